"""Faults of a signal itself: dropouts, clipping, single blows."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, count, number, runs

LEAST_RUN = 16
"""Equal samples in a row from which a sensor is taken to have dropped out, however coarse its
numbers."""

LEAST_RUN_AT_RAIL = 256
"""Equal samples in a row at the greatest or least value, where a clipped swing stays too."""

BY_CHANCE = 1e-5
"""Share of the samples at which numbers as coarse as a signal's may look held, on a straight line
or repeated. A recorder that loses samples fills the gaps with such, often at a steady rate."""

THROUGHOUT = 0.95
"""Share of a signal that is filled, or next to what is, from which the whole of it was resampled
and these are no gaps."""

LOST_REACH = 8
"""Samples over which the edge of a gap rings in the widest band, see `squared_envelopes`."""

STRAIGHT = 1e-12
"""Share of the greatest swing by which a straight line may bend: rounding bends it as much."""

LONGEST_WORD = 64
"""Samples that are looked at for repeats at most: the numbers of a signal that needs more are so
few that its repeats are its own."""

RAIL = 1e-6
"""Share of the greatest swing: samples this close to an extreme are at it."""

FEWEST_CUT, CUT_PILE = 10, 5
"""Samples at one limit, and times as many as at the next value, from which on peaks are cut off.

Of a sine, which stays longest at its peaks, it is 2.4 times.
"""


@dataclass(frozen=True)
class SignalFaults:
    """Faults of one direction of a recording.

    Attributes
    ----------
    dropped : (n,) bool
        samples that were not measured: inside a run of equal numbers or of numbers on a straight
        line, or the same as a stretch before.
    dropped_share
        of the samples, 0 to 1.
    clipped_share
        of the samples at the greatest or least value, where several in a row do.
    """

    dropped: NDArray[np.bool_] = field(repr=False)
    dropped_share: float
    clipped_share: float

    @property
    def lost_share(self) -> float:
        """Share of the samples that are dropped or so near to one that no band can show them."""
        return _spread(self.dropped)


def signal_faults(samples: Array) -> SignalFaults:
    """Dropouts and clipping of a signal (n,)."""
    steps = np.diff(samples)
    begins, ends = runs(steps == 0.0)  # of equal neighbours: samples begin .. end
    dropped = np.zeros(len(samples), dtype=bool)
    low, high = float(samples.min()), float(samples.max())
    near = RAIL * (high - low)
    levels, times = np.unique(samples, return_counts=True)
    if times[times > 1].sum() > 0.5 * times.sum():  # numbers drawn into gaps are no levels
        levels = levels[times > 1]
    step = float(np.quantile(np.diff(levels), 0.05)) if len(levels) > 1 else 0.0
    short = 1 + _fewest(step, steps)
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
    for filled in (held, _drawn(steps, step, high - low)):
        if _spread(filled) < THROUGHOUT:
            dropped |= filled
    repeated = _repeated(samples, steps, times)
    if repeated.mean() < 0.5:  # more repeats where a signal was computed, with a period
        dropped |= repeated
    return SignalFaults(dropped, float(dropped.mean()), clipped / len(samples))


def _spread(dropped: NDArray[np.bool_]) -> float:
    """Share of samples within LOST_REACH of some (n,)."""
    return float((np.convolve(dropped, np.ones(2 * LOST_REACH + 1), "same") > 0.5).mean())


def _fewest(step: float, differences: Array) -> int:
    """Differences of zero in a row that rounding to steps makes at fewer than BY_CHANCE places."""
    chance = max(step / max(float(np.median(np.abs(differences))), 1e-300), 1e-12)
    return LEAST_RUN if chance >= 0.5 else max(1, math.ceil(math.log(BY_CHANCE) / math.log(chance)))


def _drawn(steps: Array, step: float, swing: float) -> NDArray[np.bool_]:
    """Samples (n,) on straight lines between those that were measured."""
    drawn = np.zeros(len(steps) + 1, dtype=bool)
    bends = np.diff(steps)
    fewest = _fewest(step, bends)
    straight = (np.abs(bends) <= STRAIGHT * swing) & (steps[1:] != 0.0)
    for begin, end in zip(*runs(straight), strict=True):
        if end - begin >= fewest:
            drawn[begin + 1 : end + 1] = True
    return drawn


def _repeated(samples: Array, steps: Array, times: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Samples (n,) that repeat a stretch before them, number by number.

    `times` is how many times each number occurs.
    """
    repeated = np.zeros(len(samples), dtype=bool)
    moves_alike = np.unique(steps, return_counts=True)[1]
    # the chance that two samples, or two of the steps between them, are equal
    alike = max(float(np.square(many / many.sum()).sum()) for many in (times, moves_alike))
    if alike >= 0.5:
        return repeated
    word = 2
    if alike * len(samples) > 2.0:  # not as fine as if no two were equal by chance
        word *= math.ceil(math.log(BY_CHANCE / len(samples)) / math.log(alike))
    if word > LONGEST_WORD:
        return repeated
    bits = np.ascontiguousarray(samples + 0.0).view(np.uint64)
    hashed = np.zeros(len(samples) - word + 1, dtype=np.uint64)
    moves = np.zeros(len(hashed), dtype=bool)  # a sensor that rests repeats itself
    for place in range(word):
        factor = np.uint64(0x9E3779B97F4A7C15 ** (place + 1) % 2**64)
        there = bits[place : place + len(hashed)]
        hashed += (there ^ (there >> np.uint64(29))) * factor
        moves |= there != bits[: len(hashed)]
    ordered = np.sort(hashed)  # a tenth of the time that the places of equal ones take
    if not (ordered[1:] == ordered[:-1]).any():
        return repeated
    again = np.ones(len(hashed), dtype=bool)
    again[np.unique(hashed, return_index=True)[1]] = False
    for begin, end in zip(*runs(again & moves), strict=True):
        repeated[begin : end + word - 1] = True
    return repeated


def cut_off(signal: Array) -> str:
    """A sentence where the peaks of a signal (n,) are cut off by its recorder, else ""."""
    reaching = 0
    limits: list[str] = []
    for sign in (1.0, -1.0):
        side = sign * signal
        limit = side.max(initial=-np.inf)
        inside = side[side < limit]
        at = side.size - inside.size
        if not inside.size or at < FEWEST_CUT:
            continue
        next_to = np.count_nonzero(inside == inside.max())
        # a signal that rests there, as between pulses, is not cut off
        if at >= CUT_PILE * next_to and limit - np.median(side) > 0.2 * (limit - inside.min()):
            reaching += at
            limits.append(number(sign * limit, 4))
    if not reaching:
        return ""
    return (
        f"{count(reaching, 'sample')} of the file reach exactly {' or '.join(limits)}: the "
        "recorder cut the peaks off. Level, peak, crest factor and kurtosis are too low; measure "
        "with a wider range."
    )
