"""Faults of servers and disks, as the real page gets through them.

``pytest -n 0 -m proof -v tests/browser/test_faults.py`` is the list of what operators are promised;
``python -m tests.benchmarks.starting --kills 20`` ends first starts at every tenth.
"""

import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import can_be_used, rest, settle, show, slider, value, wait
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
from tests.browser.test_first_minute import samples
from tests.helpers.compiled import compile_once

pytestmark = pytest.mark.proof

STOPPED = 8.0  # [s], twice what the page waits before it says that nothing answers
LOST = "The connection to the server is lost. Reload the page to go on."
SILENT = "The server does not answer. What you change is drawn as soon as it does."
UNSENT = "not connected so cannot send"  # Bokeh, of what is moved when the line is cut


def first_picture(page: Page, url: str) -> None:
    page.goto(url)
    can_be_used(page)


def works(page: Page) -> None:
    """A slider is dragged and another tab opened, and both are drawn."""
    before = page.evaluate("window.__mark || 0")
    drag(page, slider(page, "extent_deg"), 0.2, 0.5)
    page.wait_for_function("before => window.__mark > before", arg=before)
    settle(page)
    show(page, "stiffness")
    expect(page.locator(".view-stiffness canvas").first).to_be_visible()
    wait(page, lambda: shown_extent(page) == value(page, "extent_deg"))


def shown_extent(page: Page) -> float | None:
    """The extent in the address, which is that of the scene that the server has."""
    extent: str | None = page.evaluate("new URLSearchParams(location.search).get('extent_deg')")
    return None if extent is None else float(extent)


def comes_back(page: Page) -> None:
    """Loaded again, the page has the scene that it had."""
    extent = value(page, "extent_deg")
    wait(page, lambda: shown_extent(page) == extent)
    first_picture(page, page.url)
    assert value(page, "extent_deg") == extent
    expect(page.get_by_role("alert")).to_have_count(0)
    works(page)


def test_a_server_that_stands_still_and_one_that_is_started_anew(watch: tuple[Page, Watch]) -> None:
    """Changes on their way arrive later; where the connection ends, the page says so."""
    page, watching = watch
    compile_once()
    with serving(explorer_server()) as server:
        assert samples(page, server) == [], "from the first frame of a cold start on"
        can_be_used(page)
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
        rest(page)
        wait(page, lambda: shown_extent(page) == value(page, "extent_deg"))
        expect(note).to_have_count(0)
        assert "Traceback" not in server.log

        server.process.kill()
        server.process.wait()
        expect(page.get_by_role("alert")).to_have_text(LOST)
        with serving(Server(server.command, server.port)):
            comes_back(page)
    watching.errors[:] = [words for words in watching.errors if UNSENT not in words]


def test_a_disk_on_which_nothing_can_be_written(page: Page, tmp_path: Path) -> None:
    """Home, program and all else; the folder for temporary files is in memory, as in containers."""
    if sys.platform != "linux" or subprocess.run(["unshare", "-m", "true"]).returncode:
        pytest.skip("file systems of a process's own need Linux and its administrator")
    alone = tmp_path / "package"  # without compiled kernels
    for part in ("bearingcore", "app", "assets"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / part, alone / part, ignore=ignored)
    mounts = "mount --bind / / && mount -o remount,ro,bind / && mount -t tmpfs tmpfs /run"
    environment = {
        "PYTHONPATH": f"{alone}:{alone / 'app'}",
        "HOME": str(tmp_path),
        "TMPDIR": "/run",
    }
    port = free_port()
    start = ["unshare", "-m", "sh", "-c", f'{mounts} && exec "$@"', "sh", sys.executable, "-BP"]
    start += ["-m", "bearing_explorer", "--no-browser", "--port", str(port)]
    with serving(Server(start, port, environment=environment)) as server:
        first_picture(page, server.url)
        works(page)
        assert "cannot be kept" in server.log
        assert "Traceback" not in server.log
    assert not list(alone.rglob("*.kernel"))
