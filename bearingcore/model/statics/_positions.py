"""All positions that balls and shaft take to each other, for what is said over all of them.

Quantity                                    | Symbol  | Unit
------------------------------------------- | ------- | ----
cage angle                                  | c       | rad
shaft angle, that of inner-race defects too | ψ       | rad
shaft against cage, ψ − c                   | u       | rad

With defects at rest all repeats after a ball spacing. A defect of the inner race turns with the
shaft, 1/`cage_ratio` times as fast as the cage. That is no simple fraction, so no turn is like the
one before: in time all pairs (c, ψ) occur, each as often as any other. Least, greatest and mean are
those over both angles; where the defect began does not matter.

Only c modulo the bearing's period and ψ modulo 2π count. Here u runs over the period and c over a
whole turn: at one u balls and defects turn together against the load, so that whatever bends
sharply, the path of a ball over the edges, does so along u. Nodes in u end at the edges; nodes
between which no drop changes are solved once.

Cages of unlike rows turn at speeds of their own. The place of one row against the other is then a
further angle; it is taken at ROW_PLACES places, which whole ball spacings of the first row lead to.
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
"""Factors by which cage angles to a ball spacing are fewer all around, at least 8. The
stiffness of a roller jumps as it comes to carry, so that its angles are not fewer."""

SINKING = (0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0, 1.25, 1.5, 2.0, 3.0)
"""Drops at which nodes are put on an edge, over the greatest compression of a ball in the bearing
without defects: about there it lets go. With clearance a light load follows it further."""

FARTHEST_ASIDE = math.radians(80.0)
"""Angle from the load's line up to which a ball is taken to carry beside a defect."""

ON_A_FLOOR = 96
"""Nodes in a ball spacing where a floor is not flat, so that its path bends everywhere, or where
rows turn against each other."""

ROW_PLACES, FARTHEST = 16, 4096
"""Places of a row against the other, and of how many ball spacings they are picked."""

STARTS, ROUNDS, PARTS = 3, 4, 3
"""Numbers of the search for an extreme: lowest samples it looks around, rounds of looking closer,
and parts into which it divides the distance to each neighbour."""


@dataclass(frozen=True)
class Positions:
    """Pairs of cage and shaft angle that stand for all that occur: a grid of r rows, n columns.

    Attributes
    ----------
    columns : (n,) [rad]
        cage angles, rising.
    rows : (r,) [rad]
        shaft against cage, rising, within `period`; one number where nothing turns.
    alike : (r,)
        which of m rows that differ each row is.
    cage_angles, shaft_angles : (m·n,) [rad]
        the pairs: all columns of the first row that differs, then of the next.
    weights : (m·n,)
        their share of the time; they sum to 1.
    steps : (2, n) [rad]
        from each column to the one before and to the one after.
    period [rad]
        of the rows.
    shaft_ratio
        turning of the shaft with the cage along a row.
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
    """Least and greatest of q quantities, and the angles (2, q) [rad] at which they are so."""

    least: Array
    greatest: Array
    cage_angles: Array
    shaft_angles: Array


def over_all_positions(
    scene: Scene,
    n: int = ANGLES_A_PERIOD,
    solve: Callable[..., Equilibrium] = equilibrium,
) -> Equilibrium:
    """Static equilibrium at all pairs of `positions`, with their weights.

    `solve` is `static_state` for balls with mass.
    """
    places = positions(scene, n)
    state = solve(scene, places.cage_angles, shaft_angles=places.shaft_angles)
    return dataclasses.replace(state, weights=places.weights)


def state_of(
    scene: Scene, state: Equilibrium | None, solve: Callable[..., Equilibrium] = equilibrium
) -> Equilibrium:
    """The equilibrium of a scene that was passed, else that of `over_all_positions`.

    ValueError for the equilibrium of another scene.
    """
    if state is not None and state.scene != scene:
        raise checks.refuse("state", "the equilibrium of another scene", "that of this scene")
    return over_all_positions(scene, solve=solve) if state is None else state


def equilibrium_over_all(packed: PackedScene, n: int) -> Equilibrium:
    """`over_all_positions` of a scene that is packed."""
    places = positions(packed.scene, n)
    state = equilibrium_of(packed, places.cage_angles, places.shaft_angles)
    return dataclasses.replace(state, weights=places.weights)


@lru_cache_by_bytes(
    16_000_000,
    lambda places, scene, _: 24 * places.weights.size + floor_bytes(scene.defects),
)
def positions(scene: Scene, n: int) -> Positions:
    """The positions of a scene.

    n : cage angles to the bearing's period, ends included, where no defect turns with the shaft.
    Else (n − 1)/ALL_AROUND to each ball spacing, all around, with one where the ball is on the line
    of the load, and further ones where it meets an edge of the outer race.
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
        whole = period * np.arange(round(TWO_PI / period))
        every = np.concatenate([even, (whole[:, None] - corners).ravel() % TWO_PI])
        columns = np.unique(np.round(every, 12))
        steps = _steps(columns, TWO_PI)
        # Under a light load in a clearance a ball on the line, and only there, leaves the ring
        # nearly free aside: k_xx goes with |x|^(1/3). Its mean up to the neighbours takes half of
        # that node's time; the other half is theirs.
        balls = line + bearing.ball_spacing * np.arange(bearing.n_balls)
        off_line = ~np.isin(columns, np.round(balls % TWO_PI, 12))
        of_columns = 0.5 * steps.mean(axis=0)
        of_columns[off_line] += 0.5 * _steps(columns[off_line], TWO_PI).mean(axis=0)
    else:
        steps = np.full((2, ROW_PLACES * around), TWO_PI / around)
        of_columns = steps[0]
        columns = np.add.outer(_row_places(packed), even).ravel()
        period = bearing.ball_spacing
        rows = np.linspace(0.0, period, ON_A_FLOOR, endpoint=False)
    share = _steps(rows, period).mean(axis=0)
    still, turned = np.zeros(rows.size), ratio * rows
    drops = np.round(kernels.drops_of(packed.contacts, packed.inner_path, still, turned), 14)
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
        np.outer(shares / shares.sum(), of_columns / of_columns.sum()).ravel(),
        steps,
        period,
        1.0,
    )


def _steps(angles: Array, period: float) -> Array:
    """Distances (2, n) [rad] of rising angles on a circle to those before and after them."""
    after = np.diff(angles, append=angles[0] + period)
    return np.stack([np.roll(after, 1), after])


def _cage_angles(packed: PackedScene, n: int) -> tuple[Array, Array]:
    """Cage angles [rad] over the bearing's period, ends included, and their shares of the time."""
    weights, bearing = np.ones(n), packed.scene.bearing
    weights[[0, -1]] = 0.5
    if bearing.has_one_cage_speed:
        return np.linspace(0.0, bearing.period, n), weights / weights.sum()
    places = _row_places(packed)
    angles = (np.linspace(0.0, bearing.ball_spacing, n) + places[:, None]).ravel()
    return angles, np.tile(weights / (weights.sum() * places.size), places.size)


def _row_places(packed: PackedScene) -> Array:
    """Cage angles (ROW_PLACES,) [rad], whole ball spacings, after which rows are evenly turned."""
    speeds = packed.contacts.relative_speed[packed.contacts.rows[:, 0]]
    spacings = np.array([row.ball_spacing for row in packed.rows])
    spacing = spacings[0] / speeds[0]
    others = speeds != speeds[0]
    turned = speeds[others] / spacings[others] * spacing
    reached = np.arange(FARTHEST)[:, None] * turned % 1.0
    odd = 2 * np.arange(turned.size) + 1  # a lattice rule, if there are several
    wanted = np.arange(ROW_PLACES)[:, None] * odd / ROW_PLACES % 1.0
    away = np.abs((reached - wanted[:, None] + 0.5) % 1.0 - 0.5).max(axis=2)
    return np.asarray(away.argmin(axis=1) * spacing)


def _nodes(packed: PackedScene, race: str) -> Array:
    """Race against cage [rad] over the period, rising: where balls meet an edge, and between."""
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
            angles.append(np.linspace(0.0, period, ON_A_FLOOR * spacings + 1))
    nodes = np.unique(np.round(np.concatenate(angles) % period, 12))
    return nodes[nodes < period - 1e-11]


def _places_on_edges(defect: Defect, bearing: Bearing, compression: float) -> Array:
    """Angles [rad] of a ball at both edges, where it meets the floor, and on the way there."""
    half = 0.5 * defect.extent
    # with clearance the ring follows a ball that sinks until those beside the defect carry
    aside = math.cos(min(half + bearing.ball_spacing, FARTHEST_ASIDE))
    followed = compression + max(bearing.radial_clearance, 0.0) * (1.0 / aside - 1.0)
    sizes = (compression, followed) if followed > 2.0 * compression else (compression,)
    drops = {min(share * size, defect.depth) for share in SINKING for size in sizes}
    drops.add(defect.depth)
    whole = defect.extent >= TWO_PI
    inwards = [0.0 if whole else defect.edge_width(bearing, drop) for drop in drops]
    away = half - np.minimum(inwards, half)
    return np.asarray(defect.center + np.concatenate([-away, away]))


def _greatest_compression(packed: PackedScene, row: int) -> float:
    """Greatest compression [m] in a row of the bearing without defects; 0 where none is known."""
    healthy, contacts = remove_defects(packed), packed.contacts
    state = equilibrium_of(healthy, np.linspace(0.0, packed.scene.bearing.period, 13))
    first, count = contacts.rows[row]
    loads = np.nan_to_num(state.ball_load[:, first : first + count])
    return contacts.compression(float(loads.max(initial=0.0)), first)


def _lowest(values: Array) -> NDArray[np.int64]:
    """Places (STARTS, q) of the lowest of values (q, r, n) that are below those around them."""
    q, r, n = values.shape
    low = np.ones(values.shape, dtype=bool)
    for axis, by in product((1, 2), (1, -1)):
        low &= values <= np.roll(values, by, axis=axis)
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
    """Least and greatest of q quantities over all positions; NaN where none is known.

    Parameters
    ----------
    values : (q, m·n)
        at the pairs of `places`; what is NaN does not count.
    evaluate
        gives the quantities (q, k) at cage and shaft angles (k,): around each extreme of the grid
        they are looked at ever closer.
    rounds
        number of rounds; each looks PARTS times closer.
    """
    r, n, q = places.rows.size, places.columns.size, len(values)
    whole = values.reshape(q, places.weights.size // n, n)[:, places.alike].reshape(q, r * n)
    signed = np.concatenate([whole, -whole])  # the least of each is looked for
    signed = np.where(np.isnan(signed), math.inf, signed)
    starts = _lowest(signed.reshape(2 * q, r, n))
    best = np.take_along_axis(signed.T, starts, axis=0)
    changes = np.isfinite(best) & (signed.max(axis=1) > best)
    row, column = np.divmod(starts, n)
    c, u = places.columns[column], places.rows[row]
    turn, ways = places.steps[:, column], _steps(places.rows, places.period)[:, row]
    parts = np.arange(-PARTS, PARTS + 1) / PARTS
    across = parts if r > 1 else np.zeros(1)
    side = np.sign(parts).astype(int).clip(0)
    of = np.broadcast_to(np.arange(2 * q), starts.shape)[changes]
    for _ in range(rounds if of.size else 0):
        cs = c[changes][:, None] + turn[side][:, changes].T * parts
        us = u[changes][:, None] + ways[side[: across.size]][:, changes].T * across
        pairs = np.broadcast_arrays(cs[:, None, :], us[:, :, None])
        # many quantities have an extreme in common
        where, back = np.unique(np.stack([cs[:, 0], us[:, 0]]), axis=1, return_index=True,
                                return_inverse=True)[1:]  # fmt: skip
        cage = pairs[0][where].ravel()
        shaft = places.shaft_ratio * cage + pairs[1][where].ravel()
        new = evaluate(cage, shaft).reshape(q, where.size, -1)
        tried = np.where(of < q, 1.0, -1.0)[:, None] * new[of % q, back.ravel()]
        tried = np.where(np.isnan(tried), math.inf, tried)
        at = tried.argmin(axis=1)
        i, k = np.divmod(at, parts.size)
        lower = tried.min(axis=1) <= best[changes]
        each = np.arange(of.size)
        c[changes] = np.where(lower, cs[each, k], c[changes])
        u[changes] = np.where(lower, us[each, i], u[changes])
        best[changes] = np.minimum(best[changes], tried.min(axis=1))
        turn, ways = turn / PARTS, ways / PARTS
    better = best.argmin(axis=0)
    least, c, u = (np.take_along_axis(x, better[None], axis=0)[0] for x in (best, c, u))
    least = np.where(np.isinf(least), math.nan, least)
    return Extremes(
        least[:q], -least[q:], c.reshape(2, q), (places.shaft_ratio * c + u).reshape(2, q)
    )
