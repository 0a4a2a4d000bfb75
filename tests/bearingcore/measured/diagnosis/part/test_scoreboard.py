"""The scoreboard: documents and page say what it says, and the numbers it set are those in use."""

import json
from pathlib import Path

import pytest
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis

from bearingcore.measured.diagnosis._part.probability import CALIBRATION
from tests.benchmarks.scoreboard import (
    CANNOT,
    FILE,
    OTHERS_FILE,
    WRONG,
    alarms,
    fitted,
    left_out,
    other_tables,
    stated,
    tables,
)
from tests.outside.witness import witness

ROOT = Path(__file__).parents[5]
ROWS = json.loads(FILE.read_text(encoding="utf-8"))["records"]
OTHERS = json.loads(OTHERS_FILE.read_text(encoding="utf-8"))["records"]


@witness(
    "function: diagnose",
    "function: measure_extent",
    by="answers on 80 measured records, as kept (CWRU, MFPT, HIT-SM, FEMTO-ST)",
    compared="part named, extent of spalls; what README and DIAGNOSIS.md say of them",
    within="none wrong",
)
@pytest.mark.parametrize(
    ("document", "names"),
    [
        ("README.md", ("by truth", "sure")),
        ("assets/docs/DIAGNOSIS.md", tuple(tables(ROWS))),
    ],
)
def test_documents_say_what_the_scoreboard_says(document: str, names: tuple[str, ...]) -> None:
    text = (ROOT / document).read_text(encoding="utf-8")
    assert f"{len(ROWS)} records" in text
    assert [name for name in names if tables(ROWS)[name] not in text] == []
    assert WRONG not in {row.get(kind) for row in ROWS for kind in ("verdict", "extent_verdict")}


@witness(
    "function: diagnose",
    by="answers on 231 measured records of three machines that had no part in choosing",
    compared="part named with 90 % or more; alarms on healthy records",
    within="two wrong, one alarm",
)
def test_other_machines_are_told_of_as_they_came_out() -> None:
    text = (ROOT / "assets" / "docs" / "DIAGNOSIS.md").read_text(encoding="utf-8")
    assert [words for words in other_tables(OTHERS).values() if words not in text] == []
    assert f"{len(OTHERS)} records are judged" in text
    (count, right), (before, good) = stated(OTHERS), stated(ROWS)
    assert f"{good + right} of {before + count} sure answers on eight machines are right" in text
    assert f"{right} of {count}" in PartDiagnosis.about
    assert f"{alarms(OTHERS)} of 90 healthy" in PartDiagnosis.about


def test_the_calibration_is_what_the_records_set() -> None:
    assert tuple(fitted(ROWS)) == pytest.approx(tuple(CALIBRATION), rel=0.01)


def test_stated_probabilities_hold_also_without_the_machine_they_are_of() -> None:
    again = [dict(row) for row in ROWS]
    left_out(again)
    assert [row["left_out"] for row in again] == [row["left_out"] for row in ROWS]
    for rows in (ROWS, [{**row, **row["left_out"]} for row in ROWS]):
        count, right = stated(rows)
        assert right >= 0.96 * count > 0


def test_the_page_counts_every_answer_and_every_extent() -> None:
    answered = [row for row in ROWS if row["verdict"] != CANNOT]
    count, right = stated(ROWS)
    sizes = tables(ROWS)["extents"].count("\n") - 1
    said = PartDiagnosis.about
    assert f"Of {len(ROWS)} measured records of real machines {len(answered)} were" in said
    assert f"of {count} answers stated with 90 % or more {right} were right" in said
    # n of n right: the share p with p^n = 2.5 % is the lower end (Clopper and Pearson, 1934)
    assert count == right
    assert f"interval: {100.0 * 0.025 ** (1.0 / count):.1f} to 100 %" in said
    assert f"{sizes} of {sizes} measured lengths" in said
