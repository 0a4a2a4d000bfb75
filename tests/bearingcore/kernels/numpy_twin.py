"""What the compiled code means, in plain NumPy: one ball after the other, no tricks.

Written from the paper's equations and the structs' descriptions, with numpy's own functions. Slow.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.kernels import path as paths
from tests.helpers.contact_law import straightened

Array = NDArray[np.float64]


def drop_into_one(defect: Array, tables: Array, ball_angle: float, cage_angle: float) -> float:
    """Drop [m] of a ball at an angle [rad] into one defect, a row of `PATH_COLUMNS`.

    `cage_angle` is that of the ball's own row.
    """
    column = dict(zip(kernels.PATH_COLUMNS, defect, strict=True))
    away = ball_angle - column["center"] - column["turn_ratio"] * cage_angle
    away = (away + math.pi) % (2.0 * math.pi) - math.pi
    half, depth, R, r_b = (
        column[name] for name in ("half_extent", "depth", "raceway_radius", "ball_radius")
    )
    s = half - abs(away)
    if s < 0.0:
        return 0.0
    if column["edge"] == paths.TABLE:
        start, size = int(column["table_start"]), int(column["table_size"])
        nodes = np.linspace(-half, half, size)
        return float(np.interp(away, nodes, tables[start : start + size]))
    if s >= column["angle_from_edge_to_floor"]:
        return float(depth)
    if column["edge"] == paths.PUBLISHED:
        drop = r_b - math.sqrt(r_b**2 - 0.25 * R**2 * s**2)
    elif column["edge"] == paths.CHORD:
        drop = r_b - math.sqrt(r_b**2 - R**2 * s**2)
    elif column["edge"] == paths.EXACT:
        drop = R * math.cos(s) - math.sqrt(r_b**2 - R**2 * math.sin(s) ** 2) - (R - r_b)
    else:
        drop = (R + r_b) - (R * math.cos(s) + math.sqrt(r_b**2 - R**2 * math.sin(s) ** 2))
    return float(min(drop, depth))


def drops(contacts: kernels.Contacts, path: kernels.Path, cage_angle: float) -> Array:
    """Drop [m] of every ball (n,)."""
    row_of = np.concatenate([np.full(n, row) for row, (_, n) in enumerate(contacts.rows)])
    found = np.zeros(contacts.angle.size)
    for j, angle in enumerate(contacts.angle):
        own = contacts.pace[j] * cage_angle
        for defect in path.defects:
            if defect[-1] in (kernels.EVERY_ROW, row_of[j]):
                found[j] += drop_into_one(defect, path.tables, own + angle, own)
    return found


@dataclass
class Touching:
    """The contacts at a displacement, each (n,): compression, direction, distance, gradients."""

    delta: Array
    along: Array
    across: Array
    distance: Array
    crossed: NDArray[np.bool_]


def touching(contacts: kernels.Contacts, q: Array, cage_angle: float, drop: Array) -> Touching:
    """Compression δ (n,) [m] and the directions e and t in q (n, 5) (Eqs. 7-14)."""
    phi = contacts.pace * cage_angle + contacts.angle
    c, s, zero = np.cos(phi), np.sin(phi), np.zeros_like(phi)
    R = np.stack([c, s, zero, -contacts.arm * s, contacts.arm * c], axis=1)
    Z = np.stack([zero, zero, zero + 1.0, contacts.reach * s, -contacts.reach * c], axis=1)
    u = np.stack([contacts.line_r, contacts.line_z], axis=1)
    vector = np.stack([R @ q - contacts.clearance, Z @ q + contacts.offset], axis=1)
    vector += (contacts.distance - drop)[:, None] * u
    vector, beyond = straightened(vector, u)
    A = np.maximum(np.linalg.norm(vector, axis=1), 1e-300)
    er, ez = (vector / A[:, None]).T
    return Touching(
        delta=np.maximum(A - contacts.distance, 0.0),
        along=er[:, None] * R + ez[:, None] * Z,
        across=-ez[:, None] * R + er[:, None] * Z,
        distance=A,
        crossed=beyond <= 0.0,
    )


def loads_of(contacts: kernels.Contacts, delta: Array) -> Array:
    """Q = K δ^n (n,) [N] (Eq. 13)."""
    return np.asarray(contacts.factor * delta**contacts.exponent)


def stiffness_at(contacts: kernels.Contacts, path: kernels.Path, q: Array, cage: float) -> Array:
    """Σ over loaded balls of k ee' + (Q/A) tt' (5, 5) (Eq. 17)."""
    balls = touching(contacts, q, cage, drops(contacts, path, cage))
    Q = loads_of(contacts, balls.delta)
    total = np.zeros((5, 5))
    for j in np.flatnonzero(balls.delta > 0.0):
        n = contacts.exponent[j]
        k = n * contacts.factor[j] * balls.delta[j] ** (n - 1.0)
        total += k * np.outer(balls.along[j], balls.along[j])
        if not balls.crossed[j]:
            total += Q[j] / balls.distance[j] * np.outer(balls.across[j], balls.across[j])
    return total


def unbalanced(
    contacts: kernels.Contacts, path: kernels.Path, load: kernels.StaticLoad, q: Array, cage: float
) -> Array:
    """Σ Q e − F along the free directions [N] (Eq. 15)."""
    balls = touching(contacts, q, cage, drops(contacts, path, cage))
    pushed = loads_of(contacts, balls.delta) @ balls.along
    return np.asarray((pushed - load.force)[load.active])


def accelerations(
    system: kernels.System, x: Array, v: Array, xo: Array, vo: Array, cage: float
) -> tuple[Array, Array]:
    """Of inner and outer ring (n,) (Eq. 18); x, v (5,) of the inner ring against the outer one.

    xo, vo (n,) are displacement and velocity of the outer ring. δ̇ is taken by differences: along
    the motion, the turning of the cage and the slope of the path together.
    """
    rotor, contacts, path = system

    def at(t: float) -> Array:
        turned = cage + rotor.cage_speed * t
        drop = drops(contacts, path, turned)
        balls = touching(contacts, x + t * v, turned, drop)
        return np.asarray(balls.distance)

    balls = touching(contacts, x, cage, drops(contacts, path, cage))
    h = 1e-7
    rate = (at(h) - at(-h)) / (2.0 * h)
    push = loads_of(contacts, balls.delta) + rotor.contact_damping * rate
    push[balls.delta <= 0.0] = 0.0
    if not rotor.tension:
        push = np.maximum(push, 0.0)
    force = (push @ balls.along)[rotor.active]
    inner = (rotor.force - force) * rotor.inverse_inner
    outer = (force - rotor.stiffness * xo - rotor.damping * vo) * rotor.inverse_outer
    return inner, outer


def rate_of_velocities(system: kernels.System, t: float, y: Array, start: float = 0.0) -> Array:
    """dy/dt (4 n,) of displacements and velocities of both rings."""
    rotor = system.rotor
    xi, vi, xo, vo = y.reshape(4, -1)
    x, v = np.zeros(5), np.zeros(5)
    x[rotor.active] = xi - xo
    v[rotor.active] = vi - vo
    inner, outer = accelerations(system, x, v, xo, vo, start + rotor.cage_speed * t)
    return np.concatenate([vi, inner, vo, outer])
