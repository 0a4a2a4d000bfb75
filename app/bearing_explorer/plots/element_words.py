"""What the rolling elements of a bearing are called: balls or rollers, one by one, row by row."""

from __future__ import annotations

from bearingcore import Bearing


def elements(bearing: Bearing, count: int = 2) -> str:
    """What so many of them are called."""
    return bearing.kind.element if count == 1 else bearing.kind.elements


def element_name(bearing: Bearing, index: int) -> str:
    """The name of one, counted from 0 row after row: "ball 3", "ball 3 of row 2"."""
    row, number = bearing.row_of_ball(int(index))
    name = f"{bearing.kind.element} {number + 1}"
    return name if len(bearing.all_rows) == 1 else f"{name} of row {row + 1}"


def row_words(bearing: Bearing, row: int | None) -> str:
    """Where a defect lies, of a bearing of several rows: ", row 1"; nothing of one row."""
    if len(bearing.all_rows) == 1:
        return ""
    return ", all rows" if row is None else f", row {row + 1}"
