"""Rows of balls on one shaft, and their arrangement.

A row whose contact angle has the sign of its place faces one on the other side
(X: the lines of contact meet near the axis), one of the opposite sign back to back (O).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bearingcore.bearings._ball import BALL, SECTION, Ball
from bearingcore.bearings._contact import Contact
from bearingcore.bearings._kind import Variant
from bearingcore.bearings._kinematics import check_contact_angle
from bearingcore.common import _checks as checks

if TYPE_CHECKING:
    from bearingcore.bearings._bearing import Bearing

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
    """One row of balls. What it does not give of its own is the bearing's.

    The cage of a row with dimensions of its own may turn at another speed than the bearing's. A
    cage angle φ is that of the bearing's own numbers; the cage of a row is at φ times its speed
    over the bearing's, and at φ = 0 as `turn` says (`Bearing.pace`).

    Parameters
    ----------
    place
        z_k [m] along the shaft of the circle on which its balls' centres run; of a self-aligning
        bearing that of its inner groove's centres. A bearing without rows has its origin at the
        inner groove's centres, as the paper (Eq. 12).
    facing
        1 or -1: the contact angle counts as it is, or turned round.
    clearance
        [m] on top of the bearing's radial clearance; below 0 it preloads the row.
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
        [m] of this row; None: those of the bearing, as much wider or closer as its balls are.

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
        return {name: held for name in OWN if (held := getattr(self, name)) is not None}


def pair(distance: float, arrangement: str, preload: float = 0.0) -> tuple[Row, Row]:
    """Two rows `distance` [m] apart, the lower one first.

    `preload` [m] is how far the inner grooves are pushed along the shaft, together or apart, so
    that both rows are pressed: half of it each.

    Raises
    ------
    ValueError
        for an unknown arrangement, or a preload of rows in tandem, which do not press each other.
    """
    checks.choice("arrangement", arrangement, ARRANGEMENTS)
    half = 0.5 * checks.real_number("distance", distance, at_least=0.0, at_most=10.0, unit="m")
    push = 0.5 * checks.real_number("preload", preload, at_least=0.0, at_most=1e-3, unit="m")
    if arrangement == "tandem":
        if push > 0.0:
            raise checks.refuse("preload", preload, "0: rows in tandem do not press each other")
        return Row(-half), Row(half)
    upper = 1 if arrangement == "face-to-face" else -1
    return (
        Row(-half, -upper, offset=-upper * push),
        Row(half, upper, offset=upper * push),
    )


def arrangement_of(rows: tuple[Row, ...]) -> str:
    """Which of ARRANGEMENTS two rows are as `pair` makes them; empty where they are none of it."""
    if len(rows) != 2:
        return ""
    low, high = rows
    # rounding of numbers that were added makes no other arrangement
    uneven = max(abs(low.place + high.place), abs(low.offset + high.offset))
    if uneven > 1e-12 or high.place < 0.0:
        return ""
    if low.facing == high.facing:
        return "tandem" if high.offset == 0.0 else ""
    if high.offset * high.facing < 0.0:
        return ""
    return "face-to-face" if high.facing == 1 else "back-to-back"


def spaced(rows: tuple[Row, ...], distance: float | None, preload: float | None) -> tuple[Row, ...]:
    """A pair of rows with another distance or preload [m]; all else of each row stays."""
    low, high = rows
    made = pair(
        high.place - low.place if distance is None else distance,
        arrangement_of(rows),
        abs(high.offset - low.offset) if preload is None else preload,
    )
    return tuple(
        dataclasses.replace(row, place=new.place, offset=new.offset)
        for row, new in zip(rows, made, strict=True)
    )


def paired(self: Bearing, distance: float, arrangement: str, preload: float = 0.0) -> Bearing:
    """Two rows like this one, `distance` [m] apart on the shaft.

    `arrangement` is "back-to-back", "face-to-face" or "tandem"; `preload` [m] is how far the
    inner grooves are pushed along the shaft against each other.

    Raises
    ------
    ValueError
        for a bearing that has rows already, or without a contact angle for a preload.
    """
    if self.rows:
        raise checks.refuse("rows", len(self.rows), "none yet, where a bearing is paired")
    _check_preload(self, preload)
    return self.replace(rows=pair(distance, arrangement, preload))


def respaced(self: Bearing, distance: float | None = None, preload: float | None = None) -> Bearing:
    """The pair with another distance of its rows, or another preload [m]; see `paired`.

    ValueError for a bearing that is no pair.
    """
    if not self.arrangement:
        raise checks.refuse("rows", len(self.all_rows), "two rows that form a pair")
    _check_preload(self, preload or 0.0)
    return self.replace(rows=spaced(self.rows, distance, preload))


def _check_preload(bearing: Bearing, preload: float) -> None:
    if preload > 0.0 and bearing.contact_angle == 0.0:
        raise checks.refuse("preload", preload, "0 m at a contact angle of 0")


def pressure_centers_apart(bearing: Bearing) -> float | None:
    """Distance [m] of the points in which the lines of contact of a pair meet the shaft.

    With it a pair resists tilt. None of a bearing that is no pair, or one in tandem.
    """
    if bearing.arrangement not in ("back-to-back", "face-to-face"):
        return None
    meets = [
        row.place - row.facing * 0.5 * alone.pitch_diameter * math.tan(alone.contact_angle)
        for row, alone in ((row, bearing.of_row(k)) for k, row in enumerate(bearing.rows))
    ]
    return abs(meets[1] - meets[0])


class Rows(Ball):
    """Two rows of balls or more, which may have balls and dimensions of their own."""

    name = "rows"
    element = "ball"
    variants = (
        Variant(
            "back-to-back",
            "Pair, back to back (O)",
            "Two rows whose lines of contact meet the shaft far apart: stiff against tilt.",
        ),
        Variant(
            "face-to-face",
            "Pair, face to face (X)",
            "Two rows whose lines of contact meet the shaft close together: soft against tilt.",
        ),
        Variant("tandem", "Pair, tandem", "Two rows that share an axial load one way."),
    )
    picture = SECTION._replace(dimensions=(*SECTION.dimensions, "row_distance"))

    def recognizes(self, bearing: Bearing) -> bool:
        return bearing.roller_length is None and len(bearing.rows) > 1

    def check(self, bearing: Bearing) -> None:
        if len(bearing.rows) < 2:
            raise checks.refuse("rows", len(bearing.rows), "at least 2 where the kind is 'rows'")
        self._check_balls(bearing)

    def arrangement(self, bearing: Bearing) -> str:
        return arrangement_of(bearing.rows)

    variant = arrangement

    def nearest(self, bearing: Bearing, variant: str) -> Bearing:
        distance, preload = bearing.row_distance, bearing.preload
        made = BALL.nearest(bearing, "").paired(
            USUAL_DISTANCE * bearing.ball_diameter if distance is None else distance,
            variant,
            0.0 if variant == "tandem" or preload is None else preload,
        )
        if bearing.rows_are_alike or len(bearing.rows) != 2:
            return made
        return made.replace(
            rows=tuple(
                dataclasses.replace(new, **old.own)  # type: ignore[arg-type]  # its own numbers
                for new, old in zip(made.rows, bearing.rows, strict=True)
            )
        )

    def inputs(self, bearing: Bearing) -> tuple[str, ...]:
        names = super().inputs(bearing)
        arrangement = self.variant(bearing)
        if not arrangement:
            return names
        of_row = OWN if bearing.is_drawn else [name for name in OWN if name not in LENGTHS]
        second = (f"second_{name}" for name in of_row)
        return (*names, "row_distance", *(("preload",) if arrangement != "tandem" else ()), *second)

    def contact(self, bearing: Bearing) -> Contact:
        """That of a row: its inner groove's centres are where the line of contact meets r_d.

        They are (r_d − D_p/2) tan α0 beyond the balls', which of a drawing is (r_i − D_b/2) sin α0.
        """
        beyond = bearing.groove_center_radius - 0.5 * bearing.pitch_diameter
        return super().contact(bearing)._replace(beyond=beyond * math.tan(bearing.contact_angle))

    def facts(self, bearing: Bearing) -> tuple[str, ...]:
        meet = self.variant(bearing) in ("back-to-back", "face-to-face")
        return (*(("pressure_centers_apart",) if meet else ()), *super().facts(bearing))


ROWS = Rows()
