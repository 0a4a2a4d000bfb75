"""Simulated measurements of an accelerometer on the housing."""

from bearingcore.dynamics.motion import simulate
from bearingcore.scene.scene import MASSLESS, WITH_MASS, Scene
from bearingcore.signals.recording import DIRECTIONS, Recording

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
