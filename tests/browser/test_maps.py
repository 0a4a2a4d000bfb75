"""The maps in the browser: coloured, read under the pointer, clicked, followed while dragged."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from bearing_explorer.plots.color_scales import DIVERGING, SEQUENTIAL, packed_colors
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.maps import COUNT, TWO_SIGNS, StiffnessMaps, whole_numbers
from playwright.sync_api import Page, expect

from bearingcore import STIFFNESS_TERMS, Maps, presets
from bearingcore.statics.equilibrium import TERM_UNITS
from tests.browser.explorer_page import export, open_page, pixels, rest, settle, slider, source
from tests.browser.helpers import Server, Watch, drag, move

LIEW_LIM = presets["liew-lim"]
K_XY = STIFFNESS_TERMS.index("k_xy")
IMAGES = """() => {
  const of_maps = (model) => model.type == "ColumnDataSource" && model.data.image?.length == 32
  const models = Bokeh.documents.flatMap(document => [...document._all_models.values()])
  return models.find(of_maps).data.image.map(image => [image.shape, Array.from(image)])
}"""


def open_maps(page: Page, server: Server) -> None:
    open_page(page, server)
    page.get_by_label("Bearing", exact=True).select_option("liew-lim")
    page.locator(".tab-maps").click()
    page.set_viewport_size({"width": 1366, "height": 1100})  # all of them on screen
    page.wait_for_function("Bokeh.documents[0].get_model_by_name('maps_points')?.data.bits.length")
    settle(page)


def place(page: Page, map_index: int, across: float, up: float) -> tuple[float, float]:
    """Where on the screen a place in a map lies, in shares of its sides."""
    cells = source(page, "maps_cells")
    x = cells["left"][map_index] + across * (cells["right"][map_index] - cells["left"][map_index])
    y = cells["bottom"][map_index] + up * (cells["top"][map_index] - cells["bottom"][map_index])
    found = page.evaluate(
        """([x, y]) => {
          const [view] = [...Bokeh.index.query(view => view.model.name == "maps_drawing")]
          const box = view.canvas_view.el.getBoundingClientRect()
          return [box.left + view.frame.x_scale.compute(x), box.top + view.frame.y_scale.compute(y)]
        }""",
        [x, y],
    )
    return float(found[0]), float(found[1])


@pytest.mark.proof
def test_every_point_has_the_colour_of_its_value(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_maps(page, explorer)
    images = page.evaluate(IMAGES)
    results = Results(LIEW_LIM)
    cells = source(page, "maps_cells")
    for i, term in enumerate(STIFFNESS_TERMS):
        colors = packed_colors(DIVERGING if cells["kind"][i] == TWO_SIGNS else SEQUENTIAL)
        numbers = whole_numbers(results.maps.term(term), cells["low"][i], cells["high"][i])
        shape, drawn = images[i]
        assert shape == [91, 121]
        right = np.array(drawn) == np.array(colors)[numbers >> 8]
        # limits went through 32 bits, which may move a number across a step
        assert right.mean() > 0.99, term
    assert cells["kind"][15] == COUNT
    balls = np.array(images[15][1]).reshape(91, 121)
    levels = {int(count) for count in np.unique(results.maps.loaded_balls)}
    assert len(np.unique(balls)) == len(levels)
    assert images[31][0][0] == cells["high"][15] - cells["low"][15], "a step for each number"


@pytest.mark.proof
def test_maps_follow_the_depth_and_the_load(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_maps(page, explorer)
    for name, start, end in (("depth_um", 0.1, 0.02), ("fy_n", 0.3, 0.4)):
        before, picture = source(page, "maps_points"), pixels(page, "maps")
        drag(page, slider(page, name), start, end)
        settle(page)
        assert source(page, "maps_points") != before, name
        assert pixels(page, "maps") != picture, name
    depth, force = (float(slider(page, name).input_value()) for name in ("depth_um", "fy_n"))
    scene = LIEW_LIM.replace(depth=depth * 1e-6, fy=force)
    drawn = source(page, "maps_cells")
    now = Results(scene).now
    for i, term in enumerate(STIFFNESS_TERMS):
        assert drawn["now"][i] == pytest.approx(float(now.term(term)[0]), rel=1e-4, abs=1e-3)


@pytest.mark.proof
def test_a_click_goes_to_its_extent_and_cage_angle(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, watching = watch
    open_maps(page, explorer)
    rest(page)
    before = source(page, "maps_points")
    page.mouse.click(*place(page, K_XY, 0.25, 0.75))
    expect(page.locator(".control-extent_deg .number")).to_have_value(re.compile(r"^6[78]"))
    settle(page)
    extent, angle = (
        float(slider(page, name).input_value()) for name in ("extent_deg", "cage_angle_deg")
    )
    # a pixel of the screen is a good half degree of extent and a quarter of cage angle
    assert extent == pytest.approx(0.75 * 91 - 0.5, abs=1.2)
    assert angle == pytest.approx(0.25 * 30.25 - 0.125, abs=0.4)
    assert source(page, "maps_points") == before, "moving along the maps sends no map"
    grid, marks = source(page, "maps_grid"), source(page, "maps_now")
    share = (marks["x"][0] - marks["left"][0]) / (marks["right"][0] - marks["left"][0])
    first, last = grid["x_first"][0], grid["x_last"][0]
    assert first + share * (last - first) == pytest.approx(angle, abs=0.06)
    assert re.search(
        rf"Marked: extent {extent:g}°", page.locator(".view-maps [role=status]").first.inner_text()
    )
    # beside the maps there is nowhere to go to
    rest(page)
    sent = watching.frames_sent
    page.mouse.click(*place(page, K_XY, -0.4, 0.5))
    page.wait_for_timeout(300)
    assert float(slider(page, "extent_deg").input_value()) == extent
    assert watching.frames_sent - sent < 3


@pytest.mark.proof
def test_the_value_under_the_pointer_is_shown(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_maps(page, explorer)
    row, column = 70, 30
    maps: Maps = Results(LIEW_LIM).maps
    across, up = (column + 0.5) / 121, (row + 0.5) / 91
    for index, term in ((K_XY, "k_xy"), (STIFFNESS_TERMS.index("k_ryry"), "k_ryry")):
        page.mouse.move(*place(page, index, 0.5, 0.5))
        page.mouse.move(*place(page, index, across, up))
        tooltip = page.locator(".bk-Tooltip div:has(> b)").filter(visible=True)
        expect(tooltip).to_be_visible()
        text = tooltip.inner_text().replace("\u2212", "-")
        value, prefix = re.findall(r"(-?[\d.]+) ([kM]?)N", text)[0]
        found = float(value) * {"": 1.0, "k": 1e3, "M": 1e6}[prefix]
        near = maps.term(term)[row - 1 : row + 2, column - 2 : column + 3]
        slack = 0.01 * np.abs(maps.term(term)).max()
        assert near.min() - slack <= found <= near.max() + slack
        assert float(re.findall(r"Extent (\d+\.\d)°", text)[0]) == pytest.approx(row, abs=1.2)
        unit = TERM_UNITS[term].split("/")[1]
        assert unit in text


@pytest.mark.proof
def test_every_change_that_is_waited_for_is_drawn(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_maps(page, explorer)
    frames = page.evaluate("window.__frames")
    for step in range(1, 13):
        move(slider(page, "fy_n"), -2000 - 40 * step)
        page.wait_for_function("window.__mark >= window.__asked")
    assert page.evaluate("window.__frames") - frames >= 12
    assert slider(page, "fy_n").input_value() == "-2480"
    low = StiffnessMaps(PackedSource()).data(Results(LIEW_LIM.replace(fy=-2480.0)))[0]["maps_cells"]
    np.testing.assert_allclose(source(page, "maps_cells")["now"], low["now"], rtol=1e-4, atol=1e-3)


@pytest.mark.proof
def test_the_maps_are_saved_as_numbers(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_maps(page, explorer)
    with page.expect_download() as download:
        export(page.locator(".view-maps"), "csv").click()
    lines = download.value.path().read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1 + 91 * 121
    assert lines[0].startswith("extent_deg,cage_angle_deg,loaded_balls,")
    last = [float(number) for number in lines[-1].split(",")]
    assert last[0] == pytest.approx(90.0)
    assert last[1] == pytest.approx(math.degrees(LIEW_LIM.bearing.ball_spacing))
