"""Equivalent load of a race: the constant load with the same life as all loads on its places.

Quantity                                         | Symbol | Name            | Unit
------------------------------------------------ | ------ | --------------- | ----
load of a ball                                   | Q      |                 | N
exponent of load against life                    | p      | load_exponent   |
exponent of the scatter of lives (Weibull)       | e      | scatter         |
place on the standing outer race                 | φ      |                 | rad
place on the inner race, which turns with the shaft | θ   |                 | rad
angle of the shaft                               | ψ      |                 | rad

Two averages follow each other (Lundberg and Palmgren; Harris, chapter "Fatigue life"):

- A place of a race carries one load after another. Each load consumes life as Q^p (Palmgren,
  Miner), so the equivalent load of the place is mean(Q^p)^(1/p) over all loads that pass it.
- A race fails with the first of its places. Lives combine as Σ L^(−e) (Weibull), so the equivalent
  load of the race is mean(Q^(p e))^(1/(p e)) over its places.

In a healthy bearing a place of the standing race always carries the same load, and only the second
average is needed. A place of the turning race carries all loads, and only the first average is
needed. These are the two means of ISO 16281. With a defect it depends on the race:

- A defect of the outer race stands still like the load, and nothing changes: each ball at φ meets
  the same cage, balls and defect.
- A defect of the inner race turns relative to the load. Every place of both races carries varying
  loads, and places of a race differ: both averages are needed for both races.

Each row has its races. The bearing fails with the first of them, so lives combine as those of
places do.

Rows with different cage speeds take all relative positions in the long run. Loads are then averaged
over a whole turn of the cage, and over TURNS_OF_ROWS evenly spread relative positions. The loads on
a standing place then vary a little; they are averaged by the second mean too, on the safe side.

Balls with mass press the outer race harder than the inner one, by their centrifugal load, so loads
of both races differ (`static_state`). A race of rollers also consists of laminae, and all of this
holds for each lamina (`bearingcore.model.statics._laminae`).

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
from bearingcore.model.statics._laminae import loads_or_compressions, strips
from bearingcore.model.statics._status import StaticStatus

PANELS, PANELS_ON_AN_EDGE = 16, 6
"""Panels per ball spacing, and between an edge and the place where a ball meets the floor. There a
ball loses contact within a small part of the angle."""

PANELS_ON_A_FLOOR = 96
"""Panels per ball spacing if a floor is not flat, so that the path bends everywhere."""

POINTS = 4
"""Gauss points per panel."""

SHAFT_ANGLES, SHAFT_ANGLES_BOTH = 61, 361
"""Shaft angles per turn, with defects in the inner race alone, and in both races. Balls meet an
outer defect at every place of the inner race, so no panels can end there. The numbers are odd, so
that no term of a series is its own mirror image."""

TURNS_OF_ROWS = 16
SPREAD = (0, 1, 5, 7, 3, 11, 13, 9)
"""Number of relative positions of rows, and the steps of each cage speed from one position to the
next, in parts of a ball spacing. They are odd, so that each part occurs once (a lattice rule)."""

FINER = 4
"""Number of places of the outer race for each shaft angle."""


class RaceLoads(NamedTuple):
    """Equivalent loads [N] of the inner and outer race of each row, and the heaviest load.

    They are NaN if the loads of some cage angle are unknown. `status` and `reason` then say why;
    otherwise they are CONVERGED and empty.
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
    """Return the means over the balls at one cage angle [rad], as the standard takes them.

    They are right for a healthy bearing with identical rows. The state half a ball spacing later
    must have known loads too.
    """
    state = static_state(scene, [cage_angle, cage_angle + 0.5 * scene.bearing.ball_spacing])
    loads = loads_or_compressions(state)
    if unknown := _unknown(state, loads):
        return unknown
    heaviest = float(state.ball_load[0].max())
    return _averaged(scene, loads[:, :1], heaviest, np.full(1, 1.0), load_exponent, scatter)


def race_loads(scene: Scene, load_exponent: float, scatter: float) -> RaceLoads:
    """Return the means over all cage angles, and over all shaft angles if a defect turns.

    Raises ValueError for an inner-race defect in a bearing with unlike rows.
    """
    if scene.defect_turns:
        return _average_turning_defects(scene, load_exponent, scatter)
    loads, weights, heaviest = [], [], 0.0
    turned = _rows_turned(scene)
    for defect in turned:
        places, weight = _panels(defect, "outer")
        state = static_state(defect, places)
        loads.append(loads_or_compressions(state))
        if unknown := _unknown(state, loads[-1]):
            return unknown
        heaviest = max(heaviest, float(state.ball_load.max()))
        weights.append(weight / len(turned))
    all_loads, all_weights = np.concatenate(loads, axis=1), np.concatenate(weights)
    return _averaged(scene, all_loads, heaviest, all_weights, load_exponent, scatter)


def _rows_turned(scene: Scene) -> list[Scene]:
    """Return the scene with rows in all relative positions; itself if these do not change."""
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
    """Return both races under `carried` loads (2, n, balls), if no defect turns with the shaft."""
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
    """Return the equivalent load of parts that fail independently, each under one of the loads."""
    size = max(loads)
    if len(loads) == 1 or not size > 0.0:
        return size
    return float(size * sum((load / size) ** power for load in loads) ** (1.0 / power))


def _mean(loads: Array, weights: Array, power: float) -> float:
    """Return the power mean of loads (n, N_b) with weights (n,) that sum to 1, without overflow."""
    size = float(loads.max(initial=0.0))
    if size == 0.0:
        return 0.0
    return size * float(weights @ np.mean((loads / size) ** power, axis=1)) ** (1.0 / power)


def _unknown(state: Equilibrium, loads: Array) -> RaceLoads | None:
    """Return NaN with the reason if loads of some cage angle are unknown; otherwise None."""
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
    """Return places [rad] of a ball over the bearing's period, and weights that sum to 1."""
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
            first = (corner - row.turn) / bearing.pace(k) % spacing
            corners += np.arange(first, period, spacing).tolist()
    ends = np.unique(np.concatenate([even, corners]))
    ends = ends[np.diff(ends, prepend=-1.0) > 1e-12]
    x, w = np.polynomial.legendre.leggauss(POINTS)
    half, middle = 0.5 * np.diff(ends), 0.5 * (ends[1:] + ends[:-1])
    places = middle[:, None] + half[:, None] * x
    weights = half[:, None] * w / period
    return places.ravel(), weights.ravel()


def _corners(defect: Defect, bearing: Bearing) -> list[float]:
    """Return angles [rad] of a ball at the edges of a defect, at its floor and some between."""
    half = 0.5 * defect.extent
    to_floor = min(float(defect.edge_row(bearing)[4]), half)
    away = half - to_floor * np.linspace(0.0, 1.0, PANELS_ON_AN_EDGE + 1)
    return [defect.center + side * a for side in (-1.0, 1.0) for a in away.tolist()]


def _average_turning_defects(scene: Scene, load_exponent: float, scatter: float) -> RaceLoads:
    """Return `race_loads` over all cage and shaft angles, as their ratio is no simple fraction.

    Balls are at fixed places θ of the inner race, so that panels can end at its edges. The shaft
    turns with them, in equal steps of ψ, as there are no edges along ψ.
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
    # loads (2, n, places, balls): for each start angle ψ_0, all places θ at one solve
    for k, psi_0 in enumerate(first):
        turned = dataclasses.replace(scene, defect=_turned(scene, float(psi_0)))
        state = static_state(turned, (places + psi_0) * ratio / (ratio - 1.0))
        loads[:, k] = loads_or_compressions(state)
        if unknown := _unknown(state, loads[:, k]):
            return unknown
        heaviest = max(heaviest, float(state.ball_load.max()))
    chain = load_exponent * scatter
    order = np.arange(n // 2 + 1)[:, None, None]

    def inner_race(load: Array, theta: Array) -> float:
        """Return the equivalent load of the inner race under loads (n, places, N_b) at θ."""
        size = float(load.max()) or 1.0
        used = (load / size) ** load_exponent
        along = float(weights @ np.mean(np.mean(used, axis=0) ** scatter, axis=1))
        return size * along ** (1.0 / chain)

    def outer_race(load: Array, theta: Array) -> float:
        """Return the equivalent load of the outer race, whose place φ meets θ at ψ = φ − θ.

        A Fourier series in ψ gives the loads at these angles.
        """
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
            for theta, row in zip(thetas, np.split(race_load, len(thetas), axis=2), strict=True)
        )
        for race, race_load in zip((inner_race, outer_race), loads, strict=True)
    )
    return RaceLoads(inner, outer, heaviest)


def _turned(scene: Scene, angle: float) -> tuple[Defect, ...]:
    """Return the scene's defects, with those of the inner race turned by an angle [rad]."""
    return tuple(
        dataclasses.replace(defect, center=defect.center + angle)
        if defect.race == "inner"
        else defect
        for defect in scene.defects
    )
