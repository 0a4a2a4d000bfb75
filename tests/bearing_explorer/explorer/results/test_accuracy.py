"""Speed against accuracy on the page: what is drawn is what was measured, one reference a chart."""

import html
import math
import time

import pytest
from bearing_explorer.explorer.results.accuracy import Found, compute, shipped
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.accuracy import CHARTS, Accuracy, orbits_sentence
from bearing_explorer.explorer.views.work_precision import (
    BEYOND,
    NOT_YET,
    legend,
    sentence,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets
from bearingcore.experiments import (
    Experiment,
    Measurements,
    OrbitAtSpeed,
    Point,
    Reference,
    measurements_from,
)
from tests.benchmarks import charts
from tests.helpers.timing import measure_once

RIG = presets["fan-rig"]


def point(method: str, value: float, error: float, seconds: float, **more: object) -> Point:
    calls = 0 if math.isnan(seconds) else round(1e6 * seconds)
    errors = {} if math.isnan(error) else {"spectrum": error}
    return Point(method, f"{value:g}", value, errors, seconds, calls, **more)  # type: ignore[arg-type]


EXPERIMENT = Experiment(
    "motion",
    {"spectrum": "[dB]"},
    "right-hand sides",
    {"": Reference(("LSODA", "DOP853"), {"spectrum": 2e-7}, True)},
    (
        point("RK4", 32768.0, 1e-2, 1e-3, in_use=True),
        point("RK4", 65536.0, 1e-4, 2e-3),
        point("scipy RK45", 65536.0, 1e-1, 2e-2),
        point("scipy RK45", 8192.0, math.nan, math.nan, status="failed: diverged <at once>"),
        point("scipy LSODA", 8192.0, math.inf, 1e-3),
    ),
)


def test_words_name_the_reference_and_what_failed() -> None:
    words = sentence(EXPERIMENT, "spectrum")
    assert "LSODA and DOP853 agree, 2·10⁻⁷ dB apart" in words
    assert "Fastest within 0.1 dB: RK4, 32768 (1 ms, 0.01 dB)" in words
    assert "scipy RK45, 8192, failed: diverged" in words
    assert f"scipy LSODA: {BEYOND}" in words
    assert "<b>" not in legend(["<b>"])


@pytest.mark.parametrize("preset", ["fan-rig", "liew-lim"])
def test_the_tab_opens_with_every_chart_drawn(preset: str) -> None:
    view = Accuracy(PackedSource())
    results = Results(presets[preset])
    view.say(results, view.sentence(results))
    base = shipped(preset)
    for one, chart in (pair for pairs in view._charts.values() for pair in pairs):
        words = html.unescape(chart._words.object)
        assert chart.plot.visible or base.refused.get(one.experiment, NOT_YET) in words
    known = {(one.experiment, one.reference) for charts in CHARTS.values() for one in charts}
    for name, experiment in base.experiments.items():
        assert {(name, case) for case in experiment.references} <= known
    assert len(view.table(results)["method"]) == base.count - len(base.orbits) - len(
        base.stability.trials if base.stability else ()
    )


def test_losses_of_stability_are_named() -> None:
    orbits = (
        OrbitAtSpeed(10.0, "stable orbit", "", ((0.5, 0.0),)),
        OrbitAtSpeed(20.0, "unstable orbit", "period doubling", ((-1.2, 0.0),)),
        OrbitAtSpeed(30.0, "not converged"),
    )
    words = orbits_sentence(orbits)
    assert "Stable at 1.59 Hz, period doubling from 3.18 Hz" in words
    assert "No orbit was found at 1 of 3 speeds" in words
    assert "not measured" in orbits_sentence(())


def test_an_experiment_is_shown_point_by_point_and_read_from_its_file(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    measure_once(monkeypatch)
    job = Work()
    job.started = time.monotonic()
    shown: list[Measurements] = []
    job.show = lambda found: shown.append(found.result)  # type: ignore[method-assign]
    assert "points after" in compute(job, RIG, "statics")
    assert [one.count for one in shown[:3]] == [1, 2, 3]
    found = shown[-1]
    again = measurements_from(charts.as_json(found))
    assert again.count == found.count
    ours, theirs = (one.experiments["statics"].points for one in (found, again))
    for one, other in zip(ours, theirs, strict=True):
        assert other.errors == pytest.approx(one.errors, rel=1e-3)
        assert other.in_use == one.in_use
    view = Accuracy(PackedSource())
    view.found = Found(RIG, found)
    assert "Pale: shipped" in view.sentence(Results(RIG))
    assert set(view.table(Results(RIG))["experiment"]) == {"statics"}


def test_what_cannot_be_measured_is_refused_and_a_cancelled_job_says_so() -> None:
    job = Work()
    job.started = time.monotonic()
    with pytest.raises(ValueError, match="nothing turns"):
        compute(job, RIG.replace(shaft_speed=0.0), "motion")
    with pytest.raises(ValueError, match="no such"):
        Accuracy(PackedSource()).prepare({"experiment": "../etc"}, SceneEditor("fan-rig"))
    job.stop()
    assert compute(job, RIG, "statics") == "Nothing was measured yet."
