"""How well lengths of spalls are found: signals by seed, sized, and counted.

    python -m tests.benchmarks.sizing {lengths,passages} [--half {0,1}] [--count 60]

lengths: `size_defect` on signals of 1.5 s by the program in `tests/outside/rigs.py`. "as given" is
the fan rig with 5 to 75°, 6 to 20 Hz and 80 to 400 N, behind noise and tones 20 dB below, and a
wandering cage, two resonances, knocks at 4.7 kHz, or all of them; the next rows differ from the
scene that is given in one thing, the last are lengths and machines that are hard. Thresholds were
chosen on half 0 of the seeds; half 1 judges.
passages: `measure_extent` on either race, balls with mass, three edge models, 1 to 30°, 6 to 20 Hz,
80 to 400 N, behind paths that ring; whole ball spacings more or less are as right.

Right is a length within 2° of the truth, or of passages an interval that holds it; wrong is any
other one that is stated; open is the rest.
"""

import argparse
import math
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from bearingcore import Recording, measure_extent, presets, size_defect
from bearingcore.model.dynamics import PathEffects, simulated_record
from bearingcore.model.dynamics._record import drawn_resonances
from bearingcore.sizing import ExtentStatus
from tests.outside.rigs import RATE, Machine, record
from tests.outside.test_sizing import scene_of

DISTURBED = (
    ("noise",), ("noise", "wander"), ("noise", "path"), ("noise", "knocks"),
    ("noise", "wander", "path", "knocks"),
)  # fmt: skip

DIFFERING = {
    "load +20 %": {"load": 1.2}, "load -20 %": {"load": 0.8},
    "contact damping × 2": {"contact_damping": 2.0},
    "contact damping × 0.5": {"contact_damping": 0.5},
    "support × 1.2": {"support": 1.2}, "support × 0.7": {"support": 0.7},
    "edges: chord": {"edge": "chord"}, "edges: exact": {"edge": "exact"},
}  # fmt: skip


class Case(NamedTuple):
    """A signal: its kind, the machine that makes it, that which is given, and what disturbs it."""

    kind: str
    truth: Machine
    given: Machine
    disturbed: tuple[str, ...]
    seed: int


def drawn(*seed: int) -> Machine:
    """A fan rig by seed."""
    rng = np.random.default_rng(seed)
    extent, speed = math.radians(rng.uniform(5.0, 75.0)), 2.0 * math.pi * rng.uniform(6.0, 20.0)
    return Machine(extent, speed, math.exp(rng.uniform(math.log(80.0), math.log(400.0))))


def cases(half: int) -> Iterator[Case]:
    """All signals of one half of the seeds."""
    for i in range(36):
        machine = drawn(half, i)
        yield Case("as given", machine, machine, DISTURBED[i % 5], 1000 * half + i)
    for j, (kind, differing) in enumerate(DIFFERING.items()):
        for i in range(5):
            given = drawn(half, i, j)
            changed = {"load": given.load * differing["load"]} if "load" in differing else differing
            truth = replace(given, **changed)
            yield Case(kind, truth, given, DISTURBED[i % 5], 2000 * half + 100 * j + i)
    fan = partial(Machine, speed=2.0 * math.pi * (7 + 3 * half), load=100.0 * (1 + half))
    cwru = partial(
        Machine, speed=2.0 * math.pi * (1797 / 60 if half else 25.0),
        load=1000.0 * (1 - 0.3 * half), rig="6205", edge="exact",
    )  # fmt: skip
    loud = DISTURBED[4]
    for kind, make, seed, extents, disturbed in (
        ("near whole spacings", fan, 3000, (24.5, 25.7, 27, 50.5, 51.4, 52.5), DISTURBED[:1]),
        ("pits", fan, 4000, (0.5, 1, 1.5, 2, 3, 4), (loud, DISTURBED[0])),
        ("6205", cwru, 5000, (4, 8, 40, 48, 39, 41, 1.3, 0.5), (loud, DISTURBED[0])),
        ("6205, two that touch", partial(cwru, spalls=2), 6000, (8,), DISTURBED[:1]),
    ):
        for i, extent in enumerate(extents):
            machine = make(math.radians(extent))
            yield Case(kind, machine, machine, disturbed[i % len(disturbed)], seed * half + i)
    for i, extent in enumerate((6, 15, 30)):
        given = Machine(math.radians(extent), 2.0 * math.pi * (10 + 3 * half), 200.0)
        kind = "inner race, given as outer"
        yield Case(kind, replace(given, inner=True), given, DISTURBED[0], 7000 * half + i)


def outcome(case: Case) -> tuple[str, str, str]:
    """Kind, right, wrong or open, and what was said."""
    signal = Recording(record(case.truth, 1.5, case.seed, case.disturbed), RATE)
    sizing = size_defect(signal, scene_of(case.given), support_known=True)
    words = f"{math.degrees(case.truth.extent):.1f}° {'+'.join(case.disturbed)}: {sizing.sentence}"
    if not sizing.conclusive:
        return case.kind, "open", words
    near = abs(sizing.best.extent - case.truth.extent) <= math.radians(2.0)
    held = sizing.best.low <= case.truth.extent <= sizing.best.high
    words += "" if held else " Truth outside of the interval."
    return case.kind, "right" if near and not case.truth.inner else "wrong", words


def passage(number: int) -> tuple[str, str, str]:
    """The same for a spall measured from entry to exit, the race being known."""
    rng = np.random.default_rng([777, number])
    scene = presets["fan-rig"].replace(
        extent=math.radians(rng.uniform(1.0, 30.0)),
        fy=-math.exp(rng.uniform(math.log(80.0), math.log(400.0))),
        shaft_speed=2.0 * math.pi * rng.uniform(6.0, 20.0),
        race=("outer", "inner")[number % 2],
        edge=("exact", "chord", "published")[number // 2 % 3],
        balls="with mass",
    )
    effects = PathEffects(resonances=drawn_resonances(rng))
    measured = measure_extent(
        simulated_record(scene, effects, seed=number), scene.bearing, scene.shaft_speed,
        race=scene.defect.race,
    )  # fmt: skip
    stated = [(low, high) for _, low, high in measured.alternatives]
    stated = {
        ExtentStatus.MEASURED: stated[:1],
        ExtentStatus.EITHER: stated,
        ExtentStatus.SHORTER: [(-measured.high, measured.high)],
    }.get(measured.status, [])
    kind = f"{scene.defect.race} race, {measured.status}"
    words = f"{math.degrees(scene.defect.extent):.1f}°: {measured.sentence}"
    if not stated:
        return kind, "open", words
    alike = scene.defect.extent + scene.bearing.ball_spacing * np.arange(-4, 3)
    held = any(((low <= alike) & (alike <= high)).any() for low, high in stated)
    return kind, "right" if held else "wrong", words


def main() -> int:
    """Size the signals and print what came of it."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("set", choices=("lengths", "passages"))
    parser.add_argument("--half", type=int, choices=(0, 1), default=1, help="of the seeds")
    parser.add_argument("--count", type=int, default=60, help="passages")
    chosen = parser.parse_args()
    rows: dict[str, Counter[str]] = {}
    with ProcessPoolExecutor(2) as pool:
        outcomes = (
            pool.map(outcome, list(cases(chosen.half)))
            if chosen.set == "lengths"
            else pool.map(passage, range(chosen.count))
        )
        for kind, result, words in outcomes:
            print(f"{kind}: {result}, {words}", flush=True)
            rows.setdefault(kind, Counter())[result] += 1
    print("\n| signals | number | right | wrong | open |\n| --- | ---: | ---: | ---: | ---: |")
    for kind, counts in [*rows.items(), ("all", sum(rows.values(), Counter()))]:
        numbers = [counts.total(), *(counts[name] for name in ("right", "wrong", "open"))]
        print(f"| {kind} | " + " | ".join(map(str, numbers)) + " |")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
