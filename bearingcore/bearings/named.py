"""A bearing as it may be given: itself, as one of a table, or by its name or number."""

from __future__ import annotations

from typing import TypeAlias

from bearingcore.bearings.bearing import Bearing
from bearingcore.bearings.catalogue import CatalogueBearing, catalogue
from bearingcore.bearings.designation import Designation, read_designation
from bearingcore.common import checks

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
