"""Experiments on precision: references agree, orders are known ones, failures are named."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from bearingcore import presets
from bearingcore.dynamics.problem import motion_problem
from bearingcore.experiments.integrators import HAS_CVODE
from bearingcore.experiments.measurements import Measurements, this_machine
from bearingcore.experiments.motions import motion_experiment
from bearingcore.experiments.points import Experiment
from bearingcore.experiments.references import motion_reference
from bearingcore.experiments.statics import (
    hard_cases,
    static_problem,
    static_reference,
    statics_experiment,
)
from bearingcore.statics.equilibrium import default_cage_angles
from tests.helpers.timing import measure_once

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]
STORED = np.load(Path(__file__).parents[2] / "reference" / "motion_reference.npz")


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
    found = np.hstack([reference.history[::64, 0], reference.history[::64, 3]])
    expected = STORED["12.9deg/displacement"][: len(found)]
    swing = np.abs(expected - expected.mean(axis=0)).max()
    assert np.abs(found - expected).max() / swing < 1e-8


def check_that_all_is_given(experiment: Experiment) -> None:
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
        found = static_reference(problem)
        assert found.known.all()
        assert found.reference.trusted
        assert found.reference.agreement["stiffness"] < 1e-7


def test_rollers_that_touch_by_rounding_alone_are_left_out() -> None:
    found = static_reference(hard_cases(presets["nu208"])["clearance closed"])
    assert found.reference.trusted
    assert found.known.sum() >= 11, "where a roller carries rounding alone depends on the processor"
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
