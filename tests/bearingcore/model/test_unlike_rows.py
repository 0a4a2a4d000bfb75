"""Rows with contact angles of their own: statics by what each row carries, motion refused."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from bearingcore import (
    Bearing,
    Scene,
    dynamic_load_rating,
    equilibrium,
    film,
    life,
    limits,
    modes,
    orbit,
    presets,
    simulate,
    stiffness_maps,
)
from bearingcore.model import packing
from bearingcore.model.rows import Row
from bearingcore.plan import SETTLED, plan
from bearingcore.statics.ball_positions import ball_positions, static_state
from bearingcore.statics.film import rolling_speed
from bearingcore.statics.passes import ball_drop

ONE = presets["7208-25deg"]
STEEP = math.radians(40.0)


def with_rows(*rows: Row) -> Scene:
    return ONE.replace(bearing=dataclasses.replace(ONE.bearing, rows=rows))


UNLIKE = with_rows(Row(-9e-3, -1, turn=0.1), Row(9e-3, 1, contact_angle=STEEP))


def test_a_row_of_the_bearings_own_angle_is_as_if_none_were_given() -> None:
    angle = ONE.bearing.contact_angle
    same = with_rows(Row(-9e-3, -1, contact_angle=angle), Row(9e-3))
    assert same == with_rows(Row(-9e-3, -1), Row(9e-3))
    assert same.bearing.has_one_contact_angle
    assert not UNLIKE.bearing.has_one_contact_angle


def test_what_follows_from_the_angle_follows_for_the_row() -> None:
    bearing = UNLIKE.bearing
    steep = ONE.bearing.replace(contact_angle=STEEP)
    assert bearing.of_row(0) == bearing
    assert bearing.of_row(1) == steep
    contacts, n = packing.contacts(bearing), bearing.n_balls
    assert contacts.line_r[n] == math.cos(STEEP)
    assert contacts.line_z[0] == -math.sin(bearing.contact_angle)
    assert contacts.factor[n] == steep.load_deflection_factor != contacts.factor[0]
    lever = bearing.groove_center_radius
    assert contacts.reach[n] * lever == pytest.approx(steep.groove_center_radius)
    assert steep.bpfo(10.0) > bearing.bpfo(10.0), "its cage turns faster"


def test_each_row_carries_what_it_would_alone() -> None:
    """At the middle of the shaft: a row alone, under the load it carries, moves as the pair does.

    What a row carries comes from its balls' loads and contact angles alone.
    """
    pair = with_rows(Row(turn=0.1), Row(contact_angle=STEEP)).replace(dofs=("x", "y", "z"))
    angles = [0.0, 0.13]
    found = equilibrium(pair, angles)
    assert found.converged.all()
    n = pair.bearing.n_balls
    total = np.zeros((2, 3))
    for k, row in enumerate(pair.bearing.rows):
        own = slice(k * n, (k + 1) * n)
        Q, phi = found.ball_load[:, own], found.ball_angle[:, own]
        alpha = np.nan_to_num(found.contact_angle[:, own])
        assert (Q > 0.0).any()
        F = np.stack(
            [
                (Q * np.cos(alpha) * np.cos(phi)).sum(axis=1),
                (Q * np.cos(alpha) * np.sin(phi)).sum(axis=1),
                (Q * np.sin(alpha)).sum(axis=1),
            ],
            axis=1,
        )
        total += F
        alone = dataclasses.replace(pair.bearing.of_row(k), rows=(Row(turn=row.turn),))
        for i, angle in enumerate(angles):
            fx, fy, fz = F[i]
            single = pair.replace(bearing=alone, fx=fx, fy=fy, fz=fz)
            state = equilibrium(single, [angle])
            np.testing.assert_allclose(
                state.displacement[0, :3], found.displacement[i, :3], rtol=1e-7, atol=1e-13
            )
            np.testing.assert_allclose(state.ball_load[0], Q[i], rtol=1e-6, atol=1e-6)
    load = pair.load
    np.testing.assert_allclose(total, [[load.fx, load.fy, load.fz]] * 2, rtol=1e-7, atol=1e-6)


def test_stiffness_is_symmetric_positive_and_the_slope_of_the_load() -> None:
    scene = UNLIKE.healthy().replace(dofs=("x", "y", "z", "rx", "ry"))
    found = equilibrium(scene, [0.05])
    assert found.converged.all()
    K = found.stiffness[0]
    np.testing.assert_array_equal(K, K.T)
    assert np.linalg.eigvalsh(K / np.sqrt(np.outer(K.diagonal(), K.diagonal()))).min() > 0.0
    for column, name, step in ((1, "fy", 0.5), (2, "fz", 0.5), (3, "mx", 5e-3)):
        ends = [
            equilibrium(scene.replace(**{name: getattr(scene.load, name) + s}), [0.05]).displacement
            for s in (-step, step)
        ]
        slope = (ends[1] - ends[0])[0] / (2.0 * step)
        expected = np.linalg.solve(K, np.eye(5)[column])
        np.testing.assert_allclose(slope, expected, rtol=2e-4, atol=1e-4 * np.abs(expected).max())


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("edge", ["published", "exact"])
def test_each_rows_balls_run_on_its_own_raceway(race: str, edge: str) -> None:
    scene = UNLIKE.replace(race=race, edge=edge, extent=0.15, depth=150e-6, row=None)
    angles = scene.defect.center + np.linspace(-0.1, 0.1, 301)
    for row in range(2):
        alone = ONE.replace(
            bearing=dataclasses.replace(scene.bearing.of_row(row), rows=()), defect=scene.defect
        )
        expected = ball_drop(alone, angles)
        assert np.ptp(expected) > 1e-5
        np.testing.assert_allclose(ball_drop(scene, angles, row=row), expected, atol=1e-15)
    if race == "inner":  # the shaft is where the first row's cage says
        turned = ball_drop(scene, angles + 0.3 / scene.bearing.cage_ratio, 0.3, row=1)
        np.testing.assert_allclose(turned, ball_drop(scene, angles, row=1), atol=1e-12)


def test_maps_modes_and_balls_positions_follow() -> None:
    scene = UNLIKE.replace(extent=0.12, row=None)
    angles = [0.0, 0.1]
    state = equilibrium(scene, angles)
    maps = stiffness_maps(scene, [0.0, 0.12], angles)
    np.testing.assert_allclose(maps.term("k_yy")[1], state.term("k_yy"), rtol=1e-9)
    massless = ball_positions(scene, angles, centrifugal_load=0.0)
    np.testing.assert_allclose(massless.load[0], state.ball_load, rtol=1e-6, atol=1e-6)
    fast = static_state(scene.replace(balls="with mass", shaft_speed=2000.0), angles)
    n, slack = scene.bearing.n_balls, fast.positions.load[0] == 0.0  # type: ignore[attr-defined]
    outer = [fast.ball_load[:, own][slack[:, own]] for own in (slice(0, n), slice(n, 2 * n))]
    for row in (0, 1):
        F_c = scene.bearing.of_row(row).centrifugal_load(2000.0)
        assert outer[row] == pytest.approx(F_c, rel=1e-6)
    assert np.isfinite(modes(scene, angles).frequency).all()


def test_film_pressure_and_limits_are_those_of_the_row_that_carries_most() -> None:
    scene = UNLIKE.replace(fz=-1500.0)
    oil = film(scene, viscosity=0.05)
    state = equilibrium(scene)
    n = scene.bearing.n_balls
    row = int(state.ball_load[:, n:].max() > state.ball_load[:, :n].max())
    own = scene.bearing.of_row(row)
    assert oil.rolling_speed == rolling_speed(own, scene.shaft_speed)
    told = {one.name: one for one in limits(scene)}
    p = float(own.race_contact("inner").greatest_pressure(oil.inner.load))
    assert told["contact pressure, inner race"].value == pytest.approx(p, rel=1e-3)
    assert math.isfinite(told["contact angle at the shoulder"].value)


@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_what_moves_is_refused_with_the_reason(balls: str) -> None:
    scene = UNLIKE.replace(balls=balls)
    for attempt in (lambda: simulate(scene, 0.01), lambda: plan(scene, SETTLED)):
        with pytest.raises(ValueError, match="each row's cage turns at a speed of its own"):
            attempt()
    if balls == "massless":
        with pytest.raises(ValueError, match="25° and 40°"):
            orbit(scene)


def test_ratings_of_rows_that_differ_are_refused() -> None:
    for attempt in (lambda: life(UNLIKE, 4e4), lambda: dynamic_load_rating(UNLIKE.bearing)):
        with pytest.raises(ValueError, match="contact angles of their own"):
            attempt()
    assert dynamic_load_rating(UNLIKE.bearing.of_row(1)) > 0.0


def test_angles_come_back_from_files_and_bad_ones_are_named() -> None:
    assert Scene.from_toml(UNLIKE.to_toml()) == UNLIKE
    assert presets["7208-tandem"].to_toml().count("contact_angle") == 1, "the bearing's alone"
    for angle in (-0.1, 2.0, math.nan, "steep"):
        with pytest.raises(ValueError, match="contact_angle"):
            Row(contact_angle=angle)  # type: ignore[arg-type]
    aligning = presets["1208"].bearing
    turned = tuple(dataclasses.replace(row, contact_angle=0.1) for row in aligning.rows)
    assert not dataclasses.replace(aligning, rows=turned).is_self_aligning
    assert isinstance(UNLIKE.bearing, Bearing)
