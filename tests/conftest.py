"""For all tests: what parallel processes share is made before they start."""

from __future__ import annotations

import pytest

from tests.helpers.compiled import compile_once

pytest.register_assert_rewrite("tests.helpers", "tests.browser.explorer_page")


@pytest.hookimpl(tryfirst=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile once, before processes that run in parallel would all compile the same."""
    parallel = session.config.getoption("numprocesses", default=None)
    starts_them = not hasattr(session.config, "workerinput")
    if parallel and starts_them and not session.config.option.collectonly:
        compile_once()
