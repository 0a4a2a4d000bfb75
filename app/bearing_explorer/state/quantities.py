"""What can be set on the page: ranges, and the way to a Scene and back.

Degrees, micrometres and hertz live here and in the browser; behind this module all is SI.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from bearing_explorer.state.quantity_list import CAGE_ANGLE, DEGREE, QUANTITY_LIST, Quantity
from bearingcore import Bearing, Defect, Load, RoughFloor, Scene, Support
from bearingcore.bearings.drawing import WIDEST_CONFORMITY
from bearingcore.common.numbers import number

Values = dict[str, float]
"""A value for each quantity, in the unit of its name; NaN for an optional one left open."""

DEFECT_FIELDS = ("extent", "depth", "center")
FIRST_ROUGHNESS = RoughFloor(rms_height=2e-6, correlation_length=200e-6)
"""A rough floor to begin with."""
GROOVES = ("inner_groove_radius_mm", "outer_groove_radius_mm")


@dataclass(frozen=True)
class Limits:
    """What a quantity may be, and how far one step of its slider goes, in its own unit.

    The slider reaches from `least` to `most`; a number may be typed from `typed_least` to
    `typed_most`, and the slider then reaches that far too.
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
        """Whether the slider reaches `value`, or it is left open."""
        return self.least <= value <= self.most or math.isnan(value)

    def around(self, value: float) -> Limits:
        """The same, with a slider that reaches `value`: to the end or a round number past it."""
        if self.holds(value):
            return self
        low, high = self.allowed
        room = _round_up(1.5 * abs(value))
        least = self.least if value > self.most else max(low, -room if value < 0.0 else 0.0)
        most = self.most if value < self.least else min(high, room)
        return Limits(least, most, self.step, low, high)


QUANTITIES: Mapping[str, Quantity] = {quantity.name: quantity for quantity in QUANTITY_LIST}
"""All quantities by name, in the order of the page."""

_FIELD_WORDS = {quantity.last_name: quantity.label.lower() for quantity in QUANTITY_LIST}


def defects_of(scene: Scene) -> tuple[Defect, ...]:
    """All defects of a scene, also those without extent or depth; at least one."""
    several = (scene.defect,) if isinstance(scene.defect, Defect) else scene.defect
    return several or (Defect.none(),)


def values_of(scene: Scene, selected: int = 0) -> Values:
    """The numbers of a scene as the page shows them, at cage angle 0; `selected` is a defect."""
    defect = defects_of(scene)[selected]
    rough = defect.floor if isinstance(defect.floor, RoughFloor) else FIRST_ROUGHNESS
    values = {}
    for quantity in QUANTITY_LIST:
        if quantity.of == "scene":
            values[quantity.name] = in_unit(quantity, _find(scene, defect, quantity.field))
        elif quantity.of == "floor":
            values[quantity.name] = in_unit(quantity, getattr(rough, quantity.last_name))
        elif quantity.of == "rows":
            values[quantity.name] = in_unit(quantity, of_rows(scene.bearing, quantity.last_name))
        else:
            values[quantity.name] = 0.0
    return values


SECOND = "second_"
"""How names of numbers begin that the second row of a bearing has of its own."""


def of_rows(bearing: Bearing, name: str) -> float | None:
    """A number of a bearing of two rows, by its last name; None of one that has it not."""
    if not name.startswith(SECOND):
        value: float | None = getattr(bearing, name)
        return value
    own = bearing.rows[1].own if len(bearing.rows) == 2 else {}
    return own.get(name.removeprefix(SECOND))


def _find(scene: Scene, defect: Defect, field: str) -> Any:
    if field in DEFECT_FIELDS:
        return getattr(defect, field)
    part = _PART_OF[field]
    if field == "inner_groove_radius":
        return scene.bearing.groove_radius("inner")
    return getattr(getattr(scene, part) if part else scene, field)


_PART_OF = {
    name: part
    for part, kind in (("support", Support), ("load", Load), ("bearing", Bearing), ("", Scene))
    for name in kind.__dataclass_fields__
}


def in_unit(quantity: Quantity, si: float | None) -> float:
    """A number in SI as the page shows it; NaN for one left open."""
    return math.nan if si is None else _in_unit(si, quantity.unit_si)


@lru_cache(4096)  # every change of a slider asks for all numbers of the page
def _in_unit(si: float, unit_si: float) -> float:
    # The last digits of π have no business on a page.
    return float(f"{si / unit_si:.12g}")


def in_si(quantity: Quantity, value: float) -> float | None:
    """The other way round."""
    return None if math.isnan(value) else value * quantity.unit_si


def scene_with_fields(scene: Scene, fields: Mapping[str, Any], selected: int = 0) -> Scene:
    """`scene` with fields changed by their names, those of a defect in the `selected` one."""
    own = {name: fields[name] for name in fields if name in Defect.__dataclass_fields__}
    others = {name: fields[name] for name in fields if name not in own}
    defects = list(defects_of(scene))
    if own:
        single = Scene.replace(scene, defect=defects[selected]).replace(**own)
        assert isinstance(single.defect, Defect)
        defects[selected] = single.defect
        others["defect"] = defects[0] if len(defects) == 1 else tuple(defects)
    return scene.replace(**others) if others else scene


def limits_of(base: Scene) -> dict[str, Limits]:
    """Ranges that fit a preset: loads up to a few times its own, moments at its pitch radius."""
    load = base.load
    force = _round_up(2.5 * max(abs(load.fx), abs(load.fy), abs(load.fz), 1.0))
    moment = _round_up(0.5 * force * 0.5 * base.bearing.pitch_diameter)
    pull, turn = (-1e6, 1e6), (-1e5, 1e5)
    values = values_of(base)
    return {
        "extent_deg": Limits(0.0, 120.0, 0.1, 0.0, 360.0),
        "depth_um": Limits(0.0, 500.0, 1.0, 0.0, 5000.0),
        "center_deg": Limits(0.0, 360.0, 0.5),
        "rms_height_um": Limits(0.0, 20.0, 0.1, 0.0, 500.0),
        "correlation_length_um": Limits(20.0, 2000.0, 10.0, 1.0, 20000.0),
        "seed": Limits(0.0, 99.0, 1.0, 0.0, 2.0**31 - 1.0),
        "shaft_speed_hz": Limits(1.0, 100.0, 0.1, 0.0, 1000.0),
        CAGE_ANGLE: Limits(0.0, 360.0, 0.1),
        **{name: Limits(-force, force, force / 500.0, *pull) for name in ("fx_n", "fy_n", "fz_n")},
        **{name: Limits(-moment, moment, moment / 500.0, *turn) for name in ("mx_nm", "my_nm")},
        "row_distance_mm": Limits(0.0, 100.0, 0.1, 0.0, 10_000.0),
        "preload_um": Limits(0.0, 50.0, 0.1, 0.0, 1000.0),
        "second_n_balls": Limits(3.0, 30.0, 1.0, 1.0, 100.0),
        "second_contact_angle_deg": Limits(0.0, 45.0, 0.5, 0.0, 80.0),
        "second_ball_diameter_mm": _near(values["ball_diameter_mm"]),
        "second_pitch_diameter_mm": _near(values["pitch_diameter_mm"]),
        "roller_length_mm": Limits(1.0, 100.0, 0.1, 0.0, 1000.0),
        "n_balls": Limits(3.0, 30.0, 1.0, 1.0, 100.0),
        "contact_angle_deg": Limits(0.0, 45.0, 0.5, 0.0, 80.0),
        "radial_clearance_um": Limits(0.0, 50.0, 0.1, 0.0, 1000.0),
        "youngs_modulus_gpa": Limits(60.0, 400.0, 1.0, 1.0, 1000.0),
        "poisson": Limits(0.1, 0.45, 0.005, 0.0, 0.49),
        **groove_limits(base),
        **{name: _near(value) for name, value in values.items() if name not in _FIXED},
    }


def groove_limits(scene: Scene) -> dict[str, Limits]:
    """Ranges of the groove radii, from hardly wider than a ball to the widest that guides one."""
    ball = scene.bearing.ball_diameter * 1e3
    most = float(f"{WIDEST_CONFORMITY * ball:.12g}")
    least = float(f"{0.501 * ball:.6g}")
    return {name: Limits(least, most, 0.0005 * ball, 0.0, 1e4) for name in GROOVES}


_FIXED = frozenset(
    {quantity.name for quantity in QUANTITY_LIST if quantity.of != "scene"}
    | {quantity.name for quantity in QUANTITY_LIST if quantity.group in ("Defect", "Load")}
    | {"shaft_speed_hz", "n_balls", "contact_angle_deg", "radial_clearance_um"}
    | {*GROOVES, "youngs_modulus_gpa", "poisson", "roller_length_mm"}
)


def _near(value: float) -> Limits:
    """A slider from nothing to a few times `value`; what is typed may go much further."""
    most = _round_up(2.0 * value) if value > 0.0 else 100.0  # NaN too: nobody knows its size
    return Limits(0.0, most, _round_up(most / 2000.0), 0.0, 1e9)


def read(name: str, given: object, limits: Mapping[str, Limits]) -> float:
    """The number a person gave for a quantity; ValueError with a sentence for the page."""
    if name not in QUANTITIES:
        raise ValueError("There is no such quantity.")
    quantity = QUANTITIES[name]
    least, most = limits[name].allowed
    text = str(given)[:80].strip()[:40]
    if quantity.optional and text in ("", "None"):
        return math.nan
    try:
        value = float(text.replace("−", "-").replace(",", "."))
    except ValueError:
        value = math.nan
    unit = _unit(quantity.unit)
    span = f"{number(least, 6)} to {number(most, 6)}{unit}"
    if not math.isfinite(value):
        shown = f"“{text}” is not a number" if text else "A number is missing"
        raise ValueError(f"{shown}: {_named(quantity)} goes from {span}.")
    if not least <= value <= most:
        shown = f"{number(value, 6)}{unit}"
        raise ValueError(f"{shown} is out of range: {_named(quantity)} goes from {span}.")
    return value


def check_values(values: Mapping[str, float], limits: Mapping[str, Limits]) -> None:
    """ValueError with a sentence where a number is one that could not be typed on the page.

    NaN stands for what a scene does not have.
    """
    for name, value in values.items():
        if not math.isnan(value):
            read(name, repr(value), limits)


def refusal(error: ValueError) -> str:
    """What the core refuses, as a sentence for the page: fields by the names they have there."""
    return f"Not possible: {in_page_words(str(error))}."


def in_page_words(text: str) -> str:
    """A sentence of the core with the names and the units of the page.

    "shaft_speed is 0; allowed: above 0 [rad/s]" comes out as "shaft speed is 0 Hz; allowed:
    above 0 Hz": a number without a unit of its own is of the field that the sentence begins with.
    """
    if (row := _ROW.match(text)) is not None:
        return row[0] + in_page_words(text[row.end() :])
    about = _FIELD.match(text)
    quantity = _BY_FIELD.get(about[1]) if about is not None else None
    if about is not None and quantity is not None and (si := _SI.get(quantity.unit)):
        of_field = f"{about[2]} {si}"
        text = f"{about[1]} is {of_field}; {about[3]}"
        text = _BOUND.sub(rf"\1 \2 {si}", text.removesuffix(f" [{si}]"))
    text = _WITH_UNIT.sub(lambda found: _in_page_unit(found, quantity), text)
    return _WORD.sub(lambda word: _FIELD_WORDS.get(word[0], word[0]), text)


def _in_page_unit(found: re.Match[str], quantity: Quantity | None) -> str:
    """A number in SI in the unit of a quantity, or in one that people read."""
    unit, factor = _READ[found[2]]
    if quantity is not None and _SI.get(quantity.unit) == found[2]:
        unit, factor = quantity.unit, quantity.unit_si
    return number(float(found[1]) / factor, 5) + _unit(unit)


_SI = {"mm": "m", "µm": "m", "°": "rad", "Hz": "rad/s", "GPa": "Pa"}
"""The core's unit for each of the page's that differs from it."""
_READ = {
    "m": ("mm", 1e-3),
    "rad": ("°", DEGREE),
    "rad/s": ("Hz", 2.0 * math.pi),
    "Pa": ("GPa", 1e9),
}
_BY_FIELD = {quantity.last_name: quantity for quantity in QUANTITY_LIST if quantity.field}
_SIGNED = r"([-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"
_ROW = re.compile(r"row \d+: ")
_FIELD = re.compile(rf"([a-z]+(?:_[a-z]+)*) is {_SIGNED}; (.*)", re.DOTALL)
_BOUND = re.compile(rf"(above|below|at least|at most) {_SIGNED}(?![\w.]| (?:m|rad|Pa|of)\b)")
_WITH_UNIT = re.compile(rf"{_SIGNED} (rad/s|rad|Pa|m)(?![\w/^·³²])")
_WORD = re.compile(r"[a-z]+(?:_[a-z]+)*")


def _named(quantity: Quantity) -> str:
    label = quantity.label
    return label if label[:2] in ("Yo", "Po") else label[0].lower() + label[1:]


def _unit(unit: str) -> str:
    return unit if unit in ("", "°") else f" {unit}"


def _round_up(value: float) -> float:
    """The next number of 1, 2, 5, 10, 20, 50, ... that is not below `value`."""
    value = max(value, 1e-300)  # below, powers of ten are no numbers any more
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value * 0.999999)
