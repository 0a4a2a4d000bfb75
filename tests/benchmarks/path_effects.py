"""How well defects are sized behind what real paths add, each effect switchable.

    python -m tests.benchmarks.path_effects [--count 200] [--effects all] [--steady] [--family 5812]

Scenes are drawn by seed: extents 4-75°, shaft speeds 6-20 Hz, loads 80-400 N on the fan rig. Their
signals, 1.4 s at 20,480 Hz, come from a cage whose speed wanders by 0.4 %, through two resonances
between housing and sensor (drawn too), with knocks at 4.7 kHz three times the peak of the motion at
the far edge, tones of the shaft and pink noise at 20 dB. --effects names those that are switched
on: all, none, or some of cage_wander, resonances, knock, shaft_tones, noise. --steady sizes as if
there were none.

"Right k" is a most probable extent within half a ball spacing of the truth, whether the answer
says so or not; conclusive ones are those that do.
"""

from __future__ import annotations

import argparse
import math
import os
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from bearingcore import Scene, presets
from bearingcore.diagnosis.size.sizing import size_defect
from bearingcore.diagnosis.size.variants import STEADY, PathTolerances
from tests.benchmarks.machine import pace
from tests.helpers.path_effects import PathEffects, drawn_resonances, recorded_through

SCORED, TRAINING = 5812, 4711
TOGETHER = 8
"""Signals of one speed and load: what is simulated to explain them serves for all of them."""
EFFECTS = ("cage_wander", "resonances", "knock", "shaft_tones", "noise")
SPACING_DEG = math.degrees(presets["fan-rig"].bearing.ball_spacing)


class Answer(NamedTuple):
    """One signal, sized. Angles in degrees."""

    number: int
    truth: float
    extent: float
    uncertainty: float
    probability: float
    conclusive: bool
    bound: str
    unexplained: float
    chance: float
    repeating: float
    path: str
    scores: tuple[float, ...]
    candidates: tuple[float, ...]
    scene: str
    status: str
    seconds: float

    @property
    def right(self) -> bool:
        """Whether the extent lies within half a ball spacing of the truth."""
        return abs(self.extent - self.truth) < 0.5 * SPACING_DEG

    @property
    def wrong(self) -> bool:
        """Whether it is said and not so: another k, or an extent beyond all that is stated."""
        away = abs(self.extent - self.truth)
        limit = max(1.5, 0.1 * self.truth, 4.0 * self.uncertainty)
        return self.conclusive and (not self.right or away > limit)


def draw(family: int, number: int) -> tuple[Scene, PathEffects]:
    """A scene and what lies between it and its sensor."""
    group = np.random.default_rng([family, number // TOGETHER])
    rng = np.random.default_rng([family, number // TOGETHER, number])
    scene = presets["fan-rig"].replace(
        extent=math.radians(rng.uniform(4.0, 75.0)),
        fy=-math.exp(group.uniform(math.log(80.0), math.log(400.0))),
        shaft_speed=2.0 * math.pi * group.uniform(6.0, 20.0),
    )
    return scene, PathEffects(resonances=drawn_resonances(rng))


def size(family: int, effects: tuple[str, ...], steady: bool, number: int) -> Answer:
    """Draw and size signal `number`; the extent is not told."""
    scene, every = draw(family, number)
    chosen = every.without(*(set(EFFECTS) - set(effects)))
    recording = recorded_through(scene, chosen, seed=number)
    begin = time.perf_counter()
    sized = size_defect(
        recording,
        scene.replace(extent=0.5),
        fault="outer race",  # known here: the question is how large
        support_known=True,
        path=STEADY if steady else PathTolerances(),
    )
    taken = time.perf_counter() - begin
    best = sized.best
    power = sized.passes.power.sum(axis=0)
    return Answer(
        number,
        math.degrees(scene.defects[0].extent),
        math.degrees(best.extent),
        math.degrees(sized.extent_uncertainty),
        best.probability,
        sized.conclusive,
        sized.bound,
        float(best.waveform_misfit.mean()),
        sized.chance,
        float(((np.abs(sized.passes.harmonics) ** 2).sum(axis=0) / power).mean()),
        f"{best.path.strength:g}",
        tuple(sized.scores.tolist()),
        tuple(math.degrees(c.extent) for c in sized.candidates),
        f"{scene.shaft_speed / 2.0 / math.pi:.0f} Hz {-scene.load.fy:.0f} N",
        sized.sentence,
        taken,
    )


def size_all(
    family: int, count: int, effects: tuple[str, ...], steady: bool, processes: int
) -> Iterator[Answer]:
    """Answers of many signals, in as many processes."""
    one = partial(size, family, effects, steady)
    if processes == 1:
        yield from map(one, range(count))
        return
    with ProcessPoolExecutor(processes, initializer=os.nice, initargs=(5,)) as pool:
        yield from pool.map(one, range(count), chunksize=TOGETHER)


def table(answers: Sequence[Answer]) -> str:
    """What came of it."""
    count = len(answers)
    right = sum(a.right for a in answers)
    told = [a for a in answers if a.conclusive]
    errors = [abs(a.extent - a.truth) for a in answers if a.right]
    ratio = [(a.extent - a.truth) / a.uncertainty for a in told if a.right]
    rows = [
        ("right k", f"{right} of {count} ({right / count:.0%})"),
        ("right k and conclusive", f"{sum(a.right for a in told)}"),
        ("cannot tell, or a bound", f"{count - len(told)}"),
        ("conclusive and wrong", f"{sum(a.wrong for a in answers)}"),
    ]
    if errors:
        rows.append(("error with the right k", f"{np.median(errors):.2f}° median, "
                     f"{np.quantile(errors, 0.9):.2f}° in nine of ten"))  # fmt: skip
    if len(ratio) > 1:
        spread = f"{np.std(ratio):.2f}, median size {np.median(np.abs(ratio)):.2f}"
        rows.append(("error over stated deviation", f"spread {spread} (a normal law: 1, 0.67)"))
    return "\n".join(f"{name:<30}{words}" for name, words in rows)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--effects", default="all")
    parser.add_argument("--steady", action="store_true")
    parser.add_argument("--train", action="store_true", help="draw other scenes, to choose by")
    parser.add_argument("--family", type=int, default=SCORED, help="of scenes that are drawn")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--each", action="store_true", help="print every answer")
    chosen = parser.parse_args()
    effects = EFFECTS
    if chosen.effects != "all":
        effects = () if chosen.effects == "none" else tuple(chosen.effects.split(","))
        unknown = set(effects) - set(EFFECTS)
        if unknown:
            parser.error(f"no effects: {', '.join(sorted(unknown))}")
    family = TRAINING if chosen.train else chosen.family
    begin = time.perf_counter()
    answers = []
    for a in size_all(family, chosen.count, effects, chosen.steady, chosen.processes):
        answers.append(a)
        if chosen.each or a.wrong or not a.right:
            print(
                f"{a.number:4} {a.truth:6.2f}° taken for {a.extent:6.2f}° ± {a.uncertainty:.2f}°, "
                f"p {a.probability:.2f}, {a.scene}, left {a.unexplained:.2f}, chance "
                f"{a.chance:.2f}, repeats {a.repeating:.2f}, path {a.path}: "
                f"{'CONCLUSIVE AND WRONG' if a.wrong else a.status}",
                flush=True,
            )
    print(table(answers))
    each = (time.perf_counter() - begin) / max(1, len(answers))
    print(f"{each:.1f} s a signal; {pace()}")


if __name__ == "__main__":
    main()
