"""Faults of a signal itself: dropouts, clipping, single blows."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.arrays import Array, runs
from bearingcore.common.numbers import count, number

LEAST_RUN = 16
"""Equal samples in a row from which a sensor is taken to have dropped out."""

LEAST_RUN_AT_RAIL = 256
"""The same at the greatest or least value, where a clipped swing stays for a while too."""

RAIL = 1e-6
"""Of the greatest swing: samples this close to an extreme are at it."""

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
        samples inside a run of equal numbers.
    dropped_share
        of the samples, 0 to 1.
    clipped_share
        of the samples at the greatest or least value, where several in a row do.
    """

    dropped: NDArray[np.bool_] = field(repr=False)
    dropped_share: float
    clipped_share: float


def signal_faults(samples: Array) -> SignalFaults:
    """Dropouts and clipping of a signal (n,)."""
    begins, ends = runs(np.diff(samples) == 0.0)  # of equal neighbours: samples begin .. end
    dropped = np.zeros(len(samples), dtype=bool)
    low, high = float(samples.min()), float(samples.max())
    near = RAIL * (high - low)
    clipped = 0
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        at_rail = samples[begin] <= low + near or samples[begin] >= high - near
        if end - begin + 1 >= (LEAST_RUN_AT_RAIL if at_rail else LEAST_RUN):
            dropped[begin : end + 1] = True
        elif at_rail:
            clipped += end - begin + 1
    return SignalFaults(dropped, float(dropped.mean()), clipped / len(samples))


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
