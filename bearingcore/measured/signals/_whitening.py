"""Whitening: every frequency equally loud, and no tone louder than what surrounds it.

Knocks spread over all frequencies, shaft lines, mesh and mains tones sit in single ones. What is
left after whitening is what varies in time, which is where knocks show.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array

LOUDEST = 3.0
"""Times the surroundings' root mean square that a single frequency may keep."""


def local_median(values: Array, width: int) -> Array:
    """Running median (n,) of positive values, over `width` of them, smooth in between."""
    count = len(values)
    width = max(3, min(width, count))
    half = width // 2
    places = np.unique(np.linspace(0, count - 1, max(2, 2 * count // width)).round().astype(int))
    begins = np.clip(places - half, 0, count - width)
    # all windows at once: they are few, as they overlap by half only
    windows = np.lib.stride_tricks.sliding_window_view(values, width)[begins]
    middle = np.maximum(np.median(windows, axis=1), np.finfo(float).tiny)
    return np.exp(np.interp(np.arange(count), places, np.log(middle)))


def whiten(
    transform: NDArray[np.complex128], resolution: float, width: float
) -> NDArray[np.complex128]:
    """The discrete Fourier transform (m,) of a signal, divided by its surroundings' level.

    Parameters
    ----------
    transform
        of real samples, frequencies from 0 up.
    resolution
        [Hz] between its frequencies.
    width
        [Hz] over which the surroundings' level is the median.

    Returns
    -------
    (m,) with a root mean square of about 1 everywhere, tones cut to LOUDEST.
    """
    power = np.abs(transform) ** 2
    # the median of a noise's power is ln 2 of its mean
    level = np.sqrt(local_median(power, round(width / resolution) | 1) / math.log(2.0))
    white = transform / level
    loudness = np.abs(white)
    return np.asarray(white * np.minimum(1.0, LOUDEST / np.maximum(loudness, LOUDEST)))
