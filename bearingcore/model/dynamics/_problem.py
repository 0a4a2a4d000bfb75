"""The motion of a scene as an initial-value problem for any integrator."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearingcore.common import Array, _checks as checks
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._modes import highest_frequency_of
from bearingcore.model.dynamics._motion import moving_system, static_start
from bearingcore.model.scene import Scene
from bearingcore.model.statics import path_kinks
from bearingcore.model.statics._equilibrium import equilibrium_of


@dataclass(frozen=True)
class MotionProblem:
    """Initial-value problem of a scene; rotations are times r_d.

    Attributes
    ----------
    scene, dofs
        the scene and its n active directions.
    start : (4 n,) [m, m/s]
        displacement and velocity of the inner ring, then of the outer ring, at time 0.
    scale : (4 n,) [m, m/s]
        typical sizes, to which tolerances are relative, as all displacements are micrometres: one
        ball's compression under the load, and that times the highest natural angular frequency.
    system
        arguments of the kernels, with velocities as variables.
    """

    scene: Scene
    dofs: tuple[str, ...]
    start: Array
    scale: Array
    system: kernels.System

    def rate(self, t: float, y: Array) -> Array:
        """Return dy/dt at time t [s], by compiled code."""
        return np.asarray(kernels.motion_rates(np.array([t]), y[None], 0.0, self.system)[0])

    def kinks(self, duration: float) -> Array:
        """Return rising times [s] at which a ball meets an edge or the floor of a defect."""
        if self.scene.cage_speed == 0.0:
            return np.zeros(0)
        last = duration * self.scene.cage_speed
        angles = path_kinks(self.scene, 0.0, last)
        return angles[(angles > 0.0) & (angles < last)] / self.scene.cage_speed


def motion_problem(scene: Scene) -> MotionProblem:
    """Return the motion of `scene` from rest at its static state, as `simulate` starts it.

    Raises
    ------
    ValueError
        for a shaft that stands still, or if there is no static state to start from.
    """
    checks.real_number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
    packed = packed_motion(scene)
    state = equilibrium_of(packed, [0.0])
    rest = static_start(packed, state)
    if rest is None:
        reason = state.reason(0)
        raise checks.refuse("scene", reason, "one with a static state to start from")
    load = float(np.linalg.norm(packed.rotor.force)) or 1.0
    compression = packed.contacts.compression(load)
    turning = 2.0 * math.pi * (highest_frequency_of(packed) or 1000.0)
    scale = compression * np.repeat([1.0, turning, 1.0, turning], len(packed.dofs))
    return MotionProblem(
        scene, packed.dofs, rest.ravel(), scale, moving_system(packed, velocities=True)
    )
