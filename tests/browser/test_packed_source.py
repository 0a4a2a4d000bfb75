"""The packed source, the live sentence and `serve.fast`, in a real browser."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.helpers import PAGES, Server, Watch, page_server, serving


@pytest.fixture(scope="module")
def packed_source_page() -> Iterator[Server]:
    with serving(page_server(PAGES / "packed_source.py")) as server:
        yield server


def test_the_last_packet_is_drawn_whole(
    watch: tuple[Page, Watch], packed_source_page: Server
) -> None:
    page, watching = watch
    page.goto(packed_source_page.url)
    page.wait_for_function("window.__mark == 40")
    frames = watching.frames_sent
    drawn = page.evaluate(
        """() => {
        const plot = Bokeh.documents[0].get_model_by_name("plot")
        const source = Bokeh.documents[0].get_model_by_name("drawn").data_source
        return {y: Array.from(source.data.y).map(v => isNaN(v) ? "gap" : v),
                x: Array.from(source.data.x),
                range: [plot.y_range.start, plot.y_range.end], frames: window.__frames}
        }"""
    )
    assert drawn == {"y": [40, "gap", 40.5], "x": [0, 1, 2], "range": [-40, 80], "frames": 40}
    expect(page.locator(".view-line [role=status]")).to_have_text("The line is at 40.")
    # The browser must not echo what it is sent: 40 packets, but only a handful of messages up.
    assert frames < 40, f"{frames} frames went back to the server"


def test_the_websocket_sends_at_once(page: Page, packed_source_page: Server) -> None:
    page.goto(packed_source_page.url)
    expect(page.locator(".nodelay")).to_contain_text("1")
