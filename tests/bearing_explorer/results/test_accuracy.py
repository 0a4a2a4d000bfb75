"""Speed against accuracy on the page: what is drawn is what was measured; clicks are judged."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest
from bearing_explorer.results.accuracy import TRIALS, Found, compute
from bearing_explorer.results.jobs import Work
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.state.settings import Settings
from bearing_explorer.views.accuracy import COLORS, MOST_METHODS, NAMES, Accuracy, legend, look
from bearing_explorer.widgets.status import status_of

from bearingcore import presets
from bearingcore.experiments import Experiment, Point, Reference
from bearingcore.experiments.stability import FIXED_STEP, stability_chart

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
        point("RK4", 32768.0, 1e-2, 1e-3, settings={"step_rate": 32768.0}),
        point("RK4", 65536.0, 1e-4, 2e-3, settings={"step_rate": 65536.0}),
        point("scipy RK45", 65536.0, 1e-1, 2e-2),
        point("scipy RK45", 8192.0, math.nan, math.nan, status="failed: diverged <at once>"),
        point("scipy LSODA", 8192.0, math.inf, 1e-3),
    ),
)


def measured() -> Accuracy:
    view = Accuracy(PackedSource())
    view.found = Found(RIG, EXPERIMENT)
    return view


def test_points_stand_where_they_were_measured_and_failures_on_the_edge() -> None:
    view = measured()
    sources, ranges = view.data(Results(RIG))
    assert sources["accuracy_0"]["seconds"].tolist() == [1e-3, 2e-3]
    assert sources["accuracy_0"]["error"].tolist() == [1e-2, 1e-4]
    assert sources["accuracy_1"]["error"].tolist() == [1e-1]
    assert sources["accuracy_2"]["error"].size == 0
    failed = sources["accuracy_failed"]
    assert [NAMES[int(k)] for k in failed["method"]] == ["scipy RK45", "scipy LSODA"]
    assert failed["named"].tolist() == [1.0, 2.0]
    low, high = ranges["accuracy_error"]
    assert low < 1e-4
    assert (failed["error"] > 1e-1).all()
    assert (failed["error"] < high).all()
    assert np.isfinite(failed["seconds"]).all()
    assert set(sources) == set(view.data(Results(RIG.healthy()))[0])


def test_words_and_numbers_name_the_reference_and_what_failed() -> None:
    view = measured()
    words = view.sentence(Results(RIG))
    assert "(LSODA, DOP853) differ by" in words
    assert "2·10⁻⁷ dB" in words
    assert "scipy RK45 failed: diverged" in words
    assert view.sentence(Results(RIG.healthy())).startswith("The scene has changed")
    table = view.table(Results(RIG))
    assert table["spectrum_error_db"][0] == 1e-2
    assert table["status"][3].startswith("failed")
    assert "&lt;at once&gt;" in legend(EXPERIMENT)


def test_methods_never_look_alike() -> None:
    assert len({look(slot) for slot in range(MOST_METHODS)}) == MOST_METHODS
    assert len(set(COLORS)) == len(COLORS)


def test_a_click_takes_the_steps_of_the_point_under_it() -> None:
    view = measured()
    taken: list[float | None] = []
    view.take_steps = taken.append
    view.data(Results(RIG))
    view._tapped("seconds", 2.02e-3, 1.05e-4)
    view._tapped("evaluations", 1000, 1e-2)
    assert taken == [65536.0, 32768.0]
    view._tapped("seconds", 2e-2, 1e-1)  # its steps cannot be taken
    assert "RK4" in view._step_words.text
    for strange in (None, "x", math.nan, -1.0, 0.0, 1e300, True, [1.0]):
        view._tapped("seconds", strange, 1e-2)
    assert taken == [65536.0, 32768.0]


def test_measured_steps_are_chosen_from_the_list() -> None:
    view = measured()
    taken: list[float | None] = []
    view.take_steps = taken.append
    view.say(Results(RIG), "")
    for text in ("65536", ""):
        view._steps.widgets["steps"].value = text
    assert taken == [65536.0, None]


def test_steps_by_hand_are_those_of_the_motion_and_are_said() -> None:
    ours = Results(RIG, settings=Settings(duration=0.05))
    by_hand = Results(RIG, settings=Settings(duration=0.05, step_rate=131072.0))
    assert by_hand.motion.step_rate == 131072.0
    assert ours.motion.step_rate != 131072.0
    assert by_hand.spectra["y"].density.max() != ours.spectra["y"].density.max()
    assert "steps set by hand: 131072 Hz" in status_of(by_hand, 0.0)["details"]
    assert not any("by hand" in detail for detail in status_of(ours, 0.0)["details"])
    view = measured()
    view.say(by_hand, "words")
    assert view._steps.values["steps"] == "131072"
    assert "131072 Hz" in view._step_words.text


def test_more_steps_than_the_server_holds_are_refused() -> None:
    with pytest.raises(ValueError, match="set by hand"):
        _ = Results(RIG, settings=Settings(step_rate=65536.0 * 128)).motion


@pytest.mark.proof
def test_the_stability_chart_holds_every_trial() -> None:
    chart = stability_chart(RIG, duration=0.03)
    view = Accuracy(PackedSource())
    view.found = Found(RIG, chart)
    sources, _ = view.data(Results(RIG))
    sizes = [sources[f"accuracy_verdict_{k}"]["steps"].size for k in range(4)]
    assert sum(sizes) == len(chart.trials)
    assert sizes[3] > 0
    assert sources["accuracy_limits"]["steps"].size == len(FIXED_STEP)  # all are explicit
    assert "diverges" in view.sentence(Results(RIG))
    assert view.table(Results(RIG))["verdict"].size == len(chart.trials)


@pytest.mark.parametrize("name", ["angles", "models"])
def test_experiments_run_as_jobs_and_every_name_is_known(name: str) -> None:
    job = Work()
    job.started = time.monotonic()
    assert "points after" in compute(job, RIG, name)
    (found,) = job.taken()
    view = Accuracy(PackedSource())
    view.found = found
    sources, _ = view.data(Results(RIG))
    drawn = sum(sources[f"accuracy_{k}"]["error"].size for k in range(MOST_METHODS))
    assert drawn + sources["accuracy_failed"]["error"].size == len(found.result.points)


def test_a_cancelled_job_keeps_nothing_where_nothing_was_measured() -> None:
    job = Work()
    job.started = time.monotonic()
    job.stop()
    assert compute(job, RIG, "angles") == "Nothing was measured yet."
    assert job.taken() == []


def test_unknown_experiments_are_refused() -> None:
    view, editor = Accuracy(PackedSource()), SceneEditor("fan-rig")
    with pytest.raises(ValueError, match="no such"):
        view.prepare({"experiment": "../etc"}, editor)
    for name in TRIALS:
        assert callable(view.prepare({"experiment": name}, editor))
