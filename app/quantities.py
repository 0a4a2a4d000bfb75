"""What can be set on the page: names, units, ranges, and the way to a Scene and back.

Degrees, micrometres and hertz live here and in the browser; behind this module all is SI.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from bearingcore import Scene

Values = dict[str, float]
"""A value for each quantity, in the unit of its name."""


@dataclass(frozen=True)
class Quantity:
    """One number of the page.

    `field` is the name `Scene.replace` knows it by (empty: not part of the scene), `unit_si` how
    much one unit is in SI, `symbol` and `about` may hold simple HTML.
    """

    name: str
    field: str
    label: str
    symbol: str
    unit: str
    unit_si: float
    group: str
    about: str


@dataclass(frozen=True)
class Limits:
    """What a quantity may be, and how far one step of its slider goes, in its own unit."""

    least: float
    most: float
    step: float


DEGREE = math.pi / 180.0
CAGE_ANGLE = "cage_angle_deg"

_QUANTITIES = (
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
        "Where its middle is. 0° is right, 90° up, 270° down, where the weight of a rotor acts.",
    ),
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

QUANTITIES: Mapping[str, Quantity] = {quantity.name: quantity for quantity in _QUANTITIES}
"""All quantities by name, in the order of the page."""


def values_of(scene: Scene) -> Values:
    """The numbers of a scene as the page shows them, at cage angle 0."""
    defect = scene.defects[0] if scene.defects else None
    si = {
        "extent": defect.extent if defect else 0.0,
        "depth": defect.depth if defect else 0.0,
        "center": defect.center if defect else 0.0,
        "fx": scene.load.fx,
        "fy": scene.load.fy,
        "fz": scene.load.fz,
        "mx": scene.load.mx,
        "my": scene.load.my,
        "shaft_speed": scene.shaft_speed,
        "": 0.0,
    }
    # The last digits of π have no business on a page.
    return {q.name: float(f"{si[q.field] / q.unit_si:.12g}") for q in _QUANTITIES}


def scene_with(base: Scene, values: Values, **choices: str) -> Scene:
    """`base` with the page's numbers and choices. ValueError where the scene refuses."""
    fields = {q.field: values[q.name] * q.unit_si for q in _QUANTITIES if q.field}
    return base.replace(**fields, **choices)


def limits_of(base: Scene) -> dict[str, Limits]:
    """Ranges that fit a preset: loads up to a few times its own, moments at its pitch radius."""
    load = base.load
    force = _round_up(2.5 * max(abs(load.fx), abs(load.fy), abs(load.fz), 1.0))
    moment = _round_up(0.5 * force * 0.5 * base.bearing.pitch_diameter)
    return {
        "extent_deg": Limits(0.0, 120.0, 0.1),
        "depth_um": Limits(0.0, 500.0, 1.0),
        "center_deg": Limits(0.0, 360.0, 0.5),
        **{name: Limits(-force, force, force / 500.0) for name in ("fx_n", "fy_n", "fz_n")},
        **{name: Limits(-moment, moment, moment / 500.0) for name in ("mx_nm", "my_nm")},
        "shaft_speed_hz": Limits(1.0, 100.0, 0.1),
        CAGE_ANGLE: Limits(0.0, 360.0, 0.1),
    }


def read(name: str, given: object, limits: Mapping[str, Limits]) -> float:
    """The number a person gave for a quantity; ValueError with a sentence for the page."""
    if name not in QUANTITIES:
        raise ValueError("There is no such quantity.")
    quantity, allowed = QUANTITIES[name], limits[name]
    text = str(given).strip()[:40]
    try:
        value = float(text.replace("−", "-").replace(",", "."))
    except ValueError:
        value = math.nan
    unit = _unit(quantity.unit)
    span = f"{allowed.least:g} to {allowed.most:g}{unit}".replace("-", "−")
    if not math.isfinite(value):
        shown = f"“{text}” is not a number" if text else "A number is missing"
        raise ValueError(f"{shown}: {quantity.label.lower()} goes from {span}.")
    if not allowed.least <= value <= allowed.most:
        shown = f"{value:g}{unit}".replace("-", "−")
        raise ValueError(f"{shown} is out of range: {quantity.label.lower()} goes from {span}.")
    return value


def _unit(unit: str) -> str:
    return unit if unit == "°" else f" {unit}"


def _round_up(value: float) -> float:
    """The next number of 1, 2, 5, 10, 20, 50, ... that is not below `value`."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value * 0.999999)
