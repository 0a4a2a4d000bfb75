"""A measurement brought to the page in the browser: read, drawn, sized, and refused."""

from __future__ import annotations

import io
import math
import re

import numpy as np
import pytest
from bearing_explorer.measurement.upload import PIECE
from playwright.sync_api import Page, expect
from scipy.io import wavfile

from bearingcore import presets, simulate
from tests.browser.explorer_page import open_page, pixels, settle, show, source, value, wait
from tests.browser.helpers import Server, Watch

RATE = 48_000
EXTENT = 38.6


@pytest.fixture(scope="module")
def recording() -> bytes:
    """A WAV file of more than one piece: 3 s along x and y, noise, and a channel that says nothing.

    One stands for m/s².
    """
    scene = presets["fan-rig"].replace(extent=math.radians(EXTENT))
    motion = simulate(scene, 3.2, float(RATE))
    signal = motion.outer_acceleration[round(0.2 * RATE) :]
    rng = np.random.default_rng(1)
    signal = signal + 0.1 * signal.std(axis=0) * rng.standard_normal(signal.shape)
    signal = np.hstack([signal, rng.standard_normal((len(signal), 1))])
    file = io.BytesIO()
    wavfile.write(file, RATE, signal.astype(np.float32))
    return file.getvalue()


def bring(page: Page, name: str, content: bytes) -> None:
    page.locator("#measurement-file").set_input_files(
        {"name": name, "mimeType": "application/octet-stream", "buffer": content}
    )


@pytest.mark.proof
def test_a_file_is_read_drawn_and_sized_and_a_broken_one_told(
    watch: tuple[Page, Watch], explorer: Server, recording: bytes
) -> None:
    page, _ = watch
    assert len(recording) > 1.5 * PIECE
    open_page(page, explorer, "diagnosis")
    said = page.locator(".view-measurement p.words")
    expect(said).to_contain_text("No signal yet")
    assert page.locator(".view-measured-spectrum canvas:visible").count() == 0

    # broken, before there is anything
    bring(page, "broken.wav", recording[:2000])
    expect(said).to_contain_text("broken.wav cannot be used")
    expect(said).to_have_class(re.compile("bad"))

    # three channels: which are x and y must be said
    bring(page, "fan.wav", recording)
    expect(said).to_contain_text("The file holds 3 signals.")
    expect(page.locator(".field-y")).to_have_class(re.compile("open"))
    page.locator(".field-y select").select_option(index=1)
    expect(said).to_contain_text("fan.wav: 3 s along y at 48\u202f000 Hz")
    # the file does not say its unit: what needs it waits, and the axis does not pretend
    unit = page.locator(".view-measurement .field-unit")
    expect(unit).to_have_class(re.compile("open"))
    expect(page.locator(".field-unit select")).to_have_value("choose")
    expect(page.locator(".view-measured-spectrum")).to_contain_text("Choose the unit above")
    page.locator(".field-unit select").select_option("m/s²")
    expect(unit).not_to_have_class(re.compile("open"))
    page.locator(".field-x select").select_option(index=1)
    expect(said).to_contain_text("cannot be the same column")
    page.locator(".field-y select").select_option(index=2)
    expect(said).to_contain_text("along x and y")
    expect(page.locator(".view-measured-envelope")).to_contain_text(re.compile(r"is (\d×)?BPFO\."))
    spectrum = page.locator(".view-measured-spectrum")
    expect(spectrum.locator(".field-direction option")).to_have_text(["x", "y"])
    measured = source(page, "measured_spectrum_measured")
    assert 0.0 < measured["frequency"][1] < 40.0
    assert len(measured["dB"]) > 50
    assert spectrum.locator("canvas:visible").count() >= 1
    before = pixels(page, "measured-spectrum")
    spectrum.locator(".field-scale select").select_option("linear")
    page.wait_for_function(
        "Bokeh.documents[0].get_model_by_name('measured_spectrum_drawing_linear').visible"
    )
    wait(page, lambda: pixels(page, "measured-spectrum") != before)

    # a refusal beside its field leaves what is drawn
    page.locator(".field-sample_rate input").fill("quick")
    page.locator(".field-sample_rate input").press("Tab")
    expect(page.locator(".view-measurement dl .refused")).to_contain_text("must be a number")
    assert source(page, "measured_spectrum_measured") == measured
    page.locator(".field-sample_rate input").fill(str(RATE))
    page.locator(".field-sample_rate input").press("Tab")
    expect(page.locator(".view-measurement dl .refused")).to_have_count(0)

    # the part, found by itself
    part = page.locator(".view-diagnosis section.part")
    expect(part).to_have_attribute("data-mood", "fault", timeout=30000)
    expect(part.locator("h3")).to_have_text(re.compile("The outer race is (probably )?damaged"))

    # the size: the scene says 12.9°, the signal knows better
    assert value(page, "extent_deg") == pytest.approx(12.9)
    page.get_by_role("button", name="Find the size").click()
    expect(page.locator(".view-sizing .job .words p")).to_contain_text("was tried")
    candidates = page.locator(".view-sizing tbody tr")
    expect(candidates.first).to_be_visible()
    assert candidates.count() >= 4
    best = page.locator(".view-sizing tr.looked")
    expect(best.locator("th")).to_contain_text(re.compile(r"38\.[4-8]°"))
    expect(best.locator(".percent")).to_have_text("above 99 %")
    assert page.locator(".view-sizing .truth").count() == 0
    settle(page)
    assert len(source(page, "measurement_events")["time"]) >= 7
    waveform = source(page, "sizing_pass_candidate_y")["size"]

    # another candidate's curves, over the same measured ones
    chosen = page.get_by_label("Curves shown")
    taken = chosen.input_value()
    chosen.select_option(index=0)
    expect(candidates.nth(0)).to_have_class(re.compile("looked"))
    expect(best).to_have_count(1)
    page.wait_for_function(
        """was => Bokeh.documents[0].get_model_by_name("sizing_pass_candidate_y")
                   .data.size[7] != was""",
        arg=waveform[7],
    )
    chosen.select_option(taken)

    page.get_by_role("button", name=re.compile(r"Take 38\.\d° into the scene")).click()
    settle(page)
    assert value(page, "extent_deg") == pytest.approx(EXTENT, abs=0.3)

    # after a broken file no old figure stays under its name
    bring(page, "broken.csv", b"x,y\n1,2\nhello,3")
    expect(said).to_contain_text("broken.csv cannot be used")
    expect(said).to_contain_text("The signal before it is put away.")
    expect(candidates.first).to_be_hidden()
    expect(page.locator(".field-x")).to_be_hidden()
    show(page, "load")
    show(page, "diagnosis")
    expect(said).to_contain_text("broken.csv cannot be used")

    # those who have no file simulate one, and see the truth marked
    page.get_by_role("button", name="Simulate a signal").click()
    expect(said).to_contain_text("Simulated, noise 20 dB below")
    expect(page.locator(".view-sizing")).to_contain_text("has not been looked for yet")
    expect(candidates.first).to_be_hidden()
    page.get_by_role("button", name="Find the size").click()
    expect(page.locator(".view-sizing .truth")).to_have_text(re.compile(r"true 38\.\d°"))


@pytest.mark.proof
def test_the_part_is_named_marked_and_zoomed_to(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    """An old link, a signal made on the spot by a lesson, its part, its lines, its evidence."""
    page, _ = watch
    page.goto(f"{explorer.url}?v=1&preset=6205&race=inner&tab=sizing")
    page.wait_for_function("window.__frames >= 1")
    page.wait_for_function("window.__tab == 'diagnosis'")
    part = page.locator(".view-diagnosis section.part")
    expect(part).to_be_hidden()
    assert page.locator(".view-diagnosis canvas:visible").count() == 0
    page.get_by_role("button", name="Simulate a signal").click()
    expect(part).to_have_attribute("data-mood", "fault")
    expect(part.locator("h3")).to_have_text("The inner race is damaged")
    expect(part.locator("svg")).to_have_attribute("aria-label", "Bearing, inner race marked")
    assert part.locator("svg path.marked").count() == 1
    said = page.locator(".view-diagnosis p").last
    expect(said).to_contain_text("Damage on the inner race")
    expect(said).to_contain_text("The signal is simulated: the inner race is damaged.")
    assert "100 %" not in page.locator(".view-diagnosis").inner_text()

    # the lines that count
    expect(page.locator(".view-diagnosis canvas:visible").first).to_be_visible()
    settle(page)
    lines = source(page, "diagnosis_inner_race_lines")
    assert lines["frequency"][0] == pytest.approx(162.2, rel=0.01)
    assert lines["alpha"][0] > 2.0 * source(page, "diagnosis_outer_race_lines")["alpha"][0]
    assert len(source(page, "diagnosis_spectrum")["frequency"]) > 200
    rows = page.locator(".view-diagnosis tbody tr")
    assert rows.count() == 3
    expect(page.locator(".view-diagnosis tr.leads")).to_contain_text("inner race")

    # zoom to a line
    before = pixels(page, "diagnosis")
    page.get_by_label("Zoom to").select_option("inner race, 2×")
    wait(page, lambda: min(source(page, "diagnosis_spectrum")["frequency"]) > 200.0)
    settle(page)
    assert pixels(page, "diagnosis") != before
    shown = source(page, "diagnosis_spectrum")["frequency"]
    assert 200.0 < min(shown) < 324.0 < max(shown) < 450.0

    # the size of an inner-race defect is not looked for, and no figure is left empty
    expect(page.locator(".view-sizing")).to_contain_text("its size cannot be estimated this way")
    page.get_by_role("button", name="Find the size").click()
    expect(page.locator(".view-sizing .job .words p")).to_contain_text("Not possible")
    assert page.locator(".view-sizing canvas:visible").count() == 0

    # a healthy one is told so
    page.goto(f"{explorer.url}?v=1&preset=6205&extent_deg=0&tab=diagnosis")
    page.wait_for_function("window.__tab == 'diagnosis'")
    page.get_by_role("button", name="Simulate a signal").click()
    expect(part).to_have_attribute("data-mood", "healthy")
    expect(part.locator("h3")).to_have_text("No damage seen")
    expect(part.locator(".summary")).to_contain_text("Measure again at the usual time.")
    assert part.locator("svg .marked").count() == 0
