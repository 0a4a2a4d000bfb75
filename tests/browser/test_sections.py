"""Every section comes whole: all its views and figures, also where one changes tabs in a hurry."""

from __future__ import annotations

from typing import Any

import pytest
from bearing_explorer.page import SECTIONS
from playwright.sync_api import Page, ViewportSize

from tests.browser.explorer_page import open_page, painted, rest, show
from tests.browser.helpers import Server, Watch

LAPTOP: ViewportSize = {"width": 1366, "height": 768}
PHONE: ViewportSize = {"width": 390, "height": 844}
EMPTY = {"accuracy": ["accuracy_drawing_seconds"]}
"""Figures without numbers until somebody asks for them to be computed."""
VIEWS = {section.name: [view.name for view in section.views] for section in SECTIONS}

_LOOK = """(tab) => {
  const inside = function* (where) {
    for (const root of [where, where.shadowRoot]) {
      for (const element of root?.children ?? []) {
        yield element
        yield* inside(element)
      }
    }
  }
  const main = document.querySelector("main")
  const sections = [...inside(main)].filter((one) => one.classList.contains("section"))
  const shown = sections.filter((one) => one.classList.contains("on-screen"))
  const within = (element, of) => {
    for (let at = element; at; at = at.parentNode ?? at.host) if (at === of) return true
    return false
  }
  const views = Object.fromEntries([...inside(shown[0])]
    .filter((one) => one.classList.contains("view"))
    .map((one) => {
      const name = [...one.classList].find((word) => word.startsWith("view-")).slice(5)
      const parts = [...inside(one)]
      return [name, {
        captions: parts.filter((part) => part.localName === "header").length,
        sentences: parts.filter((part) => part.getAttribute("role") === "status").length,
      }]
    }))
  // figures that the document has, each with its views, and which of these are blank
  const figures = new Set()
  for (const root of Bokeh.documents[0].roots())
    for (const model of root.references()) if (model.type === "Figure") figures.add(model)
  const of_model = new Map([...figures].map((model) => [model, []]))
  for (const view of Bokeh.index.query((view) => view.model.type === "Figure"))
    of_model.get(view.model)?.push(view)
  const twice = [], never = [], blank = [], empty = []
  let drawn = 0
  for (const [model, found] of of_model) {
    const name = model.name ?? model.id
    if (found.length === 0) never.push(name)
    if (found.length > 1) twice.push(name)
    for (const view of found) {
      if (!within(view.el, shown[0]) || view.el.offsetWidth === 0) continue
      drawn += 1
      const canvas = view.canvas_view.primary.canvas
      const pixels = new Uint32Array(canvas.getContext("2d")
        .getImageData(0, 0, canvas.width, canvas.height).data.buffer)
      if (new Set(pixels).size < 3) blank.push(name)
      const sizes = model.renderers.map(({ data_source }) => data_source.get_length() ?? 0)
      if (Math.max(0, ...sizes) === 0) empty.push(name)
    }
  }
  const right = shown[0].classList.contains(`section-${tab}`)
  return { sections: sections.length, shown: shown.length, tab: right,
           views, never, twice, blank, empty, drawn }
}"""


def look(page: Page, tab: str) -> dict[str, Any]:
    """What stands of a tab; asserts that it is whole."""
    painted(page)
    found: dict[str, Any] = page.evaluate(_LOOK, tab)
    assert found["shown"] == 1
    assert found["tab"]
    assert list(found["views"]) == VIEWS[tab]
    for view, parts in found["views"].items():
        assert parts["captions"] == 1, view
        assert parts["sentences"] >= 1, view
    for fault in ("never", "twice", "blank"):
        assert found[fault] == [], (tab, fault)
    assert found["empty"] == EMPTY.get(tab, [])
    return found


@pytest.mark.proof
@pytest.mark.parametrize("size", [LAPTOP, PHONE], ids=["laptop", "phone"])
def test_every_tab_has_all_of_its_views_and_figures(
    watch: tuple[Page, Watch], explorer: Server, size: ViewportSize
) -> None:
    page, _ = watch
    page.set_viewport_size(size)
    open_page(page, explorer, "overview")
    drawn = {}
    for tab in VIEWS:
        show(page, tab)
        if tab == "explore":
            page.wait_for_function(
                "[...Bokeh.index.query((view) => view.model.name === 'explore_map')].length > 0"
            )
        drawn[tab] = look(page, tab)["drawn"]
    assert drawn["overview"] >= 3
    assert drawn["maps"] >= 1
    assert drawn["explore"] == 4


@pytest.mark.parametrize(("first", "second"), [("diagnosis", "accuracy"), ("maps", "vibration")])
def test_who_changes_tabs_in_a_hurry_finds_both_whole(
    watch: tuple[Page, Watch], explorer: Server, first: str, second: str
) -> None:
    page, _ = watch
    page.set_viewport_size(LAPTOP)
    open_page(page, explorer, "overview")
    page.evaluate(
        """(tabs) => {
          for (const detail of tabs)
            window.dispatchEvent(new CustomEvent("explorer-show", { detail }))
        }""",
        [first, second, first],
    )
    page.wait_for_function(f"window.__tab == '{first}'")
    rest(page)
    look(page, first)
    page.evaluate(  # the one is being built when the other is asked for
        """async ([first, second]) => {
          window.dispatchEvent(new CustomEvent("explorer-show", { detail: second }))
          await new Promise((done) => requestAnimationFrame(done))
          window.dispatchEvent(new CustomEvent("explorer-show", { detail: first }))
          window.dispatchEvent(new CustomEvent("explorer-show", { detail: second }))
        }""",
        [first, second],
    )
    page.wait_for_function(f"window.__tab == '{second}'")
    rest(page)
    look(page, second)
