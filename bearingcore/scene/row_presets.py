"""Presets of other kinds than one row of balls from a paper: pairs, double rows, rollers, and more.

Few inside dimensions of such bearings are printed anywhere. Their notes say of each number whether
it is printed, computed or assumed.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from types import MappingProxyType

from bearingcore.bearings.bearing import Bearing
from bearingcore.scene.assumed import ASSUMED, FAN_RIG_SUPPORT, below, conforming, rpm
from bearingcore.scene.defect import Defect
from bearingcore.scene.load import Load
from bearingcore.scene.scene import Scene

WIDTH_7208 = 18e-3
"""[m] of a 7208 by ISO 15: two of them side by side have their rows as far apart."""

PRELOAD = 8e-6
"""[m] of the pairs."""


def _in_first_row(extent_deg: float, depth: float) -> Defect:
    return dataclasses.replace(below(extent_deg, depth), row=0)


def _single_7208() -> Bearing:
    return Bearing.from_drawing(
        n_balls=14,
        pitch_diameter=60e-3,
        contact_angle=math.radians(25.0),
        **conforming(15.0 / 32.0 * 25.4e-3),
    )


def _paired_7208(arrangement: str) -> Scene:
    tandem = arrangement == "tandem"
    return Scene(
        bearing=_single_7208().paired(WIDTH_7208, arrangement, 0.0 if tandem else PRELOAD),
        defect=_in_first_row(8.0, 100e-6),
        load=Load(fy=-3000.0, fz=3000.0 if tandem else 800.0),
        shaft_speed=rpm(3000.0),
        support=FAN_RIG_SUPPORT,
        dofs=("x", "y", "z") if tandem else None,
    )


def _3208() -> Scene:
    single = Bearing.from_drawing(
        n_balls=14,
        pitch_diameter=60e-3,
        contact_angle=math.radians(30.0),
        **conforming(13.0 / 32.0 * 25.4e-3),
    )
    return Scene(
        bearing=single.paired(14e-3, "back-to-back", 4e-6),
        defect=_in_first_row(8.0, 100e-6),
        load=Load(fy=-2500.0, fz=500.0),
        shaft_speed=rpm(3000.0),
        support=FAN_RIG_SUPPORT,
    )


def _1208() -> Scene:
    ball = 11.0 / 32.0 * 25.4e-3
    return Scene(
        bearing=Bearing.self_aligning(
            n_balls=16,
            ball_diameter=ball,
            sphere_radius=34.4e-3,
            inner_groove_radius=0.53 * ball,
            contact_angle=math.radians(10.0),
            radial_clearance=5e-6,
        ),
        defect=_in_first_row(8.0, 100e-6),
        load=Load(fy=-1000.0),
        shaft_speed=rpm(1500.0),
        support=FAN_RIG_SUPPORT,
    )


def _nu208() -> Scene:
    return Scene(
        bearing=Bearing.cylindrical(
            n_rollers=14,
            roller_diameter=11e-3,
            roller_length=11e-3,
            pitch_diameter=60.5e-3,
            radial_clearance=15e-6,
        ),
        defect=below(8.0, 100e-6),
        load=Load(fy=-3000.0),
        shaft_speed=rpm(1500.0),
        support=FAN_RIG_SUPPORT,
    )


def _6203() -> Scene:
    return Scene(
        bearing=Bearing.from_drawing(
            n_balls=8, pitch_diameter=28.55e-3, diametral_clearance=10e-6, **conforming(6.75e-3)
        ),
        defect=below(3.0, 100e-6),
        load=Load(fy=-700.0),
        shaft_speed=rpm(1500.0),
        support=FAN_RIG_SUPPORT,
    )


def _209() -> Scene:
    return Scene(
        bearing=Bearing.from_drawing(
            n_balls=9,
            ball_diameter=12.7e-3,
            pitch_diameter=65e-3,
            inner_groove_radius=6.6e-3,
            outer_groove_radius=6.6e-3,
            diametral_clearance=15e-6,
        ),
        defect=below(6.0, 100e-6),
        load=Load(fy=-2500.0),
        shaft_speed=rpm(1800.0),
        support=FAN_RIG_SUPPORT,
    )


MAKERS: Mapping[str, Callable[[], Scene]] = MappingProxyType(
    {
        "6203": _6203,
        "209": _209,
        "7208-back-to-back": lambda: _paired_7208("back-to-back"),
        "7208-face-to-face": lambda: _paired_7208("face-to-face"),
        "7208-tandem": lambda: _paired_7208("tandem"),
        "3208": _3208,
        "1208": _1208,
        "nu208": _nu208,
    }
)
"""What makes each scene."""


def _note_pair(arrangement: str, stands: str, held: str) -> str:
    return (
        f"Two 7208 angular-contact bearings of 25° side by side on a shaft, {arrangement}: "
        f"{stands}. By ISO 15: bore 40 mm, outside diameter 80 mm, width 18 mm each. Computed: "
        "rows 18 mm apart, as wide as one bearing. Assumed: the inside of the preset 7208-25deg "
        f"in each row, {held}; the loads; the defect, in the first row; {ASSUMED}"
    )


_PRELOADED = "pushed together by an axial preload of 8 µm"

NOTES: Mapping[str, str] = MappingProxyType(
    {
        "6203": (
            "A deep-groove bearing of 17 mm bore and 40 mm outside diameter, as in the data of "
            "Paderborn University (Lessmeier and others, 2016). Printed there: 8 balls of 6.75 mm "
            "on 28.55 mm, contact angle 0, 1500 rpm. Assumed: diametral clearance 10 µm, load "
            f"0.7 kN, the defect, {ASSUMED}"
        ),
        "209": (
            "The 209 deep-groove bearing of the examples in Harris, Rolling Bearing Analysis. "
            "Printed: 9 balls of 12.7 mm, raceway diameters 52.291 and 77.706 mm, groove radii "
            "6.6 mm, 1800 rpm. Computed: pitch diameter 65 mm, diametral clearance 15 µm. "
            "Assumed: load 2.5 kN, the defect, steel with 210 GPa and 0.3, and the rotor and "
            "support of the fan rig."
        ),
        "7208-back-to-back": _note_pair(
            "back to back (O)", "their lines of contact meet the shaft far apart", _PRELOADED
        ),
        "7208-face-to-face": _note_pair(
            "face to face (X)", "their lines of contact meet the shaft close together", _PRELOADED
        ),
        "7208-tandem": _note_pair(
            "in tandem",
            "both carry the same axial load, one way only",
            "without clearance or preload, and a shaft kept from tilting",
        ),
        "3208": (
            "A double-row angular-contact bearing. By ISO 15: bore 40 mm, outside diameter 80 mm, "
            "width 30.2 mm. Computed: a dynamic rating of 44 kN by ISO 281. Assumed, as makers do "
            "not print it: rows back to back, 14 mm apart, at 30°, each of 14 balls of 13/32 inch "
            "(10.319 mm) on the mean of bore and outside diameter (60 mm), an axial preload of "
            f"4 µm, the loads, the defect, in the first row, {ASSUMED}"
        ),
        "1208": (
            "A self-aligning ball bearing: two rows on one spherical outer race. By ISO 15: bore "
            "40 mm, outside diameter 80 mm, width 18 mm. Assumed, as makers do not print it: 16 "
            "balls of 11/32 inch (8.731 mm) a row at 10° on a sphere of 34.4 mm radius, inner "
            "grooves of 0.53 ball diameters, a radial clearance of 5 µm, load, speed and the "
            "defect, in the first row; steel with 210 GPa and 0.3, and the rotor and support of "
            "the fan rig. Computed: rows 10.5 mm apart on a pitch diameter of 59.2 mm. Its inner "
            "ring tilts freely, so the shaft is taken to be kept from tilting by another bearing."
        ),
        "nu208": (
            "A cylindrical roller bearing. By ISO 15: bore 40 mm, outside diameter 80 mm, width "
            "18 mm. Assumed: 14 rollers of 11 mm diameter and length on 60.5 mm, a radial "
            "clearance of 15 µm, load, speed, the defect, and the rotor and support of the fan "
            "rig. Computed: the stiffness of a steel roller between its races by Palmgren's "
            "formula. It carries radial loads only, and its rollers do not tilt here."
        ),
    }
)
"""Where their numbers come from, and which of them are assumed."""
