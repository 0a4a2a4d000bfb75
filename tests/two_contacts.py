"""A ball between two races, in plain NumPy and as written on paper: what heavy balls are held to.

Nothing of `bearingcore.kernels` is used but the drop of a ball into a defect.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearingcore import Scene

GRAVITY = 9.80665


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
            along = u @ vector
            vector = np.where(along > 0.0, vector, vector - np.outer(u, along))
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
