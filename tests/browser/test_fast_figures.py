"""What is left out of BokehJS's repaints changes no pixel, and comes back when it is needed."""

from playwright.sync_api import BrowserContext, Page

from tests.browser.explorer_page import open_page, painted, rest, settle, show, slider
from tests.browser.helpers import Server, move

_LINES = """() => [...Bokeh.index.query((view) => view.model.type === "GlyphRenderer")]
  .filter((view) => view.model.glyph.type === "Line" && view.model.data_source.length > 2)"""

# Bokeh does not clear half a pixel along two edges: what is there depends on how often it painted.
_INSIDE = """canvases => canvases.map((canvas) => {
  const {width, height} = canvas
  const {data} = canvas.getContext("2d").getImageData(4, 4, width - 8, height - 8)
  let hash = 0
  for (const pixel of new Uint32Array(data.buffer)) hash = (Math.imul(hash, 31) + pixel) | 0
  return [width, height, hash]
})"""


_COMPARED = {"overview": ["overview-bearing", "overview-stiffness"], "load": ["load-distribution"]}


def test_every_pixel_is_as_bokeh_paints_it(
    page: Page, browser: BrowserContext, explorer: Server
) -> None:
    shown: list[list[list[list[int]]]] = []
    for plain in (False, True):
        if plain:  # not sooner: a page behind another one hardly draws
            assert page.evaluate("window.fast_figures.missing") == []
            page = browser.new_page()
            page.add_init_script("window.fast_figures = {without: ['all']}")
        found = []
        open_page(page, explorer, "overview")
        for tab, views in _COMPARED.items():
            show(page, tab)
            for degrees in (14, 31):
                move(slider(page, "extent_deg"), degrees)
                settle(page)
            rest(page)
            canvases = [page.locator(f".view-{view} canvas") for view in views]
            found += [canvas.evaluate_all(_INSIDE) for canvas in canvases]
        shown.append(found)
    page.close()
    assert shown[0] == shown[1]


def test_hidden_glyphs_wait_until_they_are_to_be_seen(page: Page, explorer: Server) -> None:
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


_SIZES = """() => [...Bokeh.index.query((view) => view.model.type === "Figure")].map((view) => {
  const {width, height} = view.el.getBoundingClientRect(), {canvas} = view.canvas_view.primary
  return [Math.floor(width), Math.floor(height), canvas.width, canvas.height]
}).filter(([width]) => width)"""


def test_figures_fill_their_place_whatever_grows_beside_them(page: Page, explorer: Server) -> None:
    open_page(page, explorer, "overview")
    for tab in ("overview", "orbits"):
        show(page, tab)
        seen = set()
        for size in ((1366, 768), (1100, 900), (390, 844), (1366, 768)):
            page.set_viewport_size({"width": size[0], "height": size[1]})
            move(slider(page, "extent_deg"), 12 + len(seen))
            settle(page)
            rest(page)
            sizes = page.evaluate(_SIZES)
            assert [size[2:] for size in sizes] == [size[:2] for size in sizes]
            seen.add(str(sizes))
        assert len(seen) == 3, "the places did not change"
