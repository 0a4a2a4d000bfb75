"""Ball passes of damage on an inner race, which turns through the load zone."""

import numpy as np
import pytest

from bearingcore.measured.signals._averaging import load_zone_weights

COUNT, HARMONICS, TURNS = 300, 40, 0.203


def made(depth: float, noise: float, turns: float = TURNS) -> tuple[np.ndarray, np.ndarray]:
    """Loudness (n,) of passes, and their coefficients (n, N, 2) in noise."""
    rng = np.random.default_rng(5)
    shape = (COUNT, HARMONICS, 2)
    wave = rng.normal(size=shape[1:]) + 1j * rng.normal(size=shape[1:])
    loudness = 1.0 + depth * np.cos(2.0 * np.pi * turns * np.arange(COUNT) + 0.7)
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
