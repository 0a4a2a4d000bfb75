"""The first minute: the overview, the way in, captions, menus, zoom, and tabs that take a while."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, ViewportSize, expect

from tests.browser.explorer_page import (
    export,
    open_page,
    painted,
    place,
    rest,
    settle,
    show,
    slider,
    source,
    status,
)
from tests.browser.helpers import Server, Watch, drag, move

LAPTOP: ViewportSize = {"width": 1366, "height": 768}
PHONE: ViewportSize = {"width": 390, "height": 844}
SCROLLS = """() => {
  const main = document.querySelector("main")
  return [main.scrollHeight - main.clientHeight, main.scrollWidth - main.clientWidth]
}"""


def visit(page: Page, explorer: Server) -> None:
    """As somebody who has never been here."""
    page.goto(explorer.url)
    page.evaluate("localStorage.removeItem('bearing-explorer.welcomed')")
    page.reload()
    page.wait_for_function("window.__frames >= 1")
    settle(page)


def sentence(page: Page) -> Locator:
    return page.locator(".view-last-change [role=status]")


@pytest.mark.proof
def test_the_first_visit(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    page.set_viewport_size(LAPTOP)
    visit(page, explorer)
    expect(page.locator(".section-overview.on-screen")).to_be_visible()
    welcome = page.get_by_role("region", name="What this is")
    expect(welcome).to_be_visible()
    painted(page)
    page.wait_for_function(f"({SCROLLS})().join() === '0,0'")

    welcome.get_by_role("button", name="Python").click()
    door = page.get_by_role("dialog", name="The same in Python")
    expect(door).to_contain_text("from bearingcore import equilibrium, modes, presets")
    page.keyboard.press("Escape")
    expect(door).to_be_hidden()
    welcome.get_by_role("button", name="My machine").click()
    expect(page.locator(".section-bearing.on-screen")).to_be_visible()
    expect(welcome).to_be_hidden()

    page.reload()
    page.wait_for_function("window.__frames >= 1")
    expect(welcome).to_be_hidden()
    what = page.get_by_role("button", name="What this is")
    expect(what).to_have_attribute("aria-expanded", "false")
    what.click()  # which leads back to it, wherever one is
    expect(page.locator(".section-overview.on-screen")).to_be_visible()
    expect(welcome).to_be_visible()
    expect(what).to_have_attribute("aria-expanded", "true")
    welcome.get_by_role("button", name="Learn").click()
    expect(page.locator(".lesson h2").first).to_be_visible()
    expect(welcome).to_be_hidden()


def test_the_chain_follows_the_hand_on_one_screen(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    page.set_viewport_size(LAPTOP)
    page.goto(explorer.url)
    page.evaluate("localStorage.setItem('bearing-explorer.welcomed', '1')")
    page.reload()
    page.wait_for_function("window.__frames >= 1")
    settle(page)
    page.wait_for_function(f"({SCROLLS})().join() === '0,0'")
    expect(sentence(page)).to_contain_text("With the defect: ")
    expect(sentence(page).locator("sub").first).to_have_text("yy")
    names = ("overview_bearing_balls", "overview_lively", "overview_bands", "overview_lines")
    before = {name: source(page, name) for name in names}
    drag(page, slider(page, "extent_deg"), 0.1, 0.33)
    rest(page)
    after = {name: source(page, name) for name in names}
    assert [name for name in names if after[name] == before[name]] == []
    expect(sentence(page)).to_have_text(
        re.compile(r"(Extent|A ball spacing longer) \(12\.9 → .*: the load moves outwards, .*Hz")
    )
    page.get_by_role("button", name="Undo", exact=True).click()
    expect(sentence(page)).to_contain_text("the load moves inwards")
    frames = page.evaluate("window.__frames")
    page.get_by_role("button", name="Turn the bearing").click()  # no change of the scene
    page.wait_for_function(f"window.__frames > {frames + 5}")
    page.get_by_role("button", name="Stop turning").click()
    expect(sentence(page)).to_contain_text("the load moves inwards")

    page.set_viewport_size(PHONE)
    page.wait_for_function(f"({SCROLLS})()[1] === 0")
    for view in ("overview-bearing", "overview-spectrum", "last-change"):
        card = page.locator(f".view-{view}").bounding_box()
        assert card is not None
        assert card["height"] > 80, f"{view} is squashed"
    page.set_viewport_size(LAPTOP)
    for view, tab in (("bearing", "load"), ("bands", "modes"), ("spectrum", "vibration")):
        lead = page.locator(f".view-overview-{view} .lead")
        lead.focus()
        page.keyboard.press("Enter")
        expect(page.locator(f".section-{tab}.on-screen")).to_be_visible()
        page.wait_for_function(f"window.__tab == '{tab}'")
        show(page, "overview")


@pytest.mark.proof
def test_all_fits_with_every_contact_law(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    page.set_viewport_size(LAPTOP)
    open_page(page, explorer, "model")
    for law in page.locator("#choice-law option").evaluate_all("all => all.map((o) => o.value)"):
        show(page, "model")
        page.locator("#choice-law").select_option(law)
        show(page, "overview")
        rest(page)
        page.wait_for_function(f"({SCROLLS})().join() === '0,0'")


def test_links_open_where_they_always_did(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    for link, tab in (
        ("?v=1&preset=fan-rig&tab=stiffness", "stiffness"),
        ("?v=1&preset=fan-rig&extent_deg=20", "load"),
        ("?from=mail", "overview"),
    ):
        page.goto(explorer.url + link)
        page.wait_for_function("window.__frames >= 1")
        expect(page.locator(f".section-{tab}.on-screen")).to_be_visible()


def test_a_card_has_one_line_one_menu_and_the_rest_on_demand(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    page.set_viewport_size(LAPTOP)
    open_page(page, explorer, "stiffness")
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
    expect(opener).to_have_attribute("aria-expanded", "false")
    opener.press("Enter")
    expect(opener).to_have_attribute("aria-expanded", "true")
    items = view.get_by_role("menuitem")
    expect(items).to_have_count(5)
    expect(items.nth(0)).to_be_focused()
    for key, index in (("ArrowDown", 1), ("End", 4), ("ArrowDown", 0), ("ArrowUp", 4)):
        page.keyboard.press(key)
        expect(items.nth(index)).to_be_focused()
    page.keyboard.press("Escape")
    expect(items.nth(0)).to_be_hidden()
    expect(opener).to_be_focused()
    expect(opener).to_have_attribute("aria-expanded", "false")
    export(view, "table").click()
    dialog = view.get_by_role("dialog")
    expect(dialog).to_be_visible()
    expect(items.nth(0)).to_be_hidden()
    page.keyboard.press("Escape")

    details = page.locator("footer .status").get_by_role("button", name="Details")
    listed = status(page).locator(".list")
    expect(listed).to_be_hidden()
    expect(page.locator("footer .status [role=status]")).to_have_text("Converged")
    details.press("Enter")
    expect(listed).to_contain_text("residual at most")
    page.keyboard.press("Escape")
    expect(listed).to_be_hidden()
    expect(details).to_be_focused()


RANGE = """view => {
  const inside = (root) => {
    for (const element of root.querySelectorAll("*")) {
      if (element.matches(`.view-${view}`)) return element
      const found = element.shadowRoot && inside(element.shadowRoot)
      if (found) return found
    }
  }
  const card = inside(document)
  const holds = (node) => node && (node === card || holds(node.parentNode ?? node.host))
  for (const { model, el } of Bokeh.index.query((v) => v.model.type === "Figure"))
    if (holds(el)) return [model.x_range.start, model.x_range.end]
}"""


NAMES_OF_BANDS = """() => {
  const [plot] = [...Bokeh.index.query(({ model }) => model.type === "Figure")]
    .map(({ model }) => model).filter(({ extra_x_ranges }) => extra_x_ranges.has?.("shares")
      ?? extra_x_ranges.shares)
  const [{ glyph, data_source }] = plot.renderers.filter(({ glyph }) => glyph?.type === "Text")
  return [...glyph.text.expr.v_compute(data_source)]
}"""


def test_figures_zoom_stay_zoomed_and_go_back(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    page.set_viewport_size(LAPTOP)
    open_page(page, explorer, "modes")

    def shown() -> list[float]:
        painted(page)
        found: Any = page.evaluate(RANGE, "modes")
        return [float(end) for end in found]

    box = page.locator(".view-modes canvas").first.bounding_box()
    assert box is not None
    x, y = box["x"] + 0.4 * box["width"], box["y"] + 0.5 * box["height"]
    whole = shown()
    page.mouse.move(x, y)
    page.mouse.wheel(0, -200)
    assert shown() == whole, "the wheel alone scrolls the page"
    page.keyboard.down("Control")
    page.mouse.wheel(0, -200)
    page.keyboard.up("Control")
    near = shown()
    assert near[1] - near[0] < 0.9 * (whole[1] - whole[0])
    move(slider(page, "extent_deg"), 25)
    settle(page)
    assert shown() == near, "what is drawn anew does not take the place away"
    page.mouse.dblclick(x, y)
    assert shown() == whole
    page.wait_for_timeout(500)  # or what follows would be a third click
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 9):
        page.mouse.move(x + 14 * step, y + 8 * step)
    page.mouse.up()
    boxed = shown()
    assert whole[0] < boxed[0] < boxed[1] < whole[1]
    assert not any(page.evaluate(NAMES_OF_BANDS)), "names stand beside bands that are out of view"
    page.wait_for_timeout(500)
    page.mouse.dblclick(x, y)
    assert shown() == whole
    assert [name[:2] for name in page.evaluate(NAMES_OF_BANDS)] == ["x₁", "y₁", "x₂", "y₂"]

    # many maps on one canvas: whoever zooms into one finds its numbers at the edge
    show(page, "maps")
    axes = """() => {
      const [{ model }] = [...Bokeh.index.query(view => view.model.name === "maps_drawing")]
      const words = ({ visible, axis_label, formatter }) =>
        visible && [axis_label, formatter.args.get?.("shown") ?? formatter.args.shown]
      return [...model.left, ...model.below].map(words).map((found) =>
        found && [found[0], found[1].data.words])
    }"""
    assert page.evaluate(axes) == [False, False]
    x, y = place(page, "maps_drawing", 1.3, -4.0)
    page.mouse.move(x, y)
    page.keyboard.down("Control")
    for _ in range(8):
        page.mouse.wheel(0, -200)
    page.keyboard.up("Control")
    painted(page)
    left, below = page.evaluate(axes)
    assert left[0] == "Extent Δφf (°)"
    assert below[0] == "Loaded balls over cage angle φc (°)"
    for _, numbers in (left, below):
        degrees = [float(number) for number in numbers]
        assert len(degrees) >= 2
        assert degrees == sorted(degrees)
        assert 0.0 <= degrees[0] < degrees[-1] <= 91.0
    page.wait_for_timeout(500)
    page.mouse.dblclick(x, y)
    painted(page)
    assert page.evaluate(axes) == [False, False]


@pytest.mark.proof
def test_a_tab_that_takes_a_while_says_so_at_once(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    rest(page)
    asked = page.locator(".tab-orbits").evaluate(
        """tab => {
          tab.click()
          const main = document.querySelector("main")
          return [tab.getAttribute("aria-selected"), main.hasAttribute("data-waiting"),
                  document.getElementById("waiting").textContent]
        }"""
    )
    assert asked == ["true", True, "Orbits is being built …"]
    page.wait_for_function("window.__tab == 'orbits'")
    page.wait_for_function("!document.querySelector('main').hasAttribute('data-waiting')")
    expect(page.locator("#waiting")).to_be_empty()
    # there and back before it stands: nothing is waited for in vain
    page.evaluate(
        """() => {
          for (const name of ["maps", "orbits"])
            window.dispatchEvent(new CustomEvent("explorer-show", { detail: name }))
        }"""
    )
    page.wait_for_function("!document.querySelector('main').hasAttribute('data-waiting')")
