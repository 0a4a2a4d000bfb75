"""Compile every kernel before anybody waits for it; the machine code is kept on disk."""

from __future__ import annotations

import time
from collections.abc import Callable

from bearingcore.maps import stiffness_maps
from bearingcore.modes import modes
from bearingcore.motion import simulate
from bearingcore.presets import presets
from bearingcore.scene import Scene
from bearingcore.spectrum import spectrum


def warm(report: Callable[[str], object] = print) -> None:
    """Run a small piece of everything compiled, saying through `report` what is being done."""
    fan_rig, angular = presets["fan-rig"], presets["liew-lim"]
    tasks: tuple[tuple[str, Callable[[], object]], ...] = (
        ("static equilibrium", lambda: modes(fan_rig, [0.0])),
        ("maps", lambda: stiffness_maps(angular, [0.1], [0.0])),
        ("path of the ball", lambda: fan_rig.defects[0].path([0.0], fan_rig.bearing)),
        ("radial motion", lambda: _all_of_a_motion(fan_rig)),
        ("spectrum", lambda: spectrum([0.0] * 64, 64.0, 1.0)),
        ("motion in five directions", lambda: _all_of_a_motion(angular)),
    )
    for name, task in tasks:
        start = time.perf_counter()
        task()
        report(f"compiled: {name} ({time.perf_counter() - start:.1f} s)")


def _all_of_a_motion(scene: Scene) -> None:
    for step_rate in (65536.0, 32768.0):
        motion = simulate(scene, 1e-3, 65536.0, ball_loads=True, step_rate=step_rate)
        _ = motion.outer_acceleration
