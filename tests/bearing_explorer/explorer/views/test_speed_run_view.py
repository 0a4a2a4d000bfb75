"""The speed run on the page: what is drawn in is where it belongs."""

import time
from functools import partial

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import limits_of
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import SWEEPABLE, Sweep, sweep
from bearing_explorer.explorer.views.speed_run import (
    COUNTS,
    SPEED,
    FoundRun,
    SpeedRunSpectra,
    compute,
    levels_of,
)
from bearing_explorer.kit.compute.jobs import JobState, Work
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets
from bearingcore.model.dynamics import speed_run

RIG = presets["fan-rig"].replace(contact_damping=130.0)
SPEEDS = Sweep(SWEEPABLE[SPEED], np.array([20.0, 30.0, 40.0]))


@pytest.fixture(scope="module")
def run() -> FoundRun:
    return FoundRun(speed_run(RIG, SPEEDS.in_si[1], resolution=16.0), SPEEDS)


def test_rows_are_speeds_and_columns_frequencies(run: FoundRun) -> None:
    view = SpeedRunSpectra(PackedSource())
    view.job_result = run
    sources, ranges = view.data(Results(RIG))
    packed = sources["speed_run_cells_y"]["packed"]
    n, m = int(packed[1]), int(packed[0])
    assert n == 3
    drawn = packed[7:].reshape(n, m)
    np.testing.assert_allclose(drawn, levels_of(run.run, "y")[:, :m])
    assert packed[2:6].tolist() == pytest.approx([-8.0, 16.0 * m, 15.0, 30.0])
    assert ranges["speed_run_speed"] == (15.0, 45.0)
    low, high = ranges["speed_run_level_y"]
    loudest = np.nanmax(drawn[:, run.run.frequency[:m] >= 100.0])
    assert low < loudest <= high
    assert sources["speed_run_now"]["speed"] == pytest.approx([7.0])


def test_marched_speeds_are_marked_and_told(run: FoundRun) -> None:
    view = SpeedRunSpectra(PackedSource())
    view.job_result = run
    assert run.run.from_orbit.tolist() == [True, False, True]
    results = Results(RIG)
    assert view.data(results)[0]["speed_run_marched"]["speed"].tolist() == [30.0]
    assert "At 1 of 3 speeds" in view.sentence(results)
    assert view.sentence(Results(RIG.replace(depth=1e-5))).startswith("Faint")
    table = view.table(results)
    assert len({np.size(column) for column in table.values()}) == 1
    assert {"shaft_speed_hz", "frequency_hz", "density_y_m2_per_s4_per_hz"} <= set(table)


def test_a_first_run_that_is_computed_is_not_called_missing() -> None:
    view = SpeedRunSpectra(PackedSource())
    for mood, words in (
        ("waiting", "is being computed"),
        ("busy", "is being computed"),
        ("failed", "no run yet"),
    ):
        view.report(JobState(mood, 0.5, "Its own words."))  # type: ignore[arg-type]
        assert words in view._sentence.text
        assert words in view.sentence(Results(RIG))
        assert "Its own words." in view.job.state.words


def test_a_coarse_run_comes_first_and_bounds_hold() -> None:
    job = Work()
    job.started = time.monotonic()
    shown: list[FoundRun] = []
    job.show = shown.append  # type: ignore[method-assign]
    words = compute(job, RIG, sweep(SPEED, "30", "60", 49, limits_of(RIG)))
    assert [one.speeds.values.size for one in shown] == [25, 49]
    assert words.startswith("49 speeds after")
    view, editor = SpeedRunSpectra(PackedSource()), SceneEditor("fan-rig")
    with pytest.raises(ValueError, match=f"at most {COUNTS[-1]}"):
        view.prepare({"from": "1", "to": "60", "count": "100000"}, editor)
    assert callable(view.prepare(view.form(editor)[0], editor))


def test_a_run_that_would_take_too_many_steps_is_said_not_begun(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    speeds = sweep(SPEED, "30", "60", 49, limits_of(RIG))
    enough = partial(speed_run, most_steps_in_all=4_000_000)
    monkeypatch.setattr("bearing_explorer.explorer.views.speed_run.speed_run", enough)
    words = compute(Work(), RIG, speeds)
    assert "speeds after" in words
    assert "Finer was not begun: speeds must be fewer: they take about" in words
