"""Which part is damaged, on records of real machines.

    python -m tests.benchmarks.measured DIR [--scoreboard]
    python -m tests.benchmarks.measured DIR --other-bearings

DIR holds records of the collections of `measured_records`. For each record and in sum: right,
cannot tell, wrong; --scoreboard writes every answer, with what came of it, into the file that the
page and the documents take their numbers from (see `scoreboard`). --other-bearings judges each
record with bearings that are not the machine's. What is conclusive and wrong, a part that is
not the machine's from 90 % on, makes the command fail.
"""

import argparse
import sys
from collections import Counter
from pathlib import Path

import pandas as pd

from bearingcore import Bearing, diagnose, presets
from bearingcore.measured.diagnosis import LIKELY, part_lines
from tests.benchmarks.measured_records import Record, records
from tests.benchmarks.scoreboard import WRONG, judge, verdict

OTHERS = ("fan-rig", "liew-lim", "6203", "6205", "seven-ball", "3208")
"""Presets with which records of other machines are judged."""


def other_bearings(records: list[Record]) -> int:
    """Parts named with bearings that are not the machine's; how many are surely wrong."""
    table: dict[str, Counter[str]] = {}
    for name in OTHERS:
        counts = table[name] = Counter()
        bearing = presets[name].bearing
        for record in records:
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
    parser.add_argument("--other-bearings", action="store_true", help="not the machine's own")
    chosen = parser.parse_args()
    all_records = list(records(chosen.folder))
    if not all_records:
        print(f"no records in {chosen.folder}", file=sys.stderr)
        return 2
    if chosen.other_bearings:
        return int(other_bearings(all_records) > 0)
    return int(judge(all_records, chosen.scoreboard) > 0)


if __name__ == "__main__":
    sys.exit(main())
