"""Load of a ball over its angular position: the curve of Fig. 3."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from bearingcore import Equilibrium
from bearingcore.common import ResultTable, table_of
from bearingcore.model.statics import has_long_period

Curve = tuple[NDArray[np.float64], NDArray[np.float64]]

TWO_PI = 2.0 * math.pi
BINS = 720
SAME_PLACE = 1e-9  # [rad]


def load_curve(
    equilibrium: Equilibrium, row: int = 0, loads: NDArray[np.float64] | None = None
) -> Curve:
    """Angles from 0 to 2π [rad] and loads [N] of a row's balls in all their positions.

    `loads` (n, N_b) [N] replaces `ball_load`, for example by the loads at the inner race.

    With a defect at rest the load depends on the ball's angle alone and this is one
    curve. A defect of the inner race passes every angle, and so does the other row if the rows
    have unlike balls: the curve is then the greatest load at each angle, or half degree.
    """
    balls = equilibrium.scene.bearing.balls_of_rows[row]
    angle = np.mod(equilibrium.ball_angle[:, balls], TWO_PI).ravel()
    angle[angle > TWO_PI - SAME_PLACE] = 0.0
    load = (equilibrium.ball_load if loads is None else loads)[:, balls].ravel()
    if has_long_period(equilibrium.scene):
        angle, load = _greatest(angle, load)
    order = np.argsort(angle, kind="stable")
    angle, load = angle[order], load[order]
    # the cage turns by one spacing: a ball ends where the next one began, and one point is enough
    new = np.diff(angle, prepend=-1.0) > SAME_PLACE
    angle, load = angle[new], load[new]
    # 0 and 2π are the same place: the curve is continued past both
    return (
        np.concatenate([[angle[-1] - TWO_PI], angle, [angle[0] + TWO_PI]]),
        np.concatenate([[load[-1]], load, [load[0]]]),
    )


def row_name(row: int) -> str:
    """Prefix of the names of a row's columns: empty for the first."""
    return f"row_{row + 1}_" if row else ""


def curves_table(curves: Sequence[Curve]) -> ResultTable:
    """Angles and loads of each row's curve; only the first row's columns have no number."""
    columns = []
    for row, (angle, load) in enumerate(curves):
        name = row_name(row)
        columns += [
            (f"{name}ball_angle", "rad", angle[1:-1]),
            (f"{name}ball_load", "N", load[1:-1]),
        ]
    return table_of(*columns)


def _greatest(angle: NDArray[np.float64], load: NDArray[np.float64]) -> Curve:
    """The greatest finite load at each angle; NaN where no load is finite.

    More than `BINS` angles are replaced by the middles of `BINS` equal parts of the turn.
    """
    middles, part = np.unique(np.round(angle, 9), return_inverse=True)
    part = part.ravel()
    if middles.size > BINS:
        middles = (np.arange(BINS, dtype=np.float64) + 0.5) * (TWO_PI / BINS)
        part = np.minimum((angle / TWO_PI * BINS).astype(int), BINS - 1)
    most: NDArray[np.float64] = np.full(middles.size, -np.inf)
    known = np.isfinite(load)
    np.maximum.at(most, part[known], load[known])
    most[most == -np.inf] = np.nan
    return middles, most
