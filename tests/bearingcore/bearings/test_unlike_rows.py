"""Rows with balls and dimensions of their own: by what each row is and carries alone."""

import dataclasses
import itertools
import math
from typing import Any

import numpy as np
import pytest

from bearingcore import (
    Bearing,
    Load,
    Recording,
    Scene,
    contact_pressures,
    diagnose,
    dynamic_load_rating,
    equilibrium,
    film,
    life,
    limits,
    modes,
    orbit,
    presets,
    simulate,
    size_defect,
    stiffness_maps,
)
from bearingcore.bearings import Derived, Row
from bearingcore.measured.diagnosis import part_lines
from bearingcore.model.dynamics import OrbitStatus, common_ball_passes
from bearingcore.model.statics import ball_drop, ball_positions, crossings, drops_now, static_state
from bearingcore.model.statics._film import rolling_speed
from bearingcore.model.statics._life import race_ratings

ONE = presets["7208-25deg"]
STEEP = math.radians(40.0)


def scene_of_rows(*rows: Row) -> Scene:
    return ONE.replace(bearing=ONE.bearing.replace(rows=rows))


UNLIKE = scene_of_rows(Row(-9e-3, -1, turn=0.1), Row(9e-3, 1, contact_angle=STEEP))
OWN = {"n_balls": 11, "ball_diameter": 10e-3, "pitch_diameter": 55e-3}
BALLS = scene_of_rows(Row(-9e-3, -1, turn=0.1), Row(9e-3, 1, contact_angle=STEEP, **OWN))  # type: ignore[arg-type]
SMALL = Bearing.from_drawing(11, 10e-3, 55e-3, 5.2e-3, 5.3e-3, contact_angle=STEEP)
both = pytest.mark.parametrize("scene", [UNLIKE, BALLS], ids=["angles", "balls"])


def test_a_row_of_the_bearings_own_angle_is_as_if_none_were_given() -> None:
    angle = ONE.bearing.contact_angle
    n, ball = ONE.bearing.n_balls, ONE.bearing.ball_diameter
    told = scene_of_rows(
        Row(-9e-3, -1, contact_angle=angle, n_balls=n), Row(9e-3, ball_diameter=ball)
    ).replace(extent=0.2)
    plain = scene_of_rows(Row(-9e-3, -1), Row(9e-3)).replace(extent=0.2)
    assert told.bearing.rows_are_alike
    assert not UNLIKE.bearing.rows_are_alike
    assert told.bearing.of_row(1) is told.bearing
    one, other = equilibrium(told), equilibrium(plain)
    for name in ("displacement", "ball_load", "stiffness"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    assert life(told, 4e4).million_revolutions == life(plain, 4e4).million_revolutions
    fewer = told.replace(n_balls=n - 1).bearing
    assert fewer.of_row(0).n_balls == n, "what is a row's own stays, whatever the bearing's is"


def test_a_row_of_other_balls_is_a_bearing_of_them() -> None:
    bearing = BALLS.bearing
    assert bearing.of_row(1).n_balls == SMALL.n_balls == 11
    for name in (*Derived._fields, "inner_groove_radius", "outer_groove_radius"):
        assert getattr(bearing.of_row(1), name) == pytest.approx(getattr(SMALL, name), rel=1e-12)
    assert bearing.balls_of_rows == (slice(0, 14), slice(14, 25))
    assert [bearing.row_of_ball(ball) for ball in (13, 14)] == [(0, 13), (1, 0)]
    assert bearing.of_row(1).bpfo(10.0) == pytest.approx(SMALL.bpfo(10.0), rel=1e-12)
    assert bearing.pace(1) == pytest.approx(SMALL.cage_ratio / bearing.cage_ratio, rel=1e-12)
    assert bearing.period == 2.0 * math.pi, "its cages never come back together"
    wider = scene_of_rows(Row(), Row(ball_diameter=10e-3, inner_groove_radius=5.4e-3)).bearing
    assert wider.of_row(1).inner_groove_radius == 5.4e-3
    heavier = BALLS.replace(load_deflection_factor=2.0 * bearing.load_deflection_factor).bearing
    assert heavier.of_row(1).load_deflection_factor == pytest.approx(
        2.0 * SMALL.load_deflection_factor, rel=1e-12
    ), "a factor set apart from the drawing keeps its proportion in each row"


@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_rows_with_every_number_of_their_own_are_the_bearing_of_those_numbers(balls: str) -> None:
    """At rest and in motion, although cages and tilts are counted in other units."""
    own: dict[str, Any] = {
        name: getattr(SMALL, name)
        for name in (*OWN, "contact_angle", "inner_groove_radius", "outer_groove_radius")
    }
    rows = (Row(-9e-3, -1, offset=-3e-6), Row(9e-3, 1, offset=3e-6, turn=0.2))
    plain = ONE.replace(
        bearing=SMALL.replace(rows=rows), balls=balls, contact_damping=120.0,
        extent=0.3, dofs=("x", "y", "z", "rx", "ry"), race="inner", edge="exact",
        load=Load(200.0, -2000.0, 500.0, 8.0, -5.0),
    )  # fmt: skip
    bearing = ONE.bearing.replace(rows=tuple(dataclasses.replace(row, **own) for row in rows))
    told = plain.replace(bearing=bearing)
    pace = bearing.pace(0)
    assert bearing.pace(1) == pace != 1.0
    assert bearing.period * pace == pytest.approx(SMALL.ball_spacing)
    angles = np.array([0.0, 0.1, 2.0])
    one, other = static_state(plain, angles * pace), static_state(told, angles)
    np.testing.assert_allclose(other.ball_load, one.ball_load, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(other.displacement, one.displacement, rtol=1e-8, atol=1e-15)
    scale = np.sqrt(np.einsum("nii,njj->nij", one.stiffness, one.stiffness))
    assert np.abs((other.stiffness - one.stiffness) / scale).max() < 1e-9
    marched = [simulate(scene, 2e-3, 65536.0, step_rate=8 * 65536.0) for scene in (plain, told)]
    assert all(motion.completed for motion in marched)
    a, b = (motion.outer_acceleration for motion in marched)
    assert np.abs(a).max() > 1.0
    np.testing.assert_allclose(b, a, rtol=0.0, atol=1e-6 * np.abs(a).max())
    one_load, other_load = (motion.ball_loads() for motion in marched)
    np.testing.assert_allclose(other_load, one_load, rtol=1e-7, atol=1e-4)


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("edge", ["published", "exact"])
@both
def test_each_rows_balls_run_on_its_own_raceway(scene: Scene, race: str, edge: str) -> None:
    scene = scene.replace(race=race, edge=edge, extent=0.15, depth=150e-6, row=None)
    angles = scene.defects[0].center + np.linspace(-0.1, 0.1, 301)
    for row in range(2):
        alone = ONE.replace(bearing=scene.bearing.of_row(row).replace(rows=()), defect=scene.defect)
        expected = ball_drop(alone, angles)
        assert np.ptp(expected) > 1e-5
        np.testing.assert_allclose(ball_drop(scene, angles, row=row), expected, atol=1e-15)
    if race == "inner":  # the shaft is where the bearing's cage says
        turned = ball_drop(scene, angles + 0.3 / scene.bearing.cage_ratio, 0.3, row=1)
        np.testing.assert_allclose(turned, ball_drop(scene, angles, row=1), atol=1e-12)


@both
@pytest.mark.parametrize("race", ["outer", "inner"])
def test_balls_enter_and_leave_when_their_own_cage_says(scene: Scene, race: str) -> None:
    scene = scene.replace(race=race, edge="exact", extent=0.2, row=None)
    events = crossings(scene, 0.0, 1.5)
    rows = {scene.bearing.row_of_ball(event.ball)[0] for event in events}
    assert rows == {0, 1}
    for one in events:
        before, after = (drops_now(scene, one.cage_angle + d)[one.ball] for d in (-1e-4, 1e-4))
        assert (after > 0.0) == one.enters
        assert (before > 0.0) != one.enters


def test_depths_are_judged_by_the_balls_that_meet_them() -> None:
    deep = 5.5e-3
    assert BALLS.replace(depth=deep, row=0).defects[0].depth == deep
    for row in (None, 1):
        with pytest.raises(ValueError, match=r"at most the ball radius of 0\.005 m"):
            BALLS.replace(depth=deep, row=row)


@both
def test_maps_modes_and_balls_positions_follow(scene: Scene) -> None:
    scene = scene.replace(extent=0.12, row=None)
    angles = [0.0, 0.1]
    state = equilibrium(scene, angles)
    maps = stiffness_maps(scene, [0.0, 0.12], angles)
    np.testing.assert_allclose(maps.term("k_yy")[1], state.term("k_yy"), rtol=1e-9)
    massless = ball_positions(scene, angles, centrifugal_load=0.0)
    np.testing.assert_allclose(massless.load[0], state.ball_load, rtol=1e-6, atol=1e-6)
    fast = static_state(scene.replace(balls="with mass", shaft_speed=2000.0), angles)
    slack = fast.positions.load[0] == 0.0  # type: ignore[attr-defined]
    for row, own in enumerate(scene.bearing.balls_of_rows):
        F_c = scene.bearing.of_row(row).centrifugal_load(2000.0)
        assert fast.ball_load[:, own][slack[:, own]] == pytest.approx(F_c, rel=1e-6)
    assert np.isfinite(modes(scene, angles).frequency).all()


@both
def test_film_pressure_and_limits_are_those_of_the_row_where_they_are_worst(scene: Scene) -> None:
    scene = scene.replace(fz=-1500.0)
    oil = film(scene, viscosity=0.05)
    state = equilibrium(scene)
    told = {limit.name: limit for limit in limits(scene)}
    rows = [scene.bearing.of_row(k) for k in range(2)]
    heaviest = [float(state.ball_load[:, own].max()) for own in scene.bearing.balls_of_rows]
    speeds = [rolling_speed(own, scene.shaft_speed) for own in rows]
    row = speeds.index(oil.rolling_speed)
    # each looks at cage angles of its own: cages that turn apart never meet the same places again
    assert oil.inner.load == pytest.approx(heaviest[row], rel=1e-3)
    p = max(
        float(own.race_contact("inner").greatest_pressure(load))
        for own, load in zip(rows, heaviest, strict=True)
    )
    assert told["contact pressure, inner race"].value == pytest.approx(p, rel=1e-2)
    assert contact_pressures(scene, state).inner.greatest_pressure == pytest.approx(p, rel=1e-12)
    assert math.isfinite(told["contact angle at the shoulder"].value)
    assert told["centrifugal force, least loaded ball"].value > 0.0


def test_nothing_repeats_where_cages_turn_at_speeds_of_their_own() -> None:
    assert common_ball_passes(UNLIKE) is None
    assert orbit(UNLIKE).status == OrbitStatus.NO_PERIOD
    assert common_ball_passes(scene_of_rows(Row(-9e-3), Row(9e-3, 1, n_balls=10))) == 7
    assert common_ball_passes(scene_of_rows(Row(-9e-3), Row(9e-3, 1, n_balls=7))) == 2
    assert common_ball_passes(scene_of_rows(Row(-9e-3), Row(9e-3, 1, n_balls=9))) == 14


@both
def test_rows_live_as_they_would_alone_and_fail_as_one_chain(scene: Scene) -> None:
    """Rated together each row is rated as alone; under a thrust each row has its own share."""
    rows = tuple(dataclasses.replace(row, facing=1) for row in scene.bearing.rows)
    bearing = scene.bearing.replace(rows=rows)
    scene = scene.healthy().replace(
        bearing=bearing, load=Load(fz=3000.0), dofs=("z",), shaft_speed=100.0
    )
    own = [bearing.of_row(k).replace(rows=()) for k in range(2)]
    alone = [dynamic_load_rating(one) for one in own]
    C = dynamic_load_rating(bearing)
    assert pytest.approx(sum(alone) * 2.0**-0.3, rel=1e-12) == C
    rated = life(scene, C)
    state = equilibrium(scene, [0.0])
    pressed = state.ball_load[0] * np.sin(state.contact_angle[0])
    for k, balls in enumerate(bearing.balls_of_rows):
        assert race_ratings(bearing, C, k) == pytest.approx(race_ratings(own[k], alone[k]))
        by_itself = scene.replace(bearing=own[k], fz=float(pressed[balls].sum()))
        expected = life(by_itself, alone[k]).million_revolutions
        assert rated.rows[k] == pytest.approx(expected, rel=1e-6)
    chain = sum(row ** (-10 / 9) for row in rated.rows) ** -0.9
    assert rated.million_revolutions == pytest.approx(chain, rel=1e-9)
    standard = (rated.inner_load / rated.inner_rating) ** (10 / 3)
    standard += (rated.outer_load / rated.outer_rating) ** (10 / 3)
    assert rated.million_revolutions == pytest.approx(standard**-0.9, rel=1e-9)
    with pytest.raises(ValueError, match='"all" for rows that are not alike'):
        life(scene, C, positions="load line")


THREE_ROWS = scene_of_rows(
    Row(-9e-3, 1, n_balls=3),
    Row(9e-3, 1, n_balls=3, contact_angle=STEEP),
    Row(20e-3, -1, n_balls=3, contact_angle=math.radians(15.0)),
).replace(load=Load(fy=-3000.0, fz=300.0))
"""Of few balls, so that how the rows are turned to each other counts."""


@pytest.mark.parametrize(
    ("scene", "steps", "tolerance"), [(BALLS, 24, 2e-4), (THREE_ROWS, 10, 1e-3)]
)
def test_life_averages_over_all_that_rows_come_to_be_to_each_other(
    scene: Scene, steps: int, tolerance: float
) -> None:
    """Against a fine grid of all cages' angles."""
    scene = scene.healthy().replace(dofs=("x", "y", "z"))
    bearing, C = scene.bearing, 40_000.0
    first, *others = bearing.rows
    parts = np.arange(steps) / steps
    spacings = [bearing.of_row(k).ball_spacing for k in range(len(bearing.rows))]
    used = np.zeros((len(bearing.rows), 2))
    for turns in itertools.product(parts, repeat=len(others)):
        rows = [
            dataclasses.replace(row, turn=row.turn + part * spacing)
            for row, part, spacing in zip(others, turns, spacings[1:], strict=True)
        ]
        at = scene.replace(bearing=bearing.replace(rows=(first, *rows)))
        loads = equilibrium(at, parts * spacings[0]).ball_load
        for k, own in enumerate(bearing.balls_of_rows):
            used[k] += [np.mean(loads[:, own] ** 3), np.mean(loads[:, own] ** (10 / 3))]
    failing = 0.0
    for k, total in enumerate(used):
        Q_ci, Q_ce = race_ratings(bearing, C, k)
        Q_ei, Q_ee = (total / steps ** len(others)) ** [1 / 3, 0.3]
        failing += (Q_ei / Q_ci) ** (10 / 3) + (Q_ee / Q_ce) ** (10 / 3)
    actual = life(scene, C).million_revolutions
    assert actual == pytest.approx(failing**-0.9, rel=tolerance)


def test_a_signal_is_diagnosed_for_one_row_at_a_time() -> None:
    noise = np.random.default_rng(1).normal(size=(20_000, 1))
    heard = Recording(noise, 20_000.0, ("y",), "noise")
    with pytest.raises(ValueError, match="one row at a time"):
        diagnose(heard, BALLS.bearing, BALLS.shaft_speed)
    assert part_lines(BALLS.bearing.of_row(1)) == part_lines(SMALL)
    with pytest.raises(ValueError, match="rows are not alike"):
        size_defect(heard, BALLS.replace(race="outer"))


def test_rows_come_back_from_files() -> None:
    assert Scene.from_toml(UNLIKE.to_toml()) == UNLIKE
    assert Scene.from_toml(BALLS.to_toml()) == BALLS
