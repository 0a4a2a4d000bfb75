"""Line contact of a cylindrical roller with a race: stiffness by Palmgren, pressure by Hertz.

Quantity                                    | Symbol | Name                   | Unit
------------------------------------------- | ------ | ---------------------- | ----------
length and diameter of the roller           | l, D   | roller_length, roller_diameter | m
D / D_p                                     | γ      |                        |
curvature sum                               | Σρ     | curvature_sum          | 1/m
half length, half width of the contact      | l/2, b | semi_axes              | m
greatest pressure, in the middle            | p      | greatest_pressure      | Pa
load-deflection factor of both contacts     | K      | palmgren_factor        | N/m^(10/9)

Pressure is even along the roller: the ends, where it rises unless roller or race is crowned, and a
roller that is skewed are left out.

Source: Palmgren, Grundlagen der Wälzlagertechnik; Hertz for a cylinder on a cylinder (Harris,
Rolling Bearing Analysis, chapter "Contact stress and deformation").
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks

STEEL_MODULUS, STEEL_POISSON = 210e9, 0.3
"""E [Pa] and ν of rollers and rings: Palmgren's formula is for steel."""


@dataclass(frozen=True)
class RollerContact:
    """Contact of a roller with one race. See the table at the head of the module.

    Attributes
    ----------
    race
        "outer" or "inner".
    curvature_sum [1/m], length [m]
        Σρ and l.
    youngs_modulus [Pa], poisson
        of roller and ring.
    """

    race: str
    curvature_sum: float
    length: float
    youngs_modulus: float = STEEL_MODULUS
    poisson: float = STEEL_POISSON

    ellipse_ratio = math.inf
    """A line is an ellipse without end."""

    @property
    def load_deflection_factor(self) -> float:
        """K [N/m^(10/9)] of this contact alone: both are alike, and in series Palmgren's."""
        return 2.0 ** (10.0 / 9.0) * palmgren_factor(self.length)

    @property
    def modulus(self) -> float:
        """E/(1 − ν²) [Pa]."""
        return self.youngs_modulus / (1.0 - self.poisson**2)

    def greatest_pressure(self, load: ArrayLike) -> NDArray[np.float64]:
        """Pressure [Pa] in the middle at a load [N]: p = (Q E Σρ/(2 π l (1 − ν²)))^½."""
        Q = np.asarray(load, dtype=float)
        return np.sqrt(Q * self.modulus * self.curvature_sum / (2.0 * math.pi * self.length))

    def semi_axes(self, load: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Half the length and half the width b = 2 Q/(π l p) [m] of the contact at a load [N]."""
        Q = np.asarray(load, dtype=float)
        # b grows as Q^½: from the contact at 1 N, which exists at no load too
        b = 2.0 / (math.pi * self.length * self.greatest_pressure(1.0)) * np.sqrt(Q)
        return np.where(Q > 0.0, 0.5 * self.length, 0.0), b


def roller_contact(
    race: str, roller_diameter: float, pitch_diameter: float, roller_length: float
) -> RollerContact:
    """The contact of a steel roller with a race; lengths in m.

    Σρ = 2/(D (1 − γ)) inside, 2/(D (1 + γ)) outside, γ = D/D_p.
    """
    checks.choice("race", race, ("outer", "inner"))
    gamma = roller_diameter / pitch_diameter
    side = -1.0 if race == "inner" else 1.0
    return RollerContact(race, 2.0 / (roller_diameter * (1.0 + side * gamma)), roller_length)


def palmgren_factor(roller_length: float) -> float:
    """K [N/m^(10/9)] of both contacts of a steel roller of a length [m], one after the other.

    K = 8.06e4 l^(8/9) N/mm^(10/9), l in mm.
    """
    return float(8.06e4 * (1e3 * roller_length) ** (8.0 / 9.0) * 1e3 ** (10.0 / 9.0))
