"""From slider to pixels: ``python -m tests.benchmarks.latency`` prints a table.

The explorer in a process of its own, headless Chromium beside it, both on this machine's cores.
A step is the time from a slider's event to the end of the last repaint of the figures on screen
that shows it: every packet carries the number of the newest change, and the browser's paint is
wrapped to note which number it painted. A drag moves the mouse for some seconds; it gives frames
a second and the tail, the time from the release to the last repaint.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time

from playwright.sync_api import Page, sync_playwright

from tests.browser.helpers import chromium, explorer_server, serving

#: what is on screen, the slider that is moved, the target of a step [ms]
CASES = (
    ("load", "extent_deg", 50.0),
    ("stiffness", "extent_deg", 50.0),
    ("stiffness", "cage_angle_deg", 50.0),
    ("maps", "fy_n", 100.0),
    ("maps", "extent_deg", 100.0),
    ("modes", "extent_deg", 50.0),
    ("vibration", "extent_deg", 100.0),
)

_WATCH_PAINTS = """() => {
  window.__paints ??= []
  const wrapped = (window.__wrapped ??= new Set())
  const wrap = (view) => {
    if (view.model?.type === "Figure" || typeof view._actual_paint === "function") {
      const prototype = Object.getPrototypeOf(view)
      let owner = view
      while (owner && !Object.hasOwn(owner, "_actual_paint")) owner = Object.getPrototypeOf(owner)
      if (owner && !wrapped.has(owner)) {
        wrapped.add(owner)
        const paint = owner._actual_paint
        owner._actual_paint = function (...rest) {
          const began = performance.now(), mark = window.__mark
          const result = paint.apply(this, rest)
          window.__paints.push([mark, performance.now(), performance.now() - began])
          return result
        }
      }
    }
  }
  for (const view of Bokeh.index.query(() => true)) wrap(view)
  return wrapped.size
}"""

_STEP = """([name, value]) => new Promise((resolve) => {
  const find = (root) => {
    const found = root.querySelector(`#control-${name}`)
    if (found) return found
    for (const node of root.querySelectorAll("*"))
      if (node.shadowRoot) { const inner = find(node.shadowRoot); if (inner) return inner }
  }
  const slider = find(document)
  window.__paints.length = 0
  slider.value = value
  const began = performance.now()
  slider.dispatchEvent(new Event("input"))
  const asked = window.__asked
  const look = () => {
    const mine = window.__paints.filter(([mark]) => mark >= asked)
    const quiet = mine.length && performance.now() - mine[mine.length - 1][1] > 150
    if (quiet || performance.now() - began > 5000)
      resolve({
        step: mine.length ? mine[mine.length - 1][1] - began : null,
        first: mine.length ? mine[0][1] - began : null,
        paints: mine.length, paint: mine.reduce((sum, [, , took]) => sum + took, 0),
      })
    else setTimeout(look, 20)
  }
  look()
})"""


def steps(page: Page, slider: str, count: int) -> list[dict[str, float]]:
    """Single steps of a slider, each left to finish."""
    low, high = page.locator(f"#control-{slider}").evaluate("s => [Number(s.min), Number(s.max)]")
    found = []
    for index in range(count):
        share = 0.12 + 0.8 * ((index * 0.381966) % 1.0)
        result = page.evaluate(_STEP, [slider, low + share * (high - low)])
        if result["step"] is None:
            raise RuntimeError(f"moving {slider} painted nothing")
        found.append(result)
    return found


def drag(page: Page, slider: str, seconds: float) -> tuple[float, float]:
    """Drag to and fro; return frames a second and the tail after release [ms]."""
    thumb = page.locator(f"#control-{slider}")
    thumb.scroll_into_view_if_needed()
    box = thumb.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    page.evaluate("() => { window.__paints.length = 0 }")
    page.mouse.move(box["x"] + 0.15 * box["width"], y)
    page.mouse.down()
    began = time.perf_counter()
    while (passed := time.perf_counter() - began) < seconds:
        share = 0.15 + 0.7 * abs((passed / 2.0) % 2.0 - 1.0)
        page.mouse.move(box["x"] + share * box["width"], y)
    page.mouse.up()
    released = page.evaluate("() => performance.now()")
    page.wait_for_timeout(1500)
    paints = page.evaluate("() => window.__paints")
    drawn = {mark for mark, at, _ in paints if at <= released}
    tail = max((at for _, at, _ in paints), default=released) - released
    return len(drawn) / seconds, max(0.0, tail)


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=30)
    parser.add_argument("--seconds", type=float, default=3.0, help="of each drag")
    parser.add_argument("--preset", default="", help="a preset to choose first")
    chosen = parser.parse_args()
    print(
        f"{'on screen':<11}{'slider':<16}{'step, median':>13}{'95 %':>8}{'target':>8}"
        f"{'of which paint':>16}{'drag':>10}{'tail':>9}"
    )
    with (
        serving(explorer_server()) as server,
        sync_playwright() as playwright,
        chromium(playwright) as context,
    ):
        page = context.new_page()
        page.goto(server.url)
        page.wait_for_function("window.__frames >= 1", timeout=60000)
        if chosen.preset:
            page.locator("#choice-preset").select_option(chosen.preset)
        for tab, slider, target in CASES:
            page.locator(f".tab-{tab}").click()
            page.wait_for_timeout(1500)
            page.evaluate(_WATCH_PAINTS)
            steps(page, slider, 3)
            found = steps(page, slider, chosen.steps)
            times = sorted(result["step"] for result in found)
            paint = statistics.median(result["paint"] for result in found)
            fps, tail = drag(page, slider, chosen.seconds)
            late = times[min(len(times) - 1, int(0.95 * len(times)))]
            print(
                f"{tab:<11}{slider:<16}{statistics.median(times):>10.0f} ms{late:>5.0f} ms"
                f"{target:>5.0f} ms{paint:>13.1f} ms{fps:>6.0f} fps{tail:>6.0f} ms",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
