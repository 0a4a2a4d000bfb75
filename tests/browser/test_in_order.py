"""What the server says while views are built: nothing of it is lost, and nothing is built twice."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import painted
from tests.browser.helpers import PAGES, Server, page_server, serving

CHILDREN = ("first", "second", "third")
_SHOWN = """all => all.map(one =>
  [...one.classList].find(word => /^(first|second|third)-/.test(word)))"""


@pytest.fixture(scope="module")
def messages_page() -> Iterator[Server]:
    with serving(page_server(PAGES / "in_messages.py")) as server:
        yield server


@pytest.mark.proof
def test_children_and_numbers_that_come_in_messages_of_their_own_all_arrive(
    page: Page, messages_page: Server
) -> None:
    page.goto(f"{messages_page.url}?boxes=2")
    children = page.locator(".child")
    expect(page.locator(".third-1").first).to_be_visible()
    painted(page)
    wanted = [f"{name}-{number}" for number in range(2) for name in CHILDREN]
    assert children.evaluate_all(_SHOWN) == wanted
    assert page.evaluate("[window.in_order.missing, window.in_order.waiting]") == [[], 0]
    page.wait_for_function("window.heard?.length === 3")
    assert page.evaluate("window.heard") == [3, 1, 4]
