"""The real page: dragged, typed into, switched, played. What is drawn is what was asked for."""

from __future__ import annotations

import math
import re
import signal

import numpy as np
import pytest
from playwright.sync_api import Page, ViewportSize, expect

from bearingcore import equilibrium, presets
from tests.browser.explorer_page import (
    VIEWS,
    number,
    open_page,
    painted,
    pixels,
    rest,
    settle,
    show,
    slider,
    source,
    status,
    value,
    wait,
)
from tests.browser.helpers import Server, Watch, drag, explorer_server, move


@pytest.mark.parametrize(
    ("waited", "sent_at_once"), [pytest.param(0, {2}, marks=pytest.mark.proof), (300, {0, 1})]
)
def test_a_queue_on_the_server_is_not_made_longer(
    watch: tuple[Page, Watch], explorer: Server, waited: int, sent_at_once: set[int]
) -> None:
    """Two changes may be on their way; where the last waited for others the next waits here."""
    page, _ = watch
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
    page.evaluate("waited => { window.__wait = waited }", waited)
    assert move(thumb, 22) == 1
    settle(page)
    asked = page.evaluate("window.__asked")
    sent = move(thumb, 25, 30, 35, 40, 45)
    page.wait_for_function(f"window.__asked > {asked + sent}")  # the newest, a little later
    settle(page)
    assert number(page, "extent_deg").input_value() == "45"
    assert sent in sent_at_once


def test_a_repaint_writes_no_style_sheet_that_stays_the_same(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    """Each would have the browser work out the styles of the page anew."""
    page, _ = watch
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


def test_every_view_follows_the_slider(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer)
    ends = iter([0.5, 0.2, 0.6, 0.3] * 2)
    for tab in dict.fromkeys(VIEWS.values()):
        show(page, tab)
        views = [view for view, where in VIEWS.items() if where == tab]
        before = {view: pixels(page, view) for view in views}
        words = {
            view: page.locator(f".view-{view} [role=status]").first.inner_text() for view in views
        }
        drag(page, slider(page, "extent_deg"), 0.1, next(ends))
        settle(page)
        for view in views:
            assert pixels(page, view) != before[view], f"{view} did not follow the slider"
            status = page.locator(f".view-{view} [role=status]").first
            assert status.inner_text() != words[view], f"the sentence of {view} did not follow"


@pytest.mark.proof
@pytest.mark.parametrize("end", [0.83, 0.31])
def test_the_last_position_of_the_slider_is_drawn(
    watch: tuple[Page, Watch], explorer: Server, end: float
) -> None:
    page, _ = watch
    open_page(page, explorer, "stiffness")
    for goal in (0.2, 0.9, 0.4, end):
        drag(page, slider(page, "extent_deg"), 0.1, goal, steps=25)
    settle(page)
    extent = value(page, "extent_deg")
    assert number(page, "extent_deg").input_value() == f"{extent:g}"
    scene = presets["fan-rig"].replace(extent=math.radians(extent))
    expected = equilibrium(scene, [0.0])
    drawn = source(page, "stiffness_cells")
    diagonal = {"k_xx": 0, "k_yy": 5, "k_zz": 9}
    for term, cell in diagonal.items():
        np.testing.assert_allclose(drawn["now"][cell], expected.term(term)[0], rtol=1e-6)
    assert drawn["now"][15] == expected.loaded_balls[0]


@pytest.mark.proof
def test_what_is_not_on_screen_is_not_sent_and_what_appears_is_up_to_date(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "stiffness")
    show(page, "load")
    before = source(page, "stiffness_defective")
    drag(page, slider(page, "extent_deg"), 0.1, 0.7)
    settle(page)
    assert source(page, "stiffness_defective") == before
    show(page, "stiffness")
    assert source(page, "stiffness_defective") != before


@pytest.mark.proof
def test_play_turns_the_balls(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer)
    button = page.get_by_role("button", name="Turn the bearing")
    rest(page)
    start, picture = value(page, "cage_angle_deg"), pixels(page, "bearing")
    button.click()
    seen: list[tuple[tuple[int, int], ...]] = []

    def turned() -> bool:
        seen.append(pixels(page, "bearing"))
        return len(set(seen) - {picture}) >= 2 and value(page, "cage_angle_deg") > start + 5

    wait(page, turned)
    page.get_by_role("button", name="Stop turning").click()
    rest(page)
    stopped = value(page, "cage_angle_deg")
    assert stopped > start + 5
    still = pixels(page, "bearing")
    assert still not in (picture, seen[0])
    page.wait_for_timeout(400)  # long enough to see it, should it turn on
    assert value(page, "cage_angle_deg") == stopped
    assert pixels(page, "bearing") == still


def test_bad_input_is_refused_with_a_sentence_and_the_picture_stays(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "stiffness")
    field, refusal = number(page, "extent_deg"), page.locator(".control-extent_deg .refusal")
    for typed, sentence in (
        ("400", "400° is out of range: extent goes from 0 to 360°."),
        ("-3", "−3° is out of range: extent goes from 0 to 360°."),
        ("a lot", "“a lot” is not a number: extent goes from 0 to 360°."),
        ("NaN", "“NaN” is not a number: extent goes from 0 to 360°."),
    ):
        rest(page)
        before = source(page, "stiffness_defective")
        field.fill(typed)
        field.press("Enter")
        expect(refusal).to_have_text(sentence)
        expect(field).to_have_attribute("aria-invalid", "true")
        assert value(page, "extent_deg") == pytest.approx(12.9)
        rest(page)
        assert source(page, "stiffness_defective") == before, typed
        field.fill("33,25")
        field.press("Enter")
        expect(refusal).to_be_hidden()
        expect(field).to_have_value("33.25")
        settle(page)
        assert source(page, "stiffness_defective") != before, typed
        page.get_by_role("button", name="Reset", exact=True).click()
        expect(field).to_have_value("12.9")


@pytest.mark.proof
def test_a_load_nothing_can_carry_is_said_in_words(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "stiffness")
    line = status(page)
    expect(line).to_contain_text("Converged")
    # while it moves, and when it rests
    expect(line).to_have_text(re.compile(r"2 (degrees of freedom: x y|DOF \(x y\))"))
    expect(line).to_have_text(re.compile(r"residual at most .*10⁻"))
    expect(line).to_have_text(re.compile(r"\d ms"))
    number(page, "fy_n").fill("0")
    number(page, "fy_n").press("Enter")
    expect(line).to_contain_text("No answer")
    number(page, "fz_n").fill("50")
    number(page, "fz_n").press("Enter")
    expect(line).to_have_text(
        re.compile(r"5 (degrees of freedom: x y z θx θy|DOF \(x y z θx θy\))")
    )


@pytest.mark.proof
def test_a_preset_brings_its_values_and_ranges(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer)
    page.get_by_label("Bearing", exact=True).select_option("liew-lim")
    expect(number(page, "fy_n")).to_have_value("−2000")
    assert slider(page, "fy_n").get_attribute("max") == "5000"
    settle(page)
    drag(page, slider(page, "extent_deg"), 0.3, 0.6)
    page.get_by_role("button", name="Reset").click()
    expect(number(page, "extent_deg")).to_have_value("40")


@pytest.mark.proof
def test_the_keyboard_moves_sliders_numbers_and_tabs(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    slider(page, "depth_um").focus()
    page.keyboard.press("ArrowRight")
    expect(number(page, "depth_um")).to_have_value("51")
    number(page, "depth_um").focus()
    page.keyboard.press("ArrowUp")
    expect(number(page, "depth_um")).to_have_value("52")
    show(page, "maps")
    page.get_by_role("tab", name="Maps").focus()
    page.keyboard.press("ArrowLeft")
    expect(page.get_by_role("tab", name="Stiffness")).to_have_attribute("aria-selected", "true")
    expect(page.locator(".view-stiffness")).to_be_visible()
    expect(page.locator(".view-bearing")).to_be_hidden()


@pytest.mark.proof
def test_the_page_fits_the_screen(watch: tuple[Page, Watch], explorer: Server) -> None:
    """Opened on each screen, and each tab on each of them."""
    page, _ = watch
    screens: list[ViewportSize] = [
        {"width": 1366, "height": 768},
        {"width": 390, "height": 844},
        {"width": 1920, "height": 1080},
    ]

    def fits(what: str) -> None:
        wide = page.evaluate(
            """() => [document.documentElement, document.querySelector("main"),
                      document.querySelector("aside")].map(e => e.scrollWidth - e.clientWidth)"""
        )
        assert wide == [0, 0, 0], f"{what} needs horizontal scrolling: {wide}"

    for screen in screens:
        page.set_viewport_size(screen)
        open_page(page, explorer)
        fits(f"load, opened at {screen}")
    for number_, tab in enumerate(dict.fromkeys(VIEWS.values())):
        page.set_viewport_size(screens[number_ % 3])  # each tab is first seen on another one
        show(page, tab)
        for screen in screens[number_ % 3 :] + screens[: number_ % 3]:
            page.set_viewport_size(screen)
            painted(page)
            fits(f"{tab} at {screen}")


@pytest.mark.proof
def test_the_server_says_what_it_does_and_ends_cleanly() -> None:
    for number_ in (signal.SIGTERM, signal.SIGINT):
        server = explorer_server()
        server.wait()
        assert server.stop(number_) == 0, server.log
        for words in ("Compiling", "Ready after", str(server.port), "Stopped."):
            assert words in server.log
        assert "Traceback" not in server.log
