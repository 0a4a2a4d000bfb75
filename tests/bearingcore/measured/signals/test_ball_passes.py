"""Ball passes: a wandering cage is followed; passes of an inner race count by loudness."""

import math

import numpy as np
import pytest

from bearingcore.measured.signals import BallPasses, average_passes
from bearingcore.measured.signals._averaging import load_zone_weights

RATE, FREQUENCY, COUNT = 20_480.0, 57.3, 40


def passing(wander: float, decibels: float, seed: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Known passes on a clock that wanders, with noise: the signal, and how many have passed."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(1.6 * RATE)) / RATE
    passed = FREQUENCY * (
        time
        + wander * math.sqrt(2.0) * (1.0 - np.cos(2.0 * math.pi * 0.9 * time)) / (2 * math.pi * 0.9)
    )
    order = np.arange(1, COUNT + 1)
    size = rng.standard_normal((COUNT, 2)) + 1j * rng.standard_normal((COUNT, 2))
    clean = 2.0 * (np.exp(2j * math.pi * passed[:, None] * order) @ size).real
    level = math.sqrt(np.mean(clean**2)) * 10.0 ** (-decibels / 20.0)
    return clean + level * rng.standard_normal(clean.shape), passed


def averaged(signal: np.ndarray, follow: bool) -> BallPasses:
    return average_passes(signal, RATE, 57.0, 0.02, 60.0, 2250.0, 2250.0, follow=follow)


def repeating(passes: BallPasses) -> float:
    power = passes.power[3:COUNT].sum()
    return float((np.abs(passes.harmonics[3:COUNT]) ** 2).sum() / power)


@pytest.mark.parametrize("wander", [0.002, 0.004, 0.008])
def test_a_wandering_cage_is_followed(wander: float) -> None:
    signal, passed = passing(wander, 20.0)
    lost, followed = averaged(signal, False), averaged(signal, True)
    assert repeating(lost) < 0.7
    assert repeating(followed) > 0.97
    # the passes begin when the balls pass, but for a constant
    assert followed.begins is not None
    at = np.interp(followed.begins, np.arange(len(passed)) / RATE, passed)
    away = (at - at.round() + 0.5) % 1.0
    assert np.ptp(at - np.arange(len(at))) < 0.012, away
    mean = (at[-1] - at[0]) / (followed.begins[-1] - followed.begins[0])
    assert followed.frequency == pytest.approx(mean, rel=2e-4)


@pytest.mark.parametrize("decibels", [40.0, 20.0, 5.0])
def test_a_steady_cage_is_left_alone(decibels: float) -> None:
    signal, _ = passing(0.0, decibels)
    with_it, without = averaged(signal, True), averaged(signal, False)
    assert with_it.begins is None
    assert np.array_equal(with_it.harmonics, without.harmonics)


PASSES, PASS_HARMONICS, TURNS = 300, 40, 0.203


def made(depth: float, noise: float, turns: float = TURNS) -> tuple[np.ndarray, np.ndarray]:
    """Loudness (n,) of passes, and their coefficients (n, N, 2) in noise."""
    rng = np.random.default_rng(5)
    shape = (PASSES, PASS_HARMONICS, 2)
    wave = rng.normal(size=shape[1:]) + 1j * rng.normal(size=shape[1:])
    loudness = 1.0 + depth * np.cos(2.0 * np.pi * turns * np.arange(PASSES) + 0.7)
    chance = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    return loudness, loudness[:, None, None] * wave + noise * chance


@pytest.mark.parametrize("slip", [-0.015, 0.0, 0.015])
def test_loudness_of_passes_is_found_whatever_the_slip(slip):
    loudness, passes = made(0.9, 2.0, TURNS * (1.0 + slip))
    weights = load_zone_weights(passes, TURNS, 0.02)
    np.testing.assert_allclose(weights, loudness / loudness.mean(), atol=0.12)


def test_passes_that_are_equally_loud_count_alike():
    _, passes = made(0.0, 2.0)
    np.testing.assert_allclose(load_zone_weights(passes, TURNS, 0.02), 1.0, atol=0.08)


def test_weights_bring_the_mean_pass_nearer_to_the_truth():
    _, clean = made(0.9, 0.0)
    _, passes = made(0.9, 3.0)
    truth = clean.mean(axis=0)
    weights = load_zone_weights(passes, TURNS, 0.02)
    weighted = np.tensordot(weights, passes, 1) / (weights**2).sum()
    # of Gaussian noise the error falls by 1 / sqrt(1 + depth² / 2) = 0.84
    ratio = np.linalg.norm(weighted - truth) / np.linalg.norm(passes.mean(axis=0) - truth)
    assert ratio == pytest.approx(0.84, abs=0.05)
