"""Load ratings of bearings from their dimensions, by ISO 76 and ISO 281.

Quantity                                | Symbol | Unit
--------------------------------------- | ------ | ------------
dynamic load rating                     | C_r    | N
static load rating                      | C_0r   | N
rows, balls or rollers of a row         | i, Z   |
ball or roller diameter                 | D      | mm
roller length that touches              | l      | mm
contact angle                           | α      | rad
D cos α / D_p                           | γ      |
factors of both ratings                 | f_c, f_0 |

    C_r = b_m f_c (i cos α)^0.7 Z^(2/3) D^1.8,    C_0r = f_0 i Z D² cos α,

with 3.647 D^1.4 in place of D^1.8 above 25.4 mm, and for rollers

    C_r = b_m f_c (i l cos α)^(7/9) Z^(3/4) D^(29/27),    C_0r = 44 (1 − γ) i Z l D cos α.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.bearings._drawing import USUAL_GROOVES
from bearingcore.bearings._hertz import race_contact, spherical_contact
from bearingcore.bearings._kind import ISO_76_BALLS, ISO_76_SELF_ALIGNING
from bearingcore.common import Array

MATERIAL_FACTOR = 1.3
"""b_m of ISO 281 for deep-groove, angular-contact and self-aligning ball bearings of today."""

ROLLER_MATERIAL_FACTOR = 1.1
"""b_m of cylindrical roller bearings whose rings are machined, and of tapered rollers."""

LARGE_BALL = 25.4
"""Ball diameter [mm] above which ISO 281 lets the rating grow less with the ball."""

_SELF_ALIGNING_GAMMA = (
    *(0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.12, 0.14, 0.16, 0.18, 0.20),
    *(0.22, 0.24, 0.26, 0.28, 0.30, 0.32, 0.34, 0.36, 0.38, 0.40),
)
_SELF_ALIGNING_FACTOR = (
    *(17.3, 18.6, 19.9, 21.1, 22.3, 23.4, 25.6, 27.7, 29.7, 31.7, 33.5),
    *(35.2, 36.8, 38.2, 39.4, 40.3, 40.9, 41.2, 41.3, 41.0, 40.4),
)
"""f_c of ISO 281 for self-aligning ball bearings."""


def groove_ratio(f_i: float, f_e: float) -> float:
    """Return the effect of the grooves on Q_ci/Q_ce; f are groove radii over ball diameters."""
    return f_i / f_e * (2.0 * f_e - 1.0) / (2.0 * f_i - 1.0)


def capacity_factor(gamma: ArrayLike, f_i: float, f_e: float) -> Array:
    """Return f_c of Lundberg and Palmgren, with the constant 38.2 of the table in ISO 281."""
    g = np.asarray(gamma, dtype=float)
    B = 1.04 * ((1.0 - g) / (1.0 + g)) ** 1.72 * groove_ratio(f_i, f_e) ** 0.41
    shape = g**0.3 * (1.0 - g) ** 1.39 / (1.0 + g) ** (1.0 / 3.0)
    groove = (2.0 * f_i / (2.0 * f_i - 1.0)) ** 0.41
    return 38.2 * shape * groove * (1.0 + B ** (10.0 / 3.0)) ** -0.3


def self_aligning_capacity_factor(gamma: ArrayLike) -> Array:
    """Return f_c of ISO 281 for self-aligning ball bearings, interpolated in its table."""
    return np.interp(np.asarray(gamma, dtype=float), _SELF_ALIGNING_GAMMA, _SELF_ALIGNING_FACTOR)


def dynamic_rating(
    factor: ArrayLike, n_balls: ArrayLike, ball_diameter: ArrayLike, cosine: float, rows: int = 1
) -> Array:
    """Return C_r [N] of `rows` rows of balls [m] with the factor f_c and the cosine of α."""
    D = 1e3 * np.asarray(ball_diameter, dtype=float)
    size = np.where(D <= LARGE_BALL, D**1.8, 3.647 * D**1.4)
    number = np.asarray(n_balls, dtype=float) ** (2.0 / 3.0)
    return MATERIAL_FACTOR * np.asarray(factor) * (rows * cosine) ** 0.7 * number * size


def roller_dynamic_rating(
    n_rollers: ArrayLike,
    roller_diameter: ArrayLike,
    roller_length: ArrayLike,
    pitch_diameter: float,
    cosine: float = 1.0,
    rows: int = 1,
) -> Array:
    """Return C_r [N] of `rows` rows of rollers; lengths in m, with the cosine of α.

    f_c has the constants of the explanatory notes on ISO 281 (ISO/TR 1281-1), whose λν = 0.83
    allows for the uneven load along a real roller.
    """
    D, length = np.asarray(roller_diameter, dtype=float), np.asarray(roller_length, dtype=float)
    gamma = D * cosine / pitch_diameter
    B = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    factor = 0.377 * 551.13373 * 0.83 * shape * (1.0 + B**4.5) ** (-2.0 / 9.0)
    size = (rows * 1e3 * length * cosine) ** (7.0 / 9.0) * (1e3 * D) ** (29.0 / 27.0)
    number = np.asarray(n_rollers, dtype=float) ** 0.75
    return np.asarray(ROLLER_MATERIAL_FACTOR * factor * size * number)


def roller_static_rating_per_length(
    n_rollers: ArrayLike, roller_diameter: ArrayLike, pitch_diameter: float, cosine: float = 1.0
) -> Array:
    """Return C_0r [N] of a row of rollers [m] over the length [m] of a roller that touches."""
    D = np.asarray(roller_diameter, dtype=float)
    gamma = D * cosine / pitch_diameter
    return np.asarray(44e6 * (1.0 - gamma) * np.asarray(n_rollers, dtype=float) * D * cosine)


def static_rating(
    factor: ArrayLike, n_balls: ArrayLike, ball_diameter: ArrayLike, cosine: float, rows: int = 1
) -> Array:
    """Return C_0r [N] of `rows` rows of balls [m] with the factor f_0 and the cosine of α."""
    D = 1e3 * np.asarray(ball_diameter, dtype=float)
    return np.asarray(factor) * rows * np.asarray(n_balls, dtype=float) * D**2 * cosine


def static_factor(gamma: ArrayLike, self_aligning: bool = False) -> Array:
    """Return f_0 of ISO 76 for ball bearings, interpolated between hundredths of γ.

    It follows from the Hertzian load of a ball at the allowed pressure, on the race that carries
    less, and agrees with the standard's table to its last digit.
    """
    factors = _static_factors(self_aligning)
    g = np.asarray(gamma, dtype=float)
    return np.interp(g, 0.01 * np.arange(1, len(factors) + 1), factors)


@cache
def _static_factors(self_aligning: bool) -> tuple[float, ...]:
    """Compute f_0 at γ = 0.01, 0.02, ... 0.40; a fifth of the balls carries the load (ISO 76)."""
    D, modulus, poisson = 0.01, 207e9, 0.3
    allowed = ISO_76_SELF_ALIGNING if self_aligning else ISO_76_BALLS
    groove = (USUAL_GROOVES["outer"] if self_aligning else USUAL_GROOVES["inner"]) * D

    def factor(gamma: float) -> float:
        pitch = D / gamma
        outer = (
            spherical_contact(D, 0.5 * (pitch + D), modulus, poisson)
            if self_aligning
            else race_contact("outer", D, pitch, USUAL_GROOVES["outer"] * D, 0.0, modulus, poisson)
        )
        inner = race_contact("inner", D, pitch, groove, 0.0, modulus, poisson)
        greatest = max(float(contact.greatest_pressure(1.0)) for contact in (inner, outer))
        return (allowed / greatest) ** 3 / 5.0 / (1e3 * D) ** 2

    return tuple(factor(0.01 * k) for k in range(1, 41))
