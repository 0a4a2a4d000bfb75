"""Speed against accuracy on the page: what is drawn is what was measured, one reference a chart."""

from __future__ import annotations

import dataclasses
import html
import math
import time
from unittest.mock import Mock

import pytest
from bearing_explorer.results.accuracy import TRIALS, Found, compute, preset_like, shipped
from bearing_explorer.results.jobs import Work
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.state.sentences import words_of
from bearing_explorer.state.settings import Settings
from bearing_explorer.views.accuracy import CHARTS, Accuracy, orbits_sentence, steps_sentence
from bearing_explorer.views.alternatives import OtherModels, price
from bearing_explorer.views.work_precision import (
    BEYOND,
    COLORS,
    MARKERS,
    NOT_YET,
    PALE,
    WorkPrecision,
    legend,
    look,
    sentence,
)
from bearing_explorer.widgets.status import status_of

from bearingcore import presets
from bearingcore.experiments import (
    Experiment,
    OrbitAtSpeed,
    Point,
    Reference,
    measure,
    measurements_from,
)
from bearingcore.experiments.alternatives import Alternative, Alternatives
from bearingcore.experiments.integrators import METHODS
from bearingcore.experiments.stability import stability_chart

RIG = presets["fan-rig"]


def point(method: str, value: float, error: float, seconds: float, **more: object) -> Point:
    calls = 0 if math.isnan(seconds) else round(1e6 * seconds)
    errors = {} if math.isnan(error) else {"spectrum": error}
    return Point(method, f"{value:g}", value, errors, seconds, 3, calls, **more)  # type: ignore[arg-type]


EXPERIMENT = Experiment(
    "motion",
    "Motion",
    {"spectrum": "[dB]"},
    "right-hand sides",
    {"": Reference(("LSODA", "DOP853"), {"spectrum": 2e-7}, True, 1.0)},
    (
        point("RK4", 32768.0, 1e-2, 1e-3, settings={"step_rate": 32768.0}, in_use=True),
        point("RK4", 65536.0, 1e-4, 2e-3, settings={"step_rate": 65536.0}),
        point("scipy RK45", 65536.0, 1e-1, 2e-2),
        point("scipy RK45", 8192.0, math.nan, math.nan, status="failed: diverged <at once>"),
        point("scipy LSODA", 8192.0, math.inf, 1e-3),
    ),
)


def drawn(
    found: Experiment | None, base: Experiment | None, steps: float | None = None
) -> WorkPrecision:
    chart = WorkPrecision("Steps", {"spectrum": "[dB]"}, lambda: None)
    chart.draw(found, base, "seconds", steps, "")
    return chart


def test_points_are_where_they_were_measured_and_failures_on_the_upper_edge() -> None:
    chart = drawn(EXPERIMENT, None)
    points = chart._points.data
    assert points["cost"][:3] == [1e-3, 2e-3, 2e-2]
    assert points["error"][:3] == [1e-2, 1e-4, 1e-1]
    assert points["marker"][3:] == ["x", "x"]
    assert points["status"][3] == "failed: diverged <at once>"
    assert all(1e-1 < error < chart.plot.y_range.end for error in points["error"][3:])
    assert chart._best.data == {"cost": [1e-3, 2e-3], "error": [1e-2, 1e-4]}
    assert chart._used.data == {"cost": [1e-3], "error": [1e-2]}
    assert chart._allowed.location == 0.1


def test_shipped_points_are_pale_where_there_are_others() -> None:
    both = drawn(dataclasses.replace(EXPERIMENT, points=EXPERIMENT.points[:1]), EXPERIMENT)
    assert sorted(both._points.data["alpha"]) == [*[PALE] * 5, 1.0]
    assert set(drawn(None, EXPERIMENT)._points.data["alpha"]) == {1.0}


def test_chosen_steps_are_the_ones_in_use() -> None:
    assert drawn(EXPERIMENT, None, 65536.0)._used.data["error"] == [1e-4]


def test_a_point_without_the_chosen_error_is_not_drawn() -> None:
    other = Point("quasi-static", "", 1.0, {"level": 1.0}, 1.0, 1, 1)
    chart = drawn(dataclasses.replace(EXPERIMENT, points=(EXPERIMENT.points[0], other)), None)
    assert chart._points.data["method"] == ["RK4"]


def test_words_name_the_reference_and_what_failed() -> None:
    words = sentence(EXPERIMENT, "spectrum")
    assert "LSODA and DOP853 agree, 2·10⁻⁷ dB apart" in words
    assert "Fastest within 0.1 dB: RK4, 32768 (1 ms, 0.01 dB)" in words
    assert "scipy RK45, 8192, failed: diverged" in words
    assert f"scipy LSODA: {BEYOND}" in words
    assert "<b>" not in legend(["<b>"])


def test_methods_never_look_alike() -> None:
    assert len({look(slot) for slot in range(len(METHODS))}) == len(METHODS)
    assert len(set(COLORS)) == len(COLORS)
    assert {look(slot)[1] for slot in range(len(METHODS))} <= set(MARKERS)


@pytest.mark.parametrize("preset", ["fan-rig", "liew-lim"])
def test_the_tab_opens_with_every_chart_drawn(preset: str) -> None:
    view = Accuracy(PackedSource())
    results = Results(presets[preset])
    view.say(results, view.sentence(results))
    base = shipped(preset)
    for one, chart in view._charts:
        words = html.unescape(chart._words.object)
        assert chart.plot.visible or base.refused.get(one.experiment, NOT_YET) in words
    known = {(one.experiment, one.reference) for charts in CHARTS.values() for one in charts}
    for name, experiment in base.experiments.items():
        assert {(name, case) for case in experiment.references} <= known
    assert view._stability._steps.visible
    assert view._stability._speeds.visible
    assert base.machine.processor in view._foot.object
    assert len(view.table(results)["method"]) == base.count - len(base.orbits) - len(
        base.stability.trials if base.stability else ()
    )


def test_of_another_scene_it_says_whose_numbers_these_are() -> None:
    view = Accuracy(PackedSource())
    other = RIG.replace(extent=0.3)
    assert preset_like(other) == "fan-rig"
    assert "Nothing is shipped for this scene" in view.sentence(Results(other))
    assert "Nothing is shipped" not in view.sentence(Results(RIG))
    unlike = Results(RIG.replace(n_balls=11))
    words = view.sentence(unlike)
    assert "those of Fan rig, deep groove bearing as it comes" in words
    view.say(unlike, words)
    assert all(chart.plot.visible for _, chart in view._charts), "it opens with a finished chart"
    assert "Balls are massless" in view.sentence(Results(RIG.replace(balls="with mass")))


def test_what_a_scene_cannot_have_is_said_in_the_words_of_the_page() -> None:
    view = Accuracy(PackedSource())
    still = RIG.replace(shaft_speed=0.0)
    found = measure(still, ["motion", "balls"], words=words_of)
    view.found = Found(still, found)
    view.say(Results(still), "")
    for one, chart in view._charts:
        reason = "Not for this scene: the shaft speed is 0 Hz, so nothing turns"
        assert (reason in chart._words.object) == (one.experiment in ("motion", "balls"))
    rollers = measure(presets["30206-back-to-back"], ["balls"])
    assert rollers.refused["balls"].startswith("there is no model with the mass of tapered rollers")


def test_steps_by_hand_are_those_of_the_motion_and_are_said() -> None:
    ours = Results(RIG, settings=Settings(duration=0.05))
    by_hand = Results(RIG, settings=Settings(duration=0.05, step_rate=131072.0))
    assert by_hand.motion.step_rate == 131072.0
    assert ours.motion.step_rate != 131072.0
    assert by_hand.spectra["y"].density.max() != ours.spectra["y"].density.max()
    assert "steps set by hand: 131072 Hz" in status_of(by_hand, 0.0)["details"]
    assert not any("by hand" in detail for detail in status_of(ours, 0.0)["details"])


def test_more_steps_than_the_server_holds_are_refused() -> None:
    with pytest.raises(ValueError, match="set by hand"):
        _ = Results(RIG, settings=Settings(step_rate=65536.0 * 128)).motion


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
    view = Accuracy(PackedSource())
    base = shipped("fan-rig")
    assert base is not None
    view._stability.draw(dataclasses.replace(base, orbits=orbits), None, 10.0)
    assert view._stability._multipliers["period doubling"].data == {"x": [-1.2], "y": [0.0]}


@pytest.mark.proof
def test_the_stability_chart_holds_every_trial() -> None:
    chart = stability_chart(RIG, duration=0.03)
    view = Accuracy(PackedSource())
    view._stability._draw_steps(chart)
    sizes = {name: len(source.data["x"]) for name, source in view._stability._verdicts.items()}
    assert sum(sizes.values()) == len(chart.trials)
    assert sizes["diverged"] > 0
    assert "diverges" in steps_sentence(chart)


def test_an_experiment_is_shown_point_by_point_and_read_from_its_file() -> None:
    job = Work()
    job.started = time.monotonic()
    shares: list[int] = []
    job.show = lambda found: shares.append(found.result.count)  # type: ignore[method-assign]
    assert "points after" in compute(job, RIG, "angles")
    assert shares[:3] == [1, 2, 3]
    found = measure(RIG, ["angles", "orbits"])
    again = measurements_from(found.as_json())
    assert again.count == found.count
    assert again.experiments["angles"].references == again.experiments["angles"].references
    for one, other in zip(
        found.experiments["angles"].points, again.experiments["angles"].points, strict=True
    ):
        assert other.errors == pytest.approx(one.errors, rel=1e-3)
        assert other.in_use == one.in_use
    view = Accuracy(PackedSource())
    view.found = Found(RIG, found)
    assert "Pale: shipped" in view.sentence(Results(RIG))
    view.say(Results(RIG), "")
    angles = next(chart for one, chart in view._charts if one.experiment == "angles")
    assert PALE in angles._points.data["alpha"]
    other = RIG.replace(extent=0.3)
    view.found = Found(other, found)
    view.say(Results(other), "")
    assert PALE not in angles._points.data["alpha"], "those are of another scene"
    assert set(view.table(Results(RIG))["experiment"]) == {"angles"}


def test_a_scene_that_cannot_move_says_why() -> None:
    job = Work()
    job.started = time.monotonic()
    with pytest.raises(ValueError, match="nothing turns"):
        compute(job, RIG.replace(shaft_speed=0.0), "motion")


def test_a_cancelled_job_keeps_nothing_where_nothing_was_measured() -> None:
    job = Work()
    job.started = time.monotonic()
    job.stop()
    assert compute(job, RIG, "angles") == "Nothing was measured yet."


def test_unknown_experiments_are_refused() -> None:
    view, editor = Accuracy(PackedSource()), SceneEditor("fan-rig")
    with pytest.raises(ValueError, match="no such"):
        view.prepare({"experiment": "../etc"}, editor)
    for name in TRIALS:
        assert callable(view.prepare({"experiment": name}, editor))


def test_a_model_that_would_do_is_taken_with_one_button() -> None:
    view = OtherModels(PackedSource())
    asked: list[object] = []
    taken: list[float | None] = []
    view.parts = Mock(ask=asked.append, take_steps=taken.append)
    rows = (
        Alternative("directions x y", "spectrum", 0.01, 0.01, 0.05, changes={"dofs": ("x", "y")}),
        Alternative("half as many steps", "spectrum", 2.0, 0.02, 0.05, changes={"step_rate": 8e3}),
        Alternative("periodic orbit", "spectrum", 0.02, 0.09, 0.05),
    )
    view.found = Alternatives(RIG, rows, 1000, 2.0)
    view.say(Results(RIG), words := view.sentence(Results(RIG)))
    assert "Within 0.1 dB or 1 % of the swing: directions x y and periodic orbit" in words
    assert "Directions x y saves most, 40 ms a picture; choosing took 2 s" in words
    assert "pays after 50 pictures" in words
    assert "costs 40 ms more" in view._table.object
    assert list(view._models.widgets["model"].options) == [row.name for row in rows[:2]]
    for row in rows:
        view._use(row.name)
    assert asked == [{"choose": {"dofs": "x y"}}]
    view.say(chosen := Results(RIG, settings=Settings(step_rate=8e3)), view.sentence(chosen))
    assert view._sentence.text.startswith("Chosen steps of the motion: 8000 Hz")
    assert "the program's own steps" in view._models.widgets["model"].options
    view._use("the program's own steps")
    assert taken == [8e3, None]
    assert "saves nothing" in price(Alternatives(RIG, rows[2:], 1000, 2.0))
