"""Difference of two spectra where they count."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.signals.spectrum import spectrum

Array = NDArray[np.float64]

BAND = 1.25
"""Spectra of a motion count up to this times the highest natural frequency."""

COUNTS = 1e-4
"""Frequencies at which a direction is below this part of its greatest density do not count."""


def spectrum_difference(found: Array, expected: Array, sample_rate: float, band: float) -> float:
    """Greatest difference of spectra [dB] up to `band` [Hz], where they count.

    Infinite where a signal is not finite.
    """
    if not (np.all(np.isfinite(found)) and np.all(np.isfinite(expected))):
        return math.inf
    frequency, density = spectrum(expected, sample_rate)
    level = density.max(axis=0)
    counts = (density > COUNTS * level) & (level > 1e-12 * level.max())
    counts &= ((frequency > 2.5 * frequency[1]) & (frequency <= band))[:, None]
    if not counts.any():
        return 0.0
    with np.errstate(divide="ignore"):
        other = spectrum(found, sample_rate).density
        return float(np.abs(10.0 * np.log10(other[counts] / density[counts])).max())
