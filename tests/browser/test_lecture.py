"""Needs of a lecture: slow motion, enlarged figures, projector, exports."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from bearing_explorer.explorer.state.lessons import shipped_folder
from playwright.sync_api import BrowserContext, Page, expect

from tests.browser.explorer_page import (
    SEEN,
    export,
    largest_share,
    place,
    rest,
    show,
    slider,
    source,
)
from tests.browser.helpers import Server
from tests.browser.test_first_minute import COUNTS
from tests.browser.visitor import Visitor


def test_a_ball_crosses_the_defect_slowly(page: Page, explorer: Server) -> None:
    page.goto(f"{explorer.url}?v=1&tab=vibration")
    page.wait_for_function("window.__tab == 'vibration'")
    rest(page)
    view = page.locator(".view-slow-passage")
    instant = view.get_by_role("slider", name="Instant")
    frames, start = source(page, "slow_frames"), source(page, "slow_start")
    n = len(start["angle"])
    loads = np.reshape(source(page, "slow_path")["load"], (-1, n))

    def shown() -> int:
        """The frame that the figures show."""
        at = int(instant.input_value())
        assert source(page, "slow_cursor")["now"][0] == pytest.approx(frames["time"][at], abs=1e-8)
        balls = source(page, "slow_balls")
        np.testing.assert_allclose(balls["load"], loads[at], rtol=1e-6, atol=1e-6)
        angles = np.arctan2(balls["y"], balls["x"]) - start["angle"] - frames["turned"][at]
        np.testing.assert_allclose(np.exp(1j * angles), 1.0, atol=1e-6)
        return at

    first = shown()
    assert abs(frames["time"][first]) < 2e-4  # a ball enters
    instant.press("ArrowRight")
    instant.press("ArrowRight")
    instant.press("ArrowLeft")
    assert shown() == first + 1
    play = view.get_by_role("button", name="Play")
    play.click()
    page.wait_for_function("before => Bokeh.documents[0].get_model_by_name('slow_cursor')"
                           ".data.now[0] > before", arg=frames["time"][first + 1])  # fmt: skip
    view.get_by_role("button", name="Pause").click()
    instant.press("ArrowLeft")  # to a whole frame
    shown()
    # another defect: its motion is there as soon as it is drawn
    slider(page, "extent_deg").press("PageUp")
    rest(page)
    after = source(page, "slow_path")
    assert np.abs(np.reshape(after["load"], (-1, n)) - loads).max() > 1.0
    loads = np.reshape(after["load"], (-1, n))
    frames, start = source(page, "slow_frames"), source(page, "slow_start")
    shown()


RANGES = """() => {
  const plot = Bokeh.documents[0].get_model_by_name('stiffness_drawing')
  return [plot.x_range.start, plot.x_range.end, plot.y_range.start, plot.y_range.end,
          plot.below[0].visible && plot.below[0].axis_label]
}"""


@pytest.mark.proof
def test_a_cell_fills_the_screen_and_arrows_lead_to_the_next(desk: Visitor) -> None:
    page = desk.page
    page.set_viewport_size({"width": 1920, "height": 1080})
    desk.begin("Stiffness")
    show(page, "load")
    page.keyboard.press("Escape")  # keys are for the open tab, and for this one when it comes back
    show(page, "stiffness")
    view = page.locator(".view-stiffness")
    whole = page.evaluate(RANGES)
    steps = view.get_by_role("group", name="Cells")
    view.get_by_role("button", name="Enlarge").press("Enter")
    for _ in range(6):
        page.keyboard.press("ArrowRight")
    expect(steps).to_contain_text("kyy, 6 of 15")
    page.keyboard.press("Escape")
    expect(steps).to_be_hidden()
    rest(page)
    page.mouse.click(*place(page, "stiffness_drawing", 1.6, -1.5))
    expect(steps).to_contain_text("kyy, 6 of 15")
    left, right, bottom, top, label = page.evaluate(RANGES)
    assert 1.0 < left < right < 2.0
    assert -2.0 < bottom < top < -1.0
    assert label == "k_yy over cage angle φc (°)"
    expect(view.locator(".sentence").first).to_be_hidden(timeout=8000)
    view.get_by_role("button", name="Next cell").click()
    expect(steps).to_contain_text("kyz, 7 of 15")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    expect(steps).to_contain_text("kxθy, 5 of 15")
    page.keyboard.press("Escape")
    expect(steps).to_be_hidden()
    assert page.evaluate(RANGES) == whole


def test_pictures_say_what_they_show(
    desk: Visitor, explorer: Server, browser: BrowserContext
) -> None:
    page = desk.page
    desk.begin("Load")
    desk.type("Length of the defect", "20")
    rest(page)
    view = page.locator(".view-load-distribution")
    export(view, "svg").wait_for()
    with page.expect_download() as download:
        view.locator(".save-svg").click()
    svg = ElementTree.fromstring(download.value.path().read_text(encoding="utf-8"))
    texts = ["".join(node.itertext()).strip() for node in svg.iter() if node.tag.endswith("text")]
    said = " ".join(texts)
    assert texts[0] == "Load distribution"
    assert "Grey: the bearing without its defect" in said
    assert "Fan rig, deep groove bearing: defect 20°, 50 µm; load 100 N at 270°; shaft 7 Hz" in said
    assert f"{explorer.url}?v=1&preset=fan-rig&extent_deg=20" in said.replace(" ", "")
    # the words are above and below the figure, not on it
    height = float(svg.attrib["height"])
    figure = next(element for element in svg if element.tag.endswith("svg"))
    assert float(figure.attrib["y"]) > 40
    assert float(figure.attrib["y"]) + float(figure.attrib["height"]) < height - 30
    browser.grant_permissions(["clipboard-read", "clipboard-write"])
    export(view, "copy").click()
    expect(page.get_by_text("The picture is copied.")).to_be_visible()
    size = page.evaluate(
        """async () => {
          const [item] = await navigator.clipboard.read()
          const image = await createImageBitmap(await item.getType("image/png"))
          return [image.width, image.height]
        }"""
    )
    assert size == [2 * float(svg.attrib["width"]), 2 * height]
    browser.clear_permissions()
    # a table begins where values do
    export(view, "table").click()
    rows = view.locator("dialog[open] tbody tr")
    assert float(rows.nth(0).locator("td").nth(1).inner_text()) == 0.0
    assert float(rows.nth(1).locator("td").nth(1).inner_text()) > 0.0
    expect(view.get_by_text("before them all values are zero")).to_be_visible()
    page.keyboard.press("Escape")
    _, table = desk.download(lambda: export(view, "csv").click())
    columns = {line.count(",") for line in table.decode().strip().splitlines()}
    assert len(columns) == 1
    _, picture = desk.download(lambda: export(view, "png").click())
    assert picture.startswith(b"\x89PNG")
    export(view, "python").click()
    lines = view.locator("dialog[open] pre").inner_text()
    compile(lines, "exported", "exec")  # that they run, `test_exported_python.py` shows
    assert "from bearing_explorer import figures" in lines
    page.keyboard.press("Escape")


#: sizes of type [px] in figures that are seen, and the share of the page's width that they have
PROJECTED = """() => {
  const sizes = {}, size = (px, of) => { sizes[px] = of }
  let widest = 0
  for (const { model, el } of Bokeh.index.query((view) => view.model.type === "Figure")) {
    if (!seen(el)) continue
    widest = Math.max(widest, el.getBoundingClientRect().width)
    for (const part of model.references()) for (const property of part) {
      if (!/text_font_size$/.test(property.attr) || property.is_unset) continue
      const value = property.get_value()
      size(parseFloat(value.value ?? value), `${part.type} ${property.attr}`)
    }
  }
  for (const element of deep(document.body)) {
    const { content, fontSize } = getComputedStyle(element, "::after")
    if (seen(element) && /\\p{L}/u.test(content) && content !== "none" && content !== "normal")
      size(parseFloat(fontSize) * element.currentCSSZoom, content)
  }
  return [sizes, widest / innerWidth]
}"""


def type_is_large(page: Page) -> float:
    """Assert that all type is large; return the share of the width that figures have."""
    drawn, share = page.evaluate(PROJECTED)
    written = page.evaluate(COUNTS)["sizes"]
    assert drawn
    assert written
    small = {px: of for px, of in [*drawn.items(), *written.items()] if float(px) < 18.0}
    assert not small
    return float(share)


def test_a_projector_has_large_type_and_large_figures(page: Page, explorer: Server) -> None:
    page.set_viewport_size({"width": 1920, "height": 1080})
    page.add_init_script(SEEN)
    page.goto(f"{explorer.url}?v=1&tab=vibration#projector")
    page.wait_for_function("window.__frames >= 1")
    rest(page)
    page.wait_for_function("document.querySelector('footer').currentCSSZoom > 1.6")
    assert type_is_large(page) > 0.65


#: of these elements those whose text takes more than a line
BROKEN = """(all) => all.filter((element) => {
  const range = document.createRange()
  range.selectNodeContents(element)
  return new Set([...range.getClientRects()].map(({ bottom }) => Math.round(bottom))).size > 1
}).length"""
HEIGHT = "element => element.getBoundingClientRect().height"
LESSONS = len(list(shipped_folder().glob("*.md")))


@pytest.mark.proof
@pytest.mark.parametrize("projected", [False, True])
def test_what_a_lesson_asks_and_how_it_was_answered_are_on_the_screen(
    page: Page, explorer: Server, projected: bool
) -> None:
    """Without scrolling, beside something to look at; on a projector the figure is whole.

    On a laptop, and on a phone less the bars of its browser or on a larger screen.
    """
    screens = [(1366, 650), (1920, 940) if projected else (390, 664)]
    page.add_init_script(SEEN)
    page.goto(f"{explorer.url}?lesson=what-a-ball-carries{'#projector' if projected else ''}")
    page.wait_for_function("window.__frames >= 1")

    def whole(selector: str) -> None:
        """All of these are seen, and there are some."""
        expect(page.locator(selector)).not_to_have_count(0)
        for element in page.locator(selector).all():
            expect(element).to_be_in_viewport(ratio=0.99)

    def look(*selectors: str) -> None:
        """On each screen these are seen, the choices, and on a projector the figures."""
        for width, height in screens:
            page.set_viewport_size({"width": width, "height": height})
            rest(page)
            for selector in (".prediction label", *selectors):
                whole(selector)
            if not projected:
                continue
            assert page.locator(".prediction label span").evaluate_all(BROKEN) == 0
            words = page.locator(".lesson .words").first
            assert words.evaluate(HEIGHT) <= 150.0, "a paragraph and its question"
            for view in page.locator(".watched").filter(has=page.locator("canvas:visible")).all():
                expect(view).to_be_in_viewport(ratio=0.99)
                assert view.evaluate(HEIGHT) >= height * 0.55

    for number in range(1, LESSONS + 1):
        look(".prediction .asked", *[".part.current > .body"] * projected)
        expect(page.locator(".controls-place")).to_be_hidden()  # its question has the side panel
        assert largest_share(page) > 0.4, "there is something to look at"
        box = page.locator(".prediction input").first
        if box.get_attribute("type") == "text":
            box.fill("7")
            box.press("Enter")
        else:
            box.click()
        look(".prediction .verdict")
        if projected and number <= 2:
            page.get_by_role("button", name="Answer", exact=True).click()
            rest(page)
            expect(page.locator(".handle").first).to_have_js_property("currentCSSZoom", 1)
            assert type_is_large(page) > 0.3  # two figures beside the answer
        if number < LESSONS:
            page.get_by_role("button", name="Next lesson").click()
            expect(page.locator(".lesson select")).to_have_value(str(number))


def test_a_lesson_is_printed_with_and_without_its_answer(page: Page, explorer: Server) -> None:
    page.goto(f"{explorer.url}?lesson=fifteen-terms")
    page.wait_for_function("window.__frames >= 1")
    rest(page)
    answer, look = page.locator(".lesson .answer"), page.get_by_text("First the diagonal")
    for revealed in (False, True):
        if revealed:
            page.get_by_role("button", name="Skip to the answer").click()
        assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4"))) >= 1
        page.emulate_media(media="print")
        expect(look).to_be_visible()
        expect(answer).to_be_visible(visible=revealed)
        expect(page.locator("#control-extent_deg")).to_be_hidden()
        # all of its words are in the flow of pages, none behind an edge
        place = page.locator(".lesson-place")
        assert place.evaluate("({ scrollHeight, clientHeight }) => scrollHeight - clientHeight") < 2
        page.emulate_media(media="screen")
