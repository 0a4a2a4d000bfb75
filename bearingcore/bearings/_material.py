"""Materials of balls: Young's modulus [Pa], Poisson's ratio and density [kg/m³].

Source of silicon nitride: SKF general catalogue, properties of bearing steel and bearing grade
silicon nitride (310 GPa, 3200 kg/m³); ν is the usual 0.26.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

STEEL_DENSITY = 7800.0
"""Density [kg/m³] of balls of bearing steel."""


class BallMaterial(NamedTuple):
    """E [Pa], ν and density [kg/m³] of balls; None for E and ν: those of the rings."""

    youngs_modulus: float | None
    poisson: float | None
    density: float


BALL_MATERIALS: Mapping[str, BallMaterial] = {
    "steel": BallMaterial(None, None, STEEL_DENSITY),
    "silicon nitride": BallMaterial(310e9, 0.26, 3200.0),
}
"""Materials by name; balls of steel are as stiff as the rings."""
