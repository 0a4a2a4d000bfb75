"""Squared envelopes in bands, and the levels of their lines."""

import itertools

import numpy as np
import pytest

from bearingcore.measured.signals._filter_bank import LOWEST, Band, split, squared_envelopes
from bearingcore.measured.signals._line_levels import line_levels

RATE = 16_000.0


def test_dropouts_neither_knock_nor_lower_the_mean():
    rng = np.random.default_rng(6)
    signal = rng.standard_normal(64_000) + 5.0
    dropped = np.zeros(len(signal), dtype=bool)
    for begin in range(0, len(signal), 3200):  # five a second
        dropped[begin : begin + 800] = True
    signal[dropped] = 0.0
    (envelope,) = squared_envelopes(signal, RATE, [Band(LOWEST, 8000.0)], 300.0, dropped)
    levels = line_levels(envelope.values, envelope.rate, 2.0, 300.0, 60.0)
    fives = np.rint(5.0 * np.arange(1, 40) / levels.step).astype(int)
    assert levels.level[fives].mean() < 3.0
    (bare,) = squared_envelopes(signal, RATE, [Band(LOWEST, 8000.0)], 300.0)
    levels = line_levels(bare.values, bare.rate, 2.0, 300.0, 60.0)
    assert levels.level[fives[:10]].mean() > 15.0


def test_a_line_has_its_depth_and_stands_above_its_surroundings():
    rng = np.random.default_rng(7)
    time = np.arange(20_000) / 1000.0
    values = 1.0 + 0.1 * np.cos(2.0 * np.pi * 40.0 * time) + 0.3 * rng.standard_normal(20_000)
    levels = line_levels(values, 1000.0, 4.0, 200.0, 20.0)
    index = round(40.0 / levels.step)
    assert levels.depth[index] == pytest.approx(0.1, rel=0.05)
    assert levels.level[index] > 17.0
    away = np.abs(levels.step * np.arange(len(levels.level)) - 40.0) > 2.0
    assert np.mean(10.0 ** (0.1 * levels.level[away])) == pytest.approx(1.0, abs=0.1)
    assert levels.averages == pytest.approx(9.0 / (1.0 + 2.0 / 36.0 * 8.0 / 9.0), rel=0.02)


def test_bands_cover_the_range_without_gap_and_none_is_too_narrow():
    bands = split(RATE, 900.0)
    assert bands[0] == (LOWEST, 8000.0)
    assert min(band.high - band.low for band in bands) > 900.0
    for parts in (2, 3, 4, 6, 8):
        width = 8000.0 / parts
        level = [
            b
            for b in bands
            if b.high - b.low < width + 1e-6 and b.high - b.low > width - LOWEST - 1
        ]
        assert len(level) == parts
        for one, following in itertools.pairwise(level):
            assert one.high == pytest.approx(following.low)
