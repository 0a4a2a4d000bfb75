"""What plans need is compiled elsewhere, once, and nobody waits for it."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest
from bearing_explorer.compute import compiling
from bearing_explorer.session import Inputs, _planned

from bearingcore import kernels, orbit, presets
from bearingcore.plan import SETTLED


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
    monkeypatch.setattr(compiling, "_on_disk", lambda kernel: True)
    compiling.begin()
    assert fresh == []
    assert compiling.ready()
    monkeypatch.setattr(compiling, "_begun", False)
    monkeypatch.setattr(compiling, "_on_disk", lambda kernel: False)
    compiling.begin()
    compiling.begin()
    assert len(fresh) == 1
    assert "compile_all" in fresh[0][-1]


def test_motions_are_not_planned_until_it_is_done(
    fresh: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    inputs = Inputs(presets["fan-rig"], 0.0, 1, rested=True, planned=("load", SETTLED))
    monkeypatch.setattr(compiling, "_on_disk", lambda kernel: False)
    compiling.begin()
    assert not compiling.ready()
    assert _planned(inputs, lambda: False) == ("load",)
    compiling._helper.returncode = 0
    assert compiling.ready()
    assert _planned(inputs, lambda: False) == ("load", SETTLED)
    assert _planned(inputs, lambda: True) == (), "overtaken"


def test_machine_code_older_than_its_source_does_not_count(tmp_path: Path) -> None:
    kernel = SimpleNamespace(
        __name__="march_somehow",
        stats=SimpleNamespace(cache_path=str(tmp_path), cache_hits=Counter()),
    )
    assert not compiling._on_disk(kernel)
    index = tmp_path / "kernels.march_somehow-12.py311.nbi"
    index.write_bytes(b"")
    assert compiling._on_disk(kernel)
    before = Path(kernels.__file__).stat().st_mtime - 10.0
    os.utime(index, (before, before))
    assert not compiling._on_disk(kernel)
    assert compiling._on_disk(lambda: None), "where compiling is switched off"


def test_the_slowest_kernels_are_found_on_disk_once_they_are_compiled() -> None:
    orbit(presets["fan-rig"])
    assert compiling._on_disk(kernels.march_flat_with_tangent)
