"""All relative positions of balls and shaft, for least, greatest and mean values over them.

Quantity                                    | Symbol  | Unit
------------------------------------------- | ------- | ----
cage angle                                  | c       | rad
shaft angle, that of inner-race defects too | ψ       | rad
shaft angle relative to the cage, ψ − c     | u       | rad

If defects are at rest, everything repeats after a ball spacing. A defect of the inner race turns
with the shaft, 1/`cage_ratio` times as fast as the cage. This ratio is no simple fraction, so turns
never repeat: in time all pairs (c, ψ) occur equally often. Least, greatest and mean values are
those over both angles, and do not depend on the first position of the defect.

Only c modulo the bearing's period and ψ modulo 2π count. Here u runs over the period and c over a
whole turn. At constant u, balls and defects turn together relative to the load. Results therefore
bend sharply along u, where a ball passes an edge. Nodes in u are at the edges; nodes with the
same drops are solved once.

Cages of unlike rows turn at different speeds. The position of one row relative to another is then a
further angle. It is sampled at ROW_PLACES places, after whole ball spacings of the first row.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.bearings import Bearing
from bearingcore.common import Array, _checks as checks
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import Defect, PackedScene, Scene
from bearingcore.model.scene._defect import floor_bytes
from bearingcore.model.scene._packing import pack
from bearingcore.model.statics._equilibrium import (
    ANGLES_A_PERIOD,
    Equilibrium,
    equilibrium,
    equilibrium_of,
    remove_defects,
)

TWO_PI = 2.0 * math.pi

ALL_AROUND = {"balls": 4, "rollers": 1}
"""Divisor of the number of cage angles per ball spacing where they cover a whole turn, not a single
spacing. The stiffness jumps when a roller takes up load, so rollers keep the full number."""

SINKING = (0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0, 1.25, 1.5, 2.0, 3.0)
"""Drops at which edges get nodes, as multiples of a ball's greatest compression without defects:
near 1 a ball loses contact. In a clearance a lightly loaded ring follows it further."""

FARTHEST_ASIDE = math.radians(80.0)
"""Greatest angle from the load's line at which a ball beside a defect is assumed to carry load."""

FLOOR_NODES = 96
"""Nodes per ball spacing if a floor is not flat, so that the path bends everywhere, or if rows turn
relative to each other."""

ROW_PLACES, FARTHEST = 16, 4096
"""Number of positions of one row relative to another, and of ball spacings to choose them from."""

STARTS, ROUNDS, PARTS = 3, 4, 3
"""Numbers of the search for an extreme: lowest samples to begin with, rounds of refinement, and
parts into which a round divides the distance to each neighbour."""


@dataclass(frozen=True)
class Positions:
    """Grid of cage and shaft angles for all positions; its r rows are not those of the bearing.

    Attributes
    ----------
    columns : (n,) [rad]
        cage angles, rising.
    rows : (r,) [rad]
        shaft angle relative to the cage, rising, within `period`; one value if no defect turns.
    alike : (r,)
        index of each row among the m different rows.
    cage_angles, shaft_angles : (m·n,) [rad]
        the pairs: all columns of the first different row, then of the next.
    weights : (m·n,)
        share of the time of each pair; they sum to 1.
    steps : (2, n) [rad]
        distance of each column to the column before and to the column after.
    period [rad]
        period of the rows.
    shaft_ratio
        shaft angle per cage angle along a row.
    """

    columns: Array
    rows: Array
    alike: NDArray[np.int64]
    cage_angles: Array
    shaft_angles: Array
    weights: Array
    steps: Array
    period: float
    shaft_ratio: float


class Extremes(NamedTuple):
    """Least and greatest values of q quantities, and the angles (2, q) [rad] of these values."""

    least: Array
    greatest: Array
    cage_angles: Array
    shaft_angles: Array


def over_all_positions(
    scene: Scene,
    n: int = ANGLES_A_PERIOD,
    solve: Callable[..., Equilibrium] = equilibrium,
) -> Equilibrium:
    """Return the static equilibrium at all pairs of `positions`, with their weights.

    `solve` is `static_state` for balls with mass.
    """
    places = positions(scene, n)
    state = solve(scene, places.cage_angles, shaft_angles=places.shaft_angles)
    return dataclasses.replace(state, weights=places.weights)


def state_of(
    scene: Scene, state: Equilibrium | None, solve: Callable[..., Equilibrium] = equilibrium
) -> Equilibrium:
    """Return `state`, or if it is None the equilibrium of `over_all_positions`.

    Raises ValueError for the equilibrium of another scene.
    """
    if state is not None and state.scene != scene:
        raise checks.refuse("state", "the equilibrium of another scene", "that of this scene")
    return over_all_positions(scene, solve=solve) if state is None else state


def equilibrium_over_all(packed: PackedScene, n: int) -> Equilibrium:
    """Return `over_all_positions` for a packed scene."""
    places = positions(packed.scene, n)
    state = equilibrium_of(packed, places.cage_angles, places.shaft_angles)
    return dataclasses.replace(state, weights=places.weights)


@lru_cache_by_bytes(
    16_000_000,
    lambda places, scene, _: 24 * places.weights.size + floor_bytes(scene.defects),
)
def positions(scene: Scene, n: int) -> Positions:
    """Return the positions of a scene.

    n is the number of cage angles in the bearing's period, ends included. If a defect turns with
    the shaft, cage angles cover a turn, (n − 1)/ALL_AROUND of them per ball spacing, at least 8.
    They include angles with a ball on the line of the load, or at an edge of the outer race.
    """
    packed, bearing = pack(scene), scene.bearing
    period, ratio = bearing.period, bearing.cage_ratio
    if not scene.defect_turns:
        columns, weights = _cage_angles(packed, n)
        steps = np.full((2, columns.size), columns[1] - columns[0])
        row = np.zeros(1), np.zeros(1, np.int64)
        return Positions(
            columns, *row, columns, columns / ratio, weights, steps, period, 1.0 / ratio
        )
    part = ALL_AROUND["rollers" if bearing.kind.line_contact else "balls"]
    around = max((n - 1) // part, 8) * bearing.n_balls
    load = scene.load
    line = math.atan2(load.fy, load.fx) - bearing.all_rows[0].turn
    even: Array = np.sort((line + TWO_PI / around * np.arange(around)) % TWO_PI)
    if bearing.has_one_cage_speed:
        rows = _nodes(packed, "inner")
        corners = _nodes(packed, "outer")
        periods = period * np.arange(round(TWO_PI / period))
        all_columns = np.concatenate([even, (periods[:, None] - corners).ravel() % TWO_PI])
        columns = np.unique(np.round(all_columns, 12))
        steps = _steps(columns, TWO_PI)
        # Under a light load in a clearance, the ring is nearly free sideways only while a ball is
        # on the line of the load: k_xx is proportional to |x|^(1/3). The mean of this function up
        # to the next nodes is right if this node gives half of its time to its neighbours.
        balls = line + bearing.ball_spacing * np.arange(bearing.n_balls)
        off_line = ~np.isin(columns, np.round(balls % TWO_PI, 12))
        column_shares = 0.5 * steps.mean(axis=0)
        column_shares[off_line] += 0.5 * _steps(columns[off_line], TWO_PI).mean(axis=0)
    else:
        steps = np.full((2, ROW_PLACES * around), TWO_PI / around)
        column_shares = steps[0]
        columns = np.add.outer(_row_places(packed), even).ravel()
        period = bearing.ball_spacing
        rows = np.linspace(0.0, period, FLOOR_NODES, endpoint=False)
    # rows with the same drops into the inner race are solved once, with their common share
    share = _steps(rows, period).mean(axis=0)
    zeros, turned = np.zeros(rows.size), ratio * rows
    drops = np.round(kernels.drops_of(packed.contacts, packed.inner_path, zeros, turned), 14)
    _, first, alike = np.unique(drops, axis=0, return_index=True, return_inverse=True)
    if not bearing.has_one_cage_speed:
        first = alike = np.arange(rows.size)
    shares = np.bincount(alike.ravel(), weights=share)
    cage = np.tile(columns, first.size)
    return Positions(
        columns,
        rows,
        alike.ravel(),
        cage,
        cage + np.repeat(rows[first], columns.size),
        np.outer(shares / shares.sum(), column_shares / column_shares.sum()).ravel(),
        steps,
        period,
        1.0,
    )


def _steps(angles: Array, period: float) -> Array:
    """Return distances (2, n) [rad] of rising angles on a circle to the angle before and after."""
    after = np.diff(angles, append=angles[0] + period)
    return np.stack([np.roll(after, 1), after])


def _cage_angles(packed: PackedScene, n: int) -> tuple[Array, Array]:
    """Return cage angles [rad] over the bearing's period, ends included, and shares of the time."""
    weights, bearing = np.ones(n), packed.scene.bearing
    weights[[0, -1]] = 0.5
    if bearing.has_one_cage_speed:
        return np.linspace(0.0, bearing.period, n), weights / weights.sum()
    places = _row_places(packed)
    angles = (np.linspace(0.0, bearing.ball_spacing, n) + places[:, None]).ravel()
    return angles, np.tile(weights / (weights.sum() * places.size), places.size)


def _row_places(packed: PackedScene) -> Array:
    """Return cage angles (ROW_PLACES,) [rad] at which rows have evenly spread relative positions.

    They are whole ball spacings of the first row.
    """
    speeds = packed.contacts.relative_speed[packed.contacts.rows[:, 0]]
    spacings = np.array([row.ball_spacing for row in packed.rows])
    spacing = spacings[0] / speeds[0]
    others = speeds != speeds[0]
    turned = speeds[others] / spacings[others] * spacing
    reached = np.arange(FARTHEST)[:, None] * turned % 1.0
    odd = 2 * np.arange(turned.size) + 1  # a lattice rule, if several rows differ
    targets = np.arange(ROW_PLACES)[:, None] * odd / ROW_PLACES % 1.0
    distance = np.abs((reached - targets[:, None] + 0.5) % 1.0 - 0.5).max(axis=2)
    return np.asarray(distance.argmin(axis=1) * spacing)


def _nodes(packed: PackedScene, race: str) -> Array:
    """Return rising angles of a race relative to the cage [rad] at which balls pass its edges."""
    scene = packed.scene
    bearing, period = scene.bearing, scene.bearing.period
    angles = [np.zeros(1 if race == "inner" else 0)]
    for defect, (k, row) in product(scene.defects, enumerate(bearing.all_rows)):
        if defect.race != race or defect.row not in (None, k):
            continue
        row_bearing = packed.rows[k]
        balls = row.turn + row_bearing.ball_spacing * np.arange(row_bearing.n_balls)
        places = _places_on_edges(defect, row_bearing, _greatest_compression(packed, k))
        angles.append((balls[:, None] - places).ravel())
        if defect.floor is not None:
            spacings = round(period / row_bearing.ball_spacing)
            angles.append(np.linspace(0.0, period, FLOOR_NODES * spacings + 1))
    nodes = np.unique(np.round(np.concatenate(angles) % period, 12))
    return nodes[nodes < period - 1e-11]


def _places_on_edges(defect: Defect, bearing: Bearing, compression: float) -> Array:
    """Return angles [rad] of a ball at both edges, at the floor and at some drops between."""
    half = 0.5 * defect.extent
    # in a clearance the ring follows a sinking ball until the balls beside the defect carry load
    aside = math.cos(min(half + bearing.ball_spacing, FARTHEST_ASIDE))
    followed = compression + max(bearing.radial_clearance, 0.0) * (1.0 / aside - 1.0)
    sizes = (compression, followed) if followed > 2.0 * compression else (compression,)
    drops = {min(share * size, defect.depth) for share in SINKING for size in sizes}
    drops.add(defect.depth)
    all_around = defect.extent >= TWO_PI
    inwards = [0.0 if all_around else defect.edge_width(bearing, drop) for drop in drops]
    away = half - np.minimum(inwards, half)
    return np.asarray(defect.center + np.concatenate([-away, away]))


def _greatest_compression(packed: PackedScene, row: int) -> float:
    """Return the greatest compression [m] in a row of the healthy bearing; 0 if unknown."""
    healthy, contacts = remove_defects(packed), packed.contacts
    state = equilibrium_of(healthy, np.linspace(0.0, packed.scene.bearing.period, 13))
    first, count = contacts.rows[row]
    loads = np.nan_to_num(state.ball_load[:, first : first + count])
    return contacts.compression(float(loads.max(initial=0.0)), first)


def _lowest(values: Array) -> NDArray[np.int64]:
    """Return the places (STARTS, q) of the lowest local minima of values (q, r, n)."""
    q, r, n = values.shape
    low = np.ones(values.shape, dtype=bool)
    for axis, shift in product((1, 2), (1, -1)):
        low &= values <= np.roll(values, shift, axis=axis)
    order = np.where(low, values, math.inf).reshape(q, r * n)
    lowest = np.argpartition(order, min(STARTS, r * n - 1), axis=1)[:, :STARTS].T
    lowest[0] = values.reshape(q, r * n).argmin(axis=1)
    return lowest


def extremes(
    places: Positions,
    values: Array,
    evaluate: Callable[[Array, Array], Array],
    *,
    rounds: int = ROUNDS,
) -> Extremes:
    """Return least and greatest values of q quantities over all positions; NaN if none is known.

    The surroundings of each extreme of the grid are searched on finer and finer grids.

    Parameters
    ----------
    values : (q, m·n)
        quantities at the pairs of `places`; NaN does not count.
    evaluate
        function that returns the quantities (q, k) at cage and shaft angles (k,).
    rounds
        number of rounds; each grid is PARTS times finer.
    """
    # values (2 q, rows, columns) of the whole grid, with both signs
    r, n, q = places.rows.size, places.columns.size, len(values)
    whole = values.reshape(q, places.weights.size // n, n)[:, places.alike].reshape(q, r * n)
    signed = np.concatenate([whole, -whole])  # a greatest value is the least negative one
    signed = np.where(np.isnan(signed), math.inf, signed)
    # the lowest samples, at cage angles c and shaft against cage u, from which the search starts
    starts = _lowest(signed.reshape(2 * q, r, n))
    best = np.take_along_axis(signed.T, starts, axis=0)
    changes = np.isfinite(best) & (signed.max(axis=1) > best)  # constant quantities need no search
    row, column = np.divmod(starts, n)
    c, u = places.columns[column], places.rows[row]
    turn, aside = places.steps[:, column], _steps(places.rows, places.period)[:, row]
    parts = np.arange(-PARTS, PARTS + 1) / PARTS
    across = parts if r > 1 else np.zeros(1)
    side = np.sign(parts).astype(int).clip(0)  # 0 towards the neighbour before, 1 after
    quantity = np.broadcast_to(np.arange(2 * q), starts.shape)[changes]
    # each round evaluates a finer grid around the best place so far, and moves to its lowest point
    for _ in range(rounds if quantity.size else 0):
        cs = c[changes][:, None] + turn[side][:, changes].T * parts
        us = u[changes][:, None] + aside[side[: across.size]][:, changes].T * across
        pairs = np.broadcast_arrays(cs[:, None, :], us[:, :, None])
        # many quantities have an extreme in common
        where, back = np.unique(np.stack([cs[:, 0], us[:, 0]]), axis=1, return_index=True,
                                return_inverse=True)[1:]  # fmt: skip
        cage = pairs[0][where].ravel()
        shaft = places.shaft_ratio * cage + pairs[1][where].ravel()
        answers = evaluate(cage, shaft).reshape(q, where.size, -1)
        tried = np.where(quantity < q, 1.0, -1.0)[:, None] * answers[quantity % q, back.ravel()]
        tried = np.where(np.isnan(tried), math.inf, tried)
        i, k = np.divmod(tried.argmin(axis=1), parts.size)
        lower = tried.min(axis=1) <= best[changes]
        index = np.arange(quantity.size)
        c[changes] = np.where(lower, cs[index, k], c[changes])
        u[changes] = np.where(lower, us[index, i], u[changes])
        best[changes] = np.minimum(best[changes], tried.min(axis=1))
        turn, aside = turn / PARTS, aside / PARTS
    # the lowest result of all starts
    better = best.argmin(axis=0)
    least, c, u = (np.take_along_axis(x, better[None], axis=0)[0] for x in (best, c, u))
    least = np.where(np.isinf(least), math.nan, least)
    return Extremes(
        least[:q], -least[q:], c.reshape(2, q), (places.shaft_ratio * c + u).reshape(2, q)
    )
