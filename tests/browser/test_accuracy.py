"""Speed against accuracy in the browser: measured, drawn, a step taken over and given back."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import open_page, pixels, place, settle, show, source, wait, words
from tests.browser.helpers import Server, Watch


@pytest.mark.proof
def test_a_measured_step_is_taken_over_and_given_back(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    open_page(page, explorer, "accuracy")
    empty = pixels(page, "accuracy")
    cancel = page.get_by_role("button", name="Cancel")
    page.get_by_role("button", name="Measure").click()
    expect(cancel).to_be_enabled()
    bar = page.get_by_role("progressbar")
    # cancelled once the program's own Runge-Kutta is through
    wait(page, lambda: float(bar.get_attribute("value") or 0) >= 0.22)
    cancel.click()
    expect(words(page, "accuracy")).to_have_text(re.compile(r"Cancelled\. \d+ points after"))
    settle(page)
    wait(page, lambda: len(source(page, "accuracy_0")["error"]) == 6)
    own = source(page, "accuracy_0")
    assert pixels(page, "accuracy") != empty
    expect(page.locator(".view-accuracy")).to_contain_text("LSODA (multistep)")
    steps = page.get_by_text(re.compile("Steps set by hand: |The program chooses the steps"))
    expect(steps).to_contain_text("The program chooses")

    page.mouse.click(*place(page, "accuracy_drawing_seconds", own["seconds"][4], own["error"][4]))
    expect(steps).to_have_text(re.compile(r"Steps set by hand: \d+ Hz"))
    taken = re.sub(r"\D", "", page.locator(".field-steps select").input_value()[4:])
    show(page, "vibration")
    settle(page)
    expect(page.locator("body")).to_contain_text(f"steps set by hand: {taken} Hz")
    show(page, "accuracy")
    page.get_by_role("button", name="Reset").last.click()
    expect(steps).to_contain_text("The program chooses")
    settle(page)
    expect(page.locator("body")).not_to_contain_text("steps set by hand")

    page.get_by_role("button", name="Cost as evaluations").click()
    place(page, "accuracy_drawing_evaluations", 1e3, 1e-2)


@pytest.mark.proof
def test_where_steps_are_too_long(watch: tuple[Page, Watch], explorer: Server) -> None:
    page, _ = watch
    open_page(page, explorer, "accuracy")
    page.locator(".field-experiment:visible select").select_option("Motion: stability")
    page.get_by_role("button", name="Measure").click()
    expect(words(page, "accuracy")).to_have_text(re.compile(r"\d+ points after"))
    wait(page, lambda: len(source(page, "accuracy_verdict_3")["steps"]) > 3)
    assert len(source(page, "accuracy_limits")["steps"]) == 3
    place(page, "accuracy_drawing_stability", 10.0, 1.0)
    expect(page.locator(".view-accuracy")).to_contain_text("linear limit")
