"""Hostile messages and damaged files of every format.

``HOSTILE_MESSAGES=20000 HOSTILE_FILES=1000 pytest -m proof tests/fuzz/test_hostile.py`` sends more.
"""

import os

import pytest

from tests.fuzz.broken_uploads import run
from tests.fuzz.hostile_messages import SHAPES

MESSAGES = int(os.environ.get("HOSTILE_MESSAGES", "120"))
FILES = int(os.environ.get("HOSTILE_FILES", "12"))


@pytest.mark.proof
def test_hostile_messages_and_damaged_files_are_answered_and_leave_nothing_behind() -> None:
    outcome = run(MESSAGES, FILES, first=1_000_001)
    assert outcome.faults == []
    assert 0 < outcome.refused < FILES, "some files can still be read"
    assert outcome.tally.sent.total() >= MESSAGES
    assert set(outcome.tally.sent) == set(SHAPES), "each shape was among them"
    assert outcome.tally.cut > 10
