"""Loads that tire the races of a 6205 with a damaged inner race, by brute force."""

import math

import numpy as np
import pytest

from bearingcore import life, presets
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
    phi = cage[:, None] + 2.0 * math.pi * np.arange(9) / 9
    away = np.remainder(phi - defect.center - shaft[:, None] + math.pi, 2.0 * math.pi) - math.pi
    s = np.maximum(0.5 * defect.extent - np.abs(away), 0.0)
    R, r = b.inner_raceway_radius, 0.5 * b.ball_diameter
    under = np.maximum(r**2 - (R * np.sin(s)) ** 2, 0.0)
    drop = np.where(under > 0.0, R + r - (R * np.cos(s) + np.sqrt(under)), np.inf)
    d = np.minimum(drop, defect.depth) * damaged
    e = np.stack([np.cos(phi), np.sin(phi)], axis=2)
    q = np.tile([0.0, -2.0 * b.radial_clearance - 15e-6], (len(cage), 1))
    for _ in range(60):
        pressed = np.maximum(np.einsum("njd,nd->nj", e, q) - b.radial_clearance - d, 0.0)
        rest = np.einsum("njd,nj->nd", e, K * pressed**1.5) - [0.0, -1000.0]
        bend = np.einsum("njd,nj,nje->nde", e, 1.5 * K * pressed**0.5, e) + 1e3 * np.eye(2)
        q -= 0.7 * np.linalg.solve(bend, rest[:, :, None])[:, :, 0]
    assert np.abs(rest).max() < 1e-3
    return np.asarray(K * pressed**1.5)


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
    found = life(SCENE, 14e3)
    assert (found.inner_load, found.outer_load) == pytest.approx((294.76, 308.19), rel=2e-4)
    assert found.share_of_healthy == pytest.approx(0.92893, rel=2e-4)
    assert "That is 92.9 % of the healthy bearing's life." in found.sentence
    Q_ei, Q_ee = tiring(damaged=True)
    assert (found.inner_load, found.outer_load) == pytest.approx((Q_ei, Q_ee), rel=2e-3)
    sound = tiring(damaged=False)
    rated = found.inner_rating, found.outer_rating

    def failing(loads: tuple[float, float]) -> float:
        return sum((Q / Q_c) ** (P * E) for Q, Q_c in zip(loads, rated, strict=True))

    share = (failing((Q_ei, Q_ee)) / failing(sound)) ** (-1.0 / E)
    assert found.share_of_healthy == pytest.approx(share, rel=2e-3)
