"""Limits of the model are met where physics says, and told in sentences with numbers."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from bearingcore import Bearing, Limit, Scene, equilibrium, film, limits, presets, simulate
from bearingcore.statics.ball_positions import centrifugal_effect
from bearingcore.statics.limit import summary
from bearingcore.statics.validity import (
    looked_at,
    usual_shoulder_height,
)

HEALTHY_6205 = presets["6205"].healthy()


def found(scene: Scene, name: str, **choices: float) -> Limit:
    by_name = {limit.name: limit for limit in limits(scene, **choices)}  # type: ignore[arg-type]
    assert len(by_name) == len(limits(scene, **choices))  # type: ignore[arg-type]
    return by_name[name]


INNER, OUTER = "contact pressure, inner race", "contact pressure, outer race"


STATIC_RATING_6205 = 7.8e3
"""As makers print it [N]: the load at which ISO 76 lets 4.2 GPa stand, if a ball carries 5 F/Z."""


def test_static_rating_of_the_catalogue_is_where_the_pressure_reaches_4200_mpa() -> None:
    ball = 5.0 * STATIC_RATING_6205 / 9.0
    p = HEALTHY_6205.bearing.race_contact("inner").greatest_pressure(ball)
    assert float(p) == pytest.approx(4.2e9, rel=0.01)


def test_overload_begins_near_the_static_rating() -> None:
    """Without clearance the most loaded ball carries 4.37 F/Z (Stribeck), so a little later."""
    tight = HEALTHY_6205.replace(radial_clearance=0.0)
    begins = STATIC_RATING_6205 * 5.0 / 4.37
    assert not found(tight.replace(fy=-0.95 * begins), INNER).crossed
    limit = found(tight.replace(fy=-1.05 * begins), INNER)
    assert limit.crossed
    assert "above the 4.2 GPa" in limit.sentence


@pytest.mark.parametrize("name", ["liew-lim", "fan-rig"])
def test_without_groove_radii_pressure_is_not_known_and_not_invented(name: str) -> None:
    for race in (INNER, OUTER):
        limit = found(presets[name], race)
        assert math.isnan(limit.value)
        assert not limit.crossed
        assert "not known" in limit.sentence


def test_a_thrust_climbs_the_shoulder_of_a_deep_groove() -> None:
    gentle = HEALTHY_6205.replace(fy=-300.0, fz=500.0)
    harsh = HEALTHY_6205.replace(fy=-300.0, fz=40e3)
    name = "contact angle at the shoulder"
    assert not found(gentle, name).crossed
    limit = found(harsh, name)
    assert limit.crossed
    assert "rides over its edge" in limit.sentence
    # a higher shoulder holds it, and a lower one does not hold even the gentle thrust
    assert not found(harsh, name, shoulder_height=0.5).crossed
    assert found(gentle, name, shoulder_height=0.02).crossed


def test_the_contact_reaches_as_far_as_its_angle_and_half_its_ellipse() -> None:
    """Pure thrust: all balls alike, the angle from the balance N_b Q sin α = F_z."""
    scene = presets["7208-25deg"].healthy().replace(fy=0.0, fz=3000.0, dofs=("z",))
    state = equilibrium(scene)
    load, angle = state.ball_load[0, 0], state.contact_angle[0, 0]
    assert 14 * load * math.sin(angle) == pytest.approx(3000.0, rel=1e-9)
    a = max(scene.bearing.race_contact(race).semi_axes(load)[0] for race in ("inner", "outer"))
    expected = angle + math.asin(a / scene.bearing.ball_radius)
    assert found(scene, "contact angle at the shoulder").value == pytest.approx(expected)


def test_shoulders_stand_where_their_height_puts_them() -> None:
    """As high as the ball's centre: 90°. As usual in deep grooves: 53.1°."""
    name = "contact angle at the shoulder"
    assert found(HEALTHY_6205, name, shoulder_height=0.5).limit == pytest.approx(math.pi / 2)
    assert found(HEALTHY_6205, name).limit == pytest.approx(math.acos(0.6))
    assert usual_shoulder_height(math.radians(40.0)) == pytest.approx(0.3)


CHANGE, LEAST = "change by centrifugal force", "centrifugal force, least loaded ball"


def test_centrifugal_force_matters_at_speed_and_not_at_rest() -> None:
    at_rest = HEALTHY_6205.replace(shaft_speed=0.0)
    fast = HEALTHY_6205.replace(shaft_speed=40e3 * 2.0 * math.pi / 60.0)
    for name in (CHANGE, LEAST):
        assert found(at_rest, name).value == 0.0
        assert not found(HEALTHY_6205, name).crossed
        assert found(fast, name).crossed
    ratio = found(fast, LEAST).value / found(HEALTHY_6205, LEAST).value
    assert ratio == pytest.approx((40e3 / 1797.0) ** 2, rel=1e-9)


def test_what_centrifugal_force_changes_is_measured() -> None:
    """By two solutions, one with it and one without, here at angles of its own."""
    fast = HEALTHY_6205.replace(shaft_speed=10.0 * HEALTHY_6205.shaft_speed)
    values = [found(scene, CHANGE).value for scene in (HEALTHY_6205, fast)]
    angles = np.linspace(0.0, fast.bearing.ball_spacing, 121)
    for value, scene in zip(values, (HEALTHY_6205, fast), strict=True):
        effect = centrifugal_effect(scene, angles)
        assert value == pytest.approx(max(effect.load, effect.stiffness), rel=0.3)
    assert values[0] < 0.01 < 0.04 < values[1]
    assert "parts the contact angles" in found(fast, CHANGE).sentence
    assert "of a ball, 224 mN," in found(HEALTHY_6205, CHANGE).sentence


@pytest.mark.parametrize("conformity", [0.505, 0.52, 0.54, 0.58])
def test_compression_stands_for_the_width_of_the_contact(conformity: float) -> None:
    """At the limit the contact reaches 0.55 ball radii to either side, whatever the grooves."""
    D_b = 10e-3
    bearing = Bearing.from_drawing(
        9, D_b, 50e-3, conformity * D_b, conformity * D_b, contact_angle=0.0
    )
    load = bearing.load_deflection_factor * (0.2 * bearing.groove_center_distance) ** 1.5
    for race in ("inner", "outer"):
        width = float(bearing.race_contact(race).semi_axes(load)[0]) / bearing.ball_radius
        assert width == pytest.approx(0.55, rel=0.04)


def test_overload_is_told_in_pressure_and_in_compression() -> None:
    heavy = HEALTHY_6205.replace(fy=-40e3)
    crossed = {limit.name for limit in limits(heavy) if limit.crossed}
    assert {INNER, OUTER, "compression against groove centre distance"} <= crossed


@pytest.mark.parametrize("race", ["outer", "inner"])
def test_the_verdict_is_that_of_a_much_finer_look(race: str) -> None:
    """Twice as fine changes no verdict and no number by more than a hundredth."""
    scene = presets["6205"].replace(race=race, extent=0.5)
    angles = looked_at(scene)
    finer = np.linspace(angles[0], angles[-1], 2 * angles.size - 1)
    for one, other in zip(limits(scene), limits(scene, equilibrium(scene, finer)), strict=True):
        assert one.crossed == other.crossed
        if not math.isnan(one.value):
            assert one.value == pytest.approx(other.value, rel=0.01)


def test_loads_in_motion_count_where_they_are_known() -> None:
    names = ("contact pressure in motion", "compression in motion")
    scene = presets["6205"]
    for name in names:
        unknown = found(scene, name)
        assert math.isnan(unknown.value)
        assert "no motion of this scene has been simulated" in unknown.sentence
    still = scene.replace(shaft_speed=0.0)
    assert not {one.name for one in limits(still)} & set(names)
    motion = simulate(scene, duration=0.1)
    load = float(motion.ball_loads().max())
    moving = found(scene, names[0], dynamic_load=load)
    expected = float(scene.bearing.race_contact("inner").greatest_pressure(load))
    assert moving.value == pytest.approx(expected)
    assert found(scene, names[0], dynamic_load=50e3).crossed
    assert found(scene, names[1], dynamic_load=50e3).crossed


def test_the_summary_counts_all_three_kinds() -> None:
    scene = presets["6205"]
    known = limits(scene, dynamic_load=1.0, film=film(scene, viscosity=0.1))
    assert summary(known) == f"{len(known)} checks passed"
    assert summary(limits(scene)) == f"{len(known) - 3} checks passed, 3 not checked"
    assert summary(known[:1]) == "1 check passed"
    heavy = limits(HEALTHY_6205.replace(fy=-40e3))
    crossed = sum(limit.crossed for limit in heavy)
    assert summary(heavy).startswith(f"{crossed} limits exceeded, ")


def test_the_film_counts_where_the_oil_is_given() -> None:
    scene, name = presets["6205"], "film parameter"
    assert math.isnan(found(scene, name).value)
    assert "viscosity of the oil" in found(scene, name).sentence
    assert "groove radii" in found(presets["fan-rig"], name).sentence
    for viscosity, crossed in ((2e-3, True), (0.1, False)):
        oil = film(scene, viscosity=viscosity)
        limit = found(scene, name, film=oil)  # type: ignore[arg-type]
        assert limit == oil.limit
        assert limit.value == min(oil.inner.film_parameter, oil.outer.film_parameter)
        assert limit.crossed == (limit.value < 1.0) == crossed
    assert name not in {one.name for one in limits(scene.replace(shaft_speed=0.0))}
    with pytest.raises(ValueError, match="film of another scene"):
        limits(scene.replace(fy=-100.0), film=oil)
    rollers = presets["nu208"]
    assert found(rollers, name, film=film(rollers, viscosity=0.1)).value > 0.0  # type: ignore[arg-type]


def test_tight_grooves_of_the_published_bearing_are_told() -> None:
    """50 µm between the groove centres of a 6 mm ball: 1.4 kN press it up the sides."""
    limit = found(presets["liew-lim"], "compression against groove centre distance")
    assert limit.crossed
    assert limit.value == pytest.approx((1389.0 / 1.45e10) ** (2 / 3) / 50e-6, rel=1e-3)


def test_a_stiffness_that_does_not_go_with_the_drawing_is_told() -> None:
    name = "load-deflection factor against the drawing"
    drawn = found(HEALTHY_6205, name)
    assert drawn.value == 0.0
    assert not drawn.crossed
    K = HEALTHY_6205.bearing.load_deflection_factor
    softer = found(HEALTHY_6205.replace(load_deflection_factor=0.9 * K), name)
    assert softer.value == pytest.approx(0.1)
    assert softer.crossed
    assert not found(HEALTHY_6205.replace(contact_angle=0.6), name).crossed  # drawn anew
    seated = HEALTHY_6205.replace(bearing=HEALTHY_6205.bearing.seated())
    assert not found(seated, name).crossed
    assert name not in {limit.name for limit in limits(presets["fan-rig"])}


def test_steps_in_a_defect_by_hand() -> None:
    """6205: 1.3° at the cage's 74.95 rad/s are 0.3027 ms, at 131072 Hz 39.7 steps."""
    scene = presets["6205"]
    limit = found(scene, "time steps in a defect", step_rate=131072.0)
    assert limit.value == pytest.approx(39.7, abs=0.05)
    assert not limit.crossed
    assert found(scene, "time steps in a defect", step_rate=65536.0).crossed


def test_the_default_steps_of_a_motion_are_enough() -> None:
    for name in presets:
        step_rate = simulate(presets[name], duration=0.01).step_rate
        assert not found(presets[name], "time steps in a defect", step_rate=step_rate).crossed


def test_an_inner_race_defect_is_passed_at_the_relative_speed() -> None:
    scene = presets["fan-rig"]
    outer = found(scene, "time steps in a defect", step_rate=65536.0).value
    inner = found(scene.replace(race="inner"), "time steps in a defect", step_rate=65536.0).value
    cage = scene.bearing.cage_ratio
    assert inner / outer == pytest.approx(cage / (1.0 - cage), rel=1e-12)


def test_no_defect_or_a_shaft_at_rest_passes_nothing() -> None:
    for scene in (HEALTHY_6205, presets["6205"].replace(shaft_speed=0.0)):
        names = {limit.name for limit in limits(scene, step_rate=65536.0)}
        assert "time steps in a defect" not in names


def test_an_unloaded_bearing_has_no_numbers_and_crosses_nothing() -> None:
    for scene in (
        HEALTHY_6205.replace(fy=0.0),
        HEALTHY_6205.replace(fy=0.0, fz=-1.0, dofs=("x", "y")),
        presets["7208-25deg"].healthy().replace(fy=0.0, fz=0.0),
    ):
        for limit in limits(scene):
            assert not limit.crossed
            assert math.isnan(limit.value) or limit.value == 0.0


@pytest.mark.parametrize("name", list(presets))
def test_each_sentence_holds_its_number(name: str) -> None:
    """Read back from the words: pressure in GPa, angles in degrees, shares in percent."""
    scale = {"Pa": 1e-9, "rad": 180.0 / math.pi, "": 100.0}
    for limit in limits(presets[name], step_rate=16384.0):
        assert limit.sentence.endswith(".")
        if math.isnan(limit.value):
            continue
        shown = limit.value * (1.0 if "steps" in limit.name else scale[limit.unit])
        numbers = [
            float(text) for text in re.findall(r"\d+(?:\.\d+)?(?:e[+-]\d+)?", limit.sentence)
        ]
        tolerance = 0.5 if "steps" in limit.name else 0.006 * shown + 0.011
        assert min(abs(number - shown) for number in numbers) <= tolerance, limit.sentence


def test_a_state_at_hand_gives_the_same() -> None:
    scene = presets["6206"]
    assert limits(scene, equilibrium(scene, looked_at(scene))) == limits(scene)
    with pytest.raises(ValueError, match="equilibrium of another scene"):
        limits(scene, equilibrium(scene.healthy()))


@pytest.mark.parametrize(
    ("choices", "said"),
    [
        ({"shoulder_height": 0.0}, "shoulder_height is 0; "),
        ({"shoulder_height": 0.6}, "shoulder_height is 0.6; "),
        ({"step_rate": 0.0}, "step_rate is 0; "),
        ({"step_rate": math.nan}, "step_rate is nan; "),
    ],
)
def test_impossible_choices_are_refused(choices: dict[str, float], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        limits(HEALTHY_6205, **choices)  # type: ignore[arg-type]


def test_what_still_leaves_centrifugal_load_out_is_said_of_balls_with_mass() -> None:
    fast = presets["7208-25deg"].replace(shaft_speed=1500.0)
    massless = found(fast, "change by centrifugal force")
    heavy = found(fast.replace(balls="with mass"), "change by centrifugal force")
    assert massless.crossed
    assert heavy.crossed
    assert heavy.value == massless.value
    assert "static model leaves it out" in massless.sentence
    assert "natural frequencies and life leave it out" in heavy.sentence
