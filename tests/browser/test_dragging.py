"""A slider in motion: what is sent, what is drawn last, and what is one step to take back."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import settle, slider, value, wait
from tests.browser.helpers import Server, Watch, drag, unfold
from tests.browser.visitor import Visitor


def query(page: Page) -> str:
    return page.evaluate("location.search").removeprefix("?")


def opened(page: Page, server: Server, text: str) -> None:
    page.goto(f"{server.url}?{text}")
    page.wait_for_function("window.__frames >= 1")
    unfold(page)
    settle(page)


def test_the_address_follows_the_hand_and_steps_go_back(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, watching = watch
    opened(page, explorer, "")
    assert query(page) == "", "nothing is written before anything is done"
    entries = page.evaluate("history.length")
    undo = page.locator("#undo")  # hidden while there is nothing to undo
    expect(undo).to_be_disabled()

    page.evaluate(
        """() => {
          const old = history.replaceState
          window.__replaced = 0
          history.replaceState = (...a) => { window.__replaced++; old.apply(history, a) }
        }"""
    )
    frames, asked = watching.frames_sent, page.evaluate("window.__asked || 0")
    drag(page, slider(page, "extent_deg"), 0.1, 0.6, steps=25)
    settle(page)
    # a message may be of several frames; with its packets sent back it would be of many more
    changes = page.evaluate("window.__asked") - asked
    assert 0 < watching.frames_sent - frames <= 4 * (changes + 2)
    first = value(page, "extent_deg")
    page.wait_for_function("location.search.includes('extent_deg')")
    assert page.evaluate("window.__replaced") <= 2, "once a drag, not once a position"
    drag(page, slider(page, "depth_um"), 0.1, 0.4)
    settle(page)
    page.locator("#choice-edge").select_option("exact")
    page.wait_for_function("location.search.includes('edge=exact')")
    assert f"extent_deg={first:g}&" in query(page)

    for gone in ("edge=exact", "depth_um", "extent_deg"):
        page.keyboard.press("Control+z")
        page.wait_for_function(f"!location.search.includes('{gone}')")
    settle(page)
    assert value(page, "extent_deg") == 12.9, "a drag is one step"
    expect(undo).to_be_disabled()
    page.keyboard.press("Control+Shift+z")
    page.wait_for_function("location.search.includes('extent_deg')")
    settle(page)
    assert value(page, "extent_deg") == first

    # A key held down is one step, and text has an undo of its own.
    slider(page, "fy_n").focus()
    for _ in range(5):
        page.keyboard.down("ArrowRight")
    page.keyboard.up("ArrowRight")
    page.wait_for_function("location.search.includes('fy_n')")
    settle(page)
    assert value(page, "fy_n") == 105
    field = page.locator(".control-fy_n .number")
    field.fill("5")
    field.press("Control+z")
    assert value(page, "fy_n") == 105
    field.press("Escape")
    undo.click()
    page.wait_for_function("!location.search.includes('fy_n')")
    page.get_by_role("button", name="Reset", exact=True).click()
    page.wait_for_function("location.search == '?v=1&preset=fan-rig&tab=overview'")
    undo.click()
    page.wait_for_function("location.search.includes('extent_deg')")
    settle(page)
    assert page.evaluate("history.length") == entries + 1, "all changes are one entry"
    for there, extent in ((page.go_back, 12.9), (page.go_forward, first), (page.go_back, 12.9)):
        there()
        wait(page, lambda extent=extent: value(page, "extent_deg") == extent)
        settle(page)
    drag(page, slider(page, "extent_deg"), 0.1, 0.6)
    page.wait_for_function("location.search.includes('extent_deg')")
    page.go_back()
    wait(page, lambda: value(page, "extent_deg") == 12.9)


# a page that is quick enough has drawn each position before the next, and none would wait
_NOTHING_IS_DRAWN = """() => {
  const frame = requestAnimationFrame, drawn = window.__mark
  let newest = drawn
  window.requestAnimationFrame = () => 0
  Object.defineProperty(window, "__mark",
    { configurable: true, get: () => drawn, set: (mark) => { newest = mark } })
  window.__go_on = () => {
    window.requestAnimationFrame = frame
    Object.defineProperty(window, "__mark", { configurable: true, writable: true, value: newest })
  }
}"""


@pytest.mark.proof
def test_nothing_overtakes_a_position_that_waits(page: Page, explorer: Server) -> None:
    """A hand's last position may wait for the screen: a choice or an undo comes after it."""
    opened(page, explorer, "")
    page.evaluate(_NOTHING_IS_DRAWN)
    drag(page, slider(page, "depth_um"), 0.1, 0.4)
    last = value(page, "depth_um")
    assert page.evaluate("window.__waiting.size") == 1
    page.locator("#choice-edge").select_option("exact")
    page.evaluate("window.__go_on()")
    page.wait_for_function("location.search.includes('edge=exact')")
    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('edge=exact')")
    assert f"depth_um={last:g}" in query(page)
    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('depth_um')")
    settle(page)
    assert value(page, "depth_um") == 50, "a drag is one step"


@pytest.mark.proof
def test_a_sentence_does_not_resize_the_drawing_above_it(desk: Visitor) -> None:
    page = desk.page
    page.set_viewport_size({"width": 1280, "height": 800})
    desk.begin("Load")
    sentence = page.locator(".view-bearing p[role=status]")
    heights, lengths = [], []
    for extent in ("30", "8", "30"):
        slider(page, "extent_deg").fill(extent)
        settle(page)
        lengths.append(len(sentence.inner_text()))
        heights.append(page.locator(".view-bearing canvas").first.bounding_box()["height"])
    assert lengths[0] == lengths[2] < lengths[1]
    assert heights[0] == heights[1] == heights[2]
