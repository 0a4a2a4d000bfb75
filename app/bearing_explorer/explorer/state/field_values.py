"""The numbers of a scene on the page: by their keys, in the units of `bearingcore.fields`.

Only this module and the browser use degrees, micrometres and hertz; everything else uses SI.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from bearing_explorer.kit.sentences import label_inside, with_unit
from bearingcore import Defect, RoughFloor, Scene
from bearingcore.fields import FIELDS, Field, Range
from bearingcore.units import read_number, units_like

SHOWN_FIELDS = tuple(field for field in FIELDS if field.group)
"""Fields that can be set on the page, in the page's order."""

FIELD_BY_KEY: Mapping[str, Field] = {field.key: field for field in SHOWN_FIELDS}
"""These fields by their keys."""

CAGE_ANGLE = "cage_angle_deg"

SCENE_GROUPS = ("Defect", "Turning", "Load")
BEARING_GROUPS = ("Balls", "Rows", "Second row", "Drawing", "Contact", "Races")
MODEL_GROUPS = ("Bodies", "Contacts in motion", "Support, stiffness", "Support, damping")

_OF_DEFECT = {
    *Defect.__dataclass_fields__,
    *(field.name for field in FIELDS if field.part == "floor"),
}

Values = dict[str, float]
"""A value for each key, in the shown unit of the field; NaN for an optional one left open."""

FIRST_ROUGHNESS = RoughFloor(rms_height=2e-6, correlation_length=200e-6)
"""The rough floor that a defect begins with."""


def defects_of(scene: Scene) -> tuple[Defect, ...]:
    """All defects of a scene, also those without extent or depth; at least one."""
    several = (scene.defect,) if isinstance(scene.defect, Defect) else scene.defect
    return several or (Defect.none(),)


def values_of(scene: Scene, selected: int = 0) -> Values:
    """The numbers of a scene as the page shows them, at cage angle 0; `selected` is a defect."""
    return {
        field.key: shown_number(field, number_of(scene, field, selected)) if field.part else 0.0
        for field in SHOWN_FIELDS
    }


def number_of(scene: Scene, field: Field, selected: int = 0) -> float | None:
    """A number of a scene [SI]; None if it is left open, or if the scene does not have it.

    A number of a defect is that of the `selected` one. For a floor that is not rough it is the
    number that a rough floor begins with.
    """
    if field.part == "scene":
        part: Any = scene
    elif field.part in ("defect", "floor"):
        part = defects_of(scene)[selected]
        if field.part == "floor":
            part = part.floor if isinstance(part.floor, RoughFloor) else FIRST_ROUGHNESS
    else:
        part = getattr(scene, field.part, scene.bearing)
        if field.part == "second":
            part = part.rows[1] if len(part.rows) == 2 else None
        elif field.name == "inner_groove_radius":
            return scene.bearing.groove_radius("inner")
    value: float | None = getattr(part, field.name, None)
    return value


def shown_number(field: Field, si: float | None) -> float:
    """A number in SI as the page shows it; NaN for one left open."""
    return math.nan if si is None else _divided(si, field.factor)


@lru_cache(4096)  # every change of a slider asks for all numbers of the page
def _divided(si: float, factor: float) -> float:
    # 12 digits hide the rounding of a division by π
    return float(f"{si / factor:.12g}")


def si_number(field: Field, value: float) -> float | None:
    """A number of the page in SI; None for NaN, a number left open."""
    if math.isnan(value):
        return None
    parts = round(1.0 / field.factor)
    # 50 µm are 5e-05 m: a division by 1e6 gives just that, a product with 1e-6 does not
    return value / parts if parts in (1_000, 1_000_000) else value * field.factor


def scene_with_fields(scene: Scene, fields: Mapping[str, Any], selected: int = 0) -> Scene:
    """Change fields of a scene by their names; fields of a defect in the `selected` one."""
    of_defect = {name: fields[name] for name in fields if name in _OF_DEFECT}
    others = {name: fields[name] for name in fields if name not in of_defect}
    defects = list(defects_of(scene))
    if of_defect:
        single = Scene.replace(scene, defect=defects[selected]).replace(**of_defect)
        assert isinstance(single.defect, Defect)
        defects[selected] = single.defect
        others["defect"] = defects[0] if len(defects) == 1 else tuple(defects)
    return scene.replace(**others) if others else scene


def differ(a: float, b: float) -> bool:
    """True if two numbers of fields differ; NaN (left open) equals NaN."""
    return a != b and not (math.isnan(a) and math.isnan(b))


def limits_of(base: Scene) -> dict[str, Range]:
    """Ranges that suit a preset, by key: for example loads up to a few times its load."""
    values = values_of(base)
    return {field.key: field.range_for(base, values[field.key]) for field in SHOWN_FIELDS}


def groove_limits(scene: Scene) -> dict[str, Range]:
    """Ranges that depend on the ball of a scene, by key."""
    names = ("inner_groove_radius_mm", "outer_groove_radius_mm")
    return {name: FIELD_BY_KEY[name].range_for(scene, math.nan) for name in names}


def read(key: str, typed: object, limits: Mapping[str, Range]) -> float:
    """Read the number that a person typed for a field; ValueError with a sentence for the page."""
    if key not in FIELD_BY_KEY:
        raise ValueError("There is no such quantity.")
    field = FIELD_BY_KEY[key]
    least, most = limits[key].allowed
    text = str(typed)[:80].strip()[:40]
    if field.optional and text in ("", "None"):
        return math.nan
    try:
        value = typed if isinstance(typed, float) else read_number(text, field.shown_unit)
    except ValueError:
        value = math.nan
    low, high = sorted((field.read_sign * least, field.read_sign * most))
    span = f"{with_unit(low, '')} to {with_unit(high, field.shown_unit)}"
    if not math.isfinite(value):
        units = units_like(field.shown_unit) if re.match(r"[+−-]?[\d.,]", text) else []
        in_units = f" in {', '.join(units)}" if len(units) > 1 else ""
        shown = f"“{text}” is not a number{in_units}" if text else "A number is missing"
        raise ValueError(f"{shown}: {label_inside(field)} goes from {span}.")
    if not least <= value <= most:
        shown = with_unit(field.read_sign * value, field.shown_unit)
        is_rpm = field.shown_unit == "Hz" and text[-1:].isdecimal() and least <= value / 60 <= most
        question = f" Did you mean {text} rpm?" if is_rpm else ""
        raise ValueError(
            f"{shown} is out of range: {label_inside(field)} goes from {span}.{question}"
        )
    return value


def second_units(scene: Scene, selected: int) -> dict[str, dict[str, Any]]:
    """Second units of quantities, by key: unit, words, and factor from the first unit.

    A groove radius is also a ratio to the ball, a clearance also diametral, a speed also in turns
    a minute, an extent also in millimetres along the race.
    """
    defect = defects_of(scene)[selected]
    on_race = 1e3 * defect.raceway_radius(scene.bearing) * math.pi / 180.0
    ball = 1e3 * scene.bearing.ball_diameter

    groove = ("× ball", "groove radius over ball diameter", 1.0 / ball)
    units = {
        "extent_deg": ("mm", "along the race", on_race),
        "shaft_speed_hz": ("rpm", "turns a minute", 60.0),
        "radial_clearance_um": ("µm dia.", "diametral clearance", 2.0),
        "inner_groove_radius_mm": groove,
        "outer_groove_radius_mm": groove,
    }
    names = ("unit", "words", "factor")
    return {key: dict(zip(names, unit, strict=True)) for key, unit in units.items()}
