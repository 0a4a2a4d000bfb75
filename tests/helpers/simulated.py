"""Simulated measurements of an accelerometer on the housing."""

import dataclasses
import math

from bearingcore.model.dynamics import simulate
from bearingcore.model.scene import MASSLESS, WITH_MASS, Defect, Scene
from bearingcore.recordings import Recording
from bearingcore.recordings._recording import DIRECTIONS

SETTLING = 0.12
"""[s] of motion before the recording begins: several times the slowest mode's decay."""


def simulated_recording(
    scene: Scene, duration: float = 1.0, sample_rate: float = 65536.0, *, with_mass: bool
) -> Recording:
    """Acceleration that a sensor on the housing records of a scene, its transient left out.

    With mass a small pit gives what real ones give: a step as a ball enters, an impulse as it
    strikes the far edge.
    """
    scene = scene.replace(balls=WITH_MASS if with_mass else MASSLESS)
    motion = simulate(scene, SETTLING + duration, sample_rate)
    assert motion.completed, motion.reason
    directions = tuple(name for name in DIRECTIONS if name in scene.active_dofs)
    columns = [motion.dofs.index(name) for name in directions]
    signal = motion.outer_acceleration[-round(duration * sample_rate) :, columns]
    return Recording(signal, sample_rate, directions, f"simulated, balls {scene.balls}")


def pit(scene: Scene, length: float) -> Defect:
    """A pit of the outer race under the load, `length` [m] along it, so deep that none is met."""
    bearing, load = scene.bearing, scene.load
    depth = min(0.25 * length, 0.5 * bearing.ball_radius)
    made = Defect(0.0, depth, math.atan2(load.fy, load.fx), "outer", "exact")
    return dataclasses.replace(made, extent=length / made.raceway_radius(bearing))
