"""A bearing from the frequencies of its parts, as a maker's sheet or a file lists them.

With the outer ring at rest and γ = (D_b/D_p) cos α, in turns of the shaft (orders):

    BPFO = N_b (1 − γ)/2,  BPFI = N_b (1 + γ)/2,  FTF = (1 − γ)/2,  BSF = (1 − γ²) D_p/(2 D_b)

so that BPFO + BPFI is the number of balls. Sizes do not follow, only their ratio.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from bearingcore.bearings._bearing import Bearing
from bearingcore.bearings._drawing import USUAL_GROOVES
from bearingcore.common import _checks as checks, number

FREQUENCIES = ("bpfo", "bpfi", "ftf", "bsf")
"""Outer race, inner race, cage, and one turn of a ball."""

WHOLE = 0.02
"""Greatest relative difference between BPFO + BPFI as printed and a whole number of balls."""

_LARGEST_ANGLE = math.radians(50.0)


def bearing_of_frequencies(orders: Mapping[str, float], pitch_diameter: float) -> Bearing:
    """Return the ball bearing whose parts have these frequencies.

    Parameters
    ----------
    orders
        frequencies in turns of the shaft, by the names of FREQUENCIES. BPFO and BPFI are needed, or
        one of them with FTF. If both are there, FTF is ignored, because it is often that of a
        turning outer ring. Without a BSF that fits, the contact angle is 0.
    pitch_diameter
        [m] of the bearing, marked as estimated; no frequency depends on it.

    Raises
    ------
    ValueError
        where the frequencies are too few or cannot be those of one bearing.
    """
    known = {
        name: checks.real_number(name.upper(), value, above=0.0, unit="turns of the shaft")
        for name, value in orders.items()
        if name in FREQUENCIES
    }
    balls, gamma = _balls_and_ratio(known)
    ratio, angle = _shape(gamma, known.get("bsf"))
    ball = ratio * pitch_diameter
    bearing = Bearing.from_drawing(
        balls,
        ball,
        pitch_diameter,
        USUAL_GROOVES["inner"] * ball,
        USUAL_GROOVES["outer"] * ball,
        contact_angle=angle,
        diametral_clearance=0.0,
    )
    return bearing.replace(estimated=("ball_diameter", "pitch_diameter"))


def _balls_and_ratio(known: Mapping[str, float]) -> tuple[int, float]:
    """Return N_b and γ."""
    outer, inner, cage = (known.get(name) for name in ("bpfo", "bpfi", "ftf"))
    if outer is None and inner is not None and cage is not None and cage < 0.5:
        outer = inner * cage / (1.0 - cage)
    elif inner is None and outer is not None and cage is not None and cage < 0.5:
        inner = outer * (1.0 - cage) / cage
    if outer is None or inner is None:
        raise checks.refuse(
            "frequencies", ", ".join(name.upper() for name in known) or "none",
            "BPFO and BPFI, or one of them with FTF (below half the shaft's)",
        )  # fmt: skip
    if inner <= outer:
        raise checks.refuse("BPFI", f"{number(inner, 4)} times the shaft's", "more than BPFO")
    total = outer + inner
    balls = round(total)
    if balls < 3 or abs(total - balls) > WHOLE * balls:
        raise checks.refuse(
            "BPFO + BPFI", f"{number(total, 4)} times the shaft's",
            "nearly a whole number: that of the balls",
        )  # fmt: skip
    return balls, (inner - outer) / total


def _shape(gamma: float, spin: float | None) -> tuple[float, float]:
    """Return D_b/D_p and the contact angle [rad]; some sheets list twice the BSF."""
    for turns in () if spin is None else (spin, 0.5 * spin):
        ratio = (1.0 - gamma**2) / (2.0 * turns)
        if gamma <= ratio * (1.0 + WHOLE) and gamma >= ratio * math.cos(_LARGEST_ANGLE):
            angle = math.acos(min(gamma / ratio, 1.0))
            return (ratio, angle) if angle > math.radians(3.0) else (gamma, 0.0)
    return gamma, 0.0
