"""Spectra over time, shaft speeds that change, and spectra over the turns of the shaft.

A speed is followed by the shaft's own lines: at each time the candidate whose multiples stand out
most, and between them nothing, over a path that never jumps (dynamic programming; after the
multi-order approach of Leclère, André & Antoni, Mechanical Systems and Signal Processing 81, 2016).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks

OVERLAP = 0.75
"""Of neighbouring segments."""

FEWEST_SEGMENTS = 4
"""That fit into a signal one after the other, at least."""

HARMONICS = 6
"""Of the shaft by which it is followed."""

STEP = 0.01
"""Between candidates for the speed, as a fraction."""

FASTEST = 3
"""Steps by which the speed may change from one segment to the next."""

LOUDEST = 12.0
"""[dB] over its surroundings that a line counts in full, so that no single one decides."""

EXCESS = 0.2
"""Share of what a line is louder that counts: the middle of a line counts more than its foot."""

SURROUNDINGS = 41
"""Lines whose median is the background of one."""

CLEAR, LEAST_LINES = 4.0, 3
"""[dB] by which so many lines of a speed stand out, or it is not followed."""


class Spectrogram(NamedTuple):
    """Power spectral density over time, or over the turns of the shaft.

    Attributes
    ----------
    time : (k,) [s] or [turns]
        middles of the segments.
    frequency : (m,) [Hz] or [orders]
    density : (k, m) [(unit of the signal)²/Hz] or [(unit)²/order]
    """

    time: NDArray[np.float64]
    frequency: NDArray[np.float64]
    density: NDArray[np.float64]


class ShaftTrack(NamedTuple):
    """A shaft speed over time.

    Attributes
    ----------
    time : (k,) [s]
    speed : (k,) [Hz]
    prominence
        [dB] by which the third strongest of its lines stands out of what lies between them.
    clear
        whether that is enough to believe it.
    """

    time: NDArray[np.float64]
    speed: NDArray[np.float64]
    prominence: float
    clear: bool


def spectrogram(signal: ArrayLike, sample_rate: float, resolution: float) -> Spectrogram:
    """Spectra of segments of 1/resolution in Hann's window, three quarters overlapping.

    Parameters
    ----------
    signal : (n,)
    sample_rate
        [Hz], or samples a turn: then the result is over turns and orders.
    resolution
        [Hz] or [orders]

    Raises
    ------
    ValueError
        for a signal shorter than four segments, or with samples that are not finite.
    """
    from scipy.signal import ShortTimeFFT  # imported late: see `spectrum`
    from scipy.signal.windows import hann

    rate = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    step = checks.number("resolution", resolution, above=0.0, at_most=rate / 16.0, unit="Hz")
    samples = np.asarray(signal, dtype=float)
    length = round(rate / step)
    if samples.ndim != 1 or len(samples) < FEWEST_SEGMENTS * length:
        allowed = f"a row of {FEWEST_SEGMENTS * length} samples at least"
        raise checks.refuse("signal", f"of shape {samples.shape}", allowed)
    if not np.isfinite(samples).all():
        raise checks.refuse("signal", "not finite everywhere", "finite numbers")
    hop = max(1, round((1.0 - OVERLAP) * length))
    transform = ShortTimeFFT(
        hann(length, sym=False), hop, rate, fft_mode="onesided2X", scale_to="psd"
    )
    first, last = transform.lower_border_end[1], transform.upper_border_begin(len(samples))[1]
    power = np.abs(transform.stft(samples - samples.mean(), p0=first, p1=last)) ** 2
    time = transform.t(len(samples), p0=first, p1=last)
    return Spectrogram(time, transform.f, power.T)


def follow_shaft(
    signal: ArrayLike, sample_rate: float, lowest: float, highest: float
) -> ShaftTrack:
    """The shaft speed over time by its own lines in a signal, between two speeds [Hz].

    Parameters
    ----------
    signal : (n,)
    sample_rate, lowest, highest
        [Hz]

    Raises
    ------
    ValueError
        for limits in the wrong order, a sample rate too low for the harmonics, or a signal that is
        too short.
    """
    from scipy.ndimage import median_filter  # imported late: see `spectrum`

    low = checks.number("lowest", lowest, above=0.0, unit="Hz")
    high = checks.number("highest", highest, above=low, unit="Hz")
    rate = checks.number("sample_rate", sample_rate, at_least=2.5 * HARMONICS * high, unit="Hz")
    seen = spectrogram(signal, rate, low / 6.0)
    kept = seen.frequency <= (HARMONICS + 1.0) * high
    level = 10.0 * np.log10(np.maximum(seen.density[:, kept], 1e-300))
    level = np.maximum(level - median_filter(level, (1, SURROUNDINGS)), 0.0)
    level = np.minimum(level, LOUDEST) + EXCESS * np.maximum(level - LOUDEST, 0.0)
    speeds = low * np.exp(STEP * np.arange(math.floor(math.log(high / low) / STEP) + 1))
    place = seen.frequency[1]

    def levels(orders: NDArray[np.float64]) -> NDArray[np.float64]:
        at = np.rint(orders[:, None] * speeds / place).astype(int)
        return np.asarray(level[:, at])

    order = np.arange(1.0, HARMONICS + 1.0)
    lines, between = levels(order), levels(order[1:] - 0.5).mean(axis=1)
    path = _smoothest(lines.mean(axis=1) - between)
    row = np.arange(len(path))
    each = lines[row, :, path].mean(axis=0) - between[row, path].mean()
    prominence = float(np.sort(each)[-LEAST_LINES])
    return ShaftTrack(seen.time, speeds[path], prominence, prominence >= CLEAR)


def _smoothest(score: NDArray[np.float64]) -> NDArray[np.int_]:
    """The path (k,) through scores (k, n) with the greatest sum that moves by FASTEST at most."""
    count = score.shape[1]
    total = score[0]
    came = np.zeros(score.shape, dtype=int)
    shifts = np.arange(-FASTEST, FASTEST + 1)
    for row in range(1, len(score)):
        padded = np.pad(total, FASTEST, constant_values=-math.inf)
        from_there = np.stack([padded[FASTEST + s : FASTEST + s + count] for s in shifts])
        best = from_there.argmax(axis=0)
        came[row] = np.arange(count) + shifts[best]
        total = score[row] + from_there[best, np.arange(count)]
    path = np.empty(len(score), dtype=int)
    path[-1] = total.argmax()
    for row in range(len(score) - 1, 0, -1):
        path[row - 1] = came[row, path[row]]
    return path


def order_map(
    signal: ArrayLike,
    sample_rate: float,
    time: ArrayLike,
    speed: ArrayLike,
    resolution: float = 0.1,
) -> Spectrogram:
    """Spectra over the turns of a shaft whose speed changes: the signal resampled by its angle.

    Parameters
    ----------
    signal : (n,)
    sample_rate
        [Hz]
    time, speed : (k,) [s], [Hz]
        the speed of the shaft; constant before the first and after the last time.
    resolution
        [orders]

    Raises
    ------
    ValueError
        for speeds that are not positive, or fewer turns than four segments have.
    """
    from scipy.interpolate import CubicSpline  # imported late: see `spectrum`

    rate = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    speeds = np.asarray(speed, dtype=float)
    if not (speeds.size and np.isfinite(speeds).all() and speeds.min() > 0.0):
        raise checks.refuse("speed", "not above 0 everywhere", "speeds above 0 Hz")
    samples = np.asarray(signal, dtype=float)
    at = np.arange(len(samples)) / rate
    each = np.interp(at, np.asarray(time, dtype=float), speeds)
    turns = np.concatenate([[0.0], np.cumsum(0.5 * (each[1:] + each[:-1]))]) / rate
    # as fine as the slowest turn was sampled, so that nothing folds back
    per_turn = math.ceil(rate / float(each.min()))
    places = np.arange(0.0, turns[-1], 1.0 / per_turn)
    resampled = CubicSpline(at, samples)(np.interp(places, turns, at))
    return spectrogram(resampled, per_turn, resolution)
