"""A rim that stands above the race: a circle rolled over it, and balls between, by SciPy alone."""

import math

import numpy as np
import pytest
from bearing_explorer import figures
from scipy.optimize import fsolve

from bearingcore import Defect, Scene, equilibrium, presets
from bearingcore.errors import FieldError
from bearingcore.model.scene import MeasuredFloor
from tests.outside.witness import witness

RIG = presets["fan-rig"]
BOTTOM = math.radians(270.0)
DENT = np.radians([-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0]) + BOTTOM
HEIGHTS = 1e-6 * np.array([0.0, -6.0, -2.0, 10.0, 10.0, -2.0, -6.0, 0.0])
RIM = RIG.replace(defect=Defect.measured(DENT, HEIGHTS), fy=-120.0)


def rolled(scene: Scene, angle: float) -> float:
    """Drop [m] of a ball's centre: the farthest out that a circle comes that meets no point."""
    radius, ball = scene.bearing.outer_raceway_radius, scene.bearing.ball_radius
    point = angle + np.linspace(-0.15, 0.15, 60_001)
    at = radius + np.interp(point, DENT, HEIGHTS, left=0.0, right=0.0)
    away = at * np.sin(point - angle)
    near = np.abs(away) < ball
    center = at[near] * np.cos(point[near] - angle) - np.sqrt(ball**2 - away[near] ** 2)
    return float(center.min() - (radius - ball))


def loads(scene: Scene, cage_angle: float) -> np.ndarray:
    """Loads [N] of the balls where the force on the inner ring is carried (Eqs. 13 and 19)."""
    bearing = scene.bearing
    phi = cage_angle + 2.0 * math.pi / bearing.n_balls * np.arange(bearing.n_balls)
    drop = np.array([rolled(scene, angle) for angle in phi])
    across, up = np.cos(phi), np.sin(phi)

    def carried(place: np.ndarray) -> np.ndarray:
        pressed = place[0] * across + place[1] * up - bearing.radial_clearance - drop
        return np.asarray(bearing.load_deflection_factor * np.maximum(pressed, 0.0) ** 1.5)

    def unbalanced(place: np.ndarray) -> np.ndarray:
        load = carried(place)
        return np.array([scene.load.fx - load @ across, scene.load.fy - load @ up])

    return carried(fsolve(unbalanced, [0.0, -7e-6], xtol=1e-13))


@witness(
    "floor: measured",
    by="a circle rolled over the profile point by point, and balls in balance by SciPy's fsolve",
    compared="drop of a ball beside and on a raised rim; loads of all balls", within="0.3 N",
)  # fmt: skip
@pytest.mark.parametrize("ball_at", [-6.0, -5.0, -3.0, -1.5, 0.0, 2.0])
def test_balls_climb_a_rim_before_they_are_over_it(ball_at: float) -> None:
    angle = BOTTOM + math.radians(ball_at)
    drop = RIM.defects[0].path([angle], RIM.bearing)[0]
    assert drop == pytest.approx(rolled(RIM, angle), abs=2e-8)
    state = equilibrium(RIM, [angle])
    assert state.converged.all()
    np.testing.assert_allclose(state.ball_load[0], loads(RIM, angle), atol=0.3)


def test_a_rim_is_felt_and_its_scene_kept_as_text() -> None:
    path = RIM.defects[0].path(BOTTOM + np.radians(np.linspace(-12.0, 12.0, 2001)), RIM.bearing)
    assert path.min() == pytest.approx(-6e-6, rel=2e-3)
    assert path[0] == path[-1] == 0.0
    assert np.abs(np.diff(path)).max() < 1.5e-7, "nothing jumps where the ball begins to climb"
    healthy = equilibrium(RIM.healthy(), [BOTTOM + math.radians(-3.0)])
    raised = equilibrium(RIM, [BOTTOM + math.radians(-3.0)])
    assert raised.ball_load[0, 0] > 1.5 * healthy.ball_load[0, 0]
    assert Scene.from_toml(RIM.to_toml()) == RIM
    drawn = figures.depth_profile(RIM)
    assert "10 µm deep and 6 µm high" in drawn.sentence


def test_shapes_that_cannot_be_are_refused() -> None:
    with pytest.raises(FieldError, match="not 0 everywhere"):
        Defect.measured(DENT, 0.0 * HEIGHTS)
    with pytest.raises(FieldError, match="-1 to 1"):
        MeasuredFloor((-1.0, 0.0, 1.0), (0.0, -1.5, 0.0))
