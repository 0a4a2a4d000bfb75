"""Seconds from the command to the first picture: ``python -m tests.benchmarks.first_picture``.

A first start, with an empty folder for machine code, and one more with what that has left; a real
browser comes as soon as the port answers. Next to the clock stands what server and browser have
worked until then, which other work on the machine changes little, and its ratio to the C loop of
statics.
"""

from __future__ import annotations

import socket
import tempfile
import time
from contextlib import suppress

from playwright.sync_api import BrowserContext, sync_playwright

from tests.benchmarks.machine import Pace, pace
from tests.benchmarks.processor import worked_by_kind
from tests.browser.helpers import Server, chromium, explorer_server

PATIENCE = 600.0  # [s]


def wait_for_port(server: Server) -> None:
    """Wait until the server listens."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        with suppress(OSError), socket.create_connection(("localhost", server.port), 1.0):
            return
        time.sleep(0.02)
    raise TimeoutError(server.log)


def work(server: Server) -> float:
    """What server and browser have worked [s]."""
    kinds = worked_by_kind(server.process.pid)
    return kinds["server"] + kinds["browser"]


def start(browser: BrowserContext, folder: str, now: Pace) -> None:
    """Start a server, look at its page, and print when it was there."""
    page = browser.new_page()
    page.set_default_timeout(1e3 * PATIENCE)
    begun = time.perf_counter()
    server = explorer_server(environment={"NUMBA_CACHE_DIR": folder})
    before = work(server)

    def line(what: str) -> None:
        clock, worked = time.perf_counter() - begun, work(server) - before
        ratio = f"{worked / now.statics:,.0f} times the C loop of statics"
        print(
            f"  {what:<14}{clock:7.1f} s by the clock{worked:7.1f} s of work, {ratio}", flush=True
        )

    try:
        wait_for_port(server)
        line("port")
        page.goto(server.url, wait_until="commit")
        line("page")
        page.wait_for_function("window.__frames >= 1", polling=20)
        line("first picture")
        while "compiled: orbits" not in server.log:  # for the later start
            time.sleep(0.1)
    finally:
        server.stop()
        page.close()


def main() -> None:
    """Both starts."""
    with (
        tempfile.TemporaryDirectory(prefix="kernels-") as folder,
        sync_playwright() as playwright,
        chromium(playwright) as browser,
    ):
        for which in ("first start", "later start"):
            now = pace()
            print(f"{which}; {now}")
            start(browser, folder, now)


if __name__ == "__main__":
    main()
