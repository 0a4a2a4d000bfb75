"""Where to listen for knocks: the octave in which the envelope of a signal is most impulsive.

A coarse kurtogram. Knocks that repeat make something ring, and there the envelope rises and falls
by more than noise or a steady tone lets it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks

MOST_SAMPLES = 2**18
"""Of a signal that are looked at: the first ones."""

PIECES = 8
"""In which the signal is judged, so that a single mishap does not decide."""

DYNAMIC_RANGE = 1e-4
"""Octaves this far below the strongest one's power are not looked at (40 dB)."""


def impulsive_band(
    signal: ArrayLike, sample_rate: float, lowest: float, highest: float
) -> tuple[float, float]:
    """The octave (from, to) [Hz] in which knocks are clearest, between two frequencies.

    Parameters
    ----------
    signal : (n,)
    sample_rate
        [Hz]
    lowest, highest
        [Hz]; where they are less than an octave apart they are the answer.

    Raises
    ------
    ValueError
        for limits that are not between 0 and half the sample rate, or a signal that is not a
        row of finite numbers.
    """
    from scipy.fft import next_fast_len  # imported late: see `spectrum`
    from scipy.signal import butter, hilbert, sosfiltfilt

    rate = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    low = checks.number("lowest", lowest, above=0.0, below=0.5 * rate, unit="Hz")
    high = checks.number("highest", highest, above=low, below=0.5 * rate, unit="Hz")
    samples = np.asarray(signal, dtype=float)[:MOST_SAMPLES]
    if samples.ndim != 1 or len(samples) < 64 * PIECES or not np.isfinite(samples).all():
        raise checks.refuse(
            "signal", f"of shape {samples.shape}", f"a row of {64 * PIECES} finite numbers at least"
        )
    count = math.floor(2.0 * math.log2(high / low)) - 1
    if count < 1:
        return low, high
    samples = samples - samples.mean()
    size = next_fast_len(len(samples))
    edges = low * 2.0 ** (0.5 * np.arange(count))
    power, impulsiveness = np.zeros(count), np.zeros(count)
    for index, edge in enumerate(edges.tolist()):
        sections = butter(4, (edge, 2.0 * edge), "bandpass", fs=rate, output="sos")
        inside = sosfiltfilt(sections, samples)
        squared = np.abs(hilbert(inside, size)[: len(samples)]) ** 2
        power[index] = squared.mean()
        impulsiveness[index] = np.median([_kurtosis(part) for part in _pieces(squared)])
    loud = power >= DYNAMIC_RANGE * power.max()
    best = float(edges[int(np.where(loud, impulsiveness, -math.inf).argmax())])
    return best, 2.0 * best


def _pieces(values: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """The values in pieces, without the tenth at both ends where the filter rings."""
    cut = len(values) // 20
    return np.array_split(values[cut : len(values) - cut], PIECES)


def _kurtosis(squared: NDArray[np.float64]) -> float:
    """Unevenness of a squared envelope: 2 for noise, 1 for a steady tone, more for knocks."""
    mean = float(squared.mean())
    return float((squared**2).mean()) / mean**2 if mean > 0.0 else 0.0
