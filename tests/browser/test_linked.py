"""What belongs together lights up together, and curves remember what they were before a drag."""

from playwright.sync_api import Page, expect

from tests.browser.explorer_page import painted, rest, slider
from tests.browser.visitor import Visitor

FAINT_STROKES = """() => {
  const { stroke } = CanvasRenderingContext2D.prototype
  window.__faint = 0
  CanvasRenderingContext2D.prototype.stroke = function (...rest) {
    if (Math.abs(this.globalAlpha - 0.3) < 0.01) window.__faint += 1
    return stroke.apply(this, rest)
  }
}"""
REPAINT = """() => {
  window.__faint = 0
  const figures = Bokeh.index.query(({ model }) => model.type === "Figure")
  for (const view of figures) view.request_repaint()
}"""
LIT = """name => {
  const { data, inspected } = Bokeh.documents[0].get_model_by_name(name)
  return [...inspected.indices].map((i) => Math.abs(data.element[i]))
}"""


def test_the_last_state_stays_faintly_in_curves_while_a_hand_drags(desk: Visitor) -> None:
    desk.begin("Overview")
    page = desk.page
    page.evaluate(FAINT_STROKES)
    box = slider(page, "extent_deg").bounding_box()
    assert box is not None
    x, y = box["x"] + 30.0, box["y"] + 0.5 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    expect(page.get_by_text("Now always one rolling element inside")).to_have_count(0)
    page.mouse.move(x + 45.0, y, steps=6)
    expect(page.get_by_text("Now always one rolling element inside")).to_be_visible()
    page.wait_for_function("window.__faint > 0")
    page.mouse.up()
    rest(page)
    page.evaluate(REPAINT)
    painted(page)
    assert page.evaluate("window.__faint") == 0


def test_a_ball_that_is_named_or_pointed_at_lights_up_everywhere(desk: Visitor) -> None:
    desk.begin("Load")
    page: Page = desk.page
    page.locator(".view-bearing .sentence p").hover()
    balls = page.evaluate(LIT, "bearing_balls")
    assert balls == page.evaluate(LIT, "load_distribution_balls") == [11, 12]
    page.locator(".view-bearing h2").hover()
    assert page.evaluate(LIT, "bearing_balls") == []
