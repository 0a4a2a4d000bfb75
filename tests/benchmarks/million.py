"""Solve a great many scenes out of the whole box, judge every answer, and print what came of it.

    python -m tests.benchmarks.million [--scenes 1000000] [--seed 1] [--processes 2]

Every scene is solved at four cage angles in order. Each answer is judged in extended precision by
`helpers.judge`, which shares no code with the solver: a converged state must balance, be held
in every direction and have the right symmetric, positive semidefinite stiffness; a reason given
instead must be true. Points of the box where an answer is wrong or missing are printed, and the
exit code is then 1.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field

import numpy as np

from bearingcore import DOF_NAMES, equilibrium, kernels, warm
from tests.benchmarks.machine import pace
from tests.helpers.box import Point, cage_angles_at, draw, scene_at
from tests.helpers.judge import verdict

CHUNK = 2000
NAMES = {
    kernels.CONVERGED: "converged",
    kernels.NOTHING_TOUCHES: "nothing touches",
    kernels.FREE_DIRECTION: "free",
    kernels.NOT_CARRIED: "not carried",
    kernels.NOT_CONVERGED: "NOT CONVERGED",
}


@dataclass
class Tally:
    """What came of some scenes."""

    scenes: int = 0
    statuses: Counter[int] = field(default_factory=Counter)
    wrong: list[tuple[Point, int, str]] = field(default_factory=list)
    worst_residual: float = 0.0
    worst_asymmetry: float = 0.0
    least_eigenvalue: float = math.inf
    """over the greatest, of all five directions, tilts as lengths; below 0 is rounding"""
    least_held: float = math.inf
    """the same among the active directions of converged states"""
    most_iterations: int = 0
    solving: float = 0.0
    """[s] spent in the solver, over all processes"""

    def add(self, other: Tally) -> None:
        """Take in what came of other scenes."""
        self.scenes += other.scenes
        self.statuses += other.statuses
        self.wrong += other.wrong
        self.worst_residual = max(self.worst_residual, other.worst_residual)
        self.worst_asymmetry = max(self.worst_asymmetry, other.worst_asymmetry)
        self.least_eigenvalue = min(self.least_eigenvalue, other.least_eigenvalue)
        self.least_held = min(self.least_held, other.least_held)
        self.most_iterations = max(self.most_iterations, other.most_iterations)
        self.solving += other.solving


def solve_chunk(seed: int, chunk: int, n: int) -> Tally:
    """Draw, solve and judge n scenes; the same numbers give the same scenes."""
    points = draw(np.random.default_rng([seed, chunk]), n)
    tally = Tally(scenes=n)
    for k in range(n):
        point = points.point(k)
        scene, angles = scene_at(point), cage_angles_at(point)
        begin = time.perf_counter()
        answer = equilibrium(scene, angles)
        tally.solving += time.perf_counter() - begin
        tally.statuses.update(answer.status.tolist())
        tally.most_iterations = max(tally.most_iterations, int(answer.iterations.max()))
        for i in range(len(angles)):
            wrong = verdict(answer, i)
            if wrong:
                tally.wrong.append((point, i, wrong))
        good = answer.converged
        if not good.any():
            continue
        tally.worst_residual = max(tally.worst_residual, float(answer.residual[good].max()))
        K = answer.stiffness[good]
        asymmetry = np.abs(K - np.swapaxes(K, 1, 2)).max() / np.abs(K).max()
        tally.worst_asymmetry = max(tally.worst_asymmetry, float(asymmetry))
        units = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
        K = K / (units[:, None] * units)
        active = [DOF_NAMES.index(name) for name in answer.dofs]
        values = np.linalg.eigvalsh(K)
        tally.least_eigenvalue = min(
            tally.least_eigenvalue, float((values[:, 0] / values[:, -1]).min())
        )
        held = np.linalg.eigvalsh(K[:, active][:, :, active])
        tally.least_held = min(tally.least_held, float((held[:, 0] / values[:, -1]).min()))
    return tally


def report(tally: Tally, elapsed: float, processes: int) -> None:
    """Print the table."""
    angles = sum(tally.statuses.values())
    print(f"{tally.scenes:,} scenes, {angles:,} cage angles")
    for code, name in NAMES.items():
        count = tally.statuses[code]
        print(f"  {name:<16} {count:>12,}  {100.0 * count / angles:9.4f} %")
    print(f"  {'wrong or untrue':<16} {len(tally.wrong):>12,}")
    print(f"worst relative residual of converged states          {tally.worst_residual:.1e}")
    print(f"worst asymmetry of K                                 {tally.worst_asymmetry:.1e}")
    print(f"least over greatest eigenvalue, all five directions  {tally.least_eigenvalue:.1e}")
    print(f"the same among the free directions                   {tally.least_held:.1e}")
    print(f"most Newton steps                                    {tally.most_iterations}")
    print(
        f"{tally.scenes / elapsed:,.0f} scenes/s on {processes} processes with the judging, "
        f"{tally.scenes / tally.solving:,.0f} scenes/s of a process in the solver; {elapsed:.0f} s"
    )
    machine = pace()
    print(f"a scene {machine.ratio(tally.solving / tally.scenes)} in the solver; {machine}")


def main() -> int:
    """Run, and report."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--show", type=int, default=10, help="wrong answers to print in full")
    wanted = parser.parse_args()
    warm(lambda _: None)
    sizes = [CHUNK] * (wanted.scenes // CHUNK)
    if wanted.scenes % CHUNK:
        sizes.append(wanted.scenes % CHUNK)
    total = Tally()
    begin = time.perf_counter()
    with ProcessPoolExecutor(wanted.processes) as pool:
        jobs = [pool.submit(solve_chunk, wanted.seed, k, n) for k, n in enumerate(sizes)]
        for job in as_completed(jobs):
            part = job.result()
            shown = max(wanted.show - len(total.wrong), 0)
            for point, i, wrong in part.wrong[:shown]:
                print(f"\nat cage angle {i} of {point}:\n    {wrong}", flush=True)
            total.add(part)
            rate = total.scenes / (time.perf_counter() - begin)
            print(
                f"\r{total.scenes:,} of {wanted.scenes:,}, {rate:,.0f} scenes/s, "
                f"{len(total.wrong)} wrong",
                end="",
                file=sys.stderr,
                flush=True,
            )
    print(file=sys.stderr)
    report(total, time.perf_counter() - begin, wanted.processes)
    return 1 if total.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
