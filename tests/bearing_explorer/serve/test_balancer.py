"""Several explorers behind a balancer: everybody comes back to the process they came to first."""

from __future__ import annotations

import asyncio
import re
import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from urllib.request import Request, urlopen

import pytest

from tests.browser.helpers import explorer_server, free_port, serving
from tests.helpers.balancer import balanced, haproxy_text
from tests.helpers.loops import run
from tests.helpers.page_client import PageClient

HAPROXY = bool(shutil.which("haproxy") or shutil.which("haproxy", path="/usr/sbin"))
WAYS = [False, pytest.param(True, marks=pytest.mark.skipif(not HAPROXY, reason="no haproxy"))]


@contextmanager
def named(name: str) -> Iterator[int]:
    """A server that answers with its name, on a port of its own."""

    class Answer(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Length", str(len(name)))
            self.end_headers()
            self.wfile.write(name.encode())

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Answer)
    thread = Thread(target=server.serve_forever)
    thread.start()
    try:
        yield server.server_port
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


@pytest.mark.parametrize("haproxy", WAYS, ids=["a few lines", "haproxy"])
def test_who_came_to_a_process_comes_to_it_again(haproxy: bool) -> None:
    with ExitStack() as stack:
        ports = [stack.enter_context(named(name)) for name in ("one", "two")]
        port = stack.enter_context(balanced(ports, haproxy=haproxy))
        url = f"http://127.0.0.1:{port}/"
        seen = []
        for _ in range(6):
            with urlopen(url) as answer:
                first = answer.read()
                cookie = answer.headers["Set-Cookie"].split(";")[0]
            for _ in range(5):
                with urlopen(Request(url, headers={"Cookie": cookie})) as answer:
                    assert answer.read() == first
            seen.append(first)
        assert set(seen) <= {b"one", b"two"}
        if haproxy:
            assert len(set(seen)) == 2, "not all in one process"


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
