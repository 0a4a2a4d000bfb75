"""Balls with or without mass: what a plan says of them, and who refuses them."""

from __future__ import annotations

import math

import pytest

from bearingcore import presets
from bearingcore.dynamics.adaptive import simulate_adaptive
from bearingcore.dynamics.orbit import orbit
from bearingcore.plan import VIBRATION, plan
from bearingcore.plan.balls import compare_balls, mass_share

FAN_RIG = presets["fan-rig"].replace(contact_damping=122.0)


def test_up_to_where_massless_balls_will_do() -> None:
    """Fan rig at 7 Hz: mass adds tenths of a decibel below 5 kHz and 10 dB above."""
    found = compare_balls(FAN_RIG, budget=1.0)
    assert found.added[found.edges[:-1] > 8e3].min() > 3.0
    assert 2e3 < found.massless_up_to < 8e3
    inside = found.edges[1:] <= found.massless_up_to
    assert abs(found.added[inside]).max() <= 1.0
    assert "massless: within 1 dB up to" in found.sentence
    assert found.seconds > found.massless_seconds
    strict = compare_balls(FAN_RIG, budget=1e-6)
    assert math.isnan(strict.massless_up_to)
    assert "more than 1e-06 dB off" in strict.sentence


def test_share_of_the_power_that_mass_adds() -> None:
    assert abs(mass_share(FAN_RIG, 300.0, 2100.0, 0.7, 65536.0)) < 0.1
    assert mass_share(FAN_RIG, 10e3, 20e3, 0.7, 65536.0) > 0.8


def test_a_plan_for_balls_with_mass() -> None:
    heavy = FAN_RIG.replace(balls="with mass")
    made = plan(heavy, VIBRATION, duration=0.3)
    assert made.method == "fixed steps"
    assert made.step_rate == 3 * 65536.0
    assert made.predicted_error < 0.1
    assert made.note.startswith("massless: ")
    assert made.run().ball_place is not None


def test_those_that_do_not_know_mass_say_so() -> None:
    """Nothing marches massless balls where balls with mass were asked for."""
    heavy = FAN_RIG.replace(balls="with mass")
    for march in (orbit, lambda scene: simulate_adaptive(scene, 0.01)):
        with pytest.raises(ValueError, match="massless"):
            march(heavy)
