"""A row of elements in a bearing with its own numbers, and pairs of rows.

Two rows are face to face (X) if each contact angle has the sign of the row's place: their lines of
contact meet near the axis. With the opposite signs they are back to back (O).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearingcore.bearings._kinematics import check_contact_angle
from bearingcore.common import _checks as checks

ARRANGEMENTS = ("back-to-back", "face-to-face", "tandem")
"""Arrangements of the two rows of a pair: O, X, or one behind the other."""

MOST_ROWS = 8

USUAL_DISTANCE = 1.5
"""Distance of the rows of a new pair, in ball diameters."""

LENGTHS = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
OWN = ("n_balls", "contact_angle", *LENGTHS)
"""Fields of a `Bearing` that a row may have of its own."""


@dataclass(frozen=True)
class Row:
    """One row of balls. A dimension that is None is that of the bearing.

    The cage of a row with its own dimensions may turn faster or slower than the bearing's cage.
    When the bearing's cage is at an angle φ, that of the row is at φ times the ratio of both speeds
    (`Bearing.pace`), plus `turn`.

    Parameters
    ----------
    place
        z_k [m] along the shaft of the circle on which its balls' centres run; in a self-aligning
        bearing that of its inner groove's centres. A bearing without rows has its origin at the
        inner groove's centres, as in the paper (Eq. 12).
    facing
        1 keeps the sign of the contact angle, -1 reverses it.
    clearance
        [m] in addition to the bearing's radial clearance; below 0 it preloads the row.
    offset
        [m] displacement of the inner groove up the shaft by the preload.
    turn
        [rad] from the first ball of the bearing to the first of this row, at cage angle 0.
    contact_angle
        unloaded contact angle [rad] of this row, 0 to 80°; None: that of the bearing.
    n_balls
        balls of this row; None: as many as the bearing has.
    ball_diameter, pitch_diameter
        [m] of this row; None: those of the bearing.
    inner_groove_radius, outer_groove_radius
        [m] of this row; None: those of the bearing, scaled with the diameter of the balls.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """

    place: float = 0.0
    facing: int = 1
    clearance: float = 0.0
    offset: float = 0.0
    turn: float = 0.0
    contact_angle: float | None = None
    n_balls: int | None = None
    ball_diameter: float | None = None
    pitch_diameter: float | None = None
    inner_groove_radius: float | None = None
    outer_groove_radius: float | None = None

    def __post_init__(self) -> None:
        if self.contact_angle is not None:
            angle = check_contact_angle(self.contact_angle, "contact_angle of a row")
            checks.keep(self, contact_angle=angle)
        if self.n_balls is not None:
            count = checks.whole_number("n_balls of a row", self.n_balls, at_least=1, at_most=500)
            checks.keep(self, n_balls=count)
        for name in LENGTHS:
            checks.keep_number(self, name, optional=True, of=" of a row", above=0.0, unit="m")
        facing = checks.whole_number("facing of a row", self.facing, at_least=-1, at_most=1)
        if not facing:
            raise checks.refuse("facing of a row", self.facing, "1 or -1")
        checks.keep(self, facing=facing)
        for name, most, unit in (
            ("place", 10.0, "m"),
            ("clearance", 1e-2, "m"),
            ("offset", 1e-2, "m"),
            ("turn", 2.0 * math.pi, "rad"),
        ):
            checks.keep_number(self, name, of=" of a row", at_least=-most, at_most=most, unit=unit)

    @property
    def own(self) -> dict[str, float]:
        """Numbers of the row itself, by the names of the fields of `Bearing`."""
        return {name: value for name in OWN if (value := getattr(self, name)) is not None}


def pair(distance: float, arrangement: str, preload: float = 0.0) -> tuple[Row, Row]:
    """Return two rows `distance` [m] apart, the lower one first.

    `preload` [m] is the displacement of the inner grooves along the shaft that presses both rows,
    half of it each. Below 0 it is a clearance between them.

    Raises
    ------
    ValueError
        for an unknown arrangement, or a preload of rows in tandem, which do not press each other.
    """
    checks.choice("arrangement", arrangement, ARRANGEMENTS)
    half = 0.5 * checks.real_number("row_distance", distance, at_least=0.0, at_most=10.0, unit="m")
    push = 0.5 * checks.real_number("preload", preload, at_least=-1e-3, at_most=1e-3, unit="m")
    if arrangement == "tandem":
        if push != 0.0:
            raise checks.refuse("preload", preload, "0: rows in tandem do not press each other")
        return Row(-half), Row(half)
    upper = 1 if arrangement == "face-to-face" else -1
    return Row(-half, -upper, offset=-upper * push), Row(half, upper, offset=upper * push)


def arrangement_of(rows: tuple[Row, ...]) -> str:
    """Return the arrangement, out of ARRANGEMENTS, of rows made by `pair`; empty for others."""
    if len(rows) != 2:
        return ""
    low, high = rows
    # rounding of sums does not change the arrangement
    uneven = max(abs(low.place + high.place), abs(low.offset + high.offset))
    if uneven > 1e-12 or high.place < 0.0:
        return ""
    if low.facing == high.facing:
        return "tandem" if high.offset == 0.0 else ""
    return "face-to-face" if high.facing == 1 else "back-to-back"
