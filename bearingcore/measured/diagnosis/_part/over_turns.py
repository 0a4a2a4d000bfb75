"""Signals of a changing speed, made steady by the shaft angle that was measured with them.

A signal is resampled at equal steps of that angle instead of time. Ball passes are then equally
long, as in a record of a shaft that turns steadily at the mean speed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bearingcore.common import Array, number, runs, span
from bearingcore.measured.diagnosis._part.unknown_speed import NARROW
from bearingcore.measured.signals._filter_bank import downsample
from bearingcore.measured.signals._resampling import resample_over_turns
from bearingcore.recordings import FEWEST_SAMPLES, Recording

STEADY = 0.05
"""Greatest deviation of a steady shaft's angle, in turns: within it lines stay sharp, and the noise
of a column of speeds adds up to as much."""

SLOWEST = 0.5
"""Least speed that is kept, relative to the highest. Each turn gets as many samples as the slowest
one has, which are then at most twice those that were measured."""

DENOMINATOR = 64
"""Denominator of the ratio by which the resampled turns return to about the measured rate."""

USUAL = 5.0, 100.0
"""Range of shaft speeds [Hz] in which a tachometer is assumed to give one pulse a turn."""

LEAST_CHANGE = 0.05
"""Least change of an unmeasured speed that is reported: resonances and short spectra move the
lines of a steady shaft by up to 0.03."""

WINDOW, NEAR = 8.0, (0.7, 1.4)
"""Turns in a spectrum in which the shaft's lines are followed; range of the search, relative to the
speed."""

LARGEST_JUMP, FOLLOWED = 0.03, 0.9
"""Largest relative deviation of a speed from the mean of its neighbours, and least share of the
spectra within it: lines of a shaft reach 0.95, those of noise 0.4, of single tones 0.8."""

FEWEST_PIECES, LEAST_CORRELATION, LEAST_SHARED_CHANGE = 12, 0.75, 0.02
"""Fewest pieces of a signal whose lines are followed by phase; least rank correlation of the speeds
by three lines, which is up to 0.6 for noise and single blows; and least change that they show."""

MARGIN = 0.02
"""Largest relative distance of a given speed from the range of the measured ones."""


def resample_to_steady_speed(
    recording: Recording, low: float, high: float, source: str
) -> tuple[Recording, float, float, str]:
    """Resample a record to its mean speed; also return the speed (low, high) [Hz] and its source.

    A record stays as it is if the shaft is steady or its angle was not measured.

    Parameters
    ----------
    recording
        recording whose `shaft_angle` may count several pulses a turn.
    low, high
        given speed [Hz]. If the shaft had such a speed during the record, with whole pulses a turn,
        the angle gives its mean speed. Otherwise the given speed is the mean one, as for a shaft
        behind a gear.
    source
        source of the given speed.
    """
    if recording.shaft_angle is None:
        return recording, low, high, source
    from scipy.signal import resample_poly  # imported late: see `spectrum`

    rate, is_unknown = recording.sample_rate, high > NARROW * low
    turns = recording.shaft_angle / (2.0 * math.pi)
    mean = _mean_speed(turns, rate)
    turns /= 1.0 if is_unknown else max(1.0, round(mean / math.sqrt(low * high)))
    if is_unknown and USUAL[0] <= mean <= USUAL[1]:
        low, high, source, is_unknown = mean, mean, "assumed: a pulse is a turn", False
    # keep the longest stretch that is not too slow
    speed = _smooth_speed(turns, rate)
    begins, ends = runs(speed >= SLOWEST * speed.max())
    longest = int((ends - begins).argmax())
    part = slice(int(begins[longest]), int(ends[longest]))
    even = np.linspace(turns[0], turns[-1], len(turns))
    if np.abs(turns - even).max() <= STEADY or part.stop - part.start < FEWEST_SAMPLES:
        return recording, low, high, source
    mean, per_turn = _mean_speed(turns[part], rate), rate / float(speed[part].min())
    columns = [
        resample_over_turns(column, turns[part], per_turn)
        for column in recording.acceleration[part].T
    ]
    # return to the measured rate: at the mean speed, nothing was measured above half of it
    kept = math.floor(DENOMINATOR * rate / (per_turn * mean))
    steady = replace(
        recording,
        acceleration=resample_poly(np.stack(columns, axis=1), kept, DENOMINATOR, padtype="line"),
        sample_rate=per_turn * mean * kept / DENOMINATOR,
        shaft_angle=None,
    )
    agrees = low <= (1.0 + MARGIN) * speed.max() and high >= (1.0 - MARGIN) * speed.min()
    if agrees and not is_unknown:
        low = high = mean
    least, most = (100.0 * float(end) / mean for end in (speed[part].min(), speed[part].max()))
    words = (
        f"it changes by {number(most - least, 2)} % as measured, "
        f"{span(least, most, '% of its mean')}, so the signal is analysed over the shaft's angle"
    )
    return steady, low, high, f"{source}; {words}"


def speed_over_time(recording: Recording, shaft_speed: float | None = None) -> Array | None:
    """Return the shaft speed (n,) [rad/s] that was measured with a signal; None without one.

    It is the mean of two turns around each sample. A known `shaft_speed` [rad/s] gives the number
    of pulses a turn of a tachometer.
    """
    if recording.shaft_angle is None:
        return None
    turn = 2.0 * math.pi
    speed = turn * _smooth_speed(recording.shaft_angle / turn, recording.sample_rate)
    return speed / max(1.0, round(float(speed.mean()) / shaft_speed)) if shaft_speed else speed


def _mean_speed(turns: Array, rate: float) -> float:
    """Return the mean number of turns per second [Hz]."""
    return float(turns[-1] - turns[0]) / (len(turns) - 1) * rate


def _smooth_speed(turns: Array, rate: float) -> Array:
    """Return turns per second (n,) [Hz], the mean of two turns around each sample.

    In the first and in the last turn the speed continues its trend.
    """
    last = len(turns) - 1
    reach = min(max(1, math.ceil(rate / _mean_speed(turns, rate))), last // 4)
    inside = (turns[2 * reach :] - turns[: -2 * reach]) / (2 * reach) * rate
    past = np.arange(1, reach + 1) / reach
    begin = inside[0] + past[::-1] * (inside[0] - inside[reach])
    end = inside[-1] + past * (inside[-1] - inside[-1 - reach])
    return np.concatenate([begin, inside, end])


def speed_change(columns: Sequence[Array], rate: float, shaft: float) -> float:
    """Return the relative change of a speed that was not measured; 0 without a certain change.

    In each short spectrum the first three lines of the shaft together show its speed. Lines of
    noise jump from one spectrum to the next, those of a shaft do not. A small change hides in the
    width of such lines, but not in their phase.

    Parameters
    ----------
    columns
        signals (n,), one for each direction; a change in one of them is enough.
    shaft
        given speed [Hz].
    """
    speeds = np.linspace(NEAR[0] * shaft, NEAR[1] * shaft, 141)
    slow = [downsample(column, rate, 6.0 * shaft) for column in columns]
    change = max(_change(values, rate, shaft, speeds) for values, rate in slow)
    return change or max(_small_change(values, rate, shaft) for values, rate in slow)


def _small_change(values: Array, rate: float, shaft: float) -> float:
    """Return the change of a nearly steady speed, if the shaft's first three lines agree on it.

    The phase of each line over its order is the shaft's angle; lines of noise do not agree on it.
    """
    spectrum, step = np.fft.rfft(values - values.mean()), round(0.5 * WINDOW / shaft * rate)
    order = np.arange(len(spectrum)) * rate / len(values) / shaft
    speeds = []
    for line in (1, 2, 3):
        distance = np.minimum(np.abs(order - line) / (1.0 - NEAR[0]), 1.0)
        filtered = np.fft.ifft(spectrum * np.cos(0.5 * math.pi * distance) ** 2, len(values))
        speeds.append(np.diff(np.unwrap(np.angle(filtered))[step:-step:step]) / line)
    if len(speeds[0]) < FEWEST_PIECES or not np.ptp(values):
        return 0.0
    ranks = np.argsort(np.argsort(speeds, axis=1), axis=1)
    change = float(np.ptp(np.median(speeds, axis=0)) / np.mean(speeds))
    is_shared = np.corrcoef(ranks).min() >= LEAST_CORRELATION and change >= LEAST_SHARED_CHANGE
    return change if is_shared else 0.0


def _change(values: Array, rate: float, shaft: float, speeds: Array) -> float:
    """Return the change of the speed out of `speeds` (k,) [Hz] that fits short spectra best."""
    length = round(WINDOW / shaft * rate)
    if len(values) < 4 * length:
        return 0.0
    pieces = np.lib.stride_tricks.sliding_window_view(values - values.mean(), length)
    pieces = pieces[:: length // 2] * np.hanning(length)
    step = rate / (32 * length)
    spectra = np.abs(np.fft.rfft(pieces, 32 * length, axis=1))
    lines = np.zeros((len(pieces), len(speeds)))
    for order in (1, 2, 3):
        around = slice(round(0.5 * order * shaft / step), round(2.0 * order * shaft / step))
        background = np.median(spectra[:, around], axis=1, keepdims=True)
        place = np.round(order * speeds / step).astype(int)
        lines += np.log(np.maximum(spectra[:, place] / np.maximum(background, 1e-300), 1.0))
    best = speeds[lines.argmax(axis=1)]
    near = np.abs(2.0 * best[1:-1] / (best[2:] + best[:-2]) - 1.0) < LARGEST_JUMP
    smooth = np.median(np.lib.stride_tricks.sliding_window_view(best, 3), axis=1)
    change = float(np.ptp(smooth) / smooth.mean())
    if near.mean() < FOLLOWED or change < LEAST_CHANGE or _is_steady(values, rate, shaft, change):
        return 0.0
    return change


def _is_steady(values: Array, rate: float, shaft: float, change: float) -> bool:
    """Return True if the whole record has a line too sharp for a shaft that changes this much.

    Short spectra locate a single tone only roughly, and noise at the other orders shifts it. A
    speed that sweeps over its change has at most half of its power in a tenth of that width.
    """
    power = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(len(values)))) ** 2
    step = rate / len(values)
    first, last = (round(end * shaft / step) for end in NEAR)
    peak = first + int(power[first : last + 1].argmax())
    half_width = max(round(change * shaft / 20.0 / step), 2)
    at_peak = power[max(peak - half_width, 0) : peak + half_width + 1].sum()
    return bool(at_peak > 0.9 * power[first : last + 1].sum())
