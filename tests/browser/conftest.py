"""A real server and a real browser for the tests in this folder.

Without Chromium they are skipped; where the environment says CI they fail instead. What a
failed test saw is kept in `failures/`: a screenshot and the server's log.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Page, expect, sync_playwright

from tests.browser.helpers import (
    Server,
    Watch,
    chromium,
    explorer_server,
    find_chromium,
    serving,
    slug,
)
from tests.browser.visitor import FAN_RIG, Visitor
from tests.helpers.compiled import compile_once

FAILURES = Path(__file__).parent / "failures"
PATIENCE = 120_000
"""How long to wait for what does not happen [ms]: much longer than a crowded machine takes."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Everything in this folder drives the browser."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Iterator[None]:
    """Let fixtures know whether their test failed."""
    outcome = yield
    report = outcome.get_result()  # type: ignore[attr-defined]
    if report.when == "call" and report.failed:
        item.stash[_FAILED] = True
        for server in _servers(item):
            report.sections.append(("end of the server's log", server.log[-3000:]))


_FAILED = pytest.StashKey[bool]()


@pytest.fixture(scope="session")
def browser() -> Iterator[BrowserContext]:
    """One Chromium for all tests."""
    if find_chromium() is None:
        if os.environ.get("CI"):
            pytest.fail("there is no chromium; in CI the browser tests must run")
        pytest.skip("there is no chromium")
    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as playwright, chromium(playwright) as context:
        context.set_default_timeout(PATIENCE)
        yield context


@pytest.fixture(scope="session")
def explorer() -> Iterator[Server]:
    """The explorer, served, with all its kernels compiled: it has nothing else to do."""
    compile_once()
    with serving(explorer_server()) as server:
        yield server


@pytest.fixture
def watch(request: pytest.FixtureRequest, browser: BrowserContext) -> Iterator[tuple[Page, Watch]]:
    """A new page that must end without errors and without strangers."""
    page = browser.new_page()
    watching = Watch()
    watching.follow(page)
    yield page, watching
    if request.node.stash.get(_FAILED, False) or watching.errors or watching.strangers:
        _keep(request, page, watching)
    page.close()
    if not request.node.stash.get(_FAILED, False):
        watching.assert_clean()


@pytest.fixture
def page(watch: tuple[Page, Watch]) -> Page:
    """The page of `watch`, for tests that need no more of it."""
    return watch[0]


@pytest.fixture(scope="session")
def _desk(browser: BrowserContext, explorer: Server) -> Iterator[Visitor]:
    page, watching = browser.new_page(), Watch()
    watching.follow(page)
    visitor = Visitor(page, explorer)
    visitor.open(FAN_RIG + "load")
    yield visitor
    page.close()
    watching.assert_clean()


@pytest.fixture
def desk(_desk: Visitor, request: pytest.FixtureRequest) -> Iterator[Visitor]:
    """One page for all tests that begin with the fan rig: to load it is most of the work."""
    failed, size = request.session.testsfailed, _desk.page.viewport_size
    yield _desk
    if _desk.page.viewport_size != size and size is not None:
        _desk.page.set_viewport_size(size)
    if request.session.testsfailed > failed:
        _desk.open(FAN_RIG + "load")


def _servers(item: pytest.Item) -> list[Server]:
    """The servers that a test has used."""
    used = item.funcargs.values()  # type: ignore[attr-defined]
    return [
        value.server if isinstance(value, Visitor) else value
        for value in used
        if isinstance(value, Visitor | Server)
    ]


def _keep(request: pytest.FixtureRequest, page: Page, watching: Watch) -> None:
    FAILURES.mkdir(exist_ok=True)
    name = slug(request.node.name)
    page.screenshot(path=FAILURES / f"{name}.png", full_page=True)
    log = "\n".join(server.log for server in _servers(request.node))
    (FAILURES / f"{name}.log").write_text(
        "\n".join([*watching.errors, *watching.strangers, "", log]), encoding="utf-8"
    )
