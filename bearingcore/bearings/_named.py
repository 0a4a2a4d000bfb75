"""Bearings given as an object, as an entry of a table, by name or by number."""

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
    'a Bearing, a designation such as "6205", a name out of catalogue(), or a result of '
    "read_designation or of a table of bearings"
)


def bearing_of(value: BearingLike) -> Bearing:
    """Return the bearing that an object, a name or a number stands for.

    Parameters
    ----------
    value
        a bearing; one of a table or of `read_designation`; or text: its name in `catalogue()`, else
        its designation.

    Raises
    ------
    ValueError
        for text that is neither; for a value of another type it is a TypeError too.
    """
    if isinstance(value, str):
        value = catalogue().get(value) or read_designation(value)
    if isinstance(value, CatalogueBearing | Designation):
        return value.bearing
    return checks.instance("bearing", value, Bearing, WANTED)


_ANGLES, _CLEARANCES = ("", " B", " C", " AC"), ("", "/C2", "/C3", "/C4", "/C5")
"""Suffixes of contact angles, and of classes of clearance."""


def name_of(bearing: Bearing) -> str:
    """Return the text from which `bearing_of` makes a bearing; empty if there is none.

    If only the clearance differs, and fits no class, this is the number without a class.
    """
    for name, entry in catalogue().items():
        if entry.bearing == bearing:
            return name
    for name in (f"{basic}{angle}" for basic in _similar_numbers(bearing) for angle in _ANGLES):
        named = _bearing_or_none(name)
        if named and named.replace(radial_clearance=bearing.radial_clearance) == bearing:
            with_class = (f"{name}{suffix}" for suffix in _CLEARANCES)
            return next((name for name in with_class if _bearing_or_none(name) == bearing), name)
    return ""


def _bearing_or_none(name: str) -> Bearing | None:
    try:
        return bearing_of(name)
    except ValueError:
        return None


def _similar_numbers(bearing: Bearing) -> Iterator[str]:
    """Yield basic numbers of about this size and rating, which depends on the contact angle."""
    rating = bearing.dynamic_load_rating or math.inf
    for basic, size in boundaries().items():
        middle = 0.5 * (size.bore + size.outside_diameter)
        is_as_large = abs(bearing.pitch_diameter / middle - 1.0) < 0.1
        if is_as_large and 0.7 < rating / size.dynamic_rating < 1.5:
            yield basic
