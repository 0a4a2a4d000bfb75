"""The registry of fields: each number of a scene with its symbol, unit, label, range and meaning.

Sliders, links, drafts, sweeps, tables and sentences about a field take their data from here only. A
new field needs an entry in `FIELDS` and its attribute in the dataclass of its part.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bearingcore.units import UNITS

WIDEST_CONFORMITY = 0.6
"""Greatest groove radius over ball diameter that is accepted. Makers use 0.505 to 0.54, and up to
about 0.58 for instrument bearings."""


@dataclass(frozen=True)
class Range:
    """The numbers that a field may have, in its shown unit.

    Attributes
    ----------
    least, most
        ends of its slider.
    step
        of the slider.
    typed_least, typed_most
        least and greatest number that may be typed; NaN: the end of the slider.
    """

    least: float
    most: float
    step: float
    typed_least: float = math.nan
    typed_most: float = math.nan

    @property
    def allowed(self) -> tuple[float, float]:
        """Least and greatest number that may be typed."""
        return (
            self.least if math.isnan(self.typed_least) else self.typed_least,
            self.most if math.isnan(self.typed_most) else self.typed_most,
        )

    def holds(self, value: float) -> bool:
        """Return True if the slider reaches `value`, or if `value` is unknown (NaN)."""
        return self.least <= value <= self.most or math.isnan(value)

    def around(self, value: float) -> Range:
        """Extend the slider to a round number past `value`, or to the end of the typed numbers."""
        if self.holds(value):
            return self
        low, high = self.allowed
        room = round_up(1.5 * abs(value))
        least = self.least if value > self.most else max(low, -room if value < 0.0 else 0.0)
        most = self.most if value < self.least else min(high, room)
        return Range(least, most, self.step, low, high)


def round_up(value: float) -> float:
    """Return the least number of 1, 2, 5, 10, 20, 50, ... that is not below `value`."""
    value = max(value, 1e-300)  # smaller powers of ten underflow
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value * 0.999999)


RangeOf = Callable[[Any, float], Range]
"""A range that depends on a preset: called with its scene and the field's number there."""


def _usual(_: Any, value: float) -> Range:
    """Return the range from 0 to twice the preset's number; a typed number may be much larger."""
    most = round_up(2.0 * value) if value > 0.0 else 100.0  # also for NaN, an unknown number
    return Range(0.0, most, round_up(most / 2000.0), 0.0, 1e9)


def _usual_of_first_row(name: str) -> RangeOf:
    """Return the range `_usual` for the number of the first row [mm]."""
    return lambda scene, _: _usual(scene, getattr(scene.bearing, name) * 1e3)


def _largest_force(scene: Any) -> float:
    load = scene.load
    return round_up(2.5 * max(abs(load.fx), abs(load.fy), abs(load.fz), 1.0))


def _force(scene: Any, _: float) -> Range:
    """Return the range of a force in both directions, a few times the preset's largest one."""
    most = _largest_force(scene)
    return Range(-most, most, most / 500.0, -1e6, 1e6)


def _moment(scene: Any, _: float) -> Range:
    """Return the range of a moment: a quarter of such a force times the pitch diameter."""
    most = round_up(0.25 * _largest_force(scene) * scene.bearing.pitch_diameter)
    return Range(-most, most, most / 500.0, -1e5, 1e5)


def groove_range(scene: Any, _: float = math.nan) -> Range:
    """Return the range from hardly wider than a ball to the widest groove that guides one."""
    ball = scene.bearing.ball_diameter * 1e3
    widest = float(f"{WIDEST_CONFORMITY * ball:.12g}")
    return Range(float(f"{0.501 * ball:.6g}"), widest, 0.0005 * ball, 0.0, 1e4)


@dataclass(frozen=True)
class Field:
    """One number of a scene.

    Attributes
    ----------
    name
        of the attribute that holds it.
    part
        the part that has this attribute: "scene", "bearing", "load", "support", "defect", "floor"
        (the rough floor of a defect), "pair" (a bearing of two rows), "second" (the second row of a
        bearing), or "" for a number of the page alone.
    label
        name in words.
    symbol
        letter, with its subscript after an underscore: "D_b".
    shown_unit
        unit of sliders, links and lessons, one of `UNITS`; empty for counts and ratios.
    group
        heading of its slider; empty where it has none.
    range
        possible numbers, or a function of a preset's scene that returns them.
    meaning
        meaning in a sentence.
    optional
        True if it may be left empty: None in the scene.
    whole
        True if it is a whole number.
    sweep_range
        ends of maps over it, if they show more than its whole slider would.
    reverse_label
        name of the number with the opposite sign, if people read that one: "Load, downwards".
    """

    name: str
    part: str
    label: str
    symbol: str
    shown_unit: str
    group: str
    range: Range | RangeOf
    meaning: str
    optional: bool = False
    whole: bool = False
    sweep_range: tuple[float, float] | None = None
    reverse_label: str = ""

    @property
    def read_label(self) -> str:
        """The name of the number that people read, which is `read_sign` times the field's."""
        return self.reverse_label or self.label

    @property
    def read_sign(self) -> float:
        """-1 if people read the number with the opposite sign, under `reverse_label`; else 1."""
        return -1.0 if self.reverse_label else 1.0

    @property
    def key(self) -> str:
        """Name on the page, in links and in lessons, with the unit: "extent_deg"."""
        suffix = _SUFFIXES.get(self.shown_unit)
        return f"{self.full_name}_{suffix}" if suffix else self.full_name

    @property
    def full_name(self) -> str:
        """The name, which differs for every field: "second_n_balls" for the second row."""
        return f"second_{self.name}" if self.part == "second" else self.name

    @property
    def unit(self) -> str:
        """SI unit; "1" for counts and ratios."""
        return UNITS[self.shown_unit].si or "1"

    @property
    def factor(self) -> float:
        """Factor from the shown unit to SI."""
        return UNITS[self.shown_unit].factor

    @property
    def symbol_html(self) -> str:
        """The symbol as HTML: "D<sub>b</sub>"."""
        letter, _, below = self.symbol.partition("_")
        return f"{letter}<sub>{below}</sub>" if below else letter

    @property
    def read_symbol_html(self) -> str:
        """The symbol of the number that people read, as HTML."""
        return ("−" if self.reverse_label else "") + self.symbol_html

    def range_for(self, scene: Any, value: float) -> Range:
        """Return the range for a preset's scene, in which the field has `value` [shown unit]."""
        return self.range if isinstance(self.range, Range) else self.range(scene, value)


_SUFFIXES = {
    "°": "deg", "µm": "um", "mm": "mm", "Hz": "hz", "GPa": "gpa",
    "N": "n", "N·m": "nm", "g·mm": "g_mm",
}  # fmt: skip
"""Units in the keys of fields. They must not change, as links that people have kept use them."""

_FIRST = " Empty: the value of the first row."

# fmt: off
_SCENE = (
    Field("extent", "defect", "Length of the defect", "Δφ_f", "°", "Defect",
          Range(0.0, 120.0, 0.1, 0.0, 360.0),
          "Length of the defect along the race, as an angle.", sweep_range=(2.0, 62.0)),
    Field("depth", "defect", "Depth", "h", "µm", "Defect", Range(0.0, 500.0, 1.0, 0.0, 5000.0),
          "Depth of the defect's floor. A ball reaches it only if the defect is long enough."),
    Field("center", "defect", "Centre", "φ_f", "°", "Defect", Range(0.0, 360.0, 0.5),
          "Angle of the defect's middle: 0° is right, 90° up, 270° down, the direction of a "
          "weight. A defect of the inner race has this angle at cage angle 0 and turns with the "
          "shaft."),
    Field("rms_height", "floor", "Roughness, RMS", "R_q", "µm", "Defect",
          Range(0.0, 20.0, 0.1, 0.0, 500.0),
          "Root mean square height of the rough floor about its mean depth."),
    Field("correlation_length", "floor", "Correlation length", "l", "µm", "Defect",
          Range(20.0, 2000.0, 10.0, 1.0, 20000.0),
          "Distance along the race over which the correlation of the heights falls to 1/e."),
    Field("seed", "floor", "Seed", "", "", "Defect", Range(0.0, 99.0, 1.0, 0.0, 2.0**31 - 1.0),
          "Number of the random floor: the same number gives the same floor.",
          whole=True),
    Field("shaft_speed", "scene", "Shaft speed", "f_s", "Hz", "Turning",
          Range(1.0, 100.0, 0.1, 0.0, 1000.0),
          "Turns of the shaft per second. Static answers do not depend on it.",
          sweep_range=(4.0, 60.0)),
    Field("cage_angle", "", "Position of the balls (cage angle)", "φ_c", "°", "Turning",
          Range(0.0, 360.0, 0.1), "Angle of the first ball. Play turns the bearing."),
    Field("fx", "load", "Load, sideways", "F_x", "N", "Load", _force,
          "Force on the inner ring towards 0°."),
    Field("fy", "load", "Load, upwards", "F_y", "N", "Load", _force,
          "Vertical force on the inner ring. Sliders show it downwards, as a weight acts; F_y of "
          "links, tables and Python points up, towards 90°.", reverse_label="Load, downwards"),
    Field("fz", "load", "Load, along the shaft", "F_z", "N", "Load", _force,
          "Force on the inner ring along the shaft."),
    Field("unbalance", "scene", "Unbalance", "U", "g·mm", "Load", Range(0.0, 2000.0, 5.0, 0.0, 1e6),
          "Mass of the rotor times the distance of its centre from the shaft's axis. The force "
          "U·ω² turns with the shaft and changes the vibration; static answers leave it out."),
    Field("mx", "load", "Moment about x", "M_x", "N·m", "Load", _moment,
          "Moment on the inner ring that tilts the shaft up or down."),
    Field("my", "load", "Moment about y", "M_y", "N·m", "Load", _moment,
          "Moment on the inner ring that tilts the shaft sideways."),
)

_BEARING = (
    Field("n_balls", "bearing", "Number of balls", "N_b", "", "Balls",
          Range(3.0, 30.0, 1.0, 1.0, 100.0),
          "Balls in a row, equally spaced by the cage.", whole=True),
    Field("ball_diameter", "bearing", "Ball diameter", "D_b", "mm", "Balls", _usual,
          "Diameter of a ball. With the pitch diameter it sets the speed of the cage."),
    Field("pitch_diameter", "bearing", "Pitch diameter", "D_p", "mm", "Balls", _usual,
          "Diameter of the circle on which the centres of the balls run."),
    Field("roller_length", "bearing", "Roller length", "l", "mm", "Balls",
          Range(1.0, 100.0, 0.1, 0.0, 1000.0),
          "Length of a roller in contact with the races: longer rollers are stiffer."),
    Field("row_distance", "pair", "Distance of the rows", "a", "mm", "Rows",
          Range(0.0, 100.0, 0.1, 0.0, 10_000.0),
          "Distance between the centres of the two rows of balls, along the shaft."),
    Field("preload", "pair", "Axial preload", "", "µm", "Rows",
          Range(-50.0, 50.0, 0.1, -1000.0, 1000.0),
          "Distance by which the inner grooves of both rows are pushed together along the shaft. A "
          "negative value is an axial clearance between them.", sweep_range=(0.0, 50.0)),
    Field("preload_force", "pair", "Preload force", "F_0", "N", "",
          Range(0.0, 10_000.0, 1.0, 0.0, 1e6),
          "Axial force with which both rows press each other at rest and without a load, as makers "
          "state a preload. The axial preload follows from it."),
    Field("n_balls", "second", "Number of balls, row 2", "N_b2", "", "Second row",
          Range(3.0, 30.0, 1.0, 1.0, 100.0),
          "Balls in the second row." + _FIRST, optional=True, whole=True),
    Field("ball_diameter", "second", "Ball diameter, row 2", "D_b2", "mm", "Second row",
          _usual_of_first_row("ball_diameter"),
          "Diameter of a ball of the second row; its grooves scale with it." + _FIRST,
          optional=True),
    Field("pitch_diameter", "second", "Pitch diameter, row 2", "D_p2", "mm", "Second row",
          _usual_of_first_row("pitch_diameter"),
          "Diameter of the circle on which the balls of the second row run." + _FIRST,
          optional=True),
    Field("contact_angle", "second", "Contact angle, row 2", "α_02", "°", "Second row",
          Range(0.0, 45.0, 0.5, 0.0, 80.0),
          "Contact angle of the second row, unloaded." + _FIRST, optional=True),
    Field("outer_groove_radius", "bearing", "Outer groove radius", "r_o", "mm", "Drawing",
          groove_range,
          "Radius of the outer groove's cross-section; a little more than half a ball's diameter."),
    Field("inner_groove_radius", "bearing", "Inner groove radius", "r_i", "mm", "Drawing",
          groove_range,
          "Radius of the inner groove's cross-section; a closer fit to the ball is stiffer."),
    Field("youngs_modulus", "bearing", "Young's modulus", "E", "GPa", "Drawing",
          Range(60.0, 400.0, 1.0, 1.0, 1000.0),
          "Young's modulus of the rings, and of balls without a value of their own; steel has "
          "about 207 GPa."),
    Field("poisson", "bearing", "Poisson's ratio", "ν", "", "Drawing",
          Range(0.1, 0.45, 0.005, 0.0, 0.49),
          "Ratio of the material's transverse contraction to its extension; 0.3 for steel."),
    Field("ball_youngs_modulus", "bearing", "Young's modulus of the balls", "E_b", "GPa", "Drawing",
          Range(60.0, 400.0, 1.0, 1.0, 1000.0),
          "For balls of another material than the rings; 310 GPa for silicon nitride. Empty: the "
          "value of the rings.", optional=True),
    Field("ball_poisson", "bearing", "Poisson's ratio of the balls", "ν_b", "", "Drawing",
          Range(0.1, 0.45, 0.005, 0.0, 0.49),
          "For balls of another material than the rings; 0.26 for silicon nitride. Empty: the "
          "value of the rings.", optional=True),
    Field("contact_angle", "bearing", "Contact angle", "α_0", "°", "Contact",
          Range(0.0, 45.0, 0.5, 0.0, 80.0),
          "Angle between the line through both contacts of an unloaded ball and the plane of the "
          "balls. A bearing with a contact angle carries loads along the shaft."),
    Field("groove_center_distance", "bearing", "Groove centre distance", "A_0", "µm", "Contact",
          _usual,
          "Distance between the centres of curvature of the two grooves around an unloaded ball: "
          "the sum of both groove radii minus a ball diameter."),
    Field("groove_center_radius", "bearing", "Groove centre radius", "r_d", "mm", "Contact", _usual,
          "Radius of the circle on which the centres of the inner groove lie: the lever with which "
          "a tilt of the ring moves a contact."),
    Field("radial_clearance", "bearing", "Radial clearance", "r_L", "µm", "Contact",
          Range(-50.0, 50.0, 0.1, -100.0, 1000.0),
          "Distance that the inner ring can move from the middle before a ball touches, in "
          "addition to the play by the contact angle: half the diametral clearance of a drawing. A "
          "negative value is an interference, which compresses all balls without a load.",
          sweep_range=(0.0, 50.0)),
    Field("load_deflection_factor", "bearing", "Load-deflection factor", "K", "MN/m¹·⁵", "Contact",
          _usual,
          "Stiffness of both contacts of a ball in series: the load is K times the compression to "
          "the power of 1.5 (Hertz)."),
    Field("outer_raceway_radius", "bearing", "Outer raceway radius", "R_o", "mm", "Races", _usual,
          "Distance from the shaft's axis to the bottom of the outer groove; defects lie there."),
    Field("inner_raceway_radius", "bearing", "Inner raceway radius", "R_i", "mm", "Races", _usual,
          "Distance from the shaft's axis to the bottom of the inner groove."),
    Field("density", "bearing", "Density of the balls", "ρ", "kg/m³", "Balls", _usual,
          "Mass of a ball over its volume; 7800 kg/m³ for steel, 3200 for silicon nitride. It "
          "matters only for balls with mass."),
)

_BODIES = (
    Field("inner_mass", "support", "Mass of the rotor", "m_i", "kg", "Bodies", _usual,
          "Mass of the inner ring with the shaft and all parts on it."),
    Field("outer_mass", "support", "Mass of the housing", "m_o", "kg", "Bodies", _usual,
          "Mass of the outer ring with the housing, which carries the sensor."),
    Field("inner_inertia", "support", "Inertia of the rotor", "I_i", "g·m²", "Bodies", _usual,
          "Moment of inertia of the rotor against tilt. Needed only if the ring tilts.",
          optional=True),
    Field("outer_inertia", "support", "Inertia of the housing", "I_o", "g·m²", "Bodies", _usual,
          "Moment of inertia of the housing against tilt. Needed only if the ring tilts.",
          optional=True),
)

_CONTACT_DAMPING = (
    Field("contact_damping", "scene", "Contact damping", "c", "N·s/m", "Contacts in motion",
          _usual,
          "Viscous damping of each loaded contact. Empty: 10 µs times the radial stiffness per "
          "loaded ball of the healthy bearing.", optional=True),
)
# fmt: on


def _support(name: str, symbol: str, unit: str, tilt_unit: str, meaning: str) -> tuple[Field, ...]:
    """Return the springs or dampers of the support along x, y, z and about x, y."""
    fields = []
    for dof, words in (("x", "along x"), ("y", "along y"), ("z", "along z"),
                       ("rx", "about x"), ("ry", "about y")):  # fmt: skip
        tilts = dof.startswith("r")
        fields.append(
            Field(
                f"{name}_{dof}",
                "support",
                f"{name.capitalize()} {words}",
                f"{symbol}_{dof.replace('r', 'θ')}",
                tilt_unit if tilts else unit,
                f"Support, {name}",
                _usual,
                meaning + (" It acts against tilt." if tilts else ""),
                optional=dof not in ("x", "y"),
            )
        )
    return tuple(fields)


FIELDS: tuple[Field, ...] = (
    *_SCENE,
    *_BEARING,
    *_BODIES,
    *_support("stiffness", "k", "MN/m", "N·m/rad", "Spring between the housing and the ground."),
    *_support("damping", "c", "N·s/m", "N·m·s/rad", "Damper between the housing and the ground."),
    *_CONTACT_DAMPING,
)
"""All fields, in the order of the page."""

FIELD_OF: Mapping[str, Field] = {field.full_name: field for field in FIELDS}
"""Fields by their full names."""

SCENE_FIELDS = tuple(field for field in FIELDS if field.part)
"""Fields that `Scene.replace`, files and sweeps take, by their full names."""
