"""Scenes to start from, and where their numbers come from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from bearingcore.bearing import Bearing
from bearingcore.defect import Defect
from bearingcore.scene import Load, Scene, Support

# Table 1 of the paper gives masses and the radial support; the rest, which its motion in x and y
# never uses, is assumed: the same spring and damper along z, and rings that tilt with the inertia
# of a disc of the mass at a radius of 50 mm, on springs a radius of 50 mm apart.
_GYRATION = 0.05**2 / 2.0
_FAN_RIG_SUPPORT = Support(
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

presets: Mapping[str, Scene] = MappingProxyType(
    {
        "liew-lim": Scene(
            bearing=Bearing(
                n_balls=12,
                ball_diameter=6e-3,
                pitch_diameter=39.3e-3,
                contact_angle=math.radians(30.0),
                groove_center_radius=19.65e-3,
                groove_center_distance=50e-6,
                radial_clearance=0.05e-6,
                load_deflection_factor=1.45e10,
                outer_raceway_radius=22.65e-3,
                inner_raceway_radius=16.65e-3,
            ),
            defect=Defect(extent=math.radians(40.0), depth=50e-6, center=math.radians(270.0)),
            load=Load(fy=-2000.0, fz=500.0),
            shaft_speed=2.0 * math.pi * 7.0,
            support=_FAN_RIG_SUPPORT,
        ),
        "fan-rig": Scene(
            bearing=Bearing(
                n_balls=14,
                ball_diameter=8e-3,
                pitch_diameter=45e-3,
                contact_angle=0.0,
                groove_center_radius=22.5e-3,
                groove_center_distance=50e-6,
                radial_clearance=3e-6,
                load_deflection_factor=5453e6,
                outer_raceway_radius=26.5e-3,
                inner_raceway_radius=18.5e-3,
            ),
            defect=Defect(extent=math.radians(12.9), depth=50e-6, center=math.radians(270.0)),
            load=Load(fy=-100.0),
            shaft_speed=2.0 * math.pi * 7.0,
            support=_FAN_RIG_SUPPORT,
        ),
    }
)
"""Scenes by name."""

preset_notes: Mapping[str, str] = MappingProxyType(
    {
        "liew-lim": (
            "The angular-contact bearing of Liew and Lim that Section 3 of Petersen, Howard and "
            "Prime (2014) studies. Printed: balls, groove radius, groove distance, contact angle, "
            "clearance, load-deflection factor, loads. Assumed: pitch diameter (twice the groove "
            "centre radius), raceway radii (that radius plus and minus a ball radius), speed; it "
            "has no published rotor, so that of the fan rig is used."
        ),
        "fan-rig": (
            "The fan rig's deep-groove bearing of Section 4 and Table 1 of Petersen, Howard and "
            "Prime (2014). Printed: balls, radii, clearance, load-deflection factor, masses, "
            "radial support, load, speed. Assumed: groove centre distance 50 µm (without effect "
            "on radial answers), raceway radii (pitch radius plus and minus a ball radius), and "
            "support along z and against tilt."
        ),
    }
)
"""Where each preset's numbers come from, and which of them are assumed."""
