"""From slider to pixels: ``python -m tests.benchmarks.latency`` prints a table.

The explorer in a process of its own, headless Chromium beside it, both on this machine's cores.

A step is the time from a slider's event to the end of the last repaint that shows it: every packet
carries the number of the newest change, and the browser's paint is wrapped to note which number it
painted. Views without figures count as drawn in the first frame after the packet. "Median" stands
also as a multiple of what the C loop of 1.4 s of motion takes just before (`machine`).

A drag moves the mouse for some seconds, 60 times a second, as often as a screen shows it; it gives
frames a second and the tail, the time from the release to the last repaint of the picture that
follows the hand. "Work" is what browser and server have worked for a frame of the drag, by the
system's count of processor time: two cores have 67 ms of it for each of 30 frames a second, whoever
else is on them.
"""

import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from playwright.sync_api import Locator, Page, sync_playwright

from tests.benchmarks.machine import pace, worked_by_kind
from tests.browser.helpers import choose_tab, chromium, explorer_server, serving, unfold

STATIC, MOVING = 50.0, 100.0
"""Targets of a step's median [ms]: static views and traces, and what shows motion."""


@dataclass(frozen=True)
class Case:
    """A tab, a slider that is moved on it, and the target of a step [ms]."""

    tab: str
    slider: str
    target: float = STATIC


CASES = (
    Case("overview", "extent_deg", MOVING),
    Case("overview", "fy_n", MOVING),
    Case("overview", "cage_angle_deg", MOVING),
    Case("load", "extent_deg"),
    Case("load", "depth_um"),
    Case("load", "cage_angle_deg"),
    Case("stiffness", "extent_deg"),
    Case("stiffness", "fy_n"),
    Case("stiffness", "cage_angle_deg"),
    Case("maps", "extent_deg", MOVING),
    Case("maps", "fy_n", MOVING),
    Case("modes", "extent_deg"),
    Case("vibration", "extent_deg", MOVING),
    Case("vibration", "fy_n", MOVING),
    Case("over-speed", "extent_deg", MOVING),
    Case("accuracy", "extent_deg"),
    Case("bearing", "ball_diameter_mm"),
    Case("model", "inner_mass", MOVING),
)

WATCH = (Path(__file__).parent / "watch_paints.js").read_text(encoding="utf-8")

_STEP = """(slider, value) => new Promise((resolve) => {
  window.__paints.length = 0
  slider.value = value
  const began = performance.now()
  slider.dispatchEvent(new Event("input"))
  const asked = window.__asked
  const look = () => {
    const mine = window.__paints.filter(([mark]) => mark >= asked)
    const quiet = mine.length && performance.now() - mine.at(-1)[1] > 150
    if (quiet || performance.now() - began > 5000)
      resolve([
        mine.length ? mine.at(-1)[1] - began : null,
        mine.reduce((sum, [, , took]) => sum + took, 0),
      ])
    else setTimeout(look, 20)
  }
  look()
})"""


def slider_of(page: Page, name: str) -> Locator:
    """A slider that is to be seen."""
    return page.locator(f"#control-{name}:visible").first


def steps(slider: Locator, count: int) -> list[tuple[float, float]]:
    """Times of steps and of their paints [ms], each left to finish, never two to one place."""
    low, high = slider.evaluate("slider => [Number(slider.min), Number(slider.max)]")
    times = []
    for index in range(count):
        share = 0.12 + 0.8 * ((index * 0.381966) % 1.0)
        step, paint = slider.evaluate(_STEP, low + share * (high - low))
        if step is None:
            raise RuntimeError("a step painted nothing")
        times.append((step, paint))
    return times


STEPS, SECONDS = 20, 3.0
"""Steps of each slider, and how long it is dragged [s]."""
HAND = 60.0
"""Movements of the mouse a second."""
WORK = 60.0
"""Target of the work for a frame [ms]."""


class Drag(NamedTuple):
    """Frames a second, the tail [ms], and the work of browser and server for a frame [ms]."""

    frames: float
    tail: float
    browser: float
    server: float


def move_to_and_fro(page: Page, slider: Locator, seconds: float) -> None:
    """Take the thumb of a slider and move it, not letting go."""
    slider.evaluate("slider => slider.scrollIntoView({block: 'center'})")  # from under what sticks
    box = slider.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.15 * box["width"], y)
    page.mouse.down()
    began, moves = time.perf_counter(), 0
    while (passed := time.perf_counter() - began) < seconds:
        share = 0.15 + 0.7 * abs((passed / 2.0) % 2.0 - 1.0)
        page.mouse.move(box["x"] + share * box["width"], y)
        moves += 1
        time.sleep(max(0.0, began + moves / HAND - time.perf_counter()))


def drag(page: Page, slider: Locator, seconds: float, server: int) -> Drag:
    """Drag to and fro; `server` is the number of its process."""
    page.evaluate("() => { window.__paints.length = 0 }")
    before = worked_by_kind(server)
    move_to_and_fro(page, slider, seconds)
    after = worked_by_kind(server)
    page.mouse.up()
    released = page.evaluate("() => performance.now()")
    page.wait_for_timeout(1500)
    asked, paints = page.evaluate("() => [window.__asked, window.__paints]")
    drawn = {mark for mark, at, *_ in paints if at <= released}
    # the last picture that follows the hand: what comes after a pause is drawn by plan
    final = [at for mark, at, *_ in paints if mark >= asked]
    end = released
    for at in final:
        if at > max(end, final[0]) + 150.0:
            break
        end = max(end, at)
    work = {kind: 1e3 * (after[kind] - before[kind]) / max(len(drawn), 1) for kind in after}
    return Drag(len(drawn) / seconds, end - released, work["browser"], work["server"])


def measure(page: Page, case: Case, server: int) -> str:
    """The line of one case."""
    choose_tab(page, case.tab)
    page.wait_for_function(f"window.__tab == '{case.tab}'", timeout=120_000)
    page.wait_for_timeout(1000)
    unfold(page)  # every slider is to be seen
    page.evaluate(WATCH)
    machine = pace()
    slider = slider_of(page, case.slider)
    times, paints = np.transpose(steps(slider, 3 + STEPS)[3:])
    moved = drag(page, slider, SECONDS, server)
    median, late = np.quantile(times, [0.5, 0.95])
    slow, busy = median > case.target, moved.browser + moved.server > WORK
    return (
        f"{case.tab:<11}{case.slider:<17}{median:>6.0f} ms{machine.ratio(0.001 * median):>8}"
        f"{late:>6.0f} ms{case.target:>6.0f} ms"
        f"{np.median(paints):>6.1f} ms{moved.frames:>5.0f} fps{moved.tail:>6.0f} ms"
        f"{moved.browser:>6.0f} +{moved.server:>4.0f} ms"
        f"{'  over' if slow else ''}{'  works' if busy else ''}"
        f"   {1e3 * machine.statics:.2f}, {1e3 * machine.motion:.1f} ms"
    )


def main() -> int:
    """Measure and print."""
    failed = False
    with (
        serving(explorer_server()) as server,
        sync_playwright() as playwright,
        chromium(playwright) as context,
    ):
        for preset in ("fan-rig", "liew-lim"):
            page = context.new_page()
            page.goto(server.url)
            page.wait_for_function("window.__frames >= 1", timeout=60000)
            print(
                f"{preset}\n{'on screen':<11}{'slider':<17}{'median':>9}{'':>8}{'95 %':>9}"
                f"{'target':>9}{'paint':>9}{'drag':>9}{'tail':>9}{'work':>15}   C loops"
            )
            for case in CASES:
                # each begins with the same scene, whatever the one before has made of it
                page.goto(f"{server.url}?v=1&preset={preset}&tab={case.tab}")
                page.wait_for_function("window.__frames >= 1", timeout=60000)
                try:
                    line = measure(page, case, server.process.pid)
                except RuntimeError as error:
                    line = f"{case.tab:<11}{case.slider:<17}failed: {error}"
                    failed = True
                print(line, flush=True)
            page.close()
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
