"""Solve a great many scenes out of the whole box, judge every answer, and print what came of it.

    python -m tests.benchmarks.million [--scenes 1000000] [--seed 1]

Every scene is solved at four cage angles in order. Each answer is judged in extended precision by
`helpers.judge`, which shares no code with the solver: a converged state must balance, be held
in every direction and have the right symmetric, positive semidefinite stiffness; a reason given
instead must be true. Points of the box where an answer is wrong or missing are printed, and the
exit code is then 1.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

import numpy as np
from tqdm import tqdm

from bearingcore import equilibrium, kernels, warm
from tests.benchmarks.machine import pace
from tests.helpers.box import Point, cage_angles_at, draw, scene_at
from tests.helpers.judge import verdict

CHUNK = 2000
NAMES = {
    kernels.CONVERGED: "converged",
    kernels.NOTHING_TOUCHES: "nothing touches",
    kernels.FREE_DIRECTION: "free",
    kernels.NOT_CARRIED: "not carried",
    kernels.BEYOND: "beyond the geometry",
    kernels.NOT_CONVERGED: "NOT CONVERGED",
}


@dataclass
class Tally:
    """What came of some scenes."""

    scenes: int = 0
    statuses: Counter[int] = field(default_factory=Counter)
    wrong: list[tuple[Point, int, str]] = field(default_factory=list)
    residual: float = 0.0
    """the worst of converged states, relative"""
    solving: float = 0.0
    """[s] spent in the solver, over all processes"""

    def add(self, other: Tally) -> None:
        """Take in what came of other scenes."""
        self.scenes += other.scenes
        self.statuses += other.statuses
        self.wrong += other.wrong
        self.residual = max(self.residual, other.residual)
        self.solving += other.solving


def solve_chunk(seed: int, chunk: int, n: int) -> Tally:
    """Draw, solve and judge n scenes; the same numbers give the same scenes."""
    tally = Tally(scenes=n)
    for point in draw(np.random.default_rng([seed, chunk]), n):
        scene, angles = scene_at(point), cage_angles_at(point)
        begin = time.perf_counter()
        answer = equilibrium(scene, angles)
        tally.solving += time.perf_counter() - begin
        tally.statuses.update(answer.status.tolist())
        verdicts = [(point, i, verdict(answer, i)) for i in range(len(angles))]
        tally.wrong += [one for one in verdicts if one[2]]
        residual = answer.residual[answer.converged].max(initial=0.0)
        tally.residual = max(tally.residual, float(residual))
    return tally


def report(tally: Tally, elapsed: float) -> None:
    """Print the table."""
    angles = sum(tally.statuses.values())
    print(f"{tally.scenes:,} scenes, {angles:,} cage angles in {elapsed:.0f} s with the judging")
    for code, name in NAMES.items():
        count = tally.statuses[code]
        print(f"  {name:<16} {count:>12,}  {100.0 * count / angles:9.4f} %")
    print(f"  {'wrong or untrue':<16} {len(tally.wrong):>12,}")
    print(f"worst relative residual of converged states: {tally.residual:.1e}")
    machine = pace()
    print(f"a scene {machine.ratio(tally.solving / tally.scenes)} in the solver; {machine}")


def main() -> int:
    """Run, and report."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    wanted = parser.parse_args()
    warm(lambda _: None)
    sizes = [min(CHUNK, wanted.scenes - first) for first in range(0, wanted.scenes, CHUNK)]
    total = Tally()
    begin = time.perf_counter()
    with ProcessPoolExecutor(2) as pool:
        seeds = [wanted.seed] * len(sizes)
        parts = pool.map(solve_chunk, seeds, range(len(sizes)), sizes)
        for part in tqdm(parts, total=len(sizes), unit="chunk"):
            for point, i, wrong in part.wrong:
                tqdm.write(f"at cage angle {i} of {point}:\n    {wrong}")
            total.add(part)
    report(total, time.perf_counter() - begin)
    return 1 if total.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
