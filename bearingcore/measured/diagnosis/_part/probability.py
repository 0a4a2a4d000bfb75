"""Probabilities of the parts, from their evidence.

The probability of a race has two factors. The first, from the lead, is that its lines are there.
The second, from their swing, is that damage of the race makes them: healthy bearings and the marks
of a damaged ball make faint lines too. The lines of a ball that rolls steadily are judged in the
same way; those of a ball that slips, by their height above all others in all bands. Each factor is
a logistic curve. Magnetic noise takes its share of lines at its frequency. An unknown cause is
always possible.
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
"""Lead [dB] at which the odds that lines are there are even; scale [dB] over which they grow by a
factor e. A lead is 0 at the level that chance reaches once in a thousand signals."""


DEVIATIONS, DEVIATIONS_SCALE = 2.8, 0.6
"""The same for a ball's broad lines, in deviations: by chance the greatest of their dozen places
is above 2.8 in one signal of thirty, and damaged balls are rarer than damaged races."""


class Calibration(NamedTuple):
    """The numbers that were fitted to measured records.

    Attributes
    ----------
    swing
        swing of the envelope at which the odds that damage of a race makes its lines are even.
    swing_scale
        scale [dB] over which these odds grow by a factor e.
    """

    swing: float
    swing_scale: float


CALIBRATION = Calibration(0.136, 1.51)
"""Fitted to the records of five machines, see `tests.benchmarks.scoreboard`."""


def probabilities(evidence: Iterable[PartEvidence], chosen: Calibration) -> dict[str, float]:
    """Return the probability of each part that it is damaged; the rest is that none is.

    A damaged ball marks races, but a damaged race makes no lines of a ball. So the ball comes
    first, and the races share the rest.
    """
    chances = {}
    for part in evidence:
        chances[part.part] = math.exp(log_probability(part, chosen))
        if part.part == BALL:
            above = (part.deviations - DEVIATIONS) / DEVIATIONS_SCALE
            chances[BALL] = 1.0 - (1.0 - chances[BALL]) * (1.0 - math.exp(-_doubt(above)))
        chances[part.part] *= 1.0 - part.magnetic
    no_ball = 1.0 - chances[BALL]
    return {
        name: SURE * (value if name == BALL else no_ball * value) for name, value in chances.items()
    }


def log_probability(part: PartEvidence, chosen: Calibration = CALIBRATION) -> float:
    """Return the log probability that a part's lines are there and its own damage makes them."""
    decibels = 20.0 * math.log10(max(part.swing, 1e-9) / chosen.swing)
    return -_doubt((part.lead - LEAD) / LEAD_SCALE) - _doubt(decibels / chosen.swing_scale)


def _doubt(above: float) -> float:
    """Return minus the logarithm of a logistic curve."""
    return math.log1p(math.exp(-above)) if above > -30.0 else -above
