"""Hostile messages and damaged files of every format.

``HOSTILE_MESSAGES=20000 HOSTILE_FILES=1000 pytest -m proof tests/fuzz/test_hostile.py`` sends more.
"""

import asyncio
import gc
import logging
import os
from typing import Any

import pytest
from bearing_explorer.kit.serve.serving import Limits

from tests.fuzz.attacker import Tally, attack
from tests.fuzz.broken_uploads import run
from tests.fuzz.hostile_messages import SHAPES
from tests.helpers.page_client import PageClient
from tests.helpers.served import served

MESSAGES = int(os.environ.get("HOSTILE_MESSAGES", "60"))
FILES = int(os.environ.get("HOSTILE_FILES", "12"))


@pytest.mark.proof
def test_hostile_messages_break_nothing_and_are_taken_or_cut_off(
    caplog: pytest.LogCaptureFixture,
) -> None:
    tally = Tally()

    async def send(url: str, server: Any) -> None:
        there = PageClient(url)
        await there.connect()
        await asyncio.gather(*(attack(url, 1_000_001 + k, 120, tally) for k in range(2)))
        await there.ask(set={"extent_deg": 31.0})
        assert await there.until_drawn(), "the session that was there all the while still is"
        await there.close()

    gc.collect()  # what a server of an earlier test left behind, such as a reader that timed out
    with caplog.at_level(logging.WARNING):
        served(send, Limits())
    assert "Traceback" not in caplog.text
    assert not any(record.exc_info for record in caplog.records)
    assert tally.unanswered == 0
    assert not tally.errors
    assert set(tally.sent) == set(SHAPES), "each shape was among them"
    assert tally.cut.total() > 10


@pytest.mark.proof
def test_each_damaged_file_has_an_answer_and_leaves_nothing_behind() -> None:
    outcome = run(MESSAGES, FILES, first=1_000_001)
    assert outcome.turns, "the loop was watched"
    assert outcome.faults == []
    assert outcome.answered.total() == FILES
    assert 0 < outcome.refused.total() < FILES, "some can still be read"
    assert outcome.tally.sent.total() >= MESSAGES
