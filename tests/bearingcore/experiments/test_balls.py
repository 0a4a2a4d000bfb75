"""Ways to march balls with mass, held against each other."""

import pytest

from bearingcore import presets
from bearingcore.experiments.balls import BALL_METHODS, NO_MASS, balls_experiment
from tests.helpers.timing import measure_once

FAN_RIG = presets["fan-rig"].replace(contact_damping=122.0)


@pytest.fixture(autouse=True)
def timed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Work is not repeated for the sake of its time."""
    measure_once(monkeypatch)


@pytest.mark.proof
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


def test_massless_balls_are_held_against_heavy_ones_in_five_directions_too() -> None:
    found = balls_experiment(presets["liew-lim"], duration=0.05, steps=(10, 20))
    reference = found.references[""]
    assert reference.trusted, reference.sentence
    (massless,) = found.of(NO_MASS)
    assert massless.errors["5-10 kHz"] > 3.0, "the balls ring there"
    default, finer = found.of("RK4")
    assert default.in_use
    assert default.errors["0.3-2.1 kHz"] < massless.errors["0.3-2.1 kHz"]
    assert finer.errors["5-10 kHz"] < default.errors["5-10 kHz"] < 3.0


def test_what_has_no_heavy_balls_is_refused_in_words() -> None:
    with pytest.raises(ValueError, match="no model with the mass of tapered rollers: a rib holds"):
        balls_experiment(presets["30206-back-to-back"])
    with pytest.raises(ValueError, match="x or y among them"):
        balls_experiment(presets["liew-lim"].replace(dofs=("z",)))
    with pytest.raises(ValueError, match="above 0"):
        balls_experiment(FAN_RIG.replace(shaft_speed=0.0))
