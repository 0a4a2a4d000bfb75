"""Ways to march balls with mass, held against each other."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import expm

from bearingcore import presets
from bearingcore.bearings.rows import Row
from bearingcore.experiments.ball_steps import swing
from bearingcore.experiments.balls import BALL_METHODS, balls_experiment
from bearingcore.scene.scene import WITH_MASS

FAN_RIG = presets["fan-rig"].replace(contact_damping=122.0)


def test_methods_for_balls_agree_and_too_long_steps_are_shown_as_failed() -> None:
    """RK4 in variables without jumps beats the same steps in velocities; the implicit balls take
    steps at which both blow up.
    """
    found = balls_experiment(FAN_RIG, duration=0.15, steps=(1, 4))
    assert set(found.methods) == set(BALL_METHODS)
    by_step = {(p.method, p.value): p for p in found.points}
    assert by_step["RK4", 1].failed
    assert by_step["RK4 in velocities", 1].failed
    assert not by_step["implicit balls", 1].failed
    band = "0.3-2.1 kHz"
    assert by_step["RK4", 4].errors[band] < 0.05
    assert by_step["RK4", 4].errors[band] < by_step["RK4 in velocities", 4].errors[band]
    assert not by_step["exponential balls", 1].failed
    assert by_step["implicit balls", 4].errors[band] < by_step["implicit balls", 1].errors[band]
    # six ball passes: means over few of them, and the implicit steps have order 1 at a touch
    assert found.references[""].agreement[band] < 1.0
    assert "heavier by a part in ten thousand" in found.text()


def test_contacts_must_stay_in_the_plane() -> None:
    with pytest.raises(ValueError, match="contact angle 0"):
        balls_experiment(presets["liew-lim"])


@pytest.mark.parametrize("stiffness", [0.0, 1e-2, 1e5, 1.16e8, 2e8])
@pytest.mark.parametrize("damping", [0.0, 1e-3, 488.0, 2.0 * math.sqrt(2e8 * 2.1e-3), 5e3])
@pytest.mark.parametrize("time", [1e-9, 2e-6, 1.5e-5])
def test_a_swing_is_that_of_the_matrix_exponential(
    stiffness: float, damping: float, time: float
) -> None:
    """Way, speed and the force that acts beside spring and damper, in one linear system."""
    mass, speed, force = 2.1e-3, 0.07, 3.0
    drive = (force + damping * speed) / mass
    A = np.array([[0.0, 1.0, 0.0], [-stiffness / mass, -damping / mass, drive], [0.0, 0.0, 0.0]])
    scale = np.array([1e-6, 0.1, 1.0])
    start = np.array([0.0, speed, 1.0]) / scale
    way, after, _ = scale * (expm(time * A * scale / scale[:, None]) @ start)
    found = swing(force, stiffness, damping, mass, speed, time)
    assert found[0] == pytest.approx(way, rel=1e-5, abs=1e-5 * time * speed)
    assert found[1] == pytest.approx(after, rel=1e-5, abs=1e-5 * speed)


@pytest.mark.parametrize("method", ["implicit balls", "exponential balls"])
def test_steps_of_the_balls_alone_have_order_2_while_all_stay_in_touch(method: str) -> None:
    """Pressed from all sides, no contact opens; the ring swings after a push. RK4 is the truth."""
    scene = FAN_RIG.healthy().replace(balls=WITH_MASS, fy=-100.0)
    bearing = scene.bearing
    tight = bearing.replace(rows=(Row(clearance=-2e-5),))
    scene = scene.replace(bearing=tight, fx=20.0)
    rate, n = 65536.0, 0.004

    def ways(stride: int, name: str) -> np.ndarray:
        march = BALL_METHODS[name](scene.replace(shaft_speed=3000.0), stride, n, rate)
        assert not march.failure
        return march.history[:, [0, 3]]

    truth = ways(128, "RK4")
    errors = [np.abs(ways(stride, method) - truth).max() for stride in (16, 32, 64)]
    for coarse, fine in pairwise(errors):
        assert coarse / fine == pytest.approx(4.0, rel=0.15)
