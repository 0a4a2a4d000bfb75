"""Loads that tire the races of a 6205 with a damaged inner race, by brute force."""

import math

import numpy as np
import pytest

from bearingcore import life, presets
from tests.outside.plane import Plane
from tests.outside.test_hertz import both
from tests.outside.witness import witness

SCENE = presets["6205"].replace(
    race="inner", extent=math.radians(8.0), depth=100e-6, edge="exact", fy=-1000.0
)
P, E = 3.0, 10.0 / 9.0


def loads(cage: np.ndarray, shaft: np.ndarray, damaged: bool) -> np.ndarray:
    """Ball loads (n, 9) [N] in the plane, by Newton; a ball on the corner of a convex race."""
    b, defect = SCENE.bearing, SCENE.defect
    K = sum(factor ** (-2.0 / 3.0) for factor, _ in both(b)) ** -1.5
    plane = Plane(9, b.ball_diameter, b.pitch_diameter, K, b.radial_clearance)
    hurt = (damaged * defect.extent, defect.depth, "inner", "exact")
    return plane.solve(1000.0, cage, defect.center + shaft, hurt)[0]


def tiring(damaged: bool, places: int = 64) -> tuple[float, float]:
    """Q_ei, Q_ee [N]: every ball over every place of both races at every angle of the shaft."""
    total = 9 * places
    cage = (np.arange(places) + 0.5) * 2.0 * math.pi / total
    inner, outer = np.zeros(total), np.zeros(total)
    for k in range(0, total, 3):
        Q = loads(cage, np.full(places, 2.0 * math.pi * k / total), damaged)
        at = np.arange(places)[:, None] + places * np.arange(9)
        outer[at] += Q**P
        inner[(at - k) % total] += Q**P
    mean = 3.0 / total
    return tuple(  # type: ignore[return-value]
        float(np.mean((race * mean) ** E) ** (1.0 / (P * E))) for race in (inner, outer)
    )


@witness(
    "race: inner",
    "function: life",
    "output: life_share_of_healthy",
    by="brute force over every place of both races",
    compared="Q_ei 294.76 N, Q_ee 308.19 N, share 0.92893",
    within=2e-3,
)
def test_loads_and_share_by_brute_force() -> None:
    """Q_ei 294.76, Q_ee 308.19 N, 0.92893 of the healthy bearing's life."""
    answer = life(SCENE, 14e3)
    assert (answer.inner_load, answer.outer_load) == pytest.approx((294.76, 308.19), rel=2e-4)
    assert answer.share_of_healthy == pytest.approx(0.92893, rel=2e-4)
    assert "That is 92.9 % of the healthy bearing's life." in answer.sentence
    Q_ei, Q_ee = tiring(damaged=True)
    assert (answer.inner_load, answer.outer_load) == pytest.approx((Q_ei, Q_ee), rel=2e-3)
    sound = tiring(damaged=False)
    rated = answer.inner_rating, answer.outer_rating

    def failing(loads: tuple[float, float]) -> float:
        return sum((Q / Q_c) ** (P * E) for Q, Q_c in zip(loads, rated, strict=True))

    share = (failing((Q_ei, Q_ee)) / failing(sound)) ** (-1.0 / E)
    assert answer.share_of_healthy == pytest.approx(share, rel=2e-3)
