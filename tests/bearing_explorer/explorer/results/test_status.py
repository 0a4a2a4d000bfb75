"""The line under the page: how the newest answer went."""

import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.results.verdict import rows_of
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.kit.widgets.limits import judged

import bearingcore
from bearingcore import presets, simulate


def test_the_status_line_says_what_happened() -> None:
    good = Results(presets["fan-rig"]).status(0.0123)
    assert (good["mood"], good["words"]) == ("good", "Computed without problems")
    assert good["details"][1:] == [
        "2 degrees of freedom: x y",
        "361 cage angles",
        "12.3 ms of computing",
    ]
    assert "residual at most" in good["details"][0]
    bad = Results(presets["fan-rig"].replace(fy=0.0)).status(0.001)
    assert bad["mood"] == "bad"
    assert "nothing touches" in bad["words"]
    kept, crossed = (
        rows_of(Results(presets["fan-rig"].replace(fy=fy)).limits) for fy in (-100.0, -2e4)
    )
    assert judged(good, kept) == good
    warned = judged(good, crossed)
    assert (warned["mood"], warned["words"]) == ("warn", "Computed, limits exceeded")
    assert judged(bad, crossed) == bad


def test_a_motion_that_breaks_off_is_not_converged(monkeypatch: pytest.MonkeyPatch) -> None:
    broken = simulate(presets["fan-rig"], 0.2, step_rate=1024.0)
    monkeypatch.setattr(bearingcore, "simulate", lambda *_, **__: broken)
    results = Results(presets["fan-rig"], settings=Settings(duration=0.2))
    line = results.status(0.0, frozenset({"motion"}))
    assert line["mood"] == "bad"
    assert "diverged after" in line["words"]
