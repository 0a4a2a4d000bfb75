"""Paths: the evidence is that of a Gaussian process, and a path that was there is found again."""

import math

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from bearingcore.diagnosis.size.path_fit import PathFit, PathModel
from bearingcore.dynamics.record import Resonance

ORDER = np.arange(3, 45)
FREQUENCY = 50.0
MODEL = PathModel(1.0, 2e-3, 0.5)
NOISE = np.linspace(0.5, 2.0, len(ORDER)) * 1e-3


def simulated(seed: int = 1) -> np.ndarray:
    rng = np.random.default_rng(seed)
    size = rng.standard_normal(len(ORDER)) + 1j * rng.standard_normal(len(ORDER))
    return size / np.linalg.norm(size)


def test_the_evidence_is_that_of_the_gaussian_it_says() -> None:
    """Against scipy's density of real and imaginary parts, for a covariance written out here."""
    pass_, exit_ = simulated(), 1.3
    one = PathFit(MODEL, ORDER, FREQUENCY, NOISE).explained(pass_[None], np.array([exit_]))
    n = len(ORDER)
    covariance = np.diag(NOISE).astype(complex)
    for i in range(n):
        for j in range(n):
            apart = ORDER[i] - ORDER[j]
            path = 1.0 / (1.0 + 2j * math.pi * FREQUENCY * 2e-3 * apart)
            covariance[i, j] += pass_[i] * path * pass_[j].conj()
            burst = 0.25 / n * math.exp(-0.5 * (0.15 * apart) ** 2)
            covariance[i, j] += burst * np.exp(-1j * apart * exit_)
    real = 0.5 * np.block([[covariance.real, -covariance.imag], [covariance.imag, covariance.real]])
    law = multivariate_normal(np.zeros(2 * n), real)
    rests = [simulated(seed) * 0.2 for seed in (2, 3)]
    expected = [float(law.logpdf(np.concatenate([r.real, r.imag]))) for r in rests]
    found = [-n * float(one.misfit(rest[None, None])[0, 0]) for rest in rests]
    assert found[1] - found[0] == pytest.approx(expected[1] - expected[0], rel=1e-6)
    determinant = np.linalg.slogdet(covariance)[1] - np.log(NOISE).sum()
    assert one.complexity[0] == pytest.approx(determinant / n, rel=1e-9)
    rooted = one.whitened(rests[0][None])[0]
    assert (np.abs(rooted) ** 2).sum() == pytest.approx(
        float(one.misfit(rests[0][None, None])[0, 0])
    )


def test_a_path_that_was_there_is_found_again() -> None:
    resonance = Resonance(900.0, 0.06, (1.0,))
    transfer = 1.5 * resonance.transfer(FREQUENCY * ORDER)
    pass_ = simulated()
    noise = np.full(len(ORDER), 1e-5)
    one = PathFit(PathModel(1.0, 2e-3), ORDER, FREQUENCY, noise).explained(pass_[None], np.zeros(1))
    rest = pass_ * transfer
    found = one.transfer(rest[None])[0]
    loud = np.abs(pass_) > 0.05
    assert np.abs(found - transfer)[loud].max() < 0.25
    assert float(one.left(rest[None])[0]) < 0.01
    # what rings before it is struck is none: the same path turned round in time is not taken up
    backwards = one.left((pass_ * transfer.conj())[None])[0]
    assert backwards > 10.0 * one.left(rest[None])[0]
