"""Servers that start at once with nothing compiled: ``python -m tests.benchmarks.starting``.

All of them share one empty folder for kernels, compile what they need, and leave it there; then
each draws the loads of the balls, which must be the same, bit for bit. Afterwards one more starts
with the folder as they left it. Printed are seconds until each is ready and has drawn.

With ``--kills 20`` one server at a time is killed at every tenth of the work of a first start, each
with the kernels that those before it have left, and every tenth on an empty folder.
"""

from __future__ import annotations

import argparse
import asyncio
import shutil
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.benchmarks.processor import worked
from tests.browser.helpers import Server, explorer_server
from tests.helpers.page_client import PageClient

PATIENCE = 1800.0  # [s]
SHOWN = "load_distribution_balls"
LAST = "compiled: orbits"


@dataclass(frozen=True)
class Start:
    """How one server began."""

    ready: float  # [s] after all were started
    drawn: float
    picture: dict[str, bytes]
    log: str


async def picture_of(server: Server, begun: float) -> Start:
    """Wait for a server, and for its first picture of the Load tab that it has computed itself.

    What it draws before its kernels are compiled comes with the package, and no slider moves it.
    """
    await asyncio.to_thread(server.wait, PATIENCE)
    ready = time.perf_counter() - begun
    client = PageClient(server.url)
    await client.open_page()
    await client.connect()
    await client.show("load")
    while SHOWN not in client.sources and await client.until_drawn(seconds=PATIENCE):
        await client.news(1.0)
    shipped = picture = _numbers(client)
    while picture == shipped and not client.closed:
        await client.ask(set={"fy_n": -150.0})
        await client.until_drawn(seconds=PATIENCE)
        await client.news(0.2)
        picture = _numbers(client)
    drawn = time.perf_counter() - begun
    await client.close()
    return Start(ready, drawn, picture, server.log)


def _numbers(client: PageClient) -> dict[str, bytes]:
    return {name: values.tobytes() for name, values in client.sources[SHOWN].items()}


def start(count: int, folder: Path) -> list[Start]:
    """Start so many at once, all with one folder for kernels."""
    begun = time.perf_counter()
    servers = [explorer_server(environment={"NUMBA_CACHE_DIR": str(folder)}) for _ in range(count)]

    async def all_of_them() -> Sequence[Start]:
        return await asyncio.gather(*(picture_of(server, begun) for server in servers))

    try:
        return list(asyncio.run(all_of_them()))
    finally:
        for server in servers:
            server.stop()


def work_until(seconds: float, folder: Path) -> tuple[float, str]:
    """Kill a server once it has worked so long or compiled all: what it worked [s], and its log."""
    server = explorer_server(environment={"NUMBA_CACHE_DIR": str(folder)})
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
    """Start, print, and say with the exit code whether all drew the same."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--servers", type=int, default=4)
    parser.add_argument("--kills", type=int, default=0, help="first starts that are killed")
    chosen = parser.parse_args()
    from tests.benchmarks.machine import pace

    print(pace())
    with tempfile.TemporaryDirectory(prefix="kernels-") as name:
        folder = Path(name)
        killed = kill(chosen.kills, folder) if chosen.kills else []
        first = start(chosen.servers, folder)
        print(f"{'':<24}{'ready after':>14}{'drawn after':>14}")
        for number, one in enumerate(first, 1):
            print(
                f"{f'server {number} of {len(first)}':<24}{one.ready:>12.1f} s{one.drawn:>12.1f} s"
            )
        size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
        again = start(1, folder)[0]
        print(f"{'another, afterwards':<24}{again.ready:>12.1f} s{again.drawn:>12.1f} s")
    same = all(one.picture == again.picture for one in first) and bool(again.picture)
    print(f"kernels: {size / 1e6:.1f} MB; pictures {'all the same' if same else 'DIFFER'}")
    logs = [*killed, *(one.log for one in [*first, again])]
    troubled = [log for log in logs if "Traceback" in log]
    print(*troubled, pace(), sep="\n")
    return int(not same or bool(troubled))


if __name__ == "__main__":
    sys.exit(main())
