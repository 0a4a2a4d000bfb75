"""A bearing as it may be given: itself, as one of a table, or by its name or number."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TypeAlias

from bearingcore.bearings._bearing import Bearing
from bearingcore.bearings._catalogue import CatalogueBearing, catalogue
from bearingcore.bearings._designation import Designation, read_designation
from bearingcore.bearings._designation_tables import boundaries
from bearingcore.common import _checks as checks

BearingLike: TypeAlias = Bearing | CatalogueBearing | Designation | str
"""Values that `bearing_of` takes."""

WANTED = (
    'a Bearing, a designation such as "6205", a name out of catalogue(), or what '
    "read_designation or a table of bearings gives"
)


def bearing_of(value: BearingLike) -> Bearing:
    """The bearing that is meant by a value where a bearing is wanted.

    Parameters
    ----------
    value
        a bearing; one of a table or of `read_designation`; or text: its name in `catalogue()`, else
        its designation.

    Raises
    ------
    ValueError
        for text that is neither; of a value of another type it is a TypeError too.
    """
    if isinstance(value, str):
        value = catalogue().get(value) or read_designation(value)
    if isinstance(value, CatalogueBearing | Designation):
        return value.bearing
    return checks.instance("bearing", value, Bearing, WANTED)


_ANGLES, _CLEARANCES = ("", " B", " C", " AC"), ("", "/C2", "/C3", "/C4", "/C5")
"""Suffixes of contact angles, and of classes of clearance."""


def name_of(bearing: Bearing) -> str:
    """The text by which `bearing_of` makes a bearing; empty without one.

    Of a bearing that a number gives but for its clearance, which is of no class, that number.
    """
    for name, entry in catalogue().items():
        if entry.bearing == bearing:
            return name
    for name in (f"{basic}{angle}" for basic in _alike(bearing) for angle in _ANGLES):
        made = _made(name)
        if made and made.replace(radial_clearance=bearing.radial_clearance) == bearing:
            whole = (f"{name}{suffix}" for suffix in _CLEARANCES)
            return next((name for name in whole if _made(name) == bearing), name)
    return ""


def _made(name: str) -> Bearing | None:
    try:
        return bearing_of(name)
    except ValueError:
        return None


def _alike(bearing: Bearing) -> Iterator[str]:
    """Basic numbers of bearings about as large with about this rating: it follows the angle."""
    rating = bearing.dynamic_load_rating or math.inf
    for basic, size in boundaries().items():
        middle = 0.5 * (size.bore + size.outside_diameter)
        alike = abs(bearing.pitch_diameter / middle - 1.0) < 0.1
        if alike and 0.7 < rating / size.dynamic_rating < 1.5:
            yield basic
