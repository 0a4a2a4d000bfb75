"""Journeys of a person through the page, from end to end, by what is seen."""

import io
import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import BrowserContext, Page, expect
from scipy.io import wavfile

from bearingcore import Scene, catalogue, equilibrium, modes, presets, simulate
from tests.browser.explorer_page import rest
from tests.browser.helpers import Server, Watch
from tests.browser.test_accessibility import hold_to_rules, hold_to_screens, make_ready
from tests.browser.visitor import FAN_RIG, Visitor
from tests.helpers.saved import matlab, saved

FAN = presets["fan-rig"]
_NOTHING = re.compile("could not be computed|Traceback|undefined|\\bNaN\\b")


@pytest.fixture
def visitor(page: Page, explorer: Server) -> Visitor:
    return Visitor(page, explorer)


# --- every tab ------------------------------------------------------------------------------------


CAGE_ANGLE = "Position of the balls (cage angle)"


def _passes(scene: Scene) -> np.ndarray:
    return np.linspace(0.0, 2.0 * math.pi / scene.bearing.n_balls, 361)


def _frequency(scene: Scene) -> str:
    """The highest natural frequency of the second band."""
    return f"{np.sort(modes(scene, _passes(scene)).frequency, axis=1)[:, 1].max():.0f}"


def _most_loaded(scene: Scene) -> str:
    load = np.max(equilibrium(scene, [0.0]).ball_load)
    return f"{load:.3g} N" if load < 999.5 else f"{load / 1e3:.3g} kN"


def _stiffest(scene: Scene) -> str:
    return f"{equilibrium(scene, _passes(scene)).term('k_yy').max() / 1e6:.3g} MN/m"


def _now_stiff(scene: Scene) -> str:
    return f"{equilibrium(scene, [0.0]).term('k_yy')[0] / 1e6:.3g} MN/m"


def _outer_race(scene: Scene) -> str:
    return f"{scene.bearing.bpfo(scene.shaft_speed):.2f} Hz"


#: of each tab and part: cards, figures at least, a number of the core or words that it says, and
#: what moves it
TABS = {
    "Overview": (4, 3, _frequency, "Length of the defect"),
    "Load": (4, 3, _most_loaded, "Length of the defect"),
    "Stiffness: Curves": (1, 1, _stiffest, "Length of the defect"),
    "Stiffness: Maps": (1, 1, _now_stiff, "Length of the defect"),
    "Frequencies": (1, 1, _frequency, "Load, downwards"),  # its sentence is the same at 23°
    "Vibration": (5, 4, _outer_race, "Length of the defect"),
    "Machine: Bearing": (1, 0, _outer_race, None),
    "Machine: Rotor and support": (2, 0, None, None),
    "Machine: Life": (1, 0, None, None),
    "Diagnosis": (1, 0, lambda _: "No signal yet", None),
    "Accuracy": (2, 1, None, None),
    "More: Explore": (1, 3, None, "Load, sideways"),
    "More: Over speed": (1, 1, None, "Length of the defect"),
    "More: Paper": (1, 0, None, None),
}
LONG = ("More: Explore", "More: Over speed", "Diagnosis", "Accuracy", "More: Paper")
IN_DARK = list(TABS)[6:]
"""Tabs that are looked at in dark colours; `test_theme.py` has every colour in both."""


@pytest.fixture(scope="module")
def walk(browser: BrowserContext, explorer: Server) -> Iterator[tuple[Visitor, Watch]]:
    """One page for a walk through all tabs."""
    page, watching = browser.new_page(), Watch()
    watching.follow(page)
    visitor = Visitor(page, explorer)
    page.emulate_media(color_scheme="light")
    visitor.open()
    make_ready(page)
    yield visitor, watching
    page.close()


def test_the_tabs_are_those_that_there_have_been(walk: tuple[Visitor, Watch]) -> None:
    places = (
        walk[0]
        .page.locator("nav .parts")
        .evaluate_all(
            """all => all.flatMap((box) => {
             const tab = box.getAttribute("aria-label")
             const parts = [...box.children].map((part) => `${tab}: ${part.textContent}`)
             return parts.length ? parts : [tab]
           })"""
        )
    )
    assert places == list(TABS)


@pytest.mark.parametrize(
    "tab", [pytest.param(tab, marks=[pytest.mark.proof] * (tab in LONG)) for tab in TABS]
)
def test_a_tab_shows_its_views_and_follows_a_slider(walk: tuple[Visitor, Watch], tab: str) -> None:
    visitor, watching = walk
    cards, figures, known, moved = TABS[tab]
    visitor.page.bring_to_front()
    theme = "dark" if tab in IN_DARK else "light"
    if visitor.page.locator("html").get_attribute("data-theme") != theme:
        visitor.press("Help")
        visitor.press(re.compile("^Dark colours"))
        visitor.page.keyboard.press("Escape")
    visitor.go_to(tab)
    headings = visitor.main.get_by_role("heading", level=2)
    visitor.wait(lambda: headings.count() >= cards and len(visitor.figures()) >= figures)
    if figures or tab == "Machine: Bearing":  # whose picture is none of Bokeh's
        hold_to_screens(visitor.page)
    visitor.look_over()
    visitor.steady()
    assert "blank" not in visitor.figures()
    assert not _NOTHING.search(" ".join(visitor.sentences()))
    visitor.read_more()
    if known is not None:
        visitor.reads(re.compile(re.escape(known(FAN))))
    if moved is not None:
        visitor.sees_change(lambda: visitor.slider(moved).press("PageUp"))
        visitor.press("Reset", visitor.scene)
        expect(visitor.box("Length of the defect")).to_have_value("12.9")
    hold_to_rules(visitor.page, theme, "html" if tab == "Overview" else "main")
    watching.assert_clean()


# --- the scene ------------------------------------------------------------------------------------


def test_what_cannot_be_is_refused_and_what_is_drawn_stays(desk: Visitor) -> None:
    desk.begin("Load")
    rest(desk.page)
    before = desk.figures()
    for text in ("400", "a lot"):
        desk.type("Length of the defect", text)
        desk.reads(re.compile("from 0 to 360"), desk.scene)
        desk.box("Length of the defect").press("Escape")
    rest(desk.page)
    assert desk.figures() == before
    desk.type("Load, downwards", "0")  # nothing presses the balls
    desk.reads("No answer", desk.page.get_by_role("contentinfo"))
    desk.type("Length of the defect", "33,25")
    expect(desk.box("Length of the defect")).to_have_value("33.25")


def test_dimensions_that_do_not_fit_and_a_crossed_limit_are_said(visitor: Visitor) -> None:
    visitor.open("?v=1&preset=6205&tab=bearing")
    limits = visitor.page.get_by_role("region", name="Limits of the model")
    visitor.type("Load, downwards", "20000")
    visitor.reads(re.compile("GPa"), limits)
    limits.get_by_role("button").first.click()
    expect(limits.get_by_role("row").nth(7)).to_be_visible()
    visitor.page.keyboard.press("Escape")
    expect(limits.get_by_role("row").first).to_be_hidden()
    visitor.type("Ball diameter", "17.462")
    visitor.reads(re.compile("overlap"))
    visitor.type("Pitch diameter", "85")
    visitor.type("Ball diameter", "17.462")
    expect(visitor.box("Ball diameter")).to_have_value("17.462")
    visitor.main.get_by_label("Name", exact=True).fill("Pump 3")
    visitor.page.keyboard.press("Enter")
    chosen = visitor.page.get_by_role("combobox", name="Bearing", exact=True)
    expect(chosen).to_have_value("Pump 3")


@pytest.mark.proof
def test_two_tabs_in_a_hurry_are_both_whole(visitor: Visitor) -> None:
    visitor.open()
    for tab in ("Load", "Vibration", "Load", "Vibration"):
        visitor.page.get_by_role("tab", name=tab, exact=True).click()
    for tab in ("Vibration", "Load"):
        visitor.go_to(tab)
        cards, figures, *_ = TABS[tab]
        visitor.wait(lambda figures=figures: len(visitor.figures()) >= figures)  # type: ignore[misc]
        expect(visitor.main.get_by_role("heading", level=2)).to_have_count(cards)
        assert "blank" not in visitor.figures()


def test_a_map_is_read_and_clicked(visitor: Visitor) -> None:
    visitor.open("?v=1&preset=liew-lim&tab=maps")
    before = visitor.number("Length of the defect"), visitor.number(CAGE_ANGLE)
    visitor.point(0, 0.12, 0.12)
    visitor.reads(re.compile("Length of the defect.*°"), visitor.page.locator("body"))
    visitor.page.mouse.down()
    visitor.page.mouse.up()
    visitor.wait(
        lambda: (visitor.number("Length of the defect"), visitor.number(CAGE_ANGLE)) != before
    )
    visitor.steady()
    visitor.reads(re.compile(f"{visitor.number('Length of the defect'):g}°"))
    # the value under the pointer is that of the core
    visitor.point(0, 0.13, 0.13)
    tooltip = visitor.page.locator(".bk-Tooltip div:has(> b)").filter(visible=True)
    shown = tooltip.inner_text().replace("−", "-")
    match = re.search(r"(-?[\d.]+) ([kM])N/m", shown)
    place = [
        re.search(rf"{name}\D*?([\d.]+)°", shown) for name in ("Length of the defect", "Cage angle")
    ]
    assert match is not None
    assert None not in place, shown
    extent, angle = (float(number[1]) for number in place if number is not None)
    liew_lim, near = presets["liew-lim"], []
    for apart in (-0.5, 0.0, 0.5):  # degrees, as the pointer lies between points of the map
        scene = liew_lim.replace(extent=math.radians(extent + apart))
        angles = np.radians(angle + np.array([-0.3, 0.0, 0.3]))
        near.append(equilibrium(scene, np.maximum(angles, 0.0)).term("k_xx"))
    value = float(match[1]) * {"k": 1e3, "M": 1e6}[match[2]]
    assert 0.99 * np.min(near) <= value <= 1.01 * np.max(near)


def test_defects_are_added_chosen_and_removed(desk: Visitor) -> None:
    desk.begin("Load")
    before = desk.figures()
    desk.press("Add a defect")
    desk.wait(lambda: desk.figures() != before)
    expect(desk.box("Centre")).to_have_value("90")
    desk.choose("Floor", "Rough")
    expect(desk.box("Roughness, RMS")).to_be_visible()
    desk.choose("Floor", "Measured")
    desk.reads(re.compile("read_floor"), desk.scene)
    desk.press(re.compile("^Defect 1"))
    expect(desk.box("Centre")).to_have_value("270")
    desk.press("Remove defect 1")
    expect(desk.box("Centre")).to_have_value("90")
    expect(desk.scene.get_by_role("button", name="Remove defect 1")).to_be_disabled()


# --- what is special to a tab ---------------------------------------------------------------------


def test_life_is_computed_from_what_is_known_of_oil_and_rating(desk: Visitor) -> None:
    desk.begin("Machine: Life")
    desk.reads(re.compile("GPa"))
    desk.main.get_by_label("Dynamic load rating of the catalogue").fill("14")
    desk.page.keyboard.press("Enter")
    desk.reads(re.compile("14 kN"))
    desk.main.get_by_label("Viscosity of the oil").fill("much")
    desk.page.keyboard.press("Enter")
    desk.reads("must be a number, not “much”")


@pytest.mark.proof
def test_a_plane_is_explored_and_a_click_goes_there(desk: Visitor) -> None:
    desk.begin("More: Explore")
    desk.wait(lambda: len(desk.figures()) >= 3)
    desk.sees_change(lambda: desk.choose("Horizontal axis", "Radial clearance (µm)"))
    shown = desk.page.locator(".bk-Tooltip").filter(visible=True, has_text="µm")

    def clearance_under_the_pointer() -> bool:
        desk.point(0, 0.4, 0.5)
        desk.point(0, 0.5, 0.5)
        return shown.count() > 0

    desk.wait(clearance_under_the_pointer)  # the figure comes after its sentence
    desk.page.mouse.down()
    desk.page.mouse.up()
    desk.wait(lambda: desk.number("Load, downwards") != 100.0)
    assert 220.0 < desk.number("Load, downwards") < 305.0  # the middle of 25 to 500 N
    desk.steady()
    _, table = desk.download(lambda: desk.export("CSV"))
    assert len(table.decode().strip().splitlines()) >= 63


@pytest.mark.proof
def test_the_vibration_is_seen_over_all_frequencies_and_with_harmonics(desk: Visitor) -> None:
    desk.begin("Vibration")
    for act in (
        lambda: desk.main.get_by_role("checkbox").first.check(),
        lambda: desk.main.get_by_label("Frequency", exact=True).select_option(index=1),
    ):
        before = desk.figures()
        act()
        desk.wait(lambda before=before: desk.figures() != before)  # type: ignore[misc]
        desk.steady()
    desk.choose("Balls", "With mass")
    desk.steady()
    desk.press("Undo")
    expect(desk.page.get_by_label("Balls", exact=True)).to_have_value("massless")


def test_a_ball_strikes_where_the_numbers_say(desk: Visitor) -> None:
    desk.begin("Vibration")
    desk.press("Show: A ball with mass passes the defect")
    desk.reads(re.compile("strikes the outer race after"))
    sentence = " ".join(desk.sentences())
    strikes = re.findall(r"the (inner|outer) race after ([\d.]+) ms with ([\d.]+) N", sentence)
    assert {race for race, *_ in strikes} >= {"outer"}
    card = desk.headings().index("A ball with mass passes the defect")
    _, text = desk.download(lambda: desk.export("CSV", card))
    table = np.genfromtxt(io.StringIO(text.decode()), delimiter=",", names=True)
    for race, after, load in strikes:
        apart = table["time_s"] - 1e-3 * float(after)
        flight = (apart > -0.5e-3) & (apart < -0.1e-3)
        strike = (apart > -0.1e-3) & (apart < 1e-3)
        balls = [name for name in table.dtype.names or () if f"{race}_race_load" in name]
        flying = [name for name in balls if not table[name][flight].any()]
        assert max(table[name][strike].max() for name in flying) > 0.9 * float(load)


@pytest.mark.proof
def test_a_long_run_is_cancelled_and_a_short_one_drawn(desk: Visitor) -> None:
    desk.begin("More: Over speed")
    desk.choose("Speeds", "193")
    desk.press("Compute all speeds")
    cancel = desk.main.get_by_role("button", name="Cancel").last
    expect(desk.main.get_by_role("progressbar")).to_be_visible()
    cancel.click()
    desk.reads(re.compile("Cancelled"))
    expect(cancel).to_be_disabled()
    desk.choose("Speeds", "25")
    desk.press("Compute all speeds")
    desk.reads(re.compile("25 speeds after"))
    desk.steady()
    before = desk.figures()
    assert before
    assert "blank" not in before
    desk.press("Along x")
    desk.wait(lambda: desk.figures() != before)


def test_a_bearing_is_entered_and_found_by_name(visitor: Visitor) -> None:
    visitor.open(FAN_RIG + "bearing")
    visitor.type("Number of balls", "10")
    visitor.reads(_outer_race(FAN.replace(n_balls=10)))
    visitor.find_bearing("209 harris")
    expect(visitor.box("Pitch diameter")).to_have_value("65")
    visitor.find_bearing("6208-2RS/C3")
    visitor.reads(re.compile("Estimated from the designation"))
    visitor.type("Ball diameter", "15/32 in")
    expect(visitor.box("Ball diameter")).to_have_value("11.90625")
    visitor.choose("Kind of bearing", "Cylindrical rollers")
    visitor.steady()
    assert visitor.main.get_by_role("img").first.is_visible()
    visitor.go_to("Load")
    assert "blank" not in visitor.figures()


def test_rotor_support_and_directions_are_changed(desk: Visitor) -> None:
    desk.begin("Machine: Rotor and support")
    desk.type("Mass of the rotor", "4")
    desk.reads(re.compile("rotor of 4 kg"))
    desk.choose("Contact law", "Without tension")
    desk.choose("Shaft", "On this bearing alone: tilt free")
    desk.steady()
    desk.choose("Shaft", "On two bearings: tilt held")
    desk.go_to("Frequencies")
    desk.read_more()
    expected = _frequency(FAN.replace(inner_mass=4.0, contact_law="no tension"))
    desk.reads(re.compile(rf"\b{expected} Hz"))


def _recording(extent_deg: float, rate: float = 24_000.0, *, channels: int = 1) -> bytes:
    """A WAV file of 3 s of the fan rig's housing with noise: y alone, or x, y and noise alone."""
    scene = FAN.replace(extent=math.radians(extent_deg))
    signal = simulate(scene, 3.2, rate).outer_acceleration[round(0.2 * rate) :]
    rng = np.random.default_rng(1)
    signal = signal + 0.1 * signal.std() * rng.standard_normal(signal.shape)
    signal = np.column_stack([signal, rng.standard_normal(len(signal))])
    signal = signal[:, 1 if channels == 1 else slice(3)].astype("f4")
    return saved(wavfile.write, round(rate), signal)


@pytest.mark.proof
def test_a_measurement_is_brought_its_columns_chosen_and_its_part_named(desk: Visitor) -> None:
    """`test_measurement.py` has other roles of columns, which take the same way."""

    def choose(column: int, role: str) -> None:
        desk.main.get_by_label(re.compile(f"^Column {column}, .*is$")).select_option(role)

    desk.begin("Diagnosis")
    desk.bring(desk.main, "fan.wav", _recording(38.6, channels=3))
    desk.reads(re.compile("The file holds 3 signals"))
    choose(1, "x")
    desk.reads(re.compile("fan.wav: 3 s at"))
    choose(2, "x")  # which takes it from the first
    expect(desk.main.get_by_label(re.compile("^Column 1, .*is$"))).to_have_value("")
    choose(2, "y")
    desk.reads(re.compile(r"fan.wav · 3 s · 24 kHz · speed\? · unit\? · bearing\?"))
    desk.reads("Which bearing is it?")  # the scene's is not taken unsaid
    desk.choose("Measured bearing", "that of the scene")
    desk.reads(re.compile(r"speed\? · unit.* · the scene's bearing"))
    desk.choose("Measured speed", "given:")
    desk.type("Hz, or with its unit: rpm", "540 rpm")
    desk.reads(re.compile("540 rpm · unit.* · the scene's bearing"))
    desk.choose("Measured speed", "that of the scene")
    desk.reads(re.compile("420 rpm · unit.* · the scene's bearing"))
    desk.reads(re.compile("outer race is (probably )?damaged"))  # whatever the unit is
    desk.page.locator("#scene-button").click()
    desk.type("Shaft speed", "9")  # which it was not
    desk.reads(re.compile("540 rpm"))
    expect(desk.main.get_by_role("heading", name=re.compile("outer race is"))).to_be_hidden()
    desk.type("Shaft speed", "7")
    desk.reads(re.compile("outer race is (probably )?damaged"))
    desk.bring(desk.main, "broken.csv", b"x,y\n1,2\nhello,3")
    desk.reads(re.compile("broken.csv cannot be used.*fan.wav stays"))
    desk.main.get_by_label("Unit of the signal, channel 2").select_option("m/s²")
    desk.reads(re.compile("outer race is (probably )?damaged"))
    desk.steady()
    assert len(desk.figures()) >= 3
    desk.look_over()
    desk.wait(lambda: "blank" not in desk.figures())  # the extent comes after the part


@pytest.mark.proof
def test_the_answer_to_a_file_of_a_known_collection_is_on_the_first_screen_and_on_one_sheet(
    visitor: Visitor, browser: BrowserContext, tmp_path: Path
) -> None:
    """Unit, rate, speed and bearing of a made file in the layout of a collection are taken."""
    bearing = catalogue()["NICE, MFPT"].bearing
    motor = presets["6205"].replace(bearing=bearing, shaft_speed=math.tau * 25.0)
    rate = 48_828.0
    signal = simulate(motor, 3.2, rate).outer_acceleration[round(0.2 * rate) :, 1]
    noise = np.random.default_rng(1).standard_normal(len(signal))
    run = {"gs": signal + 0.1 * signal.std() * noise, "sr": rate, "rate": 25.0, "load": 270.0}
    file = matlab(bearing=run, BPFO=81.125, BPFI=118.875)
    visitor.page.set_viewport_size({"width": 1366, "height": 768})
    visitor.open(FAN_RIG + "diagnosis")
    visitor.bring(visitor.main, "run.mat", file)
    visitor.reads(re.compile(r"^run.mat · 3 s · 48.83 kHz · 1500 rpm · g · NICE, MFPT$"))
    answer = visitor.main.get_by_role("heading", name="The outer race is damaged")
    expect(answer).to_be_in_viewport()
    expect(
        visitor.main.get_by_text(re.compile("^Probability .*(long|not show)"))
    ).to_be_in_viewport()
    expect(visitor.main.get_by_text(re.compile("Impacts at .*Hz")).first).to_be_in_viewport()
    table = visitor.main.get_by_role("region", name="Evidence for each part").bounding_box()
    below = visitor.main.get_by_text(re.compile("^Damage on the outer race: ")).bounding_box()
    assert table is not None
    assert below is not None
    assert table["y"] + table["height"] <= below["y"] + 1.0
    name, sheet = visitor.download(lambda: visitor.press("Report on one page"))
    (tmp_path / name).write_bytes(sheet)
    page = browser.new_page()
    page.goto((tmp_path / name).as_uri())
    expect(page.get_by_role("heading", name="NICE, MFPT: run.mat")).to_be_visible()
    drawn = page.locator(".drawing svg").evaluate_all("all => all.map(e => e.clientHeight)")
    assert len(drawn) == 4
    assert min(drawn) > 100
    boxes = page.locator(".drawing svg").evaluate_all(
        "all => all.map(e => e.attributes.viewBox.value)"
    )
    assert len(set(boxes)) == 1  # as wide as each other
    assert page.pdf(prefer_css_page_size=True).count(b"/Type /Page\n") == 1
    page.close()


@pytest.mark.proof
def test_a_file_brought_to_the_other_half_is_offered_there(visitor: Visitor) -> None:
    visitor.open(FAN_RIG + "load")
    scene_file = visitor.page.locator("#scene-file")
    signal = {"name": "fan.wav", "mimeType": "audio/wav", "buffer": _recording(38.6, channels=1)}
    scene_file.set_input_files(signal)  # type: ignore[arg-type]
    offer = visitor.page.get_by_text("“fan.wav” may be a measured signal")
    expect(offer).to_be_visible()
    visitor.type("Shaft speed", "8")
    expect(offer).to_be_hidden()  # another thing is done
    scene_file.set_input_files(signal)  # type: ignore[arg-type]
    visitor.press("Diagnose it")
    visitor.is_at("Diagnosis")
    visitor.reads(re.compile("fan.wav · 3 s"))
    visitor.page.reload()
    visitor.reads(re.compile("fan.wav, and what was said of it, is not kept"))
    scene = presets["6205"].to_toml().encode()
    visitor.bring(visitor.main, "motor.toml", scene)
    visitor.press("Open the scene")
    visitor.wait(lambda: abs(visitor.number("Shaft speed") - 29.95) < 0.1)


@pytest.mark.proof
def test_a_signal_is_simulated_where_there_is_no_file(visitor: Visitor) -> None:
    visitor.open("?v=1&preset=6205&race=inner&tab=sizing")  # as the tab was once called
    visitor.press("Simulate a signal")
    visitor.reads(re.compile("The inner race is damaged"))
    visitor.steady()
    frequency, order = visitor.page.evaluate("""() =>
      [...Bokeh.documents[0]._all_models.values()].flatMap(({extra_x_ranges: more, x_range}) => {
        const orders = more?.order ?? more?.get?.("order")
        return orders ? [x_range.end, orders.end] : []
      })""")
    assert frequency / order == pytest.approx(presets["6205"].shaft_speed / (2 * math.pi), rel=1e-3)
    visitor.open("?v=1&preset=6205&extent_deg=0&tab=diagnosis")
    visitor.press("Simulate a signal")
    visitor.reads(re.compile("No damage seen"))


@pytest.mark.proof
def test_section_4_of_the_paper_entry_and_exit_leave_it_open_and_the_ringing_decides(
    visitor: Visitor,
) -> None:
    visitor.open(FAN_RIG + "paper")
    visitor.press("Section 4: size a defect")
    visitor.is_at("Diagnosis")
    visitor.reads(re.compile("about 13° or 16°, outer race"))
    visitor.reads(re.compile(r"^38\.6° \(38\.\d to 38\.\d°\)\. As balls pass, mode"))
    visitor.reads(re.compile(r"38\.6° \(38\.\d to 38\.\d°\), 17\.\d mm long"))  # the verdict
    visitor.steady()
    before = visitor.figures()
    visitor.choose("The machine's support is", "not known")
    visitor.reads(re.compile("needs the mass and the stiffness of its support"))
    visitor.wait(lambda: visitor.figures() != before)


@pytest.mark.proof
def test_accuracy_is_measured_and_what_less_would_do_is_said_with_its_error(
    desk: Visitor,
) -> None:
    desk.begin("Accuracy")
    desk.reads(re.compile("Measured beforehand"))
    desk.reads(re.compile("Within 0.1 dB, RK4 with fixed steps is 130 times cheaper"))
    for charts, words in (
        ("Stability", "growth of a disturbance with each ball pass"),
        ("Statics", "All balls just touching"),
    ):
        desk.choose("Charts of", charts)
        expect(desk.main.get_by_text(re.compile(words))).to_be_visible()
        desk.look_over()
        desk.wait(lambda: "blank" not in desk.figures())
    desk.steady()
    before = desk.figures()
    desk.press("Measure on this machine")  # what is shown
    desk.reads(re.compile(r"\d+ points after"))
    desk.reads(re.compile("Measured on this machine"))
    desk.wait(lambda: desk.figures() != before)
    before = desk.figures()
    desk.press("Compare simpler models", desk.main)
    desk.reads(re.compile(r"\d+ models after"))
    desk.wait(lambda: desk.figures() != before)


# --- lessons, classes, looks ----------------------------------------------------------------------


#: whether what figures on screen tag as an answer is drawn
TAGGED = """() => [...new Set([...Bokeh.index.query(({ model, el }) =>
    model.type === "Figure" && el.getClientRects().length > 0)]
  .flatMap(({ model }) => [...model.renderers, ...model.below])
  .filter(({ tags }) => tags.includes("answer")).map(({ visible }) => visible))]"""


@pytest.mark.proof
def test_a_lesson_is_begun_predicted_answered_and_followed_by_the_next(visitor: Visitor) -> None:
    visitor.open()
    visitor.press("Lessons")
    lesson = visitor.page.get_by_role("region", name="Lesson")
    entries = lesson.get_by_role("listitem")
    assert entries.count() >= 12
    entries.first.get_by_role("button").click()
    title = lesson.get_by_role("heading", level=2)
    first = title.inner_text()
    veil = visitor.main.locator(".view.veiled")
    expect(veil).to_have_count(2)  # what has the answer; the drawing only in part
    answers = visitor.main.get_by_text(re.compile(r"\b39\sN"))
    expect(answers).not_to_have_count(0)  # computed, and behind the veil
    assert not any(answer.is_visible() for answer in answers.all())
    assert visitor.page.evaluate(TAGGED) == [False]
    visitor.is_at("Load")
    lesson.get_by_role("textbox").fill("7")
    lesson.get_by_role("button", name="Predict").click()
    visitor.reads("Not quite: 7 N is too low. Only the balls with colour share", lesson)
    expect(veil).to_have_count(2)  # a hint is no answer
    lesson.get_by_role("textbox").fill("20")
    lesson.get_by_role("button", name="Predict").click()
    visitor.reads("Not quite: 20 N. The answer is 39 N.", lesson)
    expect(veil).to_have_count(0)
    assert visitor.page.evaluate(TAGGED) == [True]
    lesson.get_by_role("button", name="Try it yourself").click()
    lesson.get_by_role("button", name="500 N").click()
    expect(visitor.box("Load, downwards")).to_have_value("500")
    before = lesson.inner_text()
    lesson.get_by_role("button", name=re.compile("answer")).click()
    visitor.wait(lambda: len(lesson.inner_text()) > len(before))
    lesson.get_by_role("button", name="Next lesson").click()
    expect(title).not_to_have_text(first)
    visitor.steady()
    second = title.inner_text()
    visitor.page.reload()
    expect(title).to_have_text(second)
    visitor.press("Close the lessons")
    expect(lesson).to_be_hidden()


@pytest.mark.proof
def test_a_link_of_a_teacher_keeps_answers_back(visitor: Visitor) -> None:
    visitor.open("?lesson=what-a-ball-carries#hide-answers")
    lesson = visitor.page.get_by_role("region", name="Lesson")
    lesson.get_by_role("textbox").fill("7")
    lesson.get_by_role("button", name="Predict").click()
    visitor.reads("Noted: 7 N.", lesson)
    expect(visitor.main.locator(".view.veiled")).to_have_count(0)
    expect(lesson.get_by_role("button", name=re.compile("answer"))).to_have_count(0)
    assert "39" not in lesson.inner_text()
    visitor.page.goto("about:blank")
    visitor.open("?lesson=what-a-ball-carries")  # the address alone does not bring them back
    lesson.get_by_role("textbox").fill("7")
    lesson.get_by_role("button", name="Predict").click()
    visitor.reads("Noted: 7 N.", lesson)
    lesson.get_by_role("combobox", name="Lesson").select_option("All lessons")
    expect(lesson.get_by_role("listitem")).not_to_have_count(0)
    visitor.page.evaluate("localStorage.clear()")  # other tests share this browser


@pytest.mark.proof
def test_two_people_do_not_disturb_each_other_and_share_a_link(
    visitor: Visitor, explorer: Server, browser: BrowserContext
) -> None:
    other_page = browser.new_page()
    other = Visitor(other_page, explorer)
    visitor.open(FAN_RIG + "stiffness")
    other.open(FAN_RIG + "load")
    before = other.sentences(), other.figures()
    visitor.sees_change(lambda: visitor.type("Length of the defect", "38.6"))
    other.steady()
    assert (other.sentences(), other.figures()) == before
    browser.grant_permissions(["clipboard-read", "clipboard-write"])
    visitor.page.bring_to_front()
    share = visitor.menu("Share")
    link = share.get_by_role("textbox").input_value()
    visitor.press("Copy link")
    visitor.wait(lambda: visitor.page.evaluate("navigator.clipboard.readText()") == link)
    other_page.bring_to_front()
    other_page.goto(link)
    other.steady()
    other.read_more()
    other.reads(re.compile(re.escape(_stiffest(FAN.replace(extent=math.radians(38.6))))))
    assert other.number("Length of the defect") == 38.6
    other_page.close()


_NAME = "<img src=x onerror=alert(1)>"
"""Of a kept scene: a name is text, whatever it looks like."""


@pytest.mark.proof
def test_scenes_are_compared_shared_and_removed(visitor: Visitor, explorer: Server) -> None:
    visitor.open(FAN_RIG + "load")
    menu = visitor.menu("Compare")
    menu.get_by_role("button", name="Compare", exact=True).click()
    visitor.wait(lambda: "12.9°, 50 µm" in _keys(visitor))
    visitor.type("Length of the defect", "60")
    menu = visitor.menu("Compare")
    menu.get_by_role("textbox", name="Name of this scene").fill(_NAME)
    menu.get_by_role("button", name="Compare", exact=True).click()
    expect(menu).to_be_hidden()  # what was done is said in its place
    menu = visitor.menu("Compare")
    menu.get_by_role("textbox", name="Name of this scene").fill(_NAME)
    menu.get_by_role("button", name="Keep", exact=True).click()
    visitor.reads(_NAME, menu)
    visitor.page.keyboard.press("Escape")
    visitor.type("Length of the defect", "30")
    visitor.menu("Compare").get_by_role("button", name=_NAME, exact=True).click()
    expect(visitor.box("Length of the defect")).to_have_value("60")
    visitor.type("Length of the defect", "30")
    names = f"12.9°, 50 µm, {_NAME}"
    for tab in ("Load", "Stiffness", "Frequencies", "Vibration"):
        visitor.go_to(tab)
        visitor.wait(lambda: names in _keys(visitor))
    other = visitor.page.context.new_page()
    other.goto(visitor.page.url)
    again = Visitor(other, explorer)
    again.steady()
    again.wait(lambda: names in _keys(again))
    assert again.number("Length of the defect") == 30.0
    menu = again.menu("Compare")
    curves = menu.get_by_role("list", name="Compared scenes").get_by_role("listitem")
    expect(curves).to_have_count(2)
    for left in (1, 0):
        again.press(re.compile("^Remove curve"), menu)
        expect(curves).to_have_count(left)
    again.wait(lambda: _keys(again) == [])
    other.close()


@pytest.mark.proof
def test_a_figure_of_the_paper_is_drawn_and_opened_live(desk: Visitor) -> None:
    desk.begin("More: Paper")
    desk.press("Figure 10")
    desk.reads(re.compile("^Figure 10, "))
    desk.press("Figure 4")
    desk.reads(re.compile("^Figure 4, "))
    desk.reads("100 to 260 MN/m")
    desk.reads(re.compile("^Errors in the paper"))
    assert desk.number("Length of the defect") == 12.9, "the scene stays until a figure is opened"
    desk.press(re.compile("^Open it on the tab Stiffness"))
    desk.is_at("Stiffness: Curves")
    desk.wait(lambda: desk.number("Length of the defect") == 70.0 and "blank" not in desk.figures())
    desk.wait(lambda: _keys(desk) == ["5°, 50 µm, 40°, 50 µm"])
    desk.press("Undo", desk.scene)
    desk.wait(lambda: desk.number("Length of the defect") == 12.9)
    desk.wait(lambda: not any(_keys(desk)) and "blank" not in desk.figures())


def _keys(visitor: Visitor) -> list[str]:
    """The names of compared scenes in the keys of figures, one text a figure."""
    keys: list[str] = visitor.page.evaluate(
        """() => [...Bokeh.index.query((view) => view.model.type === "Legend")]
          .filter(({model, parent}) => model.visible && parent.el.getClientRects().length)
          .map(({model}) => model.items.filter((item) => item.visible)
                                       .map((item) => item.label.value).join(", "))"""
    )
    return keys


@pytest.mark.proof
def test_back_leads_to_the_tab_part_and_lesson_that_was_open(visitor: Visitor) -> None:
    def there(place: str) -> None:
        """The server knows it too, and has given the address its entry."""
        visitor.is_at(place)
        visitor.page.wait_for_function(f"window.__tab == '{place.split()[-1].lower()}'")
        visitor.page.wait_for_url(f"**tab={place.split()[-1].lower()}**")
        visitor.steady()

    visitor.open(FAN_RIG + "life")
    visitor.go_to("More: Explore")
    there("More: Explore")
    visitor.type("Length of the defect", "20")
    visitor.wait(lambda: "extent_deg=20" in visitor.page.url)
    visitor.go_to("More: Paper")
    there("More: Paper")
    changed, first = ("More: Explore", 20.0), ("More: Explore", 12.9)
    for place, extent in (changed, first, ("Machine: Life", 12.9)):
        visitor.page.go_back()
        there(place)
        visitor.wait(lambda extent=extent: visitor.number("Length of the defect") == extent)
    for place, extent in (first, changed, ("More: Paper", 20.0)):
        visitor.page.go_forward()
        there(place)
        visitor.wait(lambda extent=extent: visitor.number("Length of the defect") == extent)
    visitor.page.get_by_role("tab", name="Machine", exact=True).click()
    visitor.is_at("Machine: Life")
    part = visitor.views.get_by_role("button", name="Bearing", exact=True)
    part.press("Enter")
    visitor.is_at("Machine: Bearing")
    visitor.steady()
    expect(part).to_be_focused()
    lesson = visitor.page.get_by_role("region", name="Lesson")
    visitor.press("Lessons")
    lesson.get_by_role("listitem").nth(1).get_by_role("button").click()
    title = lesson.get_by_role("heading", level=2)
    expect(title).not_to_have_text("Lessons")  # the list
    second = title.inner_text()
    lesson.get_by_role("button", name="Next lesson").click()
    expect(title).not_to_have_text(second)
    visitor.steady()
    visitor.page.go_back()
    expect(title).to_have_text(second)
    visitor.wait(lambda: "extent_deg=" not in visitor.page.url)  # with its own scene
    visitor.press("Close the lessons")
    for _ in range(3):  # a step each time that a lesson began
        visitor.press("Undo", visitor.scene)
    expect(visitor.box("Length of the defect")).to_have_value("20")


# --- links and files ------------------------------------------------------------------------------


def test_a_link_that_cannot_be_read_says_so(visitor: Visitor) -> None:
    visitor.open("?v=1&preset=%3Cscript%3Ealert(1)%3C/script%3E")
    visitor.reads(re.compile("no bearing “<script>alert"), visitor.page.locator("body"))
    assert visitor.number("Length of the defect") == 12.9


@pytest.mark.proof
def test_a_scene_is_saved_changed_and_opened(desk: Visitor) -> None:
    desk.begin("Load")
    desk.type("Length of the defect", "38.6")
    desk.steady()
    dialog = desk.menu("Share")
    name, text = desk.download(lambda: desk.press(re.compile("^Scene"), dialog))
    assert name.endswith(".toml")
    assert Scene.from_toml(text.decode()) == FAN.replace(extent=math.radians(38.6))
    desk.page.keyboard.press("Escape")
    desk.press("Reset", desk.scene)
    expect(desk.box("Length of the defect")).to_have_value("12.9")
    dialog = desk.menu("Share")
    desk.bring(dialog, "bad.toml", b"extent = [")
    desk.reads(re.compile("allowed: TOML"), desk.scene)
    desk.bring(desk.scene, "mine.toml", text)
    expect(desk.box("Length of the defect")).to_have_value("38.6")


def test_first_visits_are_shown_in(visitor: Visitor) -> None:
    visitor.open()
    what = visitor.page.get_by_role("button", name="Help")
    welcome = visitor.page.get_by_role("region", name="Introduction")
    help_of_page = visitor.page.get_by_role("dialog", name="Bearing explorer")
    what.click()
    expect(help_of_page).to_contain_text("from bearingcore import")
    help_of_page.get_by_text("Glossary").click()
    assert help_of_page.get_by_role("row").count() > 40
    help_of_page.get_by_role("button", name=re.compile("^My machine")).click()
    visitor.is_at("Machine: Bearing")
    what.click()
    help_of_page.get_by_role("button", name=re.compile("^Introduction")).click()
    spacing = 360.0 / FAN.bearing.n_balls
    beside = visitor.box("Load, downwards").bounding_box()
    visitor.sees_change(lambda: visitor.press("Make the defect longer", welcome))
    assert visitor.number("Length of the defect") == pytest.approx(12.9 + spacing, abs=0.01)
    expect(visitor.page.get_by_text("One rolling element always inside")).to_be_visible()
    assert visitor.box("Load, downwards").bounding_box() == beside  # the cue moves nothing
    visitor.press("Undo")
    expect(visitor.box("Length of the defect")).to_have_value("12.9")
    visitor.press("Close this introduction")
    expect(welcome).to_be_hidden()
    what.click()
    help_of_page.get_by_role("button", name=re.compile("^Learn")).click()
    expect(visitor.page.get_by_role("region", name="Lesson")).to_be_visible()
