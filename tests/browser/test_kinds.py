"""A pair, a self-aligning and a roller bearing, walked through all tabs in the real page."""

from __future__ import annotations

import re

import pytest
from bearing_explorer.page import SECTIONS
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import number, painted, settle, show, source, wait
from tests.browser.helpers import Server, Watch

#: views that are empty until a job or a measurement is asked for
ASKED_FOR = {"explore", "stability-map", "speed-run", "accuracy", "mechanism"}
TABS = {section.name: [view.name for view in section.views] for section in SECTIONS}

BROKEN = re.compile("could not be computed|Not shown for this scene")

_BLANK = """all => {
  // a figure paints on several canvases that lie on top of each other; one of them is enough
  const blank = (canvas) => {
    const {width, height} = canvas
    if (!width || !height) return true
    const {data} = canvas.getContext("2d").getImageData(0, 0, width, height)
    const pixels = new Uint32Array(data.buffer)
    return pixels.every((pixel) => pixel === pixels[0])
  }
  const figures = new Map()
  for (const canvas of all) {
    if (!canvas.getClientRects().length) continue  // put aside until somebody asks for it
    const figure = canvas.parentElement ?? canvas.getRootNode()
    figures.set(figure, (figures.get(figure) ?? true) && blank(canvas))
  }
  return [...figures.values()].filter(Boolean).length
}"""


#: of eleven balls of 10 mm at 40° in the second row
UNLIKE = "7208-back-to-back&rows=-0.009_1_0_4e-06_0~0.009_-1_0_-4e-06_0_0.7_11_0.01_0.055"


def open_scene(page: Page, server: Server, preset: str, tab: str = "load") -> None:
    page.goto(f"{server.url}?v=1&preset={preset}&tab={tab}")
    page.wait_for_function("window.__frames >= 1")
    settle(page)


@pytest.mark.proof
@pytest.mark.parametrize(
    "preset", ["7208-back-to-back", "nu208", UNLIKE], ids=["pair", "rollers", "unlike rows"]
)
def test_every_tab_shows_it(watch: tuple[Page, Watch], explorer: Server, preset: str) -> None:
    page, _ = watch
    open_scene(page, explorer, preset)
    for tab, views in TABS.items():
        show(page, tab)
        painted(page)
        for view in views:
            shown = page.locator(f".section-{tab} .view-{view}")
            expect(shown).to_have_count(1)
            if view not in ASKED_FOR and tab != "diagnosis":
                figures = shown.locator("canvas")
                wait(page, lambda found=figures: found.evaluate_all(_BLANK) == 0)  # type: ignore[misc]
            for sentence in shown.locator("[role=status]").all_inner_texts():
                assert not BROKEN.search(sentence), f"{tab}, {view}: {sentence}"


def test_both_rows_are_drawn_and_told_apart(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_scene(page, explorer, "7208-back-to-back")
    balls = source(page, "bearing_balls")
    assert len(balls["x"]) == 28
    left, right = balls["x"][:14], balls["x"][14:]
    assert max(left) < min(right), "rows stand beside each other"
    curve, other = (
        source(page, f"load_distribution_{which}")["load"] for which in ("curve", "other_rows")
    )
    assert max(other) > 0.0
    assert max(curve) != pytest.approx(max(other), rel=0.02)
    sentence = page.locator(".view-load-distribution [role=status]")
    expect(sentence).to_contain_text("of row 2")
    defect = source(page, "bearing_defect")
    assert max(defect["x"]) < 0.0, "the defect is in the first row"
    page.locator("#choice-row").select_option("2")
    settle(page)
    wait(page, lambda: min(source(page, "bearing_defect")["x"]) > 0.0)


def test_dimensions_wait_until_they_fit(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_scene(page, explorer, "6205", "bearing")

    def give(name: str, text: str) -> None:
        number(page, name).fill(text)
        number(page, name).press("Enter")

    give("ball_diameter_mm", "17.462")
    ball = page.locator(".section-bearing .control-ball_diameter_mm")
    expect(ball).to_have_class(re.compile("drafted"))
    expect(ball.locator(".refusal")).to_contain_text("do not overlap")
    expect(number(page, "ball_diameter_mm")).to_have_value("17.462")
    waits = page.locator(".waits")
    expect(waits).to_contain_text("Not applied yet")
    expect(page.locator(".facts div", has_text="Balls pass the outer race")).to_contain_text(
        "107.4"
    )
    give("inner_groove_radius_mm", "9.08")
    give("pitch_diameter_mm", "85")
    expect(waits).to_be_hidden()
    expect(number(page, "ball_diameter_mm")).to_have_value("17.462")
    expect(number(page, "inner_groove_radius_mm")).to_have_value("9.08")
    expect(ball.locator(".refusal")).to_be_hidden()
    give("n_balls", "40")
    expect(waits).to_be_visible()
    waits.get_by_role("button").click()
    expect(waits).to_be_hidden()
    expect(number(page, "n_balls")).to_have_value("9")


def test_a_bearing_is_named_and_its_groove_given_as_a_ratio(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_scene(page, explorer, "6205", "bearing")
    ratio = page.locator(".control-outer_groove_radius_mm .twin input")
    expect(ratio).to_have_value("0.53")
    ratio.fill("0,55")
    ratio.press("Enter")
    expect(number(page, "outer_groove_radius_mm")).to_have_value("4.367")
    speed = page.locator(".control-shaft_speed_hz .twin input")
    speed.fill("1500")
    speed.press("Enter")
    expect(number(page, "shaft_speed_hz")).to_have_value("25")
    page.get_by_label("Name", exact=True).fill("Pump 3")
    page.get_by_label("Name", exact=True).press("Enter")
    expect(page.locator("#choice-preset option:checked")).to_have_text("Pump 3")
    wait(page, lambda: "name=Pump+3" in page.url)


def test_a_bearing_is_taken_from_the_list_and_from_a_table_of_ones_own(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_scene(page, explorer, "6205", "bearing")
    page.locator("#bearing-search").fill("harris 209")
    expect(page.locator(".bearings li")).to_have_count(1)
    page.get_by_role("button", name="Use 209, Harris").click()
    expect(number(page, "pitch_diameter_mm")).to_have_value("65")
    expect(page.locator("#choice-preset option:checked")).to_have_text("209, Harris")
    words = page.locator("#bearing-file-words")
    file = page.locator("#bearing-file")
    head = "name;balls;ball_diameter_mm;pitch_diameter_mm\n"
    for text, said in (
        (head + "Ours;9;x;39\n", "line 2"),
        (head + "Ours;8;7,94;39,04\n", "1 bearing"),
    ):
        file.set_input_files({"name": "ours.csv", "mimeType": "text/csv", "buffer": text.encode()})
        expect(words).to_contain_text(said)
    page.locator("#bearing-search").fill("ours")
    page.get_by_role("button", name="Use Ours").click()
    expect(number(page, "n_balls")).to_have_value("8")


def test_life_follows_the_rating_that_is_typed(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_scene(page, explorer, "nu208", "life")
    life = page.locator(".view-life")
    expect(life).to_contain_text("by ISO 281")
    rating = page.get_by_label("Dynamic load rating of the catalogue")
    rating.fill("62")
    rating.press("Enter")
    expect(life).to_contain_text("62 kN, given")
    expect(life).to_contain_text("million turns")
    expect(life).to_contain_text("not a promise")
    rating.fill("nothing")
    rating.press("Enter")
    expect(life.locator(".refused").first).to_contain_text("goes from")
