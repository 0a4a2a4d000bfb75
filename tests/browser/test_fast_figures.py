"""BokehJS repaints less, changes no pixel by that, and paints again what is needed."""

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from tests.browser.explorer_page import SEEN, open_page, rest, settle, show, slider, source
from tests.browser.helpers import QUICK_ONLY, Server, move
from tests.browser.visitor import Visitor

pytestmark = QUICK_ONLY

# Bokeh does not clear half a pixel along two edges: what is there depends on how often it painted.
_INSIDE = """canvases => canvases.map((canvas) => {
  const {width, height} = canvas
  const {data} = canvas.getContext("2d").getImageData(4, 4, width - 8, height - 8)
  let hash = 0
  for (const pixel of new Uint32Array(data.buffer)) hash = (Math.imul(hash, 31) + pixel) | 0
  return [width, height, hash]
})"""

_COMPARED = {"overview": ["overview-bearing", "overview-stiffness"], "load": ["load-distribution"]}


@pytest.mark.proof
def test_every_pixel_is_as_bokeh_paints_it(
    page: Page, browser: BrowserContext, explorer: Server
) -> None:
    shown: list[list[list[list[int]]]] = []
    for plain in (False, True):
        if plain:  # not sooner: a page behind another one hardly draws
            assert page.evaluate("window.fast_figures.missing") == []
            page = browser.new_page()
            page.add_init_script("window.fast_figures = {without: ['all']}")
        pixels = []
        open_page(page, explorer, "overview")
        for tab, views in _COMPARED.items():
            show(page, tab)
            for degrees in (14, 31):
                move(slider(page, "extent_deg"), degrees)
                settle(page)
            slider(page, "extent_deg").dispatch_event("change")  # lets go of the curves of before
            rest(page)
            canvases = [page.locator(f".view-{view} canvas") for view in views]
            pixels += [canvas.evaluate_all(_INSIDE) for canvas in canvases]
        shown.append(pixels)
    page.close()
    assert shown[0] == shown[1]


#: colours at the places of a curve that are farther than 12 pixels from the curves drawn now
_COLORS = """(was) => {
  const [card] = deep(document, ".view-load-distribution")
  const [figure] = deep(card.shadowRoot, ".bk-Figure"), [canvas] = deep(figure.shadowRoot, "canvas")
  const [view] = Bokeh.index.query(({ el }) => el === figure)
  const { x_scale, y_scale } = view.frame, ratio = view.canvas_view.pixel_ratio ?? 1
  const place = (x, y) => [x_scale.compute(x), y_scale.compute(y)]
  const places = ({ angle, load }) => Array.from(angle, (at, i) => place(at, load[i]))
  const named = (name) => Bokeh.documents[0].get_model_by_name(`load_distribution_${name}`).data
  const now = [...places(named("curve")), ...places(named("healthy"))]
  const far = places(was).filter(([x, y]) => now.every(([a, b]) => Math.hypot(a - x, b - y) > 12))
  const drawing = canvas.getContext("2d")
  return far.map(([x, y]) => [...drawing.getImageData(ratio*x, ratio*y, 1, 1).data])
}"""


def test_the_last_state_stays_faintly_while_a_hand_drags(desk: Visitor) -> None:
    page = desk.page
    page.evaluate(SEEN)
    desk.begin("Load")
    rest(page)
    was, extent = source(page, "load_distribution_curve"), slider(page, "extent_deg")
    move(extent, 60)
    rest(page)
    held = page.evaluate(_COLORS, was)
    extent.dispatch_event("change")  # the hand lets go
    rest(page)
    released = page.evaluate(_COLORS, was)
    assert len(held) == len(released) > 10
    assert sum(a != b for a, b in zip(held, released, strict=True)) > 0.8 * len(held)


def test_buttons_of_a_figure_come_with_the_mouse(desk: Visitor) -> None:
    page = desk.page
    desk.begin("Load")
    buttons = page.locator(".view-load-distribution .bk-Toolbar .bk-OnOffButton")
    expect(buttons).to_have_count(0)
    page.locator(".view-load-distribution .bk-events").first.hover()
    expect(buttons.first).to_be_visible()
    expect(buttons).to_have_count(3)
    page.locator(".view-bearing .bk-events").first.hover()
    expect(buttons.first).to_be_hidden()
