"""Simulated measurements of an accelerometer on the housing."""

from __future__ import annotations

import numpy as np

from bearingcore.common import checks
from bearingcore.dynamics.motion import simulate
from bearingcore.scene.scene import MASSLESS, WITH_MASS, Scene
from bearingcore.signals.recording import DIRECTIONS, Recording

SETTLING = 0.12
"""[s] of motion before the recording begins: several times the slowest mode's decay."""


def simulated_recording(
    scene: Scene,
    duration: float = 1.0,
    sample_rate: float = 65536.0,
    *,
    noise: float = 0.0,
    seed: int = 0,
    with_mass: bool | None = None,
) -> Recording:
    """Acceleration that a sensor on the housing records of a scene, its transient left out.

    Parameters
    ----------
    scene
        what is measured.
    duration, sample_rate
        [s], [Hz] of the recording.
    noise
        standard deviation [m/s²] of the sensor's white noise, another for each `seed`.
    with_mass
        whether balls have mass; None: as the scene says. With mass a small pit gives what real ones
        give: a step as a ball enters, an impulse as it strikes the far edge.

    Raises
    ------
    ValueError
        where the motion has no answer, in its words, or x and y do not move.
    """
    checks.number("duration", duration, above=0.0, unit="s")
    noise = checks.number("noise", noise, at_least=0.0, unit="m/s²")
    if with_mass is not None:
        scene = scene.replace(balls=WITH_MASS if with_mass else MASSLESS)
    directions = tuple(name for name in DIRECTIONS if name in scene.active_dofs)
    if not directions:
        raise checks.refuse("dofs", scene.active_dofs, "x or y among them, where sensors stand")
    motion = simulate(scene, SETTLING + duration, sample_rate)
    if not motion.completed:
        raise checks.refuse("scene", motion.reason, "one whose motion can be simulated")
    columns = [motion.dofs.index(name) for name in directions]
    signal = motion.outer_acceleration[-max(round(duration * sample_rate), 1) :, columns]
    if noise > 0.0:
        signal = signal + np.random.default_rng(seed).normal(0.0, noise, signal.shape)
    return Recording(signal, sample_rate, directions, f"simulated, balls {scene.balls}")
