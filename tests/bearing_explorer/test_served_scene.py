"""The page as it is served: each browser's own scene, any path, several processes."""

import asyncio
import logging
import re
import signal
from pathlib import Path
from typing import Any

import pytest

from tests.bearing_explorer.kit.serve.test_serving import NEW_MODEL, changed
from tests.browser.helpers import explorer_server, serving as server_up
from tests.helpers.loops import run
from tests.helpers.page_client import PageClient
from tests.helpers.served import get, served, session_of, wait_until


def test_a_browser_can_change_no_more_than_its_own_scene(caplog: pytest.LogCaptureFixture) -> None:
    async def attack(url: str, server: Any) -> None:
        mine, other = PageClient(url), PageClient(url)
        for client in (mine, other):
            await client.connect()
            assert await client.until_drawn()
        documents = [session.document for session in session_of(server)]
        [document] = [each for each in documents if each.models.get_by_id(mine.ids["packet"])]
        unpack = document.models.get_by_id(mine.ids["unpack"])
        code, count = unpack.code, len(document.models)
        for new in ("alert(1)", NEW_MODEL, [NEW_MODEL]):
            await mine.patch(
                changed("code", new, {"id": unpack.id}),
                {"kind": "RootAdded", "model": NEW_MODEL},
                changed("x", 1, {"id": "p0"}),
                changed("visible", False, {"id": other.ids["Controls"]}),
            )
        # a message reaches one's own controls, and not another session's
        await mine.ask(set={"extent_deg": 33.0})
        assert await mine.until_drawn()
        mine.ids["Controls"] = other.ids["Controls"]
        await mine.ask(set={"extent_deg": 77.0})
        await asyncio.sleep(0.3)
        assert unpack.code == code
        assert len(document.models) == count
        assert not other.closed
        # as an angle: 77 alone may be milliseconds or digits of a residual
        assert [words for words in map(str, other.words.values()) if "77°" in words] == []
        assert other.drawn == 0

    with caplog.at_level(logging.WARNING):
        served(attack)
    assert "Traceback" not in caplog.text


def test_the_page_does_not_know_its_path_and_works_behind_a_proxy_that_strips_it() -> None:
    """A browser test goes through one that keeps it."""

    async def look(url: str, server: Any) -> None:
        page = (await get(url)).body.decode()
        files = set(re.findall(r'(?:src|href)="([^":]+\.(?:js|css)[^"]*)"', page))
        assert len(files) > 3
        for path in files:
            assert not path.startswith("/"), path
            assert (await get(url + path)).code == 200, path
        assert (await get(url + "favicon.ico")).code == 200

    served(look)


@pytest.mark.proof
def test_two_processes_share_the_port_and_end_together() -> None:
    async def many(url: str) -> None:
        people = [PageClient(url) for _ in range(6)]

        async def come(client: PageClient) -> None:
            await client.connect()
            await client.ask(set={"extent_deg": 30.0})
            assert await client.until_drawn()

        await asyncio.gather(*(come(client) for client in people))
        for client in people:
            await client.close()

    with server_up(explorer_server("--num-procs", "2", "--log-level", "info")) as server:
        tasks = Path(f"/proc/{server.process.pid}/task/{server.process.pid}/children")
        children = [int(pid) for pid in tasks.read_text().split()]
        run(many(server.url))
        assert server.stop(signal.SIGTERM) in (0, 143)
        log = server.log
    assert len(children) >= 2, log
    assert "Traceback" not in log
    assert len(set(re.findall(r" INFO update session=(\S+)", log))) >= 6
    for child in children:
        wait_until(lambda child=child: not Path(f"/proc/{child}").exists())
