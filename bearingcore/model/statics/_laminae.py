"""Laminae of rollers: the distribution of load along a roller, for its life, by ISO 16281.

Quantity                                        | Symbol | Name              | Unit
----------------------------------------------- | ------ | ----------------- | -------
number of laminae of a roller, of equal length  | n_s    | LAMINAE           |
place of a lamina's middle along the roller     | x_k    | place             | m
drop of the roller's profile at x_k             | P_k    | drop              | m
compression of a roller in its middle           | δ      | compressions      | m
load of a lamina                                | q_k    |                   | N
factor of the stress at the ends                | f_k    | stress_factors    |
load-deflection factor of the roller            | c_L, K |                   | N/m^(10/9)

    q_k = c_L/n_s (δ − 2 P_k)^(10/9) while positive,    Q = Σ q_k,                 Eqs. (36)-(46)
    f_k = 1 − 0.01/ln(1.985 |2k − n_s − 1|/(2 n_s − 2)),                                 Eq. (60)

with the profiles of the standard for rollers with unknown profile, Eqs. (42)-(44): nearly straight
in the middle, rounded off towards the ends. f_k is meant for these profiles, for medium loads and
for rings tilted by less than 4′; here rollers do not tilt at all. The standard asks for at least 30
laminae. With 50, the highest factors belong to a smaller part of the roller, and lives of heavily
loaded rollers are up to a tenth longer.

Displacement, stiffness and load distribution of a scene are those of straight rollers. A profiled
roller is softer under a light load, so that fewer rollers share the load. For life alone the
equilibrium is therefore solved again with profiles, and gives the compressions here.

Source: ISO/TS 16281:2008, sections 5.2 and 5.3; its equations are taken from the public programs
minzhun/ISO16281 and AxisForge. The former has a mistake in Eq. (60): its factors of the outer race
are about 2 everywhere, and its lives 0.2 to 0.3 of those of the standard.
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
"""n_s, the smallest number that the standard allows."""

LINE_EXPONENT = 10.0 / 9.0

GRID = np.concatenate([[0.0], np.geomspace(1e-18, 1e6, 14_044)])
"""Compressions over the diameter at which the law of a profiled roller is tabulated. A step is
0.4 %, and linear interpolation has an error of 1e-6. The range is wide, as Newton's first steps may
be far too long."""

STEPS, HALVINGS, ENOUGH = 60, 30, 1e-6
"""Most Newton steps, most halvings of a step, and the accepted residual over the load."""


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
    """Return P_k (n_s/2,) [m] of the laminae from the middle of a roller (0 there) to one end."""
    length = length_of(bearing)
    place = (np.arange(LAMINAE // 2) + 0.5) * length / LAMINAE
    drop = bearing.kind.profile_drop(bearing, place)
    return drop - drop[0]


def stress_factors() -> Array:
    """Return f_k (n_s/2,) of the laminae of `drops`, equal for both races, Eq. (60)."""
    from_middle = 2.0 * np.arange(LAMINAE // 2) + 1.0
    return 1.0 - 0.01 / np.log(1.985 * from_middle / (2.0 * LAMINAE - 2.0))


@lru_cache(maxsize=32)
def law_of(bearing: Bearing) -> Law:
    """Return the law of the profiled rollers of a bearing, Eqs. (36)-(46)."""
    n, c_s = LINE_EXPONENT, bearing.load_deflection_factor / LAMINAE
    delta = GRID * bearing.ball_diameter
    pressed = np.maximum(delta[:, None] - 2.0 * drops(bearing), 0.0)
    q = 2.0 * c_s * pressed**n
    slope = n * 2.0 * c_s * pressed ** (n - 1.0)
    return Law(delta, q.sum(1), slope.sum(1), (q * pressed).sum(1) / (n + 1.0))


def compressions(state: Equilibrium) -> Array:
    """Return δ (n, rollers) [m] of profiled rollers under the load of an equilibrium.

    Newton's method minimises the energy, which is convex, from the state of straight rollers; lines
    of contact are fixed. NaN where it did not settle or loads are unknown.
    """
    scene = state.scene
    packed, law = pack(scene, state.dofs), law_of(scene.bearing)
    contacts, active = packed.contacts, packed.load.active
    force = packed.load.force[active]
    known = np.isfinite(state.ball_load).all(axis=1)
    result = np.full(known.shape + contacts.angle.shape, np.nan)
    if not known.any():
        return result
    angle = state.ball_angle[known]
    gradient = contacts.gradients(angle, contacts.line_r, contacts.line_z)[:, :, active]
    gap = drops_at(scene, state.cage_angles[known]) + contacts.clearance * contacts.line_r
    gap = gap - contacts.offset * contacts.line_z
    place = state.state[known][:, active]

    def pressed(q: Array) -> Array:
        return np.maximum(np.einsum("njd,nd->nj", gradient, q) - gap, 0.0)

    def energy(q: Array) -> Array:
        return law.at(pressed(q))[2].sum(1) - q @ force

    current = energy(place)
    for _ in range(STEPS):
        load, slope, _ = law.at(pressed(place))
        rest = force - np.einsum("njd,nj->nd", gradient, load)
        allowed = ENOUGH * np.maximum(np.abs(force).max(), load.max(axis=1))
        settled = np.abs(rest).max(axis=1) <= allowed
        if settled.all():
            break
        hessian = np.matmul((gradient * slope[:, :, None]).transpose(0, 2, 1), gradient)
        stiffest = np.trace(hessian, axis1=1, axis2=2).max()
        hessian += (1e-12 * stiffest or 1.0) * np.eye(len(force))
        step = np.linalg.solve(hessian, rest[:, :, None])[:, :, 0]
        # a step that raises the energy is halved
        part = np.ones((len(place), 1))
        for _ in range(HALVINGS):
            moved = energy(place + part * step)
            if not (higher := moved > current + ENOUGH * np.abs(current)).any():
                break
            part[higher] *= 0.5
        place, current = place + part * step, moved
    result[known] = np.where(settled[:, None], pressed(place), np.nan)
    return result


def loads_or_compressions(state: Equilibrium) -> Array:
    """Return compressions [m] of rollers or loads [N] of balls, as `strips` takes them.

    They are (2, n, elements), at the inner and the outer race: balls with mass press the outer race
    harder.
    """
    if state.scene.bearing.kind.line_contact:
        pressed = compressions(state)
        return np.stack([pressed, pressed])
    return np.stack([state.inner_load, state.ball_load])


def strips(bearing: Bearing, carried: Array, power: float) -> Iterator[Array]:
    """Yield the equivalent loads [N] of the parts of a race that fail independently.

    A race of balls has one part, with the loads of the balls. A race of rollers has a part for each
    pair of laminae, with the loads f_k q_k n_s^(7/9) (Eqs. (56), (57)) times 2^(1/power) for two
    laminae. If a whole roller carried this load evenly, its race would have the life that the
    lamina's part has.
    """
    if not bearing.kind.line_contact:
        yield carried
        return
    c_s = bearing.load_deflection_factor / LAMINAE
    size = stress_factors() * c_s * LAMINAE ** (7.0 / 9.0) * 2.0 ** (1.0 / power)
    for factor, drop in zip(size, drops(bearing), strict=True):
        yield factor * np.maximum(carried - 2.0 * drop, 0.0) ** LINE_EXPONENT
