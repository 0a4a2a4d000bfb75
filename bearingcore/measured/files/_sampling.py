"""Sample rate from a time column, and faults of the column.

Printed times are rounded, clocks jump, loggers leave rows out. If a rate can still be known, it is
proposed; rows after a jump are not joined to those before it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, count, number, runs, thousands, with_prefix
from bearingcore.measured.files._facts import GREATEST_STATED, LEAST_STATED
from bearingcore.measured.files._units import TIMES
from bearingcore.recordings import FEWEST_SAMPLES

UNEVEN = 0.5
"""Greatest deviation of times from even steps, in steps: printed times are rounded, but do not
wander."""

SHORTEST_PART = 0.1
"""Least length of a part that is a recording by itself, over the longest part without a jump."""

JUMP = 1.5
"""Longest step without missing samples, relative to the usual step."""

PARTS, DRIFT = 10, 5e-3
"""Number of parts of a recording, and the largest relative difference of their mean rates if a
clock drifts or is read slightly early and late; bearings slip by more."""

SHARED = 0.2
"""Least share of rows with the time of the row before if times are rounded to more than a step."""

_CUSTOMARY = (
    *(base * 10.0**power for base in (1.0, 2.0, 2.5, 4.0, 5.0, 8.0) for power in range(1, 6)),
    *(base * 2.0**power for base in (1e2, 1e3, 1.024e3, 6e2) for power in range(0, 11)),
    *(11_025.0 * factor for factor in (1, 2, 4, 8)),
    12e3, 24e3, 48e3, 96e3, 192e3, 384e3, 97_656.25, 48_828.125, 50e3, 65_536.0,
)  # fmt: skip
"""Usual sample rates [Hz] of recorders."""


@dataclass(frozen=True)
class Sampling:
    """Sample rate and faults of a column of times.

    Attributes
    ----------
    sample_rate
        [Hz]; None if there is none.
    stated
        True if the times themselves give the rate; False for a proposal.
    first, last
        rows (last excluded) of the longest part without a jump.
    trouble
        a sentence on a fault of the times; empty without one.
    reason
        the origin of the rate, in a few words.
    parts
        rows (last excluded) of each long part without a jump, if there are several.
    """

    sample_rate: float | None
    stated: bool
    first: int
    last: int
    trouble: str = ""
    reason: str = "the time column"
    parts: tuple[tuple[int, int], ...] = ()


SLOWEST = 2.0
"""Least rate [Hz] of a signal; slower rows are those of a trend."""

_SINCE_1970 = 1e9, 2.6e9
"""Seconds since 1970, as computers count them: from 2001 to 2052."""

_SINCE_1900 = 3e4
"""Days since 1900, as spreadsheets count them: 1982."""


def times_of(time: Array, unit: str | None = None, *, sure: bool = False) -> Sampling:
    """Return sample rate and faults of a column of times whose unit may not be known.

    The size of dates since 1970 shows their unit. A rate that no recorder of vibration has is a
    proposal; without a unit, it is in the unit that makes it likely. If the unit is `sure`, there
    is no rate.
    """
    finite = time[np.isfinite(time)]
    first = float(finite[0]) if finite.size else 0.0
    dated = since_1970(time)
    in_unit = unit or dated or "s"
    sampling = sampling_of(time, TIMES[in_unit])
    if unit is None and dated is not None:
        sampling = dataclasses.replace(sampling, reason=f"the time column, in {dated} since 1970")
    rate = sampling.sample_rate
    if rate is None or LEAST_STATED <= rate <= GREATEST_STATED:
        return sampling
    per_second = rate * TIMES[in_unit]
    parts = () if unit or dated else _PARTS if first > _SINCE_1900 else _PARTS[:-1]
    rates = {name: per_second / TIMES[name] for name in parts}
    likely = next((n for n, r in rates.items() if LEAST_STATED <= r <= GREATEST_STATED), None)
    if sure or (likely is None and rate < SLOWEST):
        trouble = (
            f"A row each {with_prefix(1.0 / rate, 's', 2)} is no signal of vibration: a trend?"
        )
        return dataclasses.replace(sampling, sample_rate=None, stated=False, trouble=trouble)
    doubt = f", if it is in {likely};" if likely else "; no recorder of vibration has such a rate:"
    reason = f"{sampling.reason}{doubt} in {in_unit} it would be {number(rate, 6)} Hz"
    rate = rates[likely] if likely else rate
    return dataclasses.replace(sampling, sample_rate=rate, stated=False, reason=reason)


_PARTS = ("s", "ms", "µs", "ns", "d")


def since_1970(time: Array) -> str | None:
    """Return the unit in which numbers count from 1970; None if they do not."""
    finite = time[np.isfinite(time)]
    least, most = (finite.min(), finite.max()) if finite.size else (0.0, 0.0)
    low, high = _SINCE_1970
    return next(
        (p for p in _PARTS[:-1] if low <= least * TIMES[p] and most * TIMES[p] <= high), None
    )


def longest_run(good: NDArray[np.bool_]) -> tuple[int, int]:
    """Return first and last (excluded) of the longest stretch that is True everywhere."""
    starts, ends = runs(good)
    if not starts.size:
        return 0, 0
    longest = int((ends - starts).argmax())
    return int(starts[longest]), int(ends[longest])


MOST_SINGLE = 0.01
"""Greatest share of rows that are bridged."""


def single_gaps(whole: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return single missing rows between two complete ones, unless they are many."""
    single = np.flatnonzero(~whole[1:-1] & whole[:-2] & whole[2:]) + 1
    return single if single.size <= MOST_SINGLE * whole.size else single[:0]


def sampling_of(time: Array, unit: float = 1.0) -> Sampling:
    """Return sample rate and faults of a column of times in `unit` [s]."""
    n = len(time)
    if not np.isfinite(time).all():
        first, last = longest_run(np.isfinite(time))
        if last - first < FEWEST_SAMPLES:
            return Sampling(None, False, 0, n, "There are gaps in the time column.")
        part = sampling_of(time[first:last], unit)
        trouble = (
            f"Times are missing in {count(int(np.isnan(time).sum()), 'row')}. Only the longest "
            f"whole part is used: rows {first + 1} to {last} of {n}. {part.trouble}"
        )
        return dataclasses.replace(
            part, first=first + part.first, last=first + part.last, trouble=trouble.strip()
        )
    with np.errstate(over="ignore"):
        steps = np.diff(time)
    if not np.isfinite(steps).all():
        return Sampling(None, False, 0, n, "The times are too large.")
    if n < 3 or not (steps > 0.0).any():
        return Sampling(None, False, 0, n, "The time column does not rise.")
    return _sample_even(time, unit) or _sample_jumps(time, steps, unit)


EXACT = 1e-6
"""Relative error that does not count: no recorder's clock is this exact."""


def _customary(rate: float, error: float, unit: float, n: int) -> float:
    """Return the customary rate [Hz] within the error of rounding, else the rate itself.

    Exactly printed times are only rounded to a whole rate within their last digits, because clocks
    may be inexact.
    """
    rate, error = rate / unit, error / unit
    if error * n <= 0.024 * rate:  # rounding moves no time by as much as a fiftieth of a step
        whole = float(round(rate))
        return whole if abs(whole - rate) <= max(error, EXACT * rate) else rate
    near = min(_CUSTOMARY, key=lambda known: abs(known - rate))
    return near if abs(near - rate) <= error else rate


def _sample_even(time: Array, unit: float) -> Sampling | None:
    """Return the sampling of even times, or of times rounded to more than a step; else None."""
    n, span = len(time), float(time[-1] - time[0])
    if span <= 0.0:
        return None
    step = span / (n - 1)
    stray = float(np.abs(time - np.linspace(time[0], time[-1], n)).max())
    if stray <= UNEVEN * step:
        # the rounding of both ends is hardly larger than the deviations in between
        return Sampling(_customary(1.0 / step, 2.4 * stray / (step * span), unit, n), True, 0, n)
    steps = np.diff(time)
    if steps.min() < 0.0 or np.mean(steps == 0.0) < SHARED:
        return None
    grain = float(steps[steps > 0.0].min())
    if stray > 1.01 * grain:
        return None
    error = 2.0 * grain / (step * span)
    rate = _customary(1.0 / step, error, unit, n)
    shared = round(grain / step)
    rows = f"about {shared} rows share one" if shared > 1 else "some rows share one"
    trouble = (
        f"The times are rounded to {with_prefix(grain * unit, 's', 2)}, so that {rows}. Over all "
        f"rows the rate is {number(rate, 6)} Hz within {number(error / unit, 2)} Hz. Gaps shorter "
        "than the rounding would not show."
    )
    return Sampling(rate, False, 0, n, trouble, "the rounded time column")


def _sample_jumps(time: Array, steps: Array, unit: float) -> Sampling:
    """Return the sampling of times that jump, from the longest part between two jumps."""
    n = len(time)
    usual = float(np.median(steps[steps > 0.0]))
    shared = np.mean(steps == 0.0) >= SHARED
    jumps = np.flatnonzero((steps > JUMP * usual) | (steps < 0.0 if shared else steps <= 0.0))
    edges = np.concatenate([[0], jumps + 1, [n]])
    longest = int(np.diff(edges).argmax())
    first, last = int(edges[longest]), int(edges[longest + 1])
    if jumps.size and last - first >= FEWEST_SAMPLES:
        parts = long_parts(pairwise(edges.tolist()))
        words, used = _jump_words(steps, jumps, usual, shared), f"rows {first + 1} to {last} of {n}"
        if parts:
            words = (
                f"The file holds {len(parts)} recordings, or parts of one; number "
                f"{parts.index((first, last)) + 1}, {used}, is read unless another is chosen. "
                f"{words}."
            )
        else:
            words += f". Only the longest part without a jump is used: {used}."
        if (part := _sample_even(time[first:last], unit)) is not None:
            words = f"{words} {part.trouble}".rstrip()
            return dataclasses.replace(part, first=first, last=last, trouble=words, parts=parts)
    # a clock that drifts has nearly equal mean rates in all parts; other times give no rate
    low, high = (float(np.quantile(steps, share)) for share in (0.01, 0.99))
    mean = (n - 1) / float(time[-1] - time[0]) if time[-1] > time[0] else 1.0 / usual
    ends = np.linspace(0, n - 1, PARTS + 1).astype(int)
    means = np.diff(time[ends]) / np.maximum(np.diff(ends), 1)
    if n > FEWEST_SAMPLES and not jumps.size and means.max() <= (1.0 + DRIFT) * means.min():
        drift = number(100.0 * (means.max() / means.min() - 1.0), 2)
        trouble = f"The clock drifts: by {drift} % between tenths of the recording."
        return Sampling(mean / unit, True, 0, n, trouble)
    trouble = (
        f"The times do not rise evenly (steps of {with_prefix(low * unit, 's')} to "
        f"{with_prefix(high * unit, 's')}), so they give no frequencies; the mean rate would be "
        f"{number(mean / unit, 6)} Hz."
    )
    return Sampling(mean / unit, False, 0, n, trouble, "the mean step of an uneven time column")


def long_parts(parts: Iterable[Sequence[int]]) -> tuple[tuple[int, int], ...]:
    """Return the parts (first row, last excluded) that are recordings; none for a single one."""
    all_parts = [(first, last) for first, last in parts]
    longest = max((last - first for first, last in all_parts), default=0)
    least = max(FEWEST_SAMPLES, SHORTEST_PART * longest)
    kept = tuple((first, last) for first, last in all_parts if last - first >= least)
    return kept if len(kept) > 1 else ()


def _jump_words(steps: Array, jumps: NDArray[np.intp], usual: float, shared: bool) -> str:
    """Return words on jumps of times; with `shared` times the missing samples are unknown."""
    back = bool((steps[jumps] <= 0.0).any())
    # rounded times have rounded steps: only their mean is exact
    step = float(np.delete(steps, jumps).mean()) if len(steps) > len(jumps) else usual
    with np.errstate(over="ignore"):
        missing = float(np.maximum(np.round(steps[jumps] / step) - 1.0, 0.0).sum())
    many = "" if shared or not missing else f" ({thousands(missing)} samples are missing)"
    times = "once" if jumps.size == 1 else f"{jumps.size} times"
    return f"The times jump {times}{', also back' * back}, first after row {jumps[0] + 1}{many}"


def clock_columns(columns: Array) -> int:
    """Return the number of first columns that are hours, minutes, seconds (and parts of them).

    4 with a separate column of microseconds or milliseconds, 3 with decimal seconds, 0 if the first
    columns are something else.
    """
    if columns.shape[1] < 4:
        return 0
    count = 4 if np.array_equal(columns[:, 2], np.floor(columns[:, 2])) else 3
    clock = columns[:, :count]
    if columns.shape[1] == count or not np.isfinite(clock).all() or clock.min() < 0.0:
        return 0
    whole, last = clock[:, :-1], clock[:, -1]
    if (whole != np.floor(whole)).any() or (clock.max(axis=0) >= (24, 60, 60, 1e6)[:count]).any():
        return 0
    rises = np.mean(np.diff(last) > 0.0) > 0.9
    return count if rises and (count == 3 or last.max() > 60.0) else 0


def clock_time(columns: Array, count: int) -> Array:
    """Return the seconds since the first row, from the `count` columns of `clock_columns`."""
    hour, minute, second = columns[:, :3].T
    time = 3600.0 * hour + 60.0 * minute + second
    midnights = np.cumsum(np.diff(time, prepend=time[0]) < -43_200.0)
    time = time - time[0] + 86_400.0 * midnights
    if count == 4:
        part = columns[:, 3]
        time = time + (1e-3 if part.max() < 1e3 else 1e-6) * (part - part[0])
    return np.asarray(time)
