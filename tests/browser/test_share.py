"""Links, steps, kept scenes and files on the real page."""

import csv
import http.client
import io
import json
import math
import struct
import tomllib
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from bearingcore import Scene, equilibrium, presets
from tests.browser.explorer_page import VIEWS, export, settle, show, slider, source, value
from tests.browser.helpers import Server, Watch, drag

LINK = "v=1&preset=fan-rig&extent_deg=38.6&fy_n=-120&cage_angle_deg=12.5&tab=stiffness"


def query(page: Page) -> str:
    return page.evaluate("location.search").removeprefix("?")


def menu(page: Page, name: str) -> Locator:
    page.locator(".share .opener", has_text=name).click()
    return page.locator(f".menu-{name.lower()}")


def saved(page: Page, button: Locator) -> tuple[str, bytes]:
    with page.expect_download() as download:
        button.click()
    return download.value.suggested_filename, Path(download.value.path()).read_bytes()


def opened(page: Page, server: Server, text: str) -> None:
    page.goto(f"{server.url}?{text}")
    page.wait_for_function("window.__frames >= 1")
    settle(page)


def test_the_address_follows_the_hand_and_steps_go_back(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    opened(page, explorer, "")
    assert query(page) == "", "nothing is written before anything is done"
    entries = page.evaluate("history.length")
    undo, redo = (page.get_by_role("button", name=name, exact=True) for name in ("Undo", "Redo"))
    expect(undo).to_be_disabled()

    page.evaluate(
        """() => {
          const old = history.replaceState
          window.__replaced = 0
          history.replaceState = (...a) => { window.__replaced++; old.apply(history, a) }
        }"""
    )
    drag(page, slider(page, "extent_deg"), 0.1, 0.6, steps=25)
    settle(page)
    first = value(page, "extent_deg")
    page.wait_for_function("location.search.includes('extent_deg')")
    assert page.evaluate("window.__replaced") <= 2, "once a drag, not once a position"
    drag(page, slider(page, "depth_um"), 0.1, 0.4)
    settle(page)
    page.locator("#choice-edge").select_option("exact")
    page.wait_for_function("location.search.includes('edge=exact')")
    assert f"extent_deg={first:g}&" in query(page)

    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('edge=exact')")
    expect(page.locator("#choice-edge")).to_have_value("published")
    undo.click()
    page.wait_for_function("!location.search.includes('depth_um')")
    assert value(page, "depth_um") == 50
    undo.click()
    page.wait_for_function("!location.search.includes('extent_deg')")
    settle(page)
    assert value(page, "extent_deg") == 12.9, "a drag is one step"
    expect(undo).to_be_disabled()
    page.keyboard.press("Control+Shift+z")
    page.wait_for_function("location.search.includes('extent_deg')")
    settle(page)
    assert value(page, "extent_deg") == first
    expect(redo).to_be_enabled()

    # A key held down is one step, and text has an undo of its own.
    slider(page, "fy_n").focus()
    for _ in range(5):
        page.keyboard.down("ArrowRight")
    page.keyboard.up("ArrowRight")
    page.wait_for_function("location.search.includes('fy_n')")
    settle(page)
    assert value(page, "fy_n") == -95
    field = page.locator(".control-fy_n .number")
    field.fill("-5")
    field.press("Control+z")
    assert value(page, "fy_n") == -95
    field.press("Escape")
    undo.click()
    page.wait_for_function("!location.search.includes('fy_n')")
    page.get_by_role("button", name="Reset", exact=True).click()
    page.wait_for_function("location.search == '?v=1&preset=fan-rig&tab=overview'")
    undo.click()
    page.wait_for_function("location.search.includes('extent_deg')")
    assert page.evaluate("history.length") == entries, "Back leaves the page"


# a page that is quick enough has drawn each position before the next, and none would wait
_NOTHING_IS_DRAWN = """() => {
  const frame = requestAnimationFrame, drawn = window.__mark
  let newest = drawn
  window.requestAnimationFrame = () => 0
  Object.defineProperty(window, "__mark",
    { configurable: true, get: () => drawn, set: (mark) => { newest = mark } })
  window.__go_on = () => {
    window.requestAnimationFrame = frame
    Object.defineProperty(window, "__mark", { configurable: true, writable: true, value: newest })
  }
}"""


def test_nothing_overtakes_a_position_that_waits(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    """A hand's last position may wait for the screen: a choice or an undo comes after it."""
    page, _ = watch
    opened(page, explorer, "")
    page.evaluate(_NOTHING_IS_DRAWN)
    drag(page, slider(page, "depth_um"), 0.1, 0.4)
    last = value(page, "depth_um")
    assert page.evaluate("window.__waiting.size") == 1
    page.locator("#choice-edge").select_option("exact")
    page.evaluate("window.__go_on()")
    page.wait_for_function("location.search.includes('edge=exact')")
    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('edge=exact')")
    assert f"depth_um={last:g}" in query(page)
    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('depth_um')")
    settle(page)
    assert value(page, "depth_um") == 50, "a drag is one step"


@pytest.mark.proof
def test_a_link_opens_what_it_stands_for_and_a_bad_one_says_so(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    opened(page, explorer, LINK)
    assert (value(page, "extent_deg"), value(page, "fy_n")) == (38.6, -120)
    expect(page.locator(".tab-stiffness")).to_have_attribute("aria-selected", "true")
    scene = presets["fan-rig"].replace(extent=math.radians(38.6), fy=-120.0)
    expected = equilibrium(scene, [math.radians(12.5)]).term("k_yy")[0]
    assert source(page, "stiffness_cells")["now"][5] == pytest.approx(expected, rel=1e-6)
    link = menu(page, "Share").locator("#share-link")
    assert link.input_value() == f"{explorer.url}?{LINK}"
    page.keyboard.press("Escape")
    expect(link).to_be_hidden()

    for text, words in (
        ("v=9&extent_deg=3", "version"),
        ("v=1&extent_deg=" + "9" * 200_000, "far too long"),
        ("v=1&preset=%3Cscript%3Ealert(1)%3C/script%3E", "There is no bearing “<script>alert(1)"),
    ):
        opened(page, explorer, text)
        expect(page.locator(".share .notice")).to_contain_text(words)
        assert value(page, "extent_deg") == 12.9
    assert "address.py" not in explorer.log

    connection = http.client.HTTPConnection("localhost", explorer.port, timeout=120)
    connection.request("GET", "//elsewhere.example/?" + "x" * 1_000_000)
    assert connection.getresponse().getheader("Location") == "?v=too-long"
    connection.close()


@pytest.mark.proof
def test_scenes_are_kept_pinned_and_read_back_with_care(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    opened(page, explorer, LINK)
    page.evaluate(
        """() => localStorage.setItem('bearing-explorer.kept.1', JSON.stringify(
             [7, null, {name: 5, text: 'x'}, {name: 'bad', text: 'v=1&extent_deg=nan'},
              {name: '<img src=x onerror=alert(1)>', text: 'v=1&preset=6205'}]))"""
    )
    page.reload()
    page.wait_for_function("window.__frames >= 1")
    panel = menu(page, "Keep")
    expect(panel.locator(".kept li")).to_have_count(2)
    panel.locator("#share-name").fill("Monday")
    panel.get_by_role("button", name="Keep", exact=True).click()
    expect(panel.locator(".kept li")).to_have_count(3)
    kept = json.loads(page.evaluate("localStorage.getItem('bearing-explorer.kept.1')"))
    assert kept[0]["name"] == "Monday"
    assert kept[0]["text"] == LINK.removesuffix("&tab=stiffness")

    panel.get_by_role("button", name="Pin “Monday” as grey").click()
    pinned = page.locator(".view-stiffness header .grey")
    expect(pinned).to_have_text("Grey is the pinned scene “Monday”.")
    menu(page, "Keep").get_by_text("<img src=x").click()
    page.wait_for_function("location.search.includes('preset=6205')")
    settle(page)
    scene = presets["fan-rig"].replace(extent=math.radians(38.6), fy=-120.0)
    _, text = saved(page, export(page.locator(".view-stiffness"), "csv"))
    columns = list(csv.DictReader(io.StringIO(text.decode())))
    angle = math.radians(float(columns[3]["pinned_cage_angle_deg"]))
    found = float(columns[3]["pinned_k_yy_n_per_m"])
    assert found == pytest.approx(equilibrium(scene, [angle]).term("k_yy")[0], rel=1e-6)
    menu(page, "Keep").get_by_role("button", name="bad", exact=True).click()
    expect(page.locator(".share .notice")).to_contain_text("bad: “nan” is not a number")
    menu(page, "Keep").get_by_role("button", name="Unpin").click()
    expect(pinned).to_be_hidden()
    page.evaluate("localStorage.setItem('bearing-explorer.kept.1', '{broken')")
    page.reload()
    page.wait_for_function("window.__frames >= 1")
    expect(menu(page, "Keep").locator(".kept li")).to_have_count(0)


@pytest.mark.proof
def test_everything_can_be_taken_away(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    opened(page, explorer, LINK.replace("stiffness", "load"))
    box = page.locator(".view-load-distribution")
    _, text = saved(page, export(box, "svg"))
    assert b"Ball load Q (N)" in text
    root = ET.fromstring(text)
    name, picture = saved(page, export(box, "png"))
    assert name == "bearing-load-distribution.png"
    assert picture.startswith(b"\x89PNG")
    size = struct.unpack(">II", picture[16:24])
    assert size == tuple(2 * int(root.get(side, "0")) for side in ("width", "height"))
    shown = {**VIEWS, "bearing-editor": "bearing"}
    for tab in dict.fromkeys(shown.values()):
        show(page, tab)
        for view in (view for view, where in shown.items() if where == tab):
            box = page.locator(f".view-{view}")
            name, text = saved(page, export(box, "svg"))
            assert name == f"bearing-{view}.svg"
            drawn = ET.fromstring(text)
            assert drawn.tag.endswith("svg")
            assert len(drawn.findall(".//{*}path")) > 12, view
            assert text.count(b"<script") == 0
            if view in ("maps", "bearing-editor"):
                assert len(saved(page, export(box, "png"))[1]) > 10_000
    show(page, "load")
    export(page.locator(".view-load-distribution"), "python").click()
    lines = page.locator(".view-load-distribution dialog pre")
    expect(lines).to_contain_text('presets["fan-rig"].replace(')
    expect(lines).to_contain_text("math.radians(38.6)")
    page.keyboard.press("Escape")
    expect(lines).to_be_hidden()

    panel = menu(page, "Download")
    name, text = saved(page, panel.get_by_role("button", name="Scene (TOML)"))
    assert name == "bearing-fan-rig.toml"
    scene = Scene.from_toml(text.decode())
    assert scene == presets["fan-rig"].replace(extent=math.radians(38.6), fy=-120.0)
    page.get_by_role("button", name="Reset", exact=True).click()
    page.wait_for_function("!location.search.includes('extent_deg')")
    for content, words in ((b"extent = [", "not TOML"), (text, "is open")):
        file = {"name": "mine.toml", "mimeType": "application/toml", "buffer": content}
        page.locator("#share-file").set_input_files(file)  # type: ignore[arg-type]
        expect(page.locator(".share .notice")).to_contain_text(words)
    page.wait_for_function("location.search.includes('extent_deg=38.6')")
    assert tomllib.loads(text.decode())["version"] == 1

    show(page, "modes")
    drag(page, slider(page, "depth_um"), 0.1, 0.2)
    settle(page)
    panel = menu(page, "Download")
    name, text = saved(page, panel.get_by_role("button", name="Report of this scene"))
    assert name == "bearing-report.html"
    whole = text.decode()
    assert "<!--figure" not in whole
    assert whole.count("<svg version") >= 10
    assert whole.count("<script") == 0
    assert f"depth_um={value(page, 'depth_um'):g}" in whole
    drag(page, slider(page, "depth_um"), 0.2, 0.3)
    settle(page)  # the page goes on as before
    assert page.evaluate("Bokeh.documents.length") == 1
    report = page.context.new_page()
    watching = Watch()
    watching.follow(report)
    report.set_content(whole)
    assert report.locator("figure svg").count() >= 10
    assert (
        report.evaluate("document.querySelector('.drawing svg').getBoundingClientRect().width")
        > 300
    )
    report.close()
    watching.assert_clean()
