"""How far inside the edges of a spall a ball carries nothing."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from bearingcore import Defect, Load, Scene, presets
from bearingcore.model.statics import equilibrium
from bearingcore.sizing._release import plausible_offset, release_offset

MOTOR = presets["6205"].bearing
UNDER = 1.5 * math.pi


def exact_drop(s: float) -> float:
    """[m] by which a ball pivoting on the corner of an outer race sinks."""
    outer, ball = MOTOR.outer_raceway_radius, MOTOR.ball_radius
    inner = ball**2 - (outer * math.sin(s)) ** 2
    return outer * math.cos(s) - math.sqrt(inner) - (outer - ball)


def compression_beside(load: float) -> float:
    """[m] of the ball under the load, on a whole race."""
    spall = Defect(0.0, 0.0, UNDER, "outer")
    bearing = dataclasses.replace(MOTOR, radial_clearance=0.0)
    scene = Scene(bearing, spall, Load(fy=-load), 0.0, presets["6205"].support, dofs=("x", "y"))
    carried = float(equilibrium(scene, np.array([UNDER])).ball_load[0, 0])
    return (carried / bearing.load_deflection_factor) ** (2.0 / 3.0)


@pytest.mark.parametrize("load", [50.0, 400.0])
def test_a_ball_lets_go_where_it_has_sunk_by_its_compression_and_what_the_rings_follow(load):
    """The rings follow a ball that sinks until the others carry all: by less than its compression
    once more, as six or more of nine balls are there to carry.
    """
    compressed = compression_beside(load)
    offset = release_offset(MOTOR, "outer", load, 0.0)
    alone = 2.0 * brentq(lambda s: exact_drop(s) - compressed, 0.0, 0.05)
    twice = 2.0 * brentq(lambda s: exact_drop(s) - 2.0 * compressed, 0.0, 0.05)
    assert alone < offset < twice


def test_offsets_measured_on_a_rig_fit_its_load():
    """A rig with 5 kg overhung: spalls of 5° on the outer race were 3.8-4.0° between knocks."""
    exact = [math.degrees(release_offset(MOTOR, "outer", load, 3e-6)) for load in (80.0, 150.0)]
    assert exact == pytest.approx([1.11, 1.32], abs=0.03)
    assert math.degrees(release_offset(MOTOR, "outer", 80.0, 3e-6, "published")) > 1.8


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("edge", ["exact", "chord", "published"])
def test_offsets_grow_with_load_and_clearance(race, edge):
    by_load = [release_offset(MOTOR, race, load, 3e-6, edge) for load in (50.0, 200.0, 800.0)]
    by_clearance = [release_offset(MOTOR, race, 100.0, gap, edge) for gap in (0.0, 5e-6, 2e-5)]
    assert np.all(np.diff(by_load) > 0.0)
    assert np.all(np.diff(by_clearance) > 0.0)


@pytest.mark.parametrize("load", [1e-6, 1.0, 1e5])
def test_offsets_of_any_load_are_angles_inside_the_spall(load):
    """Under a light load a ball carries over a few degrees only, and was let go turns away."""
    for gap in (0.0, 1e-5, 1e-4):
        offset = release_offset(MOTOR, "outer", load, gap)
        assert math.isnan(offset) or 0.0 <= offset < MOTOR.ball_spacing
    low, _, high = plausible_offset(MOTOR, "outer", load, None, "exact")
    assert 0.0 <= low < high < 0.5 * MOTOR.ball_spacing


def test_what_is_known_narrows_what_is_plausible():
    def width(load, clearance):
        low, _, high = plausible_offset(MOTOR, "outer", load, clearance)
        return high - low

    assert width(100.0, 3e-6) < width(100.0, None) < width(None, None)
