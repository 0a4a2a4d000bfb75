"""What is left out of BokehJS's repaints changes no pixel, and comes back when it is needed."""

import pytest
from playwright.sync_api import BrowserContext, Page

from tests.browser.explorer_page import open_page, painted, rest, settle, slider
from tests.browser.helpers import Server, Watch, move

_LINES = """() => [...Bokeh.index.query((view) => view.model.type === "GlyphRenderer")]
  .filter((view) => view.model.glyph.type === "Line" && view.model.data_source.length > 2)"""

# Bokeh does not clear half a pixel along two edges: what is there depends on how often it painted.
_INSIDE = """canvases => canvases.map((canvas) => {
  const {width, height} = canvas
  const inside = canvas.getContext("2d").getImageData(4, 4, width - 8, height - 8).data
  return [width, height, inside.reduce((sum, value) => (31 * sum + value) % 1e9, 0)]
})"""


@pytest.mark.parametrize("tab", ["overview", "load"])
def test_every_pixel_is_as_bokeh_paints_it(
    watch: tuple[Page, Watch], browser: BrowserContext, explorer: Server, tab: str
) -> None:
    fast, _ = watch
    plain = browser.new_page()
    plain.add_init_script("window.fast_figures = {without: ['all']}")
    views = {"overview": ["overview-bearing", "overview-stiffness"], "load": ["load-distribution"]}
    shown: list[list[list[list[int]]]] = []
    for page in (fast, plain):
        open_page(page, explorer, tab)
        for degrees in (14, 31):
            move(slider(page, "extent_deg"), degrees)
            settle(page)
        rest(page)
        canvases = [page.locator(f".view-{view} canvas") for view in views[tab]]
        shown.append([found.evaluate_all(_INSIDE) for found in canvases])
    assert fast.evaluate("window.fast_figures.missing") == []
    plain.close()
    assert shown[0] == shown[1]


def test_hidden_glyphs_wait_until_they_are_to_be_seen(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    page.evaluate(
        f"""() => {{
          window.heard = 0
          for (const view of ({_LINES})()) {{
            window.looked_at = view
            const glyphs = [view.nonselection_glyph, view.selection_glyph, view.muted_glyph]
            for (const glyph of glyphs)
              for (let proto = glyph; proto = Object.getPrototypeOf(proto);)
                if (Object.hasOwn(proto, "map_data") && !proto.map_data.counts) {{
                  const map_data = proto.map_data
                  proto.map_data = function () {{
                    window.heard += this.base != null && this.parent.hover_glyph !== this
                    map_data.call(this)
                  }}
                  proto.map_data.counts = true
                }}
          }}
        }}"""
    )
    move(slider(page, "extent_deg"), 22)
    settle(page)
    assert page.evaluate("window.heard") == 0
    page.evaluate("window.looked_at.model.data_source.selected.indices = [0, 1]")
    painted(page)
    assert page.evaluate("window.heard") > 0
    assert page.evaluate("window.looked_at.nonselection_glyph.sx.length") > 2


def test_a_figure_out_of_sight_is_painted_when_it_comes_into_sight_or_the_hand_rests(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    page.set_viewport_size({"width": 700, "height": 500})
    open_page(page, explorer, "load")
    rest(page)
    page.evaluate(
        """() => {
          const figures = [...Bokeh.index.query((view) => view.model.type === "Figure")]
          const shown = figures.filter((view) => view.el.getClientRects().length)
          window.last = shown.sort((a, b) => a.el.getBoundingClientRect().top
            - b.el.getBoundingClientRect().top).at(-1)
          window.first = shown[0]
        }"""
    )
    counts = "() => [window.first._render_count, window.last._render_count]"
    page.wait_for_timeout(700)  # what waited is painted
    before = page.evaluate(counts)
    move(slider(page, "extent_deg"), 27)
    settle(page)
    first, last = page.evaluate(counts)
    assert first > before[0]
    assert last == before[1], "nobody sees it"
    page.evaluate("window.last.el.scrollIntoView()")
    page.wait_for_function(f"({counts})()[1] > {before[1]}")
    page.evaluate("window.first.el.scrollIntoView()")
