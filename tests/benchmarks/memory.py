"""Memory of a process over random scenes: ``python -m tests.benchmarks.memory [--scenes 100000]``.

Each scene is another one, drawn from the whole box of `tests.helpers.box`, and everything is asked
of it that the program can answer: of each what is quick, of some what takes longer, and of a few
what the page draws of them. Printed is what the process holds after each tenth of them: before and
after a garbage collection, what of that the C library's heap has given out and what it keeps free,
what the page's caches hold, and what is given out beyond them. Caches are bounded in number and
bytes and go up and down with the scenes; what is beyond them must be flat. The last line says how
much of it was added over the second half.
"""

from __future__ import annotations

import argparse
import ctypes
import gc
import logging
import math
import os
import sys
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path

import numpy as np
from bearing_explorer.page import SECTIONS
from bearing_explorer.results.cache import cached_bytes
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.session import _picture
from bearing_explorer.views.base import View

from bearingcore import (
    Recording,
    Scene,
    Support,
    contact_damping,
    contact_pressures,
    diagnose,
    envelope_spectrum,
    equilibrium,
    film,
    impulsive_band,
    life,
    limits,
    modes,
    orbit,
    presets,
    simulate,
    spectrum,
    stiffness_maps,
)
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.experiments.alternatives import alternatives
from bearingcore.statics.ball_positions import ball_positions
from tests.benchmarks.machine import pace
from tests.helpers.box import cage_angles_at, draw, scene_at

CHUNK = 1000
MAY_GROW = 20.0
"""[MB] over the second half: what an allocator keeps in pieces."""

_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


def resident() -> float:
    """What this process holds [MB]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * _PAGE / 1e6


class _Heap(ctypes.Structure):
    """What `mallinfo2` of glibc says, as malloc.h has it [bytes]."""

    _fields_ = [
        (name, ctypes.c_size_t)
        for name in (
            "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
            "fordblks", "keepcost",
        )
    ]  # fmt: skip


def heap() -> tuple[float, float]:
    """What the C library has given out, and what it keeps free [MB]; NaN where it does not say."""
    try:
        look = ctypes.CDLL(None).mallinfo2
    except (OSError, AttributeError):
        return math.nan, math.nan
    look.restype = _Heap
    found = look()
    return (found.uordblks + found.hblkhd) / 1e6, found.fordblks / 1e6


def ask(scene: Scene, angles: np.ndarray, number: int) -> None:
    """Everything, what takes longer the more seldom; a refusal is an answer."""
    supported = scene.replace(support=_SUPPORT, shaft_speed=44.0)
    for every, questions in _QUESTIONS.items():
        if number % every == 0:
            for question in questions:
                with suppress(ValueError):
                    question(supported, angles)


def _signals(scene: Scene, angles: np.ndarray) -> None:
    del angles
    motion = simulate(scene, 0.02, 65536.0, most_steps=20_000).outer_acceleration
    spectrum(motion, 65536.0, 100.0)
    envelope_spectrum(motion, 65536.0, (2000.0, 4000.0))
    impulsive_band(motion[:, 0], 65536.0, 500.0, 20_000.0)


def _drawn(scene: Scene, angles: np.ndarray) -> None:
    """A bearing of which the grooves are known, under other loads."""
    del angles
    known = presets["6205"].replace(fy=-1.0 - 1e4 * abs(math.sin(scene.load.fy)))
    contact_pressures(known)
    life(known, 1e4, positions="load line")
    film(known, viscosity=0.01 + 0.1 * abs(math.cos(scene.load.fy)))


def _diagnosis(scene: Scene, angles: np.ndarray) -> None:
    del angles
    seed = round(1e6 * abs(math.sin(scene.load.fy)))
    noise = np.random.default_rng(seed).normal(size=4096)
    diagnose(Recording(noise, 4096.0, ("y",)), presets["fan-rig"].bearing, 90.0)


def _file(scene: Scene, angles: np.ndarray) -> None:
    del angles
    Scene.from_toml(scene.to_toml())


@cache
def _views() -> list[View]:
    packed = PackedSource()
    shown = ("load", "life", "stiffness", "maps", "modes", "vibration")
    return [view(packed) for section in SECTIONS if section.name in shown for view in section.views]


def _page(scene: Scene, angles: np.ndarray) -> None:
    del angles
    _picture(Results(scene, 0.1), _views(), limits=True)


_QUESTIONS: dict[int, tuple[Callable[[Scene, np.ndarray], object], ...]] = {
    1: (
        equilibrium,
        lambda scene, angles: stiffness_maps(scene, [0.1, 0.2], angles),
        modes,
        lambda scene, angles: highest_natural_frequency(scene),
        lambda scene, angles: contact_damping(scene),
    ),
    5: (_drawn, _file),
    20: (_signals, lambda scene, angles: limits(scene)),
    100: (
        lambda scene, angles: orbit(scene, most_steps=20_000),
        lambda scene, angles: ball_positions(scene.replace(balls="with mass", density=7850.0)),
        _diagnosis,
    ),
    500: (lambda scene, angles: alternatives(scene), _page),
}
"""What is asked of every so many scenes."""


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
    warnings.simplefilter("ignore")
    logging.disable(logging.CRITICAL)  # Bokeh finds scenes that no plot was made for
    rng = np.random.default_rng(chosen.seed)
    begun, done, held = time.perf_counter(), 0, []
    print(
        f"{'scenes':>10}{'MB':>9}{'after a collection':>20}{'in use':>9}{'free':>9}{'kept':>9}"
        f"{'beyond':>9}"
    )
    while done < chosen.scenes:
        points = draw(rng, min(CHUNK, chosen.scenes - done))
        for k in range(min(CHUNK, chosen.scenes - done)):
            point = points.point(k)
            ask(scene_at(point), cage_angles_at(point), done + k)
        done += CHUNK
        if done % max(chosen.scenes // 10, CHUNK) < CHUNK:
            before = resident()
            gc.collect()
            after = resident()
            used, free = heap()
            kept = cached_bytes() / 1e6
            held.append((after if math.isnan(used) else used) - kept)
            print(
                f"{done:>10,}{before:>9.0f}{after:>20.0f}{used:>9.0f}{free:>9.0f}{kept:>9.0f}"
                f"{held[-1]:>9.0f}",
                flush=True,
            )
    added = held[-1] - held[(len(held) - 1) // 2]
    took = time.perf_counter() - begun
    machine = pace()
    print(f"added over the second half: {added:.1f} MB; {machine.ratio(took / done)} a scene")
    print(machine)
    return int(added > MAY_GROW)


if __name__ == "__main__":
    sys.exit(main())
