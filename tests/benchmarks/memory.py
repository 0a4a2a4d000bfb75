"""Memory of a process over random scenes: ``python -m tests.benchmarks.memory [--scenes 100000]``.

Each scene is another one, drawn from the whole box of `tests.helpers.box`, and everything that is
quick is asked of it: static states, a map, modes, bands, life, plans' highest frequency, and of
every twentieth a short motion. Printed is what the process holds after each tenth of them. What is
kept for later is bounded in number and bytes, so it must be flat once the caches are full; the last
line says how much was added over the second half.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
import time
from contextlib import suppress
from pathlib import Path

import numpy as np

from bearingcore import Scene, Support, contact_damping, equilibrium, modes, simulate
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.statics.maps import stiffness_maps
from tests.benchmarks.machine import pace
from tests.helpers.box import cage_angles_at, draw, scene_at

CHUNK = 1000
MOVED = 20
"""Of every so many scenes one is moved."""
MAY_GROW = 20.0
"""[MB] over the second half: what an allocator keeps in pieces."""

_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


def resident() -> float:
    """What this process holds [MB]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * _PAGE / 1e6


def ask(scene: Scene, angles: np.ndarray, moved: bool) -> None:
    """Everything that is quick; a refusal is an answer."""
    with suppress(ValueError):
        equilibrium(scene, angles)
        stiffness_maps(scene, [0.1, 0.2], angles)
    supported = scene.replace(support=_SUPPORT, shaft_speed=44.0)
    with suppress(ValueError):
        modes(supported, angles)
        highest_natural_frequency(supported)
        contact_damping(supported)
        if moved:
            _ = simulate(supported, 0.01, 65536.0, most_steps=20_000).outer_acceleration


_SUPPORT = Support(
    inner_mass=2.0, outer_mass=2.0, inner_inertia=2.5e-3, outer_inertia=2.5e-3,
    **{f"stiffness_{dof}": 2e8 for dof in ("x", "y", "z")},
    **{f"stiffness_{dof}": 1e5 for dof in ("rx", "ry")},
    **{f"damping_{dof}": 1600.0 for dof in ("x", "y", "z")},
    **{f"damping_{dof}": 1.0 for dof in ("rx", "ry")},
)  # fmt: skip


def main() -> int:
    """Ask, print, and say with the exit code whether it was flat."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args()
    rng = np.random.default_rng(chosen.seed)
    begun, done, held = time.perf_counter(), 0, []
    print(f"{'scenes':>10}{'MB':>9}{'after a collection':>20}")
    while done < chosen.scenes:
        points = draw(rng, min(CHUNK, chosen.scenes - done))
        for k in range(min(CHUNK, chosen.scenes - done)):
            point = points.point(k)
            ask(scene_at(point), cage_angles_at(point), (done + k) % MOVED == 0)
        done += CHUNK
        if done % max(chosen.scenes // 10, CHUNK) < CHUNK:
            before = resident()
            gc.collect()
            held.append(resident())
            print(f"{done:>10,}{before:>9.0f}{held[-1]:>20.0f}", flush=True)
    added = held[-1] - held[(len(held) - 1) // 2]
    took = time.perf_counter() - begun
    machine = pace()
    print(f"added over the second half: {added:.1f} MB; {machine.ratio(took / done)} a scene")
    print(machine)
    return int(added > MAY_GROW)


if __name__ == "__main__":
    sys.exit(main())
