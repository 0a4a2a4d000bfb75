"""Balls passing defects: how deep each one sinks, and when it enters and leaves (Eqs. 4-6)."""

from __future__ import annotations

import math
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, _checks as checks
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import RACES, Defect, Scene
from bearingcore.model.scene._defect import drop_into
from bearingcore.model.scene._packing import contacts, path

TWO_PI = 2.0 * math.pi

SAME_ANGLE = 1e-12
"""Angle [rad]: kinks that are closer to each other or to an end differ by rounding alone."""

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
) -> Array:
    """Drop d(φ) [m] of ball centres at `ball_angle` [rad] over all defects of a scene.

    `cage_angle` [rad] moves inner-race defects. `race` takes the drop into that race alone;
    None for both together, as the contacts see it; `row` for balls of that row. Shapes broadcast.
    """
    if race is not None:
        checks.choice("race", race, RACES)
    defects = tuple(d for d in scene.defects if race is None or d.race == race)
    return drop_into(defects, scene.bearing, ball_angle, cage_angle, row)


def drops_now(scene: Scene, cage_angle: float, race: str | None = None) -> Array:
    """Drop [m] of each ball of the bearing with the cage at an angle [rad], row after row."""
    return drops_at(scene, np.array([cage_angle]), race)[0]


def drops_at(
    scene: Scene, cage_angles: Array, race: str | None = None, leads: Array | None = None
) -> Array:
    """Drop (n, balls) [m] of each ball at cage angles (n,) [rad], row after row.

    leads (n,) [rad]: how far the shaft is ahead of where the cage angle has it; None: nowhere.
    """
    turned = cage_angles
    if leads is not None:
        turned = cage_angles + scene.bearing.cage_ratio * leads
    return kernels.drops_of(contacts(scene.bearing), path(scene, race), cage_angles, turned)


def crossings(scene: Scene, first: float, last: float) -> list[Crossing]:
    """Every entry and exit while the cage turns from `first` to `last` [rad], in order.

    A defect around the whole race has no edges and gives none.
    """
    events = []
    bearing = scene.bearing
    angles = contacts(bearing).angle.tolist()
    for index, row in product(range(len(scene.defects)), range(len(bearing.all_rows))):
        defect = scene.defects[index]
        if defect.extent >= TWO_PI or defect.row not in (None, row):
            continue
        # Balls pass the defect with the cage, or, as an inner race overtakes the cage, against it.
        rate = passing_rate(scene, defect, row)
        balls = bearing.balls_of_rows[row]
        for enters in (True, False):
            edge = defect.center - math.copysign(0.5 * defect.extent, rate) * (1 if enters else -1)
            for ball, angle in enumerate(angles[balls], balls.start):
                # cage_angle·rate + angle of the ball = edge + 2π k
                start = (edge - angle) / rate
                period = TWO_PI / abs(rate)
                at = start + math.ceil((first - start) / period) * period
                while at <= last:
                    events.append(Crossing(at, ball, index, enters))
                    at += period
    return sorted(events)


def passing_rate(scene: Scene, defect: Defect, row: int) -> float:
    """Turning of a ball of a row past a defect for each unit of cage angle; the race may pass it
    instead, which is below 0.
    """
    bearing = scene.bearing.of_row(row)
    return scene.bearing.pace(row) * (1.0 - defect.turn_ratio(bearing))


def shortest_passage(scene: Scene) -> float:
    """Cage angle [rad] in which a ball passes a defect, the least of all; infinite without one."""
    rows = range(len(scene.bearing.all_rows))
    passages = [
        defect.extent / abs(passing_rate(scene, defect, row))
        for defect in scene.defects
        for row in rows
        if defect.row in (None, row)
    ]
    return min(passages, default=math.inf)


def path_kinks(scene: Scene, first: float, last: float) -> Array:
    """Cage angles [rad] from first to last, rising, at which a ball meets an edge or a floor.

    The path of a ball has a corner, or its curvature jumps, there and only there, as long as
    floors are flat and defects are apart.
    """
    kinks = []
    for crossing in crossings(scene, first - math.pi, last + math.pi):
        defect = scene.defects[crossing.defect]
        row, _ = scene.bearing.row_of_ball(crossing.ball)
        rate = abs(passing_rate(scene, defect, row))
        inwards = 1.0 if crossing.enters else -1.0
        at = crossing.cage_angle
        kinks.append(at)
        # too short for the floor, it turns up again in the middle
        bearing = scene.bearing.of_row(row)
        s_floor = min(float(defect.edge_row(bearing)[4]), 0.5 * defect.extent)
        kinks.append(at + inwards * s_floor / rate)
    angles = np.array(sorted(kinks))
    angles = angles[(angles > first - SAME_ANGLE) & (angles < last + SAME_ANGLE)]
    for end in (first, last):
        angles[np.abs(angles - end) < SAME_ANGLE] = end
    return angles[np.diff(angles, prepend=-math.inf) > SAME_ANGLE]
