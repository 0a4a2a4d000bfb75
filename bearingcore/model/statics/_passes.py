"""Balls that pass defects: their drops, and the cage angles of entry and exit (Eqs. 4-6)."""

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
"""Angle [rad] below which two kinks, or a kink and an end, differ by rounding alone."""

STEPS_A_PASSAGE = 24.0
"""Least number of time steps in the passage of a ball, so that a motion shows the edges."""


class Crossing(NamedTuple):
    """Passage of a ball centre over an edge of a defect."""

    cage_angle: float
    """[rad]"""
    ball: int
    """counted from 0, row after row"""
    defect: int
    """index into `scene.defects`"""
    enters: bool
    """True into the defect, False out of it"""


def ball_drop(
    scene: Scene,
    ball_angle: ArrayLike,
    cage_angle: ArrayLike = 0.0,
    race: str | None = None,
    row: int = 0,
) -> Array:
    """Return the drop d(φ) [m] of ball centres of a row at `ball_angle` [rad] into all defects.

    `cage_angle` [rad] moves inner-race defects. With `race` only the drop into that race counts;
    None adds both, as contacts do. Shapes broadcast.
    """
    if race is not None:
        checks.choice("race", race, RACES)
    defects = tuple(d for d in scene.defects if race is None or d.race == race)
    return drop_into(defects, scene.bearing, ball_angle, cage_angle, row)


def drops_now(scene: Scene, cage_angle: float, race: str | None = None) -> Array:
    """Return the drop [m] of each ball with the cage at an angle [rad], row after row."""
    return drops_at(scene, np.array([cage_angle]), race)[0]


def drops_at(
    scene: Scene, cage_angles: Array, race: str | None = None, leads: Array | None = None
) -> Array:
    """Return the drop (n, balls) [m] of each ball at cage angles (n,) [rad], row after row.

    leads (n,) [rad]: angle of the shaft beyond ω_s/ω_c times the cage angle; None stands for 0.
    """
    turned = cage_angles
    if leads is not None:
        turned = cage_angles + scene.bearing.cage_ratio * leads
    return kernels.drops_of(contacts(scene.bearing), path(scene, race), cage_angles, turned)


def crossings(scene: Scene, first: float, last: float) -> list[Crossing]:
    """Return all entries and exits while the cage turns from `first` to `last` [rad], in order.

    A defect around the whole race has no edges, and so no crossings.
    """
    events = []
    bearing = scene.bearing
    angles = contacts(bearing).angle.tolist()
    for index, row in product(range(len(scene.defects)), range(len(bearing.all_rows))):
        defect = scene.defects[index]
        if defect.extent >= TWO_PI or defect.row not in (None, row):
            continue
        # An outer-race defect stands still, and balls pass it with the cage. An inner-race defect
        # overtakes the cage, so balls pass it backwards.
        rate = passing_rate(scene, defect, row)
        balls = bearing.balls_of_rows[row]
        for enters in (True, False):
            edge = defect.center - math.copysign(0.5 * defect.extent, rate) * (1 if enters else -1)
            for ball, angle in enumerate(angles[balls], balls.start):
                # cage_angle·rate + angle of the ball = edge + 2π k
                start = (edge - angle) / rate
                period = TWO_PI / abs(rate)
                cage_angle = start + math.ceil((first - start) / period) * period
                while cage_angle <= last:
                    events.append(Crossing(cage_angle, ball, index, enters))
                    cage_angle += period
    return sorted(events)


def passing_rate(scene: Scene, defect: Defect, row: int) -> float:
    """Return the angle of a row's ball relative to a defect, per cage angle.

    It is negative if the defect overtakes the ball.
    """
    bearing = scene.bearing.of_row(row)
    return scene.bearing.pace(row) * (1.0 - defect.turn_ratio(bearing))


def shortest_passage(scene: Scene) -> float:
    """Return the least cage angle [rad] in which a ball passes a defect; infinite without one."""
    rows = range(len(scene.bearing.all_rows))
    passages = [
        defect.extent / abs(passing_rate(scene, defect, row))
        for defect in scene.defects
        for row in rows
        if defect.row in (None, row)
    ]
    return min(passages, default=math.inf)


def path_kinks(scene: Scene, first: float, last: float) -> Array:
    """Return rising cage angles [rad] from first to last at which a ball meets an edge or a floor.

    If floors are flat and defects are apart, these are the only places where the path of a ball has
    a corner or its curvature jumps.
    """
    kinks = []
    for crossing in crossings(scene, first - math.pi, last + math.pi):
        defect = scene.defects[crossing.defect]
        row, _ = scene.bearing.row_of_ball(crossing.ball)
        rate = abs(passing_rate(scene, defect, row))
        inwards = 1.0 if crossing.enters else -1.0
        # a ball that does not reach the floor of a short defect turns up again in its middle
        bearing = scene.bearing.of_row(row)
        s_floor = min(float(defect.edge_row(bearing)[4]), 0.5 * defect.extent)
        to_floor = inwards * s_floor / rate
        kinks += [crossing.cage_angle, crossing.cage_angle + to_floor]
    angles = np.array(sorted(kinks))
    angles = angles[(angles > first - SAME_ANGLE) & (angles < last + SAME_ANGLE)]
    for end in (first, last):
        angles[np.abs(angles - end) < SAME_ANGLE] = end
    return angles[np.diff(angles, prepend=-math.inf) > SAME_ANGLE]
