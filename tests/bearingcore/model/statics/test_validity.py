"""Limits of the model are met where physics says, and told in sentences with numbers."""

import math
import re

import numpy as np
import pytest

from bearingcore import Limit, Scene, equilibrium, film, limits, presets, simulate
from bearingcore.model.statics import (
    NO_DRAWING,
    NO_OIL,
    ball_positions,
    state_of_limits,
    summary,
    unknown,
)
from bearingcore.model.statics._ball_positions import centrifugal_effect
from bearingcore.model.statics._limit import upper_limit
from bearingcore.model.statics._positions import over_all_positions

HEALTHY_6205 = presets["6205"].healthy()


def limit_named(scene: Scene, name: str, **choices: float) -> Limit:
    by_name = {limit.name: limit for limit in limits(scene, **choices)}  # type: ignore[arg-type]
    assert len(by_name) == len(limits(scene, **choices))  # type: ignore[arg-type]
    return by_name[name]


INNER, OUTER = "contact pressure, inner race", "contact pressure, outer race"


@pytest.mark.parametrize("name", ["liew-lim", "fan-rig"])
def test_without_groove_radii_pressure_is_not_known_and_not_invented(name: str) -> None:
    for race in (INNER, OUTER):
        limit = limit_named(presets[name], race)
        assert math.isnan(limit.value)
        assert not limit.crossed
        assert "not known" in limit.sentence


def test_a_thrust_climbs_the_shoulder_of_a_deep_groove() -> None:
    gentle = HEALTHY_6205.replace(fy=-300.0, fz=500.0)
    harsh = HEALTHY_6205.replace(fy=-300.0, fz=40e3)
    name = "contact angle at the shoulder"
    assert not limit_named(gentle, name).crossed
    limit = limit_named(harsh, name)
    assert limit.crossed
    assert "rides over its edge" in limit.sentence
    # 0.2 ball diameters high, at 40° 0.3, seen from the middle of the groove's curve
    assert limit.limit == pytest.approx(math.acos(0.6))
    assert limit_named(presets["7208-40deg"], name).limit == pytest.approx(math.acos(0.4))


CHANGE = "change by centrifugal force"


def test_what_centrifugal_force_changes_is_measured() -> None:
    """By two solutions, one with it and one without, here at angles of its own."""
    fast = HEALTHY_6205.replace(shaft_speed=10.0 * HEALTHY_6205.shaft_speed)
    values = [limit_named(scene, CHANGE).value for scene in (HEALTHY_6205, fast)]
    angles = np.linspace(0.0, fast.bearing.ball_spacing, 121)
    for value, scene in zip(values, (HEALTHY_6205, fast), strict=True):
        effect = centrifugal_effect(scene, angles)
        assert value == pytest.approx(max(effect.load, effect.stiffness), rel=0.3)
    assert values[0] < 0.01 < 0.04 < values[1]
    assert "separates the contact angles" not in limit_named(fast, CHANGE).sentence  # radial: by 0°
    assert "separates the contact angles" in limit_named(presets["7208-25deg"], CHANGE).sentence
    said = limit_named(HEALTHY_6205, CHANGE).sentence
    assert "of a ball, 224 mN," in said
    assert said.endswith("up to 10 % it may be left out.")
    said = limit_named(HEALTHY_6205, "compression against groove centre distance").sentence
    assert "up to 20 % the contact is small" in said


def test_contact_angles_part_by_those_of_balls_that_carry_a_twentieth_of_the_heaviest_load() -> (
    None
):
    fast = presets["liew-lim"].healthy().replace(shaft_speed=1000.0)
    angles = np.linspace(0.0, fast.bearing.ball_spacing, 601)
    loads = ball_positions(fast, angles)
    heaviest = ball_positions(fast, angles, centrifugal_load=0.0).load.max()
    counts = (loads.load > 0.05 * heaviest).all(axis=0)
    parted = np.abs(loads.contact_angle[0] - loads.contact_angle[1])[counts].max()
    assert centrifugal_effect(fast, angles).contact_angle == pytest.approx(parted, rel=1e-9)


@pytest.mark.parametrize("race", ["outer", "inner"])
def test_the_verdict_is_that_of_a_much_finer_look(race: str) -> None:
    """Twice as fine changes no verdict and no number by more than a hundredth."""
    scene = presets["6205"].replace(race=race, extent=0.5)
    angles = state_of_limits(scene).cage_angles
    finer = over_all_positions(scene, 241 if race == "inner" else 2 * angles.size - 1)
    for limit, other in zip(limits(scene), limits(scene, finer), strict=True):
        assert limit.crossed == other.crossed
        if not math.isnan(limit.value):
            assert limit.value == pytest.approx(other.value, rel=0.01)


def test_loads_in_motion_count_where_they_are_known() -> None:
    names = ("contact pressure in motion", "compression in motion")
    scene = presets["6205"]
    for name in names:
        unknown = limit_named(scene, name)
        assert math.isnan(unknown.value)
        assert "no motion of this scene has been simulated" in unknown.sentence
    still = scene.replace(shaft_speed=0.0)
    assert not {limit.name for limit in limits(still)} & set(names)
    motion = simulate(scene, duration=0.1)
    load = float(motion.ball_loads().max())
    moving = limit_named(scene, names[0], dynamic_load=load)
    expected = float(scene.bearing.race_contact("inner").greatest_pressure(load))
    assert moving.value == pytest.approx(expected)
    assert limit_named(scene, names[0], dynamic_load=50e3).crossed
    assert limit_named(scene, names[1], dynamic_load=50e3).crossed


def test_the_film_counts_where_the_oil_is_given() -> None:
    scene, name = presets["6205"], "film parameter"
    assert math.isnan(limit_named(scene, name).value)
    for viscosity, crossed in ((2e-3, True), (0.1, False)):
        oil = film(scene, viscosity=viscosity)
        limit = limit_named(scene, name, film=oil)  # type: ignore[arg-type]
        assert limit == oil.limit
        assert limit.value == min(oil.inner.film_parameter, oil.outer.film_parameter)
        assert limit.crossed == (limit.value < 1.0) == crossed
    assert name not in {limit.name for limit in limits(scene.replace(shaft_speed=0.0))}
    with pytest.raises(ValueError, match="film of another scene"):
        limits(scene.replace(fy=-100.0), film=oil)


def test_a_stiffness_that_does_not_go_with_the_drawing_is_told() -> None:
    name = "load-deflection factor against the drawing"
    assert limit_named(HEALTHY_6205, name).value == 0.0
    K = HEALTHY_6205.bearing.load_deflection_factor
    softer = limit_named(HEALTHY_6205.replace(load_deflection_factor=0.9 * K), name)
    assert softer.value == pytest.approx(0.1)
    assert softer.crossed
    assert not limit_named(HEALTHY_6205.replace(contact_angle=0.6), name).crossed  # drawn anew
    assert name not in {limit.name for limit in limits(presets["fan-rig"])}


def test_steps_in_a_defect_by_hand() -> None:
    """6205: 1.3° at the cage's 74.95 rad/s are 0.3027 ms, at 131072 Hz 39.7 steps.

    On the inner race, at 188.1 − 74.95 rad/s, 26.3.
    """
    scene = presets["6205"]
    limit = limit_named(scene, "time steps in a defect", step_rate=131072.0)
    assert limit.value == pytest.approx(39.7, abs=0.05)
    assert not limit.crossed
    assert limit_named(scene, "time steps in a defect", step_rate=65536.0).crossed
    inner = limit_named(scene.replace(race="inner"), "time steps in a defect", step_rate=131072.0)
    assert inner.value == pytest.approx(26.3, abs=0.05)


def test_the_default_steps_of_a_motion_are_enough() -> None:
    for name in presets:
        step_rate = simulate(presets[name], duration=0.01).step_rate
        assert not limit_named(presets[name], "time steps in a defect", step_rate=step_rate).crossed


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
    """Read back from the words: pressure in GPa, angles in degrees, shares in percent, kN."""
    scale = {"Pa": 1e-9, "rad": 180.0 / math.pi, "": 100.0, "N": 1e-3}
    for limit in limits(presets[name], step_rate=16384.0):
        assert limit.sentence.endswith(".")
        if math.isnan(limit.value) or (limit.unit == "N" and limit.value == 0.0):
            continue
        shown = limit.value * (1.0 if "steps" in limit.name else scale[limit.unit])
        numbers = [
            float(text) for text in re.findall(r"\d+(?:\.\d+)?(?:e[+-]\d+)?", limit.sentence)
        ]
        if limit.unit == "N":
            numbers += [number / 1e3 for number in numbers]
        tolerance = 0.5 if "steps" in limit.name else 0.006 * shown + 0.011
        assert min(abs(number - shown) for number in numbers) <= tolerance, limit.sentence


def test_a_state_at_hand_gives_the_same() -> None:
    scene = presets["6206"]
    assert limits(scene, state_of_limits(scene)) == limits(scene)
    with pytest.raises(ValueError, match="equilibrium of another scene"):
        limits(scene, equilibrium(scene.healthy()))


def test_limits_in_a_line_say_what_is_unchecked_and_why() -> None:
    def limit(value: float, why: str = "") -> Limit:
        return unknown("film", 1.0, "", why) if why else upper_limit("film", value, 1.0, "", *"abc")

    assert summary([limit(0.5)]) == "No limit exceeded"
    assert summary([limit(2.0), limit(0.5)]) == "1 limit exceeded"
    assert summary([limit(0.0, "nothing is carried")]) == "No limit judged (1 unchecked)"
    assert summary([limit(0.5), limit(0.0, NO_DRAWING), limit(0.0, f"{NO_DRAWING}; so")]) == (
        "No limit exceeded (2 unchecked: groove radii unknown)"
    )
    assert summary([limit(2.0), limit(2.0), limit(0.0, NO_OIL), limit(0.0, "it turns")]) == (
        "2 limits exceeded (2 unchecked)"
    ), "a reason that is not all of it is none"
