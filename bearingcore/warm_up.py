"""Compile every kernel before anybody waits for it; the machine code is kept on disk."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

from bearingcore import kernels
from bearingcore.common.processors import processors
from bearingcore.dynamics.modes import modes
from bearingcore.dynamics.motion import Motion, march_from, simulate
from bearingcore.scene.presets import presets
from bearingcore.scene.scene import WITH_MASS, Scene
from bearingcore.signals.spectrum import spectrum
from bearingcore.statics.maps import stiffness_maps

Report = Callable[[str], object]
Tasks = tuple[tuple[str, Callable[[], object]], ...]


def warm(report: Report = print) -> None:
    """Run a small piece of everything compiled, saying through `report` what is being done.

    Where the kernels have yet to be compiled and there is a second processor, another process
    compiles those of motions meanwhile and leaves them on disk: the compiler itself uses one.
    """
    fan_rig, angular = presets["fan-rig"], presets["liew-lim"]
    _run(
        (("path of the ball", lambda: fan_rig.defects[0].path([0.0], fan_rig.bearing)),),
        report,
    )
    global _helper
    kept = kernels.kept_on_disk()
    _helper = helper = _start_helper() if kept and _compiled_afresh() and processors() > 1 else None
    try:
        _run(
            (
                ("static equilibrium", lambda: modes(fan_rig, [0.0])),
                ("maps", lambda: stiffness_maps(angular, [0.1], [0.0])),
                ("spectrum", lambda: spectrum([0.0] * 64, 64.0, 1.0)),
            ),
            report,
        )
        if helper is not None:
            for line in helper.communicate()[0].splitlines():
                report(line)
    finally:
        if helper is not None:
            helper.kill()
            helper.wait()
    _run(
        (
            ("radial motion", lambda: _all_of_a_motion(fan_rig)),
            ("motion in five directions", lambda: _all_of_a_motion(angular)),
        ),
        report if helper is None or helper.returncode else _silent,
    )


_helper: subprocess.Popen[str] | None = None


def give_up() -> None:
    """End the process that compiles beside this one: this one is about to end."""
    if _helper is not None:
        _helper.kill()


def _run(tasks: Tasks, report: Report) -> None:
    for name, task in tasks:
        start = time.perf_counter()
        task()
        report(f"compiled: {name} ({time.perf_counter() - start:.1f} s)")


def _silent(_: str) -> None: ...


def _compiled_afresh() -> bool:
    """True where what has been called until now was not on disk."""
    stats = getattr(kernels.ball_path, "stats", None)  # none where compiling is switched off
    return stats is not None and bool(stats.cache_misses)


def _start_helper() -> subprocess.Popen[str] | None:
    """A process that compiles the kernels of motions; None where none can be started."""
    return start_python(f"{_IMPORT}; compile_motions()")


_IMPORT = f"from {__name__} import compile_motions"


def start_python(lines: str, new_session: bool = False) -> subprocess.Popen[str] | None:
    """Another process that runs lines of Python; None where none can be started.

    It imports what this one can. In a `new_session` Ctrl+C does not reach it.
    """
    if not sys.executable:
        return None
    try:
        return subprocess.Popen(
            [sys.executable, "-c", lines],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL if new_session else subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=new_session,
        )
    except OSError:
        return None


def compile_motions() -> None:
    """Call every kernel of motions, and none of statics, with arguments of the types it meets."""
    fan_rig, angular = presets["fan-rig"], presets["liew-lim"]
    _run(
        (
            ("radial motion", lambda: _without_statics(fan_rig)),
            ("motion in five directions", lambda: _without_statics(angular)),
        ),
        lambda text: print(text, flush=True),
    )


def _without_statics(scene: Scene) -> None:
    """A few steps from nowhere in particular."""
    scene = scene.replace(contact_damping=100.0)  # or it is taken from a static state
    dofs = scene.active_dofs
    history = np.zeros((9, 6, len(dofs)))
    march_from(scene, np.zeros(4 * len(dofs)), 1.0 / 32768.0, history)
    motion = Motion(
        scene, dofs, 65536.0, 32768.0, True, "completed", 32, np.arange(16) / 65536.0, None, history
    )
    _ = motion.outer_acceleration, motion.ball_loads()


def motions_with_mass() -> None:
    """A little of what balls with mass are moved by, which is not part of `warm`.

    It takes as long to compile as all else together, and nobody's first picture needs it.
    """
    for name in ("fan-rig", "liew-lim"):
        motion = simulate(presets[name].replace(balls=WITH_MASS), 1e-3, ball_loads=True)
        _ = motion.outer_acceleration


def _all_of_a_motion(scene: Scene) -> None:
    for step_rate in (65536.0, 32768.0):
        motion = simulate(scene, 1e-3, 65536.0, ball_loads=True, step_rate=step_rate)
        _ = motion.outer_acceleration
