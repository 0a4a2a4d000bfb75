"""Dependence of the size of a defect on the support of the machine, where that is not known.

Masses and stiffness of a housing decide its natural frequencies, and those decide which extent is
found. Where they are not known others are tried, and each counts by how well it explains the same
signal.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field

from bearingcore.scene.support import Support

STIFFNESS_FACTORS = (0.5, 2.0)
MASS_FACTORS = (0.5, 2.0)
"""By which stiffness (damping by the root of it) and masses are multiplied in turn."""

COUNTED = 0.01
"""Weight from which a support counts as possible."""


@dataclass(frozen=True)
class SupportTrial:
    """Result of sizing with one support.

    Attributes
    ----------
    words
        how it differs from the one that was given.
    support
        it.
    extent, extent_uncertainty
        the most probable extent with it, and its standard deviation [rad].
    probability
        of that extent among those of this support.
    unexplained
        share of the mean ball pass that it leaves unexplained.
    weight
        how well it explains the signal against the others; they add up to 1.
    """

    words: str
    support: Support = field(repr=False)
    extent: float
    extent_uncertainty: float
    probability: float
    unexplained: float
    weight: float


def other_supports(support: Support) -> list[tuple[str, Support]]:
    """The support as given and others, each with how it differs."""
    found = [("as given", support)]
    for factor in STIFFNESS_FACTORS:
        words = f"stiffness × {factor:g}"
        found.append((words, _scaled(support, factor, 1.0)))
    return found + [(f"masses × {f:g}", _scaled(support, 1.0, f)) for f in MASS_FACTORS]


def _scaled(support: Support, stiffness: float, mass: float) -> Support:
    changed = {}
    for one in dataclasses.fields(support):
        value = getattr(support, one.name)
        if value is None:
            continue
        if one.name.startswith("stiffness"):
            changed[one.name] = value * stiffness
        elif one.name.startswith("damping"):
            changed[one.name] = value * math.sqrt(stiffness * mass)  # the damping ratio stays
        else:
            changed[one.name] = value * mass
    return dataclasses.replace(support, **changed)


def dependence(trials: tuple[SupportTrial, ...]) -> str:
    """A sentence: how much the answer depends on the support."""
    possible = [one for one in trials if one.weight >= COUNTED]
    low, high = (math.degrees(f(one.extent for one in possible)) for f in (min, max))
    all_low, all_high = (math.degrees(f(one.extent for one in trials)) for f in (min, max))
    best = max(trials, key=lambda one: one.weight)
    words = (
        f" The support is not known: with stiffness and masses from half to double the extent "
        f"comes out from {all_low:.1f}° to {all_high:.1f}°"
    )
    if len(possible) == 1:
        return f"{words}, but only one explains the signal ({best.words}): {high:.1f}°."
    return (
        f"{words}; {len(possible)} of {len(trials)} supports explain the signal about as well, "
        f"from {low:.1f}° to {high:.1f}°."
    )
