"""A scene's motion as numbers, for every integrator alike: start, right-hand side, kinks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import body_numbers, is_flat, packed_numbers, static_start
from bearingcore.model.scene import Scene
from bearingcore.statics.equilibrium import equilibrium
from bearingcore.statics.passes import path_kinks

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MotionProblem:
    """What an integrator needs of a scene; rotations are carried times r_d.

    Attributes
    ----------
    scene, dofs
        the scene and its n active directions.
    start : (4 n,) [m, m/s]
        displacement and velocity of the inner ring, then of the outer one, at time 0.
    scale : (4 n,) [m, m/s]
        sizes that count: one ball's compression under the load, and that times the highest natural
        angular frequency. Tolerances are relative to them: the whole signal is micrometres.
    numbers, bodies, active, rows, tables
        as `kernels.motion_rate` takes them.
    """

    scene: Scene
    dofs: tuple[str, ...]
    start: Array
    scale: Array
    numbers: Array
    bodies: Array
    active: NDArray[np.int64]
    rows: Array
    tables: Array

    @property
    def packed(self) -> tuple[float, int, Array, Array, NDArray[np.int64], Array, Array]:
        """From `start_angle` on, what the kernels of comparison take."""
        n_balls = self.scene.bearing.n_balls
        return 0.0, n_balls, self.numbers, self.bodies, self.active, self.rows, self.tables

    def rate(self, t: float, y: Array) -> Array:
        """dy/dt at time t [s], compiled."""
        rate: Array = kernels.motion_rate(t, y, *self.packed)
        return rate

    @property
    def flat(self) -> bool:
        """True where the program marches smooth variables: see `kernels.march_flat`."""
        return is_flat(self.scene)

    def kinks(self, duration: float) -> Array:
        """Times [s], rising, at which a ball meets an edge or the floor of a defect."""
        if self.scene.cage_speed == 0.0:
            return np.zeros(0)
        last = duration * self.scene.cage_speed
        angles = path_kinks(self.scene, 0.0, last)
        return angles[(angles > 0.0) & (angles < last)] / self.scene.cage_speed

    def energy(self, history: Array) -> Array:
        """(samples,) total energy [J] of the states of a history (samples, 6, n).

        Kinetic, elastic (contacts and support) and that of the load, for a cage that stands still.
        """
        n_balls, ca, sa, A0, rL, K = self.scene.bearing.contact_numbers
        inner, outer = history[:, 0], history[:, 3]
        relative = inner - outer
        loads = kernels.elastic_ball_loads(
            relative, self.active, 0.0, 0.0, self.rows, self.tables, n_balls, ca, sa, A0, rL, K
        )
        contacts = 0.4 * (loads ** (5.0 / 3.0)).sum(axis=1) / K ** (2.0 / 3.0)
        force, inverse_mi, inverse_mo, stiffness, _ = self.bodies
        kinetic = 0.5 * (
            (history[:, 1] ** 2 / inverse_mi).sum(axis=1)
            + (history[:, 4] ** 2 / inverse_mo).sum(axis=1)
        )
        support = 0.5 * (stiffness * outer**2).sum(axis=1)
        total: Array = kinetic + contacts + support - inner @ force
        return total


def motion_problem(
    scene: Scene, *, offset: Array | None = None, still: bool = False
) -> MotionProblem:
    """The motion of `scene` from rest at its static state, as `simulate` starts it.

    Parameters
    ----------
    scene
        what to march.
    offset : (n,)
        [m] added to the inner ring's displacement at the start, rotations times r_d.
    still
        holds the cage where it starts: energy is then kept where nothing damps.

    Raises
    ------
    ValueError
        where there is no static state to start from.
    """
    dofs = scene.active_dofs
    rest = static_start(scene, dofs)
    if rest is None:
        reason = equilibrium(scene, [0.0], dofs).reason(0)
        raise checks.refuse("scene", reason, "one with a static state to start from")
    n = len(dofs)
    start = rest.reshape(4, n)
    if offset is not None:
        start[0] += offset
    load = float(np.linalg.norm(body_numbers(scene, dofs).force)) or 1.0
    compression = (load / scene.bearing.load_deflection_factor) ** (2.0 / 3.0)
    turning = 2.0 * math.pi * (highest_natural_frequency(scene) or 1000.0)
    scale = compression * np.repeat([1.0, turning, 1.0, turning], n)
    if still:
        scene = scene.replace(shaft_speed=0.0)
    packed = packed_numbers(scene, dofs)
    return MotionProblem(scene, dofs, start.ravel(), scale, *packed[1:])
