"""The explorer's page as the browser tests read it: its controls, figures and sentences."""

import time
from collections.abc import Callable

from playwright.sync_api import Locator, Page

from tests.browser.helpers import Server, choose_tab

#: all that a hand asked for is sent and drawn
DRAWN = "!window.__waiting?.size && (window.__mark || 0) >= (window.__asked || 0)"

SEEN = """
window.deep = function* (where, selector = "*") {
  for (const element of where.querySelectorAll("*")) {
    if (element.matches(selector)) yield element
    if (element.shadowRoot) yield* deep(element.shadowRoot, selector)
  }
}
window.seen = (element) => {
  const box = element.getBoundingClientRect()
  return box.width > 2 && box.height > 2 && box.right > 0 && box.bottom > 0
    && box.left < innerWidth && box.top < innerHeight
    && element.checkVisibility({ visibilityProperty: true, opacityProperty: true })
    && getComputedStyle(element).clipPath === "none"
}
window.focused = () => {
  let at = document.activeElement
  while (at?.shadowRoot?.activeElement) at = at.shadowRoot.activeElement
  return at
}
"""
"""Elements inside shadows too, whether one is seen, and the one that has the focus."""


def open_page(page: Page, server: Server, tab: str = "load") -> None:
    page.goto(server.url)
    page.wait_for_function("window.__frames >= 1")
    show(page, tab)


def can_be_used(page: Page) -> None:
    """Wait until a slider that is taken moves something: before that its kernels are compiled."""
    page.wait_for_function("window.__frames >= 1")
    page.wait_for_selector("aside:not(:has([inert])) #control-extent_deg")
    settle(page)


def show(page: Page, tab: str) -> None:
    choose_tab(page, tab)
    page.wait_for_function(f"window.__tab == '{tab}'")  # it is drawn
    settle(page)


def settle(page: Page) -> None:
    """Wait until the newest change is drawn and the paints that follow are done."""
    page.wait_for_function(DRAWN)
    painted(page)


def rest(page: Page) -> None:
    """Wait until what is on screen is drawn as finely as can be: nothing more comes by itself."""
    page.wait_for_function(f"{DRAWN} && window.__resting")
    painted(page)


def painted(page: Page) -> None:
    """Wait until what has arrived is painted.

    A paint waits for at most 16 ms and then for the next frame of the screen, and may lead to
    another one. A timer that is set later and lasts longer comes after it, however slow all is.
    """
    page.evaluate(
        """async () => {
          for (let round = 0; round < 3; round++) {
            await new Promise(done => setTimeout(done, 25))
            await new Promise(done => requestAnimationFrame(done))
          }
        }"""
    )


def slider(page: Page, name: str):
    return page.locator(f"#control-{name}")


def value(page: Page, name: str) -> float:
    return float(slider(page, name).input_value())


def number(page: Page, name: str):
    return page.locator(f".control-{name} .number")


def source(page: Page, name: str) -> dict[str, list[float]]:
    """The numbers in the browser behind a figure."""
    return page.evaluate(
        """name => Object.fromEntries(Object.entries(
             Bokeh.documents[0].get_model_by_name(name).data
           ).map(([column, values]) => [column, Array.from(values)]))""",
        name,
    )


def place(page: Page, drawing: str, x: float, y: float) -> tuple[float, float]:
    """Where on the screen a place in a figure lies."""
    position = page.evaluate(
        """([name, x, y]) => {
          const [view] = [...Bokeh.index.query(view => view.model.name == name)]
          view.el.scrollIntoView({block: "center"})
          const box = view.canvas_view.el.getBoundingClientRect()
          return [box.left + view.frame.x_scale.compute(x), box.top + view.frame.y_scale.compute(y)]
        }""",
        [drawing, x, y],
    )
    return float(position[0]), float(position[1])


def largest_share(page: Page) -> float:
    """Return the share that is seen of the figure of which most is."""
    share: float = page.locator(".bk-Figure").evaluate_all(
        """figures => new Promise((done) => {
             const seen = new IntersectionObserver((all) =>
               done(Math.max(...all.map(({ intersectionRatio }) => intersectionRatio))))
             figures.forEach((figure) => seen.observe(figure))
           })"""
    )
    return share


def status(page: Page) -> Locator:
    """The status line with its details, which are in a list that need not be open."""
    return page.locator("footer .status .line")


def export(view: Locator, what: str) -> Locator:
    """An item of the Export menu, ready to be clicked: png, svg, csv, table or python."""
    item = view.locator(f".save-{what}")
    if not item.is_visible():
        view.locator("header .opener").click()
    return item


def wait(page: Page, done: Callable[[], bool], seconds: float = 120.0) -> None:
    """Wait until it is so."""
    end = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < end, "it did not happen"
        page.wait_for_timeout(60)
