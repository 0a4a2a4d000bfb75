"""Short pits and long spalls: what is told of their size where balls have mass.

    python -m tests.benchmarks.pits [--count 120] [--family 6001]

Signals of balls with mass on the fan rig at 65,536 Hz (2-20 Hz, 80-400 N, white noise at 10-30 dB),
drawn by seed, with the edges that geometry asks for, while the method is told its usual ones. A
half are pits of 0.2 to 2 mm, which balls bridge; a quarter long spalls; an eighth long spalls that
differ from whole ball spacings by less than 1.5°, so that one ball enters as another leaves, as in
a pit; and an eighth long spalls whose entry is faint, as their floor sinks slowly over the first
third. Prints how many of each kind were sized, bounded and refused, and what of it was wrong: a
size off by more than 0.5° and 4 deviations (where the entry is faint any place in the ramp is
right), or a bound below the truth.
"""

from __future__ import annotations

import argparse
import math
import os
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from bearingcore import Defect, Scene, presets
from bearingcore.diagnosis.size.answer import AT_MOST
from bearingcore.diagnosis.size.sizing import size_defect
from bearingcore.scene.pit import pit
from bearingcore.signals.recording import Recording
from tests.helpers.simulated import simulated_recording

SCORED = 6001
PIT, LONG, WHOLE, FAINT = "pit", "long", "whole spacings", "faint entry"
KINDS = (PIT, PIT, PIT, PIT, LONG, LONG, WHOLE, FAINT)
RATE = 65_536.0
RAMP = 1.0 / 3.0
"""Of a spall's extent, over which its floor sinks where the entry is faint."""


class Answer(NamedTuple):
    """One signal, sized. Angles in degrees."""

    number: int
    kind: str
    least: float
    """Extents from this to `truth` are right: they differ where the entry is faint."""
    truth: float
    extent: float
    uncertainty: float
    conclusive: bool
    bound: str
    limit: float
    """Where the bound lies; NaN without one."""
    scene: str
    status: str

    @property
    def resolved(self) -> str:
        """What was said."""
        return "sized" if self.conclusive else "bounded" if self.bound else "refused"

    @property
    def wrong(self) -> bool:
        """Whether what was said is not so."""
        room = max(0.5, 4.0 * self.uncertainty)
        if self.conclusive:
            return not self.least - room <= self.extent <= self.truth + room
        if not self.bound:
            return False
        if self.bound == AT_MOST:
            return self.limit < self.truth
        return self.limit > self.truth


def draw(family: int, number: int) -> tuple[str, Scene, float, float]:
    """Kind, scene, decibels of noise and the least extent [rad] that is right."""
    rng = np.random.default_rng([family, number])
    kind = KINDS[number % len(KINDS)]
    rig = presets["fan-rig"].replace(
        fy=-math.exp(rng.uniform(math.log(80.0), math.log(400.0))),
        shaft_speed=2.0 * math.pi * math.exp(rng.uniform(math.log(2.0), math.log(20.0))),
    )
    decibels = float(rng.uniform(10.0, 30.0))
    (defect,) = rig.defects
    if kind == PIT:
        length = 1e-3 * math.exp(rng.uniform(math.log(0.2), math.log(2.0)))
        dented = rig.replace(defect=pit(rig, length))
        return kind, dented, decibels, dented.defects[0].extent
    spacing = rig.bearing.ball_spacing
    extent = math.radians(rng.uniform(4.0, 90.0))
    if kind == WHOLE:
        extent = int(rng.integers(1, 4)) * spacing + math.radians(rng.uniform(-1.5, 1.5))
    long = rig.replace(extent=extent, edge="exact")
    if kind != FAINT:
        return kind, long, decibels, extent
    place = np.linspace(-0.5, 0.5, 401)
    depth = defect.depth * np.clip((place + 0.5) / RAMP, 0.0, 1.0) * (np.abs(place) < 0.5)
    # balls go around with rising angle: the floor sinks from the first edge that they meet
    sinking = Defect.measured(defect.center + place * extent, depth, edge="exact")
    return kind, rig.replace(defect=sinking), decibels, (1.0 - RAMP) * extent


def size(family: int, number: int) -> Answer:
    """Draw and size a signal."""
    kind, scene, decibels, least = draw(family, number)
    duration = max(1.0, 30.0 / scene.bearing.bpfo(scene.shaft_speed))
    clean = simulated_recording(scene, duration, RATE, with_mass=True)
    level = float(clean.acceleration.std()) * 10.0 ** (-decibels / 20.0)
    noise = level * np.random.default_rng([family, number, 1]).standard_normal(
        clean.acceleration.shape
    )
    recording = Recording(clean.acceleration + noise, RATE, clean.directions)
    told = presets["fan-rig"].replace(fy=scene.load.fy, shaft_speed=scene.shaft_speed, extent=0.5)
    sized = size_defect(recording, told, fault="outer race", support_known=True)
    return Answer(
        number,
        kind,
        math.degrees(least),
        math.degrees(scene.defects[0].extent),
        math.degrees(sized.best.extent),
        math.degrees(sized.extent_uncertainty),
        sized.conclusive,
        sized.bound,
        math.degrees(sized.end(sized.bound)) if sized.bound else math.nan,
        f"{scene.shaft_speed / 2.0 / math.pi:.1f} Hz {-scene.load.fy:.0f} N {decibels:.0f} dB",
        sized.sentence,
    )


def answers(family: int, count: int, processes: int) -> Iterator[Answer]:
    """Of many signals, in as many processes."""
    one = partial(size, family)
    if processes == 1:
        yield from map(one, range(count))
        return
    with ProcessPoolExecutor(processes, initializer=os.nice, initargs=(5,)) as pool:
        yield from pool.map(one, range(count))


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=120)
    parser.add_argument("--family", type=int, default=SCORED)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--each", action="store_true", help="print every answer")
    chosen = parser.parse_args()
    counts: Counter[tuple[str, str]] = Counter()
    errors: dict[str, list[float]] = {}
    for a in answers(chosen.family, chosen.count, chosen.processes):
        counts[a.kind, a.resolved] += 1
        counts[a.kind, "wrong"] += a.wrong
        if a.conclusive and a.kind != FAINT:
            errors.setdefault(a.kind, []).append(abs(a.extent - a.truth))
        if chosen.each or a.wrong:
            print(
                f"{a.number:4} {a.kind:<15} {a.truth:6.2f}° taken for {a.extent:6.2f}° ± "
                f"{a.uncertainty:.2f}°, {a.scene}: {'WRONG: ' if a.wrong else ''}{a.status}",
                flush=True,
            )
    columns = ("sized", "bounded", "refused", "wrong")
    print(f"{'kind':<16}" + "".join(f"{name:>9}" for name in columns) + "   error of those sized")
    for kind in dict.fromkeys(KINDS):
        row = "".join(f"{counts[kind, name]:9d}" for name in columns)
        error = f"{np.median(errors[kind]):.2f}° median" if kind in errors else ""
        print(f"{kind:<16}{row}   {error}")
    return 1 if sum(counts[kind, "wrong"] for kind in dict.fromkeys(KINDS)) else 0


if __name__ == "__main__":
    raise SystemExit(main())
