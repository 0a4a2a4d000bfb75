"""For all tests: what parallel processes share is made before they start."""

import os
import sys

import pytest

MOST = 4
"""Parallel processes at most: each may start a server and a browser of its own."""

# Before numpy is loaded, as the program does it: processes in parallel leave no core for threads.
for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# A half of the page that this names is hidden: the tests of the other and of the kit pass without.
if hidden := os.environ.get("BEARING_EXPLORER_TESTS_WITHOUT"):
    sys.modules[f"bearing_explorer.{hidden}"] = None  # type: ignore[assignment]

# before anything imports them
pytest.register_assert_rewrite("tests.helpers", "tests.browser.explorer_page")


@pytest.fixture
def files_read_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Files are read in this process, which is quick; that of their own has tests of its own."""
    from tests.helpers.reading import read_in_this_process

    read_in_this_process(monkeypatch)


def pytest_xdist_auto_num_workers() -> int:
    """One more than there are processors: a test that waits for a browser leaves its own free."""
    may_use = getattr(os, "sched_getaffinity", None)
    return min(MOST, 1 + (len(may_use(0)) if may_use else os.cpu_count() or 1))


@pytest.hookimpl(tryfirst=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile once, before processes that run in parallel would all compile the same."""
    parallel = session.config.getoption("numprocesses", default=None)
    starts_them = not hasattr(session.config, "workerinput")
    if parallel and starts_them and not session.config.option.collectonly:
        from tests.helpers.compiled import compile_once

        compile_once()


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Two processes begin with what takes long, one with a browser; all end with what is short.

    Each gets an equal part, and takes from the end of another's once its own is done.
    """
    kinds: dict[str, list[pytest.Item]] = {"browser": [], "proof": [], "": []}
    for item in items:
        kinds[next((kind for kind in kinds if kind and item.get_closest_marker(kind)), "")].append(
            item
        )
    driving, long, short = kinds.values()
    long.sort(key=lambda item: len(item.path.parts))  # those of the whole program take longest
    processes = getattr(config, "workerinput", {"workercount": 2})["workercount"]
    part = max(0, len(items) // processes - len(driving))
    items[:] = [*driving, *short[:part], *long, *short[part:]]
