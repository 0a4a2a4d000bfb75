"""Ball passes of a cage whose speed wanders are followed; of a steady one they are left alone."""

import math

import numpy as np
import pytest

from bearingcore.measured.signals import BallPasses, average_passes

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
