"""Laminae of rollers: the load of a roller along its length, for its life, by ISO 16281.

Quantity                                        | Symbol | Name              | Unit
----------------------------------------------- | ------ | ----------------- | -------
laminae of a roller, all of one length          | n_s    | LAMINAE           |
place of a lamina's middle along the roller     | x_k    | place             | m
drop of the roller's profile there              | P_k    | drop              | m
compression of a roller in its middle           | δ      | compressions      | m
load of a lamina                                | q_k    |                   | N
factor of the stress at the ends                | f_k    | stress_factors    |
load-deflection factor of the roller            | c_L, K |                   | N/m^(10/9)

    q_k = c_L/n_s (δ − 2 P_k)^(10/9) while positive,    Q = Σ q_k,                 Eqs. (36)-(46)
    f_k = 1 − 0.01/ln(1.985 |2k − n_s − 1|/(2 n_s − 2)),                                 Eq. (60)

with the profiles that the standard takes for rollers whose own is not known, Eqs. (42)-(44): nearly
straight in the middle, rounded off towards the ends. f_k is meant for these profiles, for medium
loads and for rings tilted by less than 4′; here rollers do not tilt at all. The standard asks for
30 laminae or more; the ends have fewer of more, so that lives of heavily loaded rollers are up to a
tenth longer with 50.

Displacement, stiffness and load distribution of a scene are those of straight rollers. A profiled
roller is softer while its load is light, which shares a load among fewer of them: for life alone
the equilibrium is found again with profiles, and compressions here are those of that one.

Source: ISO/TS 16281:2008, sections 5.2 and 5.3, as the public programs minzhun/ISO16281 and
AxisForge have its equations. The former has a slip in Eq. (60): it gives the outer race factors of
about 2 everywhere, and lives 0.2 to 0.3 of those of the standard.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.bearings._roller import length_of
from bearingcore.common import Array
from bearingcore.model.scene._packing import pack
from bearingcore.model.statics._equilibrium import Equilibrium
from bearingcore.model.statics._passes import drops_at

LAMINAE = 30
"""n_s, as few as the standard allows."""

LINE_EXPONENT = 10.0 / 9.0

GRID = np.concatenate([[0.0], np.geomspace(1e-18, 1e6, 14_044)])
"""Compressions over the diameter at which the law of a profiled roller is tabulated: a step is
0.4 %, a straight line between is off by 1e-6. Newton's steps may begin far too long."""

STEPS, HALVINGS, ENOUGH = 60, 30, 1e-6
"""Newton steps and halvings of one at most, and the part of a load that may be left over."""


class Law(NamedTuple):
    """Load [N] of a profiled roller, its slope [N/m] and energy [J] at compressions [m]."""

    compression: Array
    load: Array
    slope: Array
    energy: Array

    def at(self, compression: Array) -> tuple[Array, Array, Array]:
        """Return load, slope and energy at compressions of any shape."""
        return tuple(np.interp(compression, self.compression, y) for y in self[1:])  # type: ignore[return-value]


def drops(bearing: Bearing) -> Array:
    """P_k (n_s/2,) [m] of the laminae from the middle of a roller to one end, 0 in the middle."""
    length = length_of(bearing)
    place = (np.arange(LAMINAE // 2) + 0.5) * length / LAMINAE
    drop = bearing.kind.profile_drop(bearing, place)
    return drop - drop[0]


def stress_factors() -> Array:
    """f_k (n_s/2,) of the same laminae, both races alike, Eq. (60)."""
    from_middle = 2.0 * np.arange(LAMINAE // 2) + 1.0
    return 1.0 - 0.01 / np.log(1.985 * from_middle / (2.0 * LAMINAE - 2.0))


@lru_cache(maxsize=32)
def law_of(bearing: Bearing) -> Law:
    """The law of the profiled rollers of a bearing."""
    n, c_s = LINE_EXPONENT, bearing.load_deflection_factor / LAMINAE
    delta = GRID * bearing.ball_diameter
    pressed = np.maximum(delta[:, None] - 2.0 * drops(bearing), 0.0)
    q = 2.0 * c_s * pressed**n
    slope = n * 2.0 * c_s * pressed ** (n - 1.0)
    return Law(delta, q.sum(1), slope.sum(1), (q * pressed).sum(1) / (n + 1.0))


def compressions(state: Equilibrium) -> Array:
    """δ (n, rollers) [m] of profiled rollers under the load of an equilibrium of straight ones.

    Newton's method on the energy, which is convex, from where straight rollers carry the load; the
    lines of contact stay as they are. NaN where it did not settle or loads are not known.
    """
    scene = state.scene
    packed, law = pack(scene, state.dofs), law_of(scene.bearing)
    every, numbers = packed.contacts, packed.load
    force = numbers.force[numbers.active]
    known = np.isfinite(state.ball_load).all(axis=1)
    result = np.full(known.shape + every.angle.shape, np.nan)
    if not known.any():
        return result
    angle = state.ball_angle[known]
    gradient = every.gradients(angle, every.line_r, every.line_z)[:, :, numbers.active]
    gap = drops_at(scene, state.cage_angles[known]) + every.clearance * every.line_r
    gap = gap - every.offset * every.line_z
    place = state.state[known][:, numbers.active]

    def pressed(q: Array) -> Array:
        return np.maximum(np.einsum("njd,nd->nj", gradient, q) - gap, 0.0)

    def energy(q: Array) -> Array:
        return law.at(pressed(q))[2].sum(1) - q @ force

    reached = energy(place)
    for _ in range(STEPS):
        load, slope, _ = law.at(pressed(place))
        rest = force - np.einsum("njd,nj->nd", gradient, load)
        enough = ENOUGH * np.maximum(np.abs(force).max(), load.max(axis=1))
        settled = np.abs(rest).max(axis=1) <= enough
        if settled.all():
            break
        bend = np.matmul((gradient * slope[:, :, None]).transpose(0, 2, 1), gradient)
        stiffest = np.trace(bend, axis1=1, axis2=2).max()
        bend += (1e-12 * stiffest or 1.0) * np.eye(len(force))
        step = np.linalg.solve(bend, rest[:, :, None])[:, :, 0]
        part = np.ones((len(place), 1))
        for _ in range(HALVINGS):
            moved = energy(place + part * step)
            if not (higher := moved > reached + ENOUGH * np.abs(reached)).any():
                break
            part[higher] *= 0.5
        place, reached = place + part * step, moved
    result[known] = np.where(settled[:, None], pressed(place), np.nan)
    return result


def carried(state: Equilibrium) -> Array:
    """Compressions [m] of rollers, loads [N] of balls: `strips` takes either.

    (2, n, elements), at the inner race first: balls with mass press the outer one harder.
    """
    if state.scene.bearing.kind.line_contact:
        pressed = compressions(state)
        return np.stack([pressed, pressed])
    return np.stack([state.inner_load, state.ball_load])


def strips(bearing: Bearing, carried: Array, power: float) -> Iterator[Array]:
    """Parts of a race that fail each for itself, and the loads [N] that tire them.

    Of balls one: the load itself. Of rollers a pair of laminae each, f_k q_k n_s^(7/9): the load,
    spread evenly, under which a whole roller would tire its race as this lamina its part
    (Eqs. (56), (57)), times 2^(1/power) as there are two of them.
    """
    if not bearing.kind.line_contact:
        yield carried
        return
    c_s = bearing.load_deflection_factor / LAMINAE
    size = stress_factors() * c_s * LAMINAE ** (7.0 / 9.0) * 2.0 ** (1.0 / power)
    for factor, drop in zip(size, drops(bearing), strict=True):
        yield factor * np.maximum(carried - 2.0 * drop, 0.0) ** LINE_EXPONENT
