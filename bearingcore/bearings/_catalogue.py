"""Tables of bearings by name: inside dimensions in a CSV file, which a workshop can write itself.

A table has a line of headings and a line for each bearing. Columns, in any order:

- `name`, `balls`, `ball_diameter_mm`, `pitch_diameter_mm`: needed;
- `inner_groove_radius_mm` or `inner_groove_ratio` (radius over ball diameter), the same for the
  outer race: 0.52 and 0.53 ball diameters where empty;
- `contact_angle_deg`: 0 where empty;
- `diametral_clearance_um`: in addition to the contact angle. Where empty: 0 with a contact angle,
  else 10 µm, about the middle of the normal class of ISO 5753 for bores up to 40 mm;
- `dynamic_load_rating_kn`, `note`: may stay empty.

Columns are separated by semicolons, commas or tabs. If they are not separated by commas, numbers
may have a decimal comma. Empty lines and lines that begin with # are skipped. Each bearing lists
the values assumed for its empty cells. A table with a fault is refused as a whole; the error names
the line and the column of the first fault.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from types import MappingProxyType

from bearingcore.bearings._bearing import Bearing
from bearingcore.bearings._drawing import USUAL_GROOVES
from bearingcore.common import _checks as checks
from bearingcore.errors import FieldError

NEEDED_COLUMNS = ("name", "balls", "ball_diameter_mm", "pitch_diameter_mm")

CATALOGUE_COLUMNS = (
    *NEEDED_COLUMNS,
    "inner_groove_radius_mm",
    "inner_groove_ratio",
    "outer_groove_radius_mm",
    "outer_groove_ratio",
    "contact_angle_deg",
    "diametral_clearance_um",
    "dynamic_load_rating_kn",
    "note",
)

USUAL_CLEARANCE_UM = 10.0

_SEPARATORS = (";", "\t", ",")
"""Separators of columns; the most frequent one in the headings is taken."""


@dataclass(frozen=True)
class CatalogueBearing:
    """A bearing of a table.

    Attributes
    ----------
    name
        of the bearing in the table.
    bearing
        with groove radii, steel on steel.
    dynamic_load_rating
        C_r [N] as stated in the table, or None.
    note
        source of the numbers, as stated in the table.
    assumed
        values assumed for empty cells, in words.
    unread
        letters of a designation without a known meaning.
    """

    name: str
    bearing: Bearing
    dynamic_load_rating: float | None = None
    note: str = ""
    assumed: tuple[str, ...] = ()
    unread: str = ""


@lru_cache(maxsize=1)
def catalogue() -> Mapping[str, CatalogueBearing]:
    """Return the bearings whose inside dimensions are published, by name; notes give the source."""
    text = resources.files("bearingcore.bearings").joinpath("bearings.csv").read_bytes()
    return MappingProxyType(read_catalogue(text))


def read_catalogue(table: str | bytes) -> dict[str, CatalogueBearing]:
    """Read the bearings of a CSV text, by name, in its order. See the head of the module.

    Raises
    ------
    ValueError
        naming the first fault by line and column, with its text and the allowed values.
    """
    lines = [
        (number, line)
        for number, line in enumerate(_decode(table).splitlines(), start=1)
        if line.strip(" \t;,") and not line.lstrip().startswith("#")
    ]
    if len(lines) < 2:
        raise checks.refuse("table of bearings", "empty", "headings, and a line for each bearing")
    separator = max(_SEPARATORS, key=lines[0][1].count)
    try:
        texts = (line for _, line in lines)
        rows = csv.reader(texts, delimiter=separator, strict=True, skipinitialspace=True)
        headings, *cells = [[cell.strip() for cell in row] for row in rows]
    except csv.Error as error:
        raise checks.refuse("table of bearings", str(error), "cells that csv can read") from None
    columns = _columns(headings)
    entries: dict[str, CatalogueBearing] = {}
    for (number, _), row in zip(lines[1:], cells, strict=False):
        place = f"table of bearings: line {number}"
        if any(row[len(columns) :]):
            hint = "; numbers with a decimal comma need semicolons between columns"
            allowed = f"{len(columns)}, as headings{hint if separator == ',' else ''}"
            raise checks.refuse(f"number of cells in {place}", len(row), allowed)
        row += [""] * (len(columns) - len(row))
        entry = _bearing(place, dict(zip(columns, row, strict=False)), separator != ",")
        if entry.name in entries:
            raise checks.refuse(f"{place}, column name", entry.name, "a different name for each")
        entries[entry.name] = entry
    return entries


def _decode(table: str | bytes) -> str:
    if isinstance(table, str):
        return table.removeprefix("\ufeff")
    try:
        return table.decode("utf-8-sig")
    except UnicodeDecodeError:
        return table.decode("cp1252", errors="replace")  # what spreadsheets in Europe write


def _columns(headings: list[str]) -> list[str]:
    """Return the columns out of CATALOGUE_COLUMNS that headings name; FieldError for any other."""
    plain = (heading.lower().replace("µ", "u").replace("-", " ") for heading in headings)
    names = ["_".join(heading.split()) for heading in plain]
    while names and not names[-1]:
        names.pop()
    for position, name in enumerate(names):
        if name not in CATALOGUE_COLUMNS or name in names[:position]:
            allowed = f"each of these once: {', '.join(CATALOGUE_COLUMNS)}"
            raise checks.refuse(f"heading of column {position + 1}", headings[position], allowed)
    if missing := [name for name in NEEDED_COLUMNS if name not in names]:
        allowed = f"{', '.join(NEEDED_COLUMNS)}, and any others"
        raise checks.refuse("headings of the table", f"without {', '.join(missing)}", allowed)
    return names


def _bearing(place: str, texts: Mapping[str, str], decimal_comma: bool) -> CatalogueBearing:
    """Return the bearing of a line from its cells by column; `place` names the line in errors."""
    assumed: list[str] = []

    def refused(column: str, allowed: str) -> FieldError:
        return checks.refuse(f"{place}, column {column}", texts.get(column, ""), allowed)

    def number(column: str) -> float | None:
        """Return the number in a column; None where an optional cell is empty."""
        text, needed = texts.get(column, ""), column in NEEDED_COLUMNS
        if not text and not needed:
            return None
        plain = text.replace(",", ".") if decimal_comma else text
        try:
            value = float(plain) if "_" not in plain else math.nan
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise refused(column, "a number" if needed else "a number, or nothing")
        return value

    def groove(race: str) -> float:
        """Return the groove radius [mm] of a race, by its radius or its ratio; else the usual."""
        names = f"{race}_groove_radius_mm", f"{race}_groove_ratio"
        radius, ratio = map(number, names)
        if radius is not None and ratio is not None:
            raise refused(names[1], f"nothing where {names[0]} is given")
        if radius is not None:
            return radius
        if ratio is None:
            ratio = USUAL_GROOVES[race]
            assumed.append(f"an {race} groove of {ratio:g} ball diameters")
        return ratio * ball

    name, note = texts["name"], texts.get("note", "")
    if not name:
        raise refused("name", "a name")
    balls, ball, pitch = (number(column) or 0.0 for column in NEEDED_COLUMNS[1:])
    inner, outer = map(groove, USUAL_GROOVES)
    angle, clearance, rating = map(
        number, ("contact_angle_deg", "diametral_clearance_um", "dynamic_load_rating_kn")
    )
    if not (rating is None or rating > 0.0):
        raise refused("dynamic_load_rating_kn", "a number above 0 [kN], or nothing")
    if angle is None:
        angle = 0.0
        assumed.append("a contact angle of 0°")
    if clearance is None:
        clearance = 0.0 if angle else USUAL_CLEARANCE_UM
        assumed.append(f"a diametral clearance of {clearance:g} µm")
    rating_in_newton = None if rating is None else rating * 1e3
    try:
        bearing = Bearing.from_drawing(
            balls,  # type: ignore[arg-type]  # fractions are refused there
            ball / 1e3,
            pitch / 1e3,
            inner / 1e3,
            outer / 1e3,
            contact_angle=math.radians(angle),
            diametral_clearance=clearance / 1e6,
        ).replace(dynamic_load_rating=rating_in_newton)
    except FieldError as error:
        raise error.inside(
            f"{place}, column {_COLUMN_OF_FIELD.get(error.field, error.field)}"
        ) from None
    return CatalogueBearing(name, bearing, rating_in_newton, note, tuple(assumed))


_COLUMN_OF_FIELD = {
    "n_balls": "balls",
    "ball_diameter": "ball_diameter_mm",
    "pitch_diameter": "pitch_diameter_mm",
    "inner_groove_radius": "inner_groove_radius_mm or inner_groove_ratio",
    "outer_groove_radius": "outer_groove_radius_mm or outer_groove_ratio",
    "contact_angle": "contact_angle_deg",
    "diametral_clearance": "diametral_clearance_um",
}
