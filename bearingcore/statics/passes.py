"""Balls passing defects: how deep each one sinks, and when it enters and leaves (Eqs. 4-6)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks
from bearingcore.model.defect import RACES, drop_into
from bearingcore.model.scene import Scene

TWO_PI = 2.0 * math.pi


class Crossing(NamedTuple):
    """A ball centre passing an edge of a defect."""

    cage_angle: float
    """[rad]"""
    ball: int
    """counted from 0"""
    defect: int
    """index into `scene.defects`"""
    enters: bool
    """into the defect; else out of it"""


def ball_drop(
    scene: Scene, ball_angle: ArrayLike, cage_angle: ArrayLike = 0.0, race: str | None = None
) -> NDArray[np.float64]:
    """Drop d(φ) [m] of ball centres at `ball_angle` [rad] over all defects of a scene.

    `cage_angle` [rad] moves inner-race defects. `race` asks for the drop into that race alone;
    None for both together, as the contacts see it. Shapes broadcast.
    """
    if race is not None:
        checks.choice("race", race, RACES)
    defects = tuple(d for d in scene.defects if race is None or d.race == race)
    return drop_into(defects, scene.bearing, ball_angle, cage_angle)


def crossings(scene: Scene, first: float, last: float) -> list[Crossing]:
    """Every entry and exit while the cage turns from `first` to `last` [rad], in order.

    A defect around the whole race has no edges and gives none.
    """
    found = []
    spacing = scene.bearing.ball_spacing
    for index, defect in enumerate(scene.defects):
        if defect.extent >= TWO_PI:
            continue
        # Balls pass the defect with the cage, or, as an inner race overtakes the cage, against it.
        rate = 1.0 - defect.turn_ratio(scene.bearing)
        for enters in (True, False):
            edge = defect.center - math.copysign(0.5 * defect.extent, rate) * (1 if enters else -1)
            for ball in range(scene.bearing.n_balls):
                # cage_angle·rate + ball·spacing = edge + 2π k
                start = (edge - ball * spacing) / rate
                period = TWO_PI / abs(rate)
                at = start + math.ceil((first - start) / period) * period
                while at <= last:
                    found.append(Crossing(at, ball, index, enters))
                    at += period
    return sorted(found)
