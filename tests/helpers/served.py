"""The explorer's server inside a test's own event loop, and what tests ask of it."""

import asyncio
import threading
import time
from collections.abc import Awaitable, Callable
from typing import Any

from bearing_explorer.kit.compute.executors import POOL_SIZE, run_in_thread
from bearing_explorer.kit.serve.serving import Limits, make_server
from bearing_explorer.kit.serve.websocket import LiveSocket
from bearing_explorer.page import page
from tornado.httpclient import AsyncHTTPClient, HTTPResponse

from tests.helpers.loops import run
from tests.helpers.page_client import PageClient

SMALL = Limits(sessions=3, message=300_000, idle=3600.0)


def served(
    test: Callable[[str, Any], Awaitable[None]], limits: Limits = SMALL, **options: Any
) -> None:
    """Run `test(url, server)` beside a server, both on one event loop."""

    async def both() -> None:
        given = {"port": 0, "address": "127.0.0.1", **options}
        server = make_server(page=page, limits=limits, **given)
        server.start()
        try:
            await test(f"http://127.0.0.1:{server.port}{server.prefix}/", server)
        finally:
            for socket in list(LiveSocket.connected):
                socket.close()
            server.stop()
            # a view that is still being made in a thread would disturb the next test
            idle = threading.Barrier(POOL_SIZE)
            await asyncio.gather(*(run_in_thread(idle.wait, 60.0) for _ in range(POOL_SIZE)))

    run(both())


async def get(url: str, **options: Any) -> HTTPResponse:
    return await AsyncHTTPClient().fetch(
        url, raise_error=False, follow_redirects=False, request_timeout=60.0, **options
    )


def origin(url: str) -> str:
    return url.rstrip("/")


def wait_until(holds: Callable[[], bool], seconds: float = 120.0) -> None:
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


async def until(holds: Callable[[], bool], seconds: float = 120.0) -> None:
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        await asyncio.sleep(0.05)


async def closed(client: PageClient, seconds: float = 120.0) -> None:
    """Wait until the server ends a connection."""
    end = time.monotonic() + seconds
    while not client.closed:
        assert time.monotonic() < end
        await client.news(0.1)


def session_of(server: Any) -> Any:
    [context] = server._tornado._applications.values()
    return list(context.sessions)
