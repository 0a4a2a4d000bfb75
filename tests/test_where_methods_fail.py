"""Each known way to go wrong with this model, shown to go wrong, and ours shown not to share it.

`tests.helpers.naive` holds the formulas as printed and the methods as one first thinks of them.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bearingcore import (
    Bearing,
    Defect,
    Load,
    Motion,
    Scene,
    equilibrium,
    presets,
    simulate,
    spectrum,
)
from bearingcore.dynamics.orbit import orbit
from bearingcore.statics.ball_positions import ball_positions
from tests.helpers import naive
from tests.helpers.independent import Balls, verdict

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
RATE = 65536.0


# --- statics: the unsigned distance --------------------------------------------------------------


@pytest.mark.parametrize(
    ("depth_um", "said"),
    [(50.0, 0.0), (75.0, 0.0), (100.0, 37.712), (200.0, 5580.92), (500.0, 56018.7)],
)
def test_the_printed_distance_loads_balls_that_hang_free(depth_um: float, said: float) -> None:
    """Liew-Lim bearing, 40°: from a depth of 2 A0 on, balls on the floor seem to carry load.

    Newton's method on the printed formula, started from the right answer, ends there.
    """
    scene = LIEW_LIM.replace(extent=math.radians(40.0), depth=depth_um * 1e-6)
    angles = np.arange(120) * (scene.bearing.ball_spacing / 120)
    ours = equilibrium(scene, angles)
    lever = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
    in_the_defect = scene.defect.path(ours.ball_angle, scene.bearing) >= 0.999 * 50e-6
    assert in_the_defect.any()
    greatest = 0.0
    for i, angle in enumerate(angles):
        attempt = naive.newton(scene, angle, ours.displacement[i] * lever)
        assert not attempt.failure
        loads = naive.printed(scene, angle, attempt.q).ball_load
        greatest = max(greatest, float(loads[in_the_defect[i]].max(initial=0.0)))
    assert greatest == pytest.approx(said, rel=1e-5)
    # ours: the same 1389 N outside and nothing inside, however deep
    assert np.all(ours.ball_load[in_the_defect] == 0.0)
    assert ours.ball_load.max() == pytest.approx(1388.96, rel=1e-6)


# --- statics: Newton's method --------------------------------------------------------------------


def test_newton_from_zero_finds_a_singular_matrix() -> None:
    """With clearance nothing touches at q = 0: there is no stiffness to divide by."""
    for scene in (LIEW_LIM.healthy(), FAN_RIG.healthy()):
        for angle in (0.0, 0.1, 0.2):
            attempt = naive.newton(scene, angle, np.zeros(5))
            assert attempt.failure == "singular matrix"
            assert attempt.residual == 1.0
        assert equilibrium(scene, [0.0, 0.1, 0.2]).converged.all()


def random_scene(rng: np.random.Generator) -> Scene:
    """A bearing that one may buy, a defect that it may have, a load that it may carry."""
    n_balls = int(rng.integers(7, 21))
    D_b, D_p = 8e-3, 8e-3 * n_balls / math.pi * rng.uniform(1.1, 1.5)
    log_factor, log_load = rng.uniform(9.0, 10.5), rng.uniform(1.0, 4.0)
    heading = rng.uniform(0.0, 2.0 * math.pi)
    radial = 10.0**log_load
    return Scene(
        bearing=Bearing(
            n_balls=n_balls,
            ball_diameter=D_b,
            pitch_diameter=D_p,
            contact_angle=rng.uniform(0.0, math.radians(40.0)),
            groove_center_radius=0.5 * D_p,
            groove_center_distance=rng.uniform(50e-6, 300e-6),
            radial_clearance=rng.uniform(0.0, 20e-6),
            load_deflection_factor=10.0**log_factor,
            outer_raceway_radius=0.5 * (D_p + D_b),
            inner_raceway_radius=0.5 * (D_p - D_b),
        ),
        defect=Defect(
            extent=rng.uniform(0.0, math.radians(120.0)),
            depth=rng.uniform(0.0, 100e-6),
            center=heading + rng.uniform(-0.5, 0.5),
        ),
        load=Load(
            fx=radial * math.cos(heading),
            fy=radial * math.sin(heading),
            fz=radial * rng.uniform(0.1, 0.6),
        ),
        shaft_speed=50.0,
        support=FAN_RIG.support,
    )


def test_newton_without_a_line_search_fails_now_and_then() -> None:
    """1000 random scenes from a fair first guess, the distance mended: full steps circle, or meet a
    singular matrix, in some of them. How many depends on the scenes; ours fails in none.
    """
    rng = np.random.default_rng(2014)
    failures = 0
    for _ in range(1000):
        scene = random_scene(rng)
        angle = rng.uniform(0.0, scene.bearing.ball_spacing)
        start = naive.fair_guess(scene)
        failures += bool(naive.newton(scene, angle, start, mended=True, steps=50).failure)
        ours = equilibrium(scene, [angle])
        assert ours.converged[0]
        assert ours.residual[0] <= 1e-9
    assert 10 <= failures <= 250


def test_gaps_that_pull_converge_to_a_wrong_answer() -> None:
    """Sign(δ)|δ|^1.5 makes Newton's method happy, and balls across the bearing pull the ring."""
    scene = LIEW_LIM.healthy().replace(radial_clearance=20e-6)
    for angle in (0.0, 0.1, 0.2):
        attempt = naive.newton(scene, angle, naive.fair_guess(scene), gaps_pull=True)
        assert not attempt.failure
        pulling = naive.printed(scene, angle, attempt.q, gaps_pull=True).ball_load
        assert pulling.min() < -100.0
        ours = equilibrium(scene, [angle])
        assert verdict(ours, 0) == ""
        assert ours.ball_load.min() == 0.0
        # what really touches there does not carry the load by far
        balls = Balls(scene, angle)
        assert balls.unbalanced(attempt.q, [0, 1, 2, 3, 4]) > 0.2 * np.linalg.norm(balls.load)
        assert attempt.q[1] > 0.97 * ours.state[0, 1]  # not sunk as far, y pointing up
        assert attempt.q[2] > 1.5 * ours.state[0, 2]  # and pushed out too far


# --- motion: the integrator ----------------------------------------------------------------------


@cache
def small_defect() -> Motion:
    """The fan rig at 12.9° over 1.4 s, as `simulate` does it by default."""
    return simulate(FAN_RIG, 1.4, RATE)


def decibels_apart(signal: np.ndarray, other: np.ndarray) -> float:
    """Greatest difference of two spectra over 0.3 to 2.1 kHz [dB]."""
    frequency, density = spectrum(signal, RATE)
    band = (frequency >= 300.0) & (frequency <= 2100.0)
    expected = spectrum(other, RATE).density
    return float(np.abs(10.0 * np.log10(density[band] / expected[band])).max())


def by_scipy(duration: float, rtol: float, atol: float) -> np.ndarray:
    """Acceleration of the housing [m/s²] by scipy's RK45 with the naive right-hand side."""
    motion = naive.Motion(FAN_RIG)
    start = equilibrium(FAN_RIG, [0.0]).displacement[0, :2]
    support = FAN_RIG.support
    housing = FAN_RIG.load.vector[:2] / support.stiffness("xy")
    state = np.concatenate([housing + start, housing, np.zeros(4)])
    time = np.arange(round(duration * RATE)) / RATE
    answer = solve_ivp(motion, (0.0, time[-1]), state, "RK45", time, rtol=rtol, atol=atol)
    assert answer.success
    return np.array([motion(t, y)[6:] for t, y in zip(time, answer.y.T, strict=True)])


@pytest.mark.proof
def test_default_tolerances_are_the_size_of_the_signal() -> None:
    """An absolute tolerance of 1e-6 m lets through errors as large as all that moves.

    scipy says success, yet the spectrum is wrong by decibels. The right-hand side is not to blame:
    with tolerances scaled to micrometres it gives our motion.
    """
    wrong = by_scipy(0.5, 1e-3, 1e-6)
    assert decibels_apart(wrong, small_defect().outer_acceleration[: len(wrong)]) > 3.0
    # ours, by default, against itself at a sixteenth of the step
    fine = simulate(FAN_RIG, 1.4, RATE, step_rate=16 * RATE, most_steps=2_000_000)
    found = decibels_apart(small_defect().outer_acceleration, fine.outer_acceleration)
    assert found < 0.05
    # the same scipy method with tolerances that fit, over a shorter while
    right = by_scipy(0.05, 1e-6, 1e-12)
    ours = simulate(FAN_RIG, 0.05, RATE, step_rate=RATE).outer_acceleration
    assert np.abs(right - ours).max() < 0.02 * np.abs(ours).max()


def test_a_step_longer_than_the_passage_misses_the_defect() -> None:
    """1° at 70 Hz is passed in 96 µs; ten steps a ball pass, 248 µs each, step right over it.

    The defect lies between the angles at which balls are looked at, so the march gives the healthy
    bearing's motion to the last digit, and says nothing. The steps taken by default are told by the
    passage: they see the defect, and finer ones see the same.
    """
    scene = FAN_RIG.replace(
        shaft_speed=2.0 * math.pi * 70.0,
        extent=math.radians(1.0),
        edge="exact",
        center=1.5 * math.pi + 0.25 * FAN_RIG.bearing.ball_spacing / 10.0,
    )
    # a ball stands at 270° whenever the cage has turned a multiple of half a step
    assert 1.5 * math.pi / scene.bearing.ball_spacing * 2 % 1 == pytest.approx(0.0, abs=1e-9)
    rate = 10.0 * scene.bearing.bpfo(scene.shaft_speed)
    passage = scene.defect.extent / scene.cage_speed
    assert 1.0 / rate > 2.5 * passage
    blind = simulate(scene, 0.1, rate, step_rate=rate).outer_acceleration
    healthy = simulate(scene.healthy(), 0.1, rate, step_rate=rate).outer_acceleration
    assert np.array_equal(blind, healthy)
    seen = simulate(scene, 0.1, RATE)
    healthy = simulate(scene.healthy(), 0.1, RATE)
    assert seen.step_rate > 20.0 / passage
    assert np.ptp(seen.outer_acceleration[:, 1]) > 3.0 * np.ptp(healthy.outer_acceleration[:, 1])
    finer = simulate(scene, 0.1, RATE, step_rate=4.0 * seen.step_rate).outer_acceleration
    level = np.sqrt(np.mean(finer**2))
    assert np.sqrt(np.mean((seen.outer_acceleration - finer) ** 2)) < 0.05 * level


# --- motion: the damper --------------------------------------------------------------------------


def forces_along(motion: Motion) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What the balls press with as the published law has it, what it comes to where none may pull,
    and what the housing felt: m a + c v + k x; arrays (n, N_b), (n, 2), (n, 2) [N].
    """
    scene, support = motion.scene, motion.scene.support
    contacts = naive.Motion(scene).contacts
    x = motion.inner_displacement - motion.outer_displacement
    v = motion.inner_velocity - motion.outer_velocity
    press, pushed = [], []
    for row in zip(motion.time, x, v, strict=True):
        elastic, viscous, rays = contacts(*row)
        press.append(elastic + viscous)
        pushed.append(rays.T @ np.maximum(elastic + viscous, 0.0))
    felt = (
        support.outer_mass * motion.outer_acceleration
        + support.damping("xy") * motion.outer_velocity
        + support.stiffness("xy") * motion.outer_displacement
    )
    return np.array(press), np.array(pushed), felt


def test_the_published_damper_pulls_balls_back() -> None:
    """A ball that leaves with its damper still on is held: contact forces below zero.

    With "no tension" the housing feels the sum of pushes alone, sample by sample; with the
    published law it feels the pulls as well.
    """
    scene = FAN_RIG.replace(contact_damping=500.0)
    press, pushed, felt = forces_along(simulate(scene, 0.05, RATE, step_rate=RATE))
    assert press.min() < -0.2
    assert np.abs(felt - pushed).max() > 0.2
    free = scene.replace(contact_law="no tension")
    press, pushed, felt = forces_along(simulate(free, 0.05, RATE, step_rate=RATE))
    assert press.min() < -0.2  # the damper would pull, and is not let
    assert np.abs(felt - pushed).max() < 1e-3


# --- motion: the steady state --------------------------------------------------------------------


def test_shooting_ends_on_an_orbit_that_no_motion_follows() -> None:
    """30 Hz, 12.9°: one ball pass has an orbit, and whatever comes near it leaves it.

    Newton's shooting converges there and by itself sees nothing wrong. Ours hands over the proof,
    a largest multiplier of 1.33 through −1; marching ends in a motion of twice the period.
    """
    scene = FAN_RIG.replace(shaft_speed=2.0 * math.pi * 30.0, contact_damping=130.0)
    found = orbit(scene)
    assert found.residual < 1e-6
    assert not found.stable
    assert found.largest_multiplier == pytest.approx(1.33, abs=0.02)
    assert found.through == "-1"
    passes = 64
    rate = passes * scene.bearing.bpfo(scene.shaft_speed)
    marched = simulate(scene, 3.5, rate).outer_acceleration[-8 * passes :]
    size = np.ptp(marched, axis=0).max()
    assert np.abs(marched[passes:] - marched[:-passes]).max() > 0.05 * size
    assert np.abs(marched[2 * passes :] - marched[: -2 * passes]).max() < 0.01 * size


# --- balls with mass -----------------------------------------------------------------------------


def test_a_step_that_rings_can_take_is_too_long_for_the_ball() -> None:
    """At 65,536 steps a second, twice what the rings ask for, a ball between its contacts blows up.

    Its motion there decays 232,000 times a second, 3.5 times a step, of which RK4 takes 2.785.
    Nothing shows in the rings' own frequencies. Ours takes more steps by itself; made to take these
    it says that it diverged, and gives no number from there on.
    """
    scene = FAN_RIG.replace(balls="with mass", contact_damping=122.0)
    made_to = simulate(scene, 0.1, RATE, step_rate=RATE)
    assert simulate(scene.replace(balls="massless"), 0.01, RATE).step_rate < RATE
    assert not made_to.completed
    assert "too few" in made_to.status
    assert np.isnan(made_to.outer_acceleration[-1]).all()
    assert np.isnan(made_to.race_loads(6000, 6010)).all()
    by_itself = simulate(scene, 0.1, RATE)
    assert by_itself.completed
    assert by_itself.step_rate > 2.0 * RATE


def test_a_ball_is_stuck_between_its_contacts() -> None:
    """What one thinks of first never finds the place of a ball, in the gap or under load.

    In the gap neither contact has any stiffness, and Newton's method has nothing to divide by. A
    loaded ball that is put where its outer contact carries what the inner one presses with, again
    and again, swings farther each time where the inner contact is the stiffer one, until it hops
    from contact to contact for ever. Ours rests in either case.
    """
    scene = presets["6205"].healthy()
    bearing = scene.bearing
    inner, outer = bearing.race_factors
    assert inner > outer
    force = bearing.centrifugal_load(15_000 * math.pi / 30.0)
    found = ball_positions(scene, [0.0], centrifugal_load=force)
    assert found.converged[0]

    gap = 0.5 * bearing.radial_clearance
    assert 1.5 * inner * max(-gap, 0.0) ** 0.5 + 1.5 * outer * max(-gap, 0.0) ** 0.5 == 0.0
    unloaded = found.load[0, 0] == 0.0
    assert unloaded.sum() >= 3
    assert found.load[1, 0, unloaded] == pytest.approx(force, rel=1e-9)

    heaviest = int(np.argmax(found.load[0, 0]))
    Q_i, Q_e = found.load[:, 0, heaviest]
    assert Q_e - Q_i == pytest.approx(force, rel=1e-9)
    place = (Q_e / outer) ** (2.0 / 3.0)
    both = place + (Q_i / inner) ** (2.0 / 3.0)
    visited = [place * (1.0 + 1e-6)]
    for _ in range(2000):
        pressed = inner * max(both - visited[-1], 0.0) ** 1.5
        visited.append(((pressed + force) / outer) ** (2.0 / 3.0))
    assert abs(visited[-1] - visited[-2]) > 0.5 * both
    assert abs(visited[-1] - visited[-3]) < 1e-9 * both
