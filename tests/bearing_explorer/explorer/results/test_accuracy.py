"""Speed against accuracy on the page: what is drawn is what was measured, one reference a chart."""

import html
import math
import time
from dataclasses import replace

import pytest
from bearing_explorer.explorer.results.accuracy import Found, compute, shipped
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.accuracy import CHARTS, Accuracy
from bearing_explorer.explorer.views.stability_charts import (
    orbit_marks,
    orbits_sentence,
    step_marks,
)
from bearing_explorer.explorer.views.work_precision import (
    BEYOND,
    NOT_YET,
    details,
    sentence,
    verdict,
)
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets
from bearingcore.model.experiments import (
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
    words = details(EXPERIMENT, "spectrum")
    assert "LSODA and DOP853 agree, 2·10⁻⁷ dB apart" in words
    assert "scipy RK45, 8192, failed: diverged &lt;at once&gt;" in words
    assert f"scipy LSODA: {BEYOND}" in words
    said = sentence(EXPERIMENT, "spectrum")
    assert "Fastest within 0.1 dB, and in use: RK4, 32768 (1 ms, 0.01 dB)" in said
    points = (replace(EXPERIMENT.points[0], errors={"spectrum": 0.11}), *EXPERIMENT.points[1:])
    above = sentence(replace(EXPERIMENT, points=points), "spectrum")
    assert "; in use: RK4, 32768 (1 ms, 0.11 dB). It lies above the line because" in above


def test_the_verdict_compares_the_cheapest_of_two_programs_that_are_near_enough() -> None:
    def of(*points: Point, cost: str = "seconds") -> str:
        return verdict(replace(EXPERIMENT, points=points), "spectrum", cost)

    ours, finer, theirs = point("RK4", 1.0, 0.2, 1e-4), point("RK4", 2.0, 0.1, 2e-3), point(
        "scipy RK45", 3.0, 1e-5, 0.268
    )  # fmt: skip
    assert of(ours, finer, theirs) == (
        "Within 0.1 dB, RK4 with fixed steps is 130 times cheaper than scipy RK45"
    )
    few = replace(theirs, evaluations=100)
    assert of(ours, finer, few, cost="evaluations") == (
        "Within 0.1 dB, scipy RK45 is done with 20 times fewer right-hand sides than RK4"
    )
    assert of(ours, finer) == "Only RK4 is within 0.1 dB"
    assert of(ours) == "No method is within 0.1 dB"


@pytest.mark.parametrize("preset", ["fan-rig", "liew-lim"])
def test_the_tab_opens_with_every_chart_drawn(preset: str) -> None:
    view = Accuracy(PackedSource())
    results = Results(presets[preset])
    base = shipped(preset)
    for subject in CHARTS:
        view._chosen.put({"charts": subject})
        view.say(results, view.sentence(results))
        for chart in view._charts[subject].values():
            words = html.unescape(chart._words.object)
            assert chart.plot.visible or base.refused.get(subject, NOT_YET) in words
    known = {(name, case) for name, cases in CHARTS.items() for case in cases}
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


def test_pictures_of_stability_show_each_measured_number_and_a_cross_for_each_failure() -> None:
    measured = shipped("fan-rig")
    marks, stable, now, _ = orbit_marks(measured.orbits, RIG.shaft_speed)
    assert [mark.y for mark in marks] == [orbit.size for orbit in measured.orbits]
    assert [mark.slot == 1 for mark in marks] == [orbit.size > 1.0 for orbit in measured.orbits]
    assert stable == {"top": 1.0}
    assert now[0] == pytest.approx(7.0)
    (lost,) = orbit_marks((OrbitAtSpeed(30.0, "not converged"),), 1.0)[0]
    assert math.isinf(lost.y)
    assert "not converged" in lost.why
    assert measured.stability is not None
    marks, stable, _, _ = step_marks(measured.stability, 32768.0)
    broken = [mark for mark in marks if math.isinf(mark.y)]
    assert len(marks) == len(measured.stability.trials)
    assert broken
    assert all(mark.x < stable["left"] and "diverged" in mark.why for mark in broken)


def test_an_experiment_is_shown_point_by_point_and_read_from_its_file(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    measure_once(monkeypatch)
    job = Work()
    job.started = time.monotonic()
    shown: list[Measurements] = []
    job.show = lambda measured: shown.append(measured.result)  # type: ignore[method-assign]
    assert "points after" in compute(job, RIG, "statics")
    assert [one.count for one in shown[:3]] == [1, 2, 3]
    measured = shown[-1]
    again = measurements_from(charts.as_json(measured))
    assert again.count == measured.count
    ours, theirs = (results.experiments["statics"].points for results in (measured, again))
    for our, other in zip(ours, theirs, strict=True):
        assert other.errors == pytest.approx(our.errors, rel=1e-3)
        assert other.in_use == our.in_use
    view = Accuracy(PackedSource())
    view.job_result = Found(RIG, measured)
    assert f"Measured on this machine: {measured.count} points" in view.sentence(Results(RIG))
    assert set(view.table(Results(RIG))["experiment"]) == {"statics"}


def test_what_cannot_be_measured_is_refused_and_a_cancelled_job_says_so() -> None:
    job = Work()
    job.started = time.monotonic()
    with pytest.raises(ValueError, match="nothing turns"):
        compute(job, RIG.replace(shaft_speed=0.0), "motion")
    with pytest.raises(ValueError, match="no such"):
        Accuracy(PackedSource()).prepare({"experiment": "../etc"}, SceneEditor("fan-rig"))(job)
    job.stop()
    assert compute(job, RIG, "statics") == "Nothing was measured yet."
