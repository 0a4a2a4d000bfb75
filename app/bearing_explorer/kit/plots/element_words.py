"""Names of rolling elements (balls or rollers) and of their rows, and sizes of defects."""

from __future__ import annotations

import math
import re

from bearing_explorer.kit.plots import style
from bearingcore import Bearing, Defect

_BALL = re.compile(r"\b([Bb])all(?=s?\b)(?![- ]pass)")


def elements(bearing: Bearing, count: int = 2) -> str:
    """The word for a number of elements."""
    return bearing.kind.element if count == 1 else bearing.kind.elements


def element_name(bearing: Bearing, index: int) -> str:
    """The name of an element; `index` counts from 0 row after row: "ball 3", "ball 3 of row 2"."""
    row, number = bearing.row_of_ball(int(index))
    name = f"{bearing.kind.element} {number + 1}"
    return name if len(bearing.all_rows) == 1 else f"{name} of row {row + 1}"


def row_words(bearing: Bearing, row: int | None) -> str:
    """The row of a defect: ", row 1"; empty for a bearing of one row."""
    if len(bearing.all_rows) == 1:
        return ""
    return ", all rows" if row is None else f", row {row + 1}"


def with_elements_of(bearing: Bearing, text: str) -> str:
    """Return a text about balls in the words of a bearing, whose elements may be rollers.

    "Ball pass" stays: it is the term for rollers too.
    """
    element = bearing.kind.element
    if element == "ball":
        return text
    return _BALL.sub(lambda match: element.title() if match[1] == "B" else element, text)


def extent_words(defect: Defect, bearing: Bearing) -> str:
    """Extent of a defect in degrees and along its race: "12.9° (5.97 mm)"."""
    length = style.with_prefix(defect.extent * defect.raceway_radius(bearing), "m")
    return f"{style.number(math.degrees(defect.extent))}° ({length})"
