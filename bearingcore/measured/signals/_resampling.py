"""Resampling of a signal: more samples, or equal steps of the shaft's angle."""

from __future__ import annotations

from typing import cast

import numpy as np

from bearingcore.common import Array

SAMPLES_AROUND = 32
"""Samples on either side from which a new one is made. The filter is flat within 0.01 dB up to 0.45
of the sample rate, and 80 dB down from 0.55 on."""

OVERSAMPLED = 4
"""Factor of oversampling before a spline is fitted, which is then right within 0.1 % of power."""


def resample_over_turns(signal: Array, turns: Array, per_turn: float) -> Array:
    """Return `per_turn` samples of each turn, at equal steps of the angle of the shaft.

    Parameters
    ----------
    signal : (n,)
    turns : (n,)
        rising number of turns of the shaft at each sample.

    Returns
    -------
    Array (m,)
    """
    from scipy.ndimage import map_coordinates  # imported late: see `spectrum`

    places = np.arange(turns[0], turns[-1], 1.0 / per_turn)
    samples = np.interp(places, turns, np.arange(len(turns), dtype=float))
    # a spline through the samples themselves would damp the highest frequencies
    fine = oversample(signal, OVERSAMPLED)
    return np.asarray(map_coordinates(fine, [OVERSAMPLED * samples], order=3, mode="mirror"))


def oversample(signal: Array, factor: int) -> Array:
    """Return `factor` times as many samples of a signal (n, ...), interpolated by a windowed sinc.

    The first sample of each group is the signal's own. Beyond its ends, the signal continues the
    line through its first and last sample.
    """
    from scipy.signal import firwin, resample_poly  # imported late: see `spectrum`

    if factor == 1:
        return signal
    taps = firwin(2 * SAMPLES_AROUND * factor + 1, 1.0 / factor, window=("kaiser", 8.0))
    finer = resample_poly(signal, factor, 1, axis=0, window=taps, padtype="line")  # type: ignore[call-overload]
    return cast("Array", finer)
