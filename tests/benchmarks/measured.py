"""Which part is damaged, and how large the defect is, on records of real machines.

    python -m tests.benchmarks.measured DIR [--scoreboard]
    python -m tests.benchmarks.measured DIR --sizes
    python -m tests.benchmarks.measured DIR --other-bearings

DIR holds records of the collections of `measured_records`. For each record and in sum: right,
cannot tell, wrong; --scoreboard writes every answer, with what came of it, into the file that the
page and the documents take their numbers from (see `scoreboard`). --sizes runs the sizing, over
several plausible supports and loads, the outer race being named by hand. --other-bearings judges
each record with bearings that are not the machine's. What is conclusive and wrong, a part that is
not the machine's from 90 % on, makes the command fail.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from pathlib import Path

import pandas as pd

from bearingcore import Bearing, Load, Scene, Sizing, Support, diagnose, presets, size_defect
from bearingcore.diagnosis.part.evidence import LIKELY
from bearingcore.diagnosis.part.parts import OUTER, part_lines
from bearingcore.diagnosis.size.answer import AT_MOST
from tests.benchmarks.machine import pace
from tests.benchmarks.measured_records import Record, records
from tests.benchmarks.scoreboard import CANNOT, RIGHT, UNCHECKED, WRONG, judge, verdict

SUPPORTS = tuple(
    (inner, outer, stiffness, damping)
    for inner, outer in ((2.0, 5.0), (5.0, 20.0))
    for stiffness, damping in ((1e8, 5e3), (3e8, 1e4))
)
"""Masses [kg], stiffness [N/m] and damping [N·s/m] that a small motor or rig may have."""

LOADS = (100.0, 400.0)
"""[N]"""

OTHERS = ("fan-rig", "liew-lim", "6203", "6205", "seven-ball", "3208")
"""Presets with which records of other machines are judged."""


def sizes(found: list[Record]) -> int:
    """Print extents by several supports and loads; how many are wrong (see `size_verdict`)."""
    counts: Counter[str] = Counter()
    for record in found:
        for inner, outer, stiffness, damping in SUPPORTS:
            for load in LOADS:
                scene = Scene(
                    bearing=record.bearing,
                    defect=presets["fan-rig"].replace(depth=100e-6).defect,
                    load=Load(fy=-load),
                    shaft_speed=record.shaft_speed,
                    support=Support(inner, outer, stiffness, stiffness, damping, damping),
                    dofs=("x", "y"),
                )
                result, said = sized(record, scene)
                counts[result] += 1
                print(
                    f"{record.name[-40:]:<40} {inner:g}/{outer:g} kg, {stiffness:g} N/m, "
                    f"{load:g} N: {result}: {said[:120]}",
                    flush=True,
                )
    print(f"\nsizes: {dict(counts)}; conclusive and wrong: {counts[WRONG]}; {pace()}")
    return counts[WRONG]


def sized(record: Record, scene: Scene) -> tuple[str, str]:
    """Whether the size of a record is right by a scene, and what is said of it."""
    try:
        found = size_defect(record.recording, scene, fault=OUTER)
    except ValueError as refused:
        return CANNOT, str(refused)
    if not found.candidates:
        return CANNOT, found.sentence
    return size_verdict(record, found), found.sentence


def size_verdict(record: Record, found: Sizing) -> str:
    """Whether what is said of a size is right; nobody may know where it is not published."""
    if not (found.conclusive or found.bound):
        return CANNOT
    if record.truth != OUTER:
        return WRONG
    truth = record.outer_extent_deg
    if truth is None:
        return UNCHECKED
    if found.bound == AT_MOST:
        return RIGHT if math.degrees(found.end(found.bound)) >= truth else WRONG
    away = abs(math.degrees(found.best.extent) - truth)
    near = away <= max(1.0, 2.0 * math.degrees(found.extent_uncertainty))
    return RIGHT if near and not found.bound else WRONG


def other_bearings(found: list[Record]) -> int:
    """Parts named with bearings that are not the machine's; how many are surely wrong."""
    table: dict[str, Counter[str]] = {}
    for name in OTHERS:
        counts = table[name] = Counter()
        bearing = presets[name].bearing
        for record in found:
            if _has_lines_of(bearing, record.bearing):
                continue
            answer = diagnose(record.recording, bearing, record.shaft_speed)
            sure = answer.names_a_part and answer.probability >= LIKELY
            counts["judged"] += 1
            counts["named"] += answer.names_a_part
            counts[">= 90 %"] += sure
            counts["of these wrong"] += sure and verdict(record, answer) == WRONG
            if sure:
                print(f"    {record.name[-40:]:<40} {record.truth:<11} {answer.sentence}")
    print(pd.DataFrame(table).T.to_string())
    return sum(counts["of these wrong"] for counts in table.values())


def _has_lines_of(bearing: Bearing, other: Bearing) -> bool:
    pairs = zip(part_lines(bearing), part_lines(other), strict=True)
    return all(abs(one.order / two.order - 1.0) < 0.01 for one, two in pairs)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--scoreboard", action="store_true", help="write assets/scoreboard.json")
    parser.add_argument("--sizes", action="store_true", help="of the outer race")
    parser.add_argument("--other-bearings", action="store_true", help="not the machine's own")
    chosen = parser.parse_args()
    found = list(records(chosen.folder))
    if not found:
        print(f"no records in {chosen.folder}", file=sys.stderr)
        return 2
    if chosen.sizes:
        return int(sizes(found) > 0)
    if chosen.other_bearings:
        return int(other_bearings(found) > 0)
    return int(judge(found, chosen.scoreboard) > 0)


if __name__ == "__main__":
    sys.exit(main())
