"""Balls entering and leaving defects, and how deep they sink."""

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
    events = crossings(FAN_RIG, 0.05, 0.05 + TURN)
    assert sorted(c.ball for c in events if c.enters) == list(range(14))
    assert sorted(c.ball for c in events if not c.enters) == list(range(14))
    assert [c.cage_angle for c in events] == sorted(c.cage_angle for c in events)


@pytest.mark.parametrize("race", ["outer", "inner"])
@pytest.mark.parametrize("center_deg", [270.0, 1.0])
def test_between_entry_and_exit_a_ball_sinks_and_nowhere_else(race: str, center_deg: float) -> None:
    scene = FAN_RIG.replace(race=race, center=math.radians(center_deg))
    events = crossings(scene, 0.0, TURN)
    assert events
    for crossing in events:
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
    """Four a ball: roots by SciPy of the drop that `elements.py` has of the geometry."""
    scene = FAN_RIG.replace(edge=edge)
    hurt = scene.defect
    own = Defect(hurt.extent, hurt.depth, scene.bearing.outer_raceway_radius, edge)

    def short_of_floor(s: float) -> float:
        phi = np.array([own.center - 0.5 * own.extent + s])
        return float(own.drop(phi, scene.bearing.ball_radius)[0]) - own.depth * (1.0 - 1e-12)

    s_floor = brentq(short_of_floor, 0.0, 0.5 * own.extent, xtol=1e-15)
    corners = (-0.5 * own.extent, s_floor - 0.5 * own.extent)
    balls = own.center - scene.bearing.ball_spacing * np.arange(14)
    known = [balls + side * corner for corner in corners for side in (1.0, -1.0)]
    kinks = path_kinks(scene, 0.0, scene.bearing.ball_spacing)
    inside = np.sort(np.concatenate(known) % TURN)
    inside = inside[inside < scene.bearing.ball_spacing]
    assert kinks == pytest.approx(inside, abs=1e-6)


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
    with pytest.raises(ValueError, match="race is 'middle'; allowed: outer, inner"):
        ball_drop(scene, angle, race="middle")
