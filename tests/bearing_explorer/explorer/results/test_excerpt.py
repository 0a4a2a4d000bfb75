"""The stretch of a motion that the time view shows."""

import math

import numpy as np
import pytest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.plots.layers import least_and_greatest
from hypothesis import given, strategies as st

from bearingcore import presets

FAN_RIG = presets["fan-rig"]
ONE_PASS = 1.0 / FAN_RIG.bearing.bpfo(FAN_RIG.shaft_speed)


@pytest.fixture(scope="module")
def results() -> Results:
    return Results(FAN_RIG)


def test_it_begins_a_quarter_pass_before_an_entry_and_lasts_one_and_a_half(
    results: Results,
) -> None:
    shown = results.excerpt
    assert shown.time[0] == pytest.approx(-0.25 * ONE_PASS, abs=2e-5)
    assert shown.time[-1] == pytest.approx(1.25 * ONE_PASS, abs=4e-5)
    assert shown.motion_time > 0.7  # after the transient


def test_entry_to_exit_takes_the_time_that_the_paper_gives(results: Results) -> None:
    entry, leaving, following = results.excerpt.events
    assert (entry.enters, leaving.enters, following.enters) == (True, False, True)
    assert entry.time == pytest.approx(0.0, abs=1e-9)
    assert leaving.ball == entry.ball
    assert leaving.time == pytest.approx(math.radians(12.9) / FAN_RIG.cage_speed)
    assert leaving.time == pytest.approx(0.01245, abs=5e-6)
    assert following.time == pytest.approx(ONE_PASS)


def test_the_signal_is_the_housing_and_the_loads_are_those_of_the_balls_named(
    results: Results,
) -> None:
    shown, motion = results.excerpt, results.motion
    at = np.searchsorted(motion.time, shown.motion_time + shown.time[0] - 1e-9)
    cut = slice(at, at + shown.time.size)
    np.testing.assert_array_equal(shown.acceleration["y"], motion.outer_acceleration[cut, 1])
    loads = motion.ball_loads()[cut][:, shown.balls]
    np.testing.assert_allclose(shown.ball_load, loads, rtol=0.0, atol=1e-9)


def test_a_healthy_bearing_shows_the_balls_that_carry_most() -> None:
    shown = Results(FAN_RIG.healthy()).excerpt
    assert shown.events == ()
    assert shown.balls.size == 2
    assert shown.static_load.max() == pytest.approx(39.0, abs=0.2)


@given(st.integers(1, 4000), st.integers(1, 300), st.integers(0, 2**32 - 1))
def test_thinning_keeps_the_peaks_and_is_short(n: int, parts: int, seed: int) -> None:
    values = np.random.default_rng(seed).normal(size=(n, 2))
    rows, kept = least_and_greatest(values, parts)
    assert len(rows) == len(kept)
    assert len(kept) <= min(n, 2 * parts)
    assert rows[0] == 0
    assert rows[-1] == n - 1
    assert np.all(np.diff(rows) > 0)
    np.testing.assert_array_equal(kept.min(axis=0), values.min(axis=0))
    np.testing.assert_array_equal(kept.max(axis=0), values.max(axis=0))
