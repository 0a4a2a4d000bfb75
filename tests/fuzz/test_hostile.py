"""A small share of ``python -m tests.benchmarks.hostile``: other messages than it begins with."""

from __future__ import annotations

import asyncio
import logging
import random
from typing import Any

import pytest
from bearing_explorer.serve.serving import Limits

from tests.bearing_explorer.serve.test_serving import served
from tests.fuzz.hostile_messages import SHAPES, made
from tests.fuzz.stranger import Stranger, Tally
from tests.helpers.page_client import PageClient


def test_strangers_break_nothing_and_are_heard_or_cut_off(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    tally = Tally()
    # it would be made in a thread long after the server is gone, and hold up the next test
    monkeypatch.setattr("bearing_explorer.session.report", lambda *_: {})

    async def attack(url: str, server: Any) -> None:
        there = PageClient(url)
        await there.open_page()
        await there.connect()
        strangers = [Stranger(url, 1_000_001 + k, tally) for k in range(2)]
        await asyncio.gather(*(one.send(120) for one in strangers))
        await there.ask(set={"extent_deg": 31.0})
        assert await there.until_drawn(), "who was there all the while still is"
        await there.close()

    with caplog.at_level(logging.WARNING):
        served(attack, Limits())
    assert "Traceback" not in caplog.text
    assert not any(record.exc_info for record in caplog.records)
    assert tally.unanswered == 0
    assert not tally.errors
    assert set(tally.sent) == set(SHAPES), "each shape was among them"
    assert tally.cut.total() > 10


def test_what_is_sent_can_be_sent_again() -> None:
    ids = {"Controls": "p1001", "ShareBar": "p1002"}
    for shape in SHAPES:
        for number in range(10):
            once, again = (made(random.Random(number), shape, ids) for _ in range(2))
            assert once == again
