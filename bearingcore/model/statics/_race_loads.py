"""Long-run load of every place of a race, and the one load that tires it as much.

Quantity                                         | Symbol | Name            | Unit
------------------------------------------------ | ------ | --------------- | ----
load of a ball                                   | Q      |                 | N
exponent of load against life                    | p      | load_exponent   |
exponent of the scatter of lives (Weibull)       | e      | scatter         |
place on the standing outer race                 | φ      |                 | rad
place on the inner race, which turns with the shaft | θ   |                 | rad
angle of the shaft                               | ψ      |                 | rad

Two averages follow each other (Lundberg and Palmgren; Harris, chapter "Fatigue life"):

- one place of a race sees one load after the other. Each uses up life as Q^p (Palmgren, Miner), so
  the place lives as under mean(Q^p)^(1/p), the mean over everything that passes it;
- a race lives until the first of its places fails: lives combine as Σ L^(−e) (Weibull), so the race
  lives as under mean(Q^(p e))^(1/(p e)), the mean over its places.

A place of the standing race of a healthy bearing always sees the same load, a place of the turning
race sees all of them, which leaves the second average alone for the one and the first alone for the
other: the two means of ISO 16281. A defect breaks this up, as it is in one of the races:

- in the outer race it keeps to the load too, and nothing changes: a ball that comes to φ finds the
  cage, the other balls and the defect as every ball before it did;
- in the inner race it turns against the load, so that every place of either race sees varying
  loads, and places of one race differ: both averages are needed for both races.

Each row has races of its own, which all have to live: their lives combine as those of places do.

Rows whose cages turn at speeds of their own take all positions to each other in the long run:
loads are then averaged over a whole turn of the cage, and over TURNS_OF_ROWS ways in which the rows
are turned to each other, spread evenly. What passes a standing place then varies a little; that is
counted by the second average too, which is on the safe side.

Balls with mass press the outer race harder than the inner one, by their centrifugal load: each race
has loads of its own (`static_state`).

A race of rollers is a chain of laminae too, each of which has places and loads of its own: all of
this holds for each of them (`bearingcore.model.statics._laminae`).

The integrals are taken over panels that end where a ball meets an edge or a floor.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.common import Array, _checks as checks
from bearingcore.model.scene import Defect, Scene
from bearingcore.model.statics._ball_positions import static_state
from bearingcore.model.statics._equilibrium import Equilibrium
from bearingcore.model.statics._laminae import carried, strips
from bearingcore.model.statics._status import StaticStatus

PANELS, PANELS_ON_AN_EDGE = 16, 6
"""Panels in a ball spacing, and between an edge and where a ball meets the floor: somewhere in
there it lets go, within a small part of that angle."""

PANELS_ON_A_FLOOR = 96
"""Panels in a ball spacing where a floor is not flat: its path bends everywhere."""

POINTS = 4
"""Gauss points in a panel."""

SHAFT_ANGLES, SHAFT_ANGLES_BOTH = 61, 361
"""Shaft angles in a turn, with defects in the inner race alone, and in both: the second kind meet
the balls at every place of the inner race, so no panel can end there. Odd, so that no wave of a
series is its own mirror image."""

TURNS_OF_ROWS = 16
SPREAD = (0, 1, 5, 7, 3, 11, 13, 9)
"""Ways in which rows are turned to each other, and how many of their parts of a spacing each cage
speed takes from one to the next: odd ones, so that every part is met once (a lattice rule)."""

FINER = 4
"""Places of the outer race for each shaft angle."""


class RaceLoads(NamedTuple):
    """The load [N] that tires each race as much as all that it carries, and the greatest of all.

    Of inner and outer race one for each row. NaN where the loads of some cage angle are not known;
    `status` and `reason` then say why, and are CONVERGED and empty otherwise.
    """

    inner: tuple[float, ...]
    outer: tuple[float, ...]
    heaviest: float
    status: int = StaticStatus.CONVERGED
    reason: str = ""

    @property
    def load_of_rows(self) -> Array:
        """(rows, 2) [N] of the inner and the outer race of each row."""
        return np.stack([self.inner, self.outer], axis=1)


def snapshot_loads(
    scene: Scene, cage_angle: float, load_exponent: float, scatter: float
) -> RaceLoads:
    """The means over the balls at one cage angle [rad], as a standard takes them.

    Right for a healthy bearing with rows alike. Half a ball spacing on is looked at too: where the
    bearing carries nothing there, it has no life.
    """
    state = static_state(scene, [cage_angle, cage_angle + 0.5 * scene.bearing.ball_spacing])
    loads = carried(state)
    if unknown := _unknown(state, loads):
        return unknown
    heaviest = float(state.ball_load[0].max())
    return _averaged(scene, loads[:, :1], heaviest, np.full(1, 1.0), load_exponent, scatter)


def race_loads(scene: Scene, load_exponent: float, scatter: float) -> RaceLoads:
    """The means over all cage angles, and over all shaft angles where a defect turns.

    ValueError for a defect of the inner race of a bearing whose rows are not alike.
    """
    if scene.defect_turns:
        return _average_turning_defects(scene, load_exponent, scatter)
    loads, weights, heaviest = [], [], 0.0
    turned = _rows_turned(scene)
    for defect in turned:
        places, weight = _panels(defect, "outer")
        state = static_state(defect, places)
        loads.append(carried(state))
        if unknown := _unknown(state, loads[-1]):
            return unknown
        heaviest = max(heaviest, float(state.ball_load.max()))
        weights.append(weight / len(turned))
    all_loads, all_weights = np.concatenate(loads, axis=1), np.concatenate(weights)
    return _averaged(scene, all_loads, heaviest, all_weights, load_exponent, scatter)


def _rows_turned(scene: Scene) -> list[Scene]:
    """The scene with its rows turned to each other as they come to be; itself where they stay."""
    bearing = scene.bearing
    if bearing.has_one_cage_speed:
        return [scene]
    paces = [bearing.pace(k) for k in range(len(bearing.rows))]
    kinds = sorted(set(paces))
    scenes = []
    for i in range(TURNS_OF_ROWS):
        rows = []
        for k, row in enumerate(bearing.rows):
            alike = [bearing.of_row(other).n_balls for other, pace in enumerate(paces)
                     if pace == paces[k]]  # fmt: skip
            part = (i * SPREAD[kinds.index(paces[k])] / TURNS_OF_ROWS) % 1.0
            turn = math.remainder(row.turn + part * 2.0 * math.pi / math.gcd(*alike), 2.0 * math.pi)
            rows.append(dataclasses.replace(row, turn=turn))
        scenes.append(dataclasses.replace(scene, bearing=bearing.replace(rows=tuple(rows))))
    return scenes


def _averaged(
    scene: Scene,
    loads: Array,
    heaviest: float,
    weights: Array,
    load_exponent: float,
    scatter: float,
) -> RaceLoads:
    """Both races under what is `carried` (2, n, balls), where nothing turns against the load."""
    chain = load_exponent * scatter
    powers = load_exponent, chain
    inner, outer = (
        tuple(
            combined_load(
                [_mean(strip, weights, power) for strip in strips(scene.bearing, row, chain)], chain
            )
            for row in (carried_there[:, balls] for balls in scene.bearing.balls_of_rows)
        )
        for carried_there, power in zip(loads, powers, strict=True)
    )
    return RaceLoads(inner, outer, heaviest)


def combined_load(loads: Sequence[float], power: float) -> float:
    """Return the one load that tires as much as all loads do, each on a part that has to live."""
    size = max(loads)
    if len(loads) == 1 or not size > 0.0:
        return size
    return float(size * sum((load / size) ** power for load in loads) ** (1.0 / power))


def _mean(loads: Array, weights: Array, power: float) -> float:
    """Power mean of loads (n, N_b) with weights (n,) that sum to 1; scaled, so none overflows."""
    size = float(loads.max(initial=0.0))
    if size == 0.0:
        return 0.0
    return size * float(weights @ np.mean((loads / size) ** power, axis=1)) ** (1.0 / power)


def _unknown(state: Equilibrium, loads: Array) -> RaceLoads | None:
    """NaN with the reason, where the loads of some cage angle are not known; None where all are."""
    failed = np.flatnonzero(~np.isfinite(loads).all(axis=(0, 2)))
    if not failed.size:
        return None
    first = int(failed[0])
    nothing = (math.nan,) * len(state.scene.bearing.all_rows)
    status, reason = int(state.status[first]), state.reason(first)
    if status == StaticStatus.CONVERGED:  # of straight rollers
        status, reason = StaticStatus.NOT_CONVERGED, "rollers with their profile: not converged"
    return RaceLoads(nothing, nothing, math.nan, int(status), reason)


def _panels(scene: Scene, race: str) -> tuple[Array, Array]:
    """Places [rad] of a ball over the bearing's period, and weights that sum to 1."""
    bearing, period = scene.bearing, scene.bearing.period
    spacings = max(round(period / bearing.ball_spacing), 1)
    defects = [defect for defect in scene.defects if defect.race == race]
    rough = any(defect.floor is not None for defect in defects)
    even = np.linspace(0.0, period, (PANELS_ON_A_FLOOR if rough else PANELS) * spacings + 1)
    corners = []
    for defect, (k, row) in product(defects, enumerate(bearing.all_rows)):
        row_bearing = bearing.of_row(k)
        spacing = row_bearing.ball_spacing / bearing.pace(k)
        for corner in _corners(defect, row_bearing):
            at = (corner - row.turn) / bearing.pace(k) % spacing
            corners += np.arange(at, period, spacing).tolist()
    ends = np.unique(np.concatenate([even, corners]))
    ends = ends[np.diff(ends, prepend=-1.0) > 1e-12]
    x, w = np.polynomial.legendre.leggauss(POINTS)
    half, middle = 0.5 * np.diff(ends), 0.5 * (ends[1:] + ends[:-1])
    places = middle[:, None] + half[:, None] * x
    weights = half[:, None] * w / period
    return places.ravel(), weights.ravel()


def _corners(defect: Defect, bearing: Bearing) -> list[float]:
    """Angles [rad] of the defect's edges, of where a ball meets its floor, and some between."""
    half = 0.5 * defect.extent
    to_floor = min(float(defect.edge_row(bearing)[4]), half)
    away = half - to_floor * np.linspace(0.0, 1.0, PANELS_ON_AN_EDGE + 1)
    return [defect.center + side * a for side in (-1.0, 1.0) for a in away.tolist()]


def _average_turning_defects(scene: Scene, load_exponent: float, scatter: float) -> RaceLoads:
    """`race_loads` where cage and shaft angle matter both, as their ratio is no simple fraction.

    Balls are put at fixed places θ of the inner race, where panels can end at its edges, and the
    shaft turns with them: ψ in equal steps, as nothing has edges there.
    """
    bearing, ratio = scene.bearing, scene.bearing.cage_ratio
    if not bearing.rows_are_alike:
        raise checks.refuse(
            "race of a defect", "inner", "outer, for the life of rows that are not alike"
        )
    both = any(defect.race == "outer" for defect in scene.defects)
    n = SHAFT_ANGLES_BOTH if both else SHAFT_ANGLES
    places, weights = _panels(scene, "inner")
    # a ball at the cage angle c is at θ = c − ψ of an inner race turned by ψ = ψ_0 + c/ratio
    first = 2.0 * math.pi * np.arange(n) / n * (ratio - 1.0) / ratio
    offset = places / (ratio - 1.0)  # ψ at the first of the n steps
    loads = np.empty((2, n, places.size, bearing.total_balls))
    heaviest = 0.0
    for k, psi_0 in enumerate(first):
        turned = dataclasses.replace(scene, defect=_turned(scene, float(psi_0)))
        state = static_state(turned, (places + psi_0) * ratio / (ratio - 1.0))
        loads[:, k] = carried(state)
        if unknown := _unknown(state, loads[:, k]):
            return unknown
        heaviest = max(heaviest, float(state.ball_load.max()))
    chain = load_exponent * scatter
    order = np.arange(n // 2 + 1)[:, None, None]

    def inner_race(load: Array, theta: Array) -> float:
        """Equivalent load under loads (n, places, N_b) of balls at places θ."""
        size = float(load.max()) or 1.0
        used = (load / size) ** load_exponent
        along = float(weights @ np.mean(np.mean(used, axis=0) ** scatter, axis=1))
        return size * along ** (1.0 / chain)

    def outer_race(load: Array, theta: Array) -> float:
        """Equivalent load of the outer race: its place φ meets θ at ψ = φ − θ, by a series in ψ."""
        size = float(load.max()) or 1.0
        series = np.fft.rfft((load / size) ** load_exponent, axis=0) / n
        shifted = series * np.exp(-1j * order * (theta + offset[:, None]))
        passing = np.fft.irfft(np.mean(shifted, axis=2) @ weights, FINER * n) * (FINER * n)
        standing = float(np.mean(np.maximum(passing, 0.0) ** scatter))
        return size * standing ** (1.0 / chain)

    thetas = [
        places[:, None] + row.turn + bearing.ball_spacing * np.arange(bearing.n_balls)
        for row in bearing.all_rows
    ]
    inner, outer = (
        tuple(
            combined_load([race(strip, theta) for strip in strips(bearing, row, chain)], chain)
            for theta, row in zip(thetas, np.split(there, len(thetas), axis=2), strict=True)
        )
        for race, there in zip((inner_race, outer_race), loads, strict=True)
    )
    return RaceLoads(inner, outer, heaviest)


def _turned(scene: Scene, angle: float) -> tuple[Defect, ...]:
    """The scene's defects, those of the inner race turned by an angle [rad]."""
    return tuple(
        dataclasses.replace(defect, center=defect.center + angle)
        if defect.race == "inner"
        else defect
        for defect in scene.defects
    )
