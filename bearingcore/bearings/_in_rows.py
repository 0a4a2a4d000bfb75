"""Rows of a bearing: their numbers, their balls among all balls, and the speeds of their cages."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import accumulate
from typing import Any, Self, TypeVar

from bearingcore.bearings._drawing import GROOVES
from bearingcore.bearings._numbers import Numbers
from bearingcore.bearings._row import LENGTHS, Row
from bearingcore.common import _checks as checks
from bearingcore.errors import FieldError

_ONE_ROW = (Row(),)


class InRows(Numbers):
    """Rows of a bearing of any kind; methods of a `Kind` take these."""

    def replace(self, **changes: Any) -> Self:
        """Return the bearing with changed fields; see `Bearing.replace`."""
        raise NotImplementedError

    @property
    def all_rows(self) -> tuple[Row, ...]:
        """The rows; a single row is included."""
        return self.rows or _ONE_ROW

    def of_row(self, row: int) -> Self:
        """Return the bearing with the numbers of a row and derived fields, without rows.

        If all rows are alike, this is the bearing itself.

        Raises
        ------
        ValueError
            for dimensions of the row that do not fit each other, or if derived fields are unknown
            because the bearing does not carry its drawing.
        """
        if self.rows_are_alike:
            return self
        try:
            return _build_row(self, tuple(self.unlike(self.rows[row]).items()))
        except FieldError as refused:
            raise refused.inside(f"row {row + 1}") from None

    @property
    def rows_are_alike(self) -> bool:
        """True if no row has its own balls or dimensions; places and turns may differ."""
        return not any(row.own and self.unlike(row) for row in self.rows)

    def unlike(self, row: Row) -> dict[str, float]:
        """Return the numbers of a row that differ from the bearing's."""
        return {name: held for name, held in row.own.items() if held != getattr(self, name)}

    @property
    def unlike_rows(self) -> tuple[tuple[Self, slice], ...]:
        """The bearing of each row, see `of_row`, and the indices of its balls among all balls.

        Rows that are alike are one entry: the bearing with all balls.
        """
        if self.rows_are_alike:
            return ((self, slice(0, self.total_balls)),)
        return tuple((self.of_row(k), balls) for k, balls in enumerate(self.balls_of_rows))

    @property
    def balls_of_rows(self) -> tuple[slice, ...]:
        """Indices of the balls of each row among all balls, row after row."""
        ends = list(accumulate(row.n_balls or self.n_balls for row in self.all_rows))
        return tuple(slice(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True))

    def row_of_ball(self, ball: int) -> tuple[int, int]:
        """Return the row of a ball, and its number in that row, both counted from 0."""
        for row, balls in enumerate(self.balls_of_rows):
            if balls.start <= ball < balls.stop:
                return row, ball - balls.start
        raise checks.refuse("ball", ball, f"0 to {self.total_balls - 1}")

    def pace(self, row: int) -> float:
        """Return the speed of a row's cage over that by the bearing's own numbers."""
        own = self.of_row(row)
        return 1.0 if own.size_ratio == self.size_ratio else own.cage_ratio / self.cage_ratio

    @property
    def has_one_cage_speed(self) -> bool:
        """True if the cages of all rows turn at one speed."""
        return len({self.pace(k) for k in range(len(self.all_rows))}) == 1

    @property
    def period(self) -> float:
        """Cage angle [rad] after which the pattern of balls repeats.

        It is a ball spacing if all rows have equally many balls, and else the common multiple of
        their spacings. Cages with different speeds have no period: it is then a whole turn.
        """
        if not self.has_one_cage_speed:
            return 2.0 * math.pi
        counts = (row.n_balls or self.n_balls for row in self.all_rows)
        return 2.0 * math.pi / math.gcd(*counts) / self.pace(0)

    @property
    def total_balls(self) -> int:
        """Number of balls or rollers in all rows."""
        return self.balls_of_rows[-1].stop


B = TypeVar("B", bound=InRows)


@lru_cache(maxsize=256)
def _build_row(bearing: B, numbers: tuple[tuple[str, float], ...]) -> B:
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
