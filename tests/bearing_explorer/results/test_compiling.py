"""What plans need is compiled elsewhere, once, and nobody waits for it."""

from __future__ import annotations

import asyncio

import pytest
from bearing_explorer.results import compiling
from bearing_explorer.session import Explorer, Inputs, Planned, _planned

from bearingcore import kernels, presets
from bearingcore.plan import SETTLED
from tests.helpers.compiled import compile_once
from tests.helpers.loops import run
from tests.helpers.sections import SECTIONS


class Helper:
    """A process that ends when it is told to."""

    started: list[list[str]]

    def __init__(self, command: list[str], **_: object) -> None:
        self.started.append(command)
        self.returncode: int | None = None

    def poll(self) -> int | None:
        return self.returncode


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """A process that has not begun; what it starts."""
    started: list[list[str]] = []
    monkeypatch.setattr(Helper, "started", started, raising=False)
    monkeypatch.setattr(compiling, "_begun", False)
    monkeypatch.setattr(compiling, "_helper", None)
    monkeypatch.setattr(compiling.atexit, "register", lambda act: None)
    monkeypatch.setattr(compiling.subprocess, "Popen", Helper)
    return started


def test_it_begins_once_and_only_where_something_is_missing(
    fresh: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kernels, "on_disk", lambda kernel: True)
    compiling.begin()
    assert fresh == []
    assert compiling.ready()
    monkeypatch.setattr(compiling, "_begun", False)
    monkeypatch.setattr(kernels, "on_disk", lambda kernel: False)
    compiling.begin()
    compiling.begin()
    assert len(fresh) == 1
    assert "compile_behind" in fresh[0][-1]


def test_motions_are_not_planned_until_it_is_done(
    fresh: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    inputs = Inputs(presets["fan-rig"], 0.0, 1, rested=True, planned=("load", SETTLED))
    monkeypatch.setattr(kernels, "on_disk", lambda kernel: False)
    compiling.begin()
    assert not compiling.ready()
    assert _planned(inputs, lambda: False) == Planned(("load",), compiled=False)
    compiling._helper.returncode = 0
    assert compiling.ready()
    assert _planned(inputs, lambda: False) == Planned(("load", SETTLED), compiled=True)
    assert _planned(inputs, lambda: True).views == (), "overtaken"


@pytest.mark.parametrize(
    "last", [1, *(pytest.param(last, marks=pytest.mark.proof) for last in range(2, 8))]
)
def test_the_page_stops_saying_that_it_compiles(monkeypatch: pytest.MonkeyPatch, last: int) -> None:
    """Whoever is the first to hear it, a picture or a plan, and where nothing new is planned."""
    looks = [0]

    def ready() -> bool:
        looks[0] += 1
        return looks[0] > last

    monkeypatch.setattr(compiling, "ready", ready)

    async def live() -> Explorer:
        explorer = Explorer(SECTIONS)
        explorer.draw()
        async with asyncio.timeout(20.0):
            while not (explorer._idle_task.idle and explorer._worker.idle):
                await asyncio.sleep(0.01)
        return explorer

    explorer = run(live())
    assert looks[0] > last, "it was looked at until it was done"
    assert not explorer.plan.state["compiling"]


def test_where_compiling_is_switched_off_nothing_is_missing() -> None:
    assert kernels.on_disk(lambda: None)


def test_the_slowest_kernels_are_found_on_disk_once_they_are_compiled() -> None:
    compile_once()
    assert all(map(kernels.on_disk, compiling._slowest()))
