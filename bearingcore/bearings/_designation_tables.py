"""Tables of designations: boundary dimensions, ratings, and classes of clearance.

The heads of the CSV files name the sources of their numbers.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import NamedTuple

from bearingcore.bearings._suffix import (
    CLEARANCE_CLASSES,
    DEEP_GROOVE,
    ROLLERS,
    SELF_ALIGNING_BALLS,
)
from bearingcore.common import _checks as checks

_CLEARANCE_KIND = {DEEP_GROOVE: "ball", SELF_ALIGNING_BALLS: "self-aligning", ROLLERS: "roller"}


class Boundary(NamedTuple):
    """A line of the table of designations, in SI units; NaN where a series has no such number."""

    bore: float
    outside_diameter: float
    width: float
    dynamic_rating: float
    static_rating: float
    factor: float
    inner_raceway: float
    outer_raceway: float
    axial_factor: float
    cone_width: float
    cup_width: float
    thrust_limit: float
    pressure_center: float


_UNITS = Boundary(1e-3, 1e-3, 1e-3, 1e3, 1e3, 1.0, 1e-3, 1e-3, 1.0, 1e-3, 1e-3, 1.0, 1e-3)
"""Factors from the columns of the table to SI."""


@cache
def boundaries() -> Mapping[str, Boundary]:
    """Return boundary dimensions and ratings by basic number."""
    table = {}
    for row in rows_of("designations.csv"):
        values = [float(cell) if cell else math.nan for cell in list(row.values())[1:]]
        scaled = (value * unit for value, unit in zip(values, _UNITS, strict=True))
        table[row["designation"]] = Boundary(*scaled)
    return table


def series_of(basic: str) -> str:
    """Return the series of a basic number: 62 for 6208 and for 628, NU2 for NU208."""
    return basic[: -1 if len(basic) == 3 else -2]


def clearance(kind: str, bore: float, clearance_class: str) -> tuple[float, float]:
    """Return the least and the greatest radial internal clearance [m] of ISO 5753-1.

    It is measured from contact to contact of a bearing as delivered; fits and heat reduce it.

    Parameters
    ----------
    kind
        DEEP_GROOVE, SELF_ALIGNING_BALLS or ROLLERS.
    bore
        [m], cylindrical.
    clearance_class
        out of CLEARANCE_CLASSES.

    Raises
    ------
    ValueError
        for a kind or a bore that the table does not have.
    """
    checks.choice("clearance class", clearance_class, CLEARANCE_CLASSES)
    name = _CLEARANCE_KIND[checks.choice("kind", kind, tuple(_CLEARANCE_KIND))]
    for row in rows_of("clearances.csv"):
        over, up_to = float(row["bore_over_mm"]), float(row["bore_up_to_mm"])
        if row["kind"] == name and over < 1e3 * bore <= up_to * (1.0 + 1e-9):
            least, most = map(float, row[clearance_class].split())
            return 1e-6 * least, 1e-6 * most
    raise checks.refuse("bore", bore, "6 to 100 mm, where clearance classes are tabulated", "m")


def matched_clearance(bore: float, name: str) -> tuple[float, float]:
    """Return the least and the greatest axial clearance [m] of a matched angular-contact pair.

    Below 0 it is a preload. `bore` in m; `name` is the class, "CA", "CB", "CC", "GA", "GB" or "GC"
    (SKF). ValueError for a bore that the table does not have.
    """
    for row in rows_of("matched_clearances.csv"):
        if float(row["bore_over_mm"]) < 1e3 * bore <= float(row["bore_up_to_mm"]) * (1.0 + 1e-9):
            least, most = map(float, row[name].split())
            return 1e-6 * least, 1e-6 * most
    raise checks.refuse("bore", bore, "6 to 120 mm, where classes of pairs are tabulated", "m")


@cache
def rows_of(name: str) -> list[dict[str, str]]:
    """Return the lines of a table of this package, each with its cells by heading."""
    text = resources.files("bearingcore.bearings").joinpath(name).read_text("utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter=";"))
