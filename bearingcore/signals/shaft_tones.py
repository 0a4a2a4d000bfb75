"""Taking the shaft's own tones out of a signal: unbalance, misalignment, looseness."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

HARMONICS = 12
"""Of the shaft that are looked at."""

REACH = 0.01
"""By how much the shaft's speed may be off, as a fraction."""

STANDS_OUT = 4.0
"""Times the median of its surroundings from which a line counts as a tone."""


def without_shaft_tones(
    signal: NDArray[np.float64], sample_rate: float, shaft: float, passing: float
) -> NDArray[np.float64]:
    """The signal (n, d) without those of the shaft's harmonics that stand out.

    Parameters
    ----------
    sample_rate, shaft
        [Hz]
    passing
        ball-pass frequency [Hz]: harmonics of the shaft beside one of its own are left in.
    """
    from scipy.fft import next_fast_len, rfft  # imported late: see `spectrum`

    count = len(signal)
    duration = count / sample_rate
    size = next_fast_len(4 * count, real=True)
    height = np.abs(rfft(signal * np.hanning(count)[:, None], size, axis=0)).sum(axis=1)
    step = sample_rate / size
    order = np.arange(1, min(HARMONICS, int(0.4 * sample_rate / shaft)) + 1)
    nearest = passing * np.maximum(np.rint(order * shaft / passing), 1.0)
    order = order[np.abs(order * shaft - nearest) > 2.5 / duration + 0.01 * nearest]
    if not len(order):
        return signal
    trials = shaft * (1.0 + np.linspace(-REACH, REACH, 401))
    index = np.rint(np.outer(trials, order) / step).astype(int)
    # each line by its height over the surroundings', so that the loudest does not speak alone
    around = np.array([_surroundings(height, k * shaft / step, 3.0 * shaft / step) for k in order])
    over = height[index] / around
    best = int(np.minimum(over, 3.0 * STANDS_OUT).sum(axis=1).argmax())
    tones = order[over[best] >= STANDS_OUT]
    if not len(tones):
        return signal
    turn = 2.0 * math.pi * float(trials[best]) / sample_rate * np.arange(count)
    waves = np.concatenate([[np.cos(k * turn), np.sin(k * turn)] for k in tones]).T
    fitted = np.linalg.lstsq(waves, signal, rcond=None)[0]
    return np.asarray(signal - waves @ fitted)


def _surroundings(height: NDArray[np.float64], middle: float, reach: float) -> float:
    """Median of a spectrum's heights within reach of a place."""
    near = height[max(0, int(middle - reach)) : int(middle + reach) + 1]
    return max(float(np.median(near)), 1e-300)
