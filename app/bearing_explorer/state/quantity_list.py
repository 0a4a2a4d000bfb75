"""Every number of the page: its name, symbol, unit, and a sentence that says what it is."""

from __future__ import annotations

import math
from dataclasses import dataclass

DEGREE = math.pi / 180.0
CAGE_ANGLE = "cage_angle_deg"


@dataclass(frozen=True)
class Quantity:
    """One number of the page.

    `field` says what it is of: a name that `Scene.replace` knows, ``floor.`` and the name of a
    field of a `RoughFloor`, ``rows.`` and a property of a bearing of two rows, ``rows.second_`` and
    what the second of them has of its own, or nothing where it is no part of the scene. `unit_si`
    is how much one unit is in SI; `symbol` and `about` may hold simple HTML. `optional`: it may be
    left open.
    """

    name: str
    field: str
    label: str
    symbol: str
    unit: str
    unit_si: float
    group: str
    about: str
    optional: bool = False

    @property
    def of(self) -> str:
        """What the field belongs to: "scene", "floor", "rows" or nothing."""
        head, _, tail = self.field.partition(".")
        return head if tail else "scene" if head else ""

    @property
    def last_name(self) -> str:
        """The field without what it belongs to."""
        return self.field.rpartition(".")[2]


def _sub(letter: str, below: str) -> str:
    return f"{letter}<sub>{below}</sub>"


_DEFECT = (
    Quantity(
        "extent_deg",
        "extent",
        "Extent",
        "Δφ<sub>f</sub>",
        "°",
        DEGREE,
        "Defect",
        "How far the defect reaches along the race.",
    ),
    Quantity(
        "depth_um",
        "depth",
        "Depth",
        "h",
        "µm",
        1e-6,
        "Defect",
        "How deep its floor lies. A ball reaches it only where the defect is long enough.",
    ),
    Quantity(
        "center_deg",
        "center",
        "Centre",
        "φ<sub>f</sub>",
        "°",
        DEGREE,
        "Defect",
        "Where its middle is: 0° is right, 90° up, 270° down, where the weight of a rotor acts. "
        "A defect of the inner race is there at cage angle 0 and turns with the shaft.",
    ),
    Quantity(
        "rms_height_um",
        "floor.rms_height",
        "Roughness, RMS",
        "R<sub>q</sub>",
        "µm",
        1e-6,
        "Defect",
        "Root mean square height of the rough floor about its depth.",
    ),
    Quantity(
        "correlation_length_um",
        "floor.correlation_length",
        "Correlation length",
        "l",
        "µm",
        1e-6,
        "Defect",
        "Distance along the race over which the heights forget each other (to 1/e).",
    ),
    Quantity(
        "seed",
        "floor.seed",
        "Seed",
        "",
        "",
        1.0,
        "Defect",
        "Which of all rough floors of this kind: the same number is the same floor.",
    ),
)

_TURNING = (
    Quantity(
        "shaft_speed_hz",
        "shaft_speed",
        "Shaft speed",
        "f<sub>s</sub>",
        "Hz",
        2.0 * math.pi,
        "Turning",
        "Turns of the shaft a second. Static answers do not depend on it.",
    ),
    Quantity(
        CAGE_ANGLE,
        "",
        "Cage angle",
        "φ<sub>c</sub>",
        "°",
        DEGREE,
        "Turning",
        "Where the first ball is. Play turns the bearing.",
    ),
)

_LOAD = (
    Quantity(
        "fx_n",
        "fx",
        "Force, sideways",
        "F<sub>x</sub>",
        "N",
        1.0,
        "Load",
        "Force on the inner ring towards 0°.",
    ),
    Quantity(
        "fy_n",
        "fy",
        "Force, up",
        "F<sub>y</sub>",
        "N",
        1.0,
        "Load",
        "Force on the inner ring towards 90°; negative is down, as a weight acts.",
    ),
    Quantity(
        "fz_n",
        "fz",
        "Force, axial",
        "F<sub>z</sub>",
        "N",
        1.0,
        "Load",
        "Force on the inner ring along the shaft.",
    ),
    Quantity(
        "mx_nm",
        "mx",
        "Moment about x",
        "M<sub>x</sub>",
        "N·m",
        1.0,
        "Load",
        "Moment on the inner ring that tilts the shaft up or down.",
    ),
    Quantity(
        "my_nm",
        "my",
        "Moment about y",
        "M<sub>y</sub>",
        "N·m",
        1.0,
        "Load",
        "Moment on the inner ring that tilts the shaft sideways.",
    ),
)

_BALLS = (
    Quantity(
        "n_balls",
        "n_balls",
        "Number of balls",
        _sub("N", "b"),
        "",
        1.0,
        "Balls",
        "How many balls share the load, equally spaced by the cage.",
    ),
    Quantity(
        "ball_diameter_mm",
        "ball_diameter",
        "Ball diameter",
        _sub("D", "b"),
        "mm",
        1e-3,
        "Balls",
        "Diameter of a ball. With the pitch diameter it decides how fast the cage turns.",
    ),
    Quantity(
        "pitch_diameter_mm",
        "pitch_diameter",
        "Pitch diameter",
        _sub("D", "p"),
        "mm",
        1e-3,
        "Balls",
        "Diameter of the circle on which the centres of the balls run.",
    ),
    Quantity(
        "roller_length_mm",
        "roller_length",
        "Roller length",
        "l",
        "mm",
        1e-3,
        "Balls",
        "Length of a roller that lies on the races: the longer, the stiffer.",
    ),
)

_ROWS = (
    Quantity(
        "row_distance_mm",
        "rows.row_distance",
        "Distance of the rows",
        "a",
        "mm",
        1e-3,
        "Rows",
        "From the centre of one row of balls to that of the other, along the shaft.",
    ),
    Quantity(
        "preload_um",
        "rows.preload",
        "Axial preload",
        "",
        "µm",
        1e-6,
        "Rows",
        "How far the inner grooves of both rows are pushed against each other along the shaft.",
    ),
)

_AS_FIRST = "Left empty it is that of the first row."

_SECOND_ROW = (
    Quantity(
        "second_n_balls",
        "rows.second_n_balls",
        "Number of balls, row 2",
        _sub("N", "b2"),
        "",
        1.0,
        "Second row",
        f"How many balls the second row has. {_AS_FIRST}",
        optional=True,
    ),
    Quantity(
        "second_ball_diameter_mm",
        "rows.second_ball_diameter",
        "Ball diameter, row 2",
        _sub("D", "b2"),
        "mm",
        1e-3,
        "Second row",
        f"Diameter of a ball of the second row; its grooves go with it. {_AS_FIRST}",
        optional=True,
    ),
    Quantity(
        "second_pitch_diameter_mm",
        "rows.second_pitch_diameter",
        "Pitch diameter, row 2",
        _sub("D", "p2"),
        "mm",
        1e-3,
        "Second row",
        f"Diameter of the circle on which the balls of the second row run. {_AS_FIRST}",
        optional=True,
    ),
    Quantity(
        "second_contact_angle_deg",
        "rows.second_contact_angle",
        "Contact angle, row 2",
        _sub("α", "02"),
        "°",
        DEGREE,
        "Second row",
        f"Contact angle of the second row, unloaded. {_AS_FIRST}",
        optional=True,
    ),
)

_CONTACT = (
    Quantity(
        "contact_angle_deg",
        "contact_angle",
        "Contact angle",
        "α<sub>0</sub>",
        "°",
        DEGREE,
        "Contact",
        "Angle between the line through both contacts of an unloaded ball and the plane of the "
        "balls. A bearing with one carries loads along the shaft.",
    ),
    Quantity(
        "groove_center_distance_um",
        "groove_center_distance",
        "Groove centre distance",
        _sub("A", "0"),
        "µm",
        1e-6,
        "Contact",
        "Distance between the centres of curvature of the two grooves around an unloaded ball: "
        "both groove radii together less a ball diameter.",
    ),
    Quantity(
        "groove_center_radius_mm",
        "groove_center_radius",
        "Groove centre radius",
        _sub("r", "d"),
        "mm",
        1e-3,
        "Contact",
        "Radius of the circle on which the centres of the inner groove lie: the lever with which "
        "a tilt of the ring moves a contact.",
    ),
    Quantity(
        "radial_clearance_um",
        "radial_clearance",
        "Radial clearance",
        _sub("r", "L"),
        "µm",
        1e-6,
        "Contact",
        "How far the inner ring can move from the middle before a ball touches, on top of what "
        "the contact angle stands for: half the diametral clearance of a drawing.",
    ),
    Quantity(
        "load_deflection_factor",
        "load_deflection_factor",
        "Load-deflection factor",
        "K",
        "MN/m¹·⁵",
        1e6,
        "Contact",
        "Stiffness of both contacts of a ball in series: the load is K times the compression to "
        "the power of 1.5 (Hertz).",
    ),
)

_RACES = (
    Quantity(
        "outer_raceway_radius_mm",
        "outer_raceway_radius",
        "Outer raceway radius",
        _sub("R", "o"),
        "mm",
        1e-3,
        "Races",
        "From the shaft's middle to the bottom of the outer groove, where defects are cut.",
    ),
    Quantity(
        "inner_raceway_radius_mm",
        "inner_raceway_radius",
        "Inner raceway radius",
        _sub("R", "i"),
        "mm",
        1e-3,
        "Races",
        "From the shaft's middle to the bottom of the inner groove.",
    ),
)

_DRAWING = (
    Quantity(
        "outer_groove_radius_mm",
        "outer_groove_radius",
        "Outer groove radius",
        _sub("r", "o"),
        "mm",
        1e-3,
        "Drawing",
        "Radius of the outer groove's cross-section; a little more than half a ball's diameter.",
    ),
    Quantity(
        "inner_groove_radius_mm",
        "inner_groove_radius",
        "Inner groove radius",
        _sub("r", "i"),
        "mm",
        1e-3,
        "Drawing",
        "Radius of the inner groove's cross-section; the closer to the ball, the stiffer.",
    ),
    Quantity(
        "youngs_modulus_gpa",
        "youngs_modulus",
        "Young's modulus",
        "E",
        "GPa",
        1e9,
        "Drawing",
        "Stiffness of the material of balls and rings; steel has about 207 GPa.",
    ),
    Quantity(
        "poisson",
        "poisson",
        "Poisson's ratio",
        "ν",
        "",
        1.0,
        "Drawing",
        "How much the material narrows as it is stretched; 0.3 for steel.",
    ),
)


def _along(
    what: str, letter: str, sentence: str, radial: tuple[str, float], tilt: str
) -> list[Quantity]:
    """The five quantities of the support of one kind, along x, y, z and about x, y."""
    unit, unit_si = radial
    group = f"Support, {what}"
    made = []
    for dof, shown, words in (
        ("x", "x", "along x"),
        ("y", "y", "along y"),
        ("z", "z", "along z"),
        ("rx", "θx", "about x"),
        ("ry", "θy", "about y"),
    ):
        tilts = dof.startswith("r")
        made.append(
            Quantity(
                f"{what}_{dof}",
                f"{what}_{dof}",
                f"{what.capitalize()} {words}",
                _sub(letter, shown),
                tilt if tilts else unit,
                1.0 if tilts else unit_si,
                group,
                sentence + (" Against tilt." if tilts else ""),
                optional=dof not in ("x", "y"),
            )
        )
    return made


_BODIES = (
    Quantity(
        "inner_mass",
        "inner_mass",
        "Mass of the rotor",
        _sub("m", "i"),
        "kg",
        1.0,
        "Bodies",
        "Inner ring with the shaft and what sits on it.",
    ),
    Quantity(
        "outer_mass",
        "outer_mass",
        "Mass of the housing",
        _sub("m", "o"),
        "kg",
        1.0,
        "Bodies",
        "Outer ring with the housing, on which a sensor sits.",
    ),
    Quantity(
        "inner_inertia",
        "inner_inertia",
        "Inertia of the rotor",
        _sub("I", "i"),
        "g·m²",
        1e-3,
        "Bodies",
        "Moment of inertia of the rotor against tilt. Needed only where the ring tilts.",
        optional=True,
    ),
    Quantity(
        "outer_inertia",
        "outer_inertia",
        "Inertia of the housing",
        _sub("I", "o"),
        "g·m²",
        1e-3,
        "Bodies",
        "Moment of inertia of the housing against tilt. Needed only where the ring tilts.",
        optional=True,
    ),
)

_CONTACT_DAMPING = (
    Quantity(
        "contact_damping",
        "contact_damping",
        "Contact damping",
        "c",
        "N·s/m",
        1.0,
        "Contact of a moving ball",
        "Viscous damping of each loaded contact. Left empty it follows from the stiffness of the "
        "healthy bearing: 10 µs times its radial stiffness a ball.",
        optional=True,
    ),
)

SCENE_GROUPS = ("Defect", "Turning", "Load")
BEARING_GROUPS = ("Balls", "Rows", "Second row", "Drawing", "Contact", "Races")
MODEL_GROUPS = ("Bodies", "Contact of a moving ball", "Support, stiffness", "Support, damping")

QUANTITY_LIST: tuple[Quantity, ...] = (
    *_DEFECT,
    *_TURNING,
    *_LOAD,
    *_BALLS,
    *_ROWS,
    *_SECOND_ROW,
    *_DRAWING,
    *_CONTACT,
    *_RACES,
    *_BODIES,
    *_along(
        "stiffness",
        "k",
        "Spring between the housing and the ground.",
        ("MN/m", 1e6),
        "N·m/rad",
    ),
    *_along(
        "damping",
        "c",
        "Damper between the housing and the ground.",
        ("N·s/m", 1.0),
        "N·m·s/rad",
    ),
    *_CONTACT_DAMPING,
)
"""All quantities in the order of the page."""
