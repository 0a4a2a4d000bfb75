"""The explore plane in the browser: chosen, seen coarse and then fine, read, clicked, cancelled."""

from __future__ import annotations

import re
import time
from collections.abc import Callable

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.explorer_page import export, open_page, settle, slider, source, value
from tests.browser.helpers import Server, Watch, drag

_FIGURES = """
const figures = {}
for (const view of Bokeh.index.query((view) => view.model.type == "Figure")) {
  const {model} = view
  const name = model.name == "explore_map" ? "map"
    : model.title?.text.startsWith("Select") ? "histogram" : null
  if (name && view.el.isConnected) figures[name] = view
}
"""


def shape(page: Page) -> list[int]:
    """Rows and columns of the map that is drawn; empty before there is one."""
    return page.evaluate(
        f"""() => {{
          {_FIGURES}
          const image = figures.map?.model.renderers.find((r) => r.glyph.type == "Image")
          return image ? Array.from(image.data_source.data.image[0].shape) : []
        }}"""
    )


def covered(page: Page) -> float:
    """Part of the map that a selection of values leaves pale."""
    return page.evaluate(
        f"""() => {{
          {_FIGURES}
          const images = figures.map.model.renderers.filter((r) => r.glyph.type == "Image")
          const veil = Array.from(images.at(-1).data_source.data.image[0])
          return veil.reduce((sum, one) => sum + one, 0)/veil.length
        }}"""
    )


def place(page: Page, figure: str, across: float, up: float) -> tuple[float, float]:
    """Where on the screen a part of a figure's frame lies, 0 to 1 from the left and from below."""
    box = page.evaluate(
        f"""([name]) => {{
          {_FIGURES}
          const view = figures[name]
          view.el.scrollIntoView({{block: "center"}})
          const around = view.canvas_view.el.getBoundingClientRect()
          const {{left, top, width, height}} = view.frame.bbox
          return [around.left + left, around.top + top, width, height]
        }}""",
        [figure],
    )
    return box[0] + across * box[2], box[1] + (1.0 - up) * box[3]


def titles(page: Page) -> list[str]:
    """Of the lines across the map."""
    return page.evaluate(
        """() => Bokeh.index.query((view) => view.model.type == "Figure" && view.el.isConnected)
             .toArray().map((view) => view.model.title?.text ?? "")
             .filter((text) => text.includes(" at "))"""
    )


def words(page: Page) -> Locator:
    return page.locator(".view-explore .job .words p")


def wait(page: Page, done: Callable[[], bool], seconds: float = 120.0) -> None:
    end = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < end, "it did not happen in time"
        page.wait_for_timeout(20)


def choose(page: Page, **fields: str) -> None:
    for name, text in fields.items():
        page.locator(f".field-{name}:visible select").select_option(text)


@pytest.mark.proof
def test_a_plane_is_explored(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, watching = watch
    open_page(page, explorer, "explore")
    seen: list[list[int]] = []

    def drawn(fine: list[int]) -> bool:
        now = shape(page)
        if now and (not seen or seen[-1] != now):
            seen.append(now)
        return now == fine and words(page).inner_text().endswith(" s.")

    # coarse, then fine, unless the page came up too slowly to see the former
    wait(page, lambda: drawn([25, 33]))
    assert seen[0] in ([7, 9], [13, 17], [25, 33])
    expect(words(page)).to_have_text(re.compile(r"33 × 25 points after .* s\."))
    expect(page.locator(".view-explore")).to_contain_text("kyy, mean: least")

    # other axes: the quantity brings its range, and the map is made anew without the button
    choose(page, y="Radial clearance (µm)")
    expect(page.locator(".field-y_to input")).to_have_value("50")
    wait(page, lambda: any("Radial clearance" in title for title in titles(page)))
    wait(page, lambda: drawn([25, 33]))

    # the lines across it follow the pointer, and nobody asks the server
    frames = watching.frames_sent
    at = place(page, "map", 0.8, 0.3)
    page.mouse.move(*at)
    before = titles(page)
    page.mouse.move(*place(page, "map", 0.4, 0.6))
    wait(page, lambda: titles(page) != before)
    assert watching.frames_sent == frames
    tip = page.locator(".bk-Tooltip:visible").first
    expect(tip).to_contain_text("Extent")
    expect(tip).to_contain_text("MN/m")

    # a click goes there
    page.mouse.click(*place(page, "map", 0.4, 0.6))
    wait(page, lambda: value(page, "extent_deg") == pytest.approx(26.0, abs=1.1))
    settle(page)
    mark = source(page, "explore_mark")
    assert mark["x"] == pytest.approx([value(page, "extent_deg")], abs=0.06)
    assert mark["y"] == pytest.approx([30.0], abs=1.2)
    assert shape(page) == [25, 33], "moving along the axes changes nothing of the map"

    # values selected in the histogram stay bright
    page.mouse.move(*place(page, "histogram", 0.55, 0.5))
    page.mouse.down()
    page.mouse.move(*place(page, "histogram", 0.97, 0.6), steps=4)
    page.mouse.up()
    wait(page, lambda: 0.05 < covered(page) < 0.95)

    # another slider: coarse again, and fine when it rests
    seen.clear()
    drag(page, slider(page, "depth_um"), 0.1, 0.03, steps=8)
    wait(page, lambda: drawn([25, 33]) and len(seen) > 1)
    assert seen[0] in ([7, 9], [25, 33])
    assert 0.0 < covered(page) < 1.0, "what is selected stays selected"

    # an output that takes a while is followed and cancelled
    choose(page, grid="65 × 49", output="acceleration along y, RMS")
    cancel = page.get_by_role("button", name="Cancel")
    expect(cancel).to_be_enabled()
    wait(page, lambda: shape(page) in ([4, 5], [7, 9]))
    cancel.click()
    expect(words(page)).to_have_text(re.compile(r"Cancelled\. .* points after"))
    expect(cancel).to_be_disabled()
    expect(page.locator(".view-explore")).to_contain_text("acceleration along y, RMS: least")

    with page.expect_download() as saving:
        export(page.locator(".view-explore"), "csv").click()
    table = saving.value.path().read_text().splitlines()
    assert table[0] == (
        "extent_deg,radial_clearance_um,acceleration_rms_y_m_per_s2,no_answer_because"
    )

    with page.expect_download() as saving:
        export(page.locator(".view-explore"), "svg").click()
    assert saving.value.path().read_text().count("<svg") == 5

    # what cannot be is refused in a sentence, and the map stays
    page.locator(".field-x_from input").fill("90")
    page.locator(".field-x_from input").press("Enter")
    expect(words(page)).to_contain_text("must be greater")
