"""The noise level of a simulated measurement.

The noise of a machine is the same with a healthy bearing as with a damaged one. So where the scene
has no defect, the level is relative to the vibration of a short one: relative to the healthy
bearing's own faint vibration, noise would be far below that of any machine, and even its ball
passes would show.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.diagnosis.model import motion
from bearingcore import Defect, Scene

REFERENCE_EXTENT, REFERENCE_DEPTH = math.radians(5.0), 50e-6
"""[rad], [m] of the defect under the load to whose vibration the noise is relative."""


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
        that is measured.
    signal : (n, d) [m/s²]
        what its housing does.
    columns
        of a motion of the scene, that are measured.
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
