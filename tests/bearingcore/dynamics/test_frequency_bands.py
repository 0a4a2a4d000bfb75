"""Bands of natural frequencies: what each mode reaches, wherever the samples lie."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import Scene, frequency_bands, modes, presets
from bearingcore.statics.equilibrium import default_cage_angles

RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]
SCENES = {
    "fan rig": RIG,
    "a large defect": RIG.replace(extent=math.radians(38.6)),
    "healthy": RIG.healthy(),
    "five directions": ANGULAR,
    "sideways": RIG.replace(fx=-70.0, fy=-70.0, extent=0.9),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_bands_hold_all_that_very_many_cage_angles_give_and_hardly_more(scene: Scene) -> None:
    found = frequency_bands(scene)
    many = modes(scene, default_cage_angles(scene, 3001)).bands()
    assert list(found) == list(many)
    for label, (low, high) in many.items():
        room = 2e-4 * high  # between 3001 angles there is something too
        assert low - room <= found[label][0] <= low + room, label
        assert high - room <= found[label][1] <= high + room, label


def test_bands_do_not_depend_on_the_samples() -> None:
    spacing = RIG.bearing.ball_spacing
    coarse = modes(RIG, np.linspace(0.0, spacing, 61)).bands()
    ends = [
        frequency_bands(RIG, np.linspace(0.0, spacing, count))["y1"] for count in (61, 121, 361)
    ]
    for found in ends:
        assert found == pytest.approx(ends[-1], rel=1e-4)
    assert abs(coarse["y1"][1] - ends[-1][1]) > 5.0 * abs(ends[0][1] - ends[-1][1])


def test_without_an_answer_there_is_no_band() -> None:
    found = frequency_bands(RIG.replace(fy=0.0))
    assert list(found) == list(frequency_bands(RIG))
    assert np.isnan(list(found.values())).all()
    refused = frequency_bands(RIG, most_contacts=10)
    assert np.isnan(list(refused.values())).all()


def test_a_single_cage_angle_is_a_band_without_width() -> None:
    for label, (low, high) in frequency_bands(RIG, [0.1]).items():
        assert low == high, label
