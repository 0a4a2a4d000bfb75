"""Units: the single table of units for sliders, files, plots, tables and sweeps."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

INCH = 25.4e-3
"""[m]"""

STANDARD_GRAVITY = 9.80665
"""[m/s²]"""


@dataclass(frozen=True)
class Unit:
    """A unit of measurement.

    Attributes
    ----------
    si
        the SI unit of the same kind: "m" for millimetres.
    factor
        factor that converts a number in this unit to the SI unit.
    suffix
        end of a name in this unit: "mm" in ``ball_diameter_mm``.
    """

    si: str
    factor: float = 1.0
    suffix: str = ""


UNITS: Mapping[str, Unit] = {
    "": Unit(""),
    "1": Unit("1"),
    "m": Unit("m", 1.0, "m"),
    "mm": Unit("m", 1e-3, "mm"),
    "µm": Unit("m", 1e-6, "um"),
    "in": Unit("m", INCH, "in"),
    "rad": Unit("rad", 1.0, "rad"),
    "deg": Unit("rad", math.pi / 180.0, "deg"),
    "°": Unit("rad", math.pi / 180.0, "deg"),
    "mrad": Unit("rad", 1e-3, "mrad"),
    "s": Unit("s", 1.0, "s"),
    "ms": Unit("s", 1e-3, "ms"),
    "h": Unit("s", 3600.0, "h"),
    "rad/s": Unit("rad/s", 1.0, "rad_per_s"),
    "Hz": Unit("rad/s", 2.0 * math.pi, "hz"),
    "rpm": Unit("rad/s", math.pi / 30.0, "rpm"),
    "N": Unit("N", 1.0, "n"),
    "kN": Unit("N", 1e3, "kn"),
    "lbf": Unit("N", 4.4482216152605, "lbf"),
    "N·m": Unit("N·m", 1.0, "n_m"),
    "N/m": Unit("N/m", 1.0, "n_per_m"),
    "MN/m": Unit("N/m", 1e6, "mn_per_m"),
    "N/rad": Unit("N/rad", 1.0, "n_per_rad"),
    "N·m/rad": Unit("N·m/rad", 1.0, "n_m_per_rad"),
    "N/m^1.5": Unit("N/m^1.5", 1.0, "n_per_m1_5"),
    "MN/m¹·⁵": Unit("N/m^1.5", 1e6, "mn_per_m1_5"),
    "N·s/m": Unit("N·s/m", 1.0, "n_s_per_m"),
    "N·m·s/rad": Unit("N·m·s/rad", 1.0, "n_m_s_per_rad"),
    "kg": Unit("kg", 1.0, "kg"),
    "kg/m³": Unit("kg/m³", 1.0, "kg_per_m3"),
    "kg·m": Unit("kg·m", 1.0, "kg_m"),
    "g·mm": Unit("kg·m", 1e-6, "g_mm"),
    "kg·m²": Unit("kg·m²", 1.0, "kg_m2"),
    "g·m²": Unit("kg·m²", 1e-3, "g_m2"),
    "m/s": Unit("m/s", 1.0, "m_per_s"),
    "m/s²": Unit("m/s²", 1.0, "m_per_s2"),
    "rad/s²": Unit("rad/s²", 1.0, "rad_per_s2"),
    "(m/s²)²/Hz": Unit("(m/s²)²/Hz", 1.0, "m2_per_s4_per_hz"),
    "(rad/s²)²/Hz": Unit("(rad/s²)²/Hz", 1.0, "rad2_per_s4_per_hz"),
    "Pa": Unit("Pa", 1.0, "pa"),
    "GPa": Unit("Pa", 1e9, "gpa"),
    "dB": Unit("dB", 1.0, "db"),
}
"""All units by the text that follows a number."""


def units_like(unit: str) -> list[str]:
    """Return the units of the same kind as `unit`, including itself."""
    return [name for name, other in UNITS.items() if other.si == UNITS[unit].si]


def factor_between(unit: str, wanted: str) -> float | None:
    """Return the factor from `unit` to `wanted`; None between units of different kinds."""
    start, end = UNITS.get(unit), UNITS.get(wanted)
    if start is None or end is None or start.si != end.si:
        return None
    return start.factor * (1.0 / end.factor)


_SPELLINGS = {
    **{"um": "µm", "μm": "µm", "inch": "in", '"': "in", "″": "in", "degree": "°", "degrees": "°"},
    **{"hz": "Hz", "n": "N", "nm": "N·m", "1/min": "rpm", "min⁻¹": "rpm", "r/min": "rpm"},
    **{"kn": "kN", "khz": "kHz", "mpa": "MPa", "gpa": "GPa", "pa": "Pa", "n/um": "N/µm"},
}
"""Other spellings of units. The second one has the Greek letter μ instead of the micro sign µ."""

_TYPED: Mapping[str, tuple[float, str]] = {
    **{"g": (1e-3, "kg"), "t": (1e3, "kg"), "kgf": (STANDARD_GRAVITY, "N")},
    **{"N/mm": (1e3, "N/m"), "N/µm": (1e6, "N/m"), "N/mm²": (1e6, "Pa"), "cm": (1e-2, "m")},
}
"""Further units that may be typed: multiples of one of `UNITS`."""

_PREFIXES = {"n": 1e-9, "µ": 1e-6, "u": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6, "G": 1e9}
_WITH_PREFIX = frozenset(
    ["m", "s", "g", "Hz", "rad", "N", "N·m", "Nm", "N/m", "N/mm", "N/rad", "N·m/rad", "Pa"]
)
"""Units that may follow a prefix."""

_WITH_UNIT = re.compile(
    r"(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)"
    r"(?:(?: (?P<above>\d+))? ?/ ?(?P<below>\d+))?"
    r" ?(?P<unit>\D.*)?",
    re.IGNORECASE | re.ASCII,
)


def _factor_of(unit: str, wanted: str) -> float | None:
    """Return the factor from a typed unit, also with an SI prefix: "kN", "MPa", "N/mm"."""
    if unit == wanted:
        return 1.0
    spelled = unit if unit in UNITS else _SPELLINGS.get(unit.lower(), unit)
    times, known = _TYPED.get(spelled, (1.0, spelled))
    factor = factor_between(known, wanted)
    if factor is not None:
        return times * factor
    for name in (unit, spelled):
        if name[:1] in _PREFIXES and name[1:] in _WITH_PREFIX:
            factor = _factor_of(name[1:], wanted)
            return None if factor is None else _PREFIXES[name[0]] * factor
    return None


def read_number(text: str, unit: str) -> float:
    """Return a typed number in `unit`: "8 mm", "5/16 in", "12 µm", "0,5", "0.2 MN".

    A number without a unit is already in `unit`.

    Raises
    ------
    ValueError
        for text that is no number, or a number in a unit of another kind.
    """
    plain = " ".join(text.replace("−", "-").replace(",", ".").split())
    match = _WITH_UNIT.fullmatch(plain)
    if match is None:
        raise ValueError(f"“{text}” is not a number")
    value = float(match["number"])
    if match["below"]:
        below = float(match["below"])
        part = float(match["above"] or value) / below if below else math.nan
        value = math.copysign(abs(value) + part, value) if match["above"] else part
    factor = _factor_of((match["unit"] or unit).strip(), unit)
    if factor is None or not math.isfinite(value):
        of_unit = f" in {unit}" if unit else ""
        raise ValueError(f"“{text}” is not a number{of_unit}")
    return value * factor
