"""What only a browser can show of the views: units that follow ranges, words, proportions."""

import pytest
from bearing_explorer.explorer.views.bearing import HALF_WIDTH
from bearing_explorer.kit.plots import style
from playwright.sync_api import Page

from tests.browser.explorer_page import rest, wait
from tests.browser.helpers import Server

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


def test_the_bearing_is_round_and_numbers_are_written_as_by_the_server(
    page: Page, explorer: Server
) -> None:
    page.goto(f"{explorer.url}?v=1&preset=fan-rig&tab=load")
    page.wait_for_function("window.__frames > 0")
    numbers_are_written_alike(page)
    for width in (1366, 700):
        page.set_viewport_size({"width": width, "height": 900})
        rest(page)  # before its first paint a figure has no size
        wait(page, lambda: is_round(shape_of_the_bearing(page)))
