"""A repeated orbit is the motion that a march settles to."""

import numpy as np
import pytest

from bearingcore import orbit, presets, simulate, spectrum
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.orbit import NO_PERIOD
from bearingcore.dynamics.repeated import repeated
from bearingcore.plan import SETTLED, plan
from bearingcore.plan.pilot import BAND, spectra_apart


@pytest.mark.parametrize("sample_rate", [65536.0, 16384.0])
def test_it_is_what_a_march_settles_to(sample_rate: float) -> None:
    scene = presets["fan-rig"]
    found = orbit(scene)
    motion = repeated(found, 1.0, sample_rate)
    assert motion.sample_rate == pytest.approx(sample_rate, rel=0.05)
    assert motion.time[-1] == pytest.approx(1.0, abs=2.0 / sample_rate)
    marched = simulate(scene, 1.0)
    last = slice(int(0.8 * motion.time.size), None)
    time = motion.time[last]
    for name in ("inner_displacement", "outer_acceleration"):
        ours, theirs = getattr(motion, name)[last], getattr(marched, name)
        for axis in range(2):
            expected = np.interp(time, marched.time, theirs[:, axis])
            # lines between samples, and steps that fall elsewhere
            off = np.abs(ours[:, axis] - expected).max() / np.ptp(expected)
            assert off < (5e-3 if "displacement" in name else 5e-2)
    assert motion.ball_loads(0, 50).shape == (50, 14)
    density = spectrum(motion.outer_acceleration, motion.sample_rate).density
    assert np.isfinite(density).all()


def test_every_period_is_alike_also_in_tilts() -> None:
    scene = presets["liew-lim"]
    found = orbit(scene)
    motion = repeated(found, 3.0 * found.period)
    period = round(found.period * motion.sample_rate)
    np.testing.assert_array_equal(
        motion.outer_acceleration[:period], motion.outer_acceleration[period : 2 * period]
    )
    np.testing.assert_allclose(
        motion.inner_displacement[:period],
        found.inner_displacement(motion.time[:period]),
        rtol=1e-9,
        atol=1e-18,
    )


def test_no_orbit_is_refused() -> None:
    scene = presets["liew-lim"].replace(race="inner", shaft_speed=40.0)
    found = orbit(scene)
    assert found.status == NO_PERIOD
    with pytest.raises(ValueError, match="an orbit that was found"):
        repeated(found, 1.0)


@pytest.mark.parametrize("name", ["fan-rig", "6205"])
def test_it_is_as_exact_as_the_plan_of_its_orbit_promises(name: str) -> None:
    """Held against a march with short steps, which has its samples at the same places.

    The fan rig's orbit has fewer steps than samples, that of the 6205 more.
    """
    scene = presets[name]
    made = plan(scene, SETTLED)
    assert made.orbit is not None
    motion = repeated(made.orbit, 0.7)
    rate, ours = motion.sample_rate, motion.outer_acceleration
    settled = 20.0 * made.orbit.period * rate  # samples
    assert settled == pytest.approx(round(settled), abs=1e-6)
    marched = simulate(scene, (round(settled) + len(ours)) / rate, rate, step_rate=4.0 * rate)
    theirs = marched.outer_acceleration[round(settled) :][: len(ours)]
    off = spectra_apart(ours, theirs, rate, BAND * highest_natural_frequency(scene))
    assert off <= made.predicted_error <= made.error_budget
