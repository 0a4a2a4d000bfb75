"""Edges, floors and several defects: a ball rolled over every point of a race, one by one."""

import math

import numpy as np
import pytest

from bearingcore import Defect, equilibrium, presets, read_floor
from bearingcore.model.scene import MeasuredFloor, RoughFloor
from bearingcore.model.scene._defect import drop_into
from tests.outside.elements import Defect as Slot, Rows
from tests.outside.witness import witness

R, r = 23.49e-3, 3.97e-3
"""[m] Outer race and ball of the 6205: 0.5 (39.04 + 7.94) and 0.5 · 7.94 mm."""
BASE = presets["6205"].replace(fy=-1000.0)
DOWN = 1.5 * math.pi


def rolled(surface: np.ndarray, at: np.ndarray, phi: np.ndarray) -> np.ndarray:
    """Drop of the centre of a ball at angles phi that rests on points R + surface at angles `at`.

    The centre goes out to ρ cos Δ = … until the nearest point of the race is r away.
    """
    away = at - phi[:, None]
    near = np.abs((R + surface) * np.sin(away)) < r
    race = np.where(near, R + surface, np.nan)
    out = race * np.cos(away) - np.sqrt(r**2 - (race * np.sin(away)) ** 2)
    return np.nanmin(out, axis=1) - (R - r)


def slots(*parts: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Angles and depth of a race with slots (middle, extent, depth)."""
    at = np.linspace(DOWN - 0.6, DOWN + 0.6, 40_001)
    surface = np.zeros(at.size)
    for middle, extent, depth in parts:
        surface[np.abs(at - middle) < 0.5 * extent] = depth
    return at, surface


PHI = np.linspace(DOWN - 0.2, DOWN + 0.2, 161)


@witness(
    "edge: exact", "floor: flat", "defects: several", "race: outer",
    by="a circle rolled over 40,001 points of the race",
    compared="drop of a ball's centre over one slot, two apart, a slot in a slot", within=4e-3,
)  # fmt: skip
@pytest.mark.parametrize(
    "parts",
    [
        [(DOWN, 0.1, 80e-6)],
        [(DOWN - 0.1, 0.08, 60e-6), (DOWN + 0.05, 0.12, 100e-6)],
        [(DOWN, 0.3, 30e-6), (DOWN + 0.02, 0.1, 90e-6)],
    ],
)
def test_balls_over_slots(parts: list[tuple[float, float, float]]) -> None:
    own = rolled(*slots(*parts)[::-1], PHI)
    made = tuple(Defect(extent, depth, middle, edge="exact") for middle, extent, depth in parts)
    drop = drop_into(made, BASE.bearing, PHI)
    assert drop == pytest.approx(own, abs=4e-3 * 100e-6)


@witness(
    "floor: measured", "function: read_floor",
    by="a circle rolled over 40,001 points of the race",
    compared="drop of a ball's centre over a floor of straight pieces, read from text", within=0.01,
)  # fmt: skip
def test_a_measured_floor() -> None:
    text = "angle [degrees]; depth [µm]\n262; 0\n266; 40\n270; 10\n276; 60\n278; 0\n"
    floor, extent, depth, center = read_floor(text)
    at, _ = slots()
    surface = np.interp(np.degrees(at), [262, 266, 270, 276, 278], [0, 40e-6, 10e-6, 60e-6, 0])
    own = rolled(surface, at, PHI)
    hurt = Defect(extent, depth, center, edge="exact", floor=floor)
    assert isinstance(floor, MeasuredFloor)
    assert hurt.path(PHI, BASE.bearing) == pytest.approx(own, abs=0.01 * 60e-6)


@witness(
    "floor: rough",
    by="mean square and correlation of 40 surfaces; a circle rolled over one",
    compared="roughness 4 µm and 1/e at 0.4 mm as asked for; drop of a ball's centre", within=0.03,
)  # fmt: skip
def test_a_rough_floor() -> None:
    floors = [RoughFloor(4e-6, 0.4e-3, seed) for seed in range(40)]
    angle = np.arange(-2.0, 2.0, 0.4e-3 / R / 8)
    heights = np.array([one.surface(angle, 4.1, 1e-3, R) - 1e-3 for one in floors])
    square = np.mean(heights**2)
    assert math.sqrt(square) == pytest.approx(4e-6, rel=0.03)
    assert np.mean(heights[:, 8:] * heights[:, :-8]) / square == pytest.approx(
        math.exp(-1.0), abs=0.03
    )
    at, surface = slots((DOWN, 0.3, 50e-6))
    inside = surface > 0.0
    surface[inside] = floors[3].surface(at[inside] - DOWN, 0.3, 50e-6, R)
    hurt = Defect(0.3, 50e-6, DOWN, edge="exact", floor=floors[3])
    own = rolled(surface, at, PHI)
    assert hurt.path(PHI, BASE.bearing) == pytest.approx(own, abs=0.03 * 50e-6)


@witness(
    "edge: chord",
    by="r − sqrt(r² − R² s²), the circle's own sagitta",
    compared="drop of a ball's centre inside a slot of 4°", within=1e-9,
)  # fmt: skip
def test_chord_edges() -> None:
    hurt = Defect(math.radians(4.0), 1e-3, DOWN, edge="chord")
    s = np.linspace(0.0, math.radians(2.0), 20)
    own = r - np.sqrt(r**2 - (R * s) ** 2)
    assert hurt.path(DOWN + math.radians(2.0) - s, BASE.bearing) == pytest.approx(own, rel=1e-9)


@witness(
    "defects: several", "race: outer",
    by="least energy by SciPy over slots that a circle is rolled over",
    compared="loads of a 6205 over two defects at 20 cage angles", within=2e-3,
)  # fmt: skip
@pytest.mark.proof
def test_loads_over_two_defects() -> None:
    parts = [(DOWN - 0.1, 0.08, 6e-6), (DOWN + 0.05, 0.12, 10e-6)]
    K = BASE.bearing.load_deflection_factor  # held by test_hertz
    dense = np.linspace(DOWN - 0.25, DOWN + 0.25, 2001)
    drops = rolled(*slots(*parts)[::-1], dense)

    class Rolled(Slot):
        def drop(self, phi: np.ndarray, ball: float) -> np.ndarray:
            return np.interp(phi % (2.0 * math.pi), dense, drops, 0.0, 0.0)

    rows = Rows(
        9, 7.94e-3, 0.0, 19.52e-3, 4e-4, 5e-6, (K, 1.5), defect=Rolled(0.0, 0.0, R)
    )  # fmt: skip
    cage = np.linspace(0.0, 2.0 * math.pi / 9, 20)
    force = np.array([0.0, -1000.0, 0.0, 0.0, 0.0])
    loads = [rows.load(rows.rest(force, one, [0, 1]), one) for one in cage]
    made = tuple(Defect(extent, depth, middle, edge="exact") for middle, extent, depth in parts)
    actual = equilibrium(BASE.replace(defect=made), cage).ball_load
    assert actual == pytest.approx(np.array(loads), abs=2e-3 * actual.max())
