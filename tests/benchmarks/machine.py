"""How fast the machine is at this minute: the plain C loops, their times, and ratios to them.

A time alone says little: the same machine takes twice as long with a neighbour on its cores. So
beside every time that is printed stands what the C loops take in the same minute. And a clock
counts what neighbours take as well; the system counts what each process has worked.

The loops of `c_loops/` are no part of the program: they do the same work as a competent engineer
writes it in C. gcc compiles them when asked for, and they are called through ctypes.
"""

import ctypes
import math
import os
import shutil
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Scene, contact_damping, equilibrium, presets
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._motion import static_start
from bearingcore.model.scene._packing import rotor

SOURCES = Path(__file__).parent / "c_loops"
FLAGS = ("-O3", "-march=native")
ARC = {"published": 0.5, "chord": 1.0}

Array = NDArray[np.float64]
_DOUBLES = ctypes.POINTER(ctypes.c_double)


def compiler() -> str | None:
    """Path of gcc, None without one."""
    return shutil.which("gcc")


def build(name: str) -> Any:
    """Compile `c_loops/<name>.c` into a new temporary library and load it."""
    gcc = compiler()
    if gcc is None:
        raise RuntimeError("no gcc on this machine: install it to build the yardsticks")
    library = Path(tempfile.mkdtemp(prefix="yardstick-")) / f"{name}.so"
    command = [gcc, *FLAGS, "-shared", "-fPIC", "-o", str(library)]
    subprocess.run([*command, str(SOURCES / f"{name}.c"), "-lm"], check=True)
    return ctypes.CDLL(str(library))


def _at(array: Array) -> Any:
    return array.ctypes.data_as(_DOUBLES)


def _outer_defect(scene: Scene) -> tuple[float, float, float, float]:
    """Extent, depth, centre and part of the arc; the C loops know nothing else."""
    if not scene.defects:
        return 0.0, 0.0, 0.0, ARC["published"]
    (defect,) = scene.defects
    if defect.race != "outer" or defect.edge not in ARC:
        raise ValueError("the C loops know outer-race defects with published or chord edges")
    return defect.extent, defect.depth, defect.center, ARC[defect.edge]


class CStatics:
    """Static equilibrium and stiffness, five DOFs; outputs are kept from call to call."""

    def __init__(self, tolerance: float = 1e-12) -> None:
        self._library = build("statics")
        self._tolerance = tolerance

    def _numbers(self, scene: Scene) -> Array:
        bearing = scene.bearing
        names = (
            *("n_balls", "ball_radius", "contact_angle", "groove_center_radius"),
            *("groove_center_distance", "radial_clearance", "load_deflection_factor"),
            "outer_raceway_radius",
        )
        own = [getattr(bearing, name) for name in names]
        return np.array([*own, *_outer_defect(scene), *scene.load.vector, self._tolerance])

    def curve(self, scene: Scene, angles: int, step: float) -> dict[str, Array]:
        """`angles` cage angles from 0, `step` rad apart: displacement, 15 terms, ball loads."""
        out = {
            "displacement": np.empty((angles, 5)),
            "stiffness": np.empty((angles, 15)),
            "ball_load": np.empty((angles, scene.bearing.n_balls)),
            "residual": np.empty(angles),
        }
        evaluations = self._library.statics(
            _at(self._numbers(scene)),
            angles,
            ctypes.c_double(0.0),
            ctypes.c_double(step),
            *(_at(array) for array in out.values()),
        )
        if evaluations < 0:
            raise RuntimeError("the C loop did not converge")
        return out

    def maps(self, scene: Scene, extents: int, extent_step: float, angles: int, step: float) -> Any:
        """All 15 terms (extents, angles, 15) and the loaded balls (extents, angles)."""
        stiffness = np.empty((extents, angles, 15))
        loaded = np.empty((extents, angles))
        scratch = (np.empty((angles, 5)), np.empty((angles, 64)), np.empty(angles))
        evaluations = self._library.statics_maps(
            _at(self._numbers(scene)),
            extents,
            ctypes.c_double(extent_step),
            angles,
            ctypes.c_double(step),
            _at(stiffness),
            _at(loaded),
            *(_at(array) for array in scratch),
        )
        if evaluations < 0:
            raise RuntimeError("the C loop did not converge")
        return stiffness, loaded


def start_state(scene: Scene) -> Array:
    """Rest at the static state of cage angle 0, as `simulate` starts, in the order of the C."""
    state = static_start(packed_motion(scene), equilibrium(scene, [0.0]))
    assert state is not None
    return np.concatenate(state.reshape(4, -1)[[0, 2, 1, 3]])


class CMotion:
    """Motion of both bodies by classical Runge-Kutta, one step a sample."""

    def __init__(self, nodes: int = 2048) -> None:
        self._library = build("motion")
        self._nodes = nodes

    def march(
        self, scene: Scene, start: Array, samples: int, rate: float, damping: float
    ) -> tuple[Array, Array]:
        """In x and y, from `start` (8,): states (n, 8), the outer ring's acceleration (n, 2)."""
        numbers = self._numbers(scene, damping)
        return self._march("motion", [_at(numbers)], start, samples, rate, 2)

    def march_tilting(
        self, scene: Scene, start: Array, samples: int, rate: float, damping: float
    ) -> tuple[Array, Array]:
        """In five directions, tilts times r_d: states (n, 20), the outer ring's acceleration."""
        bodies = rotor(scene, DOF_NAMES, damping)
        angle = scene.bearing.contact_angle
        tilting = np.concatenate(
            [
                [np.cos(angle), np.sin(angle), scene.bearing.groove_center_distance],
                *(bodies.force, bodies.inverse_inner, bodies.inverse_outer),
                *(bodies.stiffness, bodies.damping),
            ]
        )
        numbers = self._numbers(scene, damping)
        pointers = [_at(numbers), _at(tilting)]
        return self._march("motion_tilting", pointers, start, samples, rate, 5)

    @staticmethod
    def _numbers(scene: Scene, damping: float) -> Array:
        bearing, support = scene.bearing, scene.support
        names = ("n_balls", "ball_radius", "radial_clearance", "load_deflection_factor")
        masses = np.array([support.inner_mass, support.outer_mass])
        return np.array([
            *(getattr(bearing, name) for name in names),
            bearing.outer_raceway_radius,
            *_outer_defect(scene),
            *(1.0 / masses),
            *support.stiffness("xy"),
            *support.damping("xy"),
            damping,
            *scene.load.vector[:2],
            scene.cage_speed,
        ])  # fmt: skip

    def _march(
        self, name: str, scene: list[Any], start: Array, samples: int, rate: float, n_dofs: int
    ) -> tuple[Array, Array]:
        states, acceleration = np.empty((samples, 4 * n_dofs)), np.empty((samples, n_dofs))
        now = np.array(start, dtype=float)
        status = getattr(self._library, name)(
            *scene,
            _at(now),
            samples,
            ctypes.c_double(1.0 / rate),
            self._nodes,
            _at(states),
            _at(acceleration),
        )
        if status:
            raise RuntimeError("the C loop has no room for this scene")
        return states, acceleration


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
