"""The scoreboard: answers on records of real machines beside the truth, and what they are worth.

`judge` puts it into `assets/scoreboard.json`, from where the page, README and DIAGNOSIS.md take
their numbers (`tables`; a test holds them together). What measured records have set, the
`Calibration`, was set with these records in sight; so each machine is judged once more with what
the other machines alone would have set.
"""

import json
import math
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from scipy.optimize import minimize
from scipy.stats import binomtest

from bearingcore import Diagnosis, MeasuredExtent, diagnose, measure_extent
from bearingcore.measured.diagnosis import (
    CANNOT_TELL,
    INNER,
    LIKELY,
    NONE_SEEN,
    OUTER,
    PARTS,
    PartEvidence,
)
from bearingcore.measured.diagnosis._part.decide import NAMED
from bearingcore.measured.diagnosis._part.parts import BALL
from bearingcore.measured.diagnosis._part.probability import LEAD, Calibration, probabilities
from tests.benchmarks.measured_records import GRADES, HEALTHY, UNKNOWN, Record

ASSETS = Path(__file__).parents[2] / "assets"
FILE = ASSETS / "scoreboard.json"
OTHERS_FILE = ASSETS / "scoreboard_other_machines.json"
"""Of machines that had no part in choosing anything."""

RIGHT, CANNOT, WRONG = "right", "cannot tell", "wrong"
MACHINES = ("CWRU 6203", "CWRU 6205", "FEMTO", "HIT-SM 6205", "MFPT")
"""Those whose records were in sight when the diagnosis was made."""

VERDICTS = (RIGHT, CANNOT, WRONG)
UNCHECKED = "size not published"

BINS = (0.5, 0.7, 0.9, 0.97, 1.0)
"""Stated probabilities between which answers are counted together."""

PRIOR = ((20.0 * math.log10(0.13), 3.0), (math.log(1.5), 0.4))
"""Expected values and deviations of the swing [dB] and of the logarithm of its scale: few records
set neither freely."""

LAPSE = 0.02
"""Share of records that no law of this kind describes."""

SHOWN = ("record", "truth", "answer", "probability", "verdict", "status")

Row = dict[str, Any]


def verdict(record: Record, diagnosis: Diagnosis) -> str:
    """Whether a diagnosis is right."""
    return _verdict(record.truth, diagnosis.fault)


def _verdict(truth: str, fault: str) -> str:
    if fault == CANNOT_TELL:
        return CANNOT
    if truth == UNKNOWN:  # damage, but nobody knows of what
        return WRONG if fault == NONE_SEEN else RIGHT
    return RIGHT if fault == (NONE_SEEN if truth == HEALTHY else truth) else WRONG


def extent_verdict(record: Record, extent: MeasuredExtent) -> str:
    """Whether an extent from entry to exit is right: the truth lies in its interval."""
    if not extent.measured:
        return CANNOT
    if record.spall_extent_deg is None:
        return UNCHECKED
    true = math.radians(record.spall_extent_deg)
    return RIGHT if extent.low <= true <= extent.high else WRONG


def row_of(record: Record) -> Row:
    """One record: its truth, the answer and what it rests on; angles in degrees."""
    diagnosis = diagnose(record.recording, record.bearing, record.shaft_speed)
    row: Row = {
        "record": record.name,
        "machine": record.machine,
        "grade": record.grade,
        "truth": record.truth,
        "answer": diagnosis.fault,
        "probability": round(diagnosis.probability, 3),
        "status": str(diagnosis.status),
        "verdict": verdict(record, diagnosis),
        "evidence": {
            part.part: {
                name: round(float(getattr(part, name)), 4)
                for name in ("lead", "swing", "deviations", "magnetic")
            }
            for part in diagnosis.evidence
        },
        "true_extent_deg": record.spall_extent_deg,
    }
    if diagnosis.fault in (OUTER, INNER):
        extent = measure_extent(record.recording, record.bearing, record.shaft_speed)
        row["extent_status"] = str(extent.status)
        row["extent_verdict"] = extent_verdict(record, extent)
        if extent.measured:
            degrees = np.degrees([extent.extent, extent.low, extent.high])
            row["extent_deg"], row["low_deg"], row["high_deg"] = degrees.round(2).tolist()
    return row


def fitted(rows: Iterable[Row]) -> Calibration:
    """What records set: whether a race's lines that are there are of its own damage, by swing."""
    pairs = [
        (20.0 * math.log10(one["swing"]), part == row["truth"])
        for row in rows
        if row["truth"] != UNKNOWN
        for part, one in row["evidence"].items()
        if part != BALL and one["lead"] >= LEAD
        # a race beside one that is named has a lead of another kind
        if part == row["answer"] or row["answer"] not in (OUTER, INNER)
    ]
    swing = np.array([pair[0] for pair in pairs])
    own = np.array([pair[1] for pair in pairs], dtype=float)
    middle, width = np.transpose(PRIOR)

    def loss(tried: np.ndarray) -> float:
        curve = 1.0 / (1.0 + np.exp(-(swing - tried[0]) / math.exp(tried[1])))
        share = 0.5 * LAPSE + (1.0 - LAPSE) * curve
        likelihood = own * np.log(share) + (1.0 - own) * np.log1p(-share)
        return float(-likelihood.sum() + 0.5 * (((tried - middle) / width) ** 2).sum())

    best = minimize(loss, middle, method="Nelder-Mead").x
    return Calibration(10.0 ** (best[0] / 20.0), math.exp(best[1]))


def left_out(rows: Sequence[Row]) -> None:
    """Add to each row the answer by what all machines but its own have set."""
    for machine in {row["machine"] for row in rows}:
        chosen = fitted(row for row in rows if row["machine"] != machine)
        for row in rows:
            if row["machine"] != machine:
                continue
            evidence = [SimpleNamespace(part=part, **one) for part, one in row["evidence"].items()]
            told = probabilities(cast("list[PartEvidence]", evidence), chosen)
            part = max(told, key=lambda name: told[name], default="")
            answer, probability = row["answer"], row["probability"]
            if part and told[part] >= NAMED:
                answer, probability = part, round(told[part], 3)
            elif answer in PARTS:
                answer = CANNOT_TELL
            row["left_out"] = {
                "answer": answer,
                "probability": probability,
                "verdict": _verdict(row["truth"], answer),
            }


def judge(records: Iterable[Record], write: bool) -> int:
    """Print every answer and the tables, or write them too; how many answers are wrong.

    Of the machines that had no part in choosing, each record has its answer alone.
    """
    rows = []
    for record in records:
        rows.append(row_of(record))
        print(" | ".join(str(rows[-1][name]) for name in SHOWN), flush=True)
    others = {row["machine"] for row in rows}.isdisjoint(MACHINES)
    if others:
        rows = [{name: row[name] for name in ("machine", *SHOWN)} for row in rows]
    else:
        left_out(rows)
        print(f"all machines together set {fitted(rows)}")
    if write:
        board = {"share_right": share_right(rows), "records": rows}
        text = json.dumps(board, indent=None if others else 1, ensure_ascii=False)
        text = text.replace('}, {"machine', '},\n{"machine')
        (OTHERS_FILE if others else FILE).write_text(text + "\n", encoding="utf-8")
    for words in (other_tables if others else tables)(rows).values():
        print(f"\n{words}")
    return sum(row["verdict"] == WRONG for row in rows)


def stated(rows: Iterable[Row]) -> tuple[int, int]:
    """How many answers were stated with LIKELY or more, and how many of them are right."""
    sure = [row for row in rows if row["verdict"] != CANNOT and row["probability"] >= LIKELY]
    return len(sure), sum(row["verdict"] == RIGHT for row in sure)


def alarms(rows: Iterable[Row]) -> int:
    """Count healthy records of which a part was named with LIKELY or more."""
    healthy = _of(rows, "truth", HEALTHY)
    return sum(row["answer"] in PARTS and row["probability"] >= LIKELY for row in healthy)


def reliability(rows: Sequence[Row]) -> str:
    """The table of stated probabilities of named parts beside the share that is right."""
    lines = ["| stated | named | right | share right | exact interval of 95 % |"]
    lines.append("| --- | ---: | ---: | ---: | ---: |")
    named = [row for row in rows if row["answer"] in PARTS and row["truth"] != UNKNOWN]
    for low, high in pairwise(BINS):
        inside = [r["verdict"] == RIGHT for r in named if low <= r["probability"] < high]
        if inside:
            ends = binomtest(sum(inside), len(inside)).proportion_ci(0.95, "exact")
            share, between = (
                100 * np.mean(inside),
                f"{100 * ends.low:.0f} to {100 * ends.high:.0f} %",
            )
            lines.append(
                f"| {100 * low:.0f} to {100 * high:.0f} % | {len(inside)} | {sum(inside)} "
                f"| {share:.0f} % | {between} |"
            )
    return "\n".join(lines)


def other_tables(rows: Sequence[Row]) -> dict[str, str]:
    """The tables and sentences on machines that had no part in choosing, by name."""
    count, right = stated(rows)
    low, high = (100.0 * end for end in share_right(rows))
    machines = sorted({row["machine"] for row in rows})
    lines = ["| machine | right | cannot tell | wrong | stated ≥ 90 %, right | healthy | alarms |"]
    lines.append("| --- |" + 6 * " ---: |")
    for name in machines:
        own = _of(rows, "machine", name)
        healthy = len(_of(own, "truth", HEALTHY))
        lines.append(f"| {name} | {_counted(own)} | {_sure(own)} | {healthy} | {alarms(own)} |")
    return {
        "other machines": "\n".join(lines),
        "other machines reliability": reliability(rows),
        "other machines sure": f"Of {count} answers stated with 90 % or more, {right} are right: "
        f"{low:.1f} to {high:.1f} % (exact two-sided 95 % interval). Of "
        f"{len(_of(rows, 'truth', HEALTHY))} healthy records {alarms(rows)} raised an alarm.",
    }


def share_right(rows: Iterable[Row]) -> list[float]:
    """Ends of the exact two-sided 95 % interval of the share of LIKELY answers that are right."""
    count, right = stated(rows)
    low, high = binomtest(right, count).proportion_ci(0.95, "exact")
    return [round(low, 4), round(high, 4)]


def tables(rows: Sequence[Row]) -> dict[str, str]:
    """The tables and sentences of the documents, by name."""
    truths = [truth for truth in (*PARTS, HEALTHY, UNKNOWN) if _of(rows, "truth", truth)]
    machines = sorted({row["machine"] for row in rows})
    again = [{**row, **row["left_out"]} for row in rows]
    by_machine = [
        f"| {name} | {_counted(_of(rows, 'machine', name))} | {_sure(_of(rows, 'machine', name))} "
        f"| {_counted(_of(again, 'machine', name))} | {_sure(_of(again, 'machine', name))} |"
        for name in machines
    ]
    graded = [row for row in rows if row["grade"] in ("Y1", "Y2")]
    clear = sum(row["verdict"] == RIGHT for row in graded)
    low, high = (100.0 * end for end in share_right(rows))
    healthy = _of(rows, "truth", HEALTHY)
    cleared = sum(row["verdict"] == RIGHT for row in healthy)
    wrong = [f"{row['record']} ({row['answer']})" for row in rows if row["verdict"] == WRONG]
    return {
        "by truth": _table("truth", [(truth, _of(rows, "truth", truth)) for truth in truths]),
        "by grade": _table("grade", [(grade, _of(rows, "grade", grade)) for grade in GRADES]),
        "by machine": "\n".join((
            "| machine | right | cannot tell | wrong | stated ≥ 90 %, right | left out: right "
            "| cannot tell | wrong | stated ≥ 90 %, right |",
            "| --- |" + 8 * " ---: |",
            *by_machine,
        )),
        "sure": f"Of {stated(rows)[0]} answers stated with 90 % or more, {stated(rows)[1]} are "
        f"right; scored with that machine left out, {stated(again)[1]} of {stated(again)[0]}. "
        f"With so many records the share of right answers is {low:.1f} to {high:.0f} % (exact "
        f"two-sided 95 % interval). Only {len(healthy)} records are of healthy bearings; {cleared} "
        f"of them was called healthy.",
        "reliability": reliability(rows),
        "graded": f"Of the {len(graded)} records here that are graded Y1 or Y2, {clear} are right.",
        "wrong": f"Wrong: {', '.join(wrong) or 'none'}.",
        "extents": _extents(rows),
    }  # fmt: skip


def _of(rows: Iterable[Row], name: str, value: str) -> list[Row]:
    return [row for row in rows if row[name] == value]


def _counted(rows: Sequence[Row]) -> str:
    counts = Counter(row["verdict"] for row in rows)
    return " | ".join(str(counts[result]) for result in VERDICTS)


def _sure(rows: Sequence[Row]) -> str:
    count, right = stated(rows)
    return f"{right} of {count}"


def _table(heading: str, named: Sequence[tuple[str, list[Row]]]) -> str:
    lines = [f"| {heading} | right | cannot tell | wrong |", "| --- | ---: | ---: | ---: |"]
    return "\n".join([*lines, *(f"| {name} | {_counted(rows)} |" for name, rows in named)])


def _extents(rows: Iterable[Row]) -> str:
    lines = ["| record | true extent | measured | interval |", "| --- | ---: | ---: | ---: |"]
    for row in rows:
        if row["true_extent_deg"] and "extent_deg" in row:
            between = f"{row['low_deg']:.1f}-{row['high_deg']:.1f}°"
            lines.append(
                f"| {row['record']} | {row['true_extent_deg']:g}° | {row['extent_deg']:.1f}° "
                f"| {between} |"
            )
    return "\n".join(lines)
