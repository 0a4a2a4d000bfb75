"""A simulated measurement: the scene as a sensor with noise would measure it.

The noise of a machine is the same with a healthy bearing as with a damaged one. So where the scene
has no defect, the level is relative to the vibration of a short one: relative to the healthy
bearing's own faint vibration, noise would be far below that of any machine, and even its ball
passes would show.
"""

from __future__ import annotations

import cmath
import math

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.diagnosis.machine import SIMULATED, scene_machine
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import cached
from bearing_explorer.kit.sentences import sentence_of
from bearingcore import Defect, Motion, Recording, Scene, simulate
from bearingcore.model.scene import WITH_MASS

REFERENCE_EXTENT, REFERENCE_DEPTH = math.radians(5.0), 50e-6
"""Extent [rad] and depth [m] of the loaded defect whose vibration is the measure of noise."""

RATE = 25_600.0
"""Sample rate [Hz] of simulated measurements."""

PASSES = 200.0
"""Ball passes in a measurement, unless it would be too short or too long: enough to separate lines
that are one shaft frequency apart."""

SHORTEST, LONGEST = 1.0, 5.0  # [s]
MOST_STEPS, MOST_STEPS_WITH_MASS = 400_000, 1_600_000
"""Largest number of steps of a simulated motion; one that needs more is shortened."""
SETTLING = 0.3  # [s] before a simulated measurement begins


@cached
def motion(scene: Scene, duration: float, sample_rate: float) -> Motion:
    """Simulate a motion of a duration [s] at a rate [Hz]; ValueError where there is none."""
    compiling.need(compiling.MOTION, scene)
    most = MOST_STEPS_WITH_MASS if scene.balls == WITH_MASS else MOST_STEPS
    step_rate = simulate(scene, 2.0 / sample_rate, sample_rate).step_rate  # of two samples
    if math.isfinite(step_rate) and step_rate > 0.0:
        duration = min(duration, max(most / step_rate, 0.1))
    return simulate(scene, duration, sample_rate, most_steps=MOST_STEPS_WITH_MASS)


def true_part(scene: Scene) -> str:
    """The part that is damaged; "none" where none is, "" where several are."""
    races = {defect.race for defect in scene.defects}
    if not races:
        return "none"
    return f"{races.pop()} race" if len(races) == 1 else ""


def noise_level(
    scene: Scene, signal: NDArray[np.float64], columns: list[int], noise_db: float,
    duration: float, sample_rate: float,
) -> NDArray[np.float64]:  # fmt: skip
    """Root mean square of the noise in each direction (d,) [m/s²].

    Parameters
    ----------
    scene
        scene that is measured.
    signal : (n, d) [m/s²]
        acceleration of its housing.
    columns
        columns of the scene's motion that are measured.
    noise_db
        signal over noise [dB].
    duration, sample_rate
        [s], [Hz] of its motion.
    """
    share = 10.0 ** (-noise_db / 20.0)
    if share == 0.0:
        return np.zeros(len(columns))
    if true_part(scene) == "none":
        loaded = math.atan2(scene.load.fy, scene.load.fx)
        damaged = scene.replace(defect=Defect(REFERENCE_EXTENT, REFERENCE_DEPTH, loaded))
        moved = motion(damaged, duration, sample_rate)
        strongest = moved.outer_acceleration[len(moved.time) // 4 :, columns]
        return np.full(len(columns), float(np.std(strongest, axis=0).max()) * share)
    return np.asarray(np.sqrt(np.mean(signal**2, axis=0)) * share)


def load_on_defect(scene: Scene) -> float | None:
    """Radial load [N] of a scene towards its defect; None with several defects, or without load.

    A defect of the inner race turns through the load zone. There, the full load counts.
    """
    if len(scene.defects) != 1:
        return None
    (defect,), force = scene.defects, complex(scene.load.fx, scene.load.fy)
    towards = (force * cmath.rect(1.0, -defect.center)).real
    load = abs(force) if defect.race == "inner" else towards
    return load if load > 1e-6 * abs(force) else None


def simulated(scene: Scene, noise_db: float, seed: int) -> Measured:
    """Return a measurement of a scene, as a sensor with noise would make it.

    Parameters
    ----------
    noise_db
        signal over noise [dB], in each direction.

    Raises
    ------
    ValueError
        with a sentence, where the scene does not move.
    """
    rng = np.random.default_rng(seed)
    passing = scene.bearing.bpfo(scene.shaft_speed)
    duration = min(max(PASSES / passing, SHORTEST), LONGEST) if passing > 0.0 else SHORTEST
    duration += SETTLING
    try:
        moved = motion(scene, duration, RATE)
    except ValueError as error:
        raise ValueError(sentence_of(error)) from None
    columns = [index for index, dof in enumerate(moved.dofs) if dof in ("x", "y")]
    # begin at a random time: the diagnosis must find out itself where the ball passes begin
    first = round((SETTLING - rng.uniform(0.0, 0.1)) * RATE)
    signal = moved.outer_acceleration[first:, columns]
    if not columns or len(signal) < 0.5 * SHORTEST * RATE or not np.isfinite(signal).all():
        raise ValueError("Not possible: the simulated housing does not move along x or y.")
    level = noise_level(scene, signal, columns, noise_db, duration, RATE)
    noisy = signal + level * rng.standard_normal(signal.shape)
    name = "Simulated" + (", balls with mass" if scene.balls == WITH_MASS else "")
    name += f", noise {noise_db:.0f} dB below" if math.isfinite(noise_db) else ""
    directions = tuple(moved.dofs[index] for index in columns)
    try:
        recording = Recording(noisy, moved.sample_rate, directions, name)
    except ValueError:
        raise ValueError("Not possible: the simulated housing does not move.") from None
    single = len(scene.defects) == 1 and scene.defects[0].race == "outer"
    extent = scene.defects[0].extent if single else None
    edge = scene.defects[0].edge if len(scene.defects) == 1 else None
    return Measured(
        recording, scene_machine(scene, SIMULATED), extent,
        true_part=true_part(scene), noiseless=math.isinf(noise_db),
        true_load=load_on_defect(scene), true_edge=edge,
        true_scene=scene,
    )  # fmt: skip
