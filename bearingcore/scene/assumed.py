"""What presets share where nothing is printed: the fan rig's rotor and support, usual grooves."""

from __future__ import annotations

import math

from bearingcore.scene.defect import Defect
from bearingcore.scene.support import Support

# Table 1 of the paper gives masses and the radial support; the rest, which its motion in x and y
# never uses, is assumed: the same spring and damper along z, and rings that tilt with the inertia
# of a disc of the mass at a radius of 50 mm, on springs a radius of 50 mm apart.
_GYRATION = 0.05**2 / 2.0
FAN_RIG_SUPPORT = Support(
    inner_mass=2.0,
    outer_mass=2.0,
    stiffness_x=212.2e6,
    stiffness_y=212.2e6,
    damping_x=1648.2,
    damping_y=1648.2,
    stiffness_z=212.2e6,
    damping_z=1648.2,
    stiffness_rx=212.2e6 * _GYRATION,
    stiffness_ry=212.2e6 * _GYRATION,
    damping_rx=1648.2 * _GYRATION,
    damping_ry=1648.2 * _GYRATION,
    inner_inertia=2.0 * _GYRATION,
    outer_inertia=2.0 * _GYRATION,
)


def rpm(turns_a_minute: float) -> float:
    """Shaft speed [rad/s]."""
    return 2.0 * math.pi * turns_a_minute / 60.0


def conforming(ball_diameter: float) -> dict[str, float]:
    """Groove radii of 0.52 and 0.53 ball diameters, the widest that ISO 281 rates in full."""
    return {
        "ball_diameter": ball_diameter,
        "inner_groove_radius": 0.52 * ball_diameter,
        "outer_groove_radius": 0.53 * ball_diameter,
    }


def below(extent_deg: float, depth: float) -> Defect:
    """A defect in the middle of the load zone, with the edges that geometry asks for."""
    return Defect(math.radians(extent_deg), depth, math.radians(270.0), edge="exact")


ASSUMED = (
    "groove radii of 0.52 (inner) and 0.53 (outer) ball diameters, steel with 210 GPa and 0.3, "
    "speed unless said otherwise, and the rotor and support of the fan rig, with which no rig of "
    "this bearing has been measured."
)
"""How notes end."""
