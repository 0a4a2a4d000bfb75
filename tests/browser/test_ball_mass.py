"""The tab on which balls with mass and massless ones are compared, as people use it."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import open_page, settle, show, source, wait
from tests.browser.helpers import Server, Watch


@pytest.mark.proof
def test_a_strike_is_seen_and_its_mechanism_said(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "ball-mass")
    said = page.locator(".view-mechanism [role=status]").first
    expect(said).to_contain_text("up the mass of the balls gives most", timeout=120_000)
    events = source(page, "mass_events")
    assert {0.0, 1.0, 3.0} <= set(events["kind"])
    assert source(page, "mass_flights")["from"]
    expect(page.locator(".view-mass-time [role=status]").first).to_contain_text("strikes the outer")
    spectrum = page.locator(".view-mass-spectrum [role=status]").first
    expect(spectrum).to_contain_text(re.compile(r"[Mm]assless: within"), timeout=60_000)


@pytest.mark.proof
def test_balls_get_mass_by_a_choice_and_keep_it_in_the_link(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "vibration")
    page.locator("#choice-balls").select_option("with mass")
    page.wait_for_function("location.search.includes('balls=with-mass')")
    settle(page)
    page.get_by_text("all, logarithmic").click()
    wait(page, lambda: len(source(page, "spectrum_wide_resonance")["low"]) == 1)
    assert source(page, "spectrum_wide_lines")["frequency"][-1] > 30e3
    page.get_by_role("button", name="Undo", exact=True).click()
    page.wait_for_function("!location.search.includes('balls=')")
    expect(page.locator("#choice-balls")).to_have_value("massless")
    show(page, "load")
