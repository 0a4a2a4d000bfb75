"""Balls with mass in motion: the fan rig's equations written down here, by SciPy's DOP853.

Each ball has its place between two contacts of 2^1.5 K and dampers of 2 c, which may pull or not.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from numba import njit
from scipy.integrate import solve_ivp
from scipy.signal import welch

from bearingcore import ForceSamples, presets, simulate
from bearingcore.model.sweeps import Grid, Settings
from tests.outside import march
from tests.outside.test_charts import problem
from tests.outside.witness import witness

# the rig as printed; the damping is that of the text's range, given to both
N_BALLS, K, CLEARANCE, DAMPING = 14, 5453e6, 3e-6, 122.0
MASS, SUPPORT, SUPPORT_DAMPING, LOAD = 2.0, 212.2e6, 1648.2, -100.0
R_BALL, R_OUTER, DEPTH, EXTENT = 4e-3, 26.5e-3, 50e-6, math.radians(12.9)
CAGE = 0.5 * 2.0 * math.pi * 7.0 * (1.0 - 8.0 / 45.0)
BALL = 7800.0 * math.pi / 6.0 * (2.0 * R_BALL) ** 3
"""[kg]"""
ONE = 2.0**1.5 * K


@njit(cache=True)
def heavy_rates(t: float, y: np.ndarray, least: float) -> np.ndarray:
    """Rates of inner x, y, outer x, y and the balls' places [µm], then of their velocities.

    `least`: load [N] that a contact that touches may have, 0 or a pull without end.
    """
    n = 4 + N_BALLS
    rates = np.empty(2 * n)
    rates[:n] = y[n:]
    inner_x = inner_y = outer_x = outer_y = 0.0
    for j in range(N_BALLS):
        angle = CAGE * t + 2.0 * math.pi / N_BALLS * j
        c, s = math.cos(angle), math.sin(angle)
        away = (angle - 1.5 * math.pi + math.pi) % (2.0 * math.pi) - math.pi
        inside, deep, slope = 0.5 * EXTENT - abs(away), 0.0, 0.0
        if inside > 0.0:
            half = 0.5 * R_OUTER * inside
            deep = DEPTH
            if half < R_BALL and R_BALL - math.sqrt(R_BALL**2 - half**2) < DEPTH:
                root = math.sqrt(R_BALL**2 - half**2)
                deep = R_BALL - root
                slope = 0.5 * R_OUTER * half / root * (-1.0 if away > 0.0 else 1.0)
        u, v = 1e-6 * y[4 + j], 1e-6 * y[n + 4 + j]
        qi, qo = 1e-6 * (y[0] * c + y[1] * s), 1e-6 * (y[2] * c + y[3] * s)
        vi = 1e-6 * (y[n] * c + y[n + 1] * s + CAGE * (y[1] * c - y[0] * s))
        vo = 1e-6 * (y[n + 2] * c + y[n + 3] * s + CAGE * (y[3] * c - y[2] * s))
        pressed_i, pressed_o = qi - u - CLEARANCE, u - qo - deep
        push_i = push_o = 0.0
        if pressed_i > 0.0:
            push_i = max(ONE * pressed_i**1.5 + 2.0 * DAMPING * (vi - v), least)
        if pressed_o > 0.0:
            push_o = max(ONE * pressed_o**1.5 + 2.0 * DAMPING * (v - vo - CAGE * slope), least)
        inner_x, inner_y = inner_x + push_i * c, inner_y + push_i * s
        outer_x, outer_y = outer_x + push_o * c, outer_y + push_o * s
        turning = BALL * 22.5e-3 * CAGE**2 - BALL * 9.80665 * s
        rates[n + 4 + j] = 1e6 * (push_i - push_o + turning) / BALL
    rates[n] = -1e6 * inner_x / MASS
    rates[n + 1] = 1e6 * (LOAD - inner_y) / MASS
    for i, push in ((2, outer_x), (3, outer_y)):
        held = SUPPORT * 1e-6 * y[i] + SUPPORT_DAMPING * 1e-6 * y[n + i]
        rates[n + i] = 1e6 * (push - held) / MASS
    return rates


RATE = 65_536.0
PUSHED = np.arange(2000) / 40_000.0
SHOCK = np.where(PUSHED < 5e-3, -300.0 * np.sin(math.pi * PUSHED / 5e-3), 0.0)
SWEEP = 40.0 * np.sin(2.0 * math.pi * (50.0 + 15_000.0 * PUSHED) * PUSHED)
RIG = presets["fan-rig"].replace(contact_damping=DAMPING, balls="with mass")


def pushed(t: float) -> np.ndarray:
    """Force [N] on the shaft: a swept sine up to 950 Hz along x, a half sine along y."""
    return np.array([np.interp(t, PUSHED, SWEEP), np.interp(t, PUSHED, SHOCK)])


def marched(
    duration: float, law: str = "published", rate: float = RATE, *, is_pushed: bool = False
) -> tuple[np.ndarray, np.ndarray]:
    """Housing (n, 2): velocity [m/s] and acceleration [m/s²], from where our motion begins."""
    first = simulate(RIG.replace(contact_law=law), 1e-3)
    start = [first.inner_displacement[0], first.outer_displacement[0], first.ball_place[0, 0]]
    start, least = 1e6 * np.concatenate(start), 0.0 if law == "no tension" else -math.inf
    time = np.arange(round(duration * rate)) / rate
    n = start.size

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        out = heavy_rates(t, y, least)
        if is_pushed:
            out[n : n + 2] += 1e6 * pushed(t) / MASS
        return out

    made = solve_ivp(
        rates, (0.0, time[-1]), np.concatenate([start, 0.0 * start]), "DOP853", time,
        rtol=1e-8, atol=1e-7,
    )  # fmt: skip
    assert made.success
    late = [
        1e-6 * heavy_rates(t, y, least)[n + 2 : n + 4] for t, y in zip(time, made.y.T, strict=True)
    ]
    return 1e-6 * made.y[n + 2 : n + 4].T, np.array(late)


@witness(
    "balls: with mass", "function: simulate", "ball bearing: motion",
    by="SciPy's DOP853 on equations with a place for each ball, written down in the test",
    compared="velocity of the fan rig's housing over 20 ms, root mean square of what differs",
    within=2e-3,
)  # fmt: skip
@pytest.mark.parametrize(("law", "within"), [("published", 1e-4), ("no tension", 2e-3)])
def test_motion_of_heavy_balls(law: str, within: float) -> None:
    own, _ = marched(0.02, law)
    velocity = simulate(RIG.replace(contact_law=law), 0.02, RATE).outer_velocity
    off = np.sqrt(np.mean((velocity - own) ** 2, axis=0) / np.mean(own**2, axis=0))
    assert off.max() < within


@witness(
    "balls: *", "function: simulate",
    by="SciPy's DOP853 on the equations of `march.py`, and on those of heavy balls",
    compared="housing's velocity, the fan rig under a half-sine shock of three times its load and "
    "a swept sine: root mean square of what differs", within=1e-3,
)  # fmt: skip
@pytest.mark.parametrize(("balls", "within"), [("massless", 1e-4), ("with mass", 1e-3)])
def test_a_shock_and_a_swept_sine(balls: str, within: float) -> None:
    force = ForceSamples(np.column_stack([SWEEP, SHOCK]), 40_000.0)
    steps = 2.0 * RATE if balls == "massless" else None
    motion = simulate(RIG.replace(balls=balls), 0.03, RATE, force=force, step_rate=steps)
    one = replace(problem("fan-rig"), c=DAMPING)
    packed = one.packed()

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        out = march.rates(t, y, *packed)
        out[4:6] += 1e6 * pushed(t) / MASS
        return out

    if balls == "massless":
        made = solve_ivp(
            rates, (0.0, 0.03), one.start(), "DOP853", motion.time, rtol=1e-8, atol=1e-8,
            max_step=1e-4,
        )  # fmt: skip
        own = 1e-6 * made.y[6:8].T
    else:
        own, _ = marched(0.03, is_pushed=True)
    off = np.sqrt(np.mean((motion.outer_velocity - own) ** 2, axis=0) / np.mean(own**2, axis=0))
    assert off.max() < within


@witness(
    "balls: with mass", "function: simulate",
    by="the polynomial of classical Runge-Kutta at a ball's decay between two dampers of 2 c",
    compared="steps a second below which no motion is given", within=1e-3,
)  # fmt: skip
def test_too_few_steps_for_heavy_balls_give_no_motion() -> None:
    """A motion of half as many said "completed", with ten times the vibration (6205)."""
    growth = np.polynomial.Polynomial([1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0])
    limit = max(-root.real for root in (growth - 1.0).roots() if abs(root.imag) < 1e-9)
    least = 4.0 * DAMPING / BALL / limit
    assert RATE < least < 2.0 * RATE
    refused = simulate(RIG, 1e-3, RATE, step_rate=RATE)
    assert not refused.completed
    assert np.isnan(refused.outer_acceleration).all()
    needed = "".join(filter(str.isdigit, refused.reason.rpartition("need ")[2]))
    assert float(needed) == pytest.approx(least, rel=1e-3)
    assert simulate(RIG, 1e-3, RATE, step_rate=2.0 * RATE).completed


@witness(
    "output: mass_share",
    by="SciPy's DOP853 on both equations of motion, densities by SciPy's welch",
    compared="share of the power from 2.1 to 10 kHz that mass adds, in 70 ms", within=0.01,
)  # fmt: skip
@pytest.mark.proof
def test_share_of_the_power_that_mass_adds() -> None:
    fine = 4.0 * RATE  # strikes are short: sampled at 65 kHz they would fold into the band
    _, heavy = marched(0.07, rate=fine)
    one, time = replace(problem("fan-rig"), c=DAMPING), np.arange(round(0.07 * fine)) / fine
    light = one.accelerations(time, one.solved(one.start(), time, 1e-9))

    def power(signal: np.ndarray) -> float:
        settled = signal[len(signal) // 2 :]
        frequency, density = welch(settled, fine, nperseg=4 * 2185, axis=0)
        return float(density[(frequency >= 2100.0) & (frequency < 10_000.0)].sum())

    settings = Settings(duration=0.07, band_low=2100.0, band_high=10_000.0)
    _, numbers = Grid.of(RIG, {"fz": [0.0]}, ["mass_share"], settings).compute()
    assert numbers["mass_share"][0] == pytest.approx(1.0 - power(light) / power(heavy), abs=0.01)


@witness(
    "law: *", "function: simulate", by="SciPy's DOP853 on the equations of `march.py`",
    compared="housing's motion by the steps that are chosen: dampers 800 times as strong, and a "
    "load of 50 mN on a support 40 times as soft, with and without unbalance", within=0.05,
)  # fmt: skip
@pytest.mark.parametrize("law", ["published", "no tension"])
@pytest.mark.parametrize(
    ("damping", "load", "soft", "unbalance", "within"),
    [
        (1e5, -100.0, 1.0, 0.0, 0.02),
        (DAMPING, -0.05, 40.0, 0.0, 0.05),
        (DAMPING, -0.05, 40.0, 1e-3, 0.02),
    ],
)
def test_steps_are_fine_enough(
    law: str, damping: float, load: float, soft: float, unbalance: float, within: float
) -> None:
    """One law diverged with strong dampers, the other "completed" with thrice the acceleration.

    Under 50 mN steps were those of its slow modes, 5500 a second: 15 % without tension.
    """
    speed = RIG.shaft_speed if soft == 1.0 else 200.0
    one = replace(
        problem("fan-rig", shaft=speed), c=damping, no_tension=law == "no tension",
        force=np.array([0.0, load, 0.0, 0.0, 0.0]), stiffness=np.full(2, SUPPORT / soft),
        unbalance=unbalance * speed**2, shaft=speed,
    )  # fmt: skip
    scene = RIG.replace(
        balls="massless", contact_damping=damping, contact_law=law, shaft_speed=speed, fy=load,
        stiffness_x=SUPPORT / soft, stiffness_y=SUPPORT / soft, unbalance=unbalance,
    )  # fmt: skip
    motion = simulate(scene, 0.01, RATE)
    assert motion.completed
    own = 1e-6 * one.solved(one.start(), motion.time)[:, 6:8]
    off = np.sqrt(np.mean((motion.outer_velocity - own) ** 2, axis=0) / np.mean(own**2, axis=0))
    assert off.max() < within


@witness(
    "law: no tension", "function: simulate", by="SciPy's DOP853 on the equations of `march.py`",
    compared="level of the housing's velocity, a 7208 under 0.5 N whose balls come and go",
    within=0.08,
)  # fmt: skip
def test_steps_are_doubled_where_contacts_let_go(monkeypatch: pytest.MonkeyPatch) -> None:
    """At 33 and 66 kHz levels are 18 and 45 % off. Where no steps are enough there is no motion."""
    scene = presets["7208-25deg"].replace(
        contact_law="no tension", contact_damping=1e3, fy=-0.5, fz=0.5
    )
    force = np.array([0.0, -0.5, 0.5, 0.0, 0.0])
    one = replace(problem("7208-25deg"), c=1e3, no_tension=True, force=force)
    motion = simulate(scene, 0.02, RATE)
    own = 1e-6 * one.solved(one.start(), motion.time, 1e-7)[:, 9:12]
    level, true = (
        np.sqrt(np.mean(v[len(v) // 2 :] ** 2, axis=0)) for v in (motion.outer_velocity, own)
    )
    assert level == pytest.approx(true, rel=0.08)
    monkeypatch.setattr("bearingcore.model.dynamics._motion.SAME_LEVEL", 0.0)
    refused = simulate(scene, 1e-3, RATE)
    assert "too few" in refused.reason
    assert np.isnan(refused.outer_acceleration).all()
