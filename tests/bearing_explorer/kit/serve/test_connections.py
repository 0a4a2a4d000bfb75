"""What a connection may send before it is answered, and that others are answered meanwhile."""

import asyncio
import os
import time
from typing import Any
from urllib.parse import urlsplit

import psutil
import pytest
from bearing_explorer.kit.serve.tornado_internals import LARGEST_HEADERS, MOST_UNFINISHED

from tests.helpers.served import get, served


async def connect(url: str) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    return await asyncio.open_connection("127.0.0.1", urlsplit(url).port)


async def answer(reader: asyncio.StreamReader) -> str:
    return (await asyncio.wait_for(reader.read(), 30.0)).decode()


@pytest.mark.parametrize("framing", ["Content-Length: 95000000", "Transfer-Encoding: chunked"])
def test_bodies_are_refused_at_once(framing: str) -> None:
    """Before they come: eight of 95 MB held 750 MB."""

    async def post(url: str, server: Any) -> None:
        reader, writer = await connect(url)
        writer.write(f"POST / HTTP/1.1\r\nHost: localhost\r\n{framing}\r\n\r\n".encode())
        if "chunked" in framing:
            writer.write(b"f0000\r\n" + b"a" * 0xF0000)
        try:
            said = await answer(reader)  # to its end: the connection is closed
        except ConnectionResetError:  # while the body was still under way
            said = ""
        assert "200" not in said.partition("\r\n")[0]
        writer.close()

    served(post)


def test_an_address_that_is_far_too_long_is_said_to_be() -> None:
    """Up to the most that headers may have; the page makes links of an eighth of that."""

    async def ask(url: str, server: Any) -> None:
        reader, writer = await connect(url)
        head = f"GET /?v=1&points={'A' * LARGEST_HEADERS} HTTP/1.1\r\nHost: localhost\r\n\r\n"
        writer.write(head.encode())
        assert await answer(reader) == "", "the line is cut"
        writer.close()
        shorter = await get(f"{url}?v=1&points={'A' * 40_000}", max_redirects=0)
        assert shorter.headers["Location"].endswith("v=too-long")

    served(ask)


def test_dripping_connections_hold_nobody_up() -> None:
    """A hundred send headers byte by byte; the server answers others, and keeps little of it."""

    async def drip(url: str, server: Any) -> None:
        before = psutil.Process(os.getpid()).memory_info().rss
        writers = []
        for _ in range(100):
            reader, writer = await connect(url)
            writer.write(b"GET / HTTP/1.1\r\nX-Long: " + b"a" * 50_000)
            writers.append((reader, writer))
        await asyncio.sleep(0.2)
        assert len(server._http._unfinished) <= MOST_UNFINISHED
        worked = []
        for _ in range(10):
            for _, writer in writers:
                if not writer.is_closing():
                    writer.write(b"a" * 100)
            began = time.thread_time()  # of this loop: a clock counts what neighbours take as well
            assert (await get(f"{url}liveness")).code == 200
            worked.append(time.thread_time() - began)
        assert sorted(worked)[5] < 0.3
        assert psutil.Process(os.getpid()).memory_info().rss - before < 50e6
        for _, writer in writers:
            writer.close()

    served(drip)
