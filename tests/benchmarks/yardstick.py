"""The plain C loops of `c_loops/`, built when asked for and called through ctypes.

They are yardsticks, not part of the program: the same work as a competent engineer writes it in
C, compiled by gcc on the machine that runs it.
"""

import ctypes
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Scene, equilibrium
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._motion import static_start
from bearingcore.model.scene._packing import body_numbers

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
        force, inner, outer, stiffness, support_damping = body_numbers(scene, DOF_NAMES)
        angle = scene.bearing.contact_angle
        tilting = np.concatenate(
            [
                [np.cos(angle), np.sin(angle), scene.bearing.groove_center_distance],
                *(force, 1.0 / inner, 1.0 / outer, stiffness, support_damping),
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
