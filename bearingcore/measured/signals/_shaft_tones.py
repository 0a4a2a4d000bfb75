"""Taking the shaft's own tones out of a signal: unbalance, misalignment, looseness."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.common import Array

HARMONICS = 12
"""Of the shaft that are looked at."""

REACH = 0.01
"""By how much the shaft's speed may be off, as a fraction."""

TRIALS = 401

STANDS_OUT = 4.0
"""Times the median of its surroundings from which a line counts as a tone."""


def without_shaft_tones(signal: Array, sample_rate: float, shaft: float, passing: float) -> Array:
    """The signal (n, d) without those of the shaft's harmonics that are clear.

    Parameters
    ----------
    sample_rate, shaft
        [Hz]
    passing
        ball-pass frequency [Hz]: harmonics of the shaft next to one of its own are left in.
    """
    from scipy.fft import rfft  # imported late: see `spectrum`
    from scipy.signal import zoom_fft

    count = len(signal)
    duration = count / sample_rate
    faded = signal * np.hanning(count)[:, None]
    height = np.abs(rfft(faded, axis=0)).sum(axis=1)
    step = sample_rate / count
    order = np.arange(1, min(HARMONICS, int(0.4 * sample_rate / shaft)) + 1)
    nearest = passing * np.maximum(np.rint(order * shaft / passing), 1.0)
    order = order[np.abs(order * shaft - nearest) > 2.5 / duration + 0.01 * nearest]
    if not len(order):
        return signal
    trials = shaft * (1.0 + np.linspace(-REACH, REACH, TRIALS))
    lines = [
        np.abs(zoom_fft(faded, k * trials[[0, -1]], TRIALS, fs=sample_rate, endpoint=True, axis=0))
        for k in order.tolist()
    ]
    # lines that are clear by their height over the surroundings, so that not one speaks alone
    around = [_surroundings(height, k * shaft / step, 3.0 * shaft / step) for k in order]
    over = np.stack([line.sum(axis=1) for line in lines], axis=1) / around
    best = int(np.log(np.maximum(over / STANDS_OUT, 1.0)).sum(axis=1).argmax())
    tones = order[over[best] >= STANDS_OUT]
    if not len(tones):
        return signal
    turn = 2.0 * math.pi * float(trials[best]) / sample_rate * np.arange(count)
    waves = np.concatenate([[np.cos(k * turn), np.sin(k * turn)] for k in tones]).T
    fitted = np.linalg.lstsq(waves, signal, rcond=None)[0]
    return np.asarray(signal - waves @ fitted)


def _surroundings(height: Array, middle: float, reach: float) -> float:
    """Median of a spectrum's heights within reach of a place."""
    near = height[max(0, int(middle - reach)) : int(middle + reach) + 1]
    return max(float(np.median(near)), 1e-300)
