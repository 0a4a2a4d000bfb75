"""A defect that turns with the shaft: what is said of it is over all turns, wherever it began.

Numbers that an independent program found, and a computation of its own: `plane.py`, the
equations of Petersen, Howard & Prime (2014) for many angles at once.
"""

import math

import numpy as np
import pytest

from bearingcore import (
    Defect,
    Scene,
    contact_pressures,
    equilibrium,
    frequency_bands,
    limits,
    presets,
)
from bearingcore.model.statics import BALL_LOAD, static_ranges
from bearingcore.model.sweeps import Grid
from tests.outside.elements import point_contact
from tests.outside.plane import Plane, undamped
from tests.outside.witness import witness

FAN = presets["fan-rig"].replace(race="inner")
DEEP_GROOVE = presets["6205"].replace(
    race="inner", extent=math.radians(8.0), depth=100e-6, edge="exact", fy=-1000.0, fz=0.0
)
TURNS, ANGLES = 80, 20_000


@witness(
    "race: inner",
    "function: frequency_bands",
    by="an independent program over 60 turns (review of 26 November 2026)",
    compared="band of x₁",
    within=0.002,
)
@pytest.mark.parametrize("center", [270.0, 0.0, 90.0, 280.0])
def test_the_fan_rigs_band_is_that_of_many_turns(center: float) -> None:
    """An independent program over 60 turns: x₁ 298.3 to 480.3 Hz, whatever the centre."""
    low, high = frequency_bands(FAN.replace(center=math.radians(center)))["x1"]
    assert low == pytest.approx(298.3, rel=2e-3)
    assert high == pytest.approx(480.3, rel=2e-3)


@witness(
    "race: inner",
    "edge: exact",
    "output: band_*",
    "output: k_xx_least",
    "output: ball_load_greatest",
    "output: loaded_balls_least",
    by="an independent program over 60 turns",
    compared="band, least stiffness, greatest load, least number of loaded balls",
    within=0.005,
)
def test_a_deep_groove_bearing_over_many_turns() -> None:
    """The same: x₁ 376 to 774 Hz, k_xx 12.1 MN/m at the least, 803 N on a ball, 2 balls loaded."""
    assert frequency_bands(DEEP_GROOVE)["x1"] == pytest.approx((376.0, 774.0), rel=2e-3)
    grid = Grid.of(
        DEEP_GROOVE, {"fz": [0.0]}, ["k_xx_least", "ball_load_greatest", "loaded_balls_least"]
    )
    _, numbers = grid.compute()
    assert numbers["k_xx_least"][0] == pytest.approx(12.1e6, rel=5e-3)
    assert numbers["ball_load_greatest"][0] == pytest.approx(803.0, rel=2e-3)
    assert numbers["loaded_balls_least"][0] == 2
    assert contact_pressures(DEEP_GROOVE).ball.load == pytest.approx(803.0, rel=2e-3)
    (pressure,) = [x for x in limits(DEEP_GROOVE) if x.name == "contact pressure, inner race"]
    assert "load 803 N" in pressure.sentence


@witness(
    "race: inner",
    "edge: published",
    "function: frequency_bands",
    by="80 turns at 20,000 angles by `plane.py`",
    compared="bands, least, greatest and mean stiffness, greatest load",
    within=0.01,
)
@pytest.mark.parametrize("center", [0.3, 4.0])
def test_bands_loads_and_stiffness_are_those_of_a_computation_of_its_own(center: float) -> None:
    """80 turns of the fan rig at 20,000 angles; its numbers are those of the paper's Table."""
    plane = Plane(14, 8e-3, 45e-3, 5453e6, 3e-6)
    shaft = np.linspace(0.0, TURNS * 2.0 * math.pi, ANGLES)
    defect = math.radians(12.9), 50e-6, "inner", "published"
    loads, k, _ = plane.solve(100.0, plane.cage * shaft, shaft + center, defect)
    own = undamped(k, 2.0, 212.2e6)
    bands = frequency_bands(FAN)
    for mode, label in enumerate(("x1", "y1", "x2", "y2")):
        ends = own[:, mode].min(), own[:, mode].max()
        assert bands[label] == pytest.approx(ends, rel=5e-3), label
    ranges = static_ranges(FAN, ("k_xx", "k_yy", BALL_LOAD))
    for name, values in (
        ("k_xx", k[:, 0, 0]),
        ("k_yy", k[:, 1, 1]),
        (BALL_LOAD, loads.max(axis=1)),
    ):
        assert ranges.greatest[name] == pytest.approx(values.max(), rel=0.01), name
        if name != BALL_LOAD:
            assert ranges.least[name] == pytest.approx(values.min(), rel=0.01), name
            mean = ranges.mean(ranges.state.term(name))
            assert mean == pytest.approx(values.mean(), rel=5e-3), name
    some = np.full(len(ranges.state.shares), 7.0)
    some[::3] = math.nan
    assert ranges.mean(some) == pytest.approx(7.0), "what is not known does not count"


def test_exact_edges_of_a_deep_groove_bearing_by_the_same_computation() -> None:
    """6205 of its drawing: Hertz's K by elliptic integrals, a ball on a convex race's corner."""
    ball, pitch = 7.94e-3, 39.04e-3
    factors = [
        point_contact(ball, -1.0 / (groove * ball), side / (0.5 * (pitch - side * ball)))[0]
        for groove, side in ((0.52, 1.0), (0.53, -1.0))
    ]
    plane = Plane(9, ball, pitch, sum(one ** (-2.0 / 3.0) for one in factors) ** -1.5, 5e-6)
    shaft = np.linspace(0.0, TURNS * 2.0 * math.pi, ANGLES)
    defect = math.radians(8.0), 100e-6, "inner", "exact"
    loads, k, _ = plane.solve(1000.0, plane.cage * shaft, shaft + 1.0, defect)
    ranges = static_ranges(DEEP_GROOVE, ("k_xx", "k_yy", BALL_LOAD))
    assert ranges.greatest[BALL_LOAD] == pytest.approx(loads.max(), rel=0.01)
    for i, name in enumerate(("k_xx", "k_yy")):
        values = k[:, i, i]
        ends = ranges.least[name], ranges.greatest[name]
        assert ends == pytest.approx((values.min(), values.max()), rel=0.01), name
        assert ranges.mean(ranges.state.term(name)) == pytest.approx(values.mean(), rel=5e-3)


def of_two_balls(plane: Plane, load: float, defect: tuple[float, float, str, str]) -> np.ndarray:
    """Mean k_xx, k_yy [N/m] of rigid rings in which two balls carry, over all positions.

    One ball on either side of the load's line: the pair of least Σ Q (clearance + drop), the loads
    by statics alone, and of each k = 3/2 K^(2/3) Q^(1/3) e e'.
    """
    extent, depth, race, edge = defect
    spacing, n, near = 2.0 * math.pi / plane.balls, 40, 12
    part = (np.arange(n) + 0.5) / n * spacing
    cage = (part[:, None] + spacing * np.arange(plane.balls)).ravel()
    cage, shaft = (one.ravel() for one in np.meshgrid(cage, part))
    before = np.reshape((1.5 * math.pi - cage) % spacing, (-1, 1))
    a, b = before + spacing * np.arange(near), spacing - before + spacing * np.arange(near)
    gaps = []
    for aside in (-a, b):
        away = 1.5 * math.pi + aside - (cage + shaft)[:, None]
        away = (away + math.pi) % (2.0 * math.pi) - math.pi
        gaps.append(plane.clearance + plane.drop(0.5 * extent - np.abs(away), race, edge, depth))
    a, b = a[:, :, None], b[:, None, :]
    first, second = (load * np.sin(other) / np.sin(a + b) for other in (b, a))
    work = first * gaps[0][:, :, None] + second * gaps[1][:, None, :]
    work = np.where((a < 1.5) & (b < 1.5), work, np.inf).reshape(cage.size, -1)
    at = np.arange(cage.size), work.argmin(axis=1)
    pairs = [
        (np.broadcast_to(one, first.shape).reshape(cage.size, -1)[at], Q.reshape(cage.size, -1)[at])
        for one, Q in ((a, first), (b, second))
    ]
    return np.array(
        [
            sum((1.5 * plane.K ** (2 / 3) * Q ** (1 / 3) * e(x) ** 2).mean() for x, Q in pairs)
            for e in (np.sin, np.cos)
        ]
    )


@witness(
    "race: inner",
    by="rigid rings on two balls, by statics alone, over 40 cage and 40 shaft angles a spacing",
    compared="mean k_xx and k_yy under a load so light that clearance decides which balls carry",
    within=0.01,
)
@pytest.mark.parametrize(("balls", "ball", "extent"), [(30, 4e-3, 20.0), (14, 8e-3, 13.4)])
def test_a_light_load_in_a_clearance(balls: int, ball: float, extent: float) -> None:
    plane = Plane(balls, ball, 45e-3, 5453e6, 3e-6)
    own = of_two_balls(plane, 1e-3, (math.radians(extent), 50e-6, "inner", "published"))
    scene = FAN.replace(n_balls=balls, ball_diameter=ball, extent=math.radians(extent), fy=-1e-3)
    ranges = static_ranges(scene, ())
    means = [ranges.mean(ranges.state.term(name)) for name in ("k_xx", "k_yy")]
    assert means == pytest.approx(own, rel=0.01)


SCENES = {
    "fan rig": FAN,
    "exact edges": DEEP_GROOVE,
    "thrust": presets["liew-lim"].replace(race="inner"),
    "both races": FAN.replace(defect=(FAN.defects[0], Defect(0.2, 50e-6, math.radians(250.0)))),
    "two on one race": FAN.replace(
        defect=(FAN.defects[0], Defect(0.1, 30e-6, math.radians(80.0), "inner"))
    ),
    "two rows": presets["7208-back-to-back"].replace(race="inner", extent=0.15),
}


def turned(scene: Scene, angle: float) -> Scene:
    """The scene with its defects of the inner race elsewhere by an angle [rad]."""
    defects = [
        Defect(d.extent, d.depth, d.center + angle * (d.race == "inner"), d.race, d.edge)
        for d in scene.defects
    ]
    return scene.replace(defect=tuple(defects))


@pytest.mark.parametrize("name", SCENES)
def test_nothing_depends_on_where_the_defect_began(name: str) -> None:
    """An invariance: in time the shaft is at every angle to the cage."""
    scene = turned(SCENES[name], 0.0)
    first, second = (
        static_ranges(one, ("k_xx", "k_yy", BALL_LOAD)) for one in (scene, turned(scene, 1.234))
    )
    for term in ("k_xx", "k_yy", BALL_LOAD):
        assert first.least[term] == pytest.approx(second.least[term], rel=2e-3), term
        assert first.greatest[term] == pytest.approx(second.greatest[term], rel=2e-3), term
    for term in ("k_xx", "k_yy"):
        means = [one.mean(one.state.term(term)) for one in (first, second)]
        assert means[0] == pytest.approx(means[1], rel=2e-3), term


@pytest.mark.parametrize("name", SCENES)
def test_many_turns_one_after_the_other_go_no_farther(name: str) -> None:
    """80 turns at 60,000 angles, solved one after the other: within 1 %."""
    scene = SCENES[name]
    cage = np.linspace(0.0, TURNS * 2.0 * math.pi * scene.bearing.cage_ratio, 60_000)
    state = equilibrium(scene, cage)
    ranges = static_ranges(scene, ("k_xx", "k_yy", BALL_LOAD))
    for term in ("k_xx", "k_yy"):
        values = state.term(term)
        assert ranges.least[term] == pytest.approx(values.min(), rel=0.01), term
        assert ranges.greatest[term] == pytest.approx(values.max(), rel=0.01), term
        assert ranges.mean(ranges.state.term(term)) == pytest.approx(values.mean(), rel=5e-3), term
    assert ranges.greatest[BALL_LOAD] == pytest.approx(state.ball_load.max(), rel=2e-3)


def test_shaft_and_cage_may_be_at_any_angle() -> None:
    """Turning everything by a ball spacing changes nothing; a cage a spacing on is the same one."""
    cage, shaft = np.array([0.1, 0.2, 0.3]), np.array([5.0, 0.4, 2.0])
    first = equilibrium(FAN, cage, shaft_angles=shaft)
    other = equilibrium(
        FAN, cage + 3.0 * FAN.bearing.ball_spacing, shaft_angles=shaft + 2.0 * math.pi
    )
    np.testing.assert_allclose(first.stiffness, other.stiffness, rtol=1e-6, atol=1.0)
    np.testing.assert_allclose(first.shaft_angles, shaft, rtol=1e-12)
    with pytest.raises(ValueError, match="shaft_angles"):
        equilibrium(FAN, cage, shaft_angles=shaft[:2])
