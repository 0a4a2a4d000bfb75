"""Random pairs, unlike rows, self-aligning and roller bearings: is each equilibrium right?

    python -m tests.benchmarks.random_rows --scenes 200000

Of each kind as many. Every answer is converged, with a residual of 1e-9, a symmetric stiffness
without negative eigenvalues that is the slope of the loads, and a convex energy about it, or has a
reason; `tests.helpers.random_rows` judges. Prints how many of each there were, and each fault.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter

import numpy as np

from bearingcore import kernels
from tests.benchmarks.machine import pace
from tests.helpers.random_rows import KINDS, judged


def main() -> int:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    outcomes: Counter[tuple[str, str]] = Counter()
    wrong = 0
    begin = time.perf_counter()
    for number in range(arguments.scenes):
        kind = KINDS[number % len(KINDS)]
        _, found, fault = judged(rng, kind)
        converged = found.status[0] == kernels.CONVERGED
        outcomes[kind, "converged" if converged else found.reason(0).split(":")[0][:60]] += 1
        if fault:
            wrong += 1
            print(f"scene {number}, {kind}: {fault}", flush=True)
    seconds = time.perf_counter() - begin
    print(f"{arguments.scenes} scenes in {seconds:.0f} s, {wrong} wrong; {pace()}")
    for (kind, outcome), count in sorted(outcomes.items()):
        print(f"{count:8d}  {kind:29s} {outcome}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
