"""How fast the machine is at this minute: milliseconds of the plain C loops, and ratios to them.

A time alone says little: the same machine takes twice as long with a neighbour on its cores. So
beside every time that is printed stands what the C loops take in the same minute. And a clock
counts what neighbours take as well; the system counts what each process has worked.
"""

import math
import os
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import psutil

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


def worked(process: int) -> float:
    """What a process has worked so far, all of its threads [s]; 0 where it is gone."""
    try:
        times = psutil.Process(process).cpu_times()
    except psutil.NoSuchProcess:
        return 0.0
    return float(times.user + times.system)


def resident(process: int) -> float:
    """The memory that a process holds [MB]."""
    return float(psutil.Process(process).memory_info().rss) / 1e6


def worked_by_kind(server: int) -> dict[str, float]:
    """What this process and all that it started have worked [s].

    Of the "server", the "browser" and the "hand" that moves the mouse, which no page has to carry.
    """
    seconds = {"hand": worked(psutil.Process().pid), "server": 0.0, "browser": 0.0}
    for process in psutil.Process().children(recursive=True):
        try:
            browser = "chrom" in process.exe()
        except psutil.Error:
            continue
        kind = "server" if process.pid == server else "browser" if browser else "hand"
        seconds[kind] += worked(process.pid)
    return seconds


if __name__ == "__main__":
    print(pace())
