"""Forces in time beside those that a scene has itself."""

import numpy as np
import pytest

from bearingcore import ForceSamples, presets, simulate

RIG = presets["fan-rig"]
RATE = 65536.0


@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_a_constant_force_ends_as_the_same_load(balls: str) -> None:
    """Along all directions that move; moments too, which are carried over a radius."""
    more = {"x": 20.0, "y": -50.0, "z": 300.0, "rx": 0.2, "ry": -0.1}
    damping = {f"damping_{name}": 0.04 if "r" in name else 3e4 for name in more}
    scene = presets["7208-25deg"].replace(
        balls=balls, dofs=tuple(more), fz=2000.0, extent=0.0, contact_damping=3400.0, **damping
    )
    fields = dict(zip(("fx", "fy", "fz", "mx", "my"), more.values(), strict=True))
    loaded = scene.replace(**{name: getattr(scene.load, name) + fields[name] for name in fields})
    steady = ForceSamples([list(more.values())] * 400, 1000.0, tuple(more))
    pushed = simulate(scene, 0.2, RATE, force=steady)
    there, before = simulate(loaded, 0.2, RATE), simulate(scene, 0.2, RATE)
    late = slice(round(0.19 * RATE), None)
    shift = there.inner_displacement[late] - before.inner_displacement[late]
    off = pushed.inner_displacement[late] - there.inner_displacement[late]
    assert np.all(np.abs(off).max(axis=0) < 1e-2 * np.abs(shift).max(axis=0))


@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_a_sampled_turning_force_is_the_unbalance(balls: str) -> None:
    scene = RIG.replace(balls=balls, unbalance=2e-4)
    time = np.arange(4000) / 32768.0
    turn = scene.shaft_speed * time
    turning = scene.turning_force * np.column_stack([np.sin(turn), np.cos(turn)])
    samples = ForceSamples(turning, 32768.0, ("y", "x"))
    pushed = simulate(scene.replace(unbalance=0.0), 0.1, RATE, force=samples)
    own, still = simulate(scene, 0.1, RATE), simulate(scene.replace(unbalance=0.0), 0.1, RATE)
    size = np.abs(own.outer_velocity - still.outer_velocity).max()
    assert np.abs(pushed.outer_velocity - own.outer_velocity).max() < 1e-4 * size


def test_an_unbalance_and_a_force_add_up_and_beyond_its_end_a_force_is_zero() -> None:
    scene = RIG.replace(unbalance=2e-4)
    own, none, once, zeros = (
        simulate(scene, 0.02, force=force and ForceSamples(force, 500.0)).outer_acceleration
        for force in (None, [[0.0, 0.0]], [[9.0, 0.0]], [[9.0, 0.0], *[[0.0, 0.0]] * 40])
    )
    assert np.array_equal(none, own)
    assert np.array_equal(once, zeros)
    assert not np.array_equal(once, own)


def test_a_strong_shock_has_the_steps_of_its_peak() -> None:
    shock = ForceSamples([0.0, -1e6, 0.0], 1000.0, ("y",))
    for scene in (RIG, RIG.replace(balls="with mass")):
        rate = simulate(scene, 0.01).step_rate
        assert simulate(scene, 0.01, force=shock).step_rate > 2.0 * rate
