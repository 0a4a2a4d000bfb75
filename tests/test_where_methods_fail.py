"""Two of the paper's formulas that load balls which hang free, and that the program mends."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import Motion, equilibrium, presets, simulate
from tests.helpers.contact_law import Array, Balls, newton
from tests.helpers.recordings import contacts

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
RATE = 65536.0


@pytest.mark.parametrize(
    ("depth_um", "wrong"),
    [(50.0, 0.0), (75.0, 0.0), (100.0, 37.712), (200.0, 5580.92), (500.0, 56018.7)],
)
def test_the_printed_distance_loads_balls_that_hang_free(depth_um: float, wrong: float) -> None:
    """From a depth of 2 A0 on, balls over the floor seem to carry load [N].

    Newton's method on the printed formula ends there even when started from the right answer.
    """
    scene = LIEW_LIM.replace(extent=math.radians(40.0), depth=depth_um * 1e-6)
    angles = np.arange(120) * (scene.bearing.ball_spacing / 120)
    right = equilibrium(scene, angles)
    in_defect = scene.defect.path(right.ball_angle, scene.bearing) >= 0.999 * 50e-6
    assert in_defect.any()
    lever = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
    greatest = 0.0
    for i, angle in enumerate(angles):
        balls = Balls(scene, angle, as_printed=True)
        attempt = newton(balls, right.displacement[i] * lever)
        assert not attempt.failure
        greatest = max(greatest, float(balls.ball_load(attempt.q)[in_defect[i]].max(initial=0.0)))
    assert greatest == pytest.approx(wrong, rel=1e-5)
    assert np.all(right.ball_load[in_defect] == 0.0)
    assert right.ball_load.max() == pytest.approx(1388.96, rel=1e-6)


def pushes(motion: Motion) -> tuple[Array, Array]:
    """Least force of a ball [N], and how far from the balls' pushes alone the housing feels [N]."""
    scene, support = motion.scene, motion.scene.support
    x = motion.inner_displacement - motion.outer_displacement
    v = motion.inner_velocity - motion.outer_velocity
    felt = (
        support.outer_mass * motion.outer_acceleration
        + support.damping("xy") * motion.outer_velocity
        + support.stiffness("xy") * motion.outer_displacement
    )
    least, apart = [], []
    for *now, force in zip(motion.time, x, v, felt, strict=True):
        elastic, viscous, rays = contacts(scene, 500.0, *now)
        least.append((elastic + viscous).min())
        apart.append(np.abs(force - rays.T @ np.maximum(elastic + viscous, 0.0)).max())
    return np.array(least), np.array(apart)


def test_the_published_damper_pulls_balls_back() -> None:
    """A ball that leaves with its damper still on is held; with "no tension" it is let go."""
    scene = FAN_RIG.replace(contact_damping=500.0)
    least, apart = pushes(simulate(scene, 0.05, RATE, step_rate=RATE))
    assert least.min() < -0.2
    assert apart.max() > 0.2
    free = simulate(scene.replace(contact_law="no tension"), 0.05, RATE, step_rate=RATE)
    least, apart = pushes(free)
    assert least.min() < -0.2  # the damper would pull, and is not let
    assert apart.max() < 1e-3
