"""Balls passing defects: how deep each one sinks, and when it enters and leaves (Eqs. 4-6)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks
from bearingcore.model.defect import RACES, drop_into
from bearingcore.model.packing import contacts
from bearingcore.model.scene import Scene

TWO_PI = 2.0 * math.pi

SAME_ANGLE = 1e-12
"""[rad] Kinks nearer than this to each other or to an end differ by rounding alone."""

STEPS_A_PASSAGE = 24.0
"""Least number of time steps while a ball passes a defect that keep its edges in a motion."""


class Crossing(NamedTuple):
    """A ball centre passing an edge of a defect."""

    cage_angle: float
    """[rad]"""
    ball: int
    """counted from 0, row after row"""
    defect: int
    """index into `scene.defects`"""
    enters: bool
    """into the defect; else out of it"""


def ball_drop(
    scene: Scene,
    ball_angle: ArrayLike,
    cage_angle: ArrayLike = 0.0,
    race: str | None = None,
    row: int = 0,
) -> NDArray[np.float64]:
    """Drop d(φ) [m] of ball centres at `ball_angle` [rad] over all defects of a scene.

    `cage_angle` [rad] moves inner-race defects. `race` asks for the drop into that race alone;
    None for both together, as the contacts see it; `row` for balls of that row. Shapes broadcast.
    """
    if race is not None:
        checks.choice("race", race, RACES)
    defects = tuple(d for d in scene.defects if race is None or d.race == race)
    return drop_into(defects, scene.bearing, ball_angle, cage_angle, row)


def drops_now(scene: Scene, cage_angle: float, race: str | None = None) -> NDArray[np.float64]:
    """Drop [m] of each ball of the bearing with the cage at an angle [rad], row after row."""
    n = scene.bearing.n_balls
    angles = cage_angle + contacts(scene.bearing).angle
    return np.concatenate(
        [
            ball_drop(scene, angles[k * n : (k + 1) * n], cage_angle, race, k)
            for k in range(len(scene.bearing.all_rows))
        ]
    )


def crossings(scene: Scene, first: float, last: float) -> list[Crossing]:
    """Every entry and exit while the cage turns from `first` to `last` [rad], in order.

    A defect around the whole race has no edges and gives none.
    """
    found = []
    angles = contacts(scene.bearing).angle.tolist()
    for index, defect in enumerate(scene.defects):
        if defect.extent >= TWO_PI:
            continue
        # Balls pass the defect with the cage, or, as an inner race overtakes the cage, against it.
        rate = 1.0 - defect.turn_ratio(scene.bearing)
        for enters in (True, False):
            edge = defect.center - math.copysign(0.5 * defect.extent, rate) * (1 if enters else -1)
            for ball, angle in enumerate(angles):
                if defect.row not in (None, ball // scene.bearing.n_balls):
                    continue
                # cage_angle·rate + angle of the ball = edge + 2π k
                start = (edge - angle) / rate
                period = TWO_PI / abs(rate)
                at = start + math.ceil((first - start) / period) * period
                while at <= last:
                    found.append(Crossing(at, ball, index, enters))
                    at += period
    return sorted(found)


def path_kinks(scene: Scene, first: float, last: float) -> NDArray[np.float64]:
    """Cage angles [rad] from first to last, rising, at which a ball meets an edge or a floor.

    The path of a ball has a corner, or its curvature jumps, there and only there, as long as
    floors are flat and defects stand apart.
    """
    found = []
    for crossing in crossings(scene, first - math.pi, last + math.pi):
        defect = scene.defects[crossing.defect]
        rate = abs(1.0 - defect.turn_ratio(scene.bearing))
        inwards = 1.0 if crossing.enters else -1.0
        at = crossing.cage_angle
        found.append(at)
        # too short for the floor, it turns up again in the middle
        s_floor = min(float(defect.edge_row(scene.bearing)[4]), 0.5 * defect.extent)
        found.append(at + inwards * s_floor / rate)
    angles = np.array(sorted(found))
    angles = angles[(angles > first - SAME_ANGLE) & (angles < last + SAME_ANGLE)]
    for end in (first, last):
        angles[np.abs(angles - end) < SAME_ANGLE] = end
    return angles[np.diff(angles, prepend=-math.inf) > SAME_ANGLE]
