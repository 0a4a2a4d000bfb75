"""Orbits against marching, and the statements of others about where they are stable."""

import math
from typing import Any

import numpy as np
import pytest

from bearingcore import Scene, orbit, presets, simulate
from bearingcore.model.dynamics import OrbitStatus, common_ball_passes
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._orbit import _Shooting, _state_at_start

RIG = presets["fan-rig"].replace(contact_damping=130.0)


def rig_at(shaft_hz: float, extent_deg: float) -> Scene:
    return RIG.replace(shaft_speed=2.0 * math.pi * shaft_hz, extent=math.radians(extent_deg))


def marched_period(scene: Scene, passes: int = 600, longest: int = 12) -> int | None:
    """Ball passes after which a long march repeats itself to 0.2 %, None if more than `longest`."""
    ball_pass = scene.bearing.ball_spacing / scene.cage_speed
    rate = 65536.0 * math.ceil(scene.shaft_speed / (2.0 * math.pi * 30.0))
    motion = simulate(scene, (passes + 2) * ball_pass, rate)
    x, t = motion.inner_displacement, motion.time
    size = np.ptp(x[-len(x) // 20 :], axis=0).max()
    times = np.arange(passes - 40, passes) * ball_pass
    phase = np.stack([np.interp(times, t, x[:, i]) for i in range(x.shape[1])], axis=1)
    for period in range(1, longest + 1):
        if np.abs(phase[period:] - phase[:-period]).max() < 2e-3 * size:
            return period
    return None


def test_at_30_hz_the_orbit_doubles_its_period() -> None:
    cycle = orbit(rig_at(30.0, 12.9))
    assert (cycle.status, cycle.through) == (OrbitStatus.UNSTABLE, "-1")
    assert cycle.largest_multiplier == pytest.approx(1.33, abs=0.01)
    assert marched_period(rig_at(30.0, 12.9)) == 2


@pytest.mark.parametrize(
    ("shaft_hz", "extent_deg"),
    [
        (25.0, 12.9),
        (28.0, 12.9),
        (32.0, 12.9),
        (35.0, 12.9),
        (60.0, 38.6),
        (120.0, 8.0),
    ],
)
def test_marching_settles_where_multipliers_say_it_does(shaft_hz: float, extent_deg: float) -> None:
    """600 ball passes of marching repeat after one pass just where the orbit is stable."""
    scene = rig_at(shaft_hz, extent_deg)
    cycle = orbit(scene)
    assert cycle.status in (OrbitStatus.STABLE, OrbitStatus.UNSTABLE)
    assert (marched_period(scene) == 1) == cycle.stable


@pytest.mark.parametrize(
    ("name", "changes"),
    [("fan-rig", {}), ("7208-25deg", {}), ("7208-25deg", {"depth": 0.0, "fz": 6e3})],
)
def test_multipliers_are_of_the_derivative_of_a_period(name: str, changes: dict[str, Any]) -> None:
    """By differences of the motion over the orbit's period, from states beside it."""
    scene = presets[name].replace(contact_damping=130.0, **changes)
    cycle = orbit(scene)
    shooting = _Shooting(packed_motion(scene), cycle.period, len(cycle.history) - 1)
    y = shooting.smooth_state(_state_at_start(cycle, cycle.dofs))
    slopes = np.empty((y.size, y.size))
    for column, h in zip(slopes.T, np.diag(1e-11 / shooting.scale), strict=True):
        column[:] = (shooting.march(y + h) - shooting.march(y - h)) / (2.0 * h.max())
    tangent = shooting.march_with_tangent(y)[1]
    wrong = (slopes - tangent) * np.divide.outer(shooting.scale, shooting.scale)
    assert np.abs(wrong).max() < 1e-6
    assert cycle.largest_multiplier == pytest.approx(
        np.abs(np.linalg.eigvals(slopes)).max(), rel=1e-3
    )


def test_no_orbit_is_claimed_where_there_is_none() -> None:
    """At 100 Hz marching returns every second pass: shooting over one pass cannot converge."""
    scene = rig_at(100.0, 12.9)
    assert marched_period(scene) == 2
    assert orbit(scene).status in (OrbitStatus.NOT_CONVERGED, OrbitStatus.UNSTABLE)


def test_an_inner_race_defect_repeats_when_shaft_and_cage_do() -> None:
    """Fan rig: ω_c/ω_s = 37/90, so 45 turns of the shaft are 18.5 of the cage, 259 ball passes."""
    inner = rig_at(7.0, 12.9).replace(race="inner")
    assert common_ball_passes(inner) == 259
    assert common_ball_passes(rig_at(7.0, 12.9)) == 1
    assert common_ball_passes(rig_at(7.0, 12.9).replace(unbalance=1e-4)) != 1
    unlike = inner.replace(contact_angle=math.radians(15.0))
    assert common_ball_passes(unlike) is None
    assert orbit(unlike).status == OrbitStatus.NO_PERIOD
    assert math.isnan(orbit(unlike).largest_multiplier)
