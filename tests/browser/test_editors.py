"""Bearing, defects, support, directions and warnings, edited in the real page."""

from __future__ import annotations

import math

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from bearingcore import Defect, RoughFloor, equilibrium, presets
from tests.browser.explorer_page import (
    number,
    open_page,
    pixels,
    rest,
    settle,
    show,
    slider,
    source,
    status,
)
from tests.browser.helpers import Server, Watch, choose_tab, drag

FAN_RIG = presets["fan-rig"]


def type_in(page: Page, name: str, text: str) -> None:
    number(page, name).fill(text)
    number(page, name).press("Enter")


def choose(page: Page, name: str, value: str) -> None:
    page.locator(f"#choice-{name}").select_option(value)


def open_tab(page: Page, tab: str) -> None:
    choose_tab(page, tab)
    page.locator(f".section-{tab}.on-screen").wait_for()
    settle(page)


def fact(page: Page, label: str) -> Locator:
    return page.locator(".facts div", has_text=label).locator("dd")


def marked(page: Page) -> list[str]:
    return page.locator(".picture .marked").evaluate_all("all => all.map(g => g.dataset.name)")


@pytest.mark.proof
def test_a_dimension_is_dragged_and_everything_follows(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "stiffness")
    before = pixels(page, "stiffness")
    open_tab(page, "bearing")
    frequency = fact(page, "Balls pass the outer race")
    expect(frequency).to_have_text("40.29 Hz")
    circles = page.locator(".picture [data-name=n_balls] circle")
    expect(circles).to_have_count(14)
    drag(page, slider(page, "n_balls"), 0.41, 0.2)
    settle(page)
    count = int(slider(page, "n_balls").input_value())
    assert count < 14
    expect(circles).to_have_count(count)
    expected = FAN_RIG.replace(n_balls=count)
    bpfo = expected.bearing.bpfo(expected.shaft_speed)
    assert float(frequency.inner_text().split()[0]) == pytest.approx(bpfo, rel=1e-3)
    show(page, "stiffness")
    assert pixels(page, "stiffness") != before
    cells = source(page, "stiffness_cells")
    k_yy = equilibrium(expected, [0.0]).term("k_yy")[0]
    np.testing.assert_allclose(cells["now"][5], k_yy, rtol=1e-5)


@pytest.mark.proof
def test_the_picture_shows_what_is_edited_and_leads_to_it(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    open_tab(page, "bearing")
    number(page, "pitch_diameter_mm").focus()
    assert marked(page) == ["pitch_diameter_mm"]
    expect(page.locator(".editor .about")).to_contain_text(
        "circle on which the centres of the balls run"
    )
    slider(page, "ball_diameter_mm").focus()
    assert marked(page) == ["ball_diameter_mm"]
    page.locator(".picture [data-name=outer_raceway_radius_mm] .label").click()
    expect(number(page, "outer_raceway_radius_mm")).to_be_focused()
    assert marked(page) == ["outer_raceway_radius_mm"]


@pytest.mark.proof
def test_an_impossible_bearing_is_refused_and_the_picture_stays(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    open_tab(page, "bearing")
    picture = page.locator(".picture")
    before = picture.inner_html()
    for name, text, words in (
        ("ball_diameter_mm", "12", "number of balls is 14"),
        ("ball_diameter_mm", "-1", "out of range"),
        ("n_balls", "7.5", "whole number"),
        ("contact_angle_deg", "90", "goes from 0 to 80°"),
        ("inner_raceway_radius_mm", "30", "outer raceway radius"),
        ("load_deflection_factor", "", "missing"),
    ):
        type_in(page, name, text)
        refusal = page.locator(f".control-{name} .refusal")
        expect(refusal).to_contain_text(words)
        expect(number(page, name)).to_have_attribute("aria-invalid", "true")
        number(page, name).press("Escape")
    settle(page)
    picture.evaluate(
        "p => p.querySelectorAll('.marked').forEach(g => g.classList.remove('marked'))"
    )
    assert picture.inner_html().replace(" marked", "") == before.replace(" marked", "")
    expect(fact(page, "Balls pass the outer race")).to_have_text("40.29 Hz")


@pytest.mark.proof
def test_a_bearing_from_its_drawing(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer)
    open_tab(page, "bearing")
    expect(slider(page, "inner_groove_radius_mm")).to_be_hidden()
    choose(page, "numbers", "drawing")
    expect(slider(page, "inner_groove_radius_mm")).to_be_visible()
    expect(slider(page, "load_deflection_factor")).to_be_hidden()
    type_in(page, "inner_groove_radius_mm", "4,16")
    type_in(page, "outer_groove_radius_mm", "4.24")
    settle(page)
    expect(fact(page, "Groove centre distance")).to_have_text("400 µm")
    type_in(page, "inner_groove_radius_mm", "3.9")
    refusal = page.locator(".control-inner_groove_radius_mm .refusal")
    expect(refusal).to_contain_text("inner groove radius")
    expect(page.locator(".origin")).to_contain_text("have been changed")
    page.get_by_role("button", name="Reset").click()
    expect(slider(page, "load_deflection_factor")).to_be_visible()
    expect(page.locator(".origin")).not_to_contain_text("have been changed")
    expect(page.locator(".origin")).to_contain_text("Petersen")


@pytest.mark.proof
def test_an_inner_race_defect_turns_and_the_axes_say_so(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    choose(page, "race", "inner")
    settle(page)
    before = source(page, "bearing_defect")
    type_in(page, "cage_angle_deg", "30")
    settle(page)
    after = source(page, "bearing_defect")
    angles = [math.atan2(s["y"][0], s["x"][0]) for s in (before, after)]
    turned = math.radians(30.0) / FAN_RIG.bearing.cage_ratio
    assert math.remainder(angles[1] - angles[0] - turned, 2 * math.pi) == pytest.approx(0, abs=1e-5)
    label = "[...Bokeh.documents[0]._all_models.values()].some(m => m.axis_label == '%s')"
    show(page, "modes")
    page.wait_for_function(label % "Shaft angle φs (°)")
    assert source(page, "modes_now")["now"][0] == pytest.approx(math.degrees(turned), rel=1e-5)
    show(page, "stiffness")
    assert source(page, "stiffness_axis")["shaft"] == [1]
    assert max(source(page, "stiffness_cells")["foot"]) == 360
    expect(page.locator(".view-stiffness [role=status]")).to_contain_text("turn of the shaft")
    choose(page, "race", "outer")
    show(page, "modes")
    page.wait_for_function(label % "Cage angle φc (°)")


@pytest.mark.proof
def test_several_defects_with_a_rough_floor(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer)
    page.get_by_role("button", name="Add a defect").focus()
    page.keyboard.press("Enter")
    expect(number(page, "center_deg")).to_have_value("90")
    expect(slider(page, "rms_height_um")).to_be_hidden()
    choose(page, "floor", "rough")
    expect(slider(page, "rms_height_um")).to_be_visible()
    type_in(page, "center_deg", "300")
    type_in(page, "rms_height_um", "6")
    settle(page)
    scene = FAN_RIG.replace(
        defect=(
            FAN_RIG.defect,
            Defect(FAN_RIG.defect.extent, 50e-6, math.radians(300), floor=RoughFloor(6e-6, 200e-6)),
        )
    )
    shaded = source(page, "load_distribution_defect")
    np.testing.assert_allclose(shaded["start"], [270 - 6.45, 300 - 6.45], rtol=1e-5)
    profile = source(page, "depth_profile_surface")
    middle = np.abs(np.array(profile["angle"]) - 300.0) < 5.0
    assert np.std(np.array(profile["depth"])[middle]) > 1e-6
    show(page, "stiffness")
    np.testing.assert_allclose(
        source(page, "stiffness_cells")["now"][5],
        equilibrium(scene, [0.0]).term("k_yy")[0],
        rtol=1e-5,
    )
    type_in(page, "depth_um", "6")  # so that balls carry load on the floor
    settle(page)
    before = pixels(page, "stiffness")
    drag(page, slider(page, "rms_height_um"), 0.3, 0.9)
    settle(page)
    assert pixels(page, "stiffness") != before
    page.get_by_role("button", name="Defect 1, outer race at 270°").click()
    expect(number(page, "center_deg")).to_have_value("270")
    expect(slider(page, "rms_height_um")).to_be_hidden()
    page.get_by_role("button", name="Remove defect 1").click()
    expect(number(page, "center_deg")).to_have_value("300")
    expect(page.get_by_role("button", name="Remove defect 1")).to_be_disabled()


@pytest.mark.proof
def test_a_floor_from_a_file(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer)
    choose(page, "floor", "measured")
    field, words = page.locator("#floor-file"), page.locator("#floor-words")
    expect(words).to_have_text("No file yet: the floor is flat.")
    rows = "\n".join(f"{260 + i / 4}, {20 + 15 * math.sin(i / 3):.3f}" for i in range(81))
    field.set_input_files(
        {"name": "wear.csv", "mimeType": "text/csv", "buffer": f"angle, depth\n{rows}".encode()}
    )
    expect(words).to_have_text("wear.csv: 81 points")
    expect(number(page, "extent_deg")).to_have_value("20")
    settle(page)
    drawn = source(page, "depth_profile_surface")
    at = int(np.argmin(np.abs(np.array(drawn["angle"]) - 270.0)))
    assert drawn["depth"][at] == pytest.approx((20 + 15 * math.sin(40 / 3)) * 1e-6, rel=2e-2)
    rest(page)
    before = pixels(page, "depth-profile")
    for name, text, wrong in (
        ("bad.csv", b"1, 2\nthree, 4\nfive, 6\n", "line 2"),
        ("empty.csv", b"", "2 or more lines"),
        ("binary.csv", bytes(range(256)) * 20, "binary.csv"),
        ("large.csv", b"1, 2\n" * 300_000, "larger than 1 MB"),
    ):
        field.set_input_files({"name": name, "mimeType": "text/csv", "buffer": text})
        expect(words).to_contain_text(wrong)
        expect(words).to_have_class("note bad")
    rest(page)
    assert pixels(page, "depth-profile") == before
    expect(status(page)).to_contain_text("Converged")


@pytest.mark.proof
def test_support_and_contact_are_edited(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "modes")
    before = source(page, "modes_bands")["high"]
    open_tab(page, "bearing")  # the first word of controls that came after others is heard, too
    open_tab(page, "model")
    expect(number(page, "contact_damping")).to_have_value("")
    automatic = number(page, "contact_damping").get_attribute("placeholder")
    assert 50 < float(automatic or 0) < 500
    type_in(page, "contact_damping", "300")
    sentence = page.locator(".view-model-editor [role=status]").last
    expect(sentence).to_contain_text("300 N·s/m, given")
    page.get_by_role("button", name="auto").click()
    expect(number(page, "contact_damping")).to_have_value("")
    choose(page, "law", "no tension")
    drag(page, slider(page, "outer_mass"), 0.4, 0.9)
    settle(page)
    type_in(page, "stiffness_z", "")
    expect(number(page, "stiffness_z")).to_have_attribute("placeholder", "not known")
    show(page, "modes")
    assert max(source(page, "modes_bands")["high"]) < max(before)


@pytest.mark.proof
def test_directions_are_forced_and_the_error_shown(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    page.get_by_label("Bearing", exact=True).select_option("liew-lim")
    open_tab(page, "model")
    sentence = page.locator(".view-dofs [role=status]").last
    expect(sentence).to_contain_text("as the scene needs")
    expect(page.get_by_label("z, along the shaft")).to_be_checked()
    for name in ("z, along the shaft", "θx, tilt about x", "θy, tilt about y"):
        box = page.get_by_label(name)
        if box.is_checked():
            box.focus()
            page.keyboard.press("Space")
            expect(box).not_to_be_checked()
            settle(page)
    expect(status(page)).to_contain_text("2 degrees of freedom: x y")
    expect(sentence).to_contain_text("forced on the scene")
    expect(fact(page, "Stiffness up and down")).to_contain_text("%")
    page.get_by_role("button", name="As the scene needs").click()
    expect(sentence).to_contain_text("as the scene needs")
    expect(page.get_by_label("z, along the shaft")).to_be_checked()


def test_a_crossed_limit_is_said_and_all_are_listed(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    page.get_by_label("Bearing", exact=True).select_option("6205")
    strip = page.locator("footer .limits")
    button = strip.get_by_role("button")
    expect(button).to_contain_text("kept")
    expect(strip.locator(".warnings p")).to_have_count(0)
    type_in(page, "fy_n", "-20000")
    expect(strip.locator(".warnings p").first).to_contain_text("GPa")
    expect(button).to_contain_text("crossed")
    foot = page.locator(".page > footer").bounding_box()
    assert foot is not None
    assert foot["height"] < 75, "one line for all that is crossed"
    button.focus()
    page.keyboard.press("Enter")
    expect(button).to_have_attribute("aria-expanded", "true")
    rows = strip.locator("tbody tr")
    assert rows.count() >= 7
    expect(rows.first).to_contain_text("crossed")
    expect(strip.locator("table")).to_contain_text("4.2 GPa")
    page.keyboard.press("Escape")
    expect(strip.locator("table")).to_be_hidden()
    type_in(page, "fy_n", "-1000")
    expect(strip.locator(".warnings p")).to_have_count(0)


def test_every_control_has_a_name_and_takes_the_keyboard(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer)
    for tab in ("bearing", "model"):
        open_tab(page, tab)
        nameless = page.locator(
            f".section-{tab} input, .section-{tab} select, .section-{tab} button, aside input,"
            " aside select, aside button"
        ).evaluate_all(
            """all => all.filter(e => e.checkVisibility() && !(
                 e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.length
               // entries of a menu are gone through by its arrow keys
               ) || (e.tabIndex < 0 && e.role !== "menuitem")).map(e => e.outerHTML)"""
        )
        assert nameless == []


@pytest.mark.parametrize("tab", ["bearing", pytest.param("model", marks=pytest.mark.proof)])
@pytest.mark.parametrize(("width", "height"), [(1366, 768), (390, 844)])
def test_the_editors_fit_the_screen(
    watch: tuple[Page, Watch], explorer: Server, tab: str, width: int, height: int
) -> None:
    page, _ = watch
    page.set_viewport_size({"width": width, "height": height})
    open_page(page, explorer)
    open_tab(page, tab)
    wide = page.evaluate(
        """() => [document.documentElement, document.querySelector("main"),
                  document.querySelector("aside")].map(e => e.scrollWidth - e.clientWidth)"""
    )
    assert wide == [0, 0, 0]
