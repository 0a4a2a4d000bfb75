"""Maps of stability and speed runs: their parts are those of single orbits and motions."""

import math
import re

import numpy as np
import pytest

from bearingcore import orbit, presets, simulate, spectrum
from bearingcore.dynamics.speed_runs import speed_run
from bearingcore.dynamics.stability_maps import OUTCOMES, regions, stability_map
from bearingcore.dynamics.status import MapOutcome, OrbitStatus

RIG = presets["fan-rig"].replace(contact_damping=130.0)
SPEEDS = 2.0 * math.pi * np.array([7.0, 20.0, 30.0, 60.0])


def test_a_map_is_made_of_orbits() -> None:
    found = stability_map(RIG, ("shaft_speed", SPEEDS), ("extent", np.radians([12.9, 38.6])))
    assert found.completed
    for j, extent in enumerate(found.y):
        for i, speed in enumerate(found.x):
            single = orbit(RIG.replace(shaft_speed=speed, extent=extent))
            assert OUTCOMES[found.outcome[j, i]] == single.status
            assert found.multiplier[j, i] == pytest.approx(single.largest_multiplier, rel=1e-4)
    assert OUTCOMES[found.outcome[0, 2]] == OrbitStatus.UNSTABLE
    assert found.through[0, 2] == "-1"
    assert found.count(OrbitStatus.STABLE) == 7
    assert any("half the ball-pass frequency" in sentence for sentence in regions(found))


def test_a_cancelled_map_says_what_it_lacks() -> None:
    asked = iter([False] * 4 + [True] * 100)
    found = stability_map(
        RIG,
        ("shaft_speed", SPEEDS),
        ("extent", np.radians([12.9, 38.6])),
        cancelled=lambda: next(asked),
    )
    assert not found.completed
    assert 0 < found.count("not computed") < found.multiplier.size
    assert np.all(np.isnan(found.multiplier[found.outcome == OUTCOMES.index("not computed")]))


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        (("shaft_speed", SPEEDS), ("shaft_speed", SPEEDS), "two different names"),
        (("shaft_sped", SPEEDS), ("extent", [0.1, 0.2]), "shaft_sped"),
        (("shaft_speed", [1.0]), ("extent", [0.1, 0.2]), "2 to 1000"),
        (("shaft_speed", SPEEDS), ("extent", [0.1, 9.0]), "extent"),
    ],
)
def test_impossible_maps_are_refused(x, y, words) -> None:
    with pytest.raises(ValueError, match=words):
        stability_map(RIG, x, y)


def test_a_point_that_is_refused_does_not_stop_a_map() -> None:
    """Balls of 9 mm fit on the greater pitch circle only, those of 5 mm on both."""
    rig = RIG.replace(ball_diameter=5e-3)
    sizes = ("ball_diameter", [5e-3, 9e-3])
    found = stability_map(rig, sizes, ("pitch_diameter", [36e-3, 45e-3]))
    assert found.completed
    assert found.count(MapOutcome.REFUSED) == 1
    assert OUTCOMES[found.outcome[0, 1]] == MapOutcome.REFUSED
    assert np.isnan(found.multiplier).tolist() == [[False, True], [False, False]]
    reason = str(found.refusals[0, 1])
    with pytest.raises(ValueError, match=re.escape(reason)):
        rig.replace(ball_diameter=9e-3, pitch_diameter=36e-3)
    assert any(reason in sentence for sentence in regions(found))


def test_a_speed_run_takes_orbits_where_they_are_stable_and_marches_elsewhere() -> None:
    run = speed_run(RIG, SPEEDS)
    assert run.completed
    assert run.from_orbit.tolist() == [True, True, False, True]
    band = (run.frequency >= 300.0) & (run.frequency <= 2100.0)
    for i, speed in enumerate(SPEEDS):
        motion = simulate(RIG.replace(shaft_speed=speed), 2.8)
        late = motion.outer_acceleration[len(motion.time) // 2 :]
        marched = spectrum(late, motion.sample_rate).up_to(run.frequency[-1])
        np.testing.assert_array_equal(marched.frequency, run.frequency)
        heard = marched.density[band] > 1e-4 * marched.density[band].max(axis=0)
        error = 10.0 * np.log10(run.density[i][band][heard] / marched.density[band][heard])
        assert np.abs(error).max() < 0.6  # lines beat otherwise from another phase
        assert np.sqrt(np.mean(error**2)) < 0.15
    assert run.ball_pass_frequency[0] == pytest.approx(40.289, abs=1e-3)


def test_speeds_must_be_above_zero() -> None:
    with pytest.raises(ValueError, match="shaft_speeds"):
        speed_run(RIG, [0.0, 10.0])
