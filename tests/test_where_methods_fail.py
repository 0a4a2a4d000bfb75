"""Ways to go wrong with this model that one thinks of first, and that the program avoids.

Two more: steps that are too long (`tests/bearingcore/model/dynamics/test_step_size.py`), and
shooting that ends on an orbit which no motion follows
(`tests/bearingcore/model/dynamics/test_orbit.py`).
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import root

from bearingcore import Motion, Scene, equilibrium, presets, simulate
from bearingcore.model import _kernels as kernels
from bearingcore.model.statics import ball_positions
from tests.helpers.contact_law import Array, Balls, newton
from tests.outside.elements import STEP
from tests.outside.march import rates
from tests.outside.test_charts import problem

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
RATE = 65536.0


def fair_guess(balls: Balls) -> NDArray[np.float64]:
    """First guess q (5,) [m]: through the clearance, as far as several balls yield."""
    bearing, load = balls.scene.bearing, balls.load.astype(float)
    size = np.linalg.norm(load)
    pressed = 5.0 * (size / bearing.load_deflection_factor) ** (2.0 / 3.0)
    gap = bearing.radial_clearance / math.cos(bearing.contact_angle)
    return np.asarray((gap + pressed) * load / size)


# --- statics --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("depth_um", "wrong"),
    [(50.0, 0.0), (75.0, 0.0), (100.0, 37.712), (200.0, 5580.92), (500.0, 56018.7)],
)
def test_the_printed_distance_loads_balls_that_hang_free(depth_um: float, wrong: float) -> None:
    """From a depth of 2 A0 on, balls over the floor seem to carry load [N].

    Newton's method on the printed formula ends there even when started from the right answer.
    """
    scene = LIEW_LIM.replace(extent=math.radians(40.0), depth=depth_um * 1e-6)
    angles = np.arange(120) * (scene.bearing.ball_spacing / 120)
    right = equilibrium(scene, angles)
    in_defect = scene.defect.path(right.ball_angle, scene.bearing) >= 0.999 * 50e-6
    assert in_defect.any()
    lever = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
    greatest = 0.0
    for i, angle in enumerate(angles):
        balls = Balls(scene, angle, as_printed=True)
        attempt = newton(balls, right.displacement[i] * lever)
        assert not attempt.failure
        greatest = max(greatest, float(balls.ball_load(attempt.q)[in_defect[i]].max(initial=0.0)))
    assert greatest == pytest.approx(wrong, rel=1e-5)
    assert np.all(right.ball_load[in_defect] == 0.0)
    assert right.ball_load.max() == pytest.approx(1388.96, rel=1e-6)


@pytest.mark.parametrize("scene", [LIEW_LIM.healthy(), FAN_RIG.healthy()])
def test_newton_from_zero_finds_a_singular_matrix(scene: Scene) -> None:
    """With clearance nothing touches at q = 0: there is no stiffness to divide by."""
    for angle in (0.0, 0.1, 0.2):
        assert newton(Balls(scene, angle), np.zeros(5)).failure == "singular matrix"
    assert equilibrium(scene, [0.0, 0.1, 0.2]).converged.all()


def test_newton_without_a_line_search_fails_now_and_then() -> None:
    """From a fair first guess full steps circle, or meet a singular matrix, in some scenes."""
    rng = np.random.default_rng(2014)
    failures = beyond = 0
    for _ in range(200):
        radial = 10.0 ** rng.uniform(1.0, 4.0)
        scene = LIEW_LIM.replace(
            n_balls=int(rng.integers(7, 17)),
            contact_angle=rng.uniform(0.0, math.radians(40.0)),
            groove_center_distance=rng.uniform(50e-6, 300e-6),
            radial_clearance=rng.uniform(0.0, 20e-6),
            load_deflection_factor=10.0 ** rng.uniform(9.0, 10.5),
            extent=rng.uniform(0.0, math.radians(120.0)),
            depth=rng.uniform(0.0, 100e-6),
            fy=-radial,
            fz=radial * rng.uniform(0.1, 0.6),
        )
        balls = Balls(scene, rng.uniform(0.0, scene.bearing.ball_spacing))
        failures += bool(newton(balls, fair_guess(balls), steps=50).failure)
        state = equilibrium(scene, [balls.cage_angle])
        # a few bearings are pressed out of their grooves: their balance is found too
        beyond += state.status[0] == kernels.BEYOND
        assert state.converged[0] or state.status[0] == kernels.BEYOND
        assert state.residual[0] <= 1e-9
    assert 2 <= failures <= 50
    assert beyond < 10


@dataclass(frozen=True)
class GapsPull(Balls):
    """Balls whose gaps pull as compressions push, Q = K sign(δ) |δ|^1.5: easy for Newton."""

    def ball_load(self, q: Array) -> Array:
        """Q (N_b,) [N]."""
        delta = self.compression(q)
        K = self.scene.bearing.load_deflection_factor
        return np.asarray(K * np.sign(delta) * np.abs(delta) ** 1.5)


def test_gaps_that_pull_converge_to_a_wrong_answer() -> None:
    """A solver is content, and balls across the bearing pull the ring."""
    scene = LIEW_LIM.healthy().replace(radial_clearance=20e-6)
    pulling, balls = GapsPull(scene, 0.1), Balls(scene, 0.1)
    load = balls.load.astype(float)
    answer = root(lambda q: (pulling.contact_force(q) - load).astype(float), fair_guess(balls))
    assert answer.success
    assert pulling.ball_load(answer.x).min() < -100.0
    right = equilibrium(scene, [0.1])
    assert right.converged[0]
    assert right.ball_load.min() == 0.0
    # what really touches there does not carry the load by far
    assert balls.unbalanced(answer.x, [0, 1, 2, 3, 4]) > 0.2 * np.linalg.norm(load)


def test_a_ball_is_stuck_between_its_contacts() -> None:
    """A loaded ball put where its outer contact carries what the inner one presses with, again and
    again, hops from contact to contact for ever where the inner contact is the stiffer one.
    """
    scene = presets["6205"].healthy()
    inner, outer = scene.bearing.race_factors
    assert inner > outer
    force = scene.bearing.centrifugal_load(15_000 * math.pi / 30.0)
    positions = ball_positions(scene, [0.0], centrifugal_load=force)
    assert positions.converged[0]
    Q_i, Q_e = positions.load[:, 0, int(np.argmax(positions.load[0, 0]))]
    assert Q_e - Q_i == pytest.approx(force, rel=1e-9)
    place = (Q_e / outer) ** (2.0 / 3.0)
    both = place + (Q_i / inner) ** (2.0 / 3.0)
    visited = [place * (1.0 + 1e-6)]
    for _ in range(2000):
        pressed = inner * max(both - visited[-1], 0.0) ** 1.5
        visited.append(((pressed + force) / outer) ** (2.0 / 3.0))
    assert abs(visited[-1] - visited[-2]) > 0.5 * both
    assert abs(visited[-1] - visited[-3]) < 1e-9 * both


# --- motion ---------------------------------------------------------------------------------------


def by_scipy(duration: float, rtol: float, atol: float) -> Array:
    """Acceleration of the fan rig's housing (n, 2) [m/s²] over a duration [s], by RK45."""
    rig, time = problem("fan-rig"), np.arange(round(duration * RATE)) / RATE
    made = solve_ivp(
        rates, (0.0, time[-1]), rig.start(), "RK45", time, args=rig.packed(),
        rtol=rtol, atol=1e6 * atol,
    )  # fmt: skip
    assert made.success
    return rig.accelerations(time, made.y.T)


def test_default_tolerances_are_the_size_of_the_signal() -> None:
    """An absolute tolerance of 1e-6 m lets through errors of a fifth of all that moves."""
    acceleration = simulate(FAN_RIG, 0.05, RATE, step_rate=RATE).outer_acceleration
    right, wrong = (by_scipy(0.05, *limits) for limits in ((1e-6, 1e-12), (1e-3, 1e-6)))
    assert (right - acceleration).std() < 0.02 * acceleration.std()
    assert (wrong - acceleration).std() > 0.15 * acceleration.std()


def pushes(motion: Motion) -> tuple[Array, Array]:
    """Least force of a ball [N], and how far from the balls' pushes alone the housing feels [N]."""
    scene, support = motion.scene, motion.scene.support
    x = motion.inner_displacement - motion.outer_displacement
    v = motion.inner_velocity - motion.outer_velocity
    felt = (
        support.outer_mass * motion.instant_acceleration("outer")
        + support.damping("xy") * motion.outer_velocity
        + support.stiffness("xy") * motion.outer_displacement
    )
    least, apart, rows = [], [], problem("fan-rig").rows
    for time, q, rate, force in zip(motion.time, x, v, felt, strict=True):
        moving = np.concatenate([q + STEP * 1j * rate, np.zeros(3)])
        delta, ways = rows.contacts(moving, scene.cage_speed * (time + STEP * 1j))
        damped = rows.pressed(delta.real) + 500.0 * delta.imag / STEP
        push = np.where(delta.real > 0.0, damped, 0.0)
        least.append(push.min())
        apart.append(np.abs(force - ways[:2].real @ np.maximum(push, 0.0)).max())
    return np.array(least), np.array(apart)


def test_the_published_damper_pulls_balls_back() -> None:
    """A ball that leaves with its damper still on is held; with "no tension" it is let go."""
    scene = FAN_RIG.replace(contact_damping=500.0)
    least, apart = pushes(simulate(scene, 0.05, RATE, step_rate=RATE))
    assert least.min() < -0.2
    assert apart.max() > 0.2
    free = simulate(scene.replace(contact_law="no tension"), 0.05, RATE, step_rate=RATE)
    least, apart = pushes(free)
    assert least.min() < -0.2  # the damper would pull, and is not let
    assert apart.max() < 1e-3
