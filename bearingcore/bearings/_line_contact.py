"""Line contact of a cylindrical roller with a race: stiffness by ISO 16281, pressure by Hertz.

Quantity                                    | Symbol | Name                   | Unit
------------------------------------------- | ------ | ---------------------- | ----------
length and diameter of the roller           | l, D   | roller_length, roller_diameter | m
D / D_p                                     | γ      |                        |
curvature sum                               | Σρ     | curvature_sum          | 1/m
half length, half width of the contact      | l/2, b | semi_axes              | m
greatest pressure, in the middle            | p      | greatest_pressure      | Pa
load-deflection factor of both contacts     | K, c_L | series_factor          | N/m^(10/9)

The pressure is even along the roller. Its rise at the ends of a roller and race without a crown,
and skewed rollers, are left out.

Source: ISO 16281, after Palmgren; Hertz for a cylinder on a cylinder (Harris, Rolling Bearing
Analysis, chapter "Contact stress and deformation").
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, _checks as checks

STEEL_MODULUS, STEEL_POISSON = 210e9, 0.3
"""E [Pa] and ν of rollers and rings: the factor is for steel."""

SERIES_CONSTANT = 35_948.0
"""Constant c_L/l^(8/9) [N/mm^2] of ISO 16281, for a steel roller between BOTH its races. Palmgren's
3.84e-5 mm for 1 N on 1 mm, or 8.06e4, is for ONE contact: two in series make 3.73e4."""

ONE_CONTACT = 8.06e4
"""Palmgren's constant of one contact. Old saved scenes of rollers used it for both."""

LONG_ROLLER = 2.5
"""Length over diameter above which the profile of a roller has a straight part (ISO 16281)."""


@dataclass(frozen=True)
class RollerContact:
    """Contact of a roller with one race. See the table at the head of the module.

    Attributes
    ----------
    race
        "outer" or "inner".
    curvature_sum [1/m], length [m]
        Σρ and l.
    """

    race: str
    curvature_sum: float
    length: float

    ellipse_ratio = math.inf
    """Infinite, as a line is an ellipse without end."""

    @property
    def load_deflection_factor(self) -> float:
        """K [N/m^(10/9)] of this contact alone: each race takes half of the compression."""
        return 2.0 ** (10.0 / 9.0) * series_factor(self.length)

    @property
    def modulus(self) -> float:
        """E/(1 − ν²) [Pa] of roller and ring."""
        return STEEL_MODULUS / (1.0 - STEEL_POISSON**2)

    def greatest_pressure(self, load: ArrayLike) -> Array:
        """Pressure [Pa] in the middle at a load [N]: p = (Q E Σρ/(2 π l (1 − ν²)))^½."""
        Q = np.asarray(load, dtype=float)
        return np.sqrt(Q * self.modulus * self.curvature_sum / (2.0 * math.pi * self.length))

    def semi_axes(self, load: ArrayLike) -> tuple[Array, Array]:
        """Half the length and half the width b = 2 Q/(π l p) [m] of the contact at a load [N]."""
        Q = np.asarray(load, dtype=float)
        # b grows as Q^½: scaled from 1 N, as a zero load has no contact
        b = 2.0 / (math.pi * self.length * self.greatest_pressure(1.0)) * np.sqrt(Q)
        return np.where(Q > 0.0, 0.5 * self.length, 0.0), b


def roller_contact(
    race: str, roller_diameter: float, pitch_diameter: float, roller_length: float
) -> RollerContact:
    """Return the contact of a steel roller with a race; lengths in m.

    Σρ = 2/(D (1 − γ)) inside, 2/(D (1 + γ)) outside, γ = D/D_p.
    """
    checks.choice("race", race, ("outer", "inner"))
    gamma = roller_diameter / pitch_diameter
    side = -1.0 if race == "inner" else 1.0
    return RollerContact(race, 2.0 / (roller_diameter * (1.0 + side * gamma)), roller_length)


def profile_drop(place: ArrayLike, diameter: float, length: float) -> Array:
    """Return the drop P [m] of a cylindrical roller's profile at places x [m] from its middle.

    P = 0.00035 D ln(1/(1 − (2x/l)²)). A roller longer than 2.5 D is straight except for 1.25 D at
    each end, with 0.0005 D in the equation (ISO 16281, Eqs. 42, 43).
    """
    rounded = min(length, LONG_ROLLER * diameter)
    part = np.maximum(2.0 * np.abs(np.asarray(place)) - (length - rounded), 0.0) / rounded
    size = 0.00035 if length <= LONG_ROLLER * diameter else 0.0005
    return np.asarray(-size * diameter * np.log1p(-(part**2)))


def tapered_profile_drop(place: ArrayLike, diameter: float, length: float) -> Array:
    """Return the drop P [m] of a tapered roller, 0.00045 D ln(1/(1 − (2x/l)²)) (Eq. 44)."""
    return np.asarray(-0.00045 * diameter * np.log1p(-((2.0 * np.asarray(place) / length) ** 2)))


def series_factor(roller_length: float) -> float:
    """Return K [N/m^(10/9)] of both contacts of a steel roller of a length [m] in series.

    K = 35 948 l^(8/9) N/mm^(10/9), l in mm (c_L of ISO 16281).
    """
    return float(SERIES_CONSTANT * (1e3 * roller_length) ** (8.0 / 9.0) * 1e3 ** (10.0 / 9.0))


def mend_factor(factor: object, roller_length: object) -> object:
    """Return K [N/m^(10/9)] of a file, corrected if ONE_CONTACT was used for both contacts.

    Any other value is returned as it is.
    """
    if not isinstance(factor, float) or not isinstance(roller_length, float):
        return factor
    if not 0.0 < roller_length < math.inf:
        return factor
    right = series_factor(roller_length)
    wrong = right * ONE_CONTACT / SERIES_CONSTANT
    return right if math.isclose(factor, wrong, rel_tol=1e-9) else factor
