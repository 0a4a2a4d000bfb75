"""Bearings as rows: the numbers of each, places of its balls among all, speed of its cage."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import accumulate
from typing import TYPE_CHECKING, Any, Self, cast

from bearingcore.bearings._drawing import GROOVES
from bearingcore.bearings._kinematics import Kinematics
from bearingcore.bearings._rows import LENGTHS, Row
from bearingcore.common import _checks as checks
from bearingcore.errors import FieldError

if TYPE_CHECKING:
    from bearingcore.bearings._bearing import Bearing

_ONE_ROW = (Row(),)


class InRows(Kinematics):
    """The part of a `Bearing` that is about its rows."""

    rows: tuple[Row, ...]

    @property
    def all_rows(self) -> tuple[Row, ...]:
        """The rows, also where there is but one."""
        return self.rows or _ONE_ROW

    def of_row(self, row: int) -> Self:
        """The bearing with the numbers of a row and what follows from them, without rows.

        The bearing itself where all rows are alike.

        Raises
        ------
        ValueError
            for dimensions of the row that do not fit each other, or that nothing follows from as
            the bearing does not carry its drawing.
        """
        if self.rows_are_alike:
            return self
        try:
            numbers = tuple(self.unlike(self.rows[row]).items())
            return cast(Self, _build_row(cast("Bearing", self), numbers))
        except FieldError as refused:
            raise refused.inside(f"row {row + 1}") from None

    @property
    def rows_are_alike(self) -> bool:
        """True where no row has balls or dimensions of its own; places and turns may differ."""
        return not any(row.own and self.unlike(row) for row in self.rows)

    def unlike(self, row: Row) -> dict[str, float]:
        """Numbers of a row that differ from the bearing's."""
        return {name: held for name, held in row.own.items() if held != getattr(self, name)}

    @property
    def unlike_rows(self) -> tuple[tuple[Self, slice], ...]:
        """The bearing of each row, see `of_row`, and the places of its balls among all of them.

        Rows that are alike are listed once: the bearing with all balls.
        """
        if self.rows_are_alike:
            return ((self, slice(0, self.total_balls)),)
        return tuple((self.of_row(k), balls) for k, balls in enumerate(self.balls_of_rows))

    @property
    def balls_of_rows(self) -> tuple[slice, ...]:
        """Places of the balls of each row among all of them: row after row."""
        ends = list(accumulate(row.n_balls or self.n_balls for row in self.all_rows))
        return tuple(slice(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True))

    def row_of_ball(self, ball: int) -> tuple[int, int]:
        """Row of a ball out of all of them, and its number in the row, both counted from 0."""
        for row, balls in enumerate(self.balls_of_rows):
            if balls.start <= ball < balls.stop:
                return row, ball - balls.start
        raise checks.refuse("ball", ball, f"0 to {self.total_balls - 1}")

    def pace(self, row: int) -> float:
        """Speed of a row's cage, over that of the bearing's own numbers."""
        own = self.of_row(row)
        return 1.0 if own.size_ratio == self.size_ratio else own.cage_ratio / self.cage_ratio

    @property
    def has_one_cage_speed(self) -> bool:
        """True where the cages of all rows turn at one speed."""
        return len({self.pace(k) for k in range(len(self.all_rows))}) == 1

    @property
    def period(self) -> float:
        """Cage angle [rad] after which balls are again where balls were.

        A ball spacing where all rows have as many balls; else what the spacings of the rows have in
        common. Cages that turn at speeds of their own come back at no angle: then a whole turn.
        """
        if not self.has_one_cage_speed:
            return 2.0 * math.pi
        counts = (row.n_balls or self.n_balls for row in self.all_rows)
        return 2.0 * math.pi / math.gcd(*counts) / self.pace(0)

    @property
    def total_balls(self) -> int:
        """Balls or rollers of all rows."""
        return self.balls_of_rows[-1].stop


@lru_cache(maxsize=256)
def _build_row(bearing: Bearing, numbers: tuple[tuple[str, float], ...]) -> Bearing:
    """The bearing without rows and with what one of them has of its own."""
    values: dict[str, Any] = dict(numbers)
    if not bearing.is_drawn:
        for name in LENGTHS:
            if name in values:
                raise checks.refuse(
                    f"{name} of a row", values[name], "None, unless the bearing has groove radii"
                )
    elif "ball_diameter" in values:
        larger = values["ball_diameter"] / bearing.ball_diameter
        for name in GROOVES:
            values.setdefault(name, larger * getattr(bearing, name))
    return bearing.replace(rows=()).replace(**values)
