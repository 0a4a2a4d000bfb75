"""From slider to pixels: ``python -m tests.benchmarks.latency`` prints a table.

The explorer in a process of its own, headless Chromium beside it, both on this machine's cores.

A step is the time from a slider's event to the end of the last repaint of a view that shows it:
every packet carries the number of the newest change, and the browser's paint is wrapped to note
which number and which view it painted. Views without figures count as drawn in the first frame
after the packet. A drag moves the mouse for some seconds; it gives frames a second and the tail,
the time from the release to the last repaint of the picture that follows the hand. When the hand
rests, the program draws finely: "planned" is when that is on screen, after the event.
"Disturbed" is a step that comes while that is being computed. "Median" stands also as a multiple of
what the C loop of 1.4 s of motion takes just before (`machine`).

The mouse moves 60 times a second, as often as a screen shows it. "Work" is what browser and server
have worked for a frame of the drag, by the system's count of processor time: two cores have 67 ms
of it for each of 30 frames a second, whoever else is on them.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from dataclasses import dataclass
from typing import Any

from playwright.sync_api import Page, sync_playwright

from tests.benchmarks.machine import pace
from tests.benchmarks.processor import worked_by_kind
from tests.browser.helpers import chromium, explorer_server, serving, unfold

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
    Case("orbits", "extent_deg", MOVING),
    Case("accuracy", "extent_deg"),
    Case("bearing", "ball_diameter_mm"),
    Case("model", "inner_mass", MOVING),
)

_WATCH_PAINTS = """() => {
  window.__paints ??= []
  const wrapped = (window.__wrapped ??= new Set())
  const where = (element) => {
    for (let node = element; node; node = node.parentNode ?? node.host) {
      const named = [...(node.classList ?? [])].find((name) => name.startsWith("view-"))
      if (named) return named.slice(5)
    }
    return ""
  }
  const wrap = (view) => {
    if (view.model?.type === "Figure" || typeof view._actual_paint === "function") {
      let owner = view
      while (owner && !Object.hasOwn(owner, "_actual_paint")) owner = Object.getPrototypeOf(owner)
      if (owner && !wrapped.has(owner)) {
        wrapped.add(owner)
        const paint = owner._actual_paint
        owner._actual_paint = function (...rest) {
          const began = performance.now(), mark = window.__mark
          const result = paint.apply(this, rest)
          const view = (this.__view ??= where(this.el))
          window.__paints.push([mark, performance.now(), performance.now() - began, view])
          return result
        }
      }
    }
  }
  for (const view of Bokeh.index.query(() => true)) wrap(view)
  if (!window.__frame_watch) {
    window.__frame_watch = true
    let seen = -1
    // asked for by each picture: a watch that looks at every frame of the screen is work too
    window.addEventListener("explorer-drawn", () => {
      if (window.__mark === seen) return
      const mark = seen = window.__mark
      requestAnimationFrame(() => window.__paints.push([mark, performance.now(), 0, ""]))
    })
  }
  return wrapped.size
}"""

_FIND = """(name) => {
  const find = (root) => {
    const found = root.querySelector(`#control-${name}`)
    if (found && found.getClientRects().length) return found
    for (const node of root.querySelectorAll("*"))
      if (node.shadowRoot) { const inner = find(node.shadowRoot); if (inner) return inner }
  }
  return find(document)
}"""

_STEP = (
    """([name, value]) => new Promise((resolve) => {
  const slider = ("""
    + _FIND
    + """)(name)
  window.__paints.length = 0
  slider.value = value
  const began = performance.now()
  window.__began = began
  slider.dispatchEvent(new Event("input"))
  const asked = window.__asked
  const look = () => {
    const mine = window.__paints.filter(([mark]) => mark >= asked)
    const quiet = mine.length && performance.now() - mine[mine.length - 1][1] > 150
    if (quiet || performance.now() - began > 5000) {
      const views = {}
      for (const [, at, , view] of mine) views[view] = Math.max(views[view] ?? 0, at - began)
      resolve({
        step: mine.length ? mine[mine.length - 1][1] - began : null, views,
        paint: mine.reduce((sum, [, , took]) => sum + took, 0),
      })
    } else setTimeout(look, 20)
  }
  look()
})"""
)

#: from the event of the last step to the last repaint by plan; null where there is none
_PLANNED = """() => new Promise((resolve) => {
  let since = null  // when it was first seen to rest: its paints follow
  const look = () => {
    const last = window.__paints.at(-1)
    since = window.__resting ? (since ?? performance.now()) : null
    const quiet = last && performance.now() - Math.max(last[1], since ?? 0) > 200
    if (since !== null && quiet) resolve(last[1] - window.__began)
    else if (performance.now() - window.__began > 12000) resolve(null)
    else setTimeout(look, 20)
  }
  look()
})"""


class Stepper:
    """Moves one slider to places that are spread over its track, never twice to the same."""

    def __init__(self, page: Page, slider: str) -> None:
        self._page, self._slider, self._index = page, slider, 0
        self._low, self._high = page.evaluate(
            f"(name) => {{ const s = ({_FIND})(name); return [Number(s.min), Number(s.max)] }}",
            slider,
        )

    def step(self) -> dict[str, Any]:
        """A single step, left to finish."""
        share = 0.12 + 0.8 * ((self._index * 0.381966) % 1.0)
        self._index += 1
        value = self._low + share * (self._high - self._low)
        result: dict[str, Any] = self._page.evaluate(_STEP, [self._slider, value])
        if result["step"] is None:
            raise RuntimeError(f"moving {self._slider} painted nothing")
        return result

    def planned(self) -> float | None:
        """Time [ms] from the last step's event to the planned picture."""
        found: float | None = self._page.evaluate(_PLANNED)
        return found


HAND = 60.0
"""Movements of the mouse a second."""
WORK = 60.0
"""Target of the work for a frame [ms]."""


@dataclass(frozen=True)
class Drag:
    """What a drag showed."""

    frames: float
    """a second"""
    tail: float
    """from the release to the last repaint [ms]"""
    browser: float
    """what the browser worked for a frame [ms]"""
    server: float
    """the same of the server"""


def drag(page: Page, slider: str, seconds: float, server: int) -> Drag:
    """Drag to and fro; `server` is the number of its process."""
    thumb = page.evaluate_handle(f"(name) => ({_FIND})(name)", slider).as_element()
    assert thumb is not None
    thumb.evaluate("slider => slider.scrollIntoView({block: 'center'})")  # from under what sticks
    box = thumb.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    page.evaluate("() => { window.__paints.length = 0 }")
    page.mouse.move(box["x"] + 0.15 * box["width"], y)
    page.mouse.down()
    before = worked_by_kind(server)
    began, moves = time.perf_counter(), 0
    while (passed := time.perf_counter() - began) < seconds:
        share = 0.15 + 0.7 * abs((passed / 2.0) % 2.0 - 1.0)
        page.mouse.move(box["x"] + share * box["width"], y)
        moves += 1
        time.sleep(max(0.0, began + moves / HAND - time.perf_counter()))
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


def late(times: list[float]) -> float:
    """95 % are below."""
    ordered = sorted(times)
    return ordered[min(len(ordered) - 1, int(0.95 * len(ordered)))]


def measure(page: Page, case: Case, count: int, seconds: float, server: int) -> list[str]:
    """The lines of one case: the tab as a whole, then its views."""
    page.locator(f".tab-{case.tab}").click()
    page.wait_for_function(f"window.__tab == '{case.tab}'", timeout=120_000)
    page.wait_for_timeout(1000)
    unfold(page)  # every slider is to be seen
    page.evaluate(_WATCH_PAINTS)
    machine = pace()
    stepper = Stepper(page, case.slider)
    for _ in range(3):
        stepper.step()
    found = [stepper.step() for _ in range(count)]
    times = [result["step"] for result in found]
    paint = statistics.median(result["paint"] for result in found)
    planned, disturbed = [], []
    for _ in range(max(count // 5, 3)):
        stepper.step()
        if (after := stepper.planned()) is None:
            break
        planned.append(after)
        stepper.step()
        page.wait_for_timeout(150)  # and the 150 ms of quiet of the step: a plan is being made
        disturbed.append(stepper.step()["step"])
    moved = drag(page, case.slider, seconds, server)
    median = statistics.median(times)
    slow, busy = median > case.target, moved.browser + moved.server > WORK
    verdict = ("  over" if slow else "") + ("  works" if busy else "")
    whole = (
        f"{case.tab:<11}{case.slider:<17}{median:>6.0f} ms{machine.ratio(0.001 * median):>8}"
        f"{late(times):>6.0f} ms{case.target:>6.0f} ms"
        f"{paint:>6.1f} ms{moved.frames:>5.0f} fps{moved.tail:>6.0f} ms"
        f"{moved.browser:>6.0f} +{moved.server:>4.0f} ms"
        + (f"{statistics.median(planned):>7.0f} ms{late(disturbed):>7.0f} ms" if planned else "")
        + verdict
        + f"   {1e3 * machine.statics:.2f}, {1e3 * machine.motion:.1f} ms"
    )
    views = sorted({view for result in found for view in result["views"] if view})
    lines = [whole]
    if len(views) > 1:
        for view in views:
            own = [result["views"][view] for result in found if view in result["views"]]
            lines.append(f"   {view:<25}{statistics.median(own):>6.0f} ms{late(own):>6.0f} ms")
    return lines


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=3.0, help="of each drag")
    parser.add_argument("--preset", action="append", help="repeatable; fan-rig and liew-lim")
    parser.add_argument("--tab", action="append", help="only these; repeatable")
    chosen = parser.parse_args()
    failed = False
    with (
        serving(explorer_server()) as server,
        sync_playwright() as playwright,
        chromium(playwright) as context,
    ):
        for preset in chosen.preset or ("fan-rig", "liew-lim"):
            page = context.new_page()
            page.goto(server.url)
            page.wait_for_function("window.__frames >= 1", timeout=60000)
            print(
                f"{preset}\n{'on screen':<11}{'slider':<17}{'median':>9}{'':>8}{'95 %':>9}"
                f"{'target':>9}{'paint':>9}{'drag':>9}{'tail':>9}{'work':>15}"
                f"{'planned':>10}{'disturbed':>10}   C loops"
            )
            for case in CASES:
                if not chosen.tab or case.tab in chosen.tab:
                    # each begins with the same scene, whatever the one before has made of it
                    page.goto(f"{server.url}?v=1&preset={preset}&tab={case.tab}")
                    page.wait_for_function("window.__frames >= 1", timeout=60000)
                    try:
                        lines = measure(
                            page, case, chosen.steps, chosen.seconds, server.process.pid
                        )
                    except RuntimeError as error:
                        lines = [f"{case.tab:<11}{case.slider:<17}failed: {error}"]
                        failed = True
                    print("\n".join(lines), flush=True)
            page.close()
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
