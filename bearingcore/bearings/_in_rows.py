"""Numbers and rows of a bearing of any kind, without the rules of its kind."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import accumulate
from typing import Any, Self, TypeVar

from bearingcore.bearings import _drawing as drawing
from bearingcore.bearings._kinematics import Kinematics
from bearingcore.bearings._material import STEEL_DENSITY
from bearingcore.bearings._row import LENGTHS, MOST_ROWS, Row
from bearingcore.common import _checks as checks, _scene_file as scene_file
from bearingcore.errors import FieldError

ESTIMATES = ("n_balls", "ball_diameter", "pitch_diameter", "roller_length")
"""Fields that may be estimates."""

_ABOVE_0 = (
    *("groove_center_radius", "load_deflection_factor"),
    *("outer_raceway_radius", "inner_raceway_radius"),
)

_ONE_ROW = (Row(),)


@dataclass(frozen=True)
class InRows(Kinematics):
    """Numbers of a bearing, each checked by itself, and its rows.

    `Bearing` describes the fields. Methods of a `Kind` take this class, which does not need one.
    """

    groove_center_radius: float
    groove_center_distance: float | None
    radial_clearance: float
    load_deflection_factor: float
    outer_raceway_radius: float
    inner_raceway_radius: float
    inner_groove_radius: float | None = None
    outer_groove_radius: float | None = None
    youngs_modulus: float | None = None
    poisson: float | None = None
    rows: tuple[Row, ...] = ()
    roller_length: float | None = None
    density: float = field(default=STEEL_DENSITY, metadata=scene_file.LEFT_OUT)
    kind: object = ""  # a Kind in `Bearing`; its methods take this class, so it is not named here
    estimated: tuple[str, ...] = field(default=(), metadata=scene_file.LEFT_OUT)
    ball_youngs_modulus: float | None = None
    ball_poisson: float | None = None
    dynamic_load_rating: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in _ABOVE_0:
            checks.keep_number(self, name, above=0.0)
        for name in ("groove_center_distance", "roller_length"):
            checks.keep_number(self, name, optional=True, above=0.0)
        checks.keep_number(self, "density", above=0.0, unit="kg/m³")
        checks.keep_number(self, "dynamic_load_rating", optional=True, above=0.0, unit="N")
        least = -self.ball_radius  # more than any contact could be compressed
        checks.keep_number(self, "radial_clearance", at_least=least, unit="m")
        drawing.check_fit(vars(self))
        checks.keep(self, **drawing.checked(vars(self)))
        rows = self.rows if isinstance(self.rows, tuple | list) else (self.rows,)
        checks.keep(self, rows=tuple(rows))
        if len(self.rows) > MOST_ROWS or not all(isinstance(row, Row) for row in self.rows):
            raise checks.refuse("rows", self.rows, f"at most {MOST_ROWS} objects of type Row")
        names: object = self.estimated
        for name in names if isinstance(names, tuple | list) else (names,):
            checks.choice("estimated", name, ESTIMATES)
        checks.keep(self, estimated=tuple(self.estimated))

    @property
    def is_hybrid(self) -> bool:
        """True where the balls are of another material than the rings."""
        balls = (self.ball_youngs_modulus, self.ball_poisson)
        rings = (self.youngs_modulus, self.poisson)
        return any(ball not in (None, ring) for ball, ring in zip(balls, rings, strict=True))

    @property
    def is_drawn(self) -> bool:
        """True where the bearing carries its groove radii and material."""
        return any(getattr(self, name) is not None for name in drawing.OPTIONAL_FIELDS)

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
        return {name: value for name, value in row.own.items() if value != getattr(self, name)}

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
        """Return the speed of a row's cage, over the one that the bearing's own numbers give."""
        single = self.of_row(row)
        return 1.0 if single.size_ratio == self.size_ratio else single.cage_ratio / self.cage_ratio

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
    """Return a bearing without rows, with the numbers of one of them; grooves grow with balls."""
    values: dict[str, Any] = dict(numbers)
    if not bearing.is_drawn:
        for name in LENGTHS:
            if name in values:
                raise checks.refuse(
                    f"{name} of a row", values[name], "None, unless the bearing has groove radii"
                )
    elif "ball_diameter" in values:
        scale = values["ball_diameter"] / bearing.ball_diameter
        for name in drawing.GROOVES:
            values.setdefault(name, scale * getattr(bearing, name))
    return bearing.replace(rows=()).replace(**values)
