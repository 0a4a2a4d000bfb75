"""A row pressed on with an interference: every element carries before the shaft does.

Witnesses: closed forms of N equal springs around a circle, and the balance of forces under a load
found by SciPy from Q = K δ^n alone. Nothing of the core but the bearing's own numbers is in them.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq, minimize

from bearingcore import (
    Bearing,
    Scene,
    ball_positions,
    contact_pressures,
    equilibrium,
    life,
    limits,
    modes,
    orbit,
    presets,
    simulate,
    stiffness_maps,
)
from bearingcore.model.dynamics import MotionStatus, OrbitStatus
from bearingcore.model.statics._status import StaticStatus

TIGHT = 10e-6
"""[m] Half of an interference of 20 µm on the diameter."""

BALLS, ROLLERS = presets["6205"].healthy(), presets["nu208"].healthy()
RATING = 20_000.0


def pressed(scene: Scene, by: float = TIGHT, **changes: object) -> Scene:
    bearing = scene.bearing.replace(radial_clearance=-by)
    return dataclasses.replace(scene, bearing=bearing).replace(**changes)


def law(bearing: Bearing) -> tuple[int, float, float]:
    """N, K and n of Q = K δ^n."""
    exponent = 1.5 if bearing.roller_length is None else 10.0 / 9.0
    return bearing.n_balls, bearing.load_deflection_factor, exponent


@pytest.mark.parametrize("scene", [BALLS, ROLLERS], ids=["balls", "rollers"])
def test_without_a_load_all_elements_carry_alike(scene: Scene) -> None:
    """Equal springs around a circle: Q = K δ^n each, k_xx = k_yy = N/2 n K δ^(n−1)."""
    N, K, n = law(scene.bearing)
    state = equilibrium(pressed(scene, fy=0.0), [0.0, 0.1])
    assert state.converged.all()
    assert np.abs(state.displacement).max() < 1e-18
    assert state.ball_load == pytest.approx(np.full((2, N), K * TIGHT**n), rel=1e-12)
    stiff = 0.5 * N * n * K * TIGHT ** (n - 1.0)
    assert state.term("k_xx") == pytest.approx(stiff, rel=1e-12)
    assert state.term("k_yy") == pytest.approx(stiff, rel=1e-12)
    assert np.abs(state.term("k_xy")).max() < 1e-12 * stiff


def test_balls_pressed_together_hold_the_ring_along_the_shaft_and_rollers_do_not() -> None:
    """Swivelling about centres A0 apart, N Q/(A0 + δ) along it; between straight races nothing."""
    N, K, n = law(BALLS.bearing)
    swivel = N * K * TIGHT**n / (4.13e-3 + 4.13e-3 - 7.94e-3 + TIGHT)
    drawn = Bearing.from_drawing(N, 7.94e-3, 39.04e-3, 4.13e-3, 4.13e-3, contact_angle=0.0)
    row = drawn.replace(load_deflection_factor=K, radial_clearance=-TIGHT)
    free = dataclasses.replace(BALLS, bearing=row, dofs=None).replace(fy=0.0)
    state = equilibrium(free, [0.0])
    assert state.converged[0]
    assert state.term("k_zz")[0] == pytest.approx(swivel, rel=1e-12)
    tilt = 0.5 * row.groove_center_radius**2 * swivel
    assert state.stiffness[0, 3, 3] == pytest.approx(tilt, rel=1e-12)
    assert equilibrium(pressed(ROLLERS, fy=0.0), [0.0]).term("k_zz")[0] == 0.0


@pytest.mark.parametrize("scene", [BALLS, ROLLERS], ids=["balls", "rollers"])
@pytest.mark.parametrize("load", [1e-6, 50.0, 3000.0, 60_000.0])
def test_under_a_load_it_is_the_balance_that_scipy_finds(scene: Scene, load: float) -> None:
    """Σ K (δ0 + y sin φ)^n sin φ = F by `brentq`: all carry, or half of them have let go."""
    N, K, n = law(scene.bearing)
    s = np.sin(2.0 * math.pi / N * np.arange(N) - 0.5 * math.pi)

    def loads(down: float) -> np.ndarray:
        return np.asarray(K * np.maximum(TIGHT - down * s, 0.0) ** n)

    down = brentq(lambda y: -loads(y) @ s - load, 0.0, 1e-3, xtol=1e-22, rtol=1e-14)
    state = equilibrium(pressed(scene, fy=-load), [-0.5 * math.pi])
    assert state.converged[0]
    assert -state.displacement[0, 1] == pytest.approx(down, rel=1e-8)
    assert state.ball_load[0] == pytest.approx(loads(down), rel=1e-9, abs=1e-9 * load)
    assert (state.loaded_balls[0] == N) == (down < TIGHT)


def test_a_row_at_an_angle_leans_on_the_shaft_s_other_bearing() -> None:
    """Held, A = |(A0 cos α + δ, A0 sin α)|; free, it slides off. Energy of a load by `minimize`."""
    lone = presets["7208-25deg"].healthy()
    b, (N, K, n) = lone.bearing, law(lone.bearing)
    A0 = b.inner_groove_radius + b.outer_groove_radius - b.ball_diameter  # type: ignore[operator]
    ca, sa = math.cos(b.contact_angle), math.sin(b.contact_angle)
    held = equilibrium(pressed(lone, fy=0.0, fz=0.0), [0.0], ("x", "y"))
    depth = math.hypot(A0 * ca + TIGHT, A0 * sa) - A0
    assert held.ball_load[0] == pytest.approx(np.full(N, K * depth**n), rel=1e-9)
    free = equilibrium(pressed(lone, fy=0.0, fz=0.0), [0.0], ("x", "y", "z"))
    assert free.status[0] == StaticStatus.NOTHING_TOUCHES
    phi = 2.0 * math.pi / N * np.arange(N)

    def energy(q: np.ndarray) -> float:
        r = q[0] * np.cos(phi) + q[1] * np.sin(phi) + 1e6 * TIGHT
        A = np.hypot(1e6 * A0 * ca + r, 1e6 * A0 * sa + q[2])
        stored = K / (n + 1.0) * (1e-6 * np.maximum(A - 1e6 * A0, 0.0)) ** (n + 1.0)
        return float(1e6 * stored.sum() + 800.0 * q[1] - 1500.0 * q[2])

    tightest = {"xatol": 1e-9, "fatol": 1e-12, "maxiter": 20_000, "maxfev": 20_000}
    least = minimize(energy, [0.0, -5.0, 0.0], method="Nelder-Mead", options=tightest)
    both = equilibrium(pressed(lone, fy=-800.0, fz=1500.0), [0.0], ("x", "y", "z"))
    assert both.converged[0]
    assert 1e6 * both.displacement[0, :3] == pytest.approx(least.x, abs=2e-3)


@pytest.mark.parametrize("name", ["6205", "fan-rig", "7208-25deg", "nu208", "30206-back-to-back"])
def test_every_question_takes_an_interference(name: str) -> None:
    """Every kind of one row; a ring that stays in its place is a periodic motion too."""
    scene = presets[name].healthy()
    one_row = scene.bearing.replace(rows=(), radial_clearance=-TIGHT)
    scene = dataclasses.replace(scene, bearing=one_row, dofs=("x", "y"))
    state = equilibrium(scene)
    assert state.converged.all()
    assert (state.loaded_balls == one_row.n_balls).all()
    assert np.isfinite(modes(scene).frequency).all()
    moved = simulate(scene, 0.02)
    assert moved.status is MotionStatus.COMPLETED
    assert moved.history[-1, 0, 1] - moved.history[-1, 3, 1] == pytest.approx(
        state.displacement[:, 1].mean(), rel=2e-3, abs=2e-8
    )
    assert orbit(scene).status is OrbitStatus.STABLE
    assert np.isfinite(stiffness_maps(scene, [0.0], [0.0]).stiffness).all()
    assert all(limit.sentence for limit in limits(scene))


def test_modes_are_those_of_two_bodies_on_the_pressed_row() -> None:
    """`scipy.linalg.eigh` of both masses, the closed-form stiffness and the support's."""
    scene = pressed(ROLLERS, fy=0.0)
    N, K, n = law(scene.bearing)
    k = 0.5 * N * n * K * TIGHT ** (n - 1.0)
    [ground] = scene.support.stiffness(("y",))
    [inner], [outer] = (scene.support.inertia(body, ("y",)) for body in ("inner", "outer"))
    squared = eigh([[k, -k], [-k, k + ground]], np.diag([inner, outer]), eigvals_only=True)
    wanted = np.sqrt(squared) / (2.0 * math.pi)
    ringing = modes(scene, [0.0])
    for frequency in wanted:
        assert np.abs(ringing.undamped_frequency[0] / frequency - 1.0).min() < 1e-9


def test_the_interference_alone_wears_a_bearing_out() -> None:
    """Lundberg and Palmgren: L ~ Q^-3, Q ~ δ^1.5, so twice as tight lasts 2^-4.5 as long; Hertz:
    p ~ Q^(1/3) ~ √δ.
    """
    once, twice = (pressed(BALLS, by, fy=0.0) for by in (TIGHT, 2.0 * TIGHT))
    short, long = (life(scene, RATING).million_revolutions for scene in (twice, once))
    assert short / long == pytest.approx(2.0**-4.5, rel=1e-9)
    pressures = [contact_pressures(one).inner.greatest_pressure for one in (twice, once)]
    assert pressures[0] / pressures[1] == pytest.approx(math.sqrt(2.0), rel=1e-9)


def test_balls_with_mass_share_the_interference_between_both_contacts() -> None:
    """At rest both races carry the same: two springs in series are the K of the row."""
    positions = ball_positions(pressed(BALLS, fy=0.0), [0.0], centrifugal_load=0.0)
    N, K, n = law(BALLS.bearing)
    assert positions.load[:, 0] == pytest.approx(np.full((2, N), K * TIGHT**n), rel=1e-9)
