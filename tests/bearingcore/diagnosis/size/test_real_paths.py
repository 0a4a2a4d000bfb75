"""A defect behind all that real paths add at once: its whole ball spacings are found."""

from __future__ import annotations

import math

import pytest

from bearingcore import size_defect
from bearingcore.diagnosis.size.path_fit import DIRECT
from bearingcore.diagnosis.size.variants import STEADY, PathTolerances
from tests.helpers.path_effects import PathEffects, recorded_through
from tests.helpers.recordings import RIG


def test_each_tolerance_can_be_switched_off() -> None:
    assert STEADY.models == (DIRECT,)
    assert len(PathTolerances().models) == 2
    only_strikes = PathTolerances(resonances=False).models[1]
    assert only_strikes.strength == 0.0
    assert only_strikes.strike > 0.0


def test_a_defect_is_sized_behind_a_wandering_cage_and_a_ringing_path() -> None:
    scene = RIG.replace(extent=math.radians(44.4), fy=-160.0, shaft_speed=2.0 * math.pi * 12.0)
    recording = recorded_through(scene, PathEffects(), seed=5)
    told = scene.replace(extent=0.5)
    sized = size_defect(recording, told, fault="outer race", support_known=True)
    assert math.degrees(sized.best.extent) == pytest.approx(44.4, abs=1.0)
    assert sized.best.turns == 1
    assert sized.passes.begins is not None
    lost = size_defect(recording, told, fault="outer race", support_known=True, path=STEADY)
    assert lost.passes.begins is None
    assert not lost.conclusive
