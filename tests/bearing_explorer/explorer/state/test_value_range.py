"""Values that quantities run through: judged, evenly spaced, coarse ones among the fine ones."""

import math

import numpy as np
import pytest
from bearing_explorer.explorer.state.field_values import limits_of
from bearing_explorer.explorer.state.value_range import SWEEPABLE, sweep, usual_range
from hypothesis import given, strategies as st

from bearingcore import presets

RIG = presets["fan-rig"]
LIMITS = limits_of(RIG)


def test_values_are_taken_as_typed_and_go_to_the_core_in_si() -> None:
    speeds = sweep("shaft_speed_hz", "5", "30,5", 11, LIMITS)
    np.testing.assert_allclose(speeds.values, np.linspace(5.0, 30.5, 11))
    field, values = speeds.in_si
    assert field == "shaft_speed"
    np.testing.assert_allclose(values, 2.0 * math.pi * speeds.values)


def test_balls_come_whole() -> None:
    balls = sweep("n_balls", "7", "16", 4, LIMITS)
    assert balls.values.tolist() == [7.0, 10.0, 13.0, 16.0]
    assert balls.every(7) is balls


@pytest.mark.parametrize(
    ("name", "first", "last", "words"),
    [
        ("shaft_speed_hz", "0", "30", "must turn"),
        ("shaft_speed_hz", "30", "5", "greater"),
        ("shaft_speed_hz", "fast", "30", "not a number"),
        ("shaft_speed_hz", "1", "1e9", "out of range"),
        ("cage_angle_deg", "1", "5", "no such"),
        ("__class__", "1", "5", "no such"),
        ("n_balls", "7.2", "7.9", "whole"),
    ],
)
def test_what_cannot_be_is_refused_with_a_sentence(name, first, last, words) -> None:
    with pytest.raises(ValueError, match=words):
        sweep(name, first, last, 13, LIMITS)


@given(st.sampled_from([13, 25, 49, 97]), st.sampled_from([1, 2, 4, 8]))
def test_coarse_values_are_among_the_fine_ones(count: int, stride: int) -> None:
    fine = sweep("extent_deg", "1", "60", count, LIMITS)
    coarse = fine.every(stride)
    assert set(coarse.values) <= set(fine.values)
    assert coarse.values[[0, -1]].tolist() == [1.0, 60.0]
    np.testing.assert_allclose(np.diff(coarse.values), np.diff(coarse.values)[0])


@pytest.mark.parametrize("preset", list(presets))
def test_every_quantity_has_a_range_to_begin_with(preset: str) -> None:
    limits = limits_of(presets[preset])
    for name in SWEEPABLE:
        low, high = usual_range(name, limits)
        assert low < high
        assert limits[name].least <= low
        assert high <= limits[name].most
