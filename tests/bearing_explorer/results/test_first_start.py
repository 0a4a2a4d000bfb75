"""A first start: kernels are compiled while the server says so."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest
from bearing_explorer.results.first_start import FirstStart

from bearingcore import warm_up


def test_it_has_words_until_all_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    go_on, over, said = threading.Event(), threading.Event(), list[str]()

    def warm(report: Callable[[str], object]) -> None:
        assert go_on.wait(60.0)
        report("compiled: something")

    monkeypatch.setattr(warm_up, "warm", warm)
    start = FirstStart(said.append, lambda: said.append("loaded"))
    assert start.words() == "", "nothing is compiled yet that would be waited for"
    start.begin(over.set)
    assert "being compiled for this processor" in start.words()
    go_on.set()
    assert over.wait(60.0)
    assert start.words() == ""
    assert said == ["compiled: something", "loaded"]
    assert start.failed is None


def test_what_goes_wrong_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    over = threading.Event()

    def warm(_: object) -> None:
        raise OSError("no compiler")

    monkeypatch.setattr(warm_up, "warm", warm)
    start = FirstStart(print)
    start.begin(over.set)
    assert over.wait(60.0)
    assert str(start.failed) == "no compiler"
    assert not start.at_work
