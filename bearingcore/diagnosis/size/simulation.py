"""Ball passes that a scene would give, with its defect varied."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.common.arrays import Array
from bearingcore.dynamics.damping import packed_motion
from bearingcore.dynamics.modes import highest_natural_frequency, modes
from bearingcore.dynamics.motion import SETTLING, march_from
from bearingcore.scene.scene import Scene
from bearingcore.signals.averaging import coefficients
from bearingcore.statics.equilibrium import equilibrium_of

AVERAGED = 0.12
"""[s] that are averaged, and never fewer than FEWEST_SIMULATED passes."""

FEWEST_SIMULATED = 4

STEPS_A_CYCLE = 10.0
"""Steps in a cycle of the highest natural frequency: an error near 0.2 dB, far below what a wrong
model does."""

STEPS_A_PIT = 10.0
"""Least number of steps while a ball passes a defect; each sees the defect four times."""


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
            f"at least {20.0 * lowest:.0f} Hz, to hold the modes of this scene",
        )
    return Band(lowest, min(highest, 0.4 * sample_rate))


class SimulatedPasses(NamedTuple):
    """Mean coefficients (N, d) of ball passes, and the mean of their squared sizes (N, d).

    NaN where the motion diverged or had no static state to start from.
    """

    harmonics: NDArray[np.complex128]
    power: Array


class Simulator:
    """Simulates ball passes of a scene whose defect is varied.

    Parameters
    ----------
    scene
        with a single defect.
    frequency
        of ball passes [Hz].
    count
        harmonics that are wanted.
    columns
        of the active directions.
    steps_a_cycle
        of the highest natural frequency.
    """

    def __init__(
        self,
        scene: Scene,
        frequency: float,
        count: int,
        columns: Sequence[int],
        steps_a_cycle: float = STEPS_A_CYCLE,
    ) -> None:
        nominal = scene.bearing.bpfo(scene.shaft_speed)
        self.scene = scene.replace(shaft_speed=scene.shaft_speed * frequency / nominal)
        self.frequency = frequency
        self._count, self._columns = count, list(columns)
        fastest = float(np.nan_to_num(highest_natural_frequency(self.scene)))
        self._n = max(math.ceil(steps_a_cycle * fastest / frequency), 4 * count)
        self._averaged = max(FEWEST_SIMULATED, math.ceil(AVERAGED * frequency))
        self._passes = math.ceil(SETTLING * frequency) + self._averaged

    @property
    def steps(self) -> int:
        """Steps of integration of one simulation, but for pits."""
        return self._n * self._passes

    def passes(self, extent: float, edge: str) -> SimulatedPasses:
        """Ball passes of a defect, once the motion has settled."""
        packed = packed_motion(self.scene.replace(extent=extent, edge=edge))
        # a pit that a few steps lead over would not be what it is
        n = self._n * math.ceil(STEPS_A_PIT * self.scene.bearing.ball_spacing / extent / self._n)
        steps = n * self._passes
        history = np.empty((steps + 1, 6, len(packed.dofs)))
        step = 1.0 / (n * self.frequency)
        if march_from(packed, equilibrium_of(packed, [0.0]), step, history) != steps:
            unknown = np.full((self._count, len(self._columns)), math.nan)
            return SimulatedPasses(unknown.astype(complex), unknown)
        signal = history[:-1, 5][-self._averaged * n :, self._columns]
        each = coefficients(signal.reshape(self._averaged, n, -1), self._count)
        return SimulatedPasses(each.mean(axis=0), (np.abs(each) ** 2).mean(axis=0))
