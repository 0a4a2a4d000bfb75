"""Steps are counted before they are taken: nothing answers after a minute what nobody can wait for.

A light ring on a support of 2.6e13 N/m swings at 19 MHz: a ball pass takes 700,000 steps.
"""

import math

import numpy as np
import pytest

from bearingcore import FieldError, equilibrium, modes, presets, simulate, stiffness_maps
from bearingcore.common import thousands
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import MotionStatus, OrbitStatus, orbit, speed_run
from bearingcore.model.statics import ball_positions
from bearingcore.recordings import Recording
from bearingcore.sizing import size_defect

STIFF = presets["liew-lim"].replace(
    inner_mass=1.8e-3,
    outer_mass=1.8e-3,
    stiffness_x=2.6e13,
    stiffness_y=2.6e13,
    stiffness_z=2.6e13,
    shaft_speed=2.0 * math.pi * 81.0,
)
LESS_STIFF = STIFF.replace(stiffness_x=1e12, stiffness_y=1e12, stiffness_z=1e12)


def begun(*_: object) -> None:
    raise AssertionError("it was begun")


@pytest.fixture
def _no_marching(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kernel that is begun has failed: that it would end after minutes is no answer."""
    for name in ("march", "march_balls", "static_maps", "ball_positions"):
        monkeypatch.setattr(kernels, name, begun)


@pytest.mark.usefixtures("_no_marching")
def test_orbits_and_motions_of_too_many_steps_are_not_begun_and_say_what_it_would_cost() -> None:
    cycle = orbit(STIFF)
    assert cycle.status == OrbitStatus.TOO_MANY_STEPS
    assert cycle.cost.startswith(f"{thousands(725688)} steps a period")
    assert f"most_steps = {thousands(1e6)}" in cycle.cost
    assert not cycle.stable
    assert math.isnan(cycle.largest_multiplier)
    assert cycle.right_hand_side_calls == 0

    motion = simulate(STIFF, 0.02, 4e7)
    assert not motion.completed
    assert motion.reason.startswith(f"too many steps: {thousands(6399992)} of 3.12 ns each")
    assert motion.right_hand_side_calls == 0
    assert motion.outer_acceleration.shape == (len(motion.time), 5)
    assert np.isnan(motion.outer_acceleration).all()
    assert np.isnan(motion.ball_loads(0, 10)).all()


@pytest.mark.usefixtures("_no_marching")
def test_speeds_of_too_many_steps_are_refused() -> None:
    with pytest.raises(ValueError, match="too many steps"):
        speed_run(LESS_STIFF, [500.0, 520.0], sample_rate=1e7, duration=0.1, most_steps=100_000)


@pytest.mark.usefixtures("_no_marching")
def test_a_run_of_too_many_steps_in_all_is_not_begun_and_says_what_it_would_cost() -> None:
    rig = presets["fan-rig"]
    speeds = np.linspace(200.0, 400.0, 1000)
    with pytest.raises(FieldError, match="fewer: they take about") as refused:
        speed_run(rig, speeds, resolution=1.0, duration=60.0, most_steps=10**8)
    assert f"the limit is most_steps_in_all = {thousands(1e9)}" in str(refused.value)
    with pytest.raises(FieldError, match="most_steps_in_all"):
        speed_run(rig, speeds, most_steps_in_all=0)


def test_the_bound_is_an_argument() -> None:
    rig = presets["fan-rig"]
    steps = orbit(rig).right_hand_side_calls // 4
    assert orbit(rig, most_steps=steps).stable
    short = orbit(rig, most_steps=steps - 1)
    assert short.status == OrbitStatus.TOO_MANY_STEPS
    assert f"the limit is most_steps = {steps - 1}" in short.cost
    assert short.right_hand_side_calls // 4 < steps
    assert simulate(rig, 0.01, most_steps=10).status is MotionStatus.TOO_MANY_STEPS
    assert simulate(rig, 0.01, most_steps=1000).completed
    for refused in (0, -3, 2.5):
        with pytest.raises(ValueError, match="most_steps"):
            simulate(rig, 0.01, most_steps=refused)  # type: ignore[arg-type]


@pytest.mark.usefixtures("_no_marching")
def test_too_many_contacts_are_not_begun_and_say_what_they_would_cost() -> None:
    rig = presets["fan-rig"]
    many = np.zeros(10_000_000)
    words = (
        f"too many contacts: {thousands(1.4e8)}, in one call at most {thousands(2e7)} are solved"
    )
    state = equilibrium(rig, many)
    assert state.cost == state.reason(9_999_999) == words
    assert not state.converged.any()
    assert np.isnan(state.stiffness[7]).all()
    assert state.stiffness.base is not None, "and take no memory"
    vibration = modes(rig, many)
    assert vibration.reason(7) == words
    assert set(vibration.label) == {"x1", "x2", "y1", "y2"}
    assert np.isnan(vibration.bands()["x1"]).all()
    places = ball_positions(rig.replace(balls="with mass"), many)
    assert places.reason(0) == places.cost == words
    assert np.isnan(places.load[1, 5]).all()
    with pytest.raises(FieldError, match="10000000; allowed: at most 1428571"):
        stiffness_maps(rig, np.linspace(0.0, 1.0, 5000), np.linspace(0.0, 0.4, 2000))


# Sizes


@pytest.mark.usefixtures("_no_marching")
def test_a_length_is_not_simulated_in_too_many_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bearingcore.sizing._size_defect.MOST_STEPS", 1000)
    noise = np.random.default_rng(1).standard_normal((20_480, 2))
    sizing = size_defect(Recording(noise, 20_480.0), presets["fan-rig"], support_known=True)
    assert sizing.status == "not simulated"
    assert not sizing.candidates
