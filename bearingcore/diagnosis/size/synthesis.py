"""Signals that a scene would give, as averages over ball passes."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.common.arrays import Array
from bearingcore.dynamics.damping import packed_motion
from bearingcore.dynamics.modes import highest_natural_frequency, modes
from bearingcore.dynamics.motion import SETTLING, moving_system
from bearingcore.scene.scene import Scene
from bearingcore.signals.averaging import BallPasses, coefficients
from bearingcore.statics.status import StaticStatus

AVERAGED = 0.12
"""[s] of it that are averaged, and never fewer than FEWEST_SIMULATED passes."""

FEWEST_SIMULATED = 4

SETTLED_FIRST = 0.03
"""[s] of motion after which one pass is first compared with the next."""

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


def _steps(
    scene: Scene, frequency: float, count: int, steps_a_cycle: float = STEPS_A_CYCLE
) -> tuple[int, int, int]:
    """Steps of a ball pass, passes that are thrown away, passes that are averaged."""
    fastest = float(np.nan_to_num(highest_natural_frequency(scene)))
    n = max(math.ceil(steps_a_cycle * fastest / frequency), 4 * count)
    passes = max(FEWEST_SIMULATED, math.ceil(AVERAGED * frequency))
    return n, math.ceil(SETTLING * frequency), passes


def steps_of(scene: Scene, frequency: float, count: int) -> int:
    """Steps that a simulation takes at most."""
    n, settle, passes = _steps(scene, frequency, count)
    return n * (settle + passes)


@dataclass(frozen=True)
class Begin:
    """State of a motion as a ball pass begins.

    Attributes
    ----------
    moving : (4, nd) [m], [m/s]
        displacement and velocity of the inner, then of the outer ring.
    resting : (4, nd) [m]
        the static state there.
    """

    moving: Array
    resting: Array


class Simulator:
    """Simulates ball passes of a scene whose defect is varied.

    What all of them share is made ready once: a simulation takes a third of a millisecond plus
    its steps else. A motion may begin where a neighbour's is, as far from its static state, and it
    ends as soon as one pass is like the next.

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
        scene = dataclasses.replace(scene, shaft_speed=scene.shaft_speed * frequency / nominal)
        self.scene = scene
        self.frequency = frequency
        self._count = count
        self._columns = list(columns)
        packed = packed_motion(scene)
        self._system, self._load = moving_system(packed), packed.load
        self._n, settle, averaged = _steps(scene, frequency, count, steps_a_cycle)
        self._rows: dict[str, Array] = {}
        self._averaged = averaged
        self._most = settle + averaged
        self._first = min(max(2, math.ceil(SETTLED_FIRST * frequency)), self._most)

    def passes(
        self,
        extent: float,
        edge: str,
        closed: float = 0.0,
        begin: Begin | None = None,
    ) -> tuple[BallPasses, Begin | None]:
        """Ball passes of a defect, and where they end.

        A motion has settled where two passes after each other differ by less than `closed`, as a
        share of their root mean square; where it never does the mean of many passes is taken.
        Coefficients are NaN where the motion diverged or had no static state to start from.
        """
        path = kernels.Path(self._row(extent, edge)[None], self._system.path.tables)
        system = self._system._replace(path=path)
        resting = self._resting(system)
        if resting is None:
            return self._nothing(), None
        state = resting if begin is None else begin.moving + (resting - begin.resting)
        y = state.ravel().copy()
        kernels.turn_smooth(y, 1.0, 0.0, system)
        # a pit that a few steps lead over would not be what it is
        n = self._n * math.ceil(STEPS_A_PIT * self.scene.bearing.ball_spacing / extent / self._n)
        step = 1.0 / (n * self.frequency)
        parts: list[NDArray[np.complex128]] = []
        done, ahead = 0, self._first
        while True:
            history = np.empty((ahead * n + 1, 6, len(system.rotor.active)))
            if kernels.march(y, step, 0.0, system, history) < ahead * n:
                return self._nothing(), None
            done += ahead
            kept = history[:-1, 5][:, self._columns].reshape(ahead, n, -1)
            parts.append(coefficients(kept[-self._averaged :], self._count))
            if done >= self._most:
                each = np.concatenate(parts)[-self._averaged :]
                break
            last, before = parts[-1][-1], parts[-1][-2] if ahead > 1 else parts[-2][-1]
            if closed > 0.0 and _apart(last, before) <= closed:
                each = last[None]
                break
            ahead = min(self._first, self._most - done) if closed > 0.0 else self._most - done
        power = (np.abs(each) ** 2).mean(axis=0)
        found = BallPasses(
            self.frequency, len(each), each.mean(axis=0), power, np.zeros(len(self._columns))
        )
        return found, Begin(history[-1, [0, 1, 3, 4]], resting)

    def _row(self, extent: float, edge: str) -> Array:
        """Path of a ball over a defect's edges; only the first of an edge model takes time."""
        if edge not in self._rows:
            (defect,) = self.scene.defects
            changed = dataclasses.replace(defect, edge=edge)
            self._rows[edge] = changed.edge_row(self.scene.bearing)
        row = self._rows[edge].copy()
        row[kernels.PATH_COLUMNS.index("half_extent")] = 0.5 * extent
        return row

    def _resting(self, system: kernels.System) -> Array | None:
        """The static state (4, nd) at cage angle 0, or None."""
        q, _, _, _, status, *_ = kernels.static_states(
            np.zeros(1), np.zeros(1), system.contacts, system.path, self._load
        )
        if status[0] not in (StaticStatus.CONVERGED, StaticStatus.FREE_DIRECTION):
            return None
        rotor = system.rotor
        state = np.zeros((4, len(rotor.active)))
        state[2] = rotor.force / rotor.stiffness  # the housing sinks into its support
        state[0] = state[2] + q[0, rotor.active]
        return state

    def _nothing(self) -> BallPasses:
        shape = (self._count, len(self._columns))
        return BallPasses(
            self.frequency,
            1,
            np.full(shape, complex(math.nan)),
            np.full(shape, math.nan),
            np.zeros(len(self._columns)),
        )


def _apart(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> float:
    """Root mean square of the difference of two passes, as a share of the first one's."""
    size = float((np.abs(one) ** 2).sum())
    return math.sqrt(float((np.abs(one - other) ** 2).sum()) / max(size, 1e-300))
