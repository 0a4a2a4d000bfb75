"""Lines in the spectrum of an envelope, and their height above the local noise."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from bearingcore.common import Array
from bearingcore.measured.signals._whitening import local_median


class LineLevels(NamedTuple):
    """The spectrum of an envelope, relative to the level of its surroundings.

    Attributes
    ----------
    step
        [Hz] between its frequencies, which begin at 0.
    level : (m,) [dB]
        over the surroundings' mean.
    depth : (m,)
        swing of the envelope at a frequency, relative to its mean.
    averages
        equivalent number of independent spectra in the mean.
    floor : (m,)
        the depth of the surroundings.
    """

    step: float
    level: Array
    depth: Array
    averages: float
    floor: Array


def line_levels(
    values: Array, rate: float, segment: float, highest: float, surroundings: float
) -> LineLevels:
    """Compute the levels of lines in a signal (n,) by Welch's method, Hann windows, half overlap.

    Parameters
    ----------
    values
        a squared envelope, relative to its mean.
    rate
        [Hz]
    segment
        [s]; the whole signal if it is shorter.
    highest
        [Hz] of the last line.
    surroundings
        width [Hz] over which the median is the background of a line.
    """
    from scipy.fft import next_fast_len, rfft  # imported late: see `spectrum`
    from scipy.special import gammaincinv

    count = len(values)
    length = min(count, max(16, round(segment * rate)))
    pieces = 1 if length == count else max(2, round(2 * (count - length) / length) + 1)
    begins = np.linspace(0, count - length, pieces).round().astype(int)
    window = hann(length)
    size = next_fast_len(2 * length, real=True)
    step = rate / size
    kept = min(size // 2 + 1, int(highest / step) + 2)
    parts = np.lib.stride_tricks.sliding_window_view(values, length)[begins]
    parts = (parts - parts.mean(axis=1, keepdims=True)) * window
    transform = rfft(parts, size, axis=1)[:, :kept]
    power = (transform.real**2 + transform.imag**2).mean(axis=0)
    apart = (count - length) / ((pieces - 1) * length) if pieces > 1 else 1.0
    shared = 2.0 * _correlation(round(1.0 - apart, 3)) * (1.0 - 1.0 / pieces)
    averages = pieces / (1.0 + shared)
    # a mean of n spectra of noise has a gamma distribution: its median over its mean
    median = float(gammaincinv(averages, 0.5)) / averages
    background = local_median(power, round(surroundings / step) | 1) / median
    level = 10.0 * np.log10(np.maximum(power, 1e-300) / np.maximum(background, 1e-300))
    scale = 2.0 / float(window.sum())
    depth = scale * np.sqrt(np.maximum(power - background, 0.0))
    return LineLevels(step, level, depth, averages, scale * np.sqrt(background))


@lru_cache(maxsize=64)
def hann(length: int) -> Array:
    """Return the periodic Hann window (length,)."""
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi / length * np.arange(length))
    window.setflags(write=False)
    return np.asarray(window)


@lru_cache(maxsize=256)
def _correlation(overlap: float) -> float:
    """Return the squared correlation of spectra of noise in two Hann windows with an overlap."""
    if overlap <= 0.0:
        return 0.0
    n = 256
    window = hann(n)
    shift = min(n - 1, round((1.0 - overlap) * n))
    return float((window[shift:] @ window[: n - shift] / (window @ window)) ** 2)
