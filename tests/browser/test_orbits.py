"""Long computations in the browser: started, followed, cancelled, drawn, read and clicked."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import (
    export,
    number,
    open_page,
    pixels,
    place,
    settle,
    show,
    slider,
    source,
    value,
    wait,
    words,
)
from tests.browser.helpers import Server, Watch, drag, holding


def fill(page: Page, **fields: str) -> None:
    for name, text in fields.items():
        page.locator(f".field-{name}:visible input").fill(text)


def grid(page: Page, name: str) -> list[float]:
    """Columns, rows, left, width, bottom, height of a picture; empty before there is one."""
    return source(page, name)["packed"][:6]


def small_map(page: Page) -> None:
    """A quick map over speeds and extents around the scene of the fan rig."""
    fill(page, x_from="20", x_to="40", y_from="5", y_to="15")
    page.locator(".field-grid:visible select").select_option("13 × 13")
    page.get_by_role("button", name="Compute the map").click()
    expect(words(page, "stability-map")).to_have_text(re.compile(r"13 × 13 points after"))
    settle(page)


def test_the_orbit_follows_the_sliders(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "orbits")
    status = page.locator(".view-orbit [role=status]").first
    expect(status).to_contain_text("Stable orbit")
    expect(page.locator(".view-orbit [role=status]").first).to_have_attribute("data-mood", "good")
    before = pixels(page, "orbit")
    assert len(source(page, "orbit_inside")["x"]) == 8
    number(page, "shaft_speed_hz").fill("30")
    number(page, "shaft_speed_hz").press("Enter")
    expect(status).to_contain_text("Unstable: the period doubles")
    expect(page.locator(".view-orbit [role=status]").first).to_have_attribute("data-mood", "bad")
    settle(page)
    assert pixels(page, "orbit") != before
    assert min(source(page, "orbit_outside")["x"]) < -1.0


@pytest.mark.proof
def test_a_map_is_drawn_read_and_clicked(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "orbits")
    before = pixels(page, "stability-map")
    small_map(page)
    wait(page, lambda: pixels(page, "stability-map") != before)  # it may stand below the screen
    columns, rows, left, width, bottom, height = grid(page, "stability_cells")
    assert (columns, rows) == (13, 13)
    expect(page.locator(".view-stability-map")).to_contain_text("points have a stable orbit")

    step = width / columns, height / rows
    x, y = left + 6.2 * step[0], bottom + 3.2 * step[1]
    at = place(page, "stability_drawing", x, y)
    page.mouse.move(*at)
    tip = page.locator(".bk-Tooltip:visible").first
    expect(tip).to_contain_text("Shaft speed: 30 Hz")
    expect(tip).to_contain_text("Extent: 7.5°")
    expect(tip).to_contain_text("|μ| =")

    page.mouse.click(*at)
    wait(page, lambda: number(page, "shaft_speed_hz").input_value() == "30")
    assert value(page, "shaft_speed_hz") == pytest.approx(30.0)
    assert value(page, "extent_deg") == pytest.approx(7.5)
    settle(page)
    mark = source(page, "stability_mark")
    assert mark["x"] == [30.0]
    assert mark["y"] == [7.5]

    with page.expect_download() as saving:
        export(page.locator(".view-stability-map"), "csv").click()
    table = saving.value.path().read_text().splitlines()
    assert table[0] == "shaft_speed_hz,extent_deg,largest_multiplier,outcome,through"
    assert len(table) == 1 + 13 * 13


@pytest.mark.proof
def test_a_changed_scene_makes_the_map_faint(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "orbits")
    small_map(page)
    assert source(page, "stability_cells")["packed"][6] == 1.0
    drag(page, slider(page, "depth_um"), 0.1, 0.4)
    settle(page)
    assert source(page, "stability_cells")["packed"][6] < 0.5
    expect(page.locator(".view-stability-map")).to_contain_text("the scene has changed")


@pytest.mark.proof
def test_progress_moves_and_cancel_works(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "orbits")
    page.locator(".field-grid:visible select").select_option("97 × 97")
    cancel = page.get_by_role("button", name="Cancel")
    expect(cancel).to_be_disabled()
    page.get_by_role("button", name="Compute the map").click()
    expect(cancel).to_be_enabled()
    bar = page.get_by_role("progressbar")
    seen: set[float] = set()

    def moved() -> bool:
        seen.add(float(bar.get_attribute("value") or 0))
        return len(seen) >= 3

    wait(page, moved)
    wait(page, lambda: grid(page, "stability_cells")[:2] == [13, 13])  # the coarse picture
    cancel.click()
    expect(words(page, "stability-map")).to_have_text(re.compile(r"Cancelled\. \d+ × \d+ points"))
    expect(cancel).to_be_disabled()
    expect(bar).to_be_hidden()
    assert grid(page, "stability_cells")[0] >= 13


@pytest.mark.proof
def test_sliders_stay_lively_and_tabs_change_while_it_computes(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "orbits")
    page.locator(".field-grid:visible select").select_option("97 × 97")
    page.get_by_role("button", name="Compute the map").click()
    expect(page.get_by_role("button", name="Cancel")).to_be_enabled()
    show(page, "load")
    frames = page.evaluate("window.__frames")
    hand = holding(page, slider(page, "extent_deg"), 0.1, 0.5, steps=25)

    def drawn() -> bool:
        next(hand)
        return page.evaluate("window.__frames") - frames >= 5

    wait(page, drawn)
    page.mouse.up()
    settle(page)
    show(page, "orbits")
    wait(page, lambda: len(grid(page, "stability_cells")) == 6)
    # another tab's job takes the place of this one
    show(page, "speed-run")
    page.locator(".field-count:visible select").select_option("25")
    page.get_by_role("button", name="Run up").click()
    expect(words(page, "speed-run")).to_have_text(re.compile("25 speeds after"))
    show(page, "orbits")
    expect(words(page, "stability-map")).to_contain_text("Cancelled: replaced by")


@pytest.mark.proof
def test_what_is_refused_gets_a_sentence(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "orbits")
    fill(page, x_from="50", x_to="20")
    page.get_by_role("button", name="Compute the map").click()
    expect(words(page, "stability-map")).to_contain_text("must be greater")
    fill(page, x_from="0")
    page.get_by_role("button", name="Compute the map").click()
    expect(words(page, "stability-map")).to_contain_text("must turn")
    # another quantity brings its own range
    page.locator(".field-x:visible select").select_option("Depth (µm)")
    expect(page.locator(".field-x_to input")).to_have_value("500")


@pytest.mark.proof
def test_a_speed_run_is_drawn_read_and_clicked(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "speed-run")
    page.locator(".field-count:visible select").select_option("49")
    page.get_by_role("button", name="Run up").click()
    expect(words(page, "speed-run")).to_have_text(re.compile("49 speeds after"))
    settle(page)
    columns, rows, left, width, bottom, height = grid(page, "speed_run_cells_y")
    assert rows == 49
    assert columns > 100
    along_y = pixels(page, "speed-run")
    at = place(page, "speed_run_drawing_y", left + 0.4 * width, bottom + 30.4 * height / rows)
    page.mouse.move(*at)
    tip = page.locator(".bk-Tooltip:visible").first
    expect(tip).to_contain_text("Frequency:")
    expect(tip).to_contain_text("dB")
    page.mouse.click(*at)
    wait(page, lambda: value(page, "shaft_speed_hz") == pytest.approx(39.0, abs=0.06))
    settle(page)
    assert source(page, "speed_run_now")["speed"] == pytest.approx([39.0], abs=1e-4)

    page.get_by_role("button", name="Along x").click()
    wait(page, lambda: pixels(page, "speed-run") != along_y)
    place(page, "speed_run_drawing_x", 0.0, 0.0)
