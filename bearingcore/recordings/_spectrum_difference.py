"""Difference of two spectra at the frequencies that count."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array
from bearingcore.recordings._spectrum import Spectrum, spectrum

BAND = 1.25
"""Highest frequency of a motion that counts, relative to its highest natural frequency."""

COUNTS = 1e-4
"""Least density of a line or band that counts, relative to the greatest of its direction."""

RESOLUTION = 32.0
"""Resolution [Hz] of spectra that are compared; coarser where signals are short."""

GROWN = 1e100
"""A signal with any value above this has no spectrum."""


def spectrum_difference(
    actual: Array, expected: Array, sample_rate: float, band: float, *, third_octaves: bool = False
) -> float:
    """Return the greatest difference of the spectra of two signals [dB], where they count.

    It is infinite if a signal is not finite, and NaN if no frequency counts.

    Parameters
    ----------
    actual, expected : (n, k)
        signals along k directions.
    sample_rate, band
        [Hz]; frequencies up to `band` count.
    third_octaves
        True compares levels in third octaves, from the fourth line on, instead of single lines.
    """
    if not max(np.abs(actual).max(), np.abs(expected).max()) < GROWN:
        return math.inf
    segment = round(sample_rate / RESOLUTION)
    resolution = RESOLUTION if len(expected) >= segment else sample_rate / len(expected) * 1.001
    computed, true = (spectrum(signal, sample_rate, resolution) for signal in (actual, expected))
    if third_octaves:
        edges = third_octave_edges(4.0 * true.frequency[1], band)
        computed, true = (Spectrum(edges[1:], lines.powers(edges)) for lines in (computed, true))
        counts = _is_strong(true.density)
    else:
        counts = lines_that_count(true, band)
    return _greatest(computed.density, true.density, counts)


def density_difference(actual: Spectrum, expected: Spectrum, band: float) -> float:
    """Return the `spectrum_difference` of two spectra over the lines that both have."""
    shared = min(len(actual.frequency), len(expected.frequency))
    true = Spectrum(expected.frequency[:shared], expected.density[:shared])
    return _greatest(actual.density[:shared], true.density, lines_that_count(true, band))


def _greatest(density: Array, expected: Array, counts: NDArray[np.bool_]) -> float:
    """Return the greatest difference [dB] where it counts; infinite if one density is 0."""
    if not counts.any():
        return math.nan
    with np.errstate(divide="ignore"):
        return float(np.abs(10.0 * np.log10(density[counts] / expected[counts])).max())


def lines_that_count(lines: Spectrum, band: float) -> NDArray[np.bool_]:
    """Mask (m, k) of the lines of k spectra that count: up to `band` [Hz], within 40 dB of the top.

    The first lines do not count, because the mean of each segment is removed.
    """
    frequency = lines.frequency
    within = (frequency > 2.5 * frequency[1]) & (frequency <= band)
    return _is_strong(lines.density) & within[:, None]


def _is_strong(density: Array) -> NDArray[np.bool_]:
    """Mask (m, k) where a direction moves at all and is within 40 dB of its greatest density."""
    level = density.max(axis=0)
    return np.asarray((density > COUNTS * level) & (level > 1e-12 * level.max()))


def third_octave_edges(low: float, high: float) -> Array:
    """Return the edges (n,) [Hz] of bands from `low` to `high`, about a third of an octave wide."""
    count = max(round(3.0 * math.log2(high / low)), 1)
    return np.asarray(np.geomspace(low, high, count + 1), dtype=np.float64)
