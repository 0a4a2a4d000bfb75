"""Which part is damaged: signals made without the project's model, diagnosed and counted.

    python -m tests.benchmarks.confusion

For each part 400 signals at 0 to 40 dB, and 1000 healthy ones, drawn by seed with
`tests.bearingcore.diagnosis.signals_made`: any bearing, speed and sample rate, knocks that slip and
wander, resonances, load zones, coloured noise, shaft lines, gear meshes, tones on and beside the
lines. Prints the confusion matrix, by noise too, and how far the stated probability holds.
"""

from concurrent.futures import ProcessPoolExecutor
from typing import NamedTuple

import numpy as np
import pandas as pd

from bearingcore import diagnose
from bearingcore.diagnosis.part.evidence import CANNOT_TELL, NONE_SEEN
from tests.bearingcore.diagnosis.signals_made import HEALTHY, PARTS, draw_signal

SCORED = 2031
SIGNALS = {**dict.fromkeys(PARTS, 400), HEALTHY: 1000}
NOISE = (0.0, 40.0)
STATED = (0.0, 0.8, 0.9, 0.95, 0.985, 1.001)


class Case(NamedTuple):
    """One signal and its answer."""

    truth: str
    decibels: float
    fault: str
    probability: float


def run(kind: str, number: int) -> Case:
    """Draw and diagnose signal `number` of a kind."""
    rng = np.random.default_rng([SCORED, list(SIGNALS).index(kind), number])
    decibels = float(rng.uniform(*NOISE))
    machine, recording = draw_signal(kind, rng, decibels)
    found = diagnose(recording, machine.bearing, machine.shaft_speed * rng.uniform(0.998, 1.002))
    return Case(kind, decibels, found.fault, found.probability)


def worth(cases: pd.DataFrame) -> pd.Series:
    """How many signals, and shares of what was said of them."""
    named = ~cases.fault.isin([CANNOT_TELL, NONE_SEEN])
    truth = cases.truth.replace(HEALTHY, NONE_SEEN)
    return pd.Series({
        "signals": len(cases),
        "stated": cases.probability.mean(),
        "right": (cases.fault == truth).mean(),
        "wrong part": (named & (cases.fault != truth)).mean(),
        "not seen": ((cases.fault == NONE_SEEN) & (truth != NONE_SEEN)).mean(),
    })  # fmt: skip


def main() -> None:
    found: list[Case] = []
    with ProcessPoolExecutor(2) as pool:
        for kind, count in SIGNALS.items():
            found += pool.map(run, [kind] * count, range(count), chunksize=8)
    cases = pd.DataFrame(found)
    print(pd.crosstab(cases.truth, cases.fault, margins=True))
    damaged, told = cases[cases.truth != HEALTHY], cases[cases.fault != CANNOT_TELL]
    for title, group, by, limits in (
        ("noise [dB] of damaged bearings", damaged, "decibels", range(0, 41, 10)),
        ("probability, of answers that name a part or none", told, "probability", STATED),
    ):
        classes = pd.cut(group[by], limits, right=False)
        shares = group.groupby(classes, observed=True)[list(cases.columns)].apply(worth)
        print(f"\n{title}\n{shares.round(3).to_string()}")
    accused = cases[cases.truth == HEALTHY].fault.isin(PARTS)
    print(f"\nfalse alarms: {accused.sum()} of {len(accused)} healthy ({accused.mean():.2%})")


if __name__ == "__main__":
    main()
