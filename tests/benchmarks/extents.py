"""Extents measured from entry to exit on simulated signals behind paths that ring.

    python -m tests.benchmarks.extents [--count 60] [--first 0] [--load]

Scenes are drawn by seed: balls with mass on the fan rig, both races, three edge models, extents of
1-30°, 6-20 Hz, 80-400 N. --load gives the load to the method. An interval or a bound holds where
the truth lies inside it, whole ball spacings more or less.
"""

from __future__ import annotations

import argparse
import math
from collections import Counter

import numpy as np

from bearingcore import measure_extent, presets
from bearingcore.scene.scene import Scene
from tests.helpers.path_effects import PathEffects, drawn_resonances, recorded_through

SEED = 777


def draw(number: int) -> tuple[Scene, PathEffects]:
    """A scene, and the path to its sensor."""
    rng = np.random.default_rng([SEED, number])
    race = ("outer", "inner")[number % 2]
    edge = ("exact", "chord", "published")[number // 2 % 3]
    scene = presets["fan-rig"].replace(
        extent=math.radians(rng.uniform(1.0, 30.0)),
        fy=-math.exp(rng.uniform(math.log(80.0), math.log(400.0))),
        shaft_speed=2.0 * math.pi * rng.uniform(6.0, 20.0),
        race=race,
        edge=edge,
        balls="with mass",
    )
    return scene, PathEffects(resonances=drawn_resonances(rng))


def judge(number: int, with_load: bool) -> str:
    """Measure one signal, print a line where there is an extent, and return the outcome."""
    scene, effects = draw(number)
    truth = scene.defects[0].extent
    found = measure_extent(
        recorded_through(scene, effects, seed=number),
        scene.bearing,
        scene.shaft_speed,
        race=scene.defects[0].race,
        load=-scene.load.fy if with_load else None,
    )
    if not math.isfinite(found.high):
        return str(found.status)
    spacing = scene.bearing.ball_spacing
    turns = spacing * np.arange(-2, 3)
    if found.measured:
        holds = ((found.low <= truth + turns) & (truth + turns <= found.high)).any()
    else:
        holds = (np.abs(truth + turns) <= found.high).any()
    kind = "interval" if found.measured else "bound"
    outcome = f"{kind} holds" if holds else f"{kind} does not hold"
    print(f"{number:4} {math.degrees(truth):6.2f}° {found.sentence} {outcome}", flush=True)
    return outcome


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--load", action="store_true")
    chosen = parser.parse_args()
    numbers = range(chosen.first, chosen.first + chosen.count)
    print(dict(Counter(judge(number, chosen.load) for number in numbers)))


if __name__ == "__main__":
    main()
