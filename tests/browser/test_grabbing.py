"""The defect and the load are grabbed in the drawing of the bearing, by mouse and by finger."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.explorer_page import rest, settle, value
from tests.browser.visitor import Visitor

START, END, MIDDLE, LOAD = range(4)
PLACES = """kind => {
  const source = Bokeh.documents[0].get_model_by_name("bearing_handles")
  const drawn = (one) => one.renderers?.some?.((other) => other.data_source === source)
  const plot = [...Bokeh.documents[0]._all_models.values()].find(drawn)
  const view = Bokeh.index.find_one_by_id(plot.id)
  const corner = view.el.getBoundingClientRect(), frame = view.frame.bbox
  const unit = frame.width / (plot.x_range.end - plot.x_range.start)
  const at = [...source.data.kind].indexOf(kind)
  return [corner.left + frame.left + (source.data.x[at] - plot.x_range.start) * unit,
          corner.top + frame.top + (plot.y_range.end - source.data.y[at]) * unit]
}"""


PROOF = pytest.mark.proof
SCROLLED = "document.querySelector('main').scrollTop"


@pytest.fixture
def page(desk: Visitor) -> Page:
    """With the scene as it came."""
    desk.begin("Load")
    return desk.page


def place(page: Page, kind: int) -> tuple[float, float]:
    """Where a handle is on screen [px]."""
    x, y = page.evaluate(PLACES, kind)
    return x, y


def use_mouse(page: Page, kind: int, right: float, down: float) -> None:
    """Drag a handle this far [px]."""
    x, y = place(page, kind)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=8)
    page.mouse.up()
    settle(page)


def use_finger(page: Page, kind: int, right: float, down: float) -> None:
    touches = page.context.new_cdp_session(page)
    touches.send("Emulation.setTouchEmulationEnabled", {"enabled": True})
    x, y = place(page, kind)
    moves = [("touchMove", step / 8) for step in range(1, 9)]
    for what, share in [("touchStart", 0.0), *moves, ("touchEnd", 1.0)]:
        points = [] if what == "touchEnd" else [{"x": x + right * share, "y": y + down * share}]
        touches.send("Input.dispatchTouchEvent", {"type": what, "touchPoints": points})
    settle(page)
    touches.detach()


@pytest.mark.parametrize(
    ("drag", "width"),
    [(use_mouse, 1366), *(pytest.param(use_finger, w, marks=PROOF) for w in (1366, 390))],
)
def test_the_end_of_a_defect_and_the_arrow_follow_the_hand(page: Page, drag, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 844 if width < 400 else 650})
    rest(page)
    scrolled = page.evaluate(SCROLLED)
    extent, center = value(page, "extent_deg"), value(page, "center_deg")
    drag(page, END, 60.0, -20.0)  # counter-clockwise at the bottom
    longer = value(page, "extent_deg")
    assert longer > extent + 5.0
    # the other end stays where it is
    assert value(page, "center_deg") - center == pytest.approx(0.5 * (longer - extent), abs=0.3), (
        "the slider goes by 0.5°"
    )
    drag(page, START, 20.0, 0.0)
    assert value(page, "extent_deg") < longer - 1.0
    shorter = value(page, "extent_deg"), value(page, "center_deg")
    drag(page, MIDDLE, -40.0, 0.0)
    assert value(page, "extent_deg") == shorter[0]
    assert value(page, "center_deg") < shorter[1] - 5.0
    drag(page, END, 0.0, -60.0)  # the way in which a finger scrolls
    assert value(page, "extent_deg") > shorter[0] + 5.0
    assert (value(page, "fx_n"), value(page, "fy_n")) == (0.0, 100.0)
    drag(page, LOAD, 40.0, 0.0)
    assert value(page, "fx_n") > 30.0
    assert value(page, "fy_n") == pytest.approx(100.0, rel=0.05), "the tip went to the side"
    assert page.evaluate(SCROLLED) == scrolled
    page.get_by_role("button", name="Undo", exact=True).click()
    settle(page)
    assert (value(page, "fx_n"), value(page, "fy_n")) == (0.0, 100.0), "a drag is one step"


@pytest.mark.proof
def test_handles_are_sliders_for_keys_and_screen_readers(page: Page) -> None:
    def handle(name: str) -> Locator:
        return page.get_by_role("main").get_by_role("slider", name=name, exact=True)

    end = handle("End of the defect")
    drawing = page.locator(".view-bearing canvas").first
    before = drawing.bounding_box()
    expect(end).to_have_attribute("aria-valuetext", "at 276°; defect 12.9° long")
    handle("Beginning of the defect").focus()
    page.keyboard.press("Tab")
    expect(end).to_be_focused()
    assert end.evaluate("one => getComputedStyle(one).outlineStyle") == "solid"
    page.keyboard.press("PageUp")
    expect(end).to_have_attribute("aria-valuetext", "at 281°; defect 17.9° long")
    assert value(page, "extent_deg") == pytest.approx(17.9, abs=0.01)
    page.keyboard.press("Tab")
    expect(handle("Place of the defect")).to_be_focused()
    page.keyboard.press("ArrowLeft")
    expect(handle("Place of the defect")).to_have_attribute("aria-valuetext", "at 272°")
    assert value(page, "extent_deg") == pytest.approx(17.9, abs=0.01)
    page.keyboard.press("Tab")
    expect(handle("Load")).to_be_focused()
    page.keyboard.press("ArrowUp")
    expect(handle("Load")).to_have_attribute("aria-valuetext", "105 N at 270°")
    assert value(page, "fy_n") == 105.0
    page.keyboard.press("PageDown")
    page.keyboard.press("ArrowRight")
    expect(handle("Load")).to_have_attribute("aria-valuetext", re.compile(r"^52\.5 N at 271°"))
    page.keyboard.press("End")
    expect(handle("Load")).to_have_attribute("aria-valuetext", re.compile(r"^500 N at 271°"))
    page.keyboard.press("Home")
    expect(handle("Load")).to_have_attribute("aria-valuetext", "0 N")
    page.keyboard.press("ArrowUp")  # it grows to where it pointed
    expect(handle("Load")).to_have_attribute("aria-valuetext", re.compile(r" N at 271°$"))
    end.press("End")
    settle(page)
    assert value(page, "extent_deg") == 120.0
    assert drawing.bounding_box() == before, "warnings and longer sentences leave it its size"
    end.press("Home")
    settle(page)
    assert 0.0 < value(page, "extent_deg") < 1.0, "its ends can still be held"


def test_the_tip_of_the_arrow_stays_under_the_hand_and_comes_back_when_it_is_let_go(
    page: Page,
) -> None:
    x, y = place(page, LOAD)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30.0, y + 60.0, steps=6)
    rest(page)
    assert place(page, LOAD) == pytest.approx((x + 30.0, y + 60.0), abs=2.0)
    page.mouse.up()
    rest(page)
    assert place(page, LOAD)[1] < y + 30.0, "within the bore"
    assert value(page, "fy_n") > 180.0


def test_who_misses_a_handle_zooms_nothing_and_reset_ends_a_zoom(page: Page) -> None:
    x, y = place(page, END)
    page.mouse.move(x + 18.0, y - 30.0)
    page.mouse.down()
    page.mouse.move(x + 60.0, y + 40.0, steps=4)
    page.mouse.up()
    settle(page)
    assert place(page, END) == pytest.approx((x, y))
    whole = page.get_by_role("button", name="Whole figure", exact=True)
    expect(whole).to_have_count(0)
    for way in (whole, page.get_by_role("button", name="Reset", exact=True)):
        page.keyboard.down("Control")
        page.mouse.wheel(0, -300)
        page.keyboard.up("Control")
        expect(whole).to_be_visible()
        assert place(page, END) != pytest.approx((x, y), abs=5.0)
        way.click()
        expect(whole).to_be_hidden()
        assert place(page, END) == pytest.approx((x, y))
        page.mouse.move(x + 18.0, y - 30.0)
