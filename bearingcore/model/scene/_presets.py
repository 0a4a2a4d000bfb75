"""Scenes to start from, and the sources of their numbers.

Inside dimensions of bearings are rarely printed. The note of each preset says which of its numbers
are printed, computed or assumed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple

from bearingcore.bearings import USUAL_GROOVES, Bearing
from bearingcore.bearings._tapered import USUAL_ANGLE
from bearingcore.model.scene._defect import Defect
from bearingcore.model.scene._load import Load
from bearingcore.model.scene._scene import TILT_FREE, Scene
from bearingcore.model.scene._support import Support
from bearingcore.units import INCH

# Table 1 of the paper gives masses and the radial support. The other numbers are assumed; motion in
# x and y never uses them. The spring and damper along z are the same as the radial ones. For tilts
# the mass of each ring and the springs and dampers are on a circle with a radius of 50 mm.
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

WIDTH_7208 = 18e-3
"""Width [m] of a 7208 by ISO 15, which is the distance of the rows of a pair."""

ASSUMED = (
    "groove radii of 0.52 (inner) and 0.53 (outer) ball diameters, steel with 210 GPa and 0.3, "
    "speed unless stated otherwise, and the rotor and support of the fan rig: no measured rig has "
    "this bearing on this support."
)
"""End of every note."""


class Preset(NamedTuple):
    """Name of a scene, function that makes it, and the note on its numbers."""

    label: str
    make: Callable[[], Scene]
    note: str


def _scene(
    bearing: Bearing,
    load: Load,
    rpm: float,
    extent_deg: float,
    depth: float,
    *,
    edge: str = "exact",
    dofs: tuple[str, ...] | str | None = None,
) -> Scene:
    """Return a scene on the fan rig's support, with a defect in the middle of the load zone.

    The defect is in the first row if the bearing has several.
    """
    row = 0 if bearing.rows else None
    return Scene(
        bearing=bearing,
        defect=Defect(math.radians(extent_deg), depth, math.radians(270.0), edge=edge, row=row),
        load=load,
        shaft_speed=2.0 * math.pi * rpm / 60.0,
        support=FAN_RIG_SUPPORT,
        dofs=dofs,
    )


def _row(
    n_balls: int,
    ball_diameter: float,
    pitch_diameter: float,
    angle_deg: float | None = None,
    groove_center_radius: float | None = None,
) -> Bearing:
    """Return a row of balls in usual grooves; without an angle its diametral clearance is 10 µm.

    Usual grooves are the widest that ISO 281 rates in full.
    """
    return Bearing.from_drawing(
        n_balls,
        ball_diameter,
        pitch_diameter,
        USUAL_GROOVES["inner"] * ball_diameter,
        USUAL_GROOVES["outer"] * ball_diameter,
        contact_angle=None if angle_deg is None else math.radians(angle_deg),
        diametral_clearance=10e-6 if angle_deg is None else None,
        groove_center_radius=groove_center_radius,
    )


def _row_7208(angle_deg: float) -> Bearing:
    return _row(14, 15.0 / 32.0 * INCH, 60e-3, angle_deg)


def _7208(angle_deg: int, rating_kn: int, thrust_kn: float) -> Preset:
    return Preset(
        f"7208, angular contact, {angle_deg}°",
        lambda: _scene(
            _row_7208(angle_deg),
            Load(fy=-1500.0, fz=1e3 * thrust_kn),
            3000.0,
            *(8.0, 100e-6),
            dofs=("x", "y", "z"),
        ),
        f"An angular-contact bearing of 40 mm bore and 80 mm outside diameter, at {angle_deg}°. "
        "From catalogues: bore, outside diameter, contact angle. Assumed, as makers do not print "
        "it: 14 balls of 15/32 inch (11.906 mm) on the mean of bore and outside diameter (60 mm), "
        f"which by ISO 281 give a dynamic rating of about {rating_kn} kN, as catalogues do; no "
        "clearance on top of the contact angle; load 1.5 kN down and "
        f"{thrust_kn:.1f} kN along the shaft, an equivalent load of 5 to 6 % of that rating; a "
        "second bearing that keeps the shaft from tilting (this one alone lets it tilt by some "
        f"milliradians); the defect; {ASSUMED}",
    )


def _pair_7208(
    arrangement: str, label: str, meaning: str, held: str, preload: float, thrust: float
) -> Preset:
    return Preset(
        f"7208 pair, {label.removeprefix('in ')}",
        lambda: _scene(
            _row_7208(25.0).paired(WIDTH_7208, arrangement, preload),
            Load(fy=-3000.0, fz=thrust),
            3000.0,
            *(8.0, 100e-6),
            dofs=TILT_FREE if preload else ("x", "y", "z"),
        ),
        f"Two 7208 angular-contact bearings of 25° side by side on a shaft, {label}: {meaning}. By "
        "ISO 15: bore 40 mm, outside diameter 80 mm, width 18 mm each. Computed: rows 18 mm apart, "
        f"as wide as one bearing. Assumed here: the inside of the preset 7208-25deg in each "
        f"row, {held};"
        f" the loads; the defect, in the first row; {ASSUMED}",
    )


_PRELOADED = ("pushed together by an axial preload of 8 µm", 8e-6, 800.0)

_PRESETS: Mapping[str, Preset] = {
    "liew-lim": Preset(
        "Angular contact bearing (Liew–Lim)",
        lambda: _scene(
            Bearing(
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
            Load(fy=-2000.0, fz=500.0),
            420.0,
            *(40.0, 50e-6),
            edge="published",
            dofs=TILT_FREE,
        ),
        "The angular-contact bearing of Liew and Lim that Section 3 of Petersen, Howard and "
        "Prime (2014) studies. From the source: balls, groove radius, groove distance, contact "
        "angle, clearance, load-deflection factor, loads. Assumed here: pitch diameter (twice the "
        "groove centre radius), raceway radii (that radius plus and minus a ball radius), speed; "
        "it has no published rotor, so that of the fan rig is used.",
    ),
    "fan-rig": Preset(
        "Fan rig, deep groove bearing",
        lambda: _scene(
            Bearing(
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
            Load(fy=-100.0),
            420.0,
            *(12.9, 50e-6),
            edge="published",
        ),
        "The fan rig's deep-groove bearing of Section 4 and Table 1 of Petersen, Howard and "
        "Prime (2014). From the source: balls, radii, clearance, load-deflection factor, masses, "
        "radial support, load, speed. Assumed here: groove centre distance 50 µm (without effect "
        "on radial answers), raceway radii (pitch radius plus and minus a ball radius), and "
        "support along z and against tilt.",
    ),
    "6205": Preset(
        "6205, deep groove bearing",
        lambda: _scene(_row(9, 7.94e-3, 39.04e-3), Load(fy=-1000.0), 1797.0, *(1.3, 279e-6)),
        "The deep-groove bearing at the drive end of the Case Western Reserve University rig, "
        "the best-known public fault data (there 6205-2RS JEM SKF). Published with the data: 9 "
        "balls of 7.94 mm on 39.04 mm (0.3126 and 1.537 inch), which give its defect "
        "frequencies of 3.5848 and 5.4152 times the shaft's; 1797 rpm; a fault of 0.021 inch, "
        "here 1.3° long, and 0.011 inch deep. Assumed here: diametral clearance 10 µm, the middle "
        "of the normal class of ISO 5753; a load of 1 kN, 7 % of the dynamic rating of 14 kN; "
        f"{ASSUMED}",
    ),
    "6206": Preset(
        "6206, deep groove bearing",
        lambda: _scene(_row(9, 9.525e-3, 46e-3), Load(fy=-1500.0), 1470.0, *(6.0, 100e-6)),
        "A deep-groove bearing of 30 mm bore and 62 mm outside diameter. Commonly given for "
        "it, though catalogues do not print the inside: 9 balls of 3/8 inch (9.525 mm) on the "
        "mean of bore and outside diameter (46 mm), which by ISO 281 give the catalogue's "
        "dynamic rating of 19.5 kN. Assumed here: diametral clearance 10 µm, load 1.5 kN (8 % of "
        f"that rating), the defect, {ASSUMED}",
    ),
    "7208-15deg": _7208(15, 38, 1.0),
    "7208-25deg": _7208(25, 36, 1.5),
    "7208-40deg": _7208(40, 32, 2.5),
    "seven-ball": Preset(
        "Seven balls, commercial code",
        lambda: _scene(
            _row(7, 11.5e-3, 43.5e-3, groove_center_radius=0.5 * 43.5e-3),
            Load(fy=-1000.0),
            1500.0,
            *(10.0, 50e-6),
        ),
        "The bearing with which a commercial code's values for ISO/TS 16281 are published "
        "(GitHub, minzhun/ISO16281). Published: 7 balls of 11.5 mm on 43.5 mm, groove radii of "
        "0.52 and 0.53 ball diameters, 210 GPa and 0.3, diametral clearance 10 µm, load 1 kN; "
        "the lever of a tilt is half the pitch diameter there, and so it is here. Assumed here: "
        "the defect, the speed, and the rotor and support of the fan rig.",
    ),
    "6203": Preset(
        "6203, deep groove bearing",
        lambda: _scene(_row(8, 6.75e-3, 28.55e-3), Load(fy=-700.0), 1500.0, *(3.0, 100e-6)),
        "A deep-groove bearing of 17 mm bore and 40 mm outside diameter, as in the data of "
        "Paderborn University (Lessmeier and others, 2016). From the source: 8 balls of 6.75 mm "
        "on 28.55 mm, contact angle 0, 1500 rpm. Assumed here: diametral clearance 10 µm, load "
        f"0.7 kN, the defect, {ASSUMED}",
    ),
    "209": Preset(
        "209, deep groove bearing (Harris)",
        lambda: _scene(
            Bearing.from_drawing(9, 12.7e-3, 65e-3, 6.6e-3, 6.6e-3, diametral_clearance=15e-6),
            Load(fy=-2500.0),
            1800.0,
            *(6.0, 100e-6),
        ),
        "The 209 deep-groove bearing of the examples in Harris, Rolling Bearing Analysis. "
        "From the source: 9 balls of 12.7 mm, raceway diameters 52.291 and 77.706 mm, groove radii "
        "6.6 mm, 1800 rpm. Computed: pitch diameter 65 mm, diametral clearance 15 µm. "
        "Assumed here: load 2.5 kN, the defect, steel with 210 GPa and 0.3, and the rotor and "
        "support of the fan rig.",
    ),
    "7208-back-to-back": _pair_7208(
        "back-to-back",
        "back to back (O)",
        "their lines of contact meet the shaft far apart",
        *_PRELOADED,
    ),
    "7208-face-to-face": _pair_7208(
        "face-to-face",
        "face to face (X)",
        "their lines of contact meet the shaft close together",
        *_PRELOADED,
    ),
    "7208-tandem": _pair_7208(
        "tandem",
        "in tandem",
        "both carry the same axial load, one way only",
        "without clearance or preload, and a shaft kept from tilting",
        *(0.0, 3000.0),
    ),
    "3208": Preset(
        "3208, double row, angular contact",
        lambda: _scene(
            _row(14, 13.0 / 32.0 * INCH, 60e-3, 30.0).paired(14e-3, "back-to-back", 4e-6),
            Load(fy=-2500.0, fz=500.0),
            3000.0,
            *(8.0, 100e-6),
            dofs=TILT_FREE,
        ),
        "A double-row angular-contact bearing. By ISO 15: bore 40 mm, outside diameter 80 mm, "
        "width 30.2 mm. Computed: a dynamic rating of 44 kN by ISO 281. Assumed, as makers do "
        "not print it: rows back to back, 14 mm apart, at 30°, each of 14 balls of 13/32 inch "
        "(10.319 mm) on the mean of bore and outside diameter (60 mm), an axial preload of "
        f"4 µm, the loads, the defect, in the first row, {ASSUMED}",
    ),
    "1208": Preset(
        "1208, self-aligning",
        lambda: _scene(
            Bearing.self_aligning(
                n_balls=16,
                ball_diameter=11.0 / 32.0 * INCH,
                sphere_radius=34.4e-3,
                inner_groove_radius=0.53 * (11.0 / 32.0 * INCH),
                contact_angle=math.radians(10.0),
                radial_clearance=5e-6,
            ),
            Load(fy=-1000.0),
            1500.0,
            *(8.0, 100e-6),
        ),
        "A self-aligning ball bearing: two rows on one spherical outer race. By ISO 15: bore "
        "40 mm, outside diameter 80 mm, width 18 mm. Assumed, as makers do not print it: 16 "
        "balls of 11/32 inch (8.731 mm) a row at 10° on a sphere of 34.4 mm radius, inner "
        "grooves of 0.53 ball diameters, a radial clearance of 5 µm, load, speed and the "
        "defect, in the first row; steel with 210 GPa and 0.3, and the rotor and support of "
        "the fan rig. Computed: rows 10.5 mm apart on a pitch diameter of 59.2 mm. Its inner "
        "ring tilts freely, so it is assumed that another bearing keeps the shaft from tilting.",
    ),
    "nu208": Preset(
        "NU 208, cylindrical rollers",
        lambda: _scene(
            Bearing.cylindrical(
                n_rollers=14,
                roller_diameter=11e-3,
                roller_length=11e-3,
                pitch_diameter=60.5e-3,
                radial_clearance=15e-6,
            ),
            Load(fy=-3000.0),
            1500.0,
            *(8.0, 100e-6),
        ),
        "A cylindrical roller bearing. By ISO 15: bore 40 mm, outside diameter 80 mm, width "
        "18 mm. Assumed here: 14 rollers of 11 mm diameter and length on 60.5 mm, a radial "
        "clearance of 15 µm, load, speed, the defect, and the rotor and support of the fan "
        "rig. Computed: the stiffness of a steel roller between its races by "
        "ISO 16281. It carries radial loads only, and its rollers do not tilt here.",
    ),
    "30206-back-to-back": Preset(
        "30206 pair, tapered rollers, back to back",
        lambda: _scene(
            Bearing.tapered(
                n_rollers=17,
                roller_diameter=7.66e-3,
                roller_length=10.3e-3,
                pitch_diameter=46e-3,
                contact_angle=USUAL_ANGLE,
            ).paired(30e-3, "back-to-back", 6e-6),
            Load(fy=-4000.0, fz=1000.0),
            1500.0,
            *(4.0, 20e-6),
            dofs=TILT_FREE,
        ),
        "Two tapered roller bearings back to back. By ISO 355: bore 30 mm, outside diameter 62 mm, "
        "a cup of 14°02′10″. Assumed, as makers do not print it: 17 rollers on 46 mm, the middle "
        "of both diameters. Computed: rollers of 7.66 mm and 10.3 mm length, which by ISO "
        "281 and ISO 76 give the ratings of a catalogue (Nachi), 43.5 kN dynamic and 48 kN static; "
        "their stiffness by ISO 16281. Assumed here too: rows 30 mm apart, an axial preload of "
        "6 µm, loads, speed, the defect, in the first row, and the rotor and support of the fan "
        "rig. The taper of the rollers, their swivelling and the friction of the rib are left out.",
    ),
}


class UnknownPresetError(KeyError):
    """Error for a name that no preset has; its message lists the known names."""

    def __str__(self) -> str:
        """Return the message itself, which KeyError would put in quotes."""
        return str(self.args[0])


class _Scenes(Mapping[str, Scene]):
    """Scenes by name, each made when it is first used.

    Scenes from drawings need SciPy's elliptic integrals, whose import takes longer than that of the
    rest of this package.
    """

    def __init__(self) -> None:
        self._made: dict[str, Scene] = {}

    def __getitem__(self, name: str) -> Scene:
        if name not in _PRESETS:
            known = ", ".join(_PRESETS)
            raise UnknownPresetError(f"there is no preset {name!r}; possible: {known}")
        if name not in self._made:
            self._made[name] = _PRESETS[name].make()
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_PRESETS)

    def __len__(self) -> int:
        return len(_PRESETS)

    def __contains__(self, name: object) -> bool:
        return name in _PRESETS


presets: Mapping[str, Scene] = _Scenes()
"""Scenes by name."""

preset_labels: Mapping[str, str] = MappingProxyType(
    {name: preset.label for name, preset in _PRESETS.items()}
)
"""Name of each preset on the page."""

preset_notes: Mapping[str, str] = MappingProxyType(
    {name: preset.note for name, preset in _PRESETS.items()}
)
"""Sources of each preset's numbers, and its assumptions."""
