"""The depth profile: square slot, a ball that sinks no deeper than it."""

import math

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.depth_profile import DepthProfile
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import RoughFloor, presets

FAN_RIG = presets["fan-rig"]
LIEW_LIM = presets["liew-lim"]


@pytest.mark.parametrize("edge", ["published", "chord", "exact"])
@pytest.mark.parametrize("center_deg", [270.0, 2.0, 359.0])
def test_the_slot_is_as_long_and_deep_as_the_defect(edge: str, center_deg: float) -> None:
    scene = FAN_RIG.replace(edge=edge, center=math.radians(center_deg))
    shown = Results(scene).profile
    cut = shown.angle[shown.depth > 0.0]
    assert cut[-1] - cut[0] == pytest.approx(math.radians(12.9), abs=1e-6)
    assert 0.5 * (cut[-1] + cut[0]) % (2.0 * math.pi) == pytest.approx(scene.defects[0].center)
    assert set(shown.depth) == {0.0, 50e-6}
    assert np.all(shown.path <= shown.depth + 1e-15)
    assert np.all(np.diff(shown.angle) >= 0.0)


def test_as_in_the_paper_a_ball_does_not_reach_the_floor_of_5_degrees_but_of_20() -> None:
    view = DepthProfile(PackedSource())
    short = Results(LIEW_LIM.replace(extent=math.radians(5.0)))
    long = Results(LIEW_LIM.replace(extent=math.radians(20.0)))
    assert short.profile.path.max() < 50e-6
    assert long.profile.path.max() == pytest.approx(50e-6)
    assert "does not reach the floor of 50 µm" in view.sentence(short)
    assert "reaches its floor of 50 µm" in view.sentence(long)


def test_a_rough_floor_is_drawn_as_it_was_cut_and_balls_roll_over_its_peaks() -> None:
    floor = RoughFloor(rms_height=5e-6, correlation_length=0.5e-3, seed=3)
    scene = FAN_RIG.replace(extent=math.radians(38.6), floor=floor)
    shown = Results(scene).profile
    inside = np.abs(shown.angle - scene.defects[0].center) < math.radians(15.0)
    assert np.std(shown.depth[inside]) == pytest.approx(5e-6, rel=0.5)
    assert np.std(shown.path[inside]) < np.std(shown.depth[inside])
    assert np.all(shown.path[inside] <= shown.depth[inside] + 1e-7)
    assert "up to" in DepthProfile(PackedSource()).sentence(Results(scene))
