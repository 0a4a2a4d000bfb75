"""Release and pressing of a ball inside the edges of a spall, by statics.

A ball keeps some load behind the edge. It sinks along the corner until it has lost its compression
and the rings follow no further; before the far edge it is pressed again in the same way. So a
sensor measures less than the extent:

    extent = separation + offset

Quantity                                          | Name        | Unit
------------------------------------------------- | ----------- | ----
angle of the race without load on the ball        | separation  | rad
angle at both edges over which load is lost       | offset      | rad
"""

from __future__ import annotations

import dataclasses
import math
from itertools import product

import numpy as np

from bearingcore.bearings import BALL_MATERIALS, Bearing
from bearingcore.common import Array, weighted_quantile
from bearingcore.model.scene import FAN_RIG_SUPPORT, Defect, Load, Scene
from bearingcore.model.statics import dynamic_load_rating, equilibrium

RELEASE_PLACES = 241
"""Ball positions across the spall at which the load is computed."""

TYPICAL_LOAD, LOAD_SPREAD = 0.007, 1.0
"""Radial load as a share of the dynamic load rating if no load is given, and the standard deviation
of its logarithm: nineteen of twenty bearings carry 0.1 % to 5 %. Balls need 1 % to roll without
sliding, but test rigs and idle machines carry less."""

GIVEN_LOAD_SPREAD = 0.2
"""Standard deviation of the logarithm of the load on the spall if the load on the bearing is given:
a spall seldom lies exactly under the load."""

CLEARANCE_SPREAD = 0.25
"""Relative standard deviation of a given clearance."""

LEAST_CLEARANCE = 3e-4
"""Least clearance, relative to the ball diameter, that is assumed where no clearance is stated."""

EDGE_WEIGHTS = {"exact": 0.48, "chord": 0.48, "published": 0.04}
"""Probability of each edge model. The first two are geometry and nearly agree. `published` halves
the arc. It agrees with the offsets measured on a rig only at a load that the rig does not carry, so
it stays in the tail of the interval."""

SEEN_SHARES = {1.0: 0.5, 0.75: 0.25, 0.5: 0.15, 0.25: 0.1}
"""Probability that a sensor shows this share of the offset. The load begins to fall at the edge and
is gone one offset later; a ball with mass strikes between that place and the far edge. So the peaks
lie somewhere between, and mostly where the load is gone."""

_NORMAL = (-1.96, -1.2816, -0.6745, 0.0, 0.6745, 1.2816, 1.96)
_WEIGHTS = (0.05, 0.125, 0.2, 0.25, 0.2, 0.125, 0.05)
"""Standard deviations at which loads are computed, and their weights: a normal distribution."""


def release_offset(
    bearing: Bearing, race: str, load: float, clearance: float, edge: str = "exact"
) -> float:
    """Return the angle [rad] by which a long, deep spall exceeds the stretch without load.

    Parameters
    ----------
    bearing
        whose ball rolls over the spall.
    race
        "outer" or "inner"; the spall lies under the load.
    load
        radial load on the bearing [N].
    clearance
        radial clearance [m].
    edge
        the edge model, see `Defect`.

    Returns
    -------
    NaN where the ball keeps its load, or carries none beside the spall.
    """
    spacing = bearing.ball_spacing
    extent = 0.6 * spacing
    bearing = dataclasses.replace(bearing, radial_clearance=clearance)
    under = 1.5 * math.pi
    spall = Defect(extent, 0.4 * bearing.ball_diameter, under, race, edge)
    turn = spall.turn_ratio(bearing)
    spall = dataclasses.replace(spall, center=under * (1.0 - turn))
    place = np.linspace(-0.5 * extent, 0.5 * extent, RELEASE_PLACES)  # of the ball, from the middle
    scene = Scene(bearing, spall, Load(fy=-load), 0.0, FAN_RIG_SUPPORT, dofs=("x", "y"))
    state = equilibrium(scene, under + place / (1.0 - turn))
    compression = np.asarray(state.ball_load[:, 0]) ** (2.0 / 3.0)  # falls to 0 linearly
    free = np.flatnonzero(compression <= 0.0)
    if free.size < 2 or free[0] < 2 or free[-1] > RELEASE_PLACES - 3:
        return math.nan
    released = _falls_to_zero(place, compression, int(free[0]) - 1, -1)
    pressed = _falls_to_zero(place, compression, int(free[-1]) + 1, 1)
    return extent - (pressed - released)


def _falls_to_zero(place: Array, compression: Array, last: int, away: int) -> float:
    """Extrapolate a compression beyond its `last` value; return the place where it reaches 0."""
    slope = (compression[last + away] - compression[last]) / (place[last + away] - place[last])
    step = abs(compression[last] / slope) if slope else math.inf
    return float(place[last] - away * min(step, abs(place[last + away] - place[last])))


def plausible_offset(
    bearing: Bearing,
    race: str,
    load: float | None,
    clearance: float | None,
    edge: str | None = None,
) -> tuple[float, float, float]:
    """Compute the offset [rad] over plausible loads, clearances and edges.

    Parameters
    ----------
    load
        radial load on the bearing [N], or None if it is not known.
    clearance
        radial clearance [m], or None: that of the bearing, with a deviation of half its value.
    edge
        the edge model, or None: all, by `EDGE_WEIGHTS`.

    Returns
    -------
    Lower 95 % limit, median and upper limit; NaN where no ball loses its load.
    """
    steel = bearing.with_balls_of(BALL_MATERIALS["steel"]) if bearing.is_hybrid else bearing
    middle = TYPICAL_LOAD * dynamic_load_rating(steel) if load is None else load
    spread = LOAD_SPREAD if load is None else GIVEN_LOAD_SPREAD
    if clearance is None:
        typical = max(bearing.radial_clearance, LEAST_CLEARANCE * bearing.ball_diameter)
        clearance_spread = 0.5
    else:
        typical, clearance_spread = clearance, CLEARANCE_SPREAD
    values, weights = [], []
    edges = EDGE_WEIGHTS if edge is None else {edge: 1.0}
    for (model, edge_weight), (load_step, load_weight), (gap_step, gap_weight) in product(
        edges.items(),
        zip(_NORMAL, _WEIGHTS, strict=True),
        zip(_NORMAL[1:-1:2], (0.3, 0.4, 0.3), strict=True),
    ):
        force = middle * math.exp(spread * load_step)
        gap = max(typical * (1.0 + clearance_spread * gap_step), 0.0)
        offset = release_offset(bearing, race, force, gap, model)
        if math.isfinite(offset):
            weight = edge_weight * load_weight * gap_weight
            values += [share * offset for share in SEEN_SHARES]
            weights += [weight * chance for chance in SEEN_SHARES.values()]
    low, middle, high = (
        weighted_quantile(np.array(values), np.array(weights), share)
        for share in (0.025, 0.5, 0.975)
    )
    return low, middle, high
