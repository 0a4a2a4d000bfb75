"""Several explorers behind a balancer: everybody comes back to the process they came to first."""

from __future__ import annotations

import asyncio
import re
import shutil
from contextlib import ExitStack

import pytest

from tests.browser.helpers import explorer_server, free_port, serving
from tests.helpers.balancer import balanced, haproxy_text
from tests.helpers.loops import run
from tests.helpers.page_client import PageClient

HAPROXY = bool(shutil.which("haproxy") or shutil.which("haproxy", path="/usr/sbin"))
WAYS = [False, pytest.param(True, marks=pytest.mark.skipif(not HAPROXY, reason="no haproxy"))]


def test_the_operators_page_has_what_is_tested() -> None:
    text = haproxy_text(5000, [1, 2, 3])
    assert "bind 127.0.0.1:5000" in text
    assert re.findall(r"server p\d 127.0.0.1:(\d)", text) == ["1", "2", "3"]
    assert "cookie explorer insert indirect nocache" in text
    assert "127.0.0.1:5006" not in text


@pytest.mark.proof
@pytest.mark.parametrize("haproxy", WAYS, ids=["a few lines", "haproxy"])
def test_two_explorers_share_their_people_and_lose_none(haproxy: bool) -> None:
    people = 8

    async def come(url: str) -> None:
        clients = [PageClient(url) for _ in range(people)]
        for client in clients:
            assert await client.open_page() == 200
            await client.connect()
        for number, client in enumerate(clients):
            await client.ask(set={"extent_deg": 20.0 + number})
        for client in clients:
            assert await client.until_drawn(seconds=60.0)
            assert not client.errors
        for client in clients:
            await client.close()

    with ExitStack() as stack:
        port = free_port()
        options = ("--log-level", "info", "--allow-websocket-origin", f"127.0.0.1:{port}")
        servers = [stack.enter_context(serving(explorer_server(*options))) for _ in range(2)]
        stack.enter_context(balanced([s.port for s in servers], port=port, haproxy=haproxy))
        run(asyncio.wait_for(come(f"http://127.0.0.1:{port}/"), 120.0))
        sessions = [set(re.findall(r" INFO update session=(\S+)", s.log)) for s in servers]
        assert sum(map(len, sessions)) == people
        assert min(map(len, sessions)) >= 2, "both have people"
