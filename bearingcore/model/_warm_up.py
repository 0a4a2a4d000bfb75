"""Compile kernels before anybody waits for them; the machine code is kept on disk."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np

from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import modes, orbit, simulate
from bearingcore.model.scene import WITH_MASS, presets
from bearingcore.recordings import spectrum

Report = Callable[[str], object]


def warm(report: Report = print, parts: Iterable[str] | None = None) -> None:
    """Compile all kernels by calling them with arguments of all types.

    Parameters
    ----------
    report
        called with a line for each part.
    parts
        names in `PARTS`; None stands for all of them, in order.
    """
    for name in PARTS if parts is None else parts:
        start = time.perf_counter()
        PARTS[name]()
        report(f"compiled: {name} ({time.perf_counter() - start:.1f} s)")


def _statics() -> None:
    fan_rig = presets["fan-rig"]
    fan_rig.defects[0].path([0.0], fan_rig.bearing)
    modes(fan_rig, [0.0])


def _motion() -> None:
    for step_rate in (65536.0, 32768.0):
        motion = simulate(presets["fan-rig"], 1e-3, 65536.0, step_rate=step_rate)
        _ = motion.outer_acceleration, motion.ball_loads()
    spectrum(np.zeros(4096), 65536.0)  # the first spectrum imports for half a second


def _balls_with_mass() -> None:
    motion = simulate(presets["fan-rig"].replace(balls=WITH_MASS), 1e-3)
    _ = motion.outer_acceleration, motion.ball_loads()


def _orbits() -> None:
    orbit(presets["fan-rig"])
    # Measured floors need the first of these kernels, frequency bands of many scenes the second.
    kernels.roll_over(np.zeros(3), np.zeros(2))
    unit = np.ones((1, 1))
    kernels.modes_like(
        unit, unit, unit, unit.copy(), np.zeros((1, 1), dtype=np.int64), unit[None].copy()
    )


STATICS, MOTION, BALLS_WITH_MASS, ORBITS = "statics", "motion", "balls with mass", "orbits"
PARTS: dict[str, Callable[[], None]] = {
    STATICS: _statics,
    MOTION: _motion,
    BALLS_WITH_MASS: _balls_with_mass,
    ORBITS: _orbits,
}
"""Parts that can be compiled separately: the first tab needs the first two, in this order."""
