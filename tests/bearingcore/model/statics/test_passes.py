"""Balls that enter and leave defects, and their depth inside."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from bearingcore import presets
from bearingcore.model.statics import ball_drop, crossings, path_kinks
from tests.outside.elements import Defect

FAN_RIG = presets["fan-rig"]
TURN = 2.0 * math.pi


def test_in_a_cage_turn_every_ball_enters_and_leaves_an_outer_race_defect_once() -> None:
    passes = crossings(FAN_RIG, 0.05, 0.05 + TURN)
    assert sorted(c.ball for c in passes if c.enters) == list(range(14))
    assert sorted(c.ball for c in passes if not c.enters) == list(range(14))
    assert [c.cage_angle for c in passes] == sorted(c.cage_angle for c in passes)


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("center_deg", [270.0, 1.0])
def test_between_entry_and_exit_a_ball_sinks_and_nowhere_else(race: str, center_deg: float) -> None:
    scene = FAN_RIG.replace(race=race, center=math.radians(center_deg))
    passes = crossings(scene, 0.0, TURN)
    assert passes
    for crossing in passes:
        offset = crossing.ball * scene.bearing.ball_spacing
        before, after = (
            float(ball_drop(scene, cage + offset, cage))
            for cage in (crossing.cage_angle - 1e-3, crossing.cage_angle + 1e-3)
        )
        outside, inside = (before, after) if crossing.enters else (after, before)
        assert outside == 0.0
        assert inside > 0.0


@pytest.mark.parametrize("edge", ["published", "exact"])
def test_a_path_has_its_corners_where_edge_and_floor_begin(edge: str) -> None:
    """A ball has four corners: roots, by SciPy, of the drop in `elements.py`."""
    scene = FAN_RIG.replace(edge=edge)
    spall = scene.defect
    slot = Defect(spall.extent, spall.depth, scene.bearing.outer_raceway_radius, edge)

    def height_above_floor(s: float) -> float:
        phi = np.array([slot.center - 0.5 * slot.extent + s])
        return float(slot.drop(phi, scene.bearing.ball_radius)[0]) - slot.depth * (1.0 - 1e-12)

    s_floor = brentq(height_above_floor, 0.0, 0.5 * slot.extent, xtol=1e-15)
    corners = (-0.5 * slot.extent, s_floor - 0.5 * slot.extent)
    balls = slot.center - scene.bearing.ball_spacing * np.arange(14)
    known = [balls + side * corner for corner in corners for side in (1.0, -1.0)]
    kinks = path_kinks(scene, 0.0, scene.bearing.ball_spacing)
    expected = np.sort(np.concatenate(known) % TURN)
    expected = expected[expected < scene.bearing.ball_spacing]
    assert kinks == pytest.approx(expected, abs=1e-6)


def test_a_healthy_bearing_and_a_worn_race_have_no_edges_to_pass() -> None:
    assert crossings(FAN_RIG.healthy(), 0.0, TURN) == []
    assert crossings(FAN_RIG.replace(extent=TURN), 0.0, TURN) == []


def test_drops_into_each_race_add_to_the_whole() -> None:
    outer = FAN_RIG.defects[0]
    inner = FAN_RIG.replace(race="inner", depth=20e-6).defects[0]
    scene = FAN_RIG.replace(defect=(outer, inner))
    angle = np.linspace(0.0, TURN, 721)
    whole = ball_drop(scene, angle)
    apart = ball_drop(scene, angle, race="outer") + ball_drop(scene, angle, race="inner")
    np.testing.assert_allclose(whole, apart)
    assert whole.max() == pytest.approx(70e-6)
