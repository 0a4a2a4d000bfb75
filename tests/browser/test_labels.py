"""Words in figures lie neither on one another nor outside of their figure."""

from contextlib import suppress

import pytest
from playwright.sync_api import Page, TimeoutError, ViewportSize

from tests.browser.explorer_page import rest, show
from tests.browser.helpers import Server

SCREENS: tuple[ViewportSize, ...] = (
    {"width": 1440, "height": 900},
    {"width": 1366, "height": 768},
    {"width": 960, "height": 900},
    {"width": 390, "height": 844},
)
ROOM = 3.0
"""[px] by which the boxes of two texts may meet: letters are smaller than their boxes."""
#: boxes of the texts of each figure on screen that meet another's or are cut by the canvas
COLLISIONS = """(room) => {
  const boxes = (view) => [...view.renderer_views.values()].flatMap(({ model, glyph }) => {
    if (glyph?.model.type !== "Text" || !model.visible || !glyph.labels) return []
    return glyph.labels.flatMap((label, i) => {
      if (!label?.text.trim() || !isFinite(glyph.sx[i] + glyph.sy[i])) return []
      const { width, height } = label.size()
      const middle = { left: 0.5, top: 0.5, center: 0, middle: 0 }
      const across = middle[glyph.text_align.get(i)] ?? -0.5
      const down = middle[glyph.text_baseline.get(i)] ?? -0.5
      const x = glyph.sx[i] + glyph.x_offset.get(i) + across*width
      const y = glyph.sy[i] + glyph.y_offset.get(i) + down*height
      const turned = Math.abs(Math.sin(glyph.angle.get(i))) > 0.7
      const [w, h] = turned ? [height, width] : [width, height]
      return [{ text: label.text, left: x - w/2, right: x + w/2, top: y - h/2, bottom: y + h/2 }]
    })
  })
  const faults = []
  for (const view of Bokeh.index.query((view) => view.model.type === "Figure")) {
    if (!view.el.checkVisibility({ visibilityProperty: true }) || view.el.offsetWidth < 3) continue
    const { width, height } = view.canvas_view.bbox, all = boxes(view)
    all.forEach((one, i) => {
      if (one.left < -1 || one.right > width + 1 || one.top < -1 || one.bottom > height + 1)
        faults.push(`“${one.text}” is cut`)
      for (const other of all.slice(0, i))
        if (Math.min(one.right, other.right) - Math.max(one.left, other.left) > 1
            && Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > room)
          faults.push(`“${one.text}” lies on “${other.text}”`)
    })
  }
  return faults
}"""


@pytest.mark.parametrize(
    ("preset", "tabs"),
    [
        ("liew-lim", ("overview", "load")),
        pytest.param("3208", ("overview", "load", "vibration"), marks=pytest.mark.proof),
        pytest.param("30206-back-to-back", ("overview", "maps"), marks=pytest.mark.proof),
        # whose curves end at the floor
        pytest.param("liew-lim&extent_deg=0", ("overview",), marks=pytest.mark.proof),
    ],
)
def test_words_in_figures_do_not_overlap(
    page: Page, explorer: Server, preset: str, tabs: tuple[str, ...]
) -> None:
    page.goto(f"{explorer.url}?v=1&preset={preset}&tab={tabs[0]}")
    page.wait_for_function("window.__frames >= 1")
    for tab in tabs:
        page.set_viewport_size(SCREENS[0])
        show(page, tab)
        rest(page)
        for screen in SCREENS:
            page.set_viewport_size(screen)
            # figures take their time to follow a change of the screen, and then all fits
            with suppress(TimeoutError):
                page.wait_for_function(f"() => !({COLLISIONS})({ROOM}).length", timeout=30e3)
            assert page.evaluate(COLLISIONS, ROOM) == [], (tab, screen)
