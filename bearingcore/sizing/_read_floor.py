"""The floor of a defect from a file of two columns."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import numpy as np

from bearingcore.common import _checks as checks
from bearingcore.measured.files import read_text
from bearingcore.model.scene import MOST_ROWS, MeasuredFloor, measured_floor
from bearingcore.units import INCH

_ANGLES = {"rad": 1.0, "radians": 1.0}
_LENGTHS = {"m": 1.0, "mm": 1e-3, "nm": 1e-9, "in": INCH}
"""Units [rad, m] that a heading may name; otherwise degrees and micrometres are read."""


def read_floor(text: str) -> tuple[MeasuredFloor, float, float, float]:
    """Read a `measured_floor` from text with two columns, angle [degrees] and depth [µm].

    Columns may be separated by commas, semicolons, tabs or blanks; numbers may have decimal points
    or commas; lines that begin with # are skipped. Headings may give other units: "angle [rad]",
    "depth_mm".

    Raises
    ------
    ValueError
        for a line that cannot be read, by its number, or a floor that `measured_floor` refuses.
    """
    lines = "2 or more lines of two numbers, angle [degrees] and depth [µm]"
    if not text.strip() or "\x00" in text:
        raise checks.refuse("floor", "no text" if text.strip() else "empty", lines)
    about, columns = read_text("the floor", text.encode("utf-8", "replace"), 2 * MOST_ROWS, 64)
    if about.get("notes"):
        raise checks.refuse("the floor", about["notes"][0], "numbers in every line")
    if columns.shape[1] != 2:
        raise checks.refuse(
            "number of columns in the floor", columns.shape[1], "2: angle [degrees] and depth [µm]"
        )
    if np.max(columns[:, 1]) <= 0.0 and np.any(columns[:, 1]):
        raise checks.refuse("depths", "all above the race", "some above 0: into the ring")
    angle, depth = about["names"] if about["headed"] else ("", "")
    return measured_floor(
        columns[:, 0] * _unit_in(angle, _ANGLES, math.radians(1.0)),
        columns[:, 1] * _unit_in(depth, _LENGTHS, 1e-6),
    )


def _unit_in(heading: str, units: Mapping[str, float], usual: float) -> float:
    """Return the unit [rad or m] at the end of a heading, or else the usual one."""
    last = re.search(r"([^\s_,;:/\[\](){}]+)[\s\])}]*$", heading.strip().lower())
    return units.get(last[1].replace("μ", "µ"), usual) if last else usual
