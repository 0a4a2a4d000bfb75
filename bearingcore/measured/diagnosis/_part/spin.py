"""The lines of a damaged ball, in all bands together.

A ball slips where it carries little load, and its axis wanders. Its lines are therefore broad, and
up to 6 % slower than in pure rolling. So only the first harmonics in short segments are used,
and the mean level of all bands, because a blow excites all of them. The height of a comb is counted
in deviations of the combs at all other frequencies in the same signal.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.diagnosis._part.combs import lines_at
from bearingcore.measured.diagnosis._part.mains import twice_mains
from bearingcore.measured.diagnosis._part.parts import BALL, INNER, OUTER, PartLines
from bearingcore.measured.diagnosis._part.search import Combs

SPIN_HARMONICS = 3
"""Harmonics of twice the spin frequency: the lines of higher ones are too broad."""

LAG, AHEAD = 0.06, 0.02
"""Shares by which a ball may spin slower and faster than by rolling alone."""

RACE_SLIP = 0.025
"""Largest relative deviation of the line of a race."""

WITH_ONE_LINE = 1.5
"""Greatest height of a ball's whole comb that counts, over its height without the loudest line.
Where noise is strong at one frequency the other lines are chance: the best of some eight places in
the window has 2.5 deviations now and then, which names no part for sure. In six measured records of
damaged balls the ratio is 0.5 to 2.3. A loudest line that may be magnetic noise does not count."""

DEVIATIONS_A_MEDIAN = 1.4826
"""Standard deviation of normal numbers over the median distance from their median."""


def may_be_ball(frequency: NDArray[np.float64] | float, nominal: float) -> NDArray[np.bool_]:
    """Mark the frequencies [Hz] that a ball with this nominal one may have."""
    ratio = np.asarray(frequency) / nominal
    return np.asarray((ratio >= 1.0 - LAG) & (ratio <= 1.0 + AHEAD))


def find_spin(
    combs: Combs,
    parts: Sequence[PartLines],
    explained: Callable[[float], NDArray[np.float64]],
) -> tuple[float, dict[str, float]]:
    """Find the frequency of a ball's lines, and the height of each part's lines in all bands.

    Sidebands of a race may be in a ball's window, but are no stronger than the race's own lines.
    Sidebands of the shaft instead of the cage belong to the inner race of another bearing.

    Parameters
    ----------
    explained
        returns for each comb the height [dB] that a ball's lines at a frequency [Hz] explain.

    Returns
    -------
    Twice the spin frequency [Hz], where a ball's lines are highest; and by part the height of its
    lines above those at other frequencies, in deviations. That of a ball is also above all lines
    that may explain its own.
    """
    order = {lines.part: lines.order for lines in parts}
    cage = next(lines.sidebands for lines in parts if lines.part == BALL)
    at, shaft = combs.frequency, combs.shaft
    height = _deviations(combs, (0.0,))
    # the highest comb in the window of a ball
    window = may_be_ball(at, order[BALL] * shaft) & np.isfinite(height)
    column = int(np.where(window, height, -np.inf).argmax())
    frequency, ball = float(at[column]), float(height[column]) if window.any() else -math.inf
    # the highest comb outside that a ball does not explain, is next to its lines, or at their
    # sidebands: if it is stronger, the ball's lines may be a part, the foot or a sideband of it
    places = frequency + cage * shaft * np.arange(-2, 3)[:, None]
    others = explained(frequency) == 0.0
    others |= (np.abs(at - places) <= shaft / combs.turns).any(axis=0)
    others &= ~window & np.isfinite(height)
    parent = float(np.max(height[others], initial=-np.inf))

    def race_height(part: str) -> float:
        inside = np.abs(at / (order[part] * shaft) - 1.0) <= RACE_SLIP
        return float(np.max(height[inside & np.isfinite(height)], initial=-np.inf))

    def sideband_height(spacing: float) -> float:
        return float(np.nan_to_num(_deviations(combs, (-spacing, spacing))[column]))

    outer, inner = race_height(OUTER), race_height(INNER)
    foreign = sideband_height(shaft) - sideband_height(cage * shaft)
    above = ball - max(0.0, outer, inner, parent if parent > ball else 0.0, foreign)
    # no single line may decide, and one that may be magnetic noise does not count
    but_one = float(_deviations(combs, (0.0,), but_one=True)[column])
    magnetic = any(twice_mains(k * frequency) for k in range(1, SPIN_HARMONICS + 1))
    above = min(above, (1.0 if magnetic else WITH_ONE_LINE) * but_one)
    return frequency, {OUTER: outer, INNER: inner, BALL: above}


def _deviations(
    combs: Combs, sidebands: Sequence[float], but_one: bool = False
) -> NDArray[np.float64]:
    """Return the mean level (n,) at some distances [Hz] from harmonics, over all bands.

    It is in deviations of all frequencies from their median; NaN where the shaft hides all lines
    but one. `but_one` leaves out the loudest line of each comb.
    """
    total = np.zeros((SPIN_HARMONICS * len(sidebands), len(combs.frequency)))
    for envelope in combs.envelopes:
        level = np.where(envelope.hidden, np.nan, envelope.cleared)
        total += np.vstack([
            lines_at(level, envelope.levels.step, combs.frequency, SPIN_HARMONICS, away)
            for away in sidebands
        ])  # fmt: skip
    visible = np.isfinite(total)
    count = visible.sum(axis=0)
    sums = np.where(visible, total, 0.0).sum(axis=0)
    if but_one:
        sums -= np.where(count > 1, np.where(visible, total, -np.inf).max(axis=0), 0.0)
    mean = sums / np.where(count > 1, count - but_one, np.nan)
    if not np.isfinite(mean).any():
        return np.asarray(mean)
    height = mean - np.nanmedian(mean)
    deviation = DEVIATIONS_A_MEDIAN * float(np.nanmedian(np.abs(height)))
    return np.asarray(height / max(deviation, 1e-9))
