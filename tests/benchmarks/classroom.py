"""A classroom: ``python -m tests.benchmarks.classroom`` prints a table.

Thirty sessions come at once and drag for two minutes. Most are websocket clients that act like the
page: they take the document, and ask for the newest position of a slider, never more than two
changes ahead of what is drawn. Two are real browsers. All of them run on this machine and take
their share of its cores, which is printed; a real class brings its own.

The time of an update is that from the change of a slider to the arrival of a packet that holds it
or a newer one, in browsers to the end of the repaint. As the page asks for the newest position
only, and when it is likely to be drawn soon, what a hand feels is longer: from each of its
positions, sixty a second, asked for or not, to a picture of that or a newer one. An update is lost
where the last change of a drag is not drawn within five seconds. Each client has a defect as deep
as no other's; a scene leaks where a picture shows another depth.
"""

import argparse
import asyncio
import itertools
import os
import sys
import threading
import time
from collections import deque
from dataclasses import dataclass, field

import numpy as np
import psutil
from playwright.sync_api import Error, sync_playwright

from tests.benchmarks.latency import WATCH, move_to_and_fro, slider_of
from tests.benchmarks.machine import Pace, pace, worked
from tests.browser.helpers import chromium, explorer_server, serving
from tests.helpers.page_client import PageClient

TAB = "load"
FRAME = 1.0 / 60.0
DRAG, REST = 5.0, 0.5  # [s]
LOST = 5.0  # [s]


@dataclass
class Notes:
    """What one person met; times in seconds of the person's own clock."""

    first_picture: float = float("nan")
    asks: dict[int, float] = field(default_factory=dict)
    """when each change was asked for"""
    moves: list[float] = field(default_factory=list)
    """when the hand moved"""
    pictures: list[tuple[int, float]] = field(default_factory=list)
    """the newest change that each picture shows, and when it came"""
    drags: int = 0
    lost: int = 0
    leaks: int = 0
    troubles: list[str] = field(default_factory=list)

    def waits(self) -> tuple[list[float], list[float]]:
        """Times from changes, and from movements of the hand, to a picture of them [s]."""
        asks, moves = deque(sorted(self.asks.items())), deque(self.moves)
        updates, felt = [], []
        for mark, came in self.pictures:
            while asks and asks[0][0] <= mark:
                _, asked = asks.popleft()
                updates.append(came - asked)
                while moves and moves[0] <= asked:
                    felt.append(came - moves.popleft())
        return updates, felt


class Person:
    """A websocket client that drags."""

    def __init__(self, url: str, number: int) -> None:
        self.notes = Notes()
        self._client = PageClient(url, self._packet)
        self._number = number
        self._settled = False
        self.depth = 20.0 + 2.5 * number  # [micrometres]

    async def come(self) -> None:
        """Open the page, wait for the first picture, and make the scene."""
        began = time.perf_counter()
        try:
            await self._client.connect()
        except ConnectionError as error:
            self.notes.troubles.append(str(error))
            return
        if not await self._client.until_drawn(seconds=120.0):
            self.notes.troubles.append("no first picture")
        self.notes.first_picture = time.perf_counter() - began
        await self._client.show(TAB)
        load = -(40.0 + 3.0 * self._number)
        await self._client.ask(set={"depth_um": self.depth, "fy_n": load, "extent_deg": 20.0})
        self._settled = await self._client.until_drawn(seconds=60.0)

    async def drag(self, seconds: float) -> None:
        """Drag, with short rests, for as long as wanted."""
        end = time.perf_counter() + seconds
        phase = 0.37 * self._number
        while time.perf_counter() < end and not self._client.closed:
            began = time.perf_counter()
            while (now := time.perf_counter()) - began < DRAG and now < end:
                share = abs(((now - began) / 2.0 + phase) % 2.0 - 1.0)
                self.notes.asks[self._client.mark + 1] = now
                await self._client.ask(set={"extent_deg": round(5.0 + 60.0 * share, 2)})
                await asyncio.sleep(FRAME)
                await self._client.turn()
            self.notes.moves += np.arange(began, now, FRAME).tolist()
            phase += 0.61
            self.notes.drags += 1
            if not await self._client.until_drawn(seconds=LOST):
                self.notes.lost += 1
            await asyncio.sleep(REST)

    async def leave(self) -> None:
        """Close the tab."""
        if self._client.closed:
            self.notes.troubles.append("the connection was lost")
        self.notes.troubles += self._client.errors
        await self._client.close()

    def _packet(self, mark: int, now: float) -> None:
        self.notes.pictures.append((mark, now))
        if self._settled:
            surface = self._client.sources["depth_profile_surface"]
            deepest = 1e6 * float(np.nanmax(surface["depth"]))
            self.notes.leaks += not np.isclose(deepest, self.depth, rtol=1e-3)


_FIRST_PAINT = """() => window.__mark !== undefined
  && [...Bokeh.index.query((view) => typeof view._actual_paint === "function")].length > 0"""


def browse(url: str, seconds: float, go: threading.Barrier, notes: Notes) -> None:
    """One real browser with a hand on a slider."""
    try:
        with sync_playwright() as playwright, chromium(playwright) as context:
            page = context.new_page()
            page.on("pageerror", lambda error: notes.troubles.append(str(error)))
            began = time.perf_counter()
            page.goto(f"{url}?v=1&preset=fan-rig&tab={TAB}", timeout=120_000)
            page.wait_for_function(_FIRST_PAINT, timeout=120_000)
            notes.first_picture = time.perf_counter() - began
            page.evaluate(WATCH)
            slider = slider_of(page, "extent_deg")
            go.wait()
            end = time.perf_counter() + seconds
            while time.perf_counter() < end:
                move_to_and_fro(page, slider, DRAG)
                page.mouse.up()
                notes.drags += 1
                try:
                    page.wait_for_function("window.__mark >= window.__asked", timeout=1000.0 * LOST)
                except Error:
                    notes.lost += 1
                time.sleep(REST)
            asks, moves, paints = page.evaluate(
                "() => [window.__asks, window.__moves, window.__paints]"
            )
            notes.asks = {int(mark): 0.001 * at for mark, at in asks.items()}
            notes.moves = [0.001 * at for at in moves]
            notes.pictures = [(mark, 0.001 * at) for mark, at, _ in paints]
    except Error as error:
        notes.troubles.append(str(error))
        go.abort()  # rather than wait for a browser that does not come


def busy() -> float:
    """What all cores of the machine have worked since it started [s]."""
    times = psutil.cpu_times()
    return float(sum(times) - times.idle - getattr(times, "iowait", 0.0))


async def crowd(
    people: list[Person], seconds: float, go: threading.Barrier, server: int
) -> dict[str, float]:
    """All come, then drag together: the cores that each part of the machine has used."""
    await asyncio.gather(*(person.come() for person in people))
    await asyncio.to_thread(go.wait)
    began, before = time.perf_counter(), (worked(server), time.process_time(), busy())
    await asyncio.gather(*(person.drag(seconds) for person in people))
    took, after = time.perf_counter() - began, (worked(server), time.process_time(), busy())
    await asyncio.gather(*(person.leave() for person in people))
    names = ("server", "websocket clients", "all that ran on the machine")
    return {n: (b - a) / took for n, a, b in zip(names, before, after, strict=True)}


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--sessions", type=int, default=30)
    parser.add_argument("--browsers", type=int, default=2, help="of them real")
    parser.add_argument("--seconds", type=float, default=120.0)
    chosen = parser.parse_args()
    quiet = pace()
    browsers = [Notes() for _ in range(chosen.browsers)]
    with serving(explorer_server()) as server:
        go = threading.Barrier(len(browsers) + 1)
        threads = [
            threading.Thread(target=browse, args=(server.url, chosen.seconds, go, notes))
            for notes in browsers
        ]
        for thread in threads:
            thread.start()
        people = [Person(server.url, n) for n in range(chosen.sessions - len(browsers))]
        cores = asyncio.run(crowd(people, chosen.seconds, go, server.process.pid))
        for thread in threads:
            thread.join()
        log = server.log
    print(f"before: {quiet}\nafter:  {pace()}")
    print(
        f"{chosen.sessions} sessions, {len(browsers)} of them browsers, dragging for "
        f"{chosen.seconds:.0f} s; {os.cpu_count()} cores"
    )
    show(quiet, [person.notes for person in people], browsers, chosen.seconds)
    print("cores used: " + ", ".join(f"{name} {used:.2f}" for name, used in cores.items()))
    if "Traceback" in log:
        print("in the server's log:\n" + log[-3000:])
    return 0


def show(quiet: Pace, clients: list[Notes], browsers: list[Notes], seconds: float) -> None:
    """Print the table, and what was lost."""
    everyone = [*clients, *browsers]
    waits = {id(pupil): pupil.waits() for pupil in everyone}
    print(f"{'':<12}{'updates':>9}{'a second':>10}{'median':>9}{'95 %':>9}{'99 %':>9}{'most':>9}")
    for name, group, kind in (
        ("clients", clients, 0),
        ("browsers", browsers, 0),
        ("hands", everyone, 1),
    ):
        times = np.array(list(itertools.chain(*(waits[id(pupil)][kind] for pupil in group))))
        if not times.size:
            continue
        shares = np.percentile(times, [50.0, 95.0, 99.0, 100.0])
        row = "".join(f"{1000.0 * share:>6.0f} ms" for share in shares)
        ratios = ", ".join(quiet.ratio(share) for share in shares[:2])
        print(f"{name:<12}{times.size:>9}{times.size / seconds:>10.0f}{row}   {ratios}")
    firsts = [pupil.first_picture for pupil in everyone]
    print(f"first picture after {np.median(firsts):.1f} s (median), {max(firsts):.1f} s (last)")
    drags, lost = (sum(getattr(pupil, name) for pupil in everyone) for name in ("drags", "lost"))
    leaks = sum(client.leaks for client in clients)
    pictures = sum(len(client.pictures) for client in clients)
    print(f"drags {drags}, lost {lost}; leaks {leaks} in {pictures} pictures")
    for trouble in sorted({t for pupil in everyone for t in pupil.troubles}):
        print(f"trouble: {trouble}")


if __name__ == "__main__":
    sys.exit(main())
