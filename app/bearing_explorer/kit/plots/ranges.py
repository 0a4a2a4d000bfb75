"""Axis ranges that stay put while a slider is dragged."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

ROOM = 0.03
"""Share of the numbers' span left free, so that a thick line does not lie on the frame."""

Anchor = Literal["free", "zero", "symmetric"]


class StickyRange:
    """A range on round numbers that grows at once and shrinks late.

    It grows as soon as a number falls outside, and is fitted anew only when the numbers use less
    than `shrink_below` of it: an axis that follows every small change would hide that change.

    Parameters
    ----------
    start, end
        the range until the first fit.
    anchor
        "zero": always holds zero. "symmetric": zero in the middle. "free": neither.
    least_span
        smallest width of a fitted range, so that rounding noise is not blown up to full height.
    room
        part of the numbers' span that is kept free above and below them, so that no curve touches
        the edge; it does not extend past zero.
    """

    def __init__(
        self,
        start: float,
        end: float,
        *,
        anchor: Anchor = "free",
        least_span: float = 0.0,
        shrink_below: float = 0.5,
        room: float = 0.0,
    ) -> None:
        self.start, self.end = float(start), float(end)
        self._anchor = anchor
        self._least_span = least_span
        self._shrink_below = shrink_below
        self._room = room
        self._fitted = False

    def fit(self, *values: ArrayLike) -> tuple[float, float]:
        """Return (start, end) for these numbers; numbers that are not finite do not count."""
        low, high = self._extremes(values)
        if not low <= high:
            return self.start, self.end
        outside = low < self.start or high > self.end
        too_wide = high - low < self._shrink_below * (self.end - self.start)
        if outside or too_wide or not self._fitted:
            self.start, self.end = nice_range(low, high)
            self._fitted = True
        return self.start, self.end

    def forget(self) -> None:
        """Fit the next numbers anew."""
        self._fitted = False

    def _extremes(self, values: tuple[ArrayLike, ...]) -> tuple[float, float]:
        low, high = math.inf, -math.inf
        for value in values:
            numbers = np.asarray(value, dtype=float)
            numbers = numbers[np.isfinite(numbers)]
            if numbers.size:
                low, high = min(low, float(numbers.min())), max(high, float(numbers.max()))
        if not low <= high:
            return low, high
        if self._anchor == "zero":
            low, high = min(low, 0.0), max(high, 0.0)
            if high - low < self._least_span:
                low, high = (
                    (low, low + self._least_span)
                    if high > 0.0 or low == 0.0
                    else (high - self._least_span, high)
                )
        elif self._anchor == "symmetric":
            top = max(abs(low), abs(high), 0.5 * self._least_span)
            low, high = -top, top
        elif high - low < self._least_span:
            middle = 0.5 * (low + high)
            low, high = middle - 0.5 * self._least_span, middle + 0.5 * self._least_span
        room = self._room * (high - low)
        return (
            low - room if low < 0.0 else max(low - room, 0.0),
            high + room if high > 0.0 else min(high + room, 0.0),
        )


TICKS = 8
"""Approximate number of steps on an axis."""


def nice_range(low: float, high: float) -> tuple[float, float]:
    """Return the narrowest range with about `TICKS` round steps that holds `low` and `high`."""
    span = high - low
    if span <= 0.0:
        span = abs(low) or 1.0
        low, high = low - 0.5 * span, high + 0.5 * span
    step = nice_step(span / TICKS)
    # a number on the edge up to rounding must not cost a whole step
    start = math.floor(low / step + 1e-9) * step
    end = math.ceil(high / step - 1e-9) * step
    return start, end


def nice_step(least: float) -> float:
    """Return the smallest of 1, 2, 2.5, 5 times a power of ten that is at least `least`."""
    power = 10.0 ** math.floor(math.log10(least))
    for factor in (1.0, 2.0, 2.5, 5.0):
        if factor * power >= least * (1.0 - 1e-9):
            return factor * power
    return 10.0 * power
