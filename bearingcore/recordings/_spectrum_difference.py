"""Difference of two spectra where they count."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array
from bearingcore.recordings._spectrum import Spectrum, spectrum

BAND = 1.25
"""Spectra of a motion count up to this times the highest natural frequency."""

COUNTS = 1e-4
"""Lines and bands in which a direction is below this part of its greatest do not count."""

RESOLUTION = 32.0
"""Resolution [Hz] of spectra that are compared; coarser where signals are short."""

GROWN = 1e100
"""A signal that is greater than this anywhere has no spectrum."""


def spectrum_difference(
    actual: Array, expected: Array, sample_rate: float, band: float, *, third_octaves: bool = False
) -> float:
    """Greatest difference of the spectra of two signals [dB], where they count.

    Infinite where a signal is not finite, NaN where nothing counts.

    Parameters
    ----------
    actual, expected : (n, k)
        signals along k directions.
    sample_rate, band
        [Hz]; frequencies up to `band` count.
    third_octaves
        of levels in third octaves, from the fourth line on, instead of single lines.
    """
    if not max(np.abs(actual).max(), np.abs(expected).max()) < GROWN:
        return math.inf
    segment = round(sample_rate / RESOLUTION)
    resolution = RESOLUTION if len(expected) >= segment else sample_rate / len(expected) * 1.001
    mine, true = (spectrum(signal, sample_rate, resolution) for signal in (actual, expected))
    if third_octaves:
        edges = third_octave_edges(4.0 * true.frequency[1], band)
        mine, true = (Spectrum(edges[1:], lines.powers(edges)) for lines in (mine, true))
        counts = _strong(true.density)
    else:
        counts = lines_that_count(true, band)
    return _greatest(mine.density, true.density, counts)


def density_difference(actual: Spectrum, expected: Spectrum, band: float) -> float:
    """`spectrum_difference` of two spectra of the same lines, as far as both go."""
    known = min(len(actual.frequency), len(expected.frequency))
    true = Spectrum(expected.frequency[:known], expected.density[:known])
    return _greatest(actual.density[:known], true.density, lines_that_count(true, band))


def _greatest(density: Array, expected: Array, counts: NDArray[np.bool_]) -> float:
    """Greatest difference [dB] where it counts: infinite where there is nothing."""
    if not counts.any():
        return math.nan
    with np.errstate(divide="ignore"):
        return float(np.abs(10.0 * np.log10(density[counts] / expected[counts])).max())


def lines_that_count(lines: Spectrum, band: float) -> NDArray[np.bool_]:
    """(m, k) where k spectra are worth comparing: below `band` [Hz], within 40 dB of their best.

    Of the first lines the mean of each segment, which is taken away, leaves no more than a remnant.
    """
    frequency = lines.frequency
    within = (frequency > 2.5 * frequency[1]) & (frequency <= band)
    return _strong(lines.density) & within[:, None]


def _strong(density: Array) -> NDArray[np.bool_]:
    """(m, k) where a direction moves at all and is within 40 dB of its best."""
    level = density.max(axis=0)
    return np.asarray((density > COUNTS * level) & (level > 1e-12 * level.max()))


def third_octave_edges(low: float, high: float) -> Array:
    """Edges (n,) [Hz] of bands from `low` to `high`, a third of an octave wide or nearly so."""
    count = max(round(3.0 * math.log2(high / low)), 1)
    return np.asarray(np.geomspace(low, high, count + 1), dtype=np.float64)
