"""The lines of a damaged ball, in all bands together.

A ball slips in the part of its way where it carries little, and its axis wanders: its lines are
broad, and slower than rolling by up to some per cent. So short segments are looked at, the first
harmonics only, and the mean level of all bands, as what a spot strikes rings everywhere. How far a
comb stands out is counted in deviations of the combs of all other frequencies in the same signal.
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
"""Shares by which a ball may spin slower and faster than it would by rolling alone."""

RACE_SLIP = 0.025
"""Share by which the line of a race may be off."""

WITH_ONE_LINE = 1.5
"""Times the deviations of a ball's comb without its loudest line that the whole one counts at most.
Where noise swells at one frequency the other lines are chance, the best of some eight places in the
window: 2.5 deviations now and then, which names no part for sure. Of six damaged balls measured the
whole comb stands out 0.5 to 2.3 times as much as those. Where magnetic noise may make the loudest
line it counts for nothing."""

DEVIATIONS_A_MEDIAN = 1.4826
"""Standard deviations of normal numbers in a median of their distances from their median."""


def may_be(frequency: NDArray[np.float64] | float, nominal: float) -> NDArray[np.bool_]:
    """Mark the frequencies [Hz] of a ball that would roll at the nominal one."""
    ratio = np.asarray(frequency) / nominal
    return np.asarray((ratio >= 1.0 - LAG) & (ratio <= 1.0 + AHEAD))


def spin(
    combs: Combs,
    parts: Sequence[PartLines],
    explained: Callable[[float], NDArray[np.float64]],
) -> tuple[float, dict[str, float]]:
    """The place of a ball's lines, and how far the lines of each part stand out in all bands.

    Sidebands of a race may be in a ball's window, but are no stronger than the race's own lines.
    Shaft sidebands where the cage's should be are those of another bearing's inner race.

    Parameters
    ----------
    explained
        says of each comb by how much [dB] lines of a ball at a frequency [Hz] explain it.

    Returns
    -------
    Twice the spin frequency [Hz] at which a ball's lines stand out most; and by part the deviations
    of the combs at other frequencies by which its comb is above them, a ball's also above all that
    explains its lines.
    """
    order = {lines.part: lines.order for lines in parts}
    cage = next(lines.sidebands for lines in parts if lines.part == BALL)
    at, shaft = combs.frequency, combs.shaft
    spread = _deviations(combs, (0.0,))
    window = may_be(at, order[BALL] * shaft) & np.isfinite(spread)
    column = int(np.where(window, spread, -np.inf).argmax())
    frequency, ball = float(at[column]), float(spread[column]) if window.any() else -math.inf
    # combs that a ball's lines do not explain, next to them or at their sidebands: where one is
    # stronger, a ball's may be a part, the foot or a sideband of it
    places = frequency + cage * shaft * np.arange(-2, 3)[:, None]
    others = explained(frequency) == 0.0
    others |= (np.abs(at - places) <= shaft / combs.turns).any(axis=0)
    others &= ~window & np.isfinite(spread)
    parent = float(np.max(spread[others], initial=-np.inf))

    def race(part: str) -> float:
        inside = np.abs(at / (order[part] * shaft) - 1.0) <= RACE_SLIP
        return float(np.max(spread[inside & np.isfinite(spread)], initial=-np.inf))

    def sides(spacing: float) -> float:
        return float(np.nan_to_num(_deviations(combs, (-spacing, spacing))[column]))

    outer, inner, foreign = race(OUTER), race(INNER), sides(shaft) - sides(cage * shaft)
    above = ball - max(0.0, outer, inner, parent if parent > ball else 0.0, foreign)
    but_one = float(_deviations(combs, (0.0,), but_one=True)[column])
    magnetic = any(twice_mains(k * frequency) for k in range(1, SPIN_HARMONICS + 1))
    above = min(above, (1.0 if magnetic else WITH_ONE_LINE) * but_one)
    return frequency, {OUTER: outer, INNER: inner, BALL: above}


def _deviations(
    combs: Combs, sidebands: Sequence[float], but_one: bool = False
) -> NDArray[np.float64]:
    """The mean level at some distances [Hz] from harmonics of each frequency, in all bands (n,).

    In deviations of all frequencies from their median; NaN where the shaft hides all lines but one.
    `but_one` leaves out the loudest line of each comb.
    """
    total = np.zeros((SPIN_HARMONICS * len(sidebands), len(combs.frequency)))
    for envelope in combs.envelopes:
        level = np.where(envelope.hidden, np.nan, envelope.cleared)
        total += np.vstack([
            lines_at(level, envelope.levels.step, combs.frequency, SPIN_HARMONICS, away)
            for away in sidebands
        ])  # fmt: skip
    seen = np.isfinite(total)
    count = seen.sum(axis=0)
    kept = np.where(seen, total, 0.0).sum(axis=0)
    if but_one:
        kept -= np.where(count > 1, np.where(seen, total, -np.inf).max(axis=0), 0.0)
    mean = kept / np.where(count > 1, count - but_one, np.nan)
    if not np.isfinite(mean).any():
        return np.asarray(mean)
    away = mean - np.nanmedian(mean)
    return np.asarray(away / max(DEVIATIONS_A_MEDIAN * float(np.nanmedian(np.abs(away))), 1e-9))
