"""A number of a scene against its limit, and what it means in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from bearingcore.common.numbers import count


@dataclass(frozen=True)
class Limit:
    """One number of a scene against its limit.

    Attributes
    ----------
    name
        what is looked at.
    value, limit [unit]
        value is NaN where it is not known.
    unit
        SI; empty for a ratio or a count.
    crossed
        True where the model no longer holds. False where the value is not known.
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
    """A limit from above, whose sentence is `fact` and then `beyond` the limit or `within` it."""
    crossed = value > limit
    return Limit(name, value, limit, unit, crossed, f"{fact}{beyond if crossed else within}")


def unknown(name: str, limit: float, unit: str, why: str) -> Limit:
    """A limit whose value is not known; `why` goes on after "as"."""
    return Limit(name, math.nan, limit, unit, False, f"{name.capitalize()}: not known, as {why}.")


def summary(found: Sequence[Limit]) -> str:
    """The limits in a line: "1 limit exceeded, 4 passed, 2 not checked" or "6 checks passed"."""
    not_known = sum(math.isnan(one.value) for one in found)
    crossed = sum(one.crossed for one in found)
    kept = len(found) - crossed - not_known
    words = [count(crossed, "limit") + " exceeded"] if crossed else []
    if kept or not crossed:
        words.append(f"{kept} passed" if crossed else f"{count(kept, 'check')} passed")
    if not_known:
        words.append(f"{not_known} not checked")
    return ", ".join(words)
