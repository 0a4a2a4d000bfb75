"""Refusals as sentences of the page, and numbers as a person types them.

Fields are named by their labels, and numbers are in the units of the page.
"""

from __future__ import annotations

import math
import re

from bearingcore.common import number, span
from bearingcore.errors import FieldError
from bearingcore.fields import FIELD_OF, Field
from bearingcore.units import UNITS, read_number

_READ_UNITS = {"m": "mm", "rad": "°", "rad/s": "Hz", "Pa": "GPa"}
"""Shown units of SI numbers that belong to no field."""

_GROOVES = ("inner_groove_radius", "outer_groove_radius")


def sentence_of(error: ValueError) -> str:
    """Return a refusal as a sentence. A refusal of the page itself is a sentence already."""
    words = words_of(error)
    whole = str(error) == f"{words}."
    return str(error) if whole else f"Not possible: {words}."


def words_of(error: ValueError) -> str:
    """A refusal in the words of the page, without a full stop, to stand inside a sentence.

    "shaft_speed is -1; allowed: a finite number at least 0" is "shaft speed is −0.15915 Hz;
    allowed: a finite number at least 0 Hz". A shaft may stand still, so a speed of 0 is refused
    only where the shaft has to turn; the words then say that.
    """
    if not isinstance(error, FieldError):
        return str(error).removesuffix(".")
    if error.field == "shaft_speed" and error.value == 0.0:
        return "the shaft speed is 0 Hz, so nothing turns"
    if error.field in _GROOVES and error.value is None:
        return "the groove radii are not known; enter them on the Machine tab, under Bearing"
    field = field_of(error)
    si = error.unit or (field.unit if field else "")

    def amount(value: float, unit: str) -> str:
        return _amount(value, unit or si, field)

    value = amount(error.value, si) if isinstance(error.value, int | float) else error.value_text
    where = "".join(f"{part}: " for part in error.where)
    return f"{where}{name_of(error.field)} is {value}; allowed: " + error.allowed_words(
        name_of, amount
    )


def field_of(error: ValueError) -> Field | None:
    """Return the field that a refusal is about; None if the page has no such field."""
    if not isinstance(error, FieldError):
        return None
    second = FIELD_OF.get(f"second_{error.field}") if "row 2" in error.where else None
    return second or FIELD_OF.get(error.field)


def name_of(name: str) -> str:
    """The label of a field inside a sentence; another name without its underscores."""
    field = FIELD_OF.get(name)
    return name.replace("_", " ") if field is None else label_inside(field)


def label_inside(field: Field) -> str:
    """The label of a field inside a sentence: small, unless it is a person's name."""
    label = field.read_label
    return label if label.startswith(("Young", "Poisson")) else label[0].lower() + label[1:]


def one_line(text: str, longest: int) -> str:
    """Put untrusted text on one line: printable characters, at most `longest` of them."""
    clean = "".join(sign if sign.isprintable() else " " for sign in text[: 4 * longest])
    return " ".join(clean.split())[:longest].rstrip()


def with_unit(value: float, unit: str, digits: int = 6) -> str:
    """A number with the unit of the page behind it: "12 mm", "3°"."""
    return number(value, digits) + (unit if unit in ("", "°") else f" {unit}")


def _amount(value: float, si: str, field: Field | None) -> str:
    """Write an SI number in the page's unit for the field, or for numbers of that SI unit."""
    unit = _READ_UNITS.get(si, si)
    if field is not None and field.unit == si:
        unit = field.shown_unit
    unit = "" if unit == "1" else unit
    value *= field.read_sign if field is not None else 1.0
    return with_unit(value / UNITS[unit].factor if unit in UNITS else value, unit, 5)


def number_of(text: str, words: str, unit: str, least: float, most: float) -> float:
    """Read a typed number, in `unit` or another unit of its kind; ValueError otherwise."""
    bare = re.sub(r"(?<=\d)[\s'](?=\d{3}\b)", "", text.strip()).replace("−", "-")
    if unit:
        bare = re.sub(rf"(?<=[\d.,\s]){re.escape(unit)}$", "", bare, flags=re.IGNORECASE).rstrip()
    if not bare:
        raise ValueError(f"{words} is missing: type it in{f' ({unit})' if unit else ''}.")
    try:
        value = read_number(bare, unit)
    except ValueError:
        raise ValueError(f"{words} must be a number, not “{text[:20]}”.") from None
    if not math.isfinite(value) or not least <= value <= most:
        allowed = (
            span(least, most, unit, 6).rstrip()
            if math.isfinite(most)
            else f"at least {number(least, 6)} {unit}".rstrip()
        )
        raise ValueError(f"{words} is {number(value, 6)}; possible: {allowed}.")
    return value
