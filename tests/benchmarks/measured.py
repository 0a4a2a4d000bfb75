"""Which part is damaged, and how large the defect is, on records of real machines.

    python -m tests.benchmarks.measured DIR [--sizes] [--by-hand]
    python -m tests.benchmarks.measured DIR --extents
    python -m tests.benchmarks.measured DIR --scoreboard
    python -m tests.benchmarks.measured DIR --other-bearings

DIR holds records and perhaps a table of what is true of them (see `measured_records`). For each
record and in sum: right, cannot tell, wrong. A conclusive answer that is wrong makes the command
fail. --sizes runs the sizing too, over several plausible supports and loads; with --by-hand it is
told that the outer race is damaged.
--extents measures spalls from entry to exit, the race being known, and nothing else; an interval
that the truth is not in makes it fail. --scoreboard writes every answer, with what came of it, into
the file that the page and the documents take their numbers from (see `scoreboard`).
--other-bearings judges each record with bearings that are not the machine's; a wrong part that is
named with 90 % or more makes it fail.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from bearingcore import (
    Bearing,
    Load,
    Scene,
    Sizing,
    Support,
    diagnose,
    measure_extent,
    presets,
    size_defect,
)
from bearingcore.diagnosis.part.evidence import LIKELY
from bearingcore.diagnosis.part.parts import INNER, OUTER, PARTS, part_lines
from bearingcore.diagnosis.size.answer import AT_MOST
from tests.benchmarks.machine import pace
from tests.benchmarks.measured_records import HEALTHY, UNKNOWN, Record, records
from tests.benchmarks.scoreboard import (
    CANNOT,
    RIGHT,
    UNCHECKED,
    WRONG,
    extent_verdict,
    verdict,
    write,
)

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


class Sized(NamedTuple):
    """One run of the sizing."""

    support: str
    extent_deg: float
    uncertainty_deg: float
    conclusive: bool
    verdict: str
    status: str


def sizes(record: Record, by_hand: bool = False) -> Iterator[Sized]:
    """The extent of the defect by several supports and loads, held against the truth.

    Whatever is conclusive, or a bound, where no outer-race defect is, or away from its known
    extent, is wrong (see `size_verdict`). `by_hand` says that the outer race is damaged, whatever
    the diagnosis says.
    """
    for inner, outer, stiffness, damping in SUPPORTS:
        for load in LOADS:
            support = Support(inner, outer, stiffness, stiffness, damping, damping)
            scene = Scene(
                bearing=record.bearing,
                defect=presets["fan-rig"].replace(depth=100e-6).defect,
                load=Load(fy=-load),
                shaft_speed=record.shaft_speed,
                support=support,
                dofs=("x", "y"),
            )
            told = f"{inner:g}/{outer:g} kg, {stiffness:g} N/m, {load:g} N"
            try:
                found = size_defect(record.recording, scene, fault=OUTER if by_hand else None)
            except ValueError as refused:
                yield Sized(told, math.nan, math.nan, False, CANNOT, str(refused))
                continue
            if not found.candidates:
                yield Sized(told, math.nan, math.nan, False, CANNOT, found.sentence)
                continue
            extent = math.degrees(found.best.extent)
            spread = math.degrees(found.extent_uncertainty)
            yield Sized(
                told, extent, spread, found.conclusive, size_verdict(record, found), found.sentence
            )


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


def _diagnosed(found: list[Record]) -> Counter[tuple[str, str]]:
    counts: Counter[tuple[str, str]] = Counter()
    heading = f"{'record':<48} {'truth':<11} {'answer':<12} {'p':>5} {'result':<12}"
    print(f"{heading} {'level':>6} {'noise':>6} {'swing':>6} {'time':>6}")
    for record in found:
        begin = time.perf_counter()
        answer = diagnose(record.recording, record.bearing, record.shaft_speed)
        took = time.perf_counter() - begin
        result = verdict(record, answer)
        counts[record.truth, result] += 1
        best = max(answer.evidence, key=lambda one: one.level, default=None)
        numbers = f"{best.level:6.1f} {best.noise:6.1f} {best.depth:6.1%}" if best else f"{'':20}"
        print(
            f"{record.name[-48:]:<48} {record.truth:<11} {answer.fault:<12} "
            f"{answer.probability:5.2f} {result:<12} {numbers} {took:5.2f}s"
        )
        if result != RIGHT:
            print(f"    {answer.status}: {answer.sentence}")
    return counts


def _sum_up(counts: Counter[tuple[str, str]]) -> int:
    print(f"\n{'truth':<12}{RIGHT:>12}{CANNOT:>14}{WRONG:>8}")
    for truth in (*PARTS, HEALTHY, UNKNOWN):
        row = [counts[truth, result] for result in (RIGHT, CANNOT, WRONG)]
        if sum(row):
            print(f"{truth:<12}{row[0]:12d}{row[1]:14d}{row[2]:8d}")
    damaged = sum(n for (truth, _), n in counts.items() if truth in PARTS)
    named = sum(n for (truth, result), n in counts.items() if truth in PARTS and result == RIGHT)
    wrong = sum(n for (_, result), n in counts.items() if result == WRONG)
    print(f"\nright part named: {named} of {damaged}; conclusive and wrong: {wrong}; {pace()}")
    return wrong


def _other_bearings(found: list[Record]) -> int:
    """Parts named with bearings that are not the machine's; how many are surely wrong."""
    wrong = 0
    print(f"{'bearing':<12}{'judged':>8}{'named':>8}{'>= 90 %':>9}{'of these wrong':>16}")
    for name in OTHERS:
        counts: Counter[str] = Counter()
        bearing = presets[name].bearing
        for record in found:
            if _has_lines_of(bearing, record.bearing):
                continue
            answer = diagnose(record.recording, bearing, record.shaft_speed)
            sure = answer.names_a_part and answer.probability >= LIKELY
            counts["judged"] += 1
            counts["named"] += answer.names_a_part
            counts["sure"] += sure
            counts["wrong"] += sure and verdict(record, answer) == WRONG
            if sure:
                print(f"    {record.name[-40:]:<40} {record.truth:<11} {answer.sentence}")
        print(
            f"{name:<12}{counts['judged']:8d}{counts['named']:8d}{counts['sure']:9d}"
            f"{counts['wrong']:16d}"
        )
        wrong += counts["wrong"]
    return wrong


def _has_lines_of(bearing: Bearing, other: Bearing) -> bool:
    pairs = zip(part_lines(bearing), part_lines(other), strict=True)
    return all(abs(one.order / two.order - 1.0) < 0.01 for one, two in pairs)


def _extents(found: list[Record]) -> int:
    """Extents from entry to exit held against the truth; how many are wrong."""
    counts: Counter[str] = Counter()
    print(f"{'record':<42} {'true':>6} {'extent':>7} {'interval':>13} {'apart':>6} {'time':>6}")
    for record in found:
        if record.truth not in (OUTER, INNER):
            continue
        begin = time.perf_counter()
        answer = measure_extent(
            record.recording, record.bearing, record.shaft_speed, race=record.truth.split()[0]
        )
        took = time.perf_counter() - begin
        result = extent_verdict(record, answer)
        counts[result] += 1
        true = math.nan if record.spall_extent_deg is None else record.spall_extent_deg
        apart, extent, low, high = (
            math.degrees(value)
            for value in (answer.separation, answer.extent, answer.low, answer.high)
        )
        interval = f"{low:.2f}-{high:.2f}" if answer.measured else ""
        print(
            f"{record.name[-42:]:<42} {true:6.2f} {extent:7.2f} {interval:>13} {apart:6.2f} "
            f"{took:5.1f}s {result}: {answer.status}"
        )
    print(f"\nextents: {dict(counts)}")
    return counts[WRONG]


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--sizes", action="store_true")
    parser.add_argument("--by-hand", action="store_true", help="size as if the outer race were")
    parser.add_argument("--scoreboard", action="store_true", help="write assets/scoreboard.json")
    parser.add_argument("--other-bearings", action="store_true", help="not the machine's own")
    parser.add_argument("--extents", action="store_true", help="from entry to exit")
    chosen = parser.parse_args()
    found = list(records(chosen.folder))
    if not found:
        print(f"no records in {chosen.folder}", file=sys.stderr)
        return 2
    if chosen.scoreboard:
        return write(found)
    if chosen.other_bearings:
        return 1 if _other_bearings(found) else 0
    if chosen.extents:
        return 1 if _extents(found) else 0
    wrong = _sum_up(_diagnosed(found))
    if chosen.sizes:
        counts: Counter[str] = Counter()
        for record in found:
            for one in sizes(record, chosen.by_hand):
                counts[one.verdict] += 1
                print(
                    f"{record.name[-40:]:<40} {one.support:<34} {one.extent_deg:6.1f}° "
                    f"± {one.uncertainty_deg:.1f}° {one.verdict}: {one.status[:90]}"
                )
        print(f"\nsizes: {dict(counts)}; conclusive and wrong: {counts[WRONG]}")
        wrong += counts[WRONG]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
