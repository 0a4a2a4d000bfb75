"""The contact of balls and races written a second time, slowly and as on paper.

Nothing here is shared with the compiled code but the drop of a ball's centre, which has tests of
its own. `Balls` are massless and held by both races together, in extended precision; `TwoContacts`
are balls with a place of their own. Tilts of `Balls` are carried as r_d θ and moments as M/r_d, so
that q is five lengths and F five forces.

Quantity                                           | Symbol   | Unit
-------------------------------------------------- | -------- | ----
vector between the groove centres                  | δr*, δz* | m
its part along the unloaded line of contact        | p        | m
its length, and the compression                    | A, δ     | m
gradients in q of the ball's motion along and across the unloaded line | along, across |
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, wraps
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Scene

Long = np.longdouble
Array = NDArray[np.floating]

GRAVITY = 9.80665


def gradients(angle: Array) -> tuple[Array, Array]:
    """Gradients (N_b, 5) of radial and axial displacement at angles [rad] (Eqs. 11, 12).

    Tilts are lengths: the rotation times the radius of the groove centres.
    """
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.zeros_like(c), np.ones_like(c)
    return np.stack([c, s, zero, zero, zero], 1), np.stack([zero, zero, one, s, -c], 1)


def straightened(vector: Array, line: Array) -> tuple[Array, Array]:
    """Vectors (N_b, 2) between groove centres without their part against the unloaded line.

    Centres that have passed each other do not press. Also returned is the part p (N_b,) along the
    line (2,) or (N_b, 2), negative for these.
    """
    p = (vector * line).sum(axis=-1)
    return vector - np.minimum(p, 0.0)[:, None] * line, p


def remembered(method: Callable[..., Any]) -> Callable[..., Any]:
    """A method of `Balls` and q that is computed once for each q."""

    @wraps(method)
    def recall(self: Balls, q: Array) -> Any:
        key = (method.__name__, np.asarray(q, dtype=Long).tobytes())
        if key not in self.memory:
            self.memory[key] = method(self, q)
        return self.memory[key]

    return recall


@dataclass(frozen=True)
class Balls:
    """The balls of a scene at one cage angle [rad], and the energy of the inner ring on them."""

    scene: Scene
    cage_angle: float
    as_printed: bool = False
    """whether the distance of the groove centres has no sign, so that passed centres press"""
    memory: dict[tuple[str, bytes], Any] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def angle(self) -> NDArray[np.float64]:
        """(N_b,) [rad]"""
        n = self.scene.bearing.n_balls
        return self.cage_angle + 2.0 * math.pi / n * np.arange(n)

    @cached_property
    def drop(self) -> Array:
        """(N_b,) [m] into all defects."""
        bearing = self.scene.bearing
        total = np.zeros(bearing.n_balls, dtype=Long)
        for defect in self.scene.defects:
            total += defect.path(self.angle, bearing, self.cage_angle)
        return total

    @cached_property
    def load(self) -> Array:
        """(5,) [N], moments over r_d."""
        return self.scene.load.vector.astype(Long) / self.units

    @cached_property
    def units(self) -> Array:
        """(5,) what a scaled displacement is divided by to give metres and radians."""
        return np.array([1.0, 1.0, 1.0, *[self.scene.bearing.groove_center_radius] * 2], dtype=Long)

    @cached_property
    def radial_axial(self) -> tuple[Array, Array]:
        """Gradients (N_b, 5) of a ball's radial and axial displacement (Eqs. 11, 12)."""
        return gradients(self.angle.astype(Long))

    @cached_property
    def along_across(self) -> tuple[Array, Array]:
        """Gradients (N_b, 5) of a ball's motion along and across the unloaded line of contact."""
        radial, axial = self.radial_axial
        ca, sa = self._line
        return radial * ca + axial * sa, axial * ca - radial * sa

    @property
    def _line(self) -> tuple[Array, Array]:
        alpha = Long(self.scene.bearing.contact_angle)
        return np.cos(alpha), np.sin(alpha)

    @remembered
    def vector(self, q: Array) -> tuple[Array, Array, Array]:
        """δr*, δz* (N_b,) [m] (Eqs. 9, 10) with a negative p taken off, and p over A0."""
        bearing = self.scene.bearing
        ca, sa = self._line
        radial, axial = self.radial_axial
        A0, clearance = Long(bearing.groove_center_distance), Long(bearing.radial_clearance)
        dr = A0 * ca + radial @ q.astype(Long) - clearance - self.drop * ca
        dz = A0 * sa + axial @ q.astype(Long) - self.drop * sa
        vector, line = np.stack([dr, dz], 1), np.array([ca, sa])
        if self.as_printed:
            return dr, dz, np.full_like(dr, np.inf)
        vector, p = straightened(vector, line)
        return vector[:, 0], vector[:, 1], p / A0

    @remembered
    def compression(self, q: Array) -> Array:
        """δ (N_b,) [m], negative for gaps."""
        dr, dz, _ = self.vector(q)
        return np.hypot(dr, dz) - Long(self.scene.bearing.groove_center_distance)

    @remembered
    def ball_load(self, q: Array) -> Array:
        """Q (N_b,) [N] (Eq. 13)."""
        K = Long(self.scene.bearing.load_deflection_factor)
        return K * np.maximum(self.compression(q), 0.0) ** Long(1.5)

    def energy(self, q: Array) -> float:
        """V(q) [N·m]: what the contacts store, less the work of the load."""
        K = Long(self.scene.bearing.load_deflection_factor)
        stored = K / Long(2.5) * np.sum(np.maximum(self.compression(q), 0.0) ** Long(2.5))
        return stored - self.load @ q.astype(Long)

    def rounding(self, q: Array) -> float:
        """What rounding does to the energy [N·m]: to its lengths, and to the work of the load."""
        lengths = self.drop + self.scene.bearing.groove_center_distance + np.linalg.norm(q)
        size = float(self.ball_load(q) @ lengths + np.abs(self.load * q).sum())
        return float(np.finfo(Long).eps) * size

    @remembered
    def directions(self, q: Array) -> tuple[Array, Array]:
        """Gradients (N_b, 5) in q along each contact and across it."""
        dr, dz, _ = self.vector(q)
        A = np.maximum(np.hypot(dr, dz), Long(1e-300))[:, None]
        er, ez = dr[:, None] / A, dz[:, None] / A
        radial, axial = self.radial_axial
        return er * radial + ez * axial, er * axial - ez * radial

    @remembered
    def contact_force(self, q: Array) -> Array:
        """(5,) [N] with which the contacts resist the load (Eq. 15)."""
        return self.ball_load(q) @ self.directions(q)[0]

    def stiffness(self, q: Array, passed: float = 0.0, faint: float = 0.0) -> Array:
        """(5, 5) [N/m] (Eq. 17), from directions along and across each contact.

        `passed` is the p, over A0, up to which the centres of a ball count as passed, `faint` the
        load [N] from which on a ball counts.
        """
        K = Long(self.scene.bearing.load_deflection_factor)
        dr, dz, p = self.vector(q)
        along, across = self.directions(q)
        load = self.ball_load(q)
        load = np.where(load > faint, load, 0.0)
        push = Long(1.5) * np.cbrt(K) ** 2 * np.cbrt(load)
        turn = np.where(p > passed, load / np.maximum(np.hypot(dr, dz), Long(1e-300)), 0.0)
        return (along.T * push) @ along + (across.T * turn) @ across

    def unbalanced(self, q: Array, active: list[int]) -> float:
        """Size of the unbalanced load along `active` [N]."""
        return float(np.linalg.norm((self.contact_force(q) - self.load)[active].astype(float)))

    def whole_load(self, q: Array, active: list[int]) -> float:
        """Size of the load along `active` and of what the other directions take [N]."""
        whole = self.contact_force(q).copy()
        whole[active] = self.load[active]
        return float(np.linalg.norm(whole.astype(float)))


class Attempt(NamedTuple):
    """Where Newton's method ended: scaled displacement (5,) [m], and why it failed, if it did."""

    q: NDArray[np.float64]
    failure: str


def newton(balls: Balls, start: Array, steps: int = 100, tolerance: float = 1e-9) -> Attempt:
    """Newton-Raphson on the balance of loads (Eq. 15) from q (5,) [m]: full steps alone."""
    active = [DOF_NAMES.index(name) for name in balls.scene.active_dofs]
    size = float(np.linalg.norm(balls.load[active].astype(float)))
    q = np.array(start, dtype=float)
    for _ in range(steps):
        unbalanced = (balls.load - balls.contact_force(q))[active].astype(float)
        if np.linalg.norm(unbalanced) <= tolerance * size:
            return Attempt(q, "")
        matrix = balls.stiffness(q).astype(float)[np.ix_(active, active)]
        try:
            q[active] += np.linalg.solve(matrix, unbalanced)
        except np.linalg.LinAlgError:
            return Attempt(q, "singular matrix")
    return Attempt(q, "does not settle")


@dataclass
class TwoContacts:
    """Contacts of all balls of a scene with the cage at an angle [rad].

    inner, outer (5,): displacements of the rings [m, rad]; place (2, N_b) [m] of the balls, radial
    and axial, against balls that touch the outer race with the rings concentric.
    """

    scene: Scene
    cage_angle: float
    inner: np.ndarray
    outer: np.ndarray
    place: np.ndarray

    def __post_init__(self) -> None:
        bearing = self.scene.bearing
        self.phi = self.cage_angle + 2.0 * math.pi / bearing.n_balls * np.arange(bearing.n_balls)
        u = np.array([math.cos(bearing.contact_angle), math.sin(bearing.contact_angle)])
        A_i, A_e = bearing.race_distances
        drop = {"inner": np.zeros(bearing.n_balls), "outer": np.zeros(bearing.n_balls)}
        for defect in self.scene.defects:
            drop[defect.race] += defect.path(self.phi, bearing, self.cage_angle)
        g_i = self._groove(self.inner) - [[bearing.radial_clearance], [0.0]]
        g_e = self._groove(self.outer)
        vectors = (
            np.outer(u, A_i - drop["inner"]) + g_i - self.place,
            np.outer(u, A_e - drop["outer"]) + self.place - g_e,
        )
        self.load, self.direction, self.energy = [], [], 0.0
        for vector, A, K in zip(vectors, (A_i, A_e), bearing.race_factors, strict=True):
            vector = straightened(vector.T, u)[0].T
            length = np.linalg.norm(vector, axis=0)
            delta = np.maximum(length - A, 0.0)
            self.load.append(K * delta**1.5)
            self.direction.append(vector / np.maximum(length, 1e-300))
            self.energy += float((0.4 * K * delta**2.5).sum())

    def _groove(self, q: np.ndarray) -> np.ndarray:
        """(2, N_b) [m] displacement of a ring's groove centres (Eqs. 11, 12)."""
        c, s = np.cos(self.phi), np.sin(self.phi)
        lever = self.scene.bearing.groove_center_radius
        return np.array([q[0] * c + q[1] * s, q[2] + lever * (q[3] * s - q[4] * c)])

    def force(self, race: int) -> np.ndarray:
        """(5,) [N, N·m] of the balls against a ring: what its load must balance."""
        radial, axial = self.load[race] * self.direction[race]
        c, s = np.cos(self.phi), np.sin(self.phi)
        lever = self.scene.bearing.groove_center_radius
        return np.array([
            (radial * c).sum(), (radial * s).sum(), axial.sum(),
            lever * (axial * s).sum(), -lever * (axial * c).sum(),
        ])  # fmt: skip

    def on_balls(self, *, centrifugal: float, weight: bool) -> np.ndarray:
        """(2, N_b) [N] radial and axial force that is left on each ball."""
        force = self.load[0] * self.direction[0] - self.load[1] * self.direction[1]
        force[0] += centrifugal
        if weight:
            force[0] -= self.scene.bearing.ball_mass * GRAVITY * np.sin(self.phi)
        return force
