"""Keyboard, screen readers, contrast in light and dark, and small screens."""

import re
import time
from importlib.resources import files

import pytest
from bearing_explorer.kit.plots.theme import DARK_COLORS
from bearing_explorer.page import SECTIONS
from playwright.sync_api import Page, ViewportSize, expect

from tests.browser.explorer_page import (
    SEEN,
    export,
    largest_share,
    open_page,
    settle,
    show,
    slider,
    status,
    value,
    wait,
)
from tests.browser.helpers import Server
from tests.browser.visitor import Visitor

NAMES = list({part.tab or part.title: part.name for part in reversed(SECTIONS)}.values())[::-1]
"""Of the tabs, each by that of its first part."""

LAPTOP: ViewportSize = {"width": 1366, "height": 768}
PHONE: ViewportSize = {"width": 390, "height": 844}
PAPERS = {"light": {"#FFFFFF", "WHITE"}, "dark": {DARK_COLORS["#FFFFFF"]}}
"""Grounds of the figures."""


def opened(page: Page, server: Server, tab: str) -> None:
    page.add_init_script(SEEN)
    open_page(page, server, tab)


def findings(page: Page, where: str) -> list[str]:
    """Return faults that axe calls serious or critical in a part of the page."""
    result = page.evaluate(
        """async (where) => {
             const options = { preload: false, resultTypes: ['violations'] }
             const { violations } = await axe.run(where, options)
             return violations.map(({ id, impact, nodes }) => [impact, `${id}: ` +
               JSON.stringify(nodes.slice(0, 3).map(n => [n.target, n.failureSummary]))])
           }""",
        where,
    )
    return [words for impact, words in result if impact in ("serious", "critical")]


def colors(page: Page) -> set[str]:
    """Grounds of the figures on screen."""
    result = page.evaluate(
        """() => Object.values(Bokeh.index.roots ?? []).flatMap(view => {
             const plots = []
             for (const model of view.model.document._all_models.values())
               if (model.type === 'Figure') plots.push(model.background_fill_color)
             return plots
           }).map(c => c?.value ?? c)"""
    )
    return {str(color).upper() for color in result if color is not None}


def make_ready(page: Page) -> None:
    """Load the scripts that `hold_to_rules` needs on an open page."""
    page.evaluate(SEEN)
    page.evaluate((files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8"))


def hold_to_rules(page: Page, theme: str, where: str = "main") -> None:
    """The open tab by the rules of axe in the colours that are on, and on a phone."""
    expect(page.locator("html")).to_have_attribute("data-theme", theme)
    # a tab is dimmed until it is there
    page.wait_for_function(
        """() => [...document.querySelectorAll('main > div')]
             .every(part => getComputedStyle(part).opacity === '1')"""
    )
    assert findings(page, where) == []
    assert colors(page) <= PAPERS[theme]
    assert silent_figures(page) == []
    assert sideways(page) == []
    page.set_viewport_size(PHONE)
    fits(page)
    page.set_viewport_size(LAPTOP)
    page.evaluate("localStorage.removeItem('bearing-explorer.theme')")


#: how much is on screen of the first figure [px], and the controls above it in its tab
FIRST_FIGURE = """() => {
  const main = document.querySelector("main"), room = main.getBoundingClientRect()
  const shown = [...deep(main, "canvas, svg.picture")].filter(
    (one) => one.checkVisibility({ visibilityProperty: true }) && one.clientHeight > 60)
  const boxes = shown.map((one) => one.getBoundingClientRect()).sort((a, b) => a.top - b.top)
  const top = boxes[0]?.top ?? room.bottom
  const controls = [...deep(main, "input, select, textarea, .bk-btn")]
    .filter((one) => one.checkVisibility() && one.getBoundingClientRect().bottom <= top)
  return [boxes.length && Math.min(boxes[0].bottom, room.bottom) - top, controls.length]
}"""


def hold_to_screens(page: Page) -> None:
    """The first figure of the open tab is seen without scrolling past controls.

    It is whole on a low laptop, also with the large type of a projector, and in part on a phone and
    on a laptop at 200 %.
    """
    for projected in (True, False):
        page.evaluate(
            "on => dispatchEvent(new CustomEvent('explorer-projector', { detail: on }))", projected
        )
        page.set_viewport_size({"width": 1366, "height": 650})
        settle(page)
        if page.locator(".bk-Figure").locator("visible=true").count():
            wait(page, lambda: largest_share(page) > 0.99)
    for width, height in ((390, 844), (683, 325)):
        page.set_viewport_size({"width": width, "height": height})
        settle(page)
        page.wait_for_function(
            f"high => {{ const [part, above] = ({FIRST_FIGURE})(); return part > high && !above }}",
            arg=0.3 * height,
            timeout=20_000,
        )
    page.set_viewport_size(LAPTOP)


def silent_figures(page: Page) -> list[str]:
    """Figures on screen without a title or a sentence for screen readers.

    Cards without a figure yet may have nothing to say.
    """
    return page.evaluate(
        """() => [...deep(document.querySelector('main'), '.on-screen')].flatMap(section =>
             [...deep(section.shadowRoot, '.view')]).filter(view => {
               if (!view.getClientRects().length) return false  // a card that waits for a file
               const words = [...deep(view.shadowRoot, '[role=status]')].map(e => e.textContent)
               const title = [...deep(view.shadowRoot, 'h2')]
               const seen = [...deep(view.shadowRoot, 'canvas, svg.picture')]
                 .some(figure => figure.getClientRects().length)
               if (title.length === 1 && !seen) return false
               return title.length !== 1 || !words.some(text => text.trim())
             }).map(view => view.className)"""
    )


def fits(page: Page) -> None:
    """Figures take their time to follow a change of the screen, and then all fits."""
    end = time.monotonic() + 120.0
    while sideways(page) and time.monotonic() < end:
        page.wait_for_timeout(50)
    assert sideways(page) == []


def sideways(page: Page) -> list[str]:
    """Parts that would have to be scrolled sideways, or are cut by the edge of the page."""
    return page.evaluate(
        """() => {
          const odd = []
          const main = document.querySelector('main')
          if (document.documentElement.scrollWidth > innerWidth) odd.push('the page')
          if (main.scrollWidth > main.clientWidth) odd.push('main')
          for (const view of deep(main, '.view'))
            if (view.getBoundingClientRect().right > innerWidth) odd.push(view.className)
          const boxes = ['.brand', 'nav', '.tools'].map(name =>
            document.querySelector(name).getBoundingClientRect())
          boxes.forEach((box, i) => {
            const next = boxes[i + 1]
            if (next && box.right > next.left + 0.5) odd.push('parts of the head overlap')
          })
          for (const button of deep(document.querySelector('.top'), 'button, select'))
            if (button.getBoundingClientRect().right > innerWidth + 0.5)
              odd.push(button.textContent)
          return odd
        }"""
    )


def test_a_phone_has_room_for_figures_and_lessons(page: Page, explorer: Server) -> None:
    page.set_viewport_size(PHONE)
    opened(page, explorer, "stiffness")
    expect(page.get_by_role("tab", name="Load")).to_be_hidden()
    high = page.locator("main").evaluate("one => one.clientHeight")
    assert high > 380, "the figures have the larger part"
    controls = page.locator("#controls")
    expect(controls).to_be_visible()
    show(page, "accuracy")  # where the scene matters little it waits behind a button
    expect(controls).to_be_hidden()
    page.locator("#scene-button").press("Enter")
    expect(controls).to_be_visible()
    page.get_by_role("button", name="Lessons").click()
    expect(page.locator(".lesson h2")).to_be_visible()
    settle(page)
    assert sideways(page) == []


# --- keyboard -------------------------------------------------------------------------------------


@pytest.mark.proof
def test_everything_is_reached_by_keys(page: Page, explorer: Server) -> None:
    opened(page, explorer, "load")
    extent = slider(page, "extent_deg")
    extent.focus()
    for key, expected in (
        ("ArrowRight", 13.0), ("ArrowLeft", 12.9), ("PageUp", 24.9), ("PageDown", 12.9),
        ("End", 120.0), ("Home", 0.0),
    ):  # fmt: skip
        extent.press(key)
        assert value(page, "extent_deg") == pytest.approx(expected), key
    settle(page)
    expect(extent).to_have_attribute("aria-valuetext", "0 °")
    field = page.locator(".control-extent_deg .number")
    field.focus()
    field.press("PageUp")
    expect(field).to_have_value("1")
    # space plays, also from a slider, and not where somebody types
    extent.focus()
    page.keyboard.press("Space")
    stop = page.get_by_role("button", name="Stop turning")
    expect(stop).to_be_visible()
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Turn the bearing")).to_be_visible()
    field.focus()
    page.keyboard.press("Space")
    expect(stop).to_have_count(0)
    field.press("Escape")
    # tabs
    page.locator(".tab-load").focus()
    page.keyboard.press("ArrowRight")
    after = NAMES[NAMES.index("load") + 1]
    expect(page.locator(f".tab-{after}")).to_be_focused()
    expect(page.locator(f".section-{after}.on-screen")).to_be_visible()
    page.keyboard.press("Home")
    expect(page.locator(".section-overview.on-screen")).to_be_visible()
    settle(page)
    # from the top of the page: where the focus is can be seen, wherever it is
    skip = page.get_by_role("link", name="To the figures")
    skip.focus()
    expect(skip).to_be_in_viewport(ratio=1)
    seen = []
    for _ in range(45):
        page.keyboard.press("Tab")
        if page.evaluate("focused() === document.body"):  # past the last control
            break
        seen.append(
            page.evaluate(
                """() => {
                  const at = focused(), style = getComputedStyle(at)
                  const ring = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 1
                  const box = at.getBoundingClientRect()
                  const name = at.id || at.getAttribute('aria-label') || at.textContent
                  return [name, ring || at.type === 'range', box.width > 0 && box.height > 0]
                }"""
            )
        )
    assert len({name for name, _, _ in seen}) > 25, str(seen)
    assert [name for name, ring, _ in seen if not ring] == []
    assert [name for name, _, there in seen if not there] == []


@pytest.mark.proof
def test_a_view_fills_the_page_and_the_screen(desk: Visitor) -> None:
    page = desk.page
    page.evaluate(SEEN)
    page.set_viewport_size({"width": 1920, "height": 1080})
    desk.begin("Frequencies")
    page.wait_for_function(  # no part of the page is empty, and none out of view
        """() => {
          const [view] = [...deep(document, '.view-modes')], main = document.querySelector('main')
          if (!view) return false
          const left = main.getBoundingClientRect().bottom - view.getBoundingClientRect().bottom
          return left > 0 && left < 40
        }"""
    )
    show(page, "vibration")
    view = page.locator(".view-vibration-time")
    heights = "all => all.map(part => part.getBoundingClientRect().height)"
    before = view.locator("canvas").evaluate_all(heights)
    enlarge = view.locator(".enlarge")
    enlarge.press("Enter")
    expect(enlarge).to_have_text("Close")
    assert view.bounding_box() == {"x": 0.0, "y": 0.0, "width": 1920.0, "height": 1080.0}
    large = "([all, least]) => all.every(part => part.getBoundingClientRect().height > least)"
    page.wait_for_function(
        f"least => ({large})([[...deep(document, '.view-vibration-time')].flatMap(view =>"
        " [...deep(view.shadowRoot, 'canvas')]).filter(part => part.clientHeight), least])",
        arg=1.4 * max(before),
    )
    enlarge.press("Escape")
    expect(enlarge).to_have_text("Enlarge")
    expect(enlarge).to_be_focused()
    settle(page)
    assert view.locator("canvas").evaluate_all(heights) == before


@pytest.mark.proof
def test_help_and_menus_are_gone_through_by_keys(desk: Visitor) -> None:
    page = desk.page
    page.evaluate(SEEN)
    desk.begin("Stiffness")
    helps = page.locator("aside .control .symbol")
    assert helps.count() >= 10
    expect(page.locator("aside .control-fy_n .named")).to_have_attribute(
        "title",
        re.compile(
            r"Vertical force on the inner ring\..*\nIn N; the slider goes from −500 to 500\sN"
        ),
    )
    about = page.get_by_role("button", name="About load, downwards")
    note = page.locator("#control-fy_n-about")
    expect(note).to_be_hidden()
    slider(page, "fy_n").focus()  # the symbol of a slider comes with the focus
    about.press("Enter")
    expect(note).to_be_visible()
    expect(about).to_have_attribute("aria-expanded", "true")
    assert "Eq" not in note.inner_text()
    missing = page.evaluate(
        """() => [...deep(document, '.control')].filter(control =>
             !control.querySelector('[id$=-about]')?.textContent.trim()).map(c => c.className)"""
    )
    assert missing == []

    view = page.locator(".view-stiffness")
    line = view.locator("header .line").bounding_box()
    assert line is not None
    assert line["height"] < 24
    more = view.get_by_role("button", name="More about")
    rest_of_it = view.locator("header .rest")
    expect(rest_of_it).to_be_hidden()
    more.press("Enter")
    expect(rest_of_it).to_be_visible()
    expect(more).to_have_attribute("aria-expanded", "true")
    more.press("Enter")
    expect(rest_of_it).to_be_hidden()

    opener = view.get_by_role("button", name="Export")
    opener.press("Enter")
    items = view.get_by_role("dialog", name="Export").get_by_role("button")
    expect(items).to_have_count(6)
    expect(items.nth(0)).to_be_focused()
    for key, index in (("Tab", 1), ("Tab", 2), ("Shift+Tab", 1)):
        page.keyboard.press(key)
        expect(items.nth(index)).to_be_focused()
    page.keyboard.press("Escape")
    expect(items.nth(0)).to_be_hidden()
    expect(opener).to_be_focused()
    export(view, "table").click()
    dialog = view.get_by_role("dialog")
    expect(dialog).to_be_visible()
    expect(items.nth(0)).to_be_hidden()
    page.keyboard.press("Escape")

    details = page.locator("footer .status").get_by_role("button", name="Computed without problems")
    listed = status(page).locator(".list")
    expect(listed).to_be_hidden()
    expect(page.locator("footer .status strong[role=status]")).to_have_text(
        "Computed without problems"
    )
    details.press("Enter")
    expect(listed).to_contain_text("residual at most")
    page.keyboard.press("Escape")
    expect(listed).to_be_hidden()
    expect(details).to_be_focused()
