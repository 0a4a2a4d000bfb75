"""Whitening: every frequency becomes equally loud, and no tone is louder than its surroundings.

Knocks spread over all frequencies, while lines of shaft, gear mesh and mains are at single ones.
Whitening leaves the part of a signal that varies in time, in which knocks show.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array

LOUDEST = 3.0
"""Greatest level of a single frequency, relative to the root mean square of its surroundings."""


def local_median(values: Array, width: int) -> Array:
    """Return the running median (n,) of positive values over `width` of them, interpolated."""
    count = len(values)
    width = max(3, min(width, count))
    half = width // 2
    places = np.unique(np.linspace(0, count - 1, max(2, 2 * count // width)).round().astype(int))
    begins = np.clip(places - half, 0, count - width)
    # all windows at once: they are few, because they overlap only by half
    windows = np.lib.stride_tricks.sliding_window_view(values, width)[begins]
    middle = np.maximum(np.median(windows, axis=1), np.finfo(float).tiny)
    return np.exp(np.interp(np.arange(count), places, np.log(middle)))


def whiten(
    transform: NDArray[np.complex128], resolution: float, width: float
) -> NDArray[np.complex128]:
    """Divide the discrete Fourier transform (m,) of a signal by the level of its surroundings.

    Parameters
    ----------
    transform
        of real samples, frequencies from 0 up.
    resolution
        [Hz] between its frequencies.
    width
        width [Hz] over which the median is the level of the surroundings.

    Returns
    -------
    (m,) with a root mean square of about 1 everywhere, and tones limited to LOUDEST.
    """
    power = np.abs(transform) ** 2
    # the median of a noise's power is ln 2 of its mean
    level = np.sqrt(local_median(power, round(width / resolution) | 1) / math.log(2.0))
    white = transform / level
    loudness = np.abs(white)
    return np.asarray(white * np.minimum(1.0, LOUDEST / np.maximum(loudness, LOUDEST)))
