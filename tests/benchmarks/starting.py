"""Seconds from the command to the first picture: ``python -m tests.benchmarks.starting``.

A first start, with an empty folder for machine code, and one more with what that has left; a real
browser comes as soon as the port answers, and moves a slider once all is compiled. Next to the
clock stands what server and browser have worked until then, which other work on the machine changes
little, and its ratio to the C loop of statics.

With ``--kills 20`` one server at a time is killed at every tenth of the work of a first start, each
with the kernels that those before it have left, and every tenth on an empty folder; then comes a
start with what the last of them has left. The exit code says whether a log held a traceback.
"""

import argparse
import shutil
import socket
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from playwright.sync_api import BrowserContext, sync_playwright

from tests.benchmarks.latency import slider_of
from tests.benchmarks.machine import Pace, pace, worked, worked_by_kind
from tests.browser.explorer_page import settle
from tests.browser.helpers import Server, chromium, drag, explorer_server

PATIENCE = 600.0  # [s]
LAST = "compiled: orbits"


def server_on(folder: Path) -> Server:
    """A server that keeps its machine code in a folder."""
    return explorer_server(environment={"NUMBA_CACHE_DIR": str(folder)})


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


def start(browser: BrowserContext, folder: Path, now: Pace) -> str:
    """Start a server, look at its page, print when it was there, use it; the server's log."""
    page = browser.new_page()
    page.set_default_timeout(1e3 * PATIENCE)
    begun = time.perf_counter()
    server = server_on(folder)
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
        while LAST not in server.log:
            time.sleep(0.1)
        line("all compiled")
        drag(page, slider_of(page, "extent_deg"), 0.2, 0.5)
        settle(page)
    finally:
        server.stop()
        page.close()
    return server.log


def work_until(seconds: float, folder: Path) -> tuple[float, str]:
    """Kill a server once it has worked so long or compiled all: what it worked [s], and its log."""
    server = server_on(folder)
    while worked(server.process.pid) < seconds and LAST not in server.log:
        time.sleep(0.05)
    took = worked(server.process.pid)
    server.process.kill()
    server.process.wait()
    return took, server.log


def kill(count: int, folder: Path) -> list[str]:
    """Kill so many servers and leave the folder as the last of them left it; logs of all."""
    whole, log = work_until(PATIENCE, folder)
    logs = [log]
    print(f"a first start works {whole:.1f} s; killed:")
    for number in range(count):
        tenth = number % 10 + 1
        if tenth == 1:
            shutil.rmtree(folder)
            folder.mkdir()
        took, log = work_until(0.1 * tenth * whole, folder)
        kept = len(list(folder.rglob("*.kernel")))
        partial = len(list(folder.rglob("*.kernel.*")))
        print(f"  after {took:5.1f} s, {kept} kernels kept, {partial} partial", flush=True)
        logs.append(log)
    return logs


def main() -> int:
    """Start, print, and say with the exit code whether all went well."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--kills", type=int, default=0, help="first starts that are killed")
    chosen = parser.parse_args()
    with (
        tempfile.TemporaryDirectory(prefix="kernels-") as name,
        sync_playwright() as playwright,
        chromium(playwright) as browser,
    ):
        folder = Path(name)
        logs = kill(chosen.kills, folder) if chosen.kills else []
        for which in ("after the kills",) if chosen.kills else ("first start", "later start"):
            now = pace()
            print(f"{which}; {now}")
            logs.append(start(browser, folder, now))
    troubled = [log for log in logs if "Traceback" in log]
    print(*troubled, sep="\n")
    return int(bool(troubled))


if __name__ == "__main__":
    sys.exit(main())
