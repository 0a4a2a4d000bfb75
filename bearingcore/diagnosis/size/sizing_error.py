"""Error of the estimated size of a defect, by its own simulated signal."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bearingcore.common import checks
from bearingcore.diagnosis.size.sizing import Sizing, size_defect
from bearingcore.dynamics.motion import simulate
from bearingcore.scene.defect import Defect
from bearingcore.scene.scene import Scene
from bearingcore.signals.recording import Recording

DURATION, SAMPLE_RATE = 0.7, 20_480.0
"""[s], [Hz] of the recording."""

SETTLED = 0.3
"""[s] of a simulated motion before its signal is recorded."""


@dataclass(frozen=True)
class ExtentError:
    """The most probable extent less the true one [rad], and the sizing that says so.

    `error` is NaN where there is no clear result; `sizing.sentence` says why.
    """

    error: float
    sizing: Sizing


def extent_error(
    scene: Scene,
    *,
    noise: float = 20.0,
    progress: Callable[[float], None] | None = None,
) -> ExtentError:
    """Simulate what sensors along x and y would record of `scene`, and size its defect by it.

    Parameters
    ----------
    scene
        with a single defect of the outer race.
    noise
        level of white noise below the signal's mean power [dB].
    progress
        as for `size_defect`: is called with the share of the work done, and may raise an exception.

    Raises
    ------
    ValueError
        for a scene without a defect that can be sized, or one whose motion does not stay finite.
    """
    if not isinstance(scene.defect, Defect):
        raise checks.refuse("defect", f"{len(scene.defect)} defects", "a single one")
    checks.real_number("extent", scene.defect.extent, above=0.0, unit="rad")
    checks.real_number("depth", scene.defect.depth, above=0.0, unit="m")
    motion = simulate(scene, DURATION + SETTLED, SAMPLE_RATE)
    if not motion.completed:
        raise ValueError(f"there is no signal to size: {motion.reason}")
    columns = [i for i, name in enumerate(motion.dofs) if name in ("x", "y")]
    signal = motion.outer_acceleration[round(SETTLED * SAMPLE_RATE) :, columns]
    level = math.sqrt(float(np.mean(signal**2))) * 10.0 ** (-noise / 20.0)
    signal = signal + level * np.random.default_rng(0).standard_normal(signal.shape)
    directions = tuple(motion.dofs[i] for i in columns)
    recording = Recording(signal, SAMPLE_RATE, directions)
    # which race is damaged and how it is supported is known here: only the size is estimated
    found = size_defect(recording, scene, fault="outer race", support_known=True, progress=progress)
    error = found.best.extent - scene.defect.extent if found.conclusive else math.nan
    return ExtentError(error, found)
