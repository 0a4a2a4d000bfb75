"""A classroom: ``python -m tests.benchmarks.classroom`` prints a table.

Thirty sessions come at once and drag for two minutes. Most are websocket clients that act like the
page: they take the document, and ask for the newest position of a slider, never more than two
changes ahead of what is drawn. Two are real browsers. All of them run on this machine and take
their share of its cores, which is printed; a real class brings its own.

The time of an update is that from the change of a slider to the arrival of a packet that holds it
or a newer one, in browsers to the end of the repaint. As the page asks for the newest position
only, and when it is likely to be drawn soon, what a hand feels is longer: from each of its
positions, sixty a second, asked for or not, to a picture of that or a newer one. An update is lost
where the last change of a drag is not drawn within five seconds. Each person has a defect as deep
and a load as high as nobody else's; every picture is looked at for the depth, and every 50th is
computed anew here and compared number by number. A scene leaks where anything else comes back.
"""

from __future__ import annotations

import argparse
import asyncio
import math
import os
import sys
import threading
import time
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Error, sync_playwright

from tests.benchmarks.machine import Pace, pace
from tests.benchmarks.processor import TICKS, resident, started_by, worked
from tests.browser.helpers import chromium, explorer_server, free_port, serving
from tests.helpers.balancer import balanced
from tests.helpers.page_client import PageClient

FRAME = 1.0 / 60.0
DRAG, REST = 5.0, 0.5  # [s]
LOST = 5.0  # [s]
CHECKED = 50  # every how many-th picture is computed anew
#: what is drawn here depends on what was drawn before, as axes do that move seldom; so do the
#: lengths of arrows in the drawing of the bearing
REMEMBERING = {("depth_profile_surface", "bottom")}


@dataclass
class Notes:
    """What one person met."""

    first_picture: float = float("nan")
    times: list[float] = field(default_factory=list)
    felt: list[float] = field(default_factory=list)
    drags: int = 0
    lost: int = 0
    leaks: int = 0
    compared: list[tuple[dict[str, float], dict[str, dict[str, np.ndarray]]]] = field(
        default_factory=list
    )
    troubles: list[str] = field(default_factory=list)


class Person:
    """A websocket client that drags."""

    def __init__(self, url: str, number: int, tab: str) -> None:
        self.notes = Notes()
        self._tab = tab
        self._client = PageClient(url, self._packet)
        self._number = number
        self._asked: dict[int, float] = {}
        self._values: dict[int, dict[str, float]] = {}
        self._pictures = 0
        self._felt_until = math.inf
        self._seen = 0
        self.depth = 20.0 + 2.5 * number  # [micrometres], nobody else's
        self.load = -(40.0 + 3.0 * number)  # [N]

    async def come(self) -> None:
        """Open the page and wait for the first picture."""
        began = time.perf_counter()
        status = await self._client.open_page()
        if status != 200:
            self.notes.troubles.append(f"the page answered {status}")
            return
        await self._client.connect()
        if not await self._client.until_drawn(seconds=120.0):
            self.notes.troubles.append("no first picture")
        self.notes.first_picture = time.perf_counter() - began
        await self._client.show(self._tab)
        await self._ask({"depth_um": self.depth, "fy_n": self.load, "extent_deg": 20.0})
        await self._client.until_drawn(seconds=60.0)

    async def drag(self, seconds: float) -> None:
        """Drag, with short rests, for as long as told."""
        end = time.perf_counter() + seconds
        phase = 0.37 * self._number
        while time.perf_counter() < end and not self._client.closed:
            began = self._felt_until = time.perf_counter()
            while (now := time.perf_counter()) - began < DRAG and now < end:
                share = abs(((now - began) / 2.0 + phase) % 2.0 - 1.0)
                await self._ask({"extent_deg": round(5.0 + 60.0 * share, 2)})
                await asyncio.sleep(FRAME)
                await self._client.turn()
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

    async def _ask(self, values: dict[str, float]) -> None:
        mark = self._client.mark + 1
        self._asked[mark] = time.perf_counter()
        self._values[mark] = {**self._values.get(mark - 1, {}), **values}
        await self._client.ask(set=values)

    def _packet(self, mark: int, now: float) -> None:
        for asked in [m for m in self._asked if m <= mark]:
            then = self._asked.pop(asked)
            self.notes.times.append(now - then)
            if then > self._felt_until:
                self.notes.felt += [now - t for t in np.arange(then, self._felt_until, -FRAME)]
                self._felt_until = then
        values = self._values.get(mark)
        if values is None or mark <= self._seen:
            return  # the same scene once more, drawn as planned for a hand that rests
        self._seen = mark
        for old in [m for m in self._values if m < mark]:
            del self._values[old]
        self._pictures += 1
        surface = self._client.sources.get("depth_profile_surface")
        deepest = float(np.nanmax(surface["depth"])) if surface is not None else 0.0
        self.notes.leaks += not np.isclose(1e6 * deepest, values["depth_um"], rtol=1e-3)
        if self._pictures % CHECKED == 0:
            shown = {
                name: {k: v.copy() for k, v in columns.items()}
                for name, columns in self._client.sources.items()
            }
            self.notes.compared.append((dict(values), shown))


def _unlike(picture: Any, shown: dict[str, dict[str, Any]]) -> int:
    """How many columns of a picture did not come as they are here."""
    return sum(
        not np.array_equal(np.asarray(column, np.float32).ravel(), shown[source][name], True)
        for drawing in picture.drawings
        for source, columns in drawing.data[0].items()
        for name, column in columns.items()
        if (source, name) not in REMEMBERING and not source.startswith("bearing_")
    )


def differences(notes: Notes, tab: str) -> int:
    """How many of the pictures kept are not those of their scene."""
    from bearing_explorer.page import SECTIONS
    from bearing_explorer.pictures import picture_of
    from bearing_explorer.results.results import Results
    from bearing_explorer.serve.packed_source import PackedSource
    from bearing_explorer.state.scene_editor import SceneEditor

    packed = PackedSource()
    views = [view(packed) for s in SECTIONS if s.name == tab for view in s.views]
    wrong = 0
    for values, shown in notes.compared:
        editor = SceneEditor("fan-rig")
        for name, value in values.items():
            editor.set({name: value})
        # drawn while the slider moves, or finely after it
        wrong += min(
            _unlike(picture_of(Results(editor.scene, 0.0, moving=moving), views), shown)
            for moving in (True, False)
        )
    return wrong


# Real browsers

_FIRST_PAINT = """() => window.__mark !== undefined
  && [...Bokeh.index.query((view) => typeof view._actual_paint === "function")].length > 0"""
_NOTE_TIMES = """() => {
  window.__times = {}
  let asked = window.__asked || 0
  Object.defineProperty(window, "__asked", {
    get: () => asked,
    set: (mark) => { asked = mark; window.__times[mark] = performance.now() },
  })
  window.__updates = []
  window.__felt = []
  let moves = []
  window.addEventListener("input", () => moves.push(performance.now()), true)
  const seen = (mark, now) => {
    for (const m of Object.keys(window.__times))
      if (Number(m) <= mark) {
        const asked = window.__times[m]
        window.__updates.push(now - asked)
        window.__felt.push(...moves.filter((moved) => moved <= asked).map((moved) => now - moved))
        moves = moves.filter((moved) => moved > asked)
        delete window.__times[m]
      }
  }
  const wrapped = new Set()
  for (const view of Bokeh.index.query(() => true)) {
    if (typeof view._actual_paint !== "function") continue
    let owner = view
    while (owner && !Object.hasOwn(owner, "_actual_paint")) owner = Object.getPrototypeOf(owner)
    if (!owner || wrapped.has(owner)) continue
    wrapped.add(owner)
    const paint = owner._actual_paint
    owner._actual_paint = function (...rest) {
      const mark = window.__mark, result = paint.apply(this, rest)
      seen(mark, performance.now())
      return result
    }
  }
}"""


def browse(url: str, seconds: float, go: Any, found: list[Notes], tab: str) -> None:
    """One real browser with a hand on a slider."""
    notes = Notes()
    found.append(notes)
    try:
        with sync_playwright() as playwright, chromium(playwright) as context:
            page = context.new_page()
            page.on("pageerror", lambda error: notes.troubles.append(str(error)))
            began = time.perf_counter()
            page.goto(f"{url}?v=1&preset=fan-rig&tab={tab}", timeout=120_000)
            page.wait_for_function(_FIRST_PAINT, timeout=120_000)
            notes.first_picture = time.perf_counter() - began
            page.evaluate(_NOTE_TIMES)
            thumb = page.locator("#control-extent_deg")
            box = thumb.bounding_box()
            assert box is not None
            y = box["y"] + box["height"] / 2
            go.wait()
            end = time.perf_counter() + seconds
            while time.perf_counter() < end:
                began = time.perf_counter()
                page.mouse.move(box["x"] + 0.2 * box["width"], y)
                page.mouse.down()
                while (passed := time.perf_counter() - began) < DRAG:
                    share = 0.2 + 0.7 * abs((passed / 2.0) % 2.0 - 1.0)
                    page.mouse.move(box["x"] + share * box["width"], y)
                    time.sleep(FRAME)
                page.mouse.up()
                notes.drags += 1
                try:
                    page.wait_for_function("window.__mark >= window.__asked", timeout=1000.0 * LOST)
                except Error:
                    notes.lost += 1
                time.sleep(REST)
            notes.times = [0.001 * t for t in page.evaluate("window.__updates")]
            notes.felt = [0.001 * t for t in page.evaluate("window.__felt")]
    except Error as error:
        notes.troubles.append(str(error))


# The machine


def busy_seconds() -> float:
    """What all cores of the machine have worked since it started [s]."""
    user, nice, system, _, _, *rest = map(int, Path("/proc/stat").read_text().split()[1:11])
    return (user + nice + system + sum(rest[:2])) / TICKS


async def _crowd(
    people: list[Person], seconds: float, go: Any, server: list[int]
) -> dict[str, float]:
    await asyncio.gather(*(person.come() for person in people))
    together = sum(map(resident, server))
    while go.parties > 1 and go.n_waiting < go.parties - 1:
        await asyncio.sleep(0.2)
    if go.parties > 1:
        await asyncio.to_thread(go.wait)
    began, used, mine = time.perf_counter(), sum(map(worked, server)), time.process_time()
    busy = busy_seconds()
    await asyncio.gather(
        *(person.drag(seconds) for person in people),
    )
    took = time.perf_counter() - began
    return {
        "memory": together,
        "memory_after": sum(map(resident, server)),
        "server": (sum(map(worked, server)) - used) / took,
        "clients": (time.process_time() - mine) / took,
        "all": (busy_seconds() - busy) / took,
        "took": took,
    }


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--sessions", type=int, default=30)
    parser.add_argument("--browsers", type=int, default=2, help="of them real")
    parser.add_argument("--seconds", type=float, default=120.0)
    parser.add_argument("--tab", default="load", help="that all look at")
    parser.add_argument("--num-procs", type=int, default=1, help="that share a port")
    parser.add_argument(
        "--behind", type=int, default=0, help="so many explorers with a balancer before them"
    )
    parser.add_argument("--leave", type=float, default=45.0, help="wait after they left [s]")
    chosen = parser.parse_args()
    options = ("--num-procs", str(chosen.num_procs)) if chosen.num_procs > 1 else ()
    fronted = chosen.behind > 0
    found: list[Notes] = []
    machine_before = pace()
    with ExitStack() as stack:
        balancer = free_port()
        if fronted:
            options = ("--allow-websocket-origin", f"localhost:{balancer}")
        servers = [
            stack.enter_context(serving(explorer_server(*options)))
            for _ in range(max(chosen.behind, 1))
        ]
        url = servers[0].url
        if fronted:
            stack.enter_context(balanced([server.port for server in servers], port=balancer))
            url = f"http://localhost:{balancer}/"
        first = [server.process.pid for server in servers]
        pids = [*first, *(pid for one in first for pid in started_by(one))]
        before = sum(map(resident, pids))
        go = threading.Barrier(chosen.browsers + 1)
        threads = [
            threading.Thread(target=browse, args=(url, chosen.seconds, go, found, chosen.tab))
            for _ in range(chosen.browsers)
        ]
        for thread in threads:
            thread.start()
        people = [Person(url, n, chosen.tab) for n in range(chosen.sessions - chosen.browsers)]

        async def class_of() -> dict[str, float]:
            return await _crowd(people, chosen.seconds, go, pids)

        async def all_leave() -> None:
            await asyncio.gather(*(person.leave() for person in people))

        with asyncio.Runner() as runner:
            machine = runner.run(class_of())
            for thread in threads:
                thread.join()
            runner.run(all_leave())
            time.sleep(chosen.leave)
            left = sum(map(resident, pids))
        log = "".join(server.log for server in servers)
    print(f"before: {machine_before}\nafter:  {pace()}")
    _print(
        machine_before, chosen, [person.notes for person in people], found, machine, before, left
    )
    if "Traceback" in log:
        print("in the server's log:\n" + log[-3000:])
    return 0


def _print(
    quiet: Pace,
    chosen: argparse.Namespace,
    clients: list[Notes],
    browsers: list[Notes],
    machine: dict[str, float],
    before: float,
    left: float,
) -> None:
    print(
        f"{chosen.sessions} sessions, {len(browsers)} of them browsers, dragging for "
        f"{machine['took']:.0f} s; {os.cpu_count()} cores, {chosen.num_procs} process(es)"
        + (f" behind a balancer: {chosen.behind}" if chosen.behind else "")
    )
    print(f"{'':<12}{'updates':>9}{'a second':>10}{'median':>9}{'95 %':>9}{'99 %':>9}{'most':>9}")
    everyone = [*clients, *browsers]
    for name, found in (
        ("clients", [one.times for one in clients]),
        ("browsers", [one.times for one in browsers]),
        ("hands", [one.felt for one in everyone]),
    ):
        times = np.array([t for one in found for t in one])
        if not times.size:
            continue
        shares = np.percentile(1000.0 * times, [50.0, 95.0, 99.0, 100.0])
        row = "".join(f"{share:>6.0f} ms" for share in shares)
        beside = ", ".join(quiet.ratio(0.001 * share) for share in shares[:2])
        print(f"{name:<12}{times.size:>9}{times.size / machine['took']:>10.0f}{row}   {beside}")
    wrong = sum(differences(one, chosen.tab) for one in clients)
    firsts = sorted(one.first_picture for one in everyone)
    print(
        f"first picture after {firsts[len(firsts) // 2]:.1f} s (median), {firsts[-1]:.1f} s (last)"
    )
    print(f"drags {sum(one.drags for one in everyone)}, lost {sum(one.lost for one in everyone)}")
    checked = sum(len(one.compared) for one in clients)
    leaks = sum(one.leaks for one in clients)
    print(f"leaks {leaks}; {checked} pictures computed anew, {wrong} differ")
    each = (machine["memory"] - before) / chosen.sessions
    print(
        f"memory {before:.0f} MB before, {machine['memory']:.0f} MB with all ({each:.1f} MB each), "
        f"{machine['memory_after']:.0f} MB after dragging, {left:.0f} MB after they left"
    )
    print(
        f"cores used: server {machine['server']:.2f}, websocket clients {machine['clients']:.2f}, "
        f"all that ran on the machine {machine['all']:.2f}"
    )
    for trouble in sorted({t for one in everyone for t in one.troubles}):
        print(f"trouble: {trouble}")


if __name__ == "__main__":
    sys.exit(main())
