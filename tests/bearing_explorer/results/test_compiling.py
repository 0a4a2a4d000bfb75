"""What takes long to compile is compiled elsewhere, once, and no page waits for it."""

from __future__ import annotations

import asyncio
import threading

import pytest
from bearing_explorer.results import compiling
from bearing_explorer.results.compiling import Compilation
from bearing_explorer.session import Explorer

from bearingcore import kernels
from tests.helpers.compiled import compile_once
from tests.helpers.loops import run
from tests.helpers.sections import SECTIONS
from tests.helpers.served import wait_until


@pytest.fixture
def compilation(monkeypatch: pytest.MonkeyPatch) -> Compilation:
    """A process that has not begun; nothing is on disk."""
    made = Compilation()
    for name in ("begin", "ready", "startup_message"):
        monkeypatch.setattr(compiling, name, getattr(made, name))
    monkeypatch.setattr(kernels, "on_disk", lambda kernel: False)
    return made


def test_a_sentence_stands_for_the_page_until_the_first_part_is_compiled(
    compilation: Compilation, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on, first, rest = threading.Event(), threading.Event(), threading.Event()
    said: list[str] = []
    monkeypatch.setattr(compiling, "warm", lambda report: report(str(go_on.wait(60.0))))
    monkeypatch.setattr(compiling, "compile_rest", lambda: rest.wait(60.0))
    assert compilation.startup_message() == "", "nothing is being compiled yet"
    compilation.begin(said.append, lambda: said.append("loaded"), first.set)
    compilation.begin(said.append)
    assert "being compiled for this processor" in compilation.startup_message()
    go_on.set()
    assert first.wait(60.0)
    assert compilation.startup_message() == ""
    assert said == ["True", "loaded"]
    assert not compilation.ready(), "the rest is being compiled"
    rest.set()
    wait_until(compilation.ready)


def test_an_error_of_the_first_part_is_kept(
    compilation: Compilation, monkeypatch: pytest.MonkeyPatch
) -> None:
    def warm(_: object) -> None:
        raise OSError("no compiler")

    over = threading.Event()
    monkeypatch.setattr(compiling, "warm", warm)
    compilation.begin(print, done=over.set)
    assert over.wait(60.0)
    assert str(compilation.failed) == "no compiler"
    assert compilation.startup_message() == ""


def test_the_page_draws_anew_once_all_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    looks, drawn = [0], [0]

    def ready() -> bool:
        looks[0] += 1
        return looks[0] > 2

    monkeypatch.setattr(compiling, "ready", ready)

    async def live() -> None:
        explorer = Explorer(SECTIONS)
        draw = explorer.draw
        monkeypatch.setattr(explorer, "draw", lambda: (draw(), drawn.append(looks[0])))
        explorer.start()
        async with asyncio.timeout(20.0):
            while len(drawn) < 3 or not explorer._loop.idle:
                await asyncio.sleep(0.01)
        explorer.stop()

    run(live())
    assert drawn[-1] > 2, "drawn once more when it was done"


def test_where_compiling_is_switched_off_nothing_is_missing() -> None:
    assert kernels.on_disk(lambda: None)


def test_the_slowest_kernels_are_found_on_disk_once_they_are_compiled() -> None:
    compile_once()
    assert all(map(kernels.on_disk, compiling._slowest()))
