"""The fatigue life of a bearing in words."""

from __future__ import annotations

import math

from bearingcore.common import number, percent, thousands
from bearingcore.model.scene import Scene
from bearingcore.model.statics._load_rating import GIVEN

HEAVIEST_SHARE = 0.5
"""Of the rating, up to which ISO 281 vouches for its life (P ≤ 0.5 C_r)."""

LEFT_OUT = (
    "This counts the changed load distribution only. The standard rates smooth races: pressure on "
    "the edges of a defect, the impact of each ball and debris are left out, so that a damaged "
    "bearing fails sooner. Treat it as an upper limit."
)


A_CENTURY = 876_600.0
"""[h] of a life beyond which its number means nothing."""


def long_number(value: float) -> str:
    """To three digits, in groups of three where it is long: of lives no more is known."""
    return number(value, 3) if value < 1e4 else thousands(float(f"{value:.3g}"))


def turns_in_words(L: float) -> str:
    """A life [10⁶ turns], up to a million of millions; "unlimited" where it is infinite."""
    if math.isinf(L):
        return "unlimited"
    return (
        f"{long_number(L)} million turns" if L < 1e6 else "practically unlimited (over 10¹² turns)"
    )


def hours_in_words(hours: float) -> str:
    """Hours of a life [h], up to a century."""
    return f"{long_number(hours)} hours" if hours < A_CENTURY else "more than 100 years"


def life_sentence(
    scene: Scene,
    reason: str,
    lives: tuple[float, float, float],
    loading: tuple[float, float],
    rating_source: str,
) -> str:
    """Return a life in words, with what it leaves out.

    Parameters
    ----------
    reason
        why loads are not known; empty where they are.
    lives
        L_10r [10⁶ turns], the same in hours, and L_10r of the healthy bearing.
    loading
        equivalent load P and rating C_r [N].
    rating_source
        GIVEN, or where else C_r is from.
    """
    L, hours, L_healthy = lives
    P, C = loading
    rating = "" if rating_source == GIVEN else f" Rating {long_number(C)} N, {rating_source}."
    return _life(scene, reason, L, hours, L_healthy, P / C) + rating


def _life(scene: Scene, reason: str, L: float, hours: float, L_healthy: float, share: float) -> str:
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
            f"{100.0 * HEAVIEST_SHARE:.0f} % the standard does not vouch for its formula."
        )
    words = f"{words} {scene.tilt_words()}".rstrip()
    if scene.defects:
        words += f" That is {percent(L / L_healthy)} of the healthy bearing's life. {LEFT_OUT}"
    return words
