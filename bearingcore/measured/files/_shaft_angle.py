"""The angle of the shaft, from a column of its speed or of a tachometer's pulses."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from bearingcore.common import Array
from bearingcore.measured.files._channels import OTHER, PULSES, SPEED, Column, words_of
from bearingcore.measured.files._facts import names_a_limit
from bearingcore.measured.files._units import SPEEDS

FEWEST_PULSES = 8
"""Least number of a tachometer's pulses that give a speed."""

LEAST_SHARE = 0.9
"""Least share of the rows that speeds cover; shorter columns have another sample rate."""

STEP = 0.2
"""Largest relative difference of a turn from the previous one. A missed pulse doubles a turn, and
noise on a tachometer's signal makes short ones."""

MOST_MEDIANS = 8.0
"""Greatest ratio of a speed to the median around it; a higher one is an overflow or a gap."""

LOW, HIGH = 0.35, 0.65
"""Shares of its range that a tachometer's signal crosses from pulse to pulse."""


def angle_columns(columns: Sequence[Column]) -> list[int]:
    """Return columns that may give the shaft's angle: first speeds, then those of a tachometer."""
    numbered = list(enumerate(columns))
    speeds = [i for i, column in numbered if column.role == SPEED and column.unit is not None]
    speeds.sort(key=lambda i: names_a_limit(columns[i].name))  # set or allowed speeds come last
    others = [i for i, column in numbered if column.role == OTHER]
    return speeds + [i for i in others if words_of(columns[i].name) & PULSES]


def shaft_angle(values: Array, unit: str | None, sample_rate: float) -> Array | None:
    """Return the angle (n,) [rad] of the shaft at each row, from 0 at the first.

    None if the numbers (n,) are neither a speed in one direction nor regular pulses.

    Parameters
    ----------
    unit
        unit of speeds; any other unit is that of a tachometer whose pulses count as turns.
    """
    if unit is None or unit not in SPEEDS:
        begins = pulse_begins(values)
        if len(begins) < FEWEST_PULSES:
            return None
        rows, last = np.arange(len(values), dtype=float), len(begins) - 1
        turns = np.interp(rows, begins, np.arange(last + 1.0))
        turns += np.minimum(rows - begins[0], 0.0) / (begins[1] - begins[0])
        turns += np.maximum(rows - begins[-1], 0.0) / (begins[-1] - begins[-2])
        return np.asarray(2.0 * math.pi * (turns - turns[0]))
    values = measured_speeds(values)
    known = np.flatnonzero(np.isfinite(values))
    if not known.size or known[-1] - known[0] < LEAST_SHARE * len(values):
        return None
    speeds = np.interp(np.arange(len(values)), known, values[known]) * SPEEDS[unit]
    if speeds.min() < 0.0 or speeds.max() <= 0.0:  # a gyroscope swings about zero
        return None
    return np.concatenate(([0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1])))) / sample_rate


def measured_speeds(values: Array) -> Array:
    """Return the speeds (n,) of a shaft, made positive; NaN where they were not measured.

    Zeros without low speeds come from a sensor that lost its mark: a shaft that stops has both.
    """
    from scipy.ndimage import median_filter  # imported late: see `spectrum`

    finite = values[np.isfinite(values)]
    if finite.size and finite.max() <= 0.0:
        values, finite = -values, -finite
    turning = np.flatnonzero(values > 0.0)
    if not turning.size:
        return values
    values = values.copy()
    nearby = median_filter(values[turning], 9)
    values[turning[values[turning] > MOST_MEDIANS * nearby]] = np.nan
    lost = finite.min() == 0.0 and np.nanmin(values[turning]) > 0.5 * np.nanmax(values)
    return np.where(values == 0.0, np.nan, values) if lost else values


def pulse_begins(values: Array) -> Array:
    """Return the fractional rows at which pulses of a tachometer begin; none for irregular ones.

    Pulses are irregular if a turn is a fifth longer or shorter than the previous one.
    """
    if not np.isfinite(values).all():
        return np.zeros(0)
    low, high = np.quantile(values, (0.0005, 0.9995))
    level = (values - low) / max(high - low, 1e-300)
    outside = np.flatnonzero((level <= LOW) | (level >= HIGH))
    is_high = level[outside] >= HIGH
    rises = np.flatnonzero(is_high[1:] & ~is_high[:-1])
    before, after = outside[rises], outside[rises + 1]
    share = (0.5 - level[before]) / np.maximum(level[after] - level[before], 1e-300)
    begins = before + share * (after - before)
    turns = np.diff(begins)
    if turns.size < 2 or (np.abs(np.diff(turns)) > STEP * turns[1:] + 2.0).any():
        return np.zeros(0)
    return np.asarray(begins)
