"""Faults of servers, lines, disks and clocks, as the real page gets through them.

``pytest -n 0 -m proof -v tests/browser/test_faults.py`` is the list of what operators are promised;
``python -m tests.benchmarks.starting --kills 20`` ends first starts at every tenth.
"""

from __future__ import annotations

import asyncio
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import rest, settle, show, slider, value, wait
from tests.browser.helpers import (
    ROOT,
    Server,
    Watch,
    drag,
    explorer_server,
    free_port,
    holding,
    serving,
)
from tests.helpers.compiled import compile_once
from tests.helpers.proxies import Relay

pytestmark = pytest.mark.proof

STOPPED = 8.0  # [s], twice what the page waits before it says that nothing answers
LOST = "The connection to the server is lost. Reload the page to go on."
SILENT = "The server does not answer. What you change is drawn as soon as it does."
UNSENT = "not connected so cannot send"  # Bokeh, of what is moved when the line is cut

CLOCK = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
/* The time of day, off by as many seconds as the file says; clocks that only count are as ever. */
int clock_gettime(clockid_t which, struct timespec *now)
{
    int (*next)(clockid_t, struct timespec *) = dlsym(RTLD_NEXT, "clock_gettime");
    int failed = next(which, now);
    FILE *file = which == CLOCK_REALTIME ? fopen(getenv("CLOCK_OFFSET"), "r") : NULL;
    long offset = 0;
    if (file) {
        if (fscanf(file, "%ld", &offset) == 1)
            now->tv_sec += offset;
        fclose(file);
    }
    return failed;
}
time_t time(time_t *at)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (at)
        *at = now.tv_sec;
    return now.tv_sec;
}
"""


class Line(Relay):
    """The line between a browser and a server, on a loop of its own."""

    def __init__(self, to: int) -> None:
        super().__init__()
        self._to = to
        self._loop = asyncio.new_event_loop()
        self._flows = asyncio.Event()
        self._thread = threading.Thread(target=self._loop.run_forever)

    def __enter__(self) -> Line:
        self._thread.start()
        self._flows.set()
        asyncio.run_coroutine_threadsafe(self.start(), self._loop).result(10)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self.cut()
        asyncio.run_coroutine_threadsafe(self.stop(), self._loop).result(10)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(10)

    def let_flow(self, flows: bool) -> None:
        """Hand on what comes, or keep it for later."""
        self._loop.call_soon_threadsafe(self._flows.set if flows else self._flows.clear)

    def cut(self) -> None:
        """End all connections; new ones are possible."""

        async def end() -> None:
            for task in self._tasks:
                task.cancel()

        asyncio.run_coroutine_threadsafe(end(), self._loop).result(10)

    async def relay(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """One connection."""
        there, back = await asyncio.open_connection("127.0.0.1", self._to)
        try:
            await asyncio.gather(self._hand_on(reader, back), self._hand_on(there, writer))
        finally:
            back.close()

    async def _hand_on(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        while data := await reader.read(65536):
            await self._flows.wait()
            writer.write(data)
            await writer.drain()
        writer.close()


def mounted(*commands: str) -> tuple[str, ...]:
    """What starts a process that sees other file systems, made by these commands of a shell."""
    if sys.platform != "linux" or subprocess.run(["unshare", "-m", "true"]).returncode:
        pytest.skip("file systems of a process's own need Linux and its administrator")
    return ("unshare", "-m", "sh", "-c", " && ".join([*commands, 'exec "$@"']), "sh")


def started(prefix: tuple[str, ...], environment: dict[str, str]) -> Server:
    """The explorer behind `prefix`."""
    port = free_port()
    command = [*prefix, sys.executable, "-B", "-m", "bearing_explorer", "--no-browser"]
    return Server([*command, "--port", str(port)], port, environment=environment)


def first_picture(page: Page, url: str) -> None:
    page.goto(url)
    page.wait_for_function("window.__frames >= 1")
    page.wait_for_selector("aside:not(:has([inert])) #control-extent_deg")  # statics are compiled
    settle(page)


def works(page: Page) -> None:
    """A slider is dragged and another tab opened, and both are drawn."""
    before = page.evaluate("window.__mark || 0")
    drag(page, slider(page, "extent_deg"), 0.2, 0.5)
    page.wait_for_function("before => window.__mark > before", arg=before)
    settle(page)
    show(page, "stiffness")
    expect(page.locator(".view-stiffness canvas").first).to_be_visible()
    wait(page, lambda: shown_extent(page) == value(page, "extent_deg"))


def works_for_another(page: Page, watching: Watch, server: Server) -> None:
    """A second page of the same browser, which goes again."""
    other = page.context.new_page()
    watching.follow(other)
    first_picture(other, server.url)
    works(other)
    other.close()


def shown_extent(page: Page) -> float | None:
    """The extent in the address, which is that of the scene that the server has."""
    found: str | None = page.evaluate("new URLSearchParams(location.search).get('extent_deg')")
    return None if found is None else float(found)


def comes_back(page: Page, url: str | None = None) -> None:
    """Loaded again, the page has the scene that it had."""
    extent = value(page, "extent_deg")
    wait(page, lambda: shown_extent(page) == extent)
    first_picture(page, url or page.url)
    assert value(page, "extent_deg") == extent
    expect(page.get_by_role("alert")).to_have_count(0)
    works(page)


def test_a_server_that_stands_still_a_line_that_is_cut_and_a_server_started_anew(
    watch: tuple[Page, Watch],
) -> None:
    """What is on its way arrives later; where connections end, the page says so."""
    page, watching = watch
    compile_once()
    with (
        serving(explorer_server("--allow-websocket-origin", "*")) as server,
        Line(server.port) as line,
    ):
        first_picture(page, f"http://localhost:{line.port}/")
        moves = holding(page, slider(page, "extent_deg"), 0.1, 0.7, 40)
        next(moves)
        settle(page)
        server.process.send_signal(signal.SIGSTOP)
        end = time.monotonic() + STOPPED
        while time.monotonic() < end:
            next(moves)
            page.wait_for_timeout(100)
        note = page.locator("#connection-note")
        expect(note).to_have_text(SILENT)
        server.process.send_signal(signal.SIGCONT)
        page.mouse.up()
        all_arrives(page)
        expect(note).to_have_count(0)

        line.let_flow(False)
        drag(page, slider(page, "extent_deg"), 0.2, 0.6)
        page.wait_for_timeout(1e3 * STOPPED)
        expect(page.get_by_role("alert")).to_have_count(0)
        line.let_flow(True)
        all_arrives(page)
        line.cut()
        expect(page.get_by_role("alert")).to_have_text(LOST)
        comes_back(page)
        expect(note).to_have_count(0)
        assert "Traceback" not in server.log

        server.process.kill()
        server.process.wait()
        expect(page.get_by_role("alert")).to_have_text(LOST)
        with serving(Server(server.command, server.port)):
            comes_back(page)
    watching.errors[:] = [words for words in watching.errors if UNSENT not in words]


def all_arrives(page: Page) -> None:
    """The last position of the slider is drawn and in the address."""
    rest(page)
    wait(page, lambda: shown_extent(page) == value(page, "extent_deg"))


def test_two_processes_on_one_port(watch: tuple[Page, Watch]) -> None:
    page, watching = watch
    compile_once()
    with serving(explorer_server("--num-procs", "2")) as server:
        first_picture(page, server.url)
        works(page)
        works_for_another(page, watching, server)
        comes_back(page)
        assert "Traceback" not in server.log


def test_a_disk_on_which_nothing_can_be_written(page: Page, tmp_path: Path) -> None:
    """Home, program and all else; the folder for temporary files is in memory, as in containers."""
    alone = tmp_path / "package"  # without compiled kernels
    for part in ("bearingcore", "app", "assets"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / part, alone / part, ignore=ignored)
    readonly = mounted(
        "mount --bind / /", "mount -o remount,ro,bind /", "mount -t tmpfs tmpfs /run"
    )
    environment = {
        "PYTHONPATH": f"{alone}:{alone / 'app'}",
        "HOME": str(tmp_path),
        "TMPDIR": "/run",
    }
    with serving(started(readonly, environment)) as server:
        first_picture(page, server.url)
        works(page)
        assert "kept nowhere" in server.log
        assert "Traceback" not in server.log
    assert not list(alone.rglob("*.kernel"))


def test_a_disk_that_is_full_at_the_first_start(page: Page, tmp_path: Path) -> None:
    small = mounted(f"mount -t tmpfs -o size=1m tmpfs {tmp_path}")
    with serving(started(small, {"NUMBA_CACHE_DIR": str(tmp_path)})) as server:
        first_picture(page, server.url)
        works(page)
        wait(page, lambda: "compiled: motion" in server.log)  # the second part
        assert server.log.count("are not kept") == 1, server.log
        assert "No space left" in server.log
        assert "Traceback" not in server.log


@contextmanager
def clock_of(folder: Path) -> Iterator[tuple[dict[str, str], Path]]:
    """An environment in which the time of day is off by what a file says."""
    source, library, offset = (folder / name for name in ("clock.c", "clock.so", "offset"))
    if (compiler := shutil.which("cc")) is None or sys.platform != "linux":
        pytest.skip("a clock that jumps needs a C compiler on Linux")
    source.write_text(CLOCK)
    offset.write_text("0")
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", library, source, "-ldl"], check=True)
    yield {"LD_PRELOAD": str(library), "CLOCK_OFFSET": str(offset)}, offset


def test_a_clock_that_jumps(watch: tuple[Page, Watch], tmp_path: Path) -> None:
    """Open pages go on, none is taken for idle, and new ones open."""
    page, watching = watch
    compile_once()
    with (
        clock_of(tmp_path) as (environment, offset),
        serving(explorer_server("--idle-minutes", "5", environment=environment)) as server,
    ):
        first_picture(page, server.url)
        for days in (-400, 400):
            offset.write_text(str(86400 * days))
            page.wait_for_timeout(6e3)  # what looks for idle pages comes every 5 s
            works(page)
        works_for_another(page, watching, server)
        expect(page.get_by_role("alert")).to_have_count(0)
        assert "Traceback" not in server.log
