"""Signals that a scene would give, as averages over ball passes."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bearingcore.common import checks
from bearingcore.dynamics.modes import highest_natural_frequency, modes
from bearingcore.dynamics.motion import simulate
from bearingcore.model.scene import Scene
from bearingcore.signals.averaging import BallPasses, coefficients

SETTLING = 0.12
"""[s] of a simulated motion that is thrown away: several times the slowest mode's decay."""

AVERAGED = 0.12
"""[s] of it that are averaged, and never fewer than FEWEST_SIMULATED passes."""

FEWEST_SIMULATED = 4

STEPS_A_CYCLE = 10.0
"""Steps in a cycle of the highest natural frequency: an error near 0.2 dB, far below what a wrong
model does."""


@dataclass(frozen=True)
class Band:
    """Frequencies [Hz] in which signals are compared, around the rigid-body modes."""

    lowest: float
    highest: float


def comparison_band(scene: Scene, sample_rate: float) -> Band:
    """From a quarter of the healthy bearing's lowest natural frequency to 1.35 of its highest.

    Raises
    ------
    ValueError
        where the sample rate leaves less than an octave of it, or no static state is known.
    """
    limits = np.array(list(modes(scene.healthy()).bands().values()))
    if not np.isfinite(limits).all():
        raise checks.refuse("load", "such that the healthy bearing has no modes", "a static state")
    lowest, highest = 0.25 * float(limits.min()), 1.35 * float(limits.max())
    if 0.4 * sample_rate < 8.0 * lowest:
        raise checks.refuse(
            "sample_rate",
            sample_rate,
            f"at least {20.0 * lowest:.0f} Hz, to hear the modes of this scene",
        )
    return Band(lowest, min(highest, 0.4 * sample_rate))


def _steps(scene: Scene, frequency: float, count: int) -> tuple[int, int, int]:
    """Steps of a ball pass, passes that are thrown away, passes that are averaged."""
    fastest = float(np.nan_to_num(highest_natural_frequency(scene)))
    n = max(math.ceil(STEPS_A_CYCLE * fastest / frequency), 4 * count)
    passes = max(FEWEST_SIMULATED, math.ceil(AVERAGED * frequency))
    return n, math.ceil(SETTLING * frequency), passes


def steps_of(scene: Scene, frequency: float, count: int) -> int:
    """Steps that `synthesise` takes."""
    n, settle, passes = _steps(scene, frequency, count)
    return n * (settle + passes)


def synthesise(scene: Scene, frequency: float, count: int, columns: Sequence[int]) -> BallPasses:
    """Simulated ball passes of a scene whose balls pass `frequency` [Hz] times a second.

    `count` harmonics, along `columns`, indices into the scene's active directions. Coefficients
    are NaN where the motion diverged or had no static state to start from.
    """
    nominal = scene.bearing.bpfo(scene.shaft_speed)
    scene = dataclasses.replace(scene, shaft_speed=scene.shaft_speed * frequency / nominal)
    n, settle, passes = _steps(scene, frequency, count)
    motion = simulate(scene, (settle + passes) / frequency, n * frequency, step_rate=n * frequency)
    signal = motion.outer_acceleration[settle * n :, list(columns)]
    each = coefficients(signal.reshape(passes, n, len(columns)), count)
    power = (np.abs(each) ** 2).mean(axis=0)
    return BallPasses(frequency, passes, each.mean(axis=0), power, np.zeros(len(columns)))
