"""Plans keep their word, and nodes stand where curves have corners."""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np
import pytest

from bearingcore import equilibrium, orbit, presets, simulate
from bearingcore.dynamics.orbit import NOT_CONVERGED
from bearingcore.plan import BUDGETS, SETTLED, VIBRATION, VIEWS, plan
from bearingcore.plan.cage_angles import curves_of, place, swings
from bearingcore.plan.motions import arrival_time, dying_time
from bearingcore.plan.pilot import Way
from bearingcore.statics.passes import ball_drop, path_kinks
from tests.benchmarks.plans import held_curves, held_motion, random_scenes

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("edge", ["published", "exact"])
@pytest.mark.parametrize("extent_deg", [1.0, 12.9])
def test_paths_are_smooth_between_kinks_and_bend_at_them(
    race: str, edge: str, extent_deg: float
) -> None:
    scene = FAN_RIG.replace(race=race, edge=edge, extent=math.radians(extent_deg))
    spacing = scene.bearing.ball_spacing
    kinks = path_kinks(scene, 0.0, spacing)
    assert kinks.size
    step = 1e-4
    angle = np.arange(0.0, spacing, step)
    balls = spacing * np.arange(scene.bearing.n_balls)
    drop = ball_drop(scene, angle[:, None] + balls, angle[:, None])
    third = np.abs(np.diff(drop, 3, axis=0)).max(axis=1) / step**3  # of a smooth path: tiny
    near = np.abs(angle[1:-2, None] + 0.5 * step - kinks).min(axis=1) <= 2.0 * step
    smooth, kinked = third[~near], third[near]
    assert smooth.max() < 2.0
    assert kinked.max() > 50.0
    for kink in kinks:
        at = np.abs(angle[1:-2] + 0.5 * step - kink) <= 2.0 * step
        if at.any():
            assert third[at].max() > 5.0 * smooth.max()


def test_nodes_stand_where_balls_touch() -> None:
    nodes = place(FAN_RIG, "stiffness", 1e-2)
    assert nodes.touches.size
    for touch in nodes.touches:
        before, after = equilibrium(FAN_RIG, [touch - 1e-6, touch + 1e-6]).ball_load > 0.0
        assert np.any(before != after)
    dense = equilibrium(FAN_RIG, np.linspace(0.0, FAN_RIG.bearing.ball_spacing, 5001))
    changes = np.diff(dense.ball_load > 0.0, axis=0).any(axis=1)
    assert nodes.touches.size >= int(changes.sum()) > 0


@pytest.mark.filterwarnings("error")
def test_a_kink_at_the_end_of_the_ball_spacing_makes_no_interval_without_length() -> None:
    """A ball meets an edge there, but for rounding, and between such nodes there is no slope."""
    scene = LIEW_LIM.replace(extent=0.06400044829220426, depth=39.67938498703571e-6)
    for curves in ("load", "stiffness", "modes"):
        assert np.diff(place(scene, curves, 5e-3).angles).min() > 1e-12


@pytest.mark.parametrize(("seed", "view", "k"), [(1, "modes", 129), (3, "stiffness", 67)])
def test_stiffness_jumps_where_groove_centres_pass_under_load(seed: int, view: str, k: int) -> None:
    """Too little for a test point beside the jump to notice, and more than the budget."""
    (scene,) = itertools.islice(random_scenes(k + 1, seed), k, None)
    held = held_curves(scene, view)
    assert held.error < 0.5 * held.plan.error_budget
    placed = place(scene, view, held.plan.error_budget)
    assert placed.jumps.size
    swing = swings(curves_of(equilibrium(scene, placed.angles), view))
    around = np.sort(np.concatenate([placed.jumps - 1e-9, placed.jumps + 1e-9]))
    jump = np.abs(np.diff(curves_of(equilibrium(scene, around), view), axis=0)[::2])
    assert (jump / swing).max() > 0.5 * held.plan.error_budget


def test_a_tighter_budget_takes_more_nodes() -> None:
    sizes = [place(LIEW_LIM, "stiffness", budget).angles.size for budget in (0.1, 1e-2, 1e-3)]
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[-1]


def test_placed_angles_are_ten_times_better_than_as_many_equal_ones() -> None:
    made = plan(LIEW_LIM, "stiffness", 1e-2)
    assert made.cage_angles is not None
    assert made.cage_angles.size < 600
    assert made.full_error > 10.0 * made.predicted_error


@pytest.mark.parametrize("view", ["load", "stiffness", "modes"])
def test_curves_of_200_scenes_stay_within_the_budget(view: str) -> None:
    """67 scenes a view; all 200 a view: python -m tests.benchmarks.plans."""
    offset = ("load", "stiffness", "modes").index(view)
    held = [held_curves(s, view) for k, s in enumerate(random_scenes(200)) if k % 3 == offset]
    broken = [h for h in held if not h.kept]
    assert not broken, [f"{h.error:.2e}: {h.plan.sentence()}" for h in broken]
    assert sum(h.plan.met for h in held) >= 0.95 * len(held)


@pytest.mark.proof
@pytest.mark.parametrize("view", [VIBRATION, SETTLED])
def test_motions_stay_within_the_budget(view: str) -> None:
    """A few of those of `python -m tests.benchmarks.plans`, which says what is saved."""
    for scene in (FAN_RIG, FAN_RIG.replace(contact_law="no tension"), LIEW_LIM):
        held = held_motion(scene, view)
        assert held.trusted
        assert held.plan.met
        assert held.error <= held.plan.error_budget, held.plan.sentence()


def test_an_unstable_orbit_is_not_taken() -> None:
    """At 30 Hz the orbit is there and nobody settles to it."""
    fast = FAN_RIG.replace(shaft_speed=2.0 * math.pi * 30.0, contact_damping=130.0)
    made = plan(fast, SETTLED)
    assert made.orbit is None
    assert "unstable orbit, through -1" in made.note
    assert made.method == "fixed steps"
    slow = plan(FAN_RIG, SETTLED)
    assert slow.method == "orbit"
    assert slow.orbit is not None
    assert slow.orbit.stable
    assert slow.evaluations < 0.5 * slow.full_evaluations


def test_where_nothing_settles_errors_are_looked_for_as_long_as_the_motion_goes_on() -> None:
    """A motion of this scene doubles its period, and forgets in two seconds how it began."""
    (scene,) = itertools.islice(random_scenes(64), 63, None)
    made = plan(scene, SETTLED, duration=0.35)
    assert "unstable orbit, through -1" in made.note
    assert not made.met
    assert made.predicted_error > 1.0


def test_a_plan_waits_until_the_motion_from_rest_has_come_to_its_orbit() -> None:
    """Seen in a scene that takes more than a second, though disturbances die in 0.4 s."""
    (scene,) = itertools.islice(random_scenes(102), 101, None)
    made = plan(scene, SETTLED)
    assert made.orbit is not None
    dying = dying_time(made.orbit)
    assert made.drop > 2.5 * dying
    motion = simulate(scene, made.drop + 0.1, 65536.0)
    away = motion.outer_acceleration - made.orbit.outer_acceleration(motion.time)
    size = np.abs(made.orbit.outer_acceleration(motion.time)).max(axis=0)
    settled, before = motion.time >= made.drop, np.abs(motion.time - dying) < 0.02
    assert np.all(np.abs(away[settled]).max(axis=0) < 0.01 * size)
    assert np.all(np.abs(away[before]).max(axis=0) > 0.1 * size)


def test_an_orbit_that_the_motion_never_comes_to_is_known_as_such() -> None:
    found = orbit(FAN_RIG)
    way = Way(65536.0, math.nan, 0.0, 0.0, 0.0, 0.0)
    arrival = arrival_time(found, way, 65536.0)
    assert 0.05 <= arrival <= 2.0 * dying_time(found)
    elsewhere = dataclasses.replace(found, scene=FAN_RIG.replace(fy=-90.0))
    assert math.isnan(arrival_time(elsewhere, way, 65536.0))


def test_the_search_for_an_orbit_ends_where_a_march_is_cheaper() -> None:
    """No scene takes much longer to plan than to march, whatever its orbits are like."""
    asked: list[int] = []
    hard = FAN_RIG.replace(shaft_speed=2.0 * math.pi * 34.0, contact_damping=0.0)
    found = orbit(hard, give_up=lambda: bool(asked.append(1)) or len(asked) == 5)
    assert found.status == NOT_CONVERGED
    assert len(asked) == 5


def test_only_directions_that_move() -> None:
    assert plan(FAN_RIG, "stiffness").dofs == ("x", "y")
    made = plan(LIEW_LIM, "stiffness")
    assert len(made.dofs) == 5
    assert [offer.dofs for offer in made.offers] == [("x", "y"), ("x", "y", "z")]
    assert all(offer.error > made.error_budget for offer in made.offers)


def test_a_plan_can_be_overruled() -> None:
    coarse = plan(FAN_RIG, VIBRATION, step_rate=16384.0)
    assert coarse.step_rate == 16384.0
    assert not coarse.met
    assert coarse.predicted_error > 0.1
    assert "not met" in coarse.sentence()
    assert plan(FAN_RIG, SETTLED, march=True).orbit is None
    assert plan(FAN_RIG, "load", dofs=("x", "y", "z")).dofs == ("x", "y", "z")


@pytest.mark.parametrize("view", VIEWS)
def test_what_was_planned_can_be_run_and_told(view: str) -> None:
    made = plan(FAN_RIG, view)
    assert made.error_budget == BUDGETS[view]
    assert made.met
    assert made.predicted_error <= made.error_budget
    assert made.sentence().startswith("this scene: 2 DOF, ")
    assert "full model" in made.sentence() or "equally spaced" in made.sentence()
    answer = made.run()
    if made.cage_angles is not None:
        np.testing.assert_array_equal(answer.cage_angles, made.cage_angles)  # type: ignore[union-attr]
    else:
        assert answer.scene == made.scene


def test_refusals() -> None:
    with pytest.raises(ValueError, match="view is 'noise'; allowed: load, stiffness"):
        plan(FAN_RIG, "noise")
    with pytest.raises(ValueError, match="error_budget is 0"):
        plan(FAN_RIG, "load", 0.0)


def test_the_sentence_writes_numbers_out() -> None:
    made = plan(presets["fan-rig"], "load")
    long = dataclasses.replace(made, full_seconds=0.104, seconds=1.5e3)
    assert "104 ms" in long.sentence()
    assert "1500 s" in long.sentence()
    assert "e+" not in long.sentence()
