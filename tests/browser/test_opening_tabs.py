"""The cost of opening a tab does not depend on the tabs that were open before."""

from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import open_page, rest, show, wait
from tests.browser.helpers import PLAIN, QUICK_ONLY, Server

# Each time that a figure is laid out: its section, with whether that is closed.
_WATCH = """() => {
  let place = Bokeh.Models.get("Plot").prototype.default_view.prototype
  while (!Object.hasOwn(place, "_update_layout")) place = Object.getPrototypeOf(place)
  const lay_out = place._update_layout
  const is_section = ({model}) => model.css_classes?.includes("section")
  const section = (view) => is_section(view) ? view : section(view.parent)
  window.__laid_out = []
  place._update_layout = function () {
    const closed = section(this).model.css_classes.includes("off-screen")
    window.__laid_out.push([this.model.id, closed])
    return lay_out.call(this)
  }
}"""

_FIGURES = """() => [...Bokeh.index.query(
  ({model, is_displayed}) => model.type === "Figure" && is_displayed)]"""
_SIZES = f"""() => ({_FIGURES})().map((view) => {{
  const box = view.el.getBoundingClientRect()
  return [box.width, view.layout.bbox.width, box.height, view.layout.bbox.height]
}})"""
_HIDDEN = """() => [...Bokeh.index.query(
  ({model, is_displayed}) => model.type === "Figure" && !is_displayed)].length"""
# Colours that a figure has: the corner of its paper, and of how many it is made.
_COLORS = f"""() => ({_FIGURES})().map((view) => {{
  const canvas = view.canvas_view.primary.canvas
  const {{data}} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height)
  const pixels = new Uint32Array(data.buffer)
  return [pixels[0], pixels[canvas.width - 1], pixels.at(-1), new Set(pixels).size]
}})"""


def _work_of(page: Page) -> Callable[[str], float]:
    """Seconds of a processor that opening a tab takes, until it is drawn as finely as can be."""
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def spent() -> float:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return float(next(m["value"] for m in metrics if m["name"] == "TaskDuration"))

    def opening(tab: str) -> float:
        before = spent()
        show(page, tab)
        rest(page)
        return spent() - before

    return opening


@QUICK_ONLY
@pytest.mark.proof
def test_a_tab_costs_no_more_for_those_that_were_open(page: Page, explorer: Server) -> None:
    page.emulate_media(reduced_motion="no-preference")  # as people have it: the bearing turns
    page.goto(explorer.url)
    stops = page.get_by_role("button", name="Stop turning")
    expect(stops).to_be_visible()
    opening = _work_of(page)
    first = opening("load")
    later = {tab: opening(tab) for tab in ("vibration", "diagnosis", "accuracy", "paper")}
    # a half more is asked for; here other tests may run at the same time
    assert max(later.values()) < 3 * first, (first, later)
    again = {tab: opening(tab) for tab in ("load", "vibration")}
    assert again["load"] < 0.7 * first, (first, again)
    assert again["vibration"] < 0.7 * later["vibration"], (later, again)
    expect(stops).to_have_count(0)  # it would cost as much as a drag, unseen


_COUNT_PAINTS = """() => {
  const place = Bokeh.Models.get("Plot").prototype.default_view.prototype
  const paint = place._actual_paint
  window.__painted = {}
  place._actual_paint = function () {
    window.__painted[this.model.id] = (window.__painted[this.model.id] ?? 0) + 1
    return paint.call(this)
  }
}"""


@QUICK_ONLY
@pytest.mark.proof
def test_only_what_is_seen_is_laid_out_and_painted_and_not_once_a_change(
    page: Page, explorer: Server
) -> None:
    page.goto(f"{explorer.url}?v=1&tab=vibration")
    page.wait_for_function("window.__tab == 'vibration'")
    rest(page)
    assert page.evaluate(_HIDDEN) == 0, "what is folded or not chosen is not built"
    page.evaluate(_WATCH)
    show(page, "accuracy")
    rest(page)
    laid_out = page.evaluate("window.__laid_out")
    assert not any(closed for _, closed in laid_out)
    figures = {figure for figure, _ in laid_out}
    assert figures
    assert len(laid_out) <= 4 * len(figures)
    page.set_viewport_size({"width": 420, "height": 500})
    page.evaluate(_COUNT_PAINTS)
    page.get_by_label("Charts of").select_option("Statics")
    wait(page, lambda: len(page.evaluate(_COLORS)) > 3)
    wait(page, lambda: all(colors[3] > 20 for colors in page.evaluate(_COLORS)))
    rest(page)
    times = page.evaluate(f"({_FIGURES})().map((view) => window.__painted[view.model.id])")
    assert len(times) > 3
    assert max(times[-2:]) <= 3, "many screens below, and painted once all rests"


@pytest.mark.proof
def test_a_closed_tab_follows_window_and_theme_and_else_opens_as_it_was(
    page: Page, explorer: Server
) -> None:
    """Neither sent nor painted again, unless the window or the theme has changed meanwhile."""
    sent: list[int] = []

    def note(frame: str | bytes) -> None:
        if isinstance(frame, bytes):
            sent.append(len(frame))

    page.on("websocket", lambda socket: socket.on("framereceived", note))
    open_page(page, explorer, "load")
    rest(page)
    for tab in ("vibration", "life"):
        show(page, tab)
        rest(page)
    page.evaluate(_COUNT_PAINTS)
    assert sum(sent) > 100_000, "numbers"
    sent.clear()
    for tab in ("load", "vibration"):
        show(page, tab)
        rest(page)
    if not PLAIN:
        assert sum(sent) < 200, "marks, and no numbers"
        assert page.evaluate("window.__painted") == {}

    show(page, "load")
    light = page.evaluate(_COLORS)
    show(page, "life")
    page.set_viewport_size({"width": 1270, "height": 760})
    page.get_by_role("button", name="Help").click()
    page.get_by_role("button", name="Dark colours").click()
    page.keyboard.press("Escape")
    for tab in ("vibration", "load"):
        show(page, tab)
        rest(page)
        sizes = page.evaluate(_SIZES)
        assert len(sizes) > 2
        for wide, laid_wide, high, laid_high in sizes:
            assert (laid_wide, laid_high) == pytest.approx((wide, high), abs=1.0), tab
            assert wide > 200
    dark = page.evaluate(_COLORS)
    assert len(light) == len(dark) > 2
    for before, after in zip(light, dark, strict=True):
        # the paper, also along the edges
        assert not set(before[:3]) & set(after[:3])
        assert after[3] > 20
