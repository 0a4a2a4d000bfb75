"""The compiled code against its meaning in plain NumPy, also where no scene can go yet."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bearingcore import DOF_NAMES, Scene, kernels
from bearingcore.scene import packing
from tests.bearingcore.kernels import numpy_twin as twin
from tests.bearingcore.kernels.scenes import (
    FAN_RIG,
    LIEW_LIM,
    SCENES,
    UNLIKE,
    in_row,
    rollers,
    system_of,
    two_rows,
)

every_scene = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())


def systems(*, velocities: bool) -> dict[str, kernels.System]:
    """Scenes, then rollers and two rows, of which one alone meets the defect."""
    found = {name: system_of(scene, velocities=velocities) for name, scene in SCENES.items()}
    for name in ("planar", "five directions"):
        found[f"rollers, {name}"] = found[name]._replace(contacts=rollers(found[name].contacts))
    single = found["five directions"]
    arm = 8e-3 / LIEW_LIM.bearing.groove_center_radius
    for name, signs in {"back to back": (-1.0, 1.0), "face to face": (1.0, -1.0)}.items():
        rows = two_rows(single.contacts, (arm, -arm), signs)
        found[f"two rows, {name}"] = single._replace(
            contacts=rows._replace(clearance=rows.clearance - 5e-6), path=in_row(single.path, 1)
        )
    for race in ("outer", "inner"):
        unlike = UNLIKE.replace(race=race, edge="exact")
        found[f"unlike rows, {race} race"] = system_of(unlike, velocities=velocities)
    return found


VELOCITIES = systems(velocities=True)
every_system = pytest.mark.parametrize("name", VELOCITIES)


def load_of(name: str) -> kernels.StaticLoad:
    other = UNLIKE if "unlike" in name else LIEW_LIM
    scene = SCENES.get(name.removeprefix("rollers, "), other)
    return packing.static_load(scene, scene.active_dofs)


@every_scene
def test_drops(scene: Scene) -> None:
    path, contacts = packing.path(scene), packing.contacts(scene.bearing)
    for cage in np.linspace(-3.0, 9.0, 61):
        expected = twin.drops(contacts, path, cage)
        found = kernels.ball_path(
            cage + contacts.angle, np.full(contacts.angle.size, cage), 0, path
        )
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-17)


@every_system
def test_static_states(name: str) -> None:
    _, contacts, path = VELOCITIES[name]
    load = load_of(name)
    cage = np.linspace(0.0, 0.6, 7)
    q, loads, stiffness, loaded, status, *_ = kernels.static_states(cage, contacts, path, load)
    assert np.all(status == kernels.CONVERGED)
    size = np.linalg.norm(load.force[load.active])
    for k, angle in enumerate(cage):
        left = twin.unbalanced(contacts, path, load, q[k], angle)
        assert np.abs(left).max() < 1e-8 * max(size, loads[k].max())
        balls = twin.touching(contacts, q[k], angle, twin.drops(contacts, path, angle))
        expected = twin.loads_of(contacts, balls.delta)
        np.testing.assert_allclose(loads[k], expected, rtol=1e-8, atol=1e-9 * expected.max())
        assert loaded[k] == np.count_nonzero(balls.delta > 0.0)
        matrix = twin.stiffness_at(contacts, path, q[k], angle)
        np.testing.assert_allclose(stiffness[k], matrix, rtol=0.0, atol=1e-9 * np.abs(matrix).max())


@every_system
def test_equations_of_motion(name: str) -> None:
    system = VELOCITIES[name]
    n = system.rotor.active.size
    random = np.random.default_rng(1)
    seen = 0
    for t in np.linspace(0.0, 0.03, 12):
        y = np.concatenate([random.normal(0.0, size, n) for size in (2e-5, 1e-3, 2e-6, 1e-3)])
        found = kernels.motion_rates(np.array([t]), y[None], 0.0, system)[0]
        expected = twin.rate_of_velocities(system, t, y)
        seen += np.any(expected[n : 2 * n] != system.rotor.force * system.rotor.inverse_inner)
        scale = np.abs(expected).reshape(4, n).max(axis=1).repeat(n)
        assert np.abs((found - expected) / scale).max() < 1e-6
    assert seen > 6, "contacts pushed"


@pytest.mark.parametrize(
    ("name", "within"),
    [
        ("planar", 1e-6),
        ("five directions", 1e-6),
        ("inner race", 1e-6),
        ("no tension", 2e-3),
        ("rollers, five directions", 1e-5),
        ("two rows, back to back", 1e-6),
        ("unlike rows, outer race", 1e-6),
        ("unlike rows, inner race", 1e-6),
    ],
)
def test_marches_follow_the_twin(name: str, within: float) -> None:
    """DOP853 on the twin, in velocities; the march takes the variables that a scene is given."""
    marched, plain = systems(velocities=False)[name], VELOCITIES[name]
    rotor = plain.rotor
    n = rotor.active.size
    duration, steps = 2e-4, 400
    state = kernels.static_states(np.zeros(1), plain.contacts, plain.path, load_of(name))[0][0]
    y = np.zeros((4, n))
    y[2] = rotor.force / rotor.stiffness
    y[0] = y[2] + state[rotor.active]
    y[1] = 2e-3  # a push, so that balls touch and leave
    solved = solve_ivp(
        lambda t, u: twin.rate_of_velocities(plain, t, u), (0.0, duration), y.ravel(), "DOP853",
        rtol=1e-9, atol=1e-14, max_step=duration / 30.0,
    )  # fmt: skip
    own = y.ravel().copy()
    history = np.empty((steps + 1, 6, n))
    kernels.turn_smooth(own, 1.0, 0.0, marched)
    assert kernels.march(own, duration / steps, 0.0, marched, history) == steps
    expected = solved.y[:, -1].reshape(4, n)
    moved = np.abs(expected - y)
    for row, column in ((0, 0), (1, 1), (2, 3), (3, 4)):
        apart = np.abs(history[-1, column] - expected[row]).max()
        assert apart < within * moved[row].max()
    kernels.turn_smooth(own, -1.0, rotor.cage_speed * duration, marched)
    np.testing.assert_allclose(own.reshape(4, n)[1], history[-1, 1], rtol=1e-9)


@pytest.mark.parametrize(
    "name", ["rollers, planar", "two rows, face to face", "unlike rows, inner race"]
)
def test_tangents_of_what_no_scene_has_yet(name: str) -> None:
    """Against central differences; with fewer columns than directions as well."""
    system = systems(velocities=False)[name]
    n = system.rotor.active.size
    random = np.random.default_rng(2)
    y = np.concatenate([random.normal(0.0, size, n) for size in (5e-6, 1e-4, 1e-6, 1e-4)])
    history = np.empty((301, 6, n))

    def end(begin: np.ndarray) -> np.ndarray:
        state = begin.copy()
        kernels.march(state, 2e-6, 0.0, system, history)
        return state

    def with_tangent(columns: int) -> tuple[np.ndarray, np.ndarray]:
        tangent = np.eye(4 * n)[:, :columns]
        both = np.concatenate([y, tangent.ravel()])
        kernels.march(both, 2e-6, 0.0, system, history)
        return both[: 4 * n], both[4 * n :].reshape(tangent.shape)

    moved, tangent = with_tangent(4 * n)
    np.testing.assert_allclose(moved, end(y), rtol=1e-13)
    scale = np.repeat([1.0, 1e-4, 1.0, 1e-4], n)  # velocities count over 10^4 rad/s
    for column in range(4 * n):
        small = np.zeros(4 * n)
        small[column] = 1e-11 / scale[column]
        difference = (end(y + small) - end(y - small)) / (2.0 * small[column])
        apart = np.abs(scale * (tangent[:, column] - difference)).max()
        assert apart < 1e-4 * np.abs(scale * difference).max()
    np.testing.assert_allclose(with_tangent(2)[1], tangent[:, :2], rtol=1e-12)


def test_two_rows_tilt_as_an_independent_program_says() -> None:
    """Two Liew-Lim rows at ± 8 mm, each preloaded by r_L = −5 µm."""
    healthy = LIEW_LIM.healthy().bearing
    single = packing.contacts(healthy)
    r_d = healthy.groove_center_radius
    arm = 8e-3 / r_d
    load = kernels.StaticLoad(np.array([0.0, -1.0, 0.0, 0.0, 0.0]), np.arange(5))
    path = kernels.Path(np.zeros((0, len(kernels.PATH_COLUMNS))), np.zeros(0))
    for signs, tilting in (((1.0, -1.0), 15_157.0), ((-1.0, 1.0), 147_945.0)):
        rows = two_rows(single, (arm, -arm), signs)
        rows = rows._replace(
            clearance=np.full_like(rows.clearance, -5e-6), angle=np.tile(single.angle, 2)
        )
        K = kernels.static_states(np.zeros(1), rows, path, load)[2][0]
        assert K[1, 1] == pytest.approx(437.4e6, rel=1e-4)
        assert K[3, 3] * r_d**2 == pytest.approx(tilting, rel=1e-4)
        assert abs(K[1, 4]) < 1e-3 * K[1, 1]


def test_one_row_split_in_two_is_the_same_bearing() -> None:
    """Rows are bookkeeping: every second ball in a row of its own changes nothing."""
    system = system_of(LIEW_LIM)
    order = np.concatenate([np.arange(0, 12, 2), np.arange(1, 12, 2)])
    whole = system.contacts
    split = kernels.Contacts(
        *(array[order] for array in whole[:-1]), rows=np.array([[0, 6], [6, 6]])
    )
    load = packing.static_load(LIEW_LIM, DOF_NAMES)
    cage = np.linspace(0.0, 2.0, 9)
    one = kernels.static_states(cage, whole, system.path, load)
    two = kernels.static_states(cage, split, system.path, load)
    np.testing.assert_allclose(two[1], one[1][:, order], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(two[2], one[2], rtol=1e-9, atol=1.0)


def test_a_roller_bearing_is_other_numbers() -> None:
    """Radial load on one line contact at the load line: F = K δ^(10/9)."""
    bearing = FAN_RIG.healthy().replace(radial_clearance=20e-6).bearing
    contacts = rollers(packing.contacts(bearing))
    path = kernels.Path(np.zeros((0, len(kernels.PATH_COLUMNS))), np.zeros(0))
    load = kernels.StaticLoad(np.array([10.0, 0.0, 0.0, 0.0, 0.0]), np.arange(2))
    q, loads, stiffness, loaded, *_ = kernels.static_states(np.zeros(1), contacts, path, load)
    assert loaded[0] in (1, 2, 3)
    delta = (loads[0, 0] / contacts.factor[0]) ** 0.9
    assert q[0, 0] == pytest.approx(20e-6 + delta, rel=1e-9)
    assert stiffness[0, 0, 0] == pytest.approx(10.0 / 9.0 * loads[0, 0] / delta, rel=1e-6) or (
        loaded[0] > 1
    )
    assert math.isfinite(stiffness[0, 1, 1])
