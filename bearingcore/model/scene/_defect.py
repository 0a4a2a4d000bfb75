"""A raceway defect and the path that a ball's centre takes over it (Eq. 6).

Quantity                              | Symbol | Name         | Unit
------------------------------------- | ------ | ------------ | ----
circumferential extent                | Δφ_f   | extent       | rad
depth of the floor                    | h      | depth        | m
angle of the middle                   | φ_f    | center       | rad
drop of the ball's centre             | d(φ)   | path         | m
angle from the nearer edge inwards    | s      |              | rad
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.bearings import Bearing
from bearingcore.bearings._row import MOST_ROWS
from bearingcore.common import Array, _checks as checks
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene._floor import MeasuredFloor, RoughFloor, measured_floor

RACES = ("outer", "inner")
EDGES = ("published", "chord", "exact")
"""Edge models. `published` is Eq. 6 with r_b in place of r_b² and factor 0.25, as in the figures of
the paper; `chord` is the same with factor 1; `exact` is a ball that pivots on the corner of the
curved race."""

TWO_PI = 2.0 * math.pi

ANGLE_ROUNDING = 1e-9
"""Angle [rad] below which two edges are at the same place. It is a nanometre on the largest race,
and more than the rounding of angles that were typed in degrees and added."""


@dataclass(frozen=True)
class Defect:
    """A spall of one race, with vertical edges and a flat floor unless `floor` is given.

    Parameters
    ----------
    extent
        circumferential extent [rad], 0 to 2π. A defect of 2π has no edges: the race is worn down by
        `depth` everywhere.
    depth
        depth of the floor [m].
    center
        angle of its middle [rad]; for an inner-race defect at cage angle 0, as it turns with the
        shaft.
    race
        "outer" or "inner".
    edge
        model of the ball's path over the edges: "published", "chord" or "exact".
    floor
        None for a flat floor; a `RoughFloor` or `MeasuredFloor` has the depth `depth`.
    row
        number of the row of balls that rolls over the defect, counted from 0; None for all rows.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """

    extent: float
    depth: float
    center: float
    race: str = "outer"
    edge: str = "published"
    floor: RoughFloor | MeasuredFloor | None = None
    row: int | None = None

    def __post_init__(self) -> None:
        # 360° typed as a decimal must neither fail on the last digit of 2π, nor leave a thin wall
        most = TWO_PI + ANGLE_ROUNDING
        checks.keep_number(self, "extent", at_least=0.0, at_most=most, unit="rad")
        if self.extent > TWO_PI - ANGLE_ROUNDING:
            checks.keep(self, extent=TWO_PI)
        checks.keep_number(self, "depth", at_least=0.0, unit="m")
        checks.keep_number(self, "center", unit="rad")
        checks.choice("race", self.race, RACES)
        checks.choice("edge", self.edge, EDGES)
        if not isinstance(self.floor, RoughFloor | MeasuredFloor | None):
            raise checks.refuse("floor", self.floor, "None, a RoughFloor or a MeasuredFloor")
        if self.row is not None:
            number = checks.whole_number("row", self.row, at_least=0, at_most=MOST_ROWS - 1)
            checks.keep(self, row=number)

    @classmethod
    def none(cls) -> Self:
        """Make a defect without extent and depth, as in a healthy bearing."""
        return cls(extent=0.0, depth=0.0, center=0.0)

    @classmethod
    def measured(
        cls, angle: ArrayLike, depth: ArrayLike, race: str = "outer", edge: str = "exact"
    ) -> Self:
        """Make a defect of any shape: angles [rad] on the race, depths [m] below it.

        Negative depths are above the race, such as a rim that was pushed up beside a dent.
        """
        floor, extent, deepest, center = measured_floor(angle, depth)
        return cls(extent, deepest, center, race, edge, floor)

    @property
    def is_none(self) -> bool:
        """True if extent or depth is 0."""
        return self.extent == 0.0 or self.depth == 0.0

    def turn_ratio(self, bearing: Bearing) -> float:
        """Return the angle of the defect per cage angle: 0 (outer) or ω_s/ω_c (inner)."""
        return 0.0 if self.race == "outer" else 1.0 / bearing.cage_ratio

    def raceway_radius(self, bearing: Bearing) -> float:
        """Return the radius [m] of the race that has the defect."""
        inner, outer = bearing.inner_raceway_radius, bearing.outer_raceway_radius
        return inner if self.race == "inner" else outer

    def check(self, bearing: Bearing) -> None:
        """Raise ValueError for a defect that `bearing` cannot have.

        Such a defect is on a row that does not exist, is too deep for balls to roll over, or has a
        floor with more detail than can be computed.
        """
        if self.row is not None and self.row >= len(bearing.all_rows):
            raise checks.refuse(
                "row of a defect", self.row, f"None, or below the {len(bearing.all_rows)} rows"
            )
        rows = range(len(bearing.all_rows)) if self.row is None else [self.row]
        least = min(bearing.of_row(row).ball_radius for row in rows)
        if self.depth > least:
            raise checks.refuse(
                "depth",
                self.depth,
                "at most the ball radius of {radius:m}, or no ball rolls over the edge",
                radius=least,
            )
        if isinstance(self.floor, RoughFloor):
            self.floor.check_length(self.extent * self.raceway_radius(bearing))

    def edge_row(self, bearing: Bearing) -> Array:
        """Return the path of a ball over the edges, in the order of `kernels.PATH_COLUMNS`."""
        R, r_b, h = self.raceway_radius(bearing), bearing.ball_radius, self.depth
        # a defect of 2π has no edges, and its floor is everywhere
        s_floor = self.edge_width(bearing, h) if self.extent < TWO_PI else 0.0
        code = EDGES.index(self.edge)
        if self.race == "inner" and self.edge == "exact":
            code = kernels.INNER_EXACT
        turn = self.turn_ratio(bearing)
        edge = (self.center, turn, 0.5 * self.extent, h, s_floor, code, R, r_b)
        row = kernels.EVERY_ROW if self.row is None else self.row
        return np.array([*edge, 0.0, 0.0, row])

    def edge_width(self, bearing: Bearing, drop: float) -> float:
        """Return the angle [rad] from an edge at which a ball has sunk by a drop [m]."""
        R, r_b = self.raceway_radius(bearing), bearing.ball_radius
        if self.edge == "exact":
            # Law of cosines for a ball that touches floor and corner at once. A ball much larger
            # than the inner race (bearings with 2 or 3 balls) never reaches the floor.
            rho = R + r_b - drop if self.race == "inner" else R - r_b + drop
            cosine = (R * R + rho * rho - r_b * r_b) / (2.0 * R * rho)
            return math.acos(min(max(cosine, -1.0), 1.0))
        factor = 0.25 if self.edge == "published" else 1.0
        return math.sqrt(drop * (2.0 * r_b - drop) / factor) / R

    def surface(self, angle: ArrayLike, bearing: Bearing) -> Array:
        """Return the depth [m] of the race itself at angles [rad], at cage angle 0."""
        away = _wrapped(np.asarray(angle, dtype=float) - self.center)
        inside = np.abs(away) <= 0.5 * self.extent
        if self.is_none:
            return np.zeros(away.shape)
        if self.floor is None:
            return np.where(inside, self.depth, 0.0)
        radius = self.raceway_radius(bearing)
        return np.where(inside, self.floor.surface(away, self.extent, self.depth, radius), 0.0)

    def path(self, ball_angle: ArrayLike, bearing: Bearing, cage_angle: ArrayLike = 0.0) -> Array:
        """Return the drop d(φ) [m] of the ball's centre at ball angles [rad] (Eq. 6, corrected).

        `cage_angle` [rad] sets the angle of cage and shaft, and with it the place of an inner-race
        defect. Shapes broadcast. Raises ValueError for a defect too deep for the balls.
        """
        self.check(bearing)
        return drop_into((self,), bearing, ball_angle, cage_angle)


def _wrapped(angle: Array) -> Array:
    """Return the angles [rad] in the range from −π to π."""
    return angle - TWO_PI * np.floor(angle / TWO_PI + 0.5)


def edge_drop(s: Array, defect: Defect, bearing: Bearing, deepest: float) -> Array:
    """Return the drop [m] of a ball that only a corner holds up, at the angle s [rad] from it.

    It is infinite where the ball has lost the corner, or would hang below `deepest` [m].
    """
    depth = min(deepest, bearing.ball_radius)
    row = dataclasses.replace(defect, depth=depth, extent=math.pi).edge_row(bearing)
    away = np.abs(s).ravel()
    near = away <= row[4] if deepest < bearing.ball_radius else away < row[4]
    x = 0.5 * math.pi - away[near]
    rows = row[None, :].copy()
    rows[0, 0] = 0.0
    drop = np.full(away.size, math.inf)
    drop[near] = kernels.ball_path(
        x, np.zeros_like(x), int(max(row[-1], 0)), kernels.Path(rows, np.zeros(0))
    )
    return drop.reshape(np.shape(s))


def floor_bytes(defects: tuple[Defect, ...]) -> int:
    """Return the memory [bytes] of the numbers of measured floors, two tuples of floats each."""
    floors = [defect.floor for defect in defects]
    return sum(64 * len(floor.places) for floor in floors if isinstance(floor, MeasuredFloor))


# The cache is bounded by bytes, as the table of a rough floor has up to two million numbers.
@lru_cache_by_bytes(
    64_000_000,
    lambda path, defects, _: sum(part.nbytes for part in path) + floor_bytes(defects),
)
def path_tables(defects: tuple[Defect, ...], bearing: Bearing) -> kernels.Path:
    """Return all defects as arrays for the kernels: rows of numbers, and tabulated paths.

    Each of the rows (n, len(kernels.PATH_COLUMNS)) is a square defect, or a stretch of the race
    whose path [m] is in the second array, because its floor is not flat or several defects touch.

    Raises
    ------
    ValueError
        if defects that touch differ in edge model or have floors that are not flat.
    """
    if not bearing.rows_are_alike:
        return _paths_of_rows(defects, bearing)
    rows: list[Array] = []
    tables: list[Array] = []
    size = 0
    for group in _touching(tuple(defect for defect in defects if not defect.is_none)):
        first = group[0]
        row = first.edge_row(bearing)
        if len(group) > 1 or first.floor is not None:
            center, half, table = (
                _joined_path(group, bearing) if len(group) > 1 else _floor_path(first, bearing)
            )
            row[0], row[2], row[5] = center, half, kernels.TABLE
            row[8], row[9] = size, table.size
            size += table.size
            tables.append(table)
        rows.append(row)
    columns = len(kernels.PATH_COLUMNS)
    return kernels.Path(
        np.array(rows).reshape(len(rows), columns), np.concatenate([*tables, np.zeros(0)])
    )


def _paths_of_rows(defects: tuple[Defect, ...], bearing: Bearing) -> kernels.Path:
    """Return the paths of unlike rows, whose raceways have different radii."""
    rows, tables, size = [], [], 0
    for row in range(len(bearing.all_rows)):
        of_row = tuple(
            dataclasses.replace(defect, row=row) for defect in defects if defect.row in (None, row)
        )
        path = path_tables(of_row, bearing.of_row(row).replace(rows=()))
        lines = path.defects.copy()
        lines[:, _TABLE_START] += size
        rows.append(lines)
        tables.append(path.tables)
        size += path.tables.size
    return kernels.Path(np.concatenate(rows), np.concatenate(tables))


_TABLE_START = kernels.PATH_COLUMNS.index("table_start")


def drop_into(
    defects: tuple[Defect, ...],
    bearing: Bearing,
    ball_angle: ArrayLike,
    cage_angle: ArrayLike = 0.0,
    row: int = 0,
) -> Array:
    """Return the drop [m] of the centre of a ball of `row` into all defects, at ball angles [rad].

    `cage_angle` [rad] is the angle of the cage; shapes broadcast.
    """
    angles = np.asarray(ball_angle, dtype=float) + np.zeros_like(cage_angle, dtype=float)
    cage = np.asarray(cage_angle, dtype=float) + np.zeros_like(angles)
    cage = bearing.pace(row) * cage
    drop = kernels.ball_path(angles.ravel(), cage.ravel(), row, path_tables(defects, bearing))
    return drop.reshape(angles.shape)


def _touching(defects: tuple[Defect, ...]) -> list[list[Defect]]:
    """Return the defects in groups that overlap or touch on the same race."""
    groups: list[list[Defect]] = []
    for defect in defects:
        near = [
            group
            for group in groups
            if any(
                other.race == defect.race
                and (other.row is None or defect.row is None or other.row == defect.row)
                and abs(float(_wrapped(np.array(other.center - defect.center))))
                <= 0.5 * (other.extent + defect.extent) + ANGLE_ROUNDING
                for other in group
            )
        ]
        merged = [defect]
        for group in near:
            groups.remove(group)
            merged = group + merged
        groups.append(merged)
    return groups


TABLE_STEP = 1e-4
"""Spacing [rad] of tabulated paths. Between nodes the curve of an edge differs from a straight line
by R_o²/r_b (step²)/8, about 1e-10 m; where a ball reaches the floor the error is 1e-8 m."""


def _nodes(half: float) -> Array:
    return np.linspace(-half, half, 2 * max(math.ceil(half / TABLE_STEP), 2) + 1)


def _joined_path(group: list[Defect], bearing: Bearing) -> tuple[float, float, Array]:
    """Return center, half extent [rad] and tabulated path [m] of square defects that touch.

    The joint profile is a staircase. The ball is held up by the floor below it and by the corners
    of all steps: d(φ) = min over the stretches k of h_k + drop(angle from φ to stretch k).
    """
    first = group[0]
    if any(defect.row != first.row for defect in group):
        raise checks.refuse(
            "row of a defect",
            [defect.row for defect in group],
            "the same where defects touch, or defects that are apart",
        )
    if any(defect.floor is not None or defect.edge != first.edge for defect in group):
        raise checks.refuse(
            "defect",
            f"{len(group)} that run into one another",
            "the same edge model and flat floors where defects touch",
        )
    places = [
        (float(_wrapped(np.array(d.center - first.center))), 0.5 * d.extent, d.depth) for d in group
    ]
    begin = min(c - half for c, half, _ in places)
    end = max(c + half for c, half, _ in places)
    if end - begin > TWO_PI - ANGLE_ROUNDING:
        raise checks.refuse(
            "defect",
            f"{len(group)} around the whole race",
            "defects that leave some of the race healthy where they touch",
        )
    # the whole profile from begin to end, held up at both ends by the healthy race
    middle, half = 0.5 * (begin + end), 0.5 * (end - begin)
    angle = _nodes(half) + middle
    edges = np.sort([edge for c, w, _ in places for edge in (c - w, c + w)])
    cuts = edges[np.diff(edges, prepend=-math.inf) > ANGLE_ROUNDING].tolist()
    deepest = max(h for _, _, h in places)
    path = np.minimum(
        edge_drop(angle - begin, first, bearing, deepest),
        edge_drop(end - angle, first, bearing, deepest),
    )
    for left, right in pairwise(cuts):
        depth = max(h for c, w, h in places if c - w <= 0.5 * (left + right) <= c + w)
        away = np.maximum(np.maximum(left - angle, angle - right), 0.0)
        path = np.minimum(path, depth + edge_drop(away, first, bearing, deepest))
    return first.center + middle, half, path


def _floor_path(defect: Defect, bearing: Bearing) -> tuple[float, float, Array]:
    """Return center, half extent [rad] and tabulated path [m] over a floor that is not flat.

    The ball's circle rolls over the surface, a grey-scale morphological operation:
    d(φ) = min over Δ of surface(φ + Δ) + drop(Δ). The drop of a point of the circle is that of the
    edge model, so that a square slot reproduces the edge model. The neglected terms are of the
    order of depth over raceway radius.
    """
    half = 0.5 * defect.extent
    all_around = defect.extent >= TWO_PI
    if isinstance(defect.floor, MeasuredFloor) and not all_around:
        # a ball touches a raised rim before its centre is above it
        height = -defect.depth * min(defect.floor.depths)
        if height > 0.0:
            half = min(half + defect.edge_width(bearing, height), math.pi)
    angle = _nodes(half)
    step = angle[1] - angle[0]
    surface = defect.surface(defect.center + angle, bearing)
    # both ends belong to the healthy race; a defect of the whole race closes on itself
    surface[0] = surface[-1] = min(surface[0], surface[-1]) if all_around else 0.0
    # The circle is no longer than the floor, as a tiny defect would need a huge number of steps.
    with np.errstate(over="ignore", divide="ignore"):
        steps = math.ceil(min(0.5 * math.pi / step, angle.size))
    reach = np.arange(steps) * step
    circle = edge_drop(reach, defect, bearing, float(np.ptp(surface)))
    circle = circle[np.isfinite(circle)]
    if not all_around:
        return defect.center, half, kernels.roll_over(surface, circle)
    margin = circle.size - 1
    around = np.concatenate([surface[-1 - margin : -1], surface, surface[1 : 1 + margin]])
    return defect.center, half, kernels.roll_over(around, circle)[margin : margin + angle.size]
