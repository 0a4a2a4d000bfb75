"""The parts of a bearing, and the lines that their damage makes.

Part       | Line, in turns of the shaft                    | Sidebands, and their reason
---------- | ---------------------------------------------- | ------------------------------------
outer race | BPFO = N_b f_c                                  | none: it stands still in the load
inner race | BPFI = N_b (f_s − f_c)                          | shaft: it turns through the load
ball       | 2 BSF: a damaged spot strikes both races        | cage: it is carried through the load
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearingcore.bearings import Bearing

OUTER, INNER, BALL = "outer race", "inner race", "ball"
PARTS = (OUTER, INNER, BALL)


@dataclass(frozen=True)
class PartLines:
    """Places of a part's lines, in turns of the shaft (orders).

    Attributes
    ----------
    part
        "outer race", "inner race" or "ball".
    order
        of its first line, by the geometry.
    sidebands
        distance of the sidebands, made by the part's own turning, from a line; 0 for none.
    """

    part: str
    order: float
    sidebands: float


def part_lines(bearing: Bearing) -> tuple[PartLines, ...]:
    """Return the lines of outer race, inner race and ball at one turn of the shaft a second.

    ValueError for rows that are not alike, because each has its own lines.
    """
    if not bearing.rows_are_alike:
        raise ValueError(
            "rows are not alike; allowed: rows that are alike, or one row at a time, as each has "
            "its own frequencies"
        )
    turn = 2.0 * math.pi  # one turn a second [rad/s]
    return (
        PartLines(OUTER, bearing.bpfo(turn), 0.0),
        PartLines(INNER, bearing.bpfi(turn), 1.0),
        PartLines(BALL, 2.0 * bearing.bsf(turn), bearing.ftf(turn)),
    )
