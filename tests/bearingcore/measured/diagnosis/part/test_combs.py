"""Levels of combs, and how often noise reaches them."""

import numpy as np
import pytest

from bearingcore.measured.diagnosis import HARMONICS
from bearingcore.measured.diagnosis._part.combs import comb_level, lines_at, noise_level
from bearingcore.measured.signals._line_levels import line_levels


def test_the_loudest_line_does_not_count():
    lines = np.full((HARMONICS, 1), 10.0)
    assert comb_level(lines)[0] == pytest.approx(10.0)
    lines[2] = 40.0
    assert comb_level(lines)[0] == pytest.approx(10.0)
    only = np.zeros((HARMONICS, 1))
    only[0] = 40.0  # a tone
    assert comb_level(only)[0] == 0.0


@pytest.mark.parametrize("averages", [1, 4])
def test_noise_reaches_a_level_as_often_as_told(averages):
    """Held against noise through the real spectrum, windows, overlap and background."""
    rng = np.random.default_rng(8)
    rate, length = 500.0, 4.0
    seen, actual = [], 0.0
    for _ in range(25):
        values = rng.standard_normal(int(rate * length * (1 if averages == 1 else 2.5)))
        lines = line_levels(values, rate, length, 250.0, 120.0)
        actual = lines.averages
        frequency = np.arange(8.0, 40.0, 0.0625)
        level = np.clip(lines.level, -3.0, 40.0)
        seen.append(comb_level(lines_at(level, lines.step, frequency)))
    levels = np.concatenate(seen)
    for chance in (0.3, 0.1, 0.02):
        share = (levels >= noise_level(chance, actual)).mean()
        assert share == pytest.approx(chance, rel=0.35)
