"""A signal made steady where the angle of its shaft was measured beside it.

Taken at equal steps of that angle instead of time, the passages of balls are equally far apart
whatever the shaft does. What is made so is the record of a shaft that turns at the mean speed.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from bearingcore.common import Array, number, runs
from bearingcore.measured.signals._resampling import resample_over_turns
from bearingcore.recordings import FEWEST_SAMPLES, Recording

STEADY = 0.05
"""Turns by which the shaft may be off the angle of a steady one: lines stay sharp so, and the noise
of a column of speeds adds up to as much."""

SLOWEST = 0.5
"""Share of the highest speed below which the signal is left out: each turn gets as many samples as
the slowest one has, and they may be no more than twice those that were measured."""

NARROW = 1.3
"""A range of given speeds whose ends differ by this factor at most says which turn is meant."""

BESIDE = 0.02
"""By how much a given speed may be outside those that were measured, as a fraction."""


def at_steady_speed(
    recording: Recording, low: float, high: float, source: str
) -> tuple[Recording, float, float, str]:
    """The record at the mean speed, with the speed from, to [Hz], and where that is from.

    Where the shaft is steady, or its angle was not measured, nothing changes.

    Parameters
    ----------
    recording
        whose `shaft_angle` may count several pulses a turn.
    low, high
        [Hz] the speed that is given. If the shaft had one of them during the record, in whole
        pulses a turn, its mean speed is that of the angle; else a given speed is the mean one, as
        of a shaft behind a gear.
    source
        where the given speed is from.
    """
    if recording.shaft_angle is None:
        return recording, low, high, source
    turns, rate = recording.shaft_angle / (2.0 * math.pi), recording.sample_rate
    even = np.linspace(turns[0], turns[-1], len(turns))
    if np.abs(turns - even).max() <= STEADY:
        return recording, low, high, source
    speed = _smooth_speed(turns, rate)
    begins, ends = runs(speed >= SLOWEST * speed.max())
    slowest, fastest = float(speed.min()), float(speed.max())
    longest = int((ends - begins).argmax())
    part = slice(int(begins[longest]), int(ends[longest]))
    if part.stop - part.start < FEWEST_SAMPLES:
        return recording, low, high, source
    turns, speed = turns[part], speed[part]
    mean = float(turns[-1] - turns[0]) / (len(turns) - 1) * rate
    per_turn = rate / float(speed.min())
    columns = [
        resample_over_turns(column, turns, per_turn) for column in recording.acceleration[part].T
    ]
    made = replace(
        recording,
        acceleration=np.stack(columns, axis=1),
        sample_rate=per_turn * mean,
        shaft_angle=None,
    )
    pulses = max(1.0, round(mean / math.sqrt(low * high)))
    apart = pulses * low / fastest, slowest / (pulses * high)
    if high <= NARROW * low and max(apart) <= 1.0 + BESIDE:
        low = high = mean / pulses
    words = f"it changes by {number(100.0 * float(np.ptp(speed)) / mean, 2)} % as measured"
    return made, low, high, f"{source}; {words}, so the signal is taken over the shaft's angle"


def _smooth_speed(turns: Array, rate: float) -> Array:
    """Turns a second (n,) [Hz] in the mean of two turns around each sample."""
    last = len(turns) - 1
    reach = max(1, math.ceil(last / float(turns[-1] - turns[0])))
    index = np.arange(last + 1)
    before, after = np.maximum(index - reach, 0), np.minimum(index + reach, last)
    return np.asarray((turns[after] - turns[before]) / (after - before) * rate)
