"""Figures zoom by the wheel and by boxes, stay so while sliders move, and go back."""

from typing import Any

import pytest
from playwright.sync_api import Page, ViewportSize

from tests.browser.explorer_page import open_page, painted, place, settle, show, slider
from tests.browser.helpers import Server, move

LAPTOP: ViewportSize = {"width": 1366, "height": 768}

RANGE = """view => {
  const inside = (root) => {
    for (const element of root.querySelectorAll("*")) {
      if (element.matches(`.view-${view}`)) return element
      const inner = element.shadowRoot && inside(element.shadowRoot)
      if (inner) return inner
    }
  }
  const card = inside(document)
  const holds = (node) => node && (node === card || holds(node.parentNode ?? node.host))
  for (const { model, el } of Bokeh.index.query((v) => v.model.type === "Figure"))
    if (holds(el)) return [model.x_range.start, model.x_range.end]
}"""


NAMES_OF_BANDS = """() => {
  const glyphs = [...Bokeh.index.query(({ model }) => model.type === "GlyphRenderer")]
  const { glyph, data_source } = glyphs.map(({ model }) => model).find(({ glyph, data_source }) =>
    glyph.type === "Text" && data_source.name === "modes_bands")
  return [...glyph.text.expr.v_compute(data_source)]
}"""


@pytest.mark.proof
def test_figures_zoom_stay_zoomed_and_go_back(page: Page, explorer: Server) -> None:
    page.set_viewport_size(LAPTOP)
    open_page(page, explorer, "modes")

    def shown() -> list[float]:
        painted(page)
        ends: Any = page.evaluate(RANGE, "modes")
        return [float(end) for end in ends]

    box = page.locator(".view-modes canvas").first.bounding_box()
    assert box is not None
    x, y = box["x"] + 0.4 * box["width"], box["y"] + 0.5 * box["height"]
    whole = shown()
    page.mouse.move(x, y)
    page.mouse.wheel(0, -200)
    assert shown() == whole, "the wheel alone scrolls the page"
    page.keyboard.down("Control")
    page.mouse.wheel(0, -200)
    nearer = f"most => {{ const [start, end] = ({RANGE})('modes'); return end - start < most }}"
    page.wait_for_function(nearer, arg=0.9 * (whole[1] - whole[0]))  # no call waits for a wheel
    page.keyboard.up("Control")
    near = shown()
    move(slider(page, "extent_deg"), 25)
    settle(page)
    assert shown() == near, "what is drawn anew does not take the place away"
    page.mouse.dblclick(x, y)
    assert shown() == whole
    page.wait_for_timeout(500)  # or what follows would be a third click
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 9):
        page.mouse.move(x + 14 * step, y + 8 * step)
    page.mouse.up()
    boxed = shown()
    assert whole[0] < boxed[0] < boxed[1] < whole[1]
    assert not any(page.evaluate(NAMES_OF_BANDS)), "names stand beside bands that are out of view"
    page.wait_for_timeout(500)
    page.mouse.dblclick(x, y)
    assert shown() == whole
    assert [name[:2] for name in page.evaluate(NAMES_OF_BANDS)] == ["x₁", "y₁", "x₂", "y₂"]

    # many maps on one canvas: whoever zooms into one finds its numbers at the edge
    show(page, "maps")
    axes = """() => {
      const [{ model }] = [...Bokeh.index.query(view => view.model.name === "maps_drawing")]
      const words = ({ visible, axis_label, formatter }) =>
        visible && [axis_label, formatter.args.get?.("shown") ?? formatter.args.shown]
      return [...model.left, ...model.below].map(words).map((axis) =>
        axis && [axis[0], axis[1].data.words])
    }"""
    assert page.evaluate(axes) == [False, False]
    x, y = place(page, "maps_drawing", 1.3, -4.0)
    page.mouse.move(x, y)
    page.keyboard.down("Control")
    for _ in range(8):
        page.mouse.wheel(0, -200)
    page.wait_for_function(f"({axes})().every(Boolean)")
    page.keyboard.up("Control")
    painted(page)
    left, below = page.evaluate(axes)
    assert left[0] == "Length of the defect Δφf (°)"
    assert below[0] == "Loaded balls over cage angle φc (°)"
    for _, numbers in (left, below):
        degrees = [float(number) for number in numbers]
        assert len(degrees) >= 2
        assert degrees == sorted(degrees)
        assert 0.0 <= degrees[0] < degrees[-1] <= 91.0
    page.wait_for_timeout(500)
    page.mouse.dblclick(x, y)
    painted(page)
    assert page.evaluate(axes) == [False, False]
