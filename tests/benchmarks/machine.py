"""How fast the machine is at this minute: milliseconds of the plain C loops, and ratios to them.

A time alone says little: the same machine takes twice as long with a neighbour on its cores. So
beside every time that is printed stands what the C loops take in the same minute.
"""

import math
import os
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from bearingcore import contact_damping, presets
from tests.benchmarks.yardstick import CMotion, CStatics, compiler, start_state

ANGLES, RATE, DURATION = 361, 65536.0, 1.4
REPEATS = 7


@dataclass(frozen=True)
class Pace:
    """Medians of the C loops [s]; NaN where there is no gcc to build them."""

    statics: float
    """361 cage angles, five directions, 15 terms."""
    motion: float
    """1.4 s of motion in two directions, 65,536 steps a second: the unit of all ratios."""
    load: float
    """of the machine, as the system counts it"""

    def ratio(self, seconds: float) -> str:
        """A time [s] as a multiple of the C loop of motion: "12.3 C"."""
        times = seconds / self.motion
        return "  – C" if math.isnan(times) else f"{times:,.{0 if times >= 100.0 else 1}f} C"

    def __str__(self) -> str:
        if math.isnan(self.motion):
            return f"yardstick: none, as there is no gcc; load {self.load:.1f}"
        return (
            f"yardstick: C loops {1e3 * self.statics:.2f} ms (statics) and "
            f"{1e3 * self.motion:.1f} ms (motion: 1 C); load {self.load:.1f}"
        )


def pace() -> Pace:
    """The machine's pace now; takes a tenth of a second."""
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else math.nan
    if compiler() is None:
        return Pace(math.nan, math.nan, load)
    return Pace(*(_median(loop) for loop in _loops()), load)


@cache
def _loops() -> tuple[Callable[[], object], ...]:
    """Both loops, built once."""
    angular, rig = presets["liew-lim"], presets["fan-rig"]
    curve, march = CStatics(), CMotion()
    state = start_state(rig)
    step, damping = angular.bearing.ball_spacing / (ANGLES - 1), contact_damping(rig)
    return (
        lambda: curve.curve(angular, ANGLES, step),
        lambda: march.march(rig, state, round(DURATION * RATE), RATE, damping),
    )


def _median(loop: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        begun = time.perf_counter()
        loop()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


if __name__ == "__main__":
    print(pace())
