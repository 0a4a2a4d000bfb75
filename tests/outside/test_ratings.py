"""Factors of load ratings as ISO 281 and ISO 76 print them."""

import math

import numpy as np
import pytest

from bearingcore import Bearing, dynamic_load_rating, read_designation
from bearingcore.bearings import Row
from bearingcore.bearings._ratings import self_aligning_capacity_factor, static_factor
from tests.outside.witness import witness

BALLS = (
    *(29.1, 35.8, 40.3, 43.8, 46.7, 49.1, 51.1, 52.8, 54.3, 55.5, 56.6, 57.5, 58.2, 58.8, 59.3),
    *(59.6, 59.8, 59.9, 60.0, 59.9, 59.8, 59.6, 59.3, 59.0, 58.6, 58.2, 57.7, 57.1, 56.6, 56.0),
    *(55.3, 54.6, 53.9, 53.2, 52.4, 51.7, 50.9, 50.0, 49.2, 48.4),
)
"""f_c of ISO 281, Table 2, at D cos α/D_pw = 0.01, 0.02, ... 0.40; also in the public program whose
function is `sfereRadiali`."""

DOUBLE_ROWS = {
    0.05: 44.2, 0.06: 46.5, 0.08: 50.0, 0.10: 52.6, 0.12: 54.5, 0.16: 56.5, 0.20: 56.8,
    0.24: 55.9, 0.28: 54.1, 0.32: 51.8, 0.36: 48.9, 0.40: 45.8,
}  # fmt: skip
"""f_c of ISO 281, Table 2, for two rows of deep groove balls; elsewhere 0.90/0.95 of BALLS."""

ROLLERS = (
    *(52.1, 60.8, 66.5, 70.7, 74.1, 76.9, 79.2, 81.2, 82.8, 84.2, 85.4, 86.4, 87.1, 87.7, 88.2),
    *(88.5, 88.7, 88.8, 88.8, 88.7, 88.5, 88.2, 87.9, 87.5, 87.0, 86.4, 85.8, 85.2, 84.5, 83.8),
)
"""f_c of ISO 281, Table 7, at 0.01, 0.02, ... 0.30; also in a public program's function `F04`."""

STATIC = (
    *(14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9, 15.6, 15.4, 15.2),
    *(14.9, 14.7, 14.4, 14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8, 12.5, 12.3, 12.1, 11.8, 11.6),
    *(11.4, 11.2, 10.9, 10.7, 10.5, 10.3, 10.0, 9.8, 9.6, 9.4),
)
"""f_0 of ISO 76, Table 1, at 0.01, 0.02, ... 0.40 (`sfereRadiali` has 15.7 for 15.9 at 0.06)."""


@witness(
    "function: dynamic_load_rating",
    by="f_c of ISO 281, 21 values",
    compared="ratings of six balls",
    within=2.5e-3,
)
def test_dynamic_ratings_of_balls() -> None:
    """C_r = 1.3 f_c Z^(2/3) D^1.8 of 6 balls of 10 mm."""
    for k, factor in enumerate(BALLS, 1):
        bearing = Bearing.from_drawing(6, 10e-3, 1.0 / k, 5.2e-3, 5.3e-3, contact_angle=0.0)
        printed = 1.3 * factor * 6 ** (2 / 3) * 10**1.8
        assert dynamic_load_rating(bearing) == pytest.approx(printed, rel=2.5e-3), k


@witness(
    "function: dynamic_load_rating", "rows bearing: life",
    by="f_c of ISO 281 for two rows of radial contact, twelve values",
    compared="ratings of two rows, of 6 balls each: 1.539 times those of one", within=3e-3,
)  # fmt: skip
def test_dynamic_ratings_of_two_rows_of_deep_groove_balls() -> None:
    """At an angle they share a load better: 2^0.7 of one row."""
    for gamma, factor in DOUBLE_ROWS.items():
        one = Bearing.from_drawing(6, 10e-3, 10e-3 / gamma, 5.2e-3, 5.3e-3, contact_angle=0.0)
        two = one.replace(rows=(Row(-8e-3), Row(8e-3)))
        printed = 1.3 * factor * 2**0.7 * 6 ** (2 / 3) * 10**1.8
        assert dynamic_load_rating(two) == pytest.approx(printed, rel=3e-3), gamma
        assert dynamic_load_rating(two) == pytest.approx(1.539 * dynamic_load_rating(one), rel=1e-3)
        angled = two.replace(contact_angle=0.4), one.replace(contact_angle=0.4)
        ratings = [dynamic_load_rating(bearing) for bearing in angled]
        assert ratings[0] == pytest.approx(2**0.7 * ratings[1])


@witness(
    "function: dynamic_load_rating",
    by="Lundberg and Palmgren's formula (ISO/TR 1281-1) for a sphere as outer race, times 40.2",
    compared="f_c of self-aligning bearings at 71 values", within=4e-3,
)  # fmt: skip
def test_factors_of_self_aligning_bearings() -> None:
    """Grooves of 0.53 diameters; the sphere about the bearing's middle touches the ball."""
    for gamma in np.arange(10, 81) / 200.0:  # half of them between those of the table
        groove, sphere = 0.53, 0.5 * (1.0 + 1.0 / gamma)
        closeness = groove / sphere * (2.0 * sphere - 1.0) / (2.0 * groove - 1.0)
        races = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * closeness**0.41
        size = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)
        factor = 40.2 * size * (2.0 * groove / (2.0 * groove - 1.0)) ** 0.41
        factor *= (1.0 + races ** (10.0 / 3.0)) ** -0.3
        assert self_aligning_capacity_factor(gamma) == pytest.approx(factor, rel=4e-3), gamma


@witness(
    "function: dynamic_load_rating",
    by="f_c of ISO 281, nine values",
    compared="ratings of six rollers",
    within=2e-3,
)
def test_dynamic_ratings_of_rollers() -> None:
    """C_r = 1.1 f_c (l cos α)^(7/9) Z^(3/4) D^(29/27) of 6 rollers of 10 × 15 mm."""
    for k, factor in enumerate(ROLLERS, 1):
        bearing = Bearing.cylindrical(6, 10e-3, 15e-3, 1.0 / k)
        printed = 1.1 * factor * 15 ** (7 / 9) * 6**0.75 * 10 ** (29 / 27)
        assert dynamic_load_rating(bearing) == pytest.approx(printed, rel=2e-3), k


def test_static_factors() -> None:
    for k, factor in enumerate(STATIC, 1):
        assert float(static_factor(0.01 * k)) == pytest.approx(factor, abs=0.065), k
    assert math.isclose(float(static_factor(0.095)), 16.45, abs_tol=0.065)


def test_grooves_of_bearings_by_number_are_those_that_the_factors_are_for() -> None:
    """ISO 281, f_c: at most 0.52 D and 0.53 D of grooves, 0.53 D of self-aligning inner rings."""
    aligning, groove = (read_designation(one).bearing for one in ("1208", "6208"))
    assert aligning.groove_radius("inner") == pytest.approx(0.53 * aligning.ball_diameter)
    for race, ratio in (("inner", 0.52), ("outer", 0.53)):
        assert groove.groove_radius(race) == pytest.approx(ratio * groove.ball_diameter)
