"""Compile kernels before anybody waits for them; the machine code is kept on disk."""

from __future__ import annotations

import time
from collections.abc import Callable

from bearingcore.dynamics.modes import modes
from bearingcore.dynamics.motion import simulate
from bearingcore.scene.presets import presets
from bearingcore.scene.scene import WITH_MASS, Scene
from bearingcore.signals.spectrum import spectrum
from bearingcore.statics.maps import stiffness_maps

Report = Callable[[str], object]


def warm(report: Report = print) -> None:
    """Call what statics, motions and spectra are computed by, with arguments of all types.

    Takes 25 s of processor time where nothing is compiled yet, 1 s later. `report` is called with
    a line for each part.
    """
    fan_rig, angular = presets["fan-rig"], presets["liew-lim"]
    parts: dict[str, Callable[[], object]] = {
        "path of the ball": lambda: fan_rig.defects[0].path([0.0], fan_rig.bearing),
        "static equilibrium": lambda: modes(fan_rig, [0.0]),
        "maps": lambda: stiffness_maps(angular, [0.1], [0.0]),
        "spectrum": lambda: spectrum([0.0] * 64, 64.0, 1.0),
        "radial motion": lambda: _move(fan_rig),
        "motion in five directions": lambda: _move(angular),
    }
    for name, call in parts.items():
        start = time.perf_counter()
        call()
        report(f"compiled: {name} ({time.perf_counter() - start:.1f} s)")


def motions_with_mass() -> None:
    """Call what moves balls with mass, which is not part of `warm`.

    It takes as long to compile as all else together, and no first picture needs it.
    """
    for name in ("fan-rig", "liew-lim"):
        motion = simulate(presets[name].replace(balls=WITH_MASS), 1e-3, ball_loads=True)
        _ = motion.outer_acceleration


def _move(scene: Scene) -> None:
    for step_rate in (65536.0, 32768.0):
        motion = simulate(scene, 1e-3, 65536.0, ball_loads=True, step_rate=step_rate)
        _ = motion.outer_acceleration
