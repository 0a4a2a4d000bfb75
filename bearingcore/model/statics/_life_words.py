"""The fatigue life of a bearing in words."""

from __future__ import annotations

import math

from bearingcore.common import number, percent, thousands
from bearingcore.model.scene import Scene

HEAVIEST_SHARE = 0.5
"""Greatest share of the rating for which ISO 281 is valid (P ≤ 0.5 C_r)."""

LEFT_OUT = (
    "This counts the changed load distribution only. The standard rates smooth races: pressure on "
    "the edges of a defect, the impact of each ball and debris are left out, so that a damaged "
    "bearing fails sooner. Treat it as an upper limit."
)

A_CENTURY = 876_600.0
"""Life [h] above which its number has no meaning."""


def long_number(value: float) -> str:
    """Return a life with three digits, as no more are known; long numbers in groups of three."""
    return number(value, 3) if value < 1e4 else thousands(float(f"{value:.3g}"))


def turns_in_words(L: float) -> str:
    """Return a life [10⁶ turns] in words, up to 10¹² turns; "unlimited" if it is infinite."""
    if math.isinf(L):
        return "unlimited"
    return (
        f"{long_number(L)} million turns" if L < 1e6 else "practically unlimited (over 10¹² turns)"
    )


def hours_in_words(hours: float) -> str:
    """Return a life [h] in words, up to a century."""
    return f"{long_number(hours)} hours" if hours < A_CENTURY else "more than 100 years"


def life_sentence(
    scene: Scene, reason: str, L: float, hours: float, L_healthy: float, share: float
) -> str:
    """Return a life of L [10⁶ turns] in words, with what it leaves out.

    `reason` says why loads are unknown; `share` is the equivalent load over the rating.
    """
    if reason:
        return f"Life is not known: not every cage angle has a static equilibrium ({reason})."
    if math.isinf(L):
        return f"No {scene.bearing.kind.element} carries load, so there is no fatigue."
    words = f"Nine of ten bearings reach {turns_in_words(L)}"
    if math.isnan(hours):
        words += "; the shaft is at rest, so there are no hours."
    else:
        rpm = scene.shaft_speed / (2.0 * math.pi) * 60.0
        words += f", {hours_in_words(hours)} at {number(rpm, 4)} rpm."
    if share > HEAVIEST_SHARE:
        words += (
            f" The equivalent load is {100.0 * share:.0f} % of the rating: above "
            f"{100.0 * HEAVIEST_SHARE:.0f} % the standard's formula is not valid."
        )
    words = f"{words} {scene.tilt_words()}".rstrip()
    if scene.defects:
        words += f" That is {percent(L / L_healthy)} of the healthy bearing's life. {LEFT_OUT}"
    return words
