"""Floors that are not flat, and defects that run into one another."""

import math

import numpy as np
import pytest

from bearingcore import EDGES, RACES, Defect, MeasuredFloor, RoughFloor, equilibrium, presets
from bearingcore.model.scene._defect import drop_into
from bearingcore.sizing import read_floor

pytestmark = pytest.mark.usefixtures("files_read_here")

BEARING = presets["fan-rig"].bearing
ANGLES = np.linspace(-0.4, 0.5, 3001)
# a tabulated path cuts the corner where the ball reaches the floor by at most this much [m]
TABLE_ERROR = 3e-8


@pytest.mark.parametrize("race", RACES)
@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("floor", [RoughFloor(0.0, 1e-3), MeasuredFloor((-1.0, 1.0), (1.0, 1.0))])
def test_a_circle_rolled_over_a_square_slot_takes_the_edge_model(race, edge, floor) -> None:
    flat = Defect(0.5, 50e-6, 0.1, race, edge)
    other = Defect(0.5, 50e-6, 0.1, race, edge, floor)
    np.testing.assert_allclose(
        other.path(ANGLES, BEARING), flat.path(ANGLES, BEARING), rtol=0.0, atol=TABLE_ERROR
    )


@pytest.mark.parametrize("race", RACES)
@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("overlap", [0.0, 0.1])
def test_two_slots_that_touch_are_one(race, edge, overlap) -> None:
    slot = Defect(0.5, 50e-6, 0.1, race, edge)
    half = 0.25 + overlap / 2
    left, right = 0.1 - 0.25 + half / 2, 0.1 + 0.25 - half / 2
    two = tuple(Defect(half, 50e-6, center, race, edge) for center in (left, right))
    np.testing.assert_allclose(
        drop_into(two, BEARING, ANGLES), slot.path(ANGLES, BEARING), rtol=0.0, atol=TABLE_ERROR
    )


def test_a_longer_defect_continues_the_same_surface() -> None:
    floor = RoughFloor(4e-6, 0.4e-3, 3)
    short, long = (Defect(extent, 50e-6, 0.1, floor=floor) for extent in (0.3, 0.6))
    near = np.abs(ANGLES - 0.1) < 0.15
    np.testing.assert_array_equal(
        short.surface(ANGLES[near], BEARING), long.surface(ANGLES[near], BEARING)
    )
    other = Defect(0.3, 50e-6, 0.1, floor=RoughFloor(4e-6, 0.4e-3, 4))
    assert not np.array_equal(other.surface(ANGLES, BEARING), short.surface(ANGLES, BEARING))


@pytest.mark.parametrize(
    "text",
    [
        "angle, depth\n# a comment\n260,0\n265,40\n270,50\n280,0\n",
        "Winkel;Tiefe\n260,0;0,0\n265;40\n270;50,0\n280,0;0\n",
        "260,0 0,0\n265,0 40,0\n270,0 50,0\n280,0 0,0",
        "angle_deg;depth_mm\n260;0\n265;0,04\n270;0,05\n280;0\n",
        "phi [rad],h (nm)\n4.53785606,0\n4.62512252,40000\n4.71238898,50000\n4.88692191,0\n",
    ],
)
def test_a_floor_is_read_from_two_columns(text: str) -> None:
    floor, extent, depth, center = read_floor(text)
    assert math.degrees(extent) == pytest.approx(20.0)
    assert math.degrees(center) == pytest.approx(270.0)
    assert depth == pytest.approx(50e-6)
    defect = Defect(extent, depth, center, floor=floor)
    assert float(defect.surface(math.radians(265.0), BEARING)) == pytest.approx(40e-6)
    assert float(defect.surface(math.radians(275.0), BEARING)) == pytest.approx(25e-6)


def test_a_race_worn_all_round_only_shifts_the_ring() -> None:
    """With no edge left, a depth all around is a clearance: the ball loads stay."""
    scene = presets["fan-rig"]
    angles = np.linspace(0.0, scene.bearing.ball_spacing, 7)
    worn = scene.replace(extent=2.0 * math.pi, depth=20e-6)
    loose = scene.healthy().replace(radial_clearance=23e-6)
    np.testing.assert_allclose(
        equilibrium(worn, angles).ball_load, equilibrium(loose, angles).ball_load, rtol=1e-9
    )


@pytest.mark.parametrize("extent", [1e-6, 1e-9, 1e-320])
def test_a_defect_may_be_tiny_and_rough(extent: float) -> None:
    """The circle of the ball is rolled no farther than the floor is long, or memory would end."""
    scene = presets["fan-rig"].replace(extent=extent, floor=RoughFloor(2e-6, 200e-6))
    healthy = equilibrium(scene.healthy()).ball_load
    np.testing.assert_allclose(equilibrium(scene).ball_load, healthy, rtol=1e-3, atol=1e-3)
