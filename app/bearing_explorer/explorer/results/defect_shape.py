"""The races of a scene with its defects at a cage angle, for shading and drawing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import cached
from bearingcore import Scene
from bearingcore.common import ResultTable, table_of
from bearingcore.model.statics import ball_drop

TWO_PI = 2.0 * math.pi
POINTS = 721
MARGIN = 0.35  # of the extent, on either side
LEAST_WIDTH = math.radians(12.0)


class Span(NamedTuple):
    """A stretch of a race that is missing: first edge and extent [rad], depth [m]."""

    start: float
    extent: float
    depth: float
    race: str
    row: int | None = None

    def meets(self, row: int | None) -> bool:
        """True if balls of a row meet it; None: balls of any row."""
        return row is None or self.row is None or self.row == row


def spans(scene: Scene, cage_angle: float, row: int | None = None) -> list[Span]:
    """The defects of `scene` with the cage at `cage_angle` [rad]; `start` between 0 and 2π.

    An inner-race defect has turned with the shaft, further than the cage. `row` selects the
    defects that the balls of that row meet.
    """
    return [
        Span(
            start=(
                defect.center + defect.turn_ratio(scene.bearing) * cage_angle - 0.5 * defect.extent
            )
            % TWO_PI,
            extent=defect.extent,
            depth=defect.depth,
            race=defect.race,
            row=defect.row,
        )
        for defect in scene.defects
        if row is None or defect.row in (None, row)
    ]


def pieces(span: Span) -> list[tuple[float, float]]:
    """`span` as intervals within 0 to 2π [rad]: two if it lies across 0."""
    end = span.start + span.extent
    if end <= TWO_PI:
        return [(span.start, end)]
    return [(span.start, TWO_PI), (0.0, end - TWO_PI)]


def race_depth(
    scene: Scene, cage_angle: float, race: str, angle: ArrayLike, row: int | None = None
) -> NDArray[np.float64]:
    """Depth [m] of the floor of defects below `race` at the angles [rad]; 0 beside the defects.

    A rim above the race has a negative depth. `row`: only the race of that row.
    """
    angles = np.asarray(angle, dtype=float)
    depth = np.zeros_like(angles)
    for defect in scene.defects:
        if defect.race == race and (row is None or defect.row in (None, row)):
            on_ring = angles - defect.turn_ratio(scene.bearing) * cage_angle
            shape = defect.surface(on_ring, scene.bearing)
            depth = np.where(np.abs(shape) > np.abs(depth), shape, depth)
    return depth


def _walls(all_spans: list[Span], race: str, row: int | None = None) -> NDArray[np.float64]:
    """A pair of angles [rad] at every edge of a race, so that walls are drawn upright."""
    ends = [
        edge
        for span in all_spans
        if span.race == race and span.meets(row)
        for edge in (span.start, span.start + span.extent)
    ]
    return np.add.outer(ends, [-1e-9, 1e-9]).ravel()


def race_angles(all_spans: list[Span], race: str, n: int = 361) -> NDArray[np.float64]:
    """Angles [rad] from 0 to 2π that draw `race` with upright walls."""
    return np.sort(np.append(np.linspace(0.0, TWO_PI, n), _walls(all_spans, race) % TWO_PI))


@dataclass(frozen=True)
class Profile:
    """A race around a defect: depth of the race and drop of a ball's centre (n,) [m].

    `angle` (n,) [rad] rises, perhaps past 2π. `row` of balls counts from 0.
    """

    race: str
    angle: NDArray[np.float64]
    depth: NDArray[np.float64]
    path: NDArray[np.float64]
    row: int = 0

    def table(self) -> ResultTable:
        """One row for each angle: depth of the race, and drop of a ball's centre."""
        return table_of(
            ("angle", "rad", self.angle),
            ("race_depth", "m", self.depth),
            ("ball_center_drop", "m", self.path),
        )


@cached
def profile(scene: Scene, cage_angle: float, focus: int = 0) -> Profile:
    """Profile around the defect `focus` of `scene` with the cage at `cage_angle` [rad]."""
    compiling.need(compiling.STATICS)
    all_spans = spans(scene, cage_angle)
    if not all_spans:
        angle = np.linspace(1.5 * math.pi - LEAST_WIDTH, 1.5 * math.pi + LEAST_WIDTH, 3)
        return Profile("outer", angle, np.zeros(3), np.zeros(3))
    first = all_spans[focus]
    middle = first.start + 0.5 * first.extent
    row = first.row or 0
    half = min(max((0.5 + MARGIN) * first.extent, LEAST_WIDTH), math.pi)
    low = middle - half
    walls = low + (_walls(all_spans, first.race, row) - low) % TWO_PI
    walls = walls[walls <= low + 2.0 * half]
    angle = np.sort(np.append(np.linspace(low, low + 2.0 * half, POINTS), walls))
    return Profile(
        first.race,
        angle,
        race_depth(scene, cage_angle, first.race, angle, row),
        ball_drop(scene, angle, cage_angle, first.race, row),
        row,
    )
