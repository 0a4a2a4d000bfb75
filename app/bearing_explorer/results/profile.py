"""The race around its defects and the path of a ball's centre there, ready to draw."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.results.defect_shape import race_depth, spans
from bearingcore import Scene
from bearingcore.common.table import ResultTable, table_of
from bearingcore.statics.passes import ball_drop

TWO_PI = 2.0 * math.pi
POINTS = 721
MARGIN = 0.35  # of the extent, on either side
LEAST_WIDTH = math.radians(12.0)


@dataclass(frozen=True)
class Profile:
    """angle (n,) [rad], rising, perhaps past 2π; depth of the race and drop of the ball [m].

    Of the race of one `row`, counted from 0.
    """

    race: str
    angle: NDArray[np.float64]
    depth: NDArray[np.float64]
    path: NDArray[np.float64]
    row: int = 0

    def table(self) -> ResultTable:
        """A row an angle: depth of the race, and how far the ball's centre drops."""
        return table_of(
            ("angle", "rad", self.angle),
            ("race_depth", "m", self.depth),
            ("ball_center_drop", "m", self.path),
        )


def profile(scene: Scene, cage_angle: float, focus: int = 0) -> Profile:
    """Profile around the defect `focus` of `scene` with the cage at `cage_angle` [rad]."""
    found = spans(scene, cage_angle)
    if not found:
        angle = np.linspace(1.5 * math.pi - LEAST_WIDTH, 1.5 * math.pi + LEAST_WIDTH, 3)
        return Profile("outer", angle, np.zeros(3), np.zeros(3))
    first = found[focus]
    middle = first.start + 0.5 * first.extent
    row = first.row or 0
    half = min(max((0.5 + MARGIN) * first.extent, LEAST_WIDTH), math.pi)
    edges = [
        edge
        for span in found
        if span.race == first.race and span.meets(row)
        for at in (span.start, span.start + span.extent)
        for edge in (at - 1e-9, at + 1e-9)
    ]
    low = middle - half
    inside = low + (np.array(edges) - low) % TWO_PI
    angle = np.sort(
        np.concatenate(
            [np.linspace(low, low + 2.0 * half, POINTS), inside[inside <= low + 2.0 * half]]
        )
    )
    return Profile(
        first.race,
        angle,
        race_depth(scene, cage_angle, first.race, angle, row),
        ball_drop(scene, angle, cage_angle, first.race, row),
        row,
    )
