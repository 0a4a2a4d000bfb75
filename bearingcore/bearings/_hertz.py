"""Hertzian contact of a ball with a groove: stiffness, contact ellipse and pressure.

Quantity                                    | Symbol | Name                     | Unit
------------------------------------------- | ------ | ------------------------ | ---------
D_b cos α0 / D_p                            | γ      |                          |
radius of the groove                        | r      | groove_radius            | m
curvature sum                               | Σρ     | curvature_sum            | 1/m
curvature difference                        | F(ρ)   |                          |
semi-axes, across and along the rolling     | a, b   | semi_axes                | m
ellipse ratio a/b                           | χ      | ellipse_ratio            |
complete elliptic integrals at 1 − 1/χ²     | K, E   | first_, second_integral  |
load-deflection factor of one contact       | K_race | load_deflection_factor   | N/m^1.5
greatest pressure, in the middle            | p      | greatest_pressure        | Pa
Young's modulus, Poisson's ratio            | E, ν   | youngs_modulus, poisson  | Pa, 1
2/((1 − ν²)/E of the ring + that of the ball) | E*   | modulus                  | Pa

E* is E/(1 − ν²) where ball and ring are of one material. The contact is small against the ball,
smooth and dry.

Source: Harris, Rolling Bearing Analysis, chapters "Bearing macrogeometry" (curvatures) and
"Contact stress and deformation" (ellipse, pressure); ISO/TS 16281 for the stiffness of both
contacts. Harris's rounded constants are not used: all follows from the elliptic integrals.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, _checks as checks

GREATEST_LOG_RATIO = 40.0
"""Greatest ln χ of the search. Even a groove that is wider than the ball by only 10^-15 of its
diameter stays far below it."""


@dataclass(frozen=True)
class RaceContact:
    """Contact of a ball with one race. See the table at the head of the module.

    Attributes
    ----------
    race
        "outer" or "inner".
    curvature_sum [1/m], ellipse_ratio
        Σρ and χ, which is at least 1.
    first_integral, second_integral
        complete elliptic integrals K and E of the ellipse.
    youngs_modulus [Pa], poisson
        of the ring.
    ball_youngs_modulus [Pa], ball_poisson
        of the ball; None: those of the ring.
    """

    race: str
    curvature_sum: float
    ellipse_ratio: float
    first_integral: float
    second_integral: float
    youngs_modulus: float
    poisson: float
    ball_youngs_modulus: float | None = None
    ball_poisson: float | None = None

    @property
    def modulus(self) -> float:
        """E* [Pa], the harmonic mean of E/(1 − ν²) of ring and ball (Hertz)."""
        E, nu = self.youngs_modulus, self.poisson
        E_b = E if self.ball_youngs_modulus is None else self.ball_youngs_modulus
        nu_b = nu if self.ball_poisson is None else self.ball_poisson
        return 2.0 / ((1.0 - nu**2) / E + (1.0 - nu_b**2) / E_b)

    @property
    def load_deflection_factor(self) -> float:
        """K_race [N/m^1.5]: load over approach^1.5 of ball and race (Harris; ISO/TS 16281)."""
        return (
            math.pi
            / math.sqrt(4.5)
            * self.ellipse_ratio
            * self.modulus
            * math.sqrt(self.second_integral / (self.curvature_sum * self.first_integral**3))
        )

    def semi_axes(self, load: ArrayLike) -> tuple[Array, Array]:
        """Semi-axes a (across the rolling) and b (along it) [m] of the ellipse at a load [N].

        a = (2 χ² E / π)^⅓ c and b = a/χ with c = (3 Q / (E* Σρ))^⅓ (Harris).
        """
        c = np.cbrt(3.0 * np.asarray(load, dtype=float) / (self.modulus * self.curvature_sum))
        a = np.cbrt(2.0 * self.ellipse_ratio**2 * self.second_integral / math.pi) * c
        return a, a / self.ellipse_ratio

    def greatest_pressure(self, load: ArrayLike) -> Array:
        """Pressure [Pa] in the middle of the ellipse at a load [N]: p = 3 Q / (2 π a b) (Harris).

        0 at no load.
        """
        Q = np.asarray(load, dtype=float)
        # a b grows as Q^⅔, so p grows as Q^⅓: scaled from 1 N, as a zero load has no ellipse
        a, b = self.semi_axes(1.0)
        return 1.5 / (math.pi * a * b) * np.cbrt(Q)


@lru_cache(maxsize=512)
def race_contact(
    race: str,
    ball_diameter: float,
    pitch_diameter: float,
    groove_radius: float,
    contact_angle: float,
    youngs_modulus: float,
    poisson: float,
    ball_youngs_modulus: float | None = None,
    ball_poisson: float | None = None,
) -> RaceContact:
    """Compute the contact of a ball with a race from the dimensions on a drawing.

    Parameters
    ----------
    race
        "outer" or "inner".
    ball_diameter, pitch_diameter, groove_radius
        D_b, D_p, r [m].
    contact_angle
        α0 [rad]; it tilts the race's curvature around the shaft.
    youngs_modulus, poisson, ball_youngs_modulus, ball_poisson
        E [Pa] and ν of the ring and of the ball; None for the ball: those of the ring.

    Raises
    ------
    ValueError
        for a groove that does not pass freely around the ball, or one wider than its race.
    """
    checks.choice("race", race, ("outer", "inner"))
    name = f"{race}_groove_radius"
    if not groove_radius > 0.5 * ball_diameter:
        raise checks.refuse(
            name, groove_radius, "above the ball radius of {radius:m}", radius=0.5 * ball_diameter
        )
    gamma = ball_diameter * math.cos(contact_angle) / pitch_diameter
    side = 1.0 if race == "inner" else -1.0
    # Σρ = two of the ball, the race around the shaft (inner convex, outer concave), the groove
    race_curvature = side * 2.0 * gamma / ((1.0 - side * gamma) * ball_diameter)
    groove_curvature = 1.0 / groove_radius
    total = 4.0 / ball_diameter + race_curvature - groove_curvature
    if not groove_curvature + race_curvature > 0.0:
        raise checks.refuse(
            name,
            groove_radius,
            "below {most:m}, the radius of the race itself",
            most=-1.0 / race_curvature,
        )
    from scipy.special import ellipe, ellipkm1  # imported late, as scipy.special is slow to import

    # 1 − F = (4/D_b − 2/r)/Σρ, in a form without the cancellation of a tight groove
    rest = 2.0 * (2.0 * groove_radius - ball_diameter) / (ball_diameter * groove_radius * total)
    chi = _ellipse_ratio(rest)
    m1 = 1.0 / chi**2
    return RaceContact(
        race=race,
        curvature_sum=total,
        ellipse_ratio=chi,
        first_integral=float(ellipkm1(m1)),
        second_integral=float(ellipe(1.0 - m1)),
        youngs_modulus=youngs_modulus,
        poisson=poisson,
        ball_youngs_modulus=ball_youngs_modulus,
        ball_poisson=ball_poisson,
    )


def spherical_contact(
    ball_diameter: float, sphere_radius: float, youngs_modulus: float, poisson: float
) -> RaceContact:
    """Return the contact of a ball with a spherical outer race of radius R_e [m]: χ = 1."""
    return RaceContact(
        race="outer",
        curvature_sum=4.0 / ball_diameter - 2.0 / sphere_radius,
        ellipse_ratio=1.0,
        first_integral=0.5 * math.pi,
        second_integral=0.5 * math.pi,
        youngs_modulus=youngs_modulus,
        poisson=poisson,
    )


def _ellipse_ratio(rest: float) -> float:
    """Solve 2/(χ²−1)·(K/E − 1) = rest for χ, with rest = 1 − F(ρ).

    With m = 1 − 1/χ² and K − E = (m/3) R_D(0, 1/χ², 1) (Carlson's integral) the left side is
    2 R_D/(3 χ² E), which is exact at χ = 1 and falls steadily from 1 to 0.
    """
    from scipy.optimize import brentq  # imported late: slow to import, and seldom needed
    from scipy.special import ellipe, elliprd

    def log_mismatch(log_chi: float) -> float:
        m1 = math.exp(-2.0 * log_chi)
        left = 2.0 * m1 * float(elliprd(0.0, m1, 1.0)) / (3.0 * float(ellipe(1.0 - m1)))
        return math.log(left / rest)

    return math.exp(brentq(log_mismatch, 0.0, GREATEST_LOG_RATIO, xtol=1e-15, rtol=1e-15))


def series_factor(inner: float, outer: float) -> float:
    """Return the load-deflection factor K [N/m^1.5] of both contacts of a ball in series.

    Approaches add at equal load: K = (K_i^(−2/3) + K_e^(−2/3))^(−3/2) (Harris).
    """
    return float((inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5)
