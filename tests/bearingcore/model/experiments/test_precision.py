"""Experiments on precision: references agree, orders are known ones, failures are named."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from bearingcore import presets
from bearingcore.common._progress import CancelledError
from bearingcore.model.dynamics._problem import motion_problem
from bearingcore.model.experiments import DIVERGED, Experiment, Measurements, measure
from bearingcore.model.experiments._integrators import HAS_CVODE
from bearingcore.model.experiments._measurements import this_machine
from bearingcore.model.experiments._motions import motion_experiment
from bearingcore.model.experiments._points import Watch
from bearingcore.model.experiments._references import motion_reference
from bearingcore.model.experiments._stability import linear_limits, stability_chart
from bearingcore.model.experiments._statics import (
    hard_cases,
    static_problem,
    static_reference,
    statics_experiment,
)
from bearingcore.model.statics import default_cage_angles
from tests.helpers.timing import measure_once

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]
STORED = np.load(Path(__file__).parents[3] / "reference" / "motion_reference.npz")


@pytest.fixture(autouse=True)
def timed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Work is not repeated for the sake of its time."""
    measure_once(monkeypatch)


@pytest.mark.proof
def test_the_reference_meets_the_one_that_was_stored() -> None:
    """Computed by other code, stopping at every event, with other integrators."""
    scene = FAN_RIG.replace(contact_damping=122.0)
    reference = motion_reference(motion_problem(scene), 0.1, 65536.0, 2200.0)
    assert reference.reference.trusted
    assert reference.reference.agreement["displacement"] < 1e-8
    assert reference.reference.agreement["spectrum"] < 1e-5
    history = np.hstack([reference.history[::64, 0], reference.history[::64, 3]])
    expected = STORED["12.9deg/displacement"][: len(history)]
    swing = np.abs(expected - expected.mean(axis=0)).max()
    assert np.abs(history - expected).max() / swing < 1e-8


@pytest.mark.proof
def test_methods_break_where_linear_theory_says() -> None:
    chart = stability_chart(FAN_RIG, duration=0.05)
    assert chart.completed
    assert {trial.method for trial in chart.trials} == set(linear_limits(FAN_RIG))
    for name in ("RK4", "RK4 in velocities"):
        limit = chart.linear_limit[name]
        assert limit / 1.5 < chart.stability_limit(name) < 1.5 * limit
        coarsest = min((t for t in chart.trials if t.method == name), key=lambda t: t.step_rate)
        assert coarsest.verdict == DIVERGED
    finest = [t for t in chart.trials if t.step_rate == max(t.step_rate for t in chart.trials)]
    assert all(trial.verdict == "stable" for trial in finest)
    table = chart.table()
    assert table["verdict"].tolist() == [trial.verdict for trial in chart.trials]
    assert table.unit("linear_limit") == table.unit("step_rate") == "Hz"


def check_that_all_is_given(experiment: Experiment) -> None:
    assert experiment.completed
    assert all(reference.trusted for reference in experiment.references.values())
    for point in experiment.points:
        assert point.seconds > 0.0
        assert point.failed == point.status.startswith("failed: ")
        if not point.failed:
            assert set(point.errors) <= set(experiment.errors)
            assert point.errors
    table = Measurements(this_machine(), {experiment.name: experiment}).table()
    assert table["method"].tolist() == [point.method for point in experiment.points]
    assert {table.unit(name) for name in table if name.endswith("_error")} <= {"dB", "1"}


def test_statics() -> None:
    experiment = statics_experiment(LIEW_LIM, n_angles=7)
    check_that_all_is_given(experiment)
    scene = experiment.per_reference()[""]
    (compiled,) = scene.of("compiled energy Newton")
    assert compiled.in_use
    assert compiled.errors["stiffness"] < 1e-8
    for name in ("scipy hybr", "scipy lm"):
        errors = [p.errors["stiffness"] for p in scene.of(name)]
        assert errors[-1] < 1e-6 * errors[0]
        assert all(point.evaluations > compiled.evaluations for point in scene.of(name))
    touching = experiment.per_reference()["all balls just touching"]
    assert not any(p.failed for p in touching.points if p.method.startswith("compiled"))
    assert any(p.failed for p in touching.points)


@pytest.mark.parametrize("preset", ["30206-back-to-back", "1208"])
def test_statics_have_trusted_references(preset: str) -> None:
    """Rollers, whose lines of centres are long, and a balance that MINPACK takes for solved."""
    scene = presets[preset]
    for problem in (static_problem(scene, default_cage_angles(scene, 7)),
                    hard_cases(scene)["all balls just touching"]):  # fmt: skip
        reference = static_reference(problem)
        assert reference.known.all()
        assert reference.reference.trusted
        assert reference.reference.agreement["stiffness"] < 1e-7


def test_rollers_that_touch_by_rounding_alone_are_left_out() -> None:
    truth = static_reference(hard_cases(presets["nu208"])["clearance closed"])
    assert truth.reference.trusted
    assert truth.known.sum() >= 11, "where a roller carries rounding alone depends on the processor"
    touching = static_reference(hard_cases(presets["nu208"])["all balls just touching"])
    assert touching.reference.trusted
    assert touching.known.all()


@pytest.mark.proof
def test_motion() -> None:
    cvode = ("CVODE Adams", "CVODE BDF") if HAS_CVODE else ()
    names = ("RK4", "RK4 in velocities", "scipy RK45", "scipy LSODA", *cvode)
    experiment = motion_experiment(FAN_RIG, duration=0.05, methods=names)
    check_that_all_is_given(experiment)
    assert experiment.methods == names
    for name in names:
        errors = [point.errors["displacement"] for point in experiment.of(name)]
        assert errors[-1] < 0.1 * errors[0]
    frontier = experiment.frontier()
    assert all(a.seconds < b.seconds for a, b in itertools.pairwise(frontier))
    assert all(a.errors["spectrum"] > b.errors["spectrum"] for a, b in itertools.pairwise(frontier))
    assert "RK4" in {point.method for point in frontier}
    assert [p.method for p in experiment.points if p.in_use] == ["RK4"]
    assert experiment.order("RK4", "series L2") > 2.0
    assert len(experiment.references[""].families) == 2 + bool(cvode)


def test_an_experiment_reports_its_progress_and_can_be_cancelled() -> None:
    shares: list[float] = []
    shown: list[Experiment] = []

    def progress(part: float, doing: str) -> None:
        if len(shares) == 7:  # five of them within the references
            raise CancelledError
        shares.append(part)

    experiment = statics_experiment(FAN_RIG, n_angles=5, watch=Watch(progress, shown.append))
    assert [len(experiment.points) for experiment in shown] == [1, 2]
    assert len(experiment.points) == 2
    assert not experiment.completed
    assert shares == sorted(shares)
    assert 0.0 <= shares[0] <= shares[-1] < 1.0


@pytest.mark.parametrize("calls", [2, 5_000, 40_000])
def test_references_end_as_soon_as_they_are_cancelled(calls: int) -> None:
    """LSODA, DOP853 and CVODE: within one evaluation of the forces."""
    asked = itertools.count()
    results = measure(FAN_RIG, ["motion"], cancelled=lambda: next(asked) > calls)
    assert results.count == 0
    assert next(asked) <= calls + 3
