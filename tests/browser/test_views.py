"""Views in a browser: proportions, words that stand apart, balls that light up together."""

from contextlib import suppress

import pytest
from bearing_explorer.explorer.views.bearing import HALF_WIDTH
from bearing_explorer.kit.plots import style
from playwright.sync_api import Page, TimeoutError, ViewportSize

from tests.browser.explorer_page import rest, show, wait
from tests.browser.helpers import Server
from tests.browser.visitor import Visitor

MODELS = "[...Bokeh.documents.flatMap(d => [...d._all_models.values()])]"


def numbers_are_written_alike(page: Page) -> None:
    """In sentences by the server and in figures by the browser."""
    values = [m * 10.0**e for m in (1.0, 2.0616, 5.0, -9.9949) for e in range(-20, 20)]
    values += [0.0, 999.96, -7.94e-24, 1e21]
    code = f"(values) => {{ {style.JS_PREFIX}; return values.map(v => si(v, 'N')) }}"
    written = [text.replace("\u00a0", " ") for text in page.evaluate(code, values)]
    assert written == [style.with_prefix(value, "N") for value in values]


def shape_of_the_bearing(page: Page) -> dict[str, float]:
    """Width and height of the figure on the screen, and of what it shows."""
    return page.evaluate(
        f"{MODELS}.filter(m => m.type == 'Figure' && m.right.concat(m.below)"
        ".some(r => r.type == 'ColorBar')).map(m => ({w: m.inner_width, h: m.inner_height,"
        " x: m.x_range.end - m.x_range.start, y: m.y_range.end - m.y_range.start}))"
    )[0]


def is_round(plot: dict[str, float]) -> bool:
    """And as large as it can be, with room for the numbers on its bars."""
    stretch, size = plot["w"] * plot["y"] / (plot["h"] * plot["x"]), min(plot["x"], plot["y"])
    return stretch == pytest.approx(1.0, rel=1e-3) and 1.0 <= size / (2 * HALF_WIDTH) < 1.1


def test_the_bearing_is_round_and_numbers_are_written_as_by_the_server(desk: Visitor) -> None:
    desk.begin("Load")
    numbers_are_written_alike(desk.page)
    for width in (1366, 700):
        desk.page.set_viewport_size({"width": width, "height": 900})
        rest(desk.page)  # before its first paint a figure has no size
        wait(desk.page, lambda: is_round(shape_of_the_bearing(desk.page)))


LIT = """name => {
  const { data, inspected } = Bokeh.documents[0].get_model_by_name(name)
  return [...inspected.indices].map((i) => Math.abs(data.element[i]))
}"""


def test_a_ball_that_is_named_or_pointed_at_lights_up_everywhere(desk: Visitor) -> None:
    desk.begin("Load")
    page = desk.page
    page.locator(".view-bearing .sentence p").hover()
    balls = page.evaluate(LIT, "bearing_balls")
    assert balls == page.evaluate(LIT, "load_distribution_balls") == [11, 12]
    page.locator(".view-bearing h2").hover()
    assert page.evaluate(LIT, "bearing_balls") == []


SCREENS: tuple[ViewportSize, ...] = (
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
      const turned = Math.abs(Math.sin(glyph.angle.get(i))) > 0.7  // upwards
      const [right, below] = turned ? [down*height, -across*width] : [across*width, down*height]
      const x = glyph.sx[i] + glyph.x_offset.get(i) + right
      const y = glyph.sy[i] + glyph.y_offset.get(i) + below
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
