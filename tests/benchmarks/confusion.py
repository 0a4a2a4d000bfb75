"""Which part is damaged: signals made without the project's model, diagnosed and counted.

    python -m tests.benchmarks.confusion [--signals 400] [--healthy 1000] [--family 2031]

For each part so many signals at 0 to 40 dB, and healthy ones, drawn by seed with
`tests.bearingcore.diagnosis.signals_made`: any bearing, speed and sample rate, knocks that slip and
wander, resonances, load zones, coloured noise, shaft lines, gear meshes, tones on and beside the
lines. Prints the confusion matrix, by noise too, and how far the stated probability holds.
"""

from __future__ import annotations

import argparse
import os
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from bearingcore import diagnose
from bearingcore.diagnosis.part.evidence import CANNOT_TELL, FAULTS, NONE_SEEN
from tests.bearingcore.diagnosis.signals_made import HEALTHY, PARTS, draw_signal

SCORED = 2031
NOISE = (0.0, 40.0)


class Case(NamedTuple):
    """One signal and its answer."""

    truth: str
    decibels: float
    fault: str
    probability: float


def run(kind: str, family: int, number: int) -> Case:
    """Draw and diagnose signal `number` of a kind."""
    kinds = (*PARTS, HEALTHY)
    rng = np.random.default_rng([family, kinds.index(kind), number])
    decibels = float(rng.uniform(*NOISE))
    machine, recording = draw_signal(kind, rng, decibels)
    found = diagnose(recording, machine.bearing, machine.shaft_speed * rng.uniform(0.998, 1.002))
    return Case(kind, decibels, found.fault, found.probability)


def table(cases: Sequence[Case]) -> str:
    """The confusion matrix."""
    lines = [f"{'truth':<12}" + "".join(f"{fault:>13}" for fault in FAULTS) + f"{'signals':>10}"]
    for kind in (*PARTS, HEALTHY):
        of_kind = Counter(case.fault for case in cases if case.truth == kind)
        total = sum(of_kind.values())
        if total:
            cells = "".join(f"{of_kind[fault]:13d}" for fault in FAULTS)
            lines.append(f"{kind:<12}{cells}{total:10d}")
    return "\n".join(lines)


def _share(cases: Sequence[Case]) -> str:
    right = sum(case.fault == case.truth for case in cases)
    wrong = sum(case.fault not in (case.truth, CANNOT_TELL, NONE_SEEN) for case in cases)
    missed = sum(case.fault == NONE_SEEN for case in cases)
    return f"{len(cases):5d} signals  {right:5d} right  {wrong:3d} wrong part  {missed:3d} not seen"


def calibration(cases: Sequence[Case]) -> str:
    """What the stated probabilities were worth, for answers that name a part or none."""
    told = [case for case in cases if case.fault != CANNOT_TELL]
    lines = []
    for low, high in ((0.0, 0.8), (0.8, 0.9), (0.9, 0.95), (0.95, 0.985), (0.985, 1.0)):
        inside = [case for case in told if low <= case.probability < high]
        if inside:
            stated = np.mean([case.probability for case in inside])
            right = np.mean([
                case.fault == (NONE_SEEN if case.truth == HEALTHY else case.truth)
                for case in inside
            ])  # fmt: skip
            lines.append(f"stated {stated:.3f}  right {right:.3f}  of {len(inside)}")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--signals", type=int, default=400)
    parser.add_argument("--healthy", type=int, default=1000)
    parser.add_argument("--family", type=int, default=SCORED)
    parser.add_argument("--processes", type=int, default=min(2, os.cpu_count() or 1))
    chosen = parser.parse_args()
    cases: list[Case] = []
    with ProcessPoolExecutor(chosen.processes) as pool:
        for kind in (*PARTS, HEALTHY):
            count = chosen.healthy if kind == HEALTHY else chosen.signals
            cases += pool.map(partial(run, kind, chosen.family), range(count), chunksize=8)
    print(table(cases), "\n")
    for low in range(0, 40, 10):
        inside = [c for c in cases if c.truth != HEALTHY and low <= c.decibels < low + 10]
        print(f"{low:2d} to {low + 10} dB:", _share(inside))
    healthy = [case for case in cases if case.truth == HEALTHY]
    accused = sum(case.fault in PARTS for case in healthy)
    print(f"\nfalse alarms: {accused} of {len(healthy)} healthy ({accused / len(healthy):.2%})\n")
    print(calibration(cases))


if __name__ == "__main__":
    main()
