"""Ways to march balls with mass, held against each other."""

from __future__ import annotations

import pytest

from bearingcore import presets
from bearingcore.experiments.balls import BALL_METHODS, NO_MASS, balls_experiment

FAN_RIG = presets["fan-rig"].replace(contact_damping=122.0)


def test_methods_for_balls_agree_and_too_long_steps_are_shown_as_failed() -> None:
    """RK4 in variables without jumps beats the same steps in velocities."""
    found = balls_experiment(FAN_RIG, duration=0.15, steps=(1, 4))
    assert set(found.methods) == {NO_MASS, *BALL_METHODS}
    (massless,) = found.of(NO_MASS)
    assert massless.errors["5-10 kHz"] > 3.0, "the balls ring there"
    by_step = {(p.method, p.value / 65536.0): p for p in found.points}
    assert by_step["RK4", 1].failed
    assert by_step["RK4 in velocities", 1].failed
    band = "0.3-2.1 kHz"
    assert by_step["RK4", 4].errors[band] < 0.05
    assert by_step["RK4", 4].errors[band] < by_step["RK4 in velocities", 4].errors[band]
    # six ball passes: means over few of them
    assert found.references[""].agreement[band] < 1.0
    assert "heavier by a part in ten thousand" in found.references[""].sentence


def test_contacts_must_stay_in_the_plane() -> None:
    with pytest.raises(ValueError, match="contact angle 0"):
        balls_experiment(presets["liew-lim"])
