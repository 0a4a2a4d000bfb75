"""What every place of a race carries in the long run, and the one load that tires it as much.

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
other: the two means of ISO 16281. A defect breaks this up, as it stands in one of the races:

- in the outer race it stands in the load too, and nothing changes: a ball that comes to φ finds the
  cage, the other balls and the defect as every ball before it did;
- in the inner race it turns against the load, so that every place of either race sees varying
  loads, and places of one race differ: both averages are needed for both races.

Each row has races of its own. They all have to live, so that their lives combine as those of places
do: a bearing of several rows lives as under (Σ over rows Q_e^(p e))^(1/(p e)).

The integrals are taken over panels that end where a ball meets an edge or a floor.
"""

from __future__ import annotations

import dataclasses
import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.model.defect import Defect
from bearingcore.model.scene import Scene
from bearingcore.statics.equilibrium import Equilibrium, equilibrium

Array = NDArray[np.float64]

PANELS, PANELS_ON_AN_EDGE = 16, 6
"""Panels in a ball spacing, and between an edge and where a ball meets the floor: somewhere in
there it lets go, within a small part of that angle."""

PANELS_ON_A_FLOOR = 96
"""The same where a floor is not flat: its path bends everywhere."""

POINTS = 4
"""Gauss points in a panel."""

SHAFT_ANGLES, SHAFT_ANGLES_BOTH = 61, 361
"""Shaft angles in a turn, with defects in the inner race alone, and in both: the second kind meet
the balls at every place of the inner race, so no panel can end there. Odd, so that no wave of a
series is its own mirror image."""

FINER = 4
"""Places of the outer race for each shaft angle."""


class RaceLoads(NamedTuple):
    """The load [N] that tires each race as much as all that it carries, and the greatest of all.

    NaN where the loads of some cage angle are not known; `status` (a code of `kernels`) and
    `reason` then say why, and are CONVERGED and empty otherwise.
    """

    inner: float
    outer: float
    heaviest: float
    status: int = kernels.CONVERGED
    reason: str = ""


def snapshot_loads(
    scene: Scene, cage_angle: float, load_exponent: float, scatter: float, turning_race: str
) -> RaceLoads:
    """The means over the balls at one cage angle [rad], as a standard takes them.

    Right for a healthy bearing alone. Half a ball spacing on is looked at too: where the bearing
    carries nothing there, it has no life.
    """
    state = equilibrium(scene, [cage_angle, cage_angle + 0.5 * scene.bearing.ball_spacing])
    if unknown := _unknown(state):
        return unknown
    return _averaged(
        scene, state.ball_load[:1], np.full(1, 1.0), load_exponent, scatter, turning_race
    )


def race_loads(
    scene: Scene, load_exponent: float, scatter: float, turning_race: str = "inner"
) -> RaceLoads:
    """The means over all cage angles, and over all shaft angles where a defect turns."""
    if any(defect.race == "inner" for defect in scene.defects):
        return _with_turning_defects(scene, load_exponent, scatter)
    places, weights = _panels(scene, "outer")
    state = equilibrium(scene, places)
    if unknown := _unknown(state):
        return unknown
    return _averaged(scene, state.ball_load, weights, load_exponent, scatter, turning_race)


def _averaged(
    scene: Scene,
    loads: Array,
    weights: Array,
    load_exponent: float,
    scatter: float,
    turning_race: str,
) -> RaceLoads:
    """Both races under loads (n, balls) with weights (n,) where nothing turns against the load."""
    rows = np.split(loads, len(scene.bearing.all_rows), axis=1)
    power = load_exponent * scatter
    turning = _together([_mean(row, weights, load_exponent) for row in rows], power)
    standing = _together([_mean(row, weights, power) for row in rows], power)
    inner, outer = (turning, standing) if turning_race == "inner" else (standing, turning)
    return RaceLoads(inner, outer, float(loads.max()))


def _together(loads: list[float], power: float) -> float:
    """The one load that tires a row as much as each of these its own: (Σ Q^power)^(1/power)."""
    size = max(loads)
    if len(loads) == 1 or size == 0.0:
        return size
    return float(size * sum((load / size) ** power for load in loads) ** (1.0 / power))


def _mean(loads: Array, weights: Array, power: float) -> float:
    """Power mean of loads (n, N_b) with weights (n,) that sum to 1; scaled, so none overflows."""
    size = float(loads.max(initial=0.0))
    if size == 0.0:
        return 0.0
    return size * float(weights @ np.mean((loads / size) ** power, axis=1)) ** (1.0 / power)


def _unknown(state: Equilibrium) -> RaceLoads | None:
    """NaN with the reason, where the loads of some cage angle are not known; None where all are."""
    failed = np.flatnonzero(~np.isfinite(state.ball_load).all(axis=1))
    if not failed.size:
        return None
    first = int(failed[0])
    return RaceLoads(math.nan, math.nan, math.nan, int(state.status[first]), state.reason(first))


def _panels(scene: Scene, race: str) -> tuple[Array, Array]:
    """Places [rad] of a ball over one spacing of a race, and weights that sum to 1."""
    spacing = scene.bearing.ball_spacing
    defects = [defect for defect in scene.defects if defect.race == race]
    rough = any(defect.floor is not None for defect in defects)
    even = np.linspace(0.0, spacing, (PANELS_ON_A_FLOOR if rough else PANELS) + 1)
    turns = {row.turn for row in scene.bearing.all_rows}
    corners = [
        (corner - turn) % spacing
        for defect in defects
        for corner in _corners(defect, scene)
        for turn in turns
    ]
    ends = np.unique(np.concatenate([even, corners]))
    ends = ends[np.diff(ends, prepend=-1.0) > 1e-12]
    x, w = _gauss(POINTS)
    half, middle = 0.5 * np.diff(ends), 0.5 * (ends[1:] + ends[:-1])
    places = middle[:, None] + half[:, None] * x
    weights = half[:, None] * w / spacing
    return places.ravel(), weights.ravel()


@lru_cache(maxsize=8)
def _gauss(n: int) -> tuple[Array, Array]:
    return np.polynomial.legendre.leggauss(n)


def _corners(defect: Defect, scene: Scene) -> list[float]:
    """Angles [rad] of the defect's edges, of where a ball meets its floor, and some between."""
    half = 0.5 * defect.extent
    to_floor = min(float(defect.edge_row(scene.bearing)[4]), half)
    away = half - to_floor * np.linspace(0.0, 1.0, PANELS_ON_AN_EDGE + 1)
    return [defect.center + side * a for side in (-1.0, 1.0) for a in away.tolist()]


def _with_turning_defects(scene: Scene, load_exponent: float, scatter: float) -> RaceLoads:
    """`race_loads` where cage and shaft angle matter both, as their ratio is no simple fraction.

    Balls are put at fixed places θ of the inner race, where panels can end at its edges, and the
    shaft turns with them: ψ in equal steps, as nothing has edges there.
    """
    bearing, ratio = scene.bearing, scene.bearing.cage_ratio
    both = any(defect.race == "outer" for defect in scene.defects)
    n = SHAFT_ANGLES_BOTH if both else SHAFT_ANGLES
    places, weights = _panels(scene, "inner")
    # a ball at the cage angle c is at θ = c − ψ of an inner race turned by ψ = ψ_0 + c/ratio
    first = 2.0 * math.pi * np.arange(n) / n * (ratio - 1.0) / ratio
    offset = places / (ratio - 1.0)  # ψ at the first of the n steps
    loads = np.empty((n, places.size, bearing.total_balls))
    for k, psi_0 in enumerate(first):
        turned = dataclasses.replace(scene, defect=_turned(scene, float(psi_0)))
        state = equilibrium(turned, (places + psi_0) * ratio / (ratio - 1.0))
        if unknown := _unknown(state):
            return unknown
        loads[k] = state.ball_load
    size = float(loads.max())
    if size == 0.0:
        return RaceLoads(0.0, 0.0, 0.0)
    inner = outer = 0.0
    order = np.arange(n // 2 + 1)[:, None, None]
    for row, own in zip(
        bearing.all_rows, np.split(loads, len(bearing.all_rows), axis=2), strict=True
    ):
        used = (own / size) ** load_exponent
        inner += float(weights @ np.mean(np.mean(used, axis=0) ** scatter, axis=1))
        # a place φ of the outer race meets every θ at ψ = φ − θ: the series in ψ tells it between
        theta = places[:, None] + row.turn + bearing.ball_spacing * np.arange(bearing.n_balls)
        series = np.fft.rfft(used, axis=0) / n
        shifted = series * np.exp(-1j * order * (theta + offset[:, None]))
        along = np.mean(shifted, axis=2) @ weights
        passing = np.fft.irfft(along, FINER * n) * (FINER * n)
        outer += float(np.mean(np.maximum(passing, 0.0) ** scatter))
    root = 1.0 / (load_exponent * scatter)
    return RaceLoads(size * inner**root, size * outer**root, size)


def _turned(scene: Scene, angle: float) -> tuple[Defect, ...]:
    """The scene's defects, those of the inner race turned by an angle [rad]."""
    return tuple(
        dataclasses.replace(defect, center=defect.center + angle)
        if defect.race == "inner"
        else defect
        for defect in scene.defects
    )
