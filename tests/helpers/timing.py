"""Times that experiments measure: taken once where a test does not look at them."""

import pytest

from bearingcore.model.experiments._points import least_time


def measure_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `least_time` do its work once, however short it is."""
    monkeypatch.setitem(least_time.__kwdefaults__, "budget", 0.0)
