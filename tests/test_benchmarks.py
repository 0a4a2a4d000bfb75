"""Benchmarks are commands; what they print can be compared between machines."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from tests.benchmarks import machine, yardstick

FOLDER = Path(__file__).parent / "benchmarks"
NEEDS_NONE = {"__init__", "machine", "yardstick"}
TIMED = [
    path
    for path in sorted(FOLDER.glob("*.py"))
    if path.stem not in NEEDS_NONE
    and re.search(r"perf_counter|process_time|monotonic|_seconds|table\(\)", path.read_text())
]


@pytest.mark.parametrize("path", TIMED, ids=lambda path: path.stem)
def test_a_time_that_is_printed_stands_beside_the_machines_own_pace(path: Path) -> None:
    text = path.read_text()
    assert "from tests.benchmarks.machine import" in text
    assert re.search(r"[^_.\w]pace\(\)", text), "and is measured in the same run"


def test_a_pace_says_what_it_is_and_gives_ratios() -> None:
    found = machine.Pace(statics=0.7e-3, motion=10e-3, load=0.5)
    assert str(found).startswith("yardstick: C loops 0.70 ms (statics) and 10.0 ms")
    assert found.ratio(0.025) == "2.5 C"
    assert found.ratio(10.0) == "1,000 C"


@pytest.mark.skipif(yardstick.compiler() is None, reason="no gcc")
def test_the_pace_is_that_of_the_c_loops() -> None:
    found = machine.pace()
    assert 0.0 < found.statics < found.motion < 5.0


def test_without_a_compiler_there_is_no_yardstick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(machine, "compiler", lambda: None)
    found = machine.pace()
    assert math.isnan(found.motion)
    assert "none" in str(found)
    assert "–" in found.ratio(1.0)
