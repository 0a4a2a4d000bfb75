"""Balls with or without mass: up to where massless ones will do, and what refuses mass."""

import math

from bearingcore import presets, simulate
from bearingcore.model.dynamics import Motion, compare_motions, fine_step_rate, speed_run
from bearingcore.model.scene import MASSLESS, WITH_MASS, Scene
from tests.helpers.simulated import pit

FAN_RIG = presets["fan-rig"].replace(contact_damping=122.0)


def both(scene: Scene) -> tuple[Motion, Motion]:
    """Motions with massless balls and with those that have mass, known up to the same frequency."""
    kinds = (scene.replace(balls=balls) for balls in (MASSLESS, WITH_MASS))
    massless, heavy = (
        simulate(kind, 1.0, step_rate=fine_step_rate(kind, 65536.0)) for kind in kinds
    )
    return massless, heavy


def test_up_to_where_massless_balls_will_do() -> None:
    """Fan rig at 7 Hz: mass adds tenths of a decibel below 5 kHz and 10 dB above."""
    motions = both(FAN_RIG)
    comparison = compare_motions(*motions, budget=1.0)
    assert comparison.added[comparison.edges[:-1] > 8e3].min() > 3.0
    assert 2e3 < comparison.massless_up_to < 8e3
    inside = comparison.edges[1:] <= comparison.massless_up_to
    assert abs(comparison.added[inside]).max() <= 1.0
    assert "massless: within 1 dB up to" in comparison.sentence
    assert "0.1 dB" in compare_motions(*motions).sentence  # as everywhere else
    strict = compare_motions(*motions, budget=1e-6)
    assert math.isnan(strict.massless_up_to)
    assert "off by more than 1·10⁻⁶ dB from 300 Hz on" in strict.sentence


def test_bands_without_power_do_not_count() -> None:
    """A pit under load: sideways next to nothing moves, and below 500 Hz up and down neither."""
    motor = presets["6205"]
    comparison = compare_motions(*both(motor.replace(defect=pit(motor, 5e-4))), budget=1.0)
    assert abs(comparison.added).max() > 1.0
    assert comparison.massless_up_to > 15e3


def test_a_speed_run_marches_balls_with_mass() -> None:
    heavy = FAN_RIG.replace(balls="with mass")
    run = speed_run(heavy, [40.0], duration=0.2)
    assert not run.from_orbit.any()
    assert math.isfinite(run.density.max())
