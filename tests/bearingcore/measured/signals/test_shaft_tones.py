"""Tones of the shaft are taken out, and nothing else."""

import math

import numpy as np

from bearingcore.measured.signals._shaft_tones import without_shaft_tones

RATE = 10_000.0
TIME = np.arange(14_000) / RATE


def tones(shaft: float, orders: tuple[int, ...], size: float = 1.0) -> np.ndarray:
    waves = [np.cos(2.0 * math.pi * k * shaft * TIME + k) for k in orders]
    return size * np.stack([sum(waves), 0.5 * sum(waves)], axis=1)


def test_a_harmonic_of_the_ball_passes_beside_one_of_the_shaft_stays() -> None:
    """Every sixth of the shaft's is one of the ball passes': 42 Hz."""
    noise = 0.1 * np.random.default_rng(3).standard_normal((len(TIME), 2))
    both = noise + tones(7.0, (1, 6))
    left = without_shaft_tones(both, RATE, 7.0, 42.0)
    assert np.std(left - noise - tones(7.0, (6,))) < 0.02
