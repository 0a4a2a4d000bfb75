"""Kurtogram: impulsiveness of a signal in bands of many widths, and the band for its envelope.

Repeated knocks excite resonances. In their bands the envelope rises and falls more than that of
noise or of a steady tone. The bands are those of the fast kurtogram (Antoni, Mechanical Systems and
Signal Processing 21, 2007), each filtered without delay.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import Array, ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.measured.signals._filter_bank import BAND_COUNTS, Band, split, squared_envelopes

MOST_JUDGED = 2**18
"""Greatest number of samples that are used: the first ones of a signal."""

PIECES = 8
"""Number of pieces that are judged, so that a single disturbance does not decide."""

FEWEST = 24.0
"""Fewest independent values of the envelope in a piece; narrower bands are left out."""

DYNAMIC_RANGE = 1e-4
"""Least density of a band that may be chosen, relative to that of the strongest one (40 dB)."""

CHANCE = 7.0
"""Standard deviations that are subtracted from the kurtosis of a band before the choice. Among many
bands one is high by chance, and a narrow one more often than a Gaussian would be."""

SCATTER = 3.6
"""Variance of the kurtosis of noise, times duration and width: 4 ∫ sinc⁴ = 8/3 for a band of noise,
and a third more for the median of eight pieces."""


@shown_as_table
class Kurtogram(NamedTuple):
    """Spectral kurtosis of a signal in bands of many widths.

    Attributes
    ----------
    bands
        (from, to) [Hz], the whole range first, then its halves, thirds and so on.
    parts : (n,)
        number of equal parts into which the range is split for each band.
    kurtosis : (n,)
        0 for noise, -1 for a steady tone, more for knocks; the median over pieces of the signal.
    density : (n,) [(unit of the signal)²/Hz]
        mean power spectral density in each band.
    deviation : (n,)
        standard deviation of the kurtosis of noise in a band of this width.
    """

    bands: tuple[Band, ...]
    parts: NDArray[np.int_]
    kurtosis: Array
    density: Array
    deviation: Array

    def best(self, lowest: float = 0.0) -> Band:
        """Return the band for the envelope: the most impulsive one that is not too faint.

        The kurtosis that chance may add is subtracted; for narrow bands it is large.
        Bands that begin below `lowest` [Hz] are left out, unless there is no other.
        """
        loud = self.density >= DYNAMIC_RANGE * self.density.max()
        high = np.array([band.low >= lowest for band in self.bands])
        allowed = loud & high if (loud & high).any() else loud
        surplus = np.where(allowed, self.kurtosis - CHANCE * self.deviation, -math.inf)
        return self.bands[int(surplus.argmax())]

    def table(self) -> ResultTable:
        """Return a row for each band."""
        low, high = np.array(self.bands).T
        return table_of(
            ("band_low", "Hz", low),
            ("band_high", "Hz", high),
            ("kurtosis", "1", self.kurtosis, "0 for noise"),
        )


def kurtogram(signal: ArrayLike, sample_rate: float, narrowest: float = 0.0) -> Kurtogram:
    """Compute the kurtogram of a signal; its `best` is the band with the clearest knocks.

    Parameters
    ----------
    signal : (n,)
        the signal; the first 2^18 samples are used.
    sample_rate
        [Hz]
    narrowest
        least width of a band [Hz]; a short signal has wider bands.

    Raises
    ------
    ValueError
        for a sample rate that is not positive, or a signal that is not one-dimensional and finite,
        is too short, or is constant.
    """
    from scipy.signal import periodogram  # imported late: see `spectrum`

    rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    least = checks.real_number("narrowest", narrowest, at_least=0.0, unit="Hz")
    samples = checks.samples_of(signal, 32 * PIECES, "in a row", (1,))[:MOST_JUDGED]
    if not np.ptp(samples):
        raise checks.refuse("signal", "the same number throughout", "a signal that varies")
    duration = len(samples) / rate
    least = max(least, FEWEST * PIECES / duration)
    numbers = {band: parts for parts in BAND_COUNTS for band in split(rate, least, (parts,))}
    envelopes = squared_envelopes(samples, rate, list(numbers), math.inf, loudest=math.inf)
    frequency, density = periodogram(samples, rate, detrend="constant")
    kept = tuple(envelope.band for envelope in envelopes)
    widths = np.array([band.high - band.low for band in kept])
    return Kurtogram(
        kept,
        np.array([numbers[band] for band in kept]),
        np.array([_kurtosis(envelope.values) for envelope in envelopes]),
        np.array([density[(frequency >= b.low) & (frequency < b.high)].mean() for b in kept]),
        np.sqrt(SCATTER / (duration * widths)),
    )


def _kurtosis(squared: Array) -> float:
    """Return the kurtosis of a squared envelope without its ends: 0 for noise, -1 for a tone."""
    cut = len(squared) // 20
    pieces = np.array_split(squared[cut : len(squared) - cut], PIECES)
    values = [float((piece**2).mean()) / max(float(piece.mean()), 1e-300) ** 2 for piece in pieces]
    return float(np.median(values)) - 2.0
