"""The same physics done the way one first thinks of, to show where that fails.

Formulas as printed, in NumPy, for one cage angle at a time. Nothing of bearingcore depends on this.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Scene, contact_damping

Array = NDArray[np.float64]


class Contacts(NamedTuple):
    """Loads of all balls and what follows from them."""

    ball_load: Array
    """(N_b,) [N]"""
    force: Array
    """(5,) on the outer ring [N], moments over r_d"""
    stiffness: Array
    """(5, 5) [N/m], tilts as lengths"""


def printed(
    scene: Scene, cage_angle: float, q: Array, *, gaps_pull: bool = False, mended: bool = False
) -> Contacts:
    """Eqs. 7-17 as printed, with the unsigned distance A of the groove centres.

    q (5,) [m], tilts times r_d. With `gaps_pull` a gap pulls as a compression pushes,
    Q = K sign(δ) |δ|^1.5, which makes Newton's method converge. `mended` counts the distance
    along the line of contact only while it is positive.
    """
    bearing = scene.bearing
    phi = cage_angle + bearing.ball_spacing * np.arange(bearing.n_balls)
    c, s = np.cos(phi), np.sin(phi)
    drop = np.zeros_like(phi)
    for defect in scene.defects:
        drop += defect.path(phi, bearing, cage_angle)
    ca, sa = math.cos(bearing.contact_angle), math.sin(bearing.contact_angle)
    A0, K = bearing.groove_center_distance, bearing.load_deflection_factor
    dr = A0 * ca + q[0] * c + q[1] * s - bearing.radial_clearance - drop * ca
    dz = A0 * sa + q[2] + q[3] * s - q[4] * c - drop * sa
    if mended:
        back = np.minimum(dr * ca + dz * sa, 0.0)
        dr, dz = dr - back * ca, dz - back * sa
    A = np.maximum(np.hypot(dr, dz), 1e-300)
    delta = A - A0
    size = np.abs(delta) if gaps_pull else np.maximum(delta, 0.0)
    load = K * np.sign(delta) * size**1.5
    zero = np.zeros_like(phi)
    radial = np.stack([c, s, zero, zero, zero])
    axial = np.stack([zero, zero, zero + 1.0, s, -c])
    along = (dr * radial + dz * axial) / A
    across = (dr * axial - dz * radial) / A
    stiffness = (1.5 * K * np.sqrt(size) * along) @ along.T + (load / A * across) @ across.T
    return Contacts(load, along @ load, stiffness)


def active_of(scene: Scene) -> list[int]:
    """Indices of the scene's active directions."""
    return [DOF_NAMES.index(name) for name in scene.active_dofs]


def load_of(scene: Scene) -> Array:
    """Load (5,) [N], moments over r_d."""
    lever = scene.bearing.groove_center_radius
    return scene.load.vector / np.array([1.0, 1.0, 1.0, lever, lever])


def fair_guess(scene: Scene) -> Array:
    """Through the clearance, and on by what presses several balls, along the load; (5,) [m]."""
    bearing, F = scene.bearing, load_of(scene)
    size = float(np.linalg.norm(F))
    sunk = (size / bearing.load_deflection_factor) ** (2.0 / 3.0)
    return (bearing.radial_clearance / math.cos(bearing.contact_angle) + 5.0 * sunk) * F / size


class Attempt(NamedTuple):
    """Where Newton's method ended."""

    q: Array
    residual: float
    """unbalanced load over the load"""
    failure: str
    """empty where it converged"""


def newton(
    scene: Scene,
    cage_angle: float,
    start: Array,
    *,
    gaps_pull: bool = False,
    mended: bool = False,
    steps: int = 100,
    tolerance: float = 1e-9,
) -> Attempt:
    """Newton-Raphson on the balance of loads (Eq. 15), full steps, no line search."""
    active = active_of(scene)
    F = load_of(scene)
    size = float(np.linalg.norm(F[active]))
    q = start.copy()
    residual = math.inf
    for _ in range(steps):
        state = printed(scene, cage_angle, q, gaps_pull=gaps_pull, mended=mended)
        unbalanced = (F - state.force)[active]
        residual = float(np.linalg.norm(unbalanced)) / size
        if residual <= tolerance:
            return Attempt(q, residual, "")
        if not np.isfinite(residual):
            return Attempt(q, residual, "runs away")
        try:
            q[active] += np.linalg.solve(state.stiffness[np.ix_(active, active)], unbalanced)
        except np.linalg.LinAlgError:
            return Attempt(q, residual, "singular matrix")
    return Attempt(q, residual, "does not settle")


class Motion:
    """Right-hand side of the motion in x and y at zero contact angle (Eqs. 18, 19, 22, 23)."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.damping = contact_damping(scene)
        self.balls = scene.bearing.ball_spacing * np.arange(scene.bearing.n_balls)

    def contacts(self, time: float, x: Array, v: Array) -> tuple[Array, Array, Array]:
        """Load K δ^1.5 and damping c δ̇ of touching balls [N], 0 elsewhere, and rays (N_b, 2).

        x, v (2,) of the inner ring against the outer one.
        """
        bearing, turn = self.scene.bearing, self.scene.cage_speed
        phi = turn * time + self.balls
        rays = np.stack([np.cos(phi), np.sin(phi)], axis=1)
        across = np.stack([-np.sin(phi), np.cos(phi)], axis=1)
        drop, slope = np.zeros_like(phi), np.zeros_like(phi)
        for defect in self.scene.defects:
            drop = defect.path(phi, bearing)
            slope += (defect.path(phi + 1e-7, bearing) - drop) / 1e-7
        delta = rays @ x - bearing.radial_clearance - drop
        rate = rays @ v + turn * (across @ x - slope)
        touching = delta > 0.0
        elastic = bearing.load_deflection_factor * np.maximum(delta, 0.0) ** 1.5
        return elastic, np.where(touching, self.damping * rate, 0.0), rays

    def __call__(self, time: float, state: Array) -> Array:
        """d/dt of (x_i, x_o, v_i, v_o), shape (8,)."""
        support = self.scene.support
        xi, xo, vi, vo = state.reshape(4, 2)
        elastic, viscous, rays = self.contacts(time, xi - xo, vi - vo)
        force = rays.T @ (elastic + viscous)
        ground = support.stiffness("xy") * xo + support.damping("xy") * vo
        load = self.scene.load.vector[:2]
        return np.concatenate(
            [vi, vo, (load - force) / support.inner_mass, (force - ground) / support.outer_mass]
        )
