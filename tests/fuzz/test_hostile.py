"""Small shares of the benchmark `hostile`: other messages and files."""

import asyncio
import gc
import logging
from typing import Any

import pytest
from bearing_explorer.kit.serve.serving import Limits

from tests.benchmarks.hostile import run
from tests.fuzz.attacker import Tally, attack
from tests.fuzz.hostile_messages import SHAPES
from tests.helpers.page_client import PageClient
from tests.helpers.served import served


@pytest.mark.proof
def test_hostile_messages_break_nothing_and_are_taken_or_cut_off(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    tally = Tally()
    # it would be made in a thread long after the server is gone, and hold up the next test
    monkeypatch.setattr("bearing_explorer.explorer.requests.report", lambda *_: {})

    async def send(url: str, server: Any) -> None:
        there = PageClient(url)
        await there.open_page()
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
    outcome = run(messages=60, files=12, first=1_000_001)
    assert outcome.turns, "the loop was watched"
    assert outcome.faults == []
    assert outcome.answered.total() == 12
    assert 0 < outcome.refused.total() < 12, "some can still be read"
    assert outcome.tally.sent.total() >= 60
