"""Public collections of bearing signals: marks of their files, and facts from their documents.

Their files lack facts that are in their documents. A fact of a recognised collection is a good
guess with a reason: it is used at once and can be changed. A collection is one row or several of
COLLECTIONS; the first row whose marks all fit is taken.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from bearingcore.measured.files._facts import Finding, Named


@dataclass(frozen=True)
class Collection:
    """A row: marks by which files are recognised, and facts about them.

    Attributes
    ----------
    name
        name of the collection.
    clue
        words for the mark that is stated as the reason: "columns" as in the collection.
    variable
        regular expression of the whole name of a column.
    scalars
        last parts of the names of required single numbers.
    width, clock
        number of columns, and of those with hours, minutes, seconds, fractions of seconds.
    unit, sample_rate, rpm
        unit of the acceleration, sample rate [Hz], shaft speed [turns a minute].
    bearing
        a name of the catalogue, or a designation.
    place
        place of the sensor at the bearing, if there are several.
    directions
        directions of the last columns.
    """

    name: str
    clue: str
    variable: str = ""
    scalars: tuple[str, ...] = ()
    width: int | None = None
    clock: int | None = None
    unit: str = ""
    sample_rate: float | None = None
    rpm: float | None = None
    bearing: str = ""
    place: str = ""
    directions: tuple[str, ...] = ()

    @property
    def why(self) -> str:
        """The reason for facts of the collection, in a few words; empty without a collection."""
        return f"{self.clue} as in the {self.name} collection" if self.name else ""

    def guess(self, fact: str, words: str = "", factor: float = 1.0, unit: str = "") -> Any:
        """Return a fact times `factor` as a `Finding` with further words; None if it is missing."""
        value = getattr(self, fact)
        if not value:
            return None
        value = value if isinstance(value, str) else factor * value
        return Finding(value, self.why + words, stated=False, strong=True, file_unit=unit)


_CASE_WESTERN = "Case Western Reserve"
_ALL_OF_CASE_WESTERN: Any = {"unit": "g", "clue": "variables named", "rpm": 1764.0}
"""Speeds are from 1730 to 1797 rpm, depending on the load; most files state them."""
_ENDS = "_(DE|FE|BA)_time"
_DRIVE_END: Any = {"bearing": "6205-2RS, CWRU drive end", "place": "drive end"}
_AT_48_KHZ = (
    "09[789]|100|109|11[0-2]|12[2-5]|13[5-8]|148|149|15[01]|16[1-4]|17[4-7]|189|19[0-2]"
    "|20[1-4]|21[3-7]|22[6-9]|23[89]|24[01]|25[0-4]|26[2-5]"
)

COLLECTIONS = (
    Collection(
        _CASE_WESTERN, **_ALL_OF_CASE_WESTERN, variable=f"X({_AT_48_KHZ}){_ENDS}",
        sample_rate=48_000.0, **_DRIVE_END,
    ),
    Collection(
        _CASE_WESTERN, **_ALL_OF_CASE_WESTERN, variable=f"X(2[789]|3[01])\\d{_ENDS}",
        sample_rate=12_000.0, bearing="6203-2RS, CWRU fan end", place="fan end",
    ),
    Collection(
        _CASE_WESTERN, **_ALL_OF_CASE_WESTERN, variable=f"X\\d{{3}}{_ENDS}",
        sample_rate=12_000.0, **_DRIVE_END,
    ),
    Collection(
        "MFPT", "fields", variable=r"(.*\.)?gs", scalars=("sr", "rate"), unit="g",
        bearing="NICE, MFPT",
    ),
    Collection(
        "FEMTO-ST", "columns", width=6, clock=4, unit="g", sample_rate=25_600.0,
        bearing="6804RS, FEMTO-ST", directions=("x", "y"),
    ),
)  # fmt: skip
"""The facts are from the collections' own documents, and from programs that read their files."""


def recognize(names: Sequence[str], clock: int, named: Sequence[Named]) -> Collection:
    """Return the collection whose marks a file has; an empty one if there is none.

    Parameters
    ----------
    names
        names of all columns.
    clock
        number of first columns with hours, minutes, seconds and fractions of seconds.
    named
        the single numbers of the file.
    """
    ends = {item.name.rpartition(".")[2] for item in named}
    for row in COLLECTIONS:
        if (
            any(re.fullmatch(row.variable or ".*", name) for name in names)
            and ends >= set(row.scalars)
            and row.width in (None, len(names))
            and row.clock in (None, clock)
        ):
            return row
    return Collection("", "")
