"""A small share of ``python -m tests.benchmarks.mutated_files``, with files of its own."""

from __future__ import annotations

import pytest

from tests.benchmarks.mutated_files import faults_of, run


@pytest.mark.proof
def test_each_mutated_file_has_an_answer_and_leaves_nothing_behind() -> None:
    tally, turns, left, log = run(12, 1_000_001)
    assert turns, "the loop was watched"
    assert faults_of(12, tally, [], left) == []
    assert 0 < tally.refused.total() < 12, "some can still be read"
    assert "Traceback" not in log
