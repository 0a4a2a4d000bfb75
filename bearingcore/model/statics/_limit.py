"""A number of a scene with its limit, and its meaning in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bearingcore.common import count

NO_DRAWING = "the groove radii of this bearing are not known"
NO_OIL = "the viscosity of the oil and the roughness of the surfaces are not given"
NO_MOTION = "no motion of this scene has been simulated yet"
_SHORTLY = {
    NO_DRAWING: "groove radii unknown",
    NO_OIL: "oil unknown",
    NO_MOTION: "no motion yet",
}
"""Reasons for unknown values, and their short forms."""


@dataclass(frozen=True)
class Limit:
    """A number of a scene with its limit.

    Attributes
    ----------
    name
        the checked quantity.
    value, limit [unit]
        `value` is NaN if it is not known.
    unit
        SI unit; empty for a ratio or a count.
    crossed
        True if the model no longer holds; False if the value is not known.
    sentence
        the same in words, with the number.
    """

    name: str
    value: float
    limit: float
    unit: str
    crossed: bool
    sentence: str


def upper_limit(
    name: str, value: float, limit: float, unit: str, fact: str, beyond: str, within: str
) -> Limit:
    """Return an upper limit; its sentence is `fact` and then `beyond` the limit or `within` it."""
    crossed = value > limit
    return Limit(name, value, limit, unit, crossed, f"{fact}{beyond if crossed else within}")


def unknown(name: str, limit: float, unit: str, why: str) -> Limit:
    """Return a limit of unknown value; `why` continues its sentence after "as"."""
    return Limit(name, math.nan, limit, unit, False, f"{name.capitalize()}: not known, as {why}.")


def summary(limits: Sequence[Limit]) -> str:
    """Return the limits in a line: "No limit exceeded (4 unchecked: groove radii unknown)"."""
    crossed = sum(limit.crossed for limit in limits)
    words = f"{count(crossed, 'limit') if crossed else 'No limit'} exceeded"
    unchecked = [limit.sentence for limit in limits if math.isnan(limit.value)]
    if not unchecked:
        return words
    if len(unchecked) == len(limits):
        words = "No limit judged"
    text = " ".join(unchecked)
    causes = {why: short for why, short in _SHORTLY.items() if why in text}
    known = all(any(why in sentence for why in causes) for sentence in unchecked)
    because = f": {', '.join(causes.values())}" if known else ""
    return f"{words} ({len(unchecked)} unchecked{because})"
