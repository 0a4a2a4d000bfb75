"""Angular positions of the defects of a scene at a cage angle, for shading and drawing."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore import Scene

TWO_PI = 2.0 * math.pi


class Span(NamedTuple):
    """A stretch of a race that is missing: first edge and extent [rad], depth [m]."""

    start: float
    extent: float
    depth: float
    race: str
    row: int | None = None

    def meets(self, row: int | None) -> bool:
        """Whether balls of a row meet it; None: of any row."""
        return row is None or self.row is None or self.row == row


def spans(scene: Scene, cage_angle: float, row: int | None = None) -> list[Span]:
    """The defects of `scene` with the cage at `cage_angle` [rad]; `start` between 0 and 2π.

    An inner-race defect has turned with the shaft, further than the cage. `row` asks for those
    that the balls of that row meet.
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
    """`span` as intervals within 0 to 2π [rad]: two where it lies across 0."""
    end = span.start + span.extent
    if end <= TWO_PI:
        return [(span.start, end)]
    return [(span.start, TWO_PI), (0.0, end - TWO_PI)]


def race_depth(
    scene: Scene, cage_angle: float, race: str, angle: ArrayLike, row: int | None = None
) -> NDArray[np.float64]:
    """Depth [m] of what is missing from `race` at the angles [rad], the floor as it was cut.

    `row`: of that row's race alone.
    """
    angles = np.asarray(angle, dtype=float)
    depth = np.zeros_like(angles)
    for defect in scene.defects:
        if defect.race == race and (row is None or defect.row in (None, row)):
            turned = angles - defect.turn_ratio(scene.bearing) * cage_angle
            depth = np.maximum(depth, defect.surface(turned, scene.bearing))
    return depth


def race_angles(found: list[Span], race: str, n: int = 361) -> NDArray[np.float64]:
    """Angles [rad] from 0 to 2π that draw `race` with upright walls: a pair at every edge."""
    edges = [
        edge
        for span in found
        if span.race == race
        for at in (span.start, (span.start + span.extent) % TWO_PI)
        for edge in (at - 1e-9, at + 1e-9)
    ]
    return np.sort(np.concatenate([np.linspace(0.0, TWO_PI, n), edges]))
