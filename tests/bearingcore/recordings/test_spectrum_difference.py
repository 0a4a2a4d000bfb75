"""Differences of spectra: of known factors, in lines and in third octaves."""

import math

import numpy as np
import pytest

from bearingcore.recordings import spectrum
from bearingcore.recordings._spectrum_difference import spectrum_difference, third_octave_edges

RATE = 8192.0
SIGNAL = np.random.default_rng(5).normal(size=(8192, 2))


@pytest.mark.parametrize("third_octaves", [False, True])
def test_a_louder_signal_differs_by_its_factor(third_octaves: bool) -> None:
    level = spectrum_difference(1.1 * SIGNAL, SIGNAL, RATE, 3000.0, third_octaves=third_octaves)
    assert level == pytest.approx(20.0 * math.log10(1.1))
    lost = np.full_like(SIGNAL, math.nan)
    assert spectrum_difference(lost, SIGNAL, RATE, 3000.0, third_octaves=third_octaves) == math.inf
    nothing = np.zeros_like(SIGNAL)
    assert math.isnan(
        spectrum_difference(SIGNAL, nothing, RATE, 3000.0, third_octaves=third_octaves)
    )


def test_third_octaves_forgive_single_lines() -> None:
    """A tone in one of the lines adds its power to a band of many."""
    tone = 0.05 * np.sin(2.0 * math.pi * 2048.0 * np.arange(len(SIGNAL)) / RATE)
    louder = SIGNAL + tone[:, None]
    lines = spectrum_difference(louder, SIGNAL, RATE, 3000.0)
    bands = spectrum_difference(louder, SIGNAL, RATE, 3000.0, third_octaves=True)
    assert 0.0 < bands < 0.3 * lines


def test_powers_of_bands_add_up() -> None:
    lines = spectrum(SIGNAL, RATE)
    edges = third_octave_edges(128.0, 4096.0)
    assert edges[1:] / edges[:-1] == pytest.approx(2.0 ** (1.0 / 3.0))
    inside = (lines.frequency >= edges[0]) & (lines.frequency < edges[-1])
    whole = lines.density[inside].sum(axis=0) * lines.frequency[1]
    np.testing.assert_allclose(lines.powers(edges).sum(axis=0), whole, rtol=1e-12)
