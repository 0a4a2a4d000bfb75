"""Tables of bearings by name: inside dimensions as a CSV, which a workshop can write for itself.

A table has a line of headings and a line for each bearing. Columns, in any order:

- `name`, `balls`, `ball_diameter_mm`, `pitch_diameter_mm`: needed;
- `inner_groove_radius_mm` or `inner_groove_ratio` (radius over ball diameter), the same for the
  outer race: 0.52 and 0.53 ball diameters where empty;
- `contact_angle_deg`: 0 where empty;
- `diametral_clearance_um`: on top of the contact angle. Where empty 0 with a contact angle, else
  10 µm, about the middle of the normal class of ISO 5753 for bores up to 40 mm;
- `dynamic_load_rating_kn`, `note`: may stay empty.

Columns are parted by semicolons, commas or tabs; decimals may have a comma where columns do not.
Empty lines and lines that begin with # are passed over. What was assumed for an empty cell is said
with each bearing. A table with a fault is refused as a whole, the first one named by line and
column.
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

MOST_BYTES = 2**20
MOST_BEARINGS = 2000
LONGEST_NAME, LONGEST_NOTE = 80, 2000

_SEPARATORS = (";", "\t", ",")
"""Of columns; the most frequent one in the headings is taken."""


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
    """Bearings by name whose inside dimensions are published, each with its source in its note."""
    text = resources.files("bearingcore.bearings").joinpath("bearings.csv").read_bytes()
    return MappingProxyType(read_catalogue(text))


def read_catalogue(table: str | bytes) -> dict[str, CatalogueBearing]:
    """Read the bearings of a CSV text, by name, in its order. See the head of the module.

    Raises
    ------
    ValueError
        naming the first fault by line and column, with its text and the allowed values.
    """
    lines = _lines(_text(table))
    if not lines:
        raise checks.refuse("table of bearings", "empty", "a line of headings and one a bearing")
    separator = max(_SEPARATORS, key=lines[0][1].count)
    rows = [(number, _cells(number, line, separator)) for number, line in lines]
    headings = _headings(*rows[0])
    if len(rows) - 1 > MOST_BEARINGS:
        raise checks.refuse(
            "table of bearings", f"{len(rows) - 1} bearings long", f"at most {MOST_BEARINGS}"
        )
    entries: dict[str, CatalogueBearing] = {}
    for number, cells in rows[1:]:
        at = f"table of bearings: line {number}"
        entry = _bearing(at, _label_cells(at, headings, cells, separator), separator != ",")
        if entry.name in entries:
            raise checks.refuse(f"{at}, column name", entry.name, "a name of its own for each")
        entries[entry.name] = entry
    if not entries:
        raise checks.refuse("table of bearings", "headings alone", "a line for each bearing")
    return entries


def _text(table: str | bytes) -> str:
    size = len(table)
    if size > MOST_BYTES:
        raise checks.refuse("table of bearings", f"{size} bytes long", f"at most {MOST_BYTES}")
    if isinstance(table, str):
        return table.removeprefix("\ufeff")
    try:
        return table.decode("utf-8-sig")
    except UnicodeDecodeError:
        return table.decode("cp1252", errors="replace")  # what spreadsheets in Europe write


def _lines(text: str) -> list[tuple[int, str]]:
    """Lines that say something, with their numbers from 1."""
    return [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip(" \t;,") and not line.lstrip().startswith("#")
    ]


def _cells(number: int, line: str, separator: str) -> list[str]:
    try:
        row = next(csv.reader([line], delimiter=separator, strict=True, skipinitialspace=True))
    except csv.Error as error:
        raise ValueError(f"table of bearings: line {number} cannot be read ({error})") from None
    return [cell.strip() for cell in row]


def _headings(number: int, cells: list[str]) -> list[str]:
    names = ["_".join(cell.lower().replace("µ", "u").split()).replace("-", "_") for cell in cells]
    while names and not names[-1]:
        names.pop()
    allowed = ", ".join(CATALOGUE_COLUMNS)
    for position, name in enumerate(names, start=1):
        if name not in CATALOGUE_COLUMNS:
            raise checks.refuse(
                f"heading of column {position} (line {number})", cells[position - 1], allowed
            )
        if names.count(name) > 1:
            raise checks.refuse(f"heading {name} (line {number})", "there twice", "once")
    missing = [name for name in NEEDED_COLUMNS if name not in names]
    if missing:
        others = CATALOGUE_COLUMNS[len(NEEDED_COLUMNS) :]
        raise checks.refuse(
            f"table of bearings, headings in line {number}",
            f"without {', '.join(missing)}",
            f"{', '.join(NEEDED_COLUMNS)}, and of the others any: {', '.join(others)}",
        )
    return names


def _label_cells(at: str, headings: list[str], cells: list[str], separator: str) -> dict[str, str]:
    """The cells of a line by their headings; those at its end may be missing."""
    while len(cells) > len(headings) and not cells[-1]:
        cells.pop()
    if len(cells) > len(headings):
        hint = "; numbers with a decimal comma need semicolons between columns"
        raise checks.refuse(
            f"number of cells in {at}",
            len(cells),
            f"{len(headings)}, as headings{hint if separator == ',' else ''}",
        )
    return dict(zip(headings, cells + [""] * (len(headings) - len(cells)), strict=True))


def _bearing(at: str, texts: Mapping[str, str], decimal_comma: bool) -> CatalogueBearing:
    """The bearing of a line, whose cells are given by column; `at` is its place in words."""
    assumed: list[str] = []

    def refused(column: str, allowed: str) -> FieldError:
        return checks.refuse(f"{at}, column {column}", texts.get(column, ""), allowed)

    def number(column: str) -> float | None:
        """The number in a column; None where it is empty and may be."""
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
        """Groove radius [mm] of a race, by its radius or its ratio, or as it is usual."""
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
    if not name or len(name) > LONGEST_NAME:
        raise refused("name", f"a name of 1 to {LONGEST_NAME} characters")
    if len(note) > LONGEST_NOTE:
        raise refused("note", f"at most {LONGEST_NOTE} characters")
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
            balls,  # type: ignore[arg-type]  # it refuses what is no whole number
            ball / 1e3,
            pitch / 1e3,
            inner / 1e3,
            outer / 1e3,
            contact_angle=math.radians(angle),
            diametral_clearance=clearance / 1e6,
        ).replace(dynamic_load_rating=rating_in_newton)
    except FieldError as error:
        raise error.inside(
            f"{at}, column {_COLUMN_OF_FIELD.get(error.field, error.field)}"
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
