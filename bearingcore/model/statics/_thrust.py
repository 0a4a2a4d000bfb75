"""Limits on rows that carry thrust one way only: thrust the other way, or too little thrust.

Quantity                                                 | Symbol | Unit
-------------------------------------------------------- | ------ | -----
load and contact angle of a ball or roller               | Q_j, α_j | N, rad
angle from the most heavily loaded element               | φ_j    | rad
radial load, thrust                                      | F_r, F_a | N

A row at a contact angle turns part of a radial load into thrust, ΣQ_j sin α_j, which pushes its
rings apart along the shaft. The size depends on the number of loaded elements. If the rings are
held along the shaft without clearance, half of the row carries load, Q_j ~ (cos φ_j)^n over half a
turn. The thrust of that state is called the thrust that the radial load induces. At a fixed contact
angle it is F_r tan α Ja(0.5)/Jr(0.5) with Sjövall's integrals (Harris, Rolling Bearing Analysis):
1.216 F_r tan α for balls and 1.25 F_r tan α for rollers, which is F_r/(2 Y) in makers' catalogues.
Here the statics compute it, as contact angles of balls change under load.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.common import with_prefix
from bearingcore.model.scene import Scene
from bearingcore.model.statics._equilibrium import Equilibrium, default_cage_angles, equilibrium
from bearingcore.model.statics._limit import Limit, unknown

_ANGLES = 31

_NOTICED = 1e-6
"""Share of a row's loads above which thrust the wrong way is more than rounding."""


def thrust_limits(scene: Scene, state: Equilibrium) -> Iterator[Limit]:
    """Yield limits on thrust; none if all rows carry thrust both ways, or not at all."""
    if any(_one_way(scene.bearing)):
        yield _wrong_way(scene, state)
        if (induced := induced_thrust(scene)) > 0.0:
            yield _too_little(scene, state, induced)


def facing(bearing: Bearing) -> int:
    """Return the sign of the thrust on the inner ring if a bearing carries one way only, or 0."""
    signs = set(_one_way(bearing))
    return signs.pop() if len(signs) == 1 else 0


def induced_thrust(scene: Scene) -> float:
    """Return the thrust [N] that a radial load induces in a bearing that carries thrust one way.

    It is the mean over the cage angles without defects. It is 0 without a radial load, if the rows
    together carry thrust both ways, and if the ring is held along the shaft.
    """
    one_way = facing(scene.bearing)
    if not one_way or "z" not in scene.active_dofs or not np.hypot(scene.load.fx, scene.load.fy):
        return 0.0
    rows = tuple(dataclasses.replace(row, clearance=0.0, offset=0.0) for row in scene.bearing.rows)
    tight = dataclasses.replace(scene.bearing, radial_clearance=0.0, rows=rows)
    held = dataclasses.replace(scene.healthy(), bearing=tight)
    state = equilibrium(held, default_cage_angles(held, _ANGLES), ("x", "y"))
    return float(one_way * state.shares @ _thrusts(state).sum(axis=1))


def _one_way(bearing: Bearing) -> list[int]:
    """Return, for each row, the sign of the thrust if it carries one way only, or 0."""
    return [
        row.facing if bearing.kind.carries_thrust_one_way(bearing.of_row(k)) else 0
        for k, row in enumerate(bearing.all_rows)
    ]


def _thrusts(state: Equilibrium) -> np.ndarray:
    """Return the thrust ΣQ_j sin α_j (n, rows) [N] of rows on the outer ring; NaN if unknown."""
    thrust = state.ball_load * np.sin(np.nan_to_num(state.contact_angle))
    rows = state.scene.bearing.balls_of_rows
    return np.stack([thrust[:, row].sum(axis=1) for row in rows], axis=1)


def _wrong_way(scene: Scene, state: Equilibrium) -> Limit:
    """Return the limit on thrust that presses a row the wrong way, the greatest of all rows."""
    name, bearing = "thrust the wrong way", scene.bearing
    one_way = np.array(_one_way(bearing))
    wrong = -one_way * _thrusts(state)
    loads = [state.ball_load[:, balls].sum(axis=1) for balls in bearing.balls_of_rows]
    wrong[wrong <= _NOTICED * np.stack(loads, axis=1)] = 0.0
    known = wrong[np.isfinite(wrong)]
    against = -facing(bearing) * scene.load.fz if "z" in scene.active_dofs else 0.0
    if not known.size and not against > 0.0:
        return unknown(name, 0.0, "N", "no cage angle has a static equilibrium")
    value = max(float(known.max(initial=0.0)), against, 0.0)
    alone = f"A row of {bearing.kind.elements} at {math.degrees(bearing.contact_angle):.1f}°"
    subject = f"Each row of {bearing.kind.elements}" if bearing.rows else alone
    fact = f"{subject} carries thrust one way only"
    if value > 0.0:
        fact += (
            f", and here {with_prefix(value, 'N')} press the other way, where its races have no "
            "shoulder to take it: turn the bearing round, or let the shaft's other bearing carry it"
        )
        return Limit(name, value, 0.0, "N", True, f"{fact}.")
    return Limit(name, 0.0, 0.0, "N", False, f"{fact}, and is pressed that way.")


def _too_little(scene: Scene, state: Equilibrium, induced: float) -> Limit:
    """Return the limit on the axial load: at least the thrust that the radial load induces."""
    axial = facing(scene.bearing) * scene.load.fz
    crossed = axial < induced * (1.0 - 1e-9)
    kind = scene.bearing.kind
    thrust, least, radial = (
        with_prefix(load, "N")
        for load in (axial, induced, math.hypot(scene.load.fx, scene.load.fy))
    )
    loaded = state.loaded_balls[state.converged]
    carry = f"{loaded.min()} of {scene.bearing.total_balls} {kind.elements}" if loaded.size else ""
    if crossed:
        sentence = (
            f"The axial load is below the one it induces ({least}): {thrust} beside a radial load "
            f"of {radial} let the rings move apart along the shaft"
            + (f", until {carry} carry all of it" if carry else ", and nothing holds them")
            + ". More axial load, or the shaft's other bearing, has to hold them."
        )
    else:
        sentence = f"The axial load of {thrust} is at least the {least} that {radial} induce."
    return Limit("axial load against the induced one", axial, induced, "N", crossed, sentence)
