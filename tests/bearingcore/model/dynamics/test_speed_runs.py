"""Speed runs: their parts are those of single orbits and motions."""

import math

import numpy as np
import pytest

from bearingcore import presets, simulate, spectrum
from bearingcore.model.dynamics import speed_run

RIG = presets["fan-rig"].replace(contact_damping=130.0)
SPEEDS = 2.0 * math.pi * np.array([7.0, 20.0, 30.0, 60.0])


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
