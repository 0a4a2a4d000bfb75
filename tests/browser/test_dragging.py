"""A slider in motion: what is sent, what is drawn last, and what is one step to take back."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.browser.explorer_page import (
    number,
    open_page,
    settle,
    slider,
    value,
)
from tests.browser.helpers import Server, drag, move, unfold


def test_a_queue_on_the_server_is_not_made_longer(page: Page, explorer: Server) -> None:
    """Two changes may be on their way; where the last waited for others the next waits here."""
    open_page(page, explorer)
    # The clock of the network is the test's own: each change takes 20 ms there, some wait longer.
    page.evaluate(
        """() => {
        let asked = window.__asked || 0, asked_at = 0, arrived = window.__arrived
        window.__wait = 0
        Object.defineProperty(window, "__asked", {
          get: () => asked,
          set: (mark) => { asked = mark; asked_at = performance.now() },
        })
        Object.defineProperty(window, "__arrived", {
          get: () => arrived,
          set: () => { arrived = asked_at + 1000 * window.__worked + 20 + window.__wait },
        })
      }"""
    )
    thumb = slider(page, "extent_deg")
    assert move(thumb, 20) == 1
    settle(page)  # the time on the network is known
    for waited, newest, sent_at_once in ((0, 45, {2}), (300, 46, {0, 1})):
        page.evaluate("waited => { window.__wait = waited }", waited)
        assert move(thumb, 22) == 1
        settle(page)
        asked = page.evaluate("window.__asked")
        sent = move(thumb, 25, 30, 35, 40, newest)
        page.wait_for_function(f"window.__asked > {asked + sent}")  # the newest, a little later
        settle(page)
        assert number(page, "extent_deg").input_value() == str(newest)
        assert sent in sent_at_once


def test_a_repaint_writes_no_style_sheet_that_stays_the_same(page: Page, explorer: Server) -> None:
    """Each would have the browser work out the styles of the page anew."""
    open_page(page, explorer)
    page.evaluate(
        """() => {
        const texts = new Map()
        window.__rewritten = 0
        const seen = (records) => {
          for (const { target } of records) {
            if (target.nodeName !== "STYLE") continue
            if (texts.get(target) === target.textContent) window.__rewritten++
            texts.set(target, target.textContent)
          }
        }
        const observe = (root) => {
          new MutationObserver(seen).observe(root, { subtree: true, childList: true })
          for (const element of root.querySelectorAll("*")) {
            if (element.nodeName === "STYLE") texts.set(element, element.textContent)
            if (element.shadowRoot) observe(element.shadowRoot)
          }
        }
        observe(document)
        // what is to be found is found: a sheet of a figure written anew
        const { InlineStyleSheet } = Bokeh.require("core/dom")
        const extra = new InlineStyleSheet("a {}")
        document.body.append(extra.el)
        texts.set(extra.el, extra.el.textContent)
        extra.el.textContent = extra.el.textContent
      }"""
    )
    page.wait_for_function("window.__rewritten === 1")
    paints = page.evaluate("window.__frames")
    drag(page, slider(page, "extent_deg"), 0.3, 0.6)
    settle(page)
    assert page.evaluate("window.__frames") > paints
    assert page.evaluate("window.__rewritten") == 1, "a style sheet was written anew as it was"


def query(page: Page) -> str:
    return page.evaluate("location.search").removeprefix("?")


def opened(page: Page, server: Server, text: str) -> None:
    page.goto(f"{server.url}?{text}")
    page.wait_for_function("window.__frames >= 1")
    unfold(page)
    settle(page)


def test_the_address_follows_the_hand_and_steps_go_back(page: Page, explorer: Server) -> None:
    opened(page, explorer, "")
    assert query(page) == "", "nothing is written before anything is done"
    entries = page.evaluate("history.length")
    undo, redo = (page.get_by_role("button", name=name, exact=True) for name in ("Undo", "Redo"))
    expect(undo).to_be_disabled()

    page.evaluate(
        """() => {
          const old = history.replaceState
          window.__replaced = 0
          history.replaceState = (...a) => { window.__replaced++; old.apply(history, a) }
        }"""
    )
    drag(page, slider(page, "extent_deg"), 0.1, 0.6, steps=25)
    settle(page)
    first = value(page, "extent_deg")
    page.wait_for_function("location.search.includes('extent_deg')")
    assert page.evaluate("window.__replaced") <= 2, "once a drag, not once a position"
    drag(page, slider(page, "depth_um"), 0.1, 0.4)
    settle(page)
    page.locator("#choice-edge").select_option("exact")
    page.wait_for_function("location.search.includes('edge=exact')")
    assert f"extent_deg={first:g}&" in query(page)

    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('edge=exact')")
    expect(page.locator("#choice-edge")).to_have_value("published")
    undo.click()
    page.wait_for_function("!location.search.includes('depth_um')")
    assert value(page, "depth_um") == 50
    undo.click()
    page.wait_for_function("!location.search.includes('extent_deg')")
    settle(page)
    assert value(page, "extent_deg") == 12.9, "a drag is one step"
    expect(undo).to_be_disabled()
    page.keyboard.press("Control+Shift+z")
    page.wait_for_function("location.search.includes('extent_deg')")
    settle(page)
    assert value(page, "extent_deg") == first
    expect(redo).to_be_enabled()

    # A key held down is one step, and text has an undo of its own.
    slider(page, "fy_n").focus()
    for _ in range(5):
        page.keyboard.down("ArrowRight")
    page.keyboard.up("ArrowRight")
    page.wait_for_function("location.search.includes('fy_n')")
    settle(page)
    assert value(page, "fy_n") == -95
    field = page.locator(".control-fy_n .number")
    field.fill("-5")
    field.press("Control+z")
    assert value(page, "fy_n") == -95
    field.press("Escape")
    undo.click()
    page.wait_for_function("!location.search.includes('fy_n')")
    page.get_by_role("button", name="Reset", exact=True).click()
    page.wait_for_function("location.search == '?v=1&preset=fan-rig&tab=overview'")
    undo.click()
    page.wait_for_function("location.search.includes('extent_deg')")
    assert page.evaluate("history.length") == entries, "Back leaves the page"


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
