"""For all tests: what parallel processes share is made before they start."""

import os

import pytest

MOST = 4
"""Parallel processes at most: each may start a server and a browser of its own."""

# Before numpy is loaded, as the program does it: processes in parallel leave no core for threads.
for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# before anything imports them
pytest.register_assert_rewrite("tests.helpers", "tests.browser.explorer_page")


def pytest_xdist_auto_num_workers() -> int:
    """As many as there are processors that this process may use, real or not."""
    may_use = getattr(os, "sched_getaffinity", None)
    return min(MOST, len(may_use(0)) if may_use else os.cpu_count() or 1)


@pytest.hookimpl(tryfirst=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile once, before processes that run in parallel would all compile the same."""
    parallel = session.config.getoption("numprocesses", default=None)
    starts_them = not hasattr(session.config, "workerinput")
    if parallel and starts_them and not session.config.option.collectonly:
        from tests.helpers.compiled import compile_once

        compile_once()
