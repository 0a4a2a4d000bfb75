"""One session floods the server; another one draws meanwhile, and nothing is left behind."""

import asyncio
import io
import math
import time
import zipfile
from collections.abc import Callable, Iterator
from typing import Any

import psutil
import pytest
from bearing_explorer.diagnosis.upload import PIECE

from tests.browser.helpers import serving
from tests.fuzz.attacker import PATIENCE
from tests.fuzz.broken_uploads import Uploader
from tests.fuzz.hostile_messages import GOOD, LARGEST
from tests.fuzz.watched_server import GRACE, WatchedServer
from tests.helpers.loops import run
from tests.helpers.page_client import PageClient, message

COUNT = 50
"""Messages of a kind as the page sends them, and as many with long texts."""
LONGEST = 1.0
"""[s] in which another session draws, where the machine has nothing else to do."""


def kinds() -> dict[str, tuple[str, dict[str, Any]]]:
    """One message of each kind: the component that sends it, and its data."""
    return {f"{component}: {', '.join(sorted(data))}": (component, data)
            for component, data in GOOD}  # fmt: skip


def lengthen_texts(size: int, data: Any) -> Any:
    """The same message with each of its texts so long."""
    if isinstance(data, dict):
        return {k: v if k == "type" else lengthen_texts(size, v) for k, v in data.items()}
    return data.ljust(size, "x") if isinstance(data, str) else data


async def longest_picture(client: PageClient, goes_on: Callable[[], bool]) -> float:
    """Move a slider again and again; return the longest time to a picture [s]."""
    longest = 0.0
    while goes_on():
        began = time.perf_counter()
        await client.ask(set={"extent_deg": 20.0 + 10.0 * math.sin(0.1 * client.mark)})
        drawn = not client.closed and await client.until_drawn(seconds=PATIENCE)
        longest = max(longest, time.perf_counter() - began if drawn else math.inf)
    return longest


async def opened(url: str, kind: type[PageClient] = PageClient, tab: str = "diagnosis") -> Any:
    client = kind(url)
    await client.connect()
    await client.until_drawn(seconds=PATIENCE)
    await client.show(tab, "FileUpload" if tab == "diagnosis" else "")
    return client


async def send(client: PageClient, component: str, data: Any) -> None:
    """Send a message `COUNT` times in one of the websocket, and then with long texts."""
    model = {"id": client.ids[component]}
    for sent in (data, lengthen_texts(LARGEST // COUNT - 500, data)):
        if not client.closed:
            await client.patch(*[message("data_event", model=model, data=sent)] * COUNT)


@pytest.mark.proof
def test_another_session_draws_whatever_one_sends_a_hundred_times() -> None:
    slow: list[str] = []

    async def flood(url: str) -> None:
        client, other = await opened(url), await opened(url, tab="load")
        until = time.perf_counter() + 3.0
        calm = await longest_picture(other, lambda: time.perf_counter() < until)

        async def longest(component: str, data: Any) -> float:
            """The longest time [s] until the other session draws, while messages arrive."""
            nonlocal client
            if client.closed:
                client = await opened(url)
            sending = asyncio.ensure_future(send(client, component, data))
            ends = time.perf_counter() + 0.5
            return await longest_picture(
                other, lambda: not sending.done() or time.perf_counter() < ends
            )

        for name, (component, data) in kinds().items():
            took, limit = await longest(component, data), max(LONGEST, 4.0 * calm)
            if took > limit:  # a kind that jams does so again; a busy machine hardly
                took = min(took, await longest(component, data))
            if took > limit:
                slow.append(f"{name}: {took:.1f} s, {calm:.2f} s before")
        await client.close()
        await other.close()

    with serving(WatchedServer()) as server:
        run(flood(server.url))
        assert not slow
        assert server.slow_turns() == []


def packed(members: int, rows: int) -> bytes:
    """A zip of tables of numbers, small as it is packed."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for index in range(members):
            file.writestr(f"run{index}.csv", "time,x\n" + "0.125,0.5\n" * rows)
    return content.getvalue()


def children(server: WatchedServer) -> Iterator[psutil.Process]:
    return iter(psutil.Process(server.process.pid).children())


async def upload(client: PageClient, name: str, content: bytes) -> None:
    await client.say("FileUpload", {"type": "begin", "name": name, "size": len(content)})
    piece = {"type": "piece", "content": {"type": "bytes", "data": {"id": "b1"}}, "of": 1}
    await client.say("FileUpload", piece, b1=content)


@pytest.mark.proof
def test_what_is_in_a_zip_is_read_no_further_once_its_page_is_closed() -> None:
    """Two such uploads, each of which would take a minute, and a third session's small one."""
    large, small = packed(30, 1_500_000), packed(2, 2_000)
    assert max(len(large), len(small)) <= PIECE

    async def leave(url: str, server: WatchedServer) -> None:
        clients = [await opened(url) for _ in range(2)]
        for client in clients:
            await upload(client, "large.zip", large)
        end = time.perf_counter() + PATIENCE
        while not any(children(server)):
            assert time.perf_counter() < end, "it is read"
            await asyncio.sleep(0.05)
        third = await opened(url, Uploader)
        assert await third.upload("small.zip", small), "files are read in turn by session"
        for client in (*clients, third):
            await client.close()
        # a page that lost its connection may come back for a while
        end = time.perf_counter() + GRACE + 20.0
        quiet_since = time.perf_counter()
        while time.perf_counter() - quiet_since < 3.0:  # nor is the next one begun
            assert time.perf_counter() < end, "nobody waits for it any longer"
            await asyncio.sleep(0.05)
            quiet_since = time.perf_counter() if any(children(server)) else quiet_since

    with serving(WatchedServer()) as server:
        run(leave(server.url, server))
