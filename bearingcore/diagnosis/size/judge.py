"""Whether the extent that explains a signal best is an answer: all that speaks against it.

First the search itself is judged: is the mean ball pass one, is it explained, is one extent ahead?
Then knocks in the envelope, which need no model of the machine, are held against the extent.
"""

from __future__ import annotations

import math

from bearingcore.common.numbers import probability, with_deviation
from bearingcore.diagnosis.extent.measure import ExtentStatus, MeasuredExtent
from bearingcore.diagnosis.size.answer import AT_LEAST, AT_MOST, Sizing, SizingStatus
from bearingcore.diagnosis.size.search import EXTENT_STEP, GREATEST_EXTENT, LEAST_EXTENT
from bearingcore.errors import FieldError

WIDEST = 0.1
"""Of a ball spacing: where extents that are nearly as good differ by more than this (their
standard deviation at `TEMPERATURE`), no size is given."""

CLEAR = 0.9
"""Probability from which a candidate counts as found."""

MUCH_UNEXPLAINED = 0.2
"""Part of the mean ball pass without noise: where the best candidate leaves more, none is it."""

PIT = math.radians(2.0)
"""[rad] Extents up to which a defect counts as a pit."""

PIT_UNEXPLAINED = 0.45
"""The same for pits, of which only a bound or a small extent is given."""

MOST_IN_ONE, FEWEST_HARMONICS = 0.5, 2.5
"""Part of the mean ball pass that one harmonic may carry, and by how many it is carried at least:
a tone that happens to be on a harmonic is not a defect."""

LEAST_PROMINENCE = 6.0
"""Of the ball-pass lines, in standard deviations: noise alone reaches 5."""

_KNOCKS_TWICE = (ExtentStatus.MEASURED, ExtentStatus.EITHER, ExtentStatus.BOUNCES)
"""Findings in the envelope where it knocks twice a ball pass."""

_CANNOT = "The size of the defect is not clear: "


def judged(sized: Sizing) -> Sizing:
    """With the finding of the search itself: an answer, a bound, or why neither."""
    return sized.said(*(_refusal(sized) or _several(sized) or _answer(sized)))


def _size(sized: Sizing) -> str:
    extent, spread = math.degrees(sized.best.extent), math.degrees(sized.extent_uncertainty)
    return with_deviation(extent, spread, "°")


def _refusal(sized: Sizing) -> tuple[SizingStatus, str] | None:
    """Why the best extent is not an explanation of the signal; None where it is one."""
    best, quality = sized.best, sized.quality
    unexplained = float(best.waveform_misfit.mean())
    without_noise = unexplained - quality.noise_share
    if sized.passes.prominence < LEAST_PROMINENCE and unexplained > 0.6:
        status = SizingStatus.NO_LINES
        words = "no lines stand out at the ball-pass frequency of an outer-race defect."
    elif quality.strongest > MOST_IN_ONE or quality.harmonics < FEWEST_HARMONICS:
        status = SizingStatus.ONE_TONE
        words = (
            f"one harmonic carries {100.0 * quality.strongest:.0f} % of the mean ball pass, as a "
            "tone would; a defect's entry and exit show in many."
        )
    elif without_noise > (MUCH_UNEXPLAINED if best.extent > PIT else PIT_UNEXPLAINED):
        status = SizingStatus.UNEXPLAINED
        words = (
            f"the best extent leaves {100.0 * unexplained:.0f} % of the mean ball pass "
            f"unexplained, of which {100.0 * quality.noise_share:.0f} % are noise. Load, "
            "speed, support or bearing may not be those of this machine."
        )
    elif abs(best.level) > math.log(10.0):
        status = SizingStatus.OTHER_LEVEL
        decibels = 10.0 / math.log(10.0) * abs(best.level)
        than = "weaker" if best.level > 0.0 else "stronger"
        words = (
            f"best match {_size(sized)}, but the signal is {decibels:.0f} dB {than} than such a "
            "defect gives: it may be in another unit, or have another cause."
        )
    else:
        return None
    return status, _CANNOT + words


def _several(sized: Sizing) -> tuple[SizingStatus, str] | None:
    """Why the best extent is not ahead of all others; None where it is."""
    best = sized.best
    if best.probability < CLEAR:
        likely = [c for c in sized.candidates if c.probability >= 0.05]
        each = ", ".join(
            f"{math.degrees(c.extent):.1f}° ({probability(c.probability)})" for c in likely
        )
        return SizingStatus.SEVERAL, f"Several extents explain the signal: {each}."
    if sized.apart > WIDEST * best.scene.bearing.ball_spacing:
        low, high = (math.degrees(best.extent + way * sized.apart) for way in (-1.0, 1.0))
        return SizingStatus.WIDE, (
            f"{_CANNOT}best match {_size(sized)}, but extents from {max(low, 0.0):.0f}° to "
            f"{high:.0f}° explain it nearly as well."
        )
    pit = _like_a_pit(sized)
    if pit:
        return SizingStatus.LIKE_A_PIT, (
            f"{_CANNOT}best match {_size(sized)}, but there one ball enters as another leaves, "
            f"and a pit shorter than {math.degrees(pit):.1f}° gives nearly the same."
        )
    return None


def _answer(sized: Sizing) -> tuple[SizingStatus, str]:
    best, spread = sized.best, sized.extent_uncertainty
    if best.extent < max(sized.resolved, LEAST_EXTENT + 2.0 * spread):
        most = math.degrees(sized.end(AT_MOST))
        words = f"The defect extends over {most:.1f}° at most: shorter ones cannot be separated."
        return AT_MOST, words
    if GREATEST_EXTENT - best.extent < max(2.0 * spread, EXTENT_STEP):
        least = math.degrees(sized.end(AT_LEAST))
        return AT_LEAST, f"The defect extends over {least:.1f}° at least."
    return SizingStatus.SIZED, (
        f"The defect extends over {_size(sized)}, {best.turns} whole ball spacings and a rest; "
        f"probability {probability(best.probability)}."
    )


def _like_a_pit(sized: Sizing) -> float:
    """Length [rad] of a pit that knocks as the best extent does; 0 where there is none.

    Whole ball spacings long, a defect is entered by one ball as another leaves it. The difference
    from a pit is how the rings swing between, and that rests on the support alone, which is never
    known so well; and pits are common.
    """
    best = sized.best
    spacing = best.scene.bearing.ball_spacing
    whole = round(best.extent / spacing)
    reach = PIT + 2.0 * sized.extent_uncertainty + 0.5 * sized.resolved
    return reach if whole >= 1 and abs(best.extent - whole * spacing) < reach else 0.0


def confirmed(sized: Sizing, knocks: MeasuredExtent | FieldError) -> Sizing:
    """An answer or a bound, once knocks in the envelope are held against it.

    `knocks` is the extent from entry to exit, of the same recording, or why there is none.
    """
    if isinstance(knocks, FieldError):
        status, why = SizingStatus.UNCONFIRMED, f"no entry and exit can bear it out: {knocks}"
    elif sized.status == AT_MOST and knocks.status in _KNOCKS_TWICE:
        status = SizingStatus.TWO_KNOCKS
        why = "the envelope has two knocks a ball pass, as a ball's entry and exit give"
    elif not _agree(sized, knocks):
        status = SizingStatus.UNCONFIRMED
        why = "entry and exit in the envelope do not bear it out"
    else:
        return sized
    return sized.said(status, f"{_CANNOT}best match {_size(sized)}, but {why}.")


def _agree(sized: Sizing, knocks: MeasuredExtent) -> bool:
    """Whether two peaks, if any, may be entry and exit of the best extent but for whole spacings.

    Either way round: the envelope does not say which of them is the entry.
    """
    if knocks.status not in (ExtentStatus.MEASURED, ExtentStatus.EITHER):
        return True
    best, room = sized.best, 2.0 * sized.extent_uncertainty
    # with two balls over the defect at once the others carry more, and so are lost for longer
    more = 2.0 * room + (knocks.offset_high if best.turns else 0.0)
    return any(
        (best.extent - low + room) % knocks.ball_spacing <= high - low + more
        for _, low, high in knocks.alternatives
    )
