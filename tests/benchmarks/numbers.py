"""Print the speeds that the program is to reach, beside what it reaches and what plain C takes.

    python -m tests.benchmarks.numbers [--repeats 15] [--core]

gcc builds the C loops of `c_loops/` at the start, every answer is compared with the other's and
with the stored references before anything is timed, and the contenders take turns, so that all
are measured in the same minute on the same machine. Times are of the wall clock, of calls of
bearingcore's public functions with everything that a caller gets: checks of the input, arrays and
objects made, after a warm-up. Each repetition asks for a slightly different extent, as a dragged
slider does, so that nothing can come out of a cache. Nothing here passes or fails.

Then the page, by `starting`, `latency` and `classroom` of this folder: its first start with nothing
compiled, slider to pixels, a classroom. `--core` leaves them out.
"""

import argparse
import os
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from bearingcore import (
    DOF_NAMES,
    Scene,
    contact_damping,
    equilibrium,
    presets,
    simulate,
    spectrum,
    stiffness_maps,
)
from bearingcore.model.scene._packing import length_units
from tests.benchmarks.machine import CMotion, CStatics, start_state
from tests.browser.helpers import find_chromium

REFERENCE = Path(__file__).parent.parent / "reference" / "motion_reference.npz"
ANGLES, MAP_EXTENTS, MAP_ANGLES = 361, 91, 121
RATE, DURATION = 65536.0, 1.4
UPPER = np.triu_indices(5)

Contender = Callable[[Scene], object]


@dataclass
class Number:
    """One line of the table: who does it, on which scene, and what is asked for."""

    title: str
    target: str
    scene: Scene
    contenders: dict[str, Contender]
    share: float = 1.0
    """Part of the repetitions, for what takes long."""
    times: dict[str, list[float]] = field(default_factory=dict)


def dragged(scene: Scene, step: int) -> Scene:
    """The scene a hair further along the extent slider."""
    (defect,) = scene.defects
    return scene.replace(extent=defect.extent * (1.0 + 1e-7 * (step + 1)))


def measure(number: Number, repeats: int) -> None:
    """Contenders take turns; times in milliseconds."""
    number.times = {name: [] for name in number.contenders}
    for step in range(-2, max(3, round(repeats * number.share))):
        scene = dragged(number.scene, step + 2)
        for name, contender in number.contenders.items():
            start = time.perf_counter()
            contender(scene)
            taken = 1e3 * (time.perf_counter() - start)
            if step >= 0:
                number.times[name].append(taken)


def statics(scene: Scene, angles: int, step: float) -> object:
    """Ours: five DOFs whatever the scene needs, as the C loop has them."""
    return equilibrium(scene, step * np.arange(angles), dofs=DOF_NAMES)


def maps(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Ours: all 15 terms (15, m, n) and the loaded balls (m, n) over extents × cage angles."""
    extents = np.radians(np.arange(float(MAP_EXTENTS)))
    angles = np.linspace(0.0, scene.bearing.ball_spacing, MAP_ANGLES)
    answer = stiffness_maps(scene, extents, angles, dofs=DOF_NAMES)
    return answer.stiffness, answer.loaded_balls


def decibels(acceleration: np.ndarray, reference: np.ndarray) -> float:
    """Greatest error of the spectra in x and y over 0.3 to 2.1 kHz [dB]."""
    frequency, density = spectrum(acceleration, RATE)
    band = (frequency >= 300.0) & (frequency <= 2100.0)
    return float(np.abs(10.0 * np.log10(density[band] / reference[band])).max())


def check(c_statics: CStatics, c_motion: CMotion) -> None:
    """Say how far ours, C and the references are apart."""
    scene = presets["liew-lim"]
    step = scene.bearing.ball_spacing / (ANGLES - 1)
    ours = equilibrium(scene, step * np.arange(ANGLES), dofs=DOF_NAMES)
    theirs = c_statics.curve(scene, ANGLES, step)
    terms = ours.stiffness[:, UPPER[0], UPPER[1]]
    apart = (np.abs(terms - theirs["stiffness"]) / np.abs(terms).max(axis=0)).max()
    print(
        f"  statics: 15 terms of ours and of C differ by {apart:.1e} of each term's size;"
        f"\n    greatest relative residual: ours {ours.residual.max():.1e},"
        f" C {theirs['residual'].max():.1e}"
    )
    our_maps, our_loaded = maps(scene)
    c_maps, c_loaded = c_statics.maps(
        scene, MAP_EXTENTS, np.radians(1.0), MAP_ANGLES, scene.bearing.ball_spacing / 120
    )
    our_maps = np.moveaxis(our_maps, 0, -1)
    apart = (np.abs(our_maps - c_maps) / np.abs(our_maps).max(axis=(0, 1))).max()
    other = int((our_loaded != c_loaded).sum())
    print(f"  maps: {apart:.1e}; loaded balls differ at {other} of {our_loaded.size} points")
    stored = np.load(REFERENCE)
    scene = presets["fan-rig"].replace(contact_damping=122.0)
    density = stored["12.9deg/density"]
    samples = round(DURATION * RATE)
    march = c_motion.march(scene, start_state(scene), samples, RATE, 122.0)[1]
    mine = simulate(scene, DURATION, RATE)
    same = simulate(scene, DURATION, RATE, step_rate=RATE)
    print(
        f"  motion, error of the spectra (to reach: 0.05 dB): ours"
        f" {decibels(mine.outer_acceleration, density):.4f} dB at {mine.step_rate:.0f} steps a"
        f" second,\n    {decibels(same.outer_acceleration, density):.4f} dB at {RATE:.0f};"
        f" C {decibels(march, density):.4f} dB at {RATE:.0f}"
    )
    scene = presets["liew-lim"]
    fine = simulate(scene, 0.2, RATE, step_rate=8.0 * RATE).outer_acceleration
    mine = simulate(scene, 0.2, RATE, step_rate=RATE).outer_acceleration
    damping = contact_damping(scene)
    march = c_motion.march_tilting(scene, start_state(scene), len(mine), RATE, damping)[1]
    march /= length_units(scene, DOF_NAMES)
    off = [np.sqrt(np.mean((a - fine) ** 2) / np.mean(fine**2)) for a in (mine, march)]
    print(
        f"  five directions, error of the acceleration against eight times the steps: ours"
        f" {off[0]:.1e}, C {off[1]:.1e} (root mean square)"
    )


def numbers() -> list[Number]:
    """What is to be reached, with everybody who does it."""
    c_statics, c_motion = CStatics(), CMotion()
    check(c_statics, c_motion)
    liew_lim, fan_rig = presets["liew-lim"], presets["fan-rig"]
    spacing = liew_lim.bearing.ball_spacing / (ANGLES - 1)
    turn = 2.0 * np.pi / (ANGLES - 1)
    samples = round(DURATION * RATE)
    damping, start = contact_damping(fan_rig), start_state(fan_rig)
    tilting = contact_damping(liew_lim), start_state(liew_lim)

    def curves(step: float) -> dict[str, Contender]:
        return {
            "ours": lambda scene: statics(scene, ANGLES, step),
            "C": lambda scene: c_statics.curve(scene, ANGLES, step),
        }

    def c_maps(scene: Scene) -> object:
        step = scene.bearing.ball_spacing / 120
        return c_statics.maps(scene, MAP_EXTENTS, np.radians(1.0), MAP_ANGLES, step)

    def march(scene: Scene) -> object:
        return c_motion.march(scene, start, samples, RATE, damping)

    def tilting_march(scene: Scene) -> object:
        return c_motion.march_tilting(scene, tilting[1], samples, RATE, tilting[0])

    def signal(scene: Scene, step_rate: float | None = None) -> object:
        motion = simulate(scene, DURATION, RATE, step_rate=step_rate)
        return spectrum(motion.outer_acceleration, RATE)

    return [
        Number("361 cage angles over a ball spacing, 5 DOF, 15 terms", "2x C", liew_lim,
               curves(spacing), share=8.0),
        Number("361 cage angles over a turn, 1 degree apart", "2x C", liew_lim, curves(turn),
               share=8.0),
        Number("15 maps, 91 extents x 121 cage angles", "40 ms", liew_lim,
               {"ours": maps, "C": c_maps}),
        Number("1.4 s of motion, spectra (C: the march alone)", "2x C", fan_rig,
               {"ours": signal, "C": march}),
        Number("the same at 65,536 steps a second, as C", "", fan_rig,
               {"ours": lambda scene: signal(scene, RATE), "C": march}),
        Number("1.4 s of motion, 5 DOF, spectra (C: the march alone)", "", liew_lim,
               {"ours": signal, "C": tilting_march}, share=0.4),
    ]  # fmt: skip


def import_seconds(repeats: int = 5) -> list[float]:
    """Wall time of a new Python that imports bearingcore, less that of one that imports nothing."""

    def run(code: str) -> float:
        start = time.perf_counter()
        subprocess.run([sys.executable, "-c", code], check=True)
        return time.perf_counter() - start

    run("import bearingcore")
    return [run("import bearingcore") - run("pass") for _ in range(repeats)]


def show(table: list[Number]) -> None:
    """The table, times as median (least)."""

    def cell(times: list[float]) -> str:
        return f"{statistics.median(times):.2f} ({min(times):.2f})"

    print(f"\n{'':54}{'target':>8}{'ours ms':>18}{'C ms':>18}{'ratio':>15}")
    for number in table:
        ours, c = (number.times[name] for name in ("ours", "C"))
        ratio = f"{statistics.median(ours) / statistics.median(c):.2f}"
        ratio += f" ({min(ours) / min(c):.2f})"
        print(f"{number.title:54}{number.target:>8}{cell(ours):>18}{cell(c):>18}{ratio:>15}")


def main() -> None:
    """Build, check, measure, print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--repeats", type=int, default=15, help="of the longest measurements")
    parser.add_argument("--core", action="store_true", help="leave the page out")
    chosen = parser.parse_args()
    repeats = chosen.repeats
    began = time.perf_counter()
    compiler = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True)
    print(f"Python {platform.python_version()}, {compiler.stdout.splitlines()[0]}, "
          f"{os.cpu_count()} CPUs, load {os.getloadavg()[0]:.1f}")  # fmt: skip
    print("Checked before timing:")
    table = numbers()
    for number in table:
        measure(number, repeats)
    show(table)
    seconds = import_seconds()
    print(f"{'import bearingcore, caches warm':54}{'500 ms':>8}"
          f"{1e3 * statistics.median(seconds):>11.0f} ({1e3 * min(seconds):.0f})")  # fmt: skip
    counts = ", ".join(str(len(number.times["ours"])) for number in table)
    print(
        f"\nMilliseconds of wall clock, median and in brackets the least of {counts} repetitions,"
        f"\ncontenders in turn, all built and run within {time.perf_counter() - began:.0f} s."
        "\nours: bearingcore's public functions from Python; C: gcc -O3 -march=native, one thread,"
        "\nthrough ctypes; ratio: ours over C.",
        flush=True,
    )
    if not chosen.core:
        page()


def page() -> None:
    """What takes a server, and a browser where there is one."""
    commands = [
        ("First start, nothing compiled, and a later one", "starting"),
        ("Slider to pixels", "latency"),
        ("A classroom of 30 (target: nothing lost, 95 % in 300 ms)", "classroom"),
    ]
    if find_chromium() is None:
        commands = []
    for title, name in commands:
        print(f"\n{title}:", flush=True)
        subprocess.run([sys.executable, "-m", f"tests.benchmarks.{name}"], check=False)


if __name__ == "__main__":
    main()
