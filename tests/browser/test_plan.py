"""The plan on the page: drawn by when the hand rests, overruled, and given back."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import open_page, rest, settle, show, slider, source, status, wait
from tests.browser.helpers import Server, Watch, drag, holding

PLANNED = re.compile(r"this scene: 2 DOF \(x y\), (\d+) cage angles: .*, error 0\.\d+ %")


#: notes how long ago that was asked for which comes drawn by its plan [ms]
PAUSES = """() => {
  let asked = window.__asked, resting = window.__resting
  const asked_at = new Map()
  window.__pauses = []
  Object.defineProperty(window, "__asked", {
    get: () => asked,
    set: (mark) => { asked = mark; asked_at.set(mark, performance.now()) },
  })
  Object.defineProperty(window, "__resting", {
    get: () => resting,
    set: (now) => {
      resting = now
      if (now) window.__pauses.push(performance.now() - (asked_at.get(window.__mark) ?? -Infinity))
    },
  })
}"""


@pytest.mark.proof
def test_the_hand_moves_rests_overrules_and_gives_back(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "stiffness")
    line = status(page)
    rest(page)
    footer = page.get_by_role("contentinfo").bounding_box()

    page.evaluate(PAUSES)
    hand = holding(page, slider(page, "extent_deg"), 0.2, 0.35, steps=30)
    moved_at = page.evaluate("performance.now()")
    for _ in range(30):
        next(hand)
        page.wait_for_timeout(20)

    def moving() -> bool:
        next(hand)
        return "121 cage angles" in (line.text_content() or "")

    wait(page, moving)
    pauses = page.evaluate("window.__pauses")
    assert min(pauses, default=1e3) > 250, "nothing is planned while the hand moves"
    page.mouse.up()
    rest(page)
    assert page.evaluate("performance.now()") - moved_at > 250
    expect(line).to_have_text(PLANNED)
    assert page.get_by_role("contentinfo").bounding_box() == footer, "the page does not jump"
    found = PLANNED.search(line.text_content() or "")
    assert found is not None
    # 15 terms with a gap after each, and two points an angle for the loaded balls
    nodes = int(found[1])
    assert len(source(page, "stiffness_defective")["x"]) == 15 * (nodes + 1) + 2 * nodes + 1

    # turning the bearing plans nothing anew
    drag(page, slider(page, "cage_angle_deg"), 0.1, 0.3)
    settle(page)
    expect(line).to_contain_text(f"{nodes} cage angles")
    assert page.evaluate("window.__resting") is True

    opener = page.get_by_role("button", name="Plan", exact=True)
    opener.click()
    expect(page.locator("#plan-list")).to_contain_text("Stiffness this scene: 2 DOF")
    page.get_by_label("Cage angles", exact=True).select_option("61")
    expect(line).to_contain_text("cage angles set by hand: 61")
    settle(page)
    assert len(source(page, "stiffness_defective")["x"]) == 15 * 62 + 2 * 61 + 1
    back = page.get_by_role("button", name="Automatic again")
    back.click()
    expect(line).to_have_text(PLANNED)
    expect(back).to_be_hidden()
    page.keyboard.press("Escape")
    expect(page.locator("#plan-list")).to_be_hidden()

    # motion: the orbit or a march, and it says which
    show(page, "vibration")
    page.evaluate("window.__resting = false")
    drag(page, slider(page, "extent_deg"), 0.3, 0.25)
    rest(page)
    expect(line).to_have_text(re.compile(r"this scene: 2 DOF \(x y\), .* kHz, .* dB; full model"))
    spectrum = page.locator(".view-vibration-spectrum")
    expect(spectrum).to_contain_text(re.compile("that of (the stable orbit|a marched motion)"))
    opener.click()
    page.get_by_label("Settled vibration", exact=True).select_option("march")
    expect(spectrum).to_contain_text("that of a marched motion")
    expect(line).to_contain_text("marched motion set by hand")
    page.get_by_label("Settled vibration", exact=True).select_option("orbit")
    expect(spectrum).to_contain_text("that of the stable orbit")
    expect(line).to_have_text(re.compile(r"periodic orbit set by hand.*1 ball pass: "))
    back.click()
    expect(line).not_to_contain_text("by hand")

    show(page, "accuracy")
    rest(page)
    table = page.locator(".view-plan table")
    expect(table.get_by_role("row")).to_have_count(5)
    expect(table).to_contain_text("Settled vibration")
