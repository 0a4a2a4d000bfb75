"""Spectra over time, and over the turns of a shaft whose speed changes."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, _checks as checks
from bearingcore.measured.signals._resampling import resample_over_turns

OVERLAP = 0.75
"""Overlap of neighbouring segments."""

FEWEST_SEGMENTS = 4
"""Least number of segments that must fit into a signal one after the other."""

MOST_IN_ANGLE = 20_000_000
"""Greatest number of samples at equal steps of angle: some gigabytes."""


class Spectrogram(NamedTuple):
    """Power spectral density over time, or over the turns of the shaft.

    Attributes
    ----------
    time : (k,) [s] or [turns]
        middles of the segments.
    frequency : (m,) [Hz] or [orders]
    density : (k, m) [(unit of the signal)²/Hz] or [(unit)²/order]
    """

    time: Array
    frequency: Array
    density: Array


def spectrogram(signal: ArrayLike, sample_rate: float, resolution: float) -> Spectrogram:
    """Compute spectra of segments of 1/resolution (Hann window, overlap of three quarters).

    Parameters
    ----------
    signal : (n,)
    sample_rate
        [Hz], or samples per turn: the result is then over turns and orders.
    resolution
        [Hz] or [orders]

    Raises
    ------
    ValueError
        for a signal shorter than four segments, or with samples that are not finite.
    """
    from scipy.signal import ShortTimeFFT  # imported late: see `spectrum`
    from scipy.signal.windows import hann

    rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    step = checks.real_number("resolution", resolution, above=0.0, at_most=rate / 16.0, unit="Hz")
    length = round(rate / step)
    samples = checks.samples_of(signal, FEWEST_SEGMENTS * length, "in a row", (1,))
    hop = max(1, round((1.0 - OVERLAP) * length))
    transform = ShortTimeFFT(
        hann(length, sym=False), hop, rate, fft_mode="onesided2X", scale_to="psd"
    )
    first, last = transform.lower_border_end[1], transform.upper_border_begin(len(samples))[1]
    power = np.abs(transform.stft(samples - samples.mean(), p0=first, p1=last)) ** 2
    time = transform.t(len(samples), p0=first, p1=last)
    return Spectrogram(time, transform.f, power.T)


def order_map(
    signal: ArrayLike,
    sample_rate: float,
    time: ArrayLike,
    speed: ArrayLike,
    resolution: float = 0.1,
) -> Spectrogram:
    """Compute spectra over the turns of a shaft whose speed changes.

    The signal is resampled at equal steps of the shaft's angle.

    Parameters
    ----------
    signal : (n,)
    sample_rate
        [Hz]
    time, speed : (k,) [s], [Hz]
        the speed of the shaft at rising times; constant before the first and after the last one.
    resolution
        [orders]

    Raises
    ------
    ValueError
        for speeds that are not positive or too slow (too many samples per turn), times that do not
        rise, fewer turns than four segments need, or samples that are not finite.
    """
    from scipy.fft import next_fast_len  # imported late: see `spectrum`

    rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    speeds, times = checks.finite("speed", speed, "Hz"), checks.finite("time", time, "s")
    if not (speeds.size and speeds.min() > 0.0):
        raise checks.refuse("speed", "not above 0 everywhere", "speeds above 0 Hz")
    if len(times) != len(speeds) or (np.diff(times) <= 0.0).any():
        raise checks.refuse("time", "not rising with the speeds", "a later time for each speed")
    samples = checks.samples_of(signal, 1, "in a row", (1,))
    sample_times = np.arange(len(samples)) / rate
    sample_speeds = np.interp(sample_times, times, speeds)
    middles = 0.5 * (sample_speeds[1:] + sample_speeds[:-1])
    turns = np.concatenate([[0.0], np.cumsum(middles)]) / rate
    # as many samples a turn as the slowest turn has, so that nothing is aliased
    slowest, least = float(sample_speeds.min()), float(turns[-1]) * rate / MOST_IN_ANGLE
    if slowest < least:
        allowed = f"at least {least:.2g} Hz in such a long signal: leave out its slower parts"
        raise checks.refuse("speed", f"{slowest:.2g} Hz", allowed)
    per_turn = next_fast_len(math.ceil(rate / slowest), real=True)
    return spectrogram(resample_over_turns(samples, turns, per_turn), per_turn, resolution)
