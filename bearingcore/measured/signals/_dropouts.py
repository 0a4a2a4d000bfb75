"""Faults of a signal itself: dropouts, clipping, single blows."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, count, number, runs

LEAST_RUN = 16
"""Fewest equal samples in a row that count as a dropout of the sensor, however coarse its numbers.
"""

LEAST_RUN_AT_RAIL = 256
"""The same at the greatest or least value, where a clipped swing also stays."""

BY_CHANCE = 1e-5
"""Greatest share of the samples at which coarse numbers may look held, interpolated or repeated by
chance. A recorder that loses samples fills the gaps with such numbers, often at a steady rate."""

THROUGHOUT = 0.95
"""Share of filled samples and their neighbours above which a whole signal was resampled: then they
are no gaps."""

LOST_REACH = 8
"""Number of samples over which the edge of a gap rings in the widest band, see
`squared_envelopes`."""

STRAIGHT = 1e-12
"""Greatest bend of a straight line, relative to the greatest swing: rounding bends it as much."""

LONGEST_WORD = 64
"""Most samples that are compared to find repeats. A signal that needs more has so few different
numbers that it repeats by itself."""

RAIL = 1e-6
"""Greatest distance of a sample at an extreme, relative to the greatest swing."""

FEWEST_CUT, CUT_PILE = 10, 5
"""Peaks are cut off if at least this many samples are at one limit, and this many times as many as
at the next value. For a sine, which stays longest at its peaks, the ratio is 2.4.
"""


@dataclass(frozen=True)
class SignalFaults:
    """Faults of one direction of a recording.

    Attributes
    ----------
    dropped : (n,) bool
        samples that were not measured: in a run of equal numbers, on a straight line, or repeating
        an earlier stretch.
    dropped_share
        share of dropped samples, 0 to 1.
    clipped_share
        share of the samples in runs at the greatest or least value.
    """

    dropped: NDArray[np.bool_] = field(repr=False)
    dropped_share: float
    clipped_share: float

    @property
    def lost_share(self) -> float:
        """Share of the samples that are dropped or too near a dropped one to show in any band."""
        return _share_near(self.dropped)


def signal_faults(samples: Array) -> SignalFaults:
    """Return the dropouts and the clipping of a signal (n,)."""
    steps = np.diff(samples)
    begins, ends = runs(steps == 0.0)  # of equal neighbours: samples begin .. end
    dropped = np.zeros(len(samples), dtype=bool)
    low, high = float(samples.min()), float(samples.max())
    near = RAIL * (high - low)
    levels, times = np.unique(samples, return_counts=True)
    if times[times > 1].sum() > 0.5 * times.sum():  # interpolated numbers are no levels
        levels = levels[times > 1]
    step = float(np.quantile(np.diff(levels), 0.05)) if len(levels) > 1 else 0.0
    short = 1 + _fewest_zeros(step, steps)
    held = np.zeros(len(samples), dtype=bool)
    clipped = 0
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        at_rail = samples[begin] <= low + near or samples[begin] >= high - near
        if end - begin + 1 >= (LEAST_RUN_AT_RAIL if at_rail else LEAST_RUN):
            dropped[begin : end + 1] = True
        elif at_rail:
            clipped += end - begin + 1
        elif end - begin + 1 >= short:
            held[begin : end + 1] = True
    for filled in (held, _mark_straight(steps, step, high - low)):
        if _share_near(filled) < THROUGHOUT:
            dropped |= filled
    repeated = _mark_repeated(samples, steps, times)
    if repeated.mean() < 0.5:  # a computed, periodic signal repeats more
        dropped |= repeated
    return SignalFaults(dropped, float(dropped.mean()), clipped / len(samples))


def _share_near(dropped: NDArray[np.bool_]) -> float:
    """Return the share of samples within LOST_REACH of a dropped one (n,)."""
    return float((np.convolve(dropped, np.ones(2 * LOST_REACH + 1), "same") > 0.5).mean())


def _fewest_zeros(step: float, differences: Array) -> int:
    """Return the fewest zeros in a row that rounding to steps makes more rarely than BY_CHANCE."""
    chance = max(step / max(float(np.median(np.abs(differences))), 1e-300), 1e-12)
    return LEAST_RUN if chance >= 0.5 else max(1, math.ceil(math.log(BY_CHANCE) / math.log(chance)))


def _mark_straight(steps: Array, step: float, swing: float) -> NDArray[np.bool_]:
    """Mark samples (n,) on straight lines between those that were measured."""
    marked = np.zeros(len(steps) + 1, dtype=bool)
    bends = np.diff(steps)
    fewest = _fewest_zeros(step, bends)
    straight = (np.abs(bends) <= STRAIGHT * swing) & (steps[1:] != 0.0)
    for begin, end in zip(*runs(straight), strict=True):
        if end - begin >= fewest:
            marked[begin + 1 : end + 1] = True
    return marked


def _mark_repeated(samples: Array, steps: Array, times: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Mark samples (n,) that repeat an earlier stretch, number by number.

    `times` are the numbers of occurrences of each value.
    """
    repeated = np.zeros(len(samples), dtype=bool)
    step_times = np.unique(steps, return_counts=True)[1]
    # probability that two samples, or two of the steps between them, are equal
    equal = max(float(np.square(many / many.sum()).sum()) for many in (times, step_times))
    if equal >= 0.5:
        return repeated
    # length of a word that repeats by chance less often than BY_CHANCE; 2 for fine numbers
    word = 2
    if equal * len(samples) > 2.0:
        word *= math.ceil(math.log(BY_CHANCE / len(samples)) / math.log(equal))
    if word > LONGEST_WORD:
        return repeated
    # hash the word that begins at each sample
    bits = np.ascontiguousarray(samples + 0.0).view(np.uint64)
    hashed = np.zeros(len(samples) - word + 1, dtype=np.uint64)
    moves = np.zeros(len(hashed), dtype=bool)  # words of one number do not count
    for place in range(word):
        factor = np.uint64(0x9E3779B97F4A7C15 ** (place + 1) % 2**64)
        shifted = bits[place : place + len(hashed)]
        hashed += (shifted ^ (shifted >> np.uint64(29))) * factor
        moves |= shifted != bits[: len(hashed)]
    ordered = np.sort(hashed)  # ten times as fast as np.unique with indices
    if not (ordered[1:] == ordered[:-1]).any():
        return repeated
    again = np.ones(len(hashed), dtype=bool)
    again[np.unique(hashed, return_index=True)[1]] = False
    for begin, end in zip(*runs(again & moves), strict=True):
        repeated[begin : end + word - 1] = True
    return repeated


def cut_off(signal: Array) -> str:
    """Return a sentence if the recorder has cut off the peaks of a signal (n,), else ""."""
    reaching = 0
    limits: list[str] = []
    for sign in (1.0, -1.0):
        side = sign * signal
        limit = side.max(initial=-np.inf)
        inside = side[side < limit]
        pile = side.size - inside.size
        if not inside.size or pile < FEWEST_CUT:
            continue
        next_pile = np.count_nonzero(inside == inside.max())
        # a signal that rests at its limit, as between pulses, is not cut off
        if pile >= CUT_PILE * next_pile and limit - np.median(side) > 0.2 * (limit - inside.min()):
            reaching += pile
            limits.append(number(sign * limit, 4))
    if not reaching:
        return ""
    return (
        f"{count(reaching, 'sample')} of the file reach exactly {' or '.join(limits)}: the "
        "recorder cut the peaks off. Level, peak, crest factor and kurtosis are too low; measure "
        "with a wider range."
    )
