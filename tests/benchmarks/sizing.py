"""How well defects are sized: signals of known defects, drawn by seed, sized, and counted.

    python -m tests.benchmarks.sizing {given,passages} [--count 200]

All are of the fan rig, whose outer race is known to be damaged; the extent is not given.

given: extents 3-100°, 5-30 Hz, 60-1000 N, depths 15-200 µm, balls that slip by up to 1 %, 1.4 s at
20,480 Hz in white noise of 40, 20 and 10 dB; then a truth that differs from the given scene in one
thing, at 20 dB, and for each fourth scene in more than was asked for.
passages: entry to exit (`measure_extent`) on either race, balls with mass, three edge models,
1-30°, 6-20 Hz, 80-400 N, behind paths that ring; whole ball spacings more or less are as right,
and counted apart ("but for spacings").

"Right k" is an answer within half a ball spacing of the truth, "extent" one within 1° or 5 %, or of
passages one whose interval holds the truth. Wrong is a size that is off by more than that and by
more than 4 deviations, or a bound that the truth is beyond.
"""

import argparse
import math
import os
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np
import pandas as pd

from bearingcore import Scene, contact_damping, measure_extent, presets, simulate
from bearingcore.diagnosis.extent.measure import ExtentStatus
from bearingcore.diagnosis.size.answer import AT_MOST
from bearingcore.diagnosis.size.sizing import size_defect
from bearingcore.dynamics.record import PathEffects, drawn_resonances, simulated_record
from bearingcore.signals.recording import Recording
from tests.benchmarks.machine import pace

RIG = presets["fan-rig"]
SPACING = RIG.bearing.ball_spacing
FAMILIES = {"given": 2014, "passages": 777}
"""Seeds whose signals were never used to choose anything; 77 and 4711 were."""
TOGETHER = 8
"""Signals of one speed and load: what is simulated to explain them serves for all of them."""


class Answer(NamedTuple):
    """One signal, sized. Angles in degrees."""

    kind: str
    truth: float
    extent: float
    uncertainty: float
    probability: float
    conclusive: bool
    bound: str
    limit: float
    """Where the bound lies; NaN without one."""
    room: float
    """How far off an extent may be, or four deviations."""
    said: str
    seconds: float

    @property
    def right_turns(self) -> bool:
        """Whether the extent lies within half a ball spacing of the truth, said or not."""
        return abs(self.extent - self.truth) < 0.5 * math.degrees(SPACING)

    @property
    def right_extent(self) -> bool:
        """Whether the extent is off by no more than the room."""
        return self.truth - self.room <= self.extent <= self.truth + self.room

    @property
    def wrong(self) -> bool:
        """Whether what was said is not so."""
        if self.conclusive:
            room = max(self.room, 4.0 * self.uncertainty)
            return not self.truth - room <= self.extent <= self.truth + room
        if not self.bound:
            return False
        return self.limit < self.truth if self.bound == AT_MOST else self.limit > self.truth

    @property
    def outcome(self) -> str:
        """What was said."""
        return "sized" if self.conclusive else "bounded" if self.bound else "refused"


def sized(
    kind: str,
    truth: Scene,
    recording: Recording,
    room: float,
    *,
    given: Scene | None = None,
) -> Answer:
    """Size a recording of `truth`, whose extent is not looked at; `given` where that differs."""
    extent = truth.defects[0].extent
    begin = time.perf_counter()
    found = size_defect(
        recording,
        (given or truth).replace(extent=0.5),
        fault="outer race",
        support_known=True,
    )
    return Answer(
        kind,
        math.degrees(extent),
        math.degrees(found.best.extent),
        math.degrees(found.extent_uncertainty),
        found.best.probability,
        found.conclusive,
        found.bound,
        math.degrees(found.end(found.bound)) if found.bound else math.nan,
        room,
        f"{truth.shaft_speed / 2.0 / math.pi:.1f} Hz {-truth.load.fy:.0f} N: {found.sentence}",
        time.perf_counter() - begin,
    )


def _load_between(rng: np.random.Generator, low: float, high: float) -> float:
    return -math.exp(rng.uniform(math.log(low), math.log(high)))


# --- the scene as given, and one that differs in one thing


def _damping(scene: Scene, factor: float) -> Scene:
    support = scene.support
    return scene.replace(
        contact_damping=contact_damping(scene) * factor,
        damping_x=support.damping_x * factor,
        damping_y=support.damping_y * factor,
    )


def _stiffness(scene: Scene, factor: float) -> Scene:
    return scene.replace(
        load_deflection_factor=scene.bearing.load_deflection_factor * factor,
        stiffness_x=scene.support.stiffness_x * factor,
        stiffness_y=scene.support.stiffness_y * factor,
        contact_damping=contact_damping(scene),
    )


def _load(scene: Scene, factor: float) -> Scene:
    return scene.replace(fy=scene.load.fy * factor, contact_damping=contact_damping(scene))


#: how the truth differs from what the method is given
WRONG: dict[str, Callable[[Scene], Scene]] = {
    "edges: chord": lambda scene: scene.replace(edge="chord"),
    "edges: exact": lambda scene: scene.replace(edge="exact"),
    "damping half": lambda scene: _damping(scene, 0.5),
    "damping double": lambda scene: _damping(scene, 2.0),
    "stiffness -10 %": lambda scene: _stiffness(scene, 0.9),
    "stiffness +10 %": lambda scene: _stiffness(scene, 1.1),
    "load -20 %": lambda scene: _load(scene, 0.8),
    "load +20 %": lambda scene: _load(scene, 1.2),
}
#: beyond what was asked for
WORSE: dict[str, Callable[[Scene], Scene]] = {
    "depth -30 %": lambda scene: scene.replace(depth=0.7 * scene.defect.depth),
    "all at once": lambda scene: _load(
        _stiffness(_damping(scene.replace(edge="exact"), 2.0), 0.9), 1.2
    ),
}


def as_given(
    family: int, number: int, noises: Sequence[float] = (40.0, 20.0, 10.0)
) -> list[Answer]:
    """The right model at each noise, then one wrong thing at 20 dB."""
    rng = np.random.default_rng([family, number])
    scene = RIG.replace(
        extent=math.radians(rng.uniform(3.0, 100.0)),
        fy=_load_between(rng, 60.0, 1000.0),
        shaft_speed=2.0 * math.pi * rng.uniform(5.0, 30.0),
        depth=math.exp(rng.uniform(math.log(15e-6), math.log(200e-6))),
    )
    slip, rate = rng.uniform(-0.01, 0.01), 20_480.0

    def one(kind: str, noise: float, truth: Scene) -> Answer:
        start = round(rng.uniform(0.2, 0.4) * rate)
        turning = truth.replace(shaft_speed=truth.shaft_speed * (1.0 + slip))
        signal = simulate(turning, 1.4 + start / rate, rate).outer_acceleration[start:]
        level = math.sqrt(float(np.mean(signal**2))) * 10.0 ** (-noise / 20.0)
        recording = Recording(signal + level * rng.standard_normal(signal.shape), rate)
        room = max(1.0, 0.05 * math.degrees(scene.defects[0].extent))
        return sized(f"{kind}, {noise:.0f} dB", truth, recording, room, given=scene)

    kinds = [list(WRONG.items())[number % len(WRONG)]]
    if number % 4 == 0:
        kinds.append(list(WORSE.items())[number // 4 % len(WORSE)])
    return [
        *(one("right", noise, scene) for noise in noises),
        *(one(kind, 20.0, change(scene)) for kind, change in kinds),
    ]


# --- entry to exit


def passages(family: int, number: int) -> list[Answer]:
    """A spall measured from entry to exit, the race being known."""
    rng = np.random.default_rng([family, number])
    scene = RIG.replace(
        extent=math.radians(rng.uniform(1.0, 30.0)),
        fy=_load_between(rng, 80.0, 400.0),
        shaft_speed=2.0 * math.pi * rng.uniform(6.0, 20.0),
        race=("outer", "inner")[number % 2],
        edge=("exact", "chord", "published")[number // 2 % 3],
        balls="with mass",
    )
    truth = scene.defects[0].extent
    begin = time.perf_counter()
    found = measure_extent(
        simulated_record(scene, PathEffects(resonances=drawn_resonances(rng)), seed=number),
        scene.bearing,
        scene.shaft_speed,
        race=scene.defects[0].race,
    )
    bounded, either = (found.status == one for one in (ExtentStatus.SHORTER, ExtentStatus.EITHER))
    said = [part[1:] for part in found.alternatives if found.measured or either]
    said = [(-found.high, found.high)] if bounded else said[: 2 if either else 1]
    apart = bool(said) and not any(low <= truth <= high for low, high in said)
    # what was said that is nearest to the truth, or to it with whole ball spacings
    _, low, high, right = min(
        (
            (max(low - one, one - high), low, high, one)
            for low, high in np.degrees(said)
            for one in np.degrees(truth + SPACING * np.arange(-4, 3))
        ),
        default=(math.nan,) * 4,
    )
    return [
        Answer(
            f"{scene.defects[0].race} race{', x or y' * either}{', but for spacings' * apart}",
            right,
            0.5 * (low + high),
            0.125 * (high - low),
            math.nan,
            found.measured or either,
            AT_MOST if bounded else "",
            high,
            0.5 * (high - low),
            found.sentence or str(found.status),
            time.perf_counter() - begin,
        )
    ]


def size_all(
    one: Callable[[int], list[Answer]], count: int, processes: int = 2
) -> Iterator[Answer]:
    """Answers of many signals, in as many processes, which let other work go first."""
    with ProcessPoolExecutor(processes, initializer=os.nice, initargs=(5,)) as pool:
        for answers in pool.map(one, range(count), chunksize=TOGETHER if count > 99 else 1):
            yield from answers


def percent(flags: Sequence[bool]) -> float:
    """The share of those that hold."""
    return round(100.0 * float(np.mean(flags)), 1)


def print_table(answers: Sequence[Answer]) -> None:
    """Each kind of signal, and all together."""
    rows = {}
    for kind in [*dict.fromkeys(a.kind for a in answers), "all"]:
        group = [a for a in answers if kind in (a.kind, "all")]
        said = Counter(a.outcome for a in group)
        errors = [abs(a.extent - a.truth) for a in group if a.right_turns] or [math.nan]
        rows[kind] = {
            "n": len(group),
            "right k %": percent([a.right_turns for a in group]),
            "extent %": percent([a.right_extent for a in group]),
            **{name: said[name] for name in ("sized", "bounded", "refused")},
            "wrong": sum(a.wrong for a in group),
            "median error": round(float(np.median(errors)), 2),
            "nine of ten": round(float(np.quantile(errors, 0.9)), 2),
        }
    print(pd.DataFrame.from_dict(rows, orient="index").to_string())


def main() -> int:
    """Size the signals and print what came of it."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("set", choices=FAMILIES)
    parser.add_argument("--count", type=int, default=200, help="scenes")
    chosen = parser.parse_args()
    family = FAMILIES[chosen.set]
    sets: dict[str, Callable[[int], list[Answer]]] = {
        "given": partial(as_given, family),
        "passages": partial(passages, family),
    }
    answers = []
    for a in size_all(sets[chosen.set], chosen.count):
        answers.append(a)
        if a.wrong:
            print(
                f"{len(answers):4} {a.kind}: {a.truth:.2f}° taken for {a.extent:.2f}° ± "
                f"{a.uncertainty:.2f}°, {100.0 * a.probability:.1f} %, "
                f"WRONG, {a.said}",
                flush=True,
            )
    print_table(answers)
    machine = pace()
    print(f"a signal {machine.ratio(float(np.median([a.seconds for a in answers])))}; {machine}")
    return int(any(a.wrong for a in answers))


if __name__ == "__main__":
    raise SystemExit(main())
