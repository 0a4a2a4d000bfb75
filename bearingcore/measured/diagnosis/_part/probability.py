"""Probabilities of the parts, from their evidence.

Two doubts make up that of a race: whether its lines are there, which its lead answers, and whether
the race makes them, which their swing answers: sound bearings and the marks of a damaged ball make
faint ones. The lines of a ball that rolls steadily are judged likewise; those of one that slips, by
how far they stand out of all others in all bands. Each doubt is a logistic curve. Lines where
magnetic noise has its own are shared with it; a cause that none of this knows of is always
possible.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from bearingcore.measured.diagnosis._part.evidence import PartEvidence
from bearingcore.measured.diagnosis._part.parts import BALL

SURE = 0.99
"""The greatest probability: a cause outside the model is always possible."""

LEAD, LEAD_SCALE = 1.2, 1.0
"""Lead [dB] at which lines are as probably there as not; scale [dB] on which the odds grow by e.
A lead counts from the level that chance reaches once in a thousand signals."""


DEVIATIONS, DEVIATIONS_SCALE = 2.8, 0.6
"""Lead and scale of a ball's broad lines, in deviations: by chance the greatest of their dozen
places is above 2.8 in one signal of thirty, and damaged balls are rarer than damaged races."""


class Calibration(NamedTuple):
    """The numbers that measured records have set.

    Attributes
    ----------
    swing
        of the envelope at which a race's lines are its own damage's as probably as not.
    swing_scale
        [dB] in which these odds grow by e.
    """

    swing: float
    swing_scale: float


CALIBRATION = Calibration(0.136, 1.51)
"""Fitted to the records of five machines, see `tests.benchmarks.scoreboard`."""


def probabilities(evidence: Iterable[PartEvidence], chosen: Calibration) -> dict[str, float]:
    """Probability that each part is the damaged one; what is left is that none of them is.

    A damaged ball marks races, a damaged race makes no ball's lines: where a ball's stand out, it
    is the ball, and races share the rest.
    """
    chances = {}
    for seen in evidence:
        chances[seen.part] = math.exp(log_probability(seen, chosen))
        if seen.part == BALL:
            above = (seen.deviations - DEVIATIONS) / DEVIATIONS_SCALE
            chances[BALL] = 1.0 - (1.0 - chances[BALL]) * (1.0 - math.exp(-_doubt(above)))
        chances[seen.part] *= 1.0 - seen.magnetic
    no_ball = 1.0 - chances[BALL]
    return {
        part: SURE * (value if part == BALL else no_ball * value) for part, value in chances.items()
    }


def log_probability(part: PartEvidence, chosen: Calibration = CALIBRATION) -> float:
    """Logarithm of the probability that a part's lines are there and its own damage makes them."""
    decibels = 20.0 * math.log10(max(part.swing, 1e-9) / chosen.swing)
    return -_doubt((part.lead - LEAD) / LEAD_SCALE) - _doubt(decibels / chosen.swing_scale)


def _doubt(above: float) -> float:
    """Minus the logarithm of a logistic curve."""
    return math.log1p(math.exp(-above)) if above > -30.0 else -above
