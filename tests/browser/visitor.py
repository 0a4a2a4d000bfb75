"""The page as a person uses it: visible text, roles, labels and painted figures, and nothing else.

Journeys go through this, so that they hold however the page is built.
"""

import re
from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.browser.explorer_page import wait
from tests.browser.helpers import Server, unfold

FAN_RIG = "?v=1&preset=fan-rig&tab="

#: of each visible figure, top to bottom: a hash of its pixels, and how many differ from the paper
_FIGURES = """canvases => {
  const figures = new Map()
  for (const canvas of canvases) {
    if (canvas.width < 3 || canvas.height < 3 || !canvas.getClientRects().length) continue
    // not the edge: what is painted again there grows darker by a shade
    const context = canvas.getContext("2d")
    const {data} = context.getImageData(1, 1, canvas.width - 2, canvas.height - 2)
    const pixels = new Uint32Array(data.buffer)
    let hash = 0, drawn = 0
    for (const pixel of pixels) {
      hash = (Math.imul(hash, 31) + pixel) | 0
      drawn += pixel !== pixels[0]
    }
    // layers of one figure have the same parent
    const figure = canvas.parentElement ?? canvas.getRootNode()
    const [hashes, most] = figures.get(figure) ?? ["", 0]
    figures.set(figure, [`${hashes} ${hash}`, Math.max(most, drawn)])
  }
  return [...figures.values()]
}"""


class Visitor:
    """Somebody at the page."""

    def __init__(self, page: Page, server: Server) -> None:
        self.page = page
        self.server = server
        self.main = page.get_by_role("main")
        self.views = page.get_by_role("navigation", name="Views")
        self.scene = page.get_by_role("complementary", name="Scene")

    # --- getting about ----------------------------------------------------------------------------

    def open(self, address: str = "") -> None:
        """Open an address of the page and wait until it shows something."""
        self.page.goto(self.server.url + address)
        expect(self.page.get_by_role("tab", selected=True)).to_be_visible()
        self.wait(lambda: any(self.sentences()))
        unfold(self.page)
        self.steady()

    def begin(self, tab: str) -> None:
        """Go on with an open page: its scene as it came, on this tab."""
        self.page.bring_to_front()
        self.page.keyboard.press("Escape")  # a menu may be open
        self.press("Reset", self.scene)
        expect(self.box("Length of the defect")).to_have_value("12.9")
        self.go_to(tab)

    def go_to(self, place: str) -> None:
        """Choose a tab, or "Tab: Part", and wait until its views are there."""
        tab, _, part = place.partition(": ")
        self.page.get_by_role("tab", name=tab, exact=True).click()
        if part:
            self.press(part, self.views.get_by_role("group", name=tab, exact=True))
        self.is_at(place)
        self.steady()

    def is_at(self, place: str) -> None:
        """Wait until a tab is open, or "Tab: Part"."""
        tab, _, part = place.partition(": ")
        expect(self.page.get_by_role("tab", name=tab, exact=True, selected=True)).to_be_visible()
        expect(self.main).not_to_have_attribute("aria-busy", "true")  # its cards are drawn
        if part:
            parts = self.views.get_by_role("group", name=tab, exact=True)
            expect(parts.get_by_role("button", pressed=True)).to_have_text(part)

    def press(self, name: str | re.Pattern[str], where: Locator | None = None) -> None:
        """Click the button of that name."""
        exact = isinstance(name, str)
        (where or self.page).get_by_role("button", name=name, exact=exact).first.click()

    def menu(self, name: str) -> Locator:
        """Open one of the menus above the scene."""
        self.press(name, self.scene)
        return self.page.get_by_role("dialog").first

    def export(self, what: str, card: int = 0) -> None:
        """Ask for something in the Export menu of a card: the first is 0."""
        opener = self.main.get_by_role("button", name=re.compile("^Export"))
        opener.nth(card).click()
        self.main.get_by_role("dialog").get_by_role("button", name=re.compile(what)).click()

    # --- the controls -----------------------------------------------------------------------------

    def box(self, label: str) -> Locator:
        """The field in which the number of a quantity is typed."""
        return self.page.get_by_role(
            "textbox", name=re.compile(rf"^{re.escape(label)}( in |, type|$)")
        ).first

    def number(self, label: str) -> float:
        """The number in that field."""
        return float(self.box(label).input_value().replace("−", "-"))

    def type(self, label: str, text: str) -> None:
        """Type a number and confirm it."""
        self.box(label).fill(text)
        self.box(label).press("Enter")

    def slider(self, label: str) -> Locator:
        """The slider of a quantity."""
        return self.page.get_by_role("slider", name=label, exact=True)

    def choose(self, label: str, option: str) -> None:
        """Choose from a list."""
        self.page.get_by_label(label, exact=True).locator("visible=true").select_option(
            label=option
        )

    def find_bearing(self, text: str) -> None:
        """Search for a bearing and take the first that is found."""
        field = self.page.get_by_role("combobox", name="Bearing", exact=True)
        field.fill(text)
        field.press("Enter")  # before there is a list
        expect(field).not_to_be_focused()

    def bring(self, where: Locator, name: str, content: bytes) -> None:
        """Choose a file from the disk."""
        where.locator("input[type=file]").first.set_input_files(
            {"name": name, "mimeType": "application/octet-stream", "buffer": content}
        )

    def download(self, ask: Callable[[], None]) -> tuple[str, bytes]:
        """What the browser saves: its name and content."""
        with self.page.expect_download() as saving:
            ask()
        return saving.value.suggested_filename, Path(saving.value.path()).read_bytes()

    # --- what is seen -----------------------------------------------------------------------------

    def reads(self, words: str | re.Pattern[str], where: Locator | None = None) -> None:
        """Wait until these words are to be seen, in the figures' part unless said otherwise."""
        if isinstance(words, re.Pattern):  # a unit does not break from its number
            words = re.compile(re.sub(r"\\? ", r"\\s", words.pattern))
        expect(
            (where or self.main).get_by_text(words).locator("visible=true").first
        ).to_be_visible()

    def read_more(self) -> None:
        """Open what stands behind "?" of the cards on screen, once there are any."""
        expect(self.main.get_by_role("heading", level=2).first).to_be_visible()
        for more in self.main.get_by_role("button", name=re.compile("^More about")).all():
            more.click()

    def headings(self) -> list[str]:
        """Titles of the cards that are on screen."""
        return self.main.get_by_role("heading", level=2).all_inner_texts()

    def sentences(self) -> list[str]:
        """What the views say about themselves."""
        return self.main.get_by_role("status").all_inner_texts()

    def figures(self) -> list[str]:
        """What each visible figure shows, without the lines of its key; none must be blank."""
        figures = self.main.locator("canvas:not(.bk-glyph)").evaluate_all(_FIGURES)
        return [pixels if drawn > 300 else "blank" for pixels, drawn in figures]

    def look_over(self) -> None:
        """Scroll past all figures and back: those out of sight are painted last."""
        # in one call: a part that a busy server closes late takes its figures away meanwhile
        self.main.locator("canvas:not(.bk-glyph)").locator("visible=true").evaluate_all(
            """async (figures) => {
              for (const one of figures) {
                one.scrollIntoView({block: "nearest"})
                await new Promise(requestAnimationFrame)
              }
            }"""
        )
        self.main.evaluate("part => part.scrollTo(0, 0)")

    def point(self, figure: int, across: float, down: float) -> None:
        """Move the pointer to a part of a figure, 0 to 1 from its left and from its top."""
        canvas = self.main.locator("canvas:not(.bk-glyph)").locator("visible=true").nth(figure)
        canvas.scroll_into_view_if_needed()
        box = canvas.bounding_box()
        assert box is not None
        x, y = box["x"] + across * box["width"], box["y"] + down * box["height"]
        self.page.mouse.move(x, y, steps=4)

    def wait(self, done: Callable[[], bool]) -> None:
        """Wait until it is so."""
        wait(self.page, done)

    def steady(self) -> None:
        """Wait until sentences and figures have stopped changing."""
        seen: list[object] = []

        def still() -> bool:
            seen.append((self.sentences(), self.figures()))
            return len(seen) > 2 and seen[-1] == seen[-2] == seen[-3]

        self.wait(still)

    def sees_change(self, act: Callable[[], object]) -> None:
        """Do something; a sentence and a figure are different then."""
        said, drawn = self.sentences(), self.figures()
        act()
        self.wait(lambda: self.sentences() != said and self.figures() != drawn)
        self.steady()
        assert self.sentences() != said, "what differed was on its way only: choose another act"
