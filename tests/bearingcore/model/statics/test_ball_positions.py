"""Static ball positions under centrifugal load, held to force balance and to independent sums."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from bearingcore import Bearing, Load, Scene, equilibrium, presets
from bearingcore.model.statics import EquilibriumWithMass, ball_positions, static_state
from tests.helpers.random_balls import faults, random_scene
from tests.outside.witness import witness

POUND = 4.4482216152605


@pytest.mark.parametrize("name", [n for n in presets if not presets[n].bearing.kind.mass_unknown])
def test_without_centrifugal_load_it_is_the_massless_state(name: str) -> None:
    """Both contacts lie on one line: displacement, loads and stiffness to 1e-12."""
    scene = presets[name]
    massless = equilibrium(scene)
    positions = ball_positions(scene, centrifugal_load=0.0)
    standing = ball_positions(scene.replace(shaft_speed=0.0))
    for state in (positions, standing):
        assert state.converged.all()
        size = np.abs(massless.displacement).max()
        assert np.abs(state.displacement - massless.displacement).max() <= 1e-12 * size
        assert np.abs(state.load - massless.ball_load).max() <= 1e-12 * massless.ball_load.max()
        terms = np.abs(massless.stiffness).max(axis=0)
        assert np.all(
            np.abs(state.stiffness - massless.stiffness).max(axis=0) <= 1e-12 * terms.max()
        )
        loaded = massless.ball_load > 1e-6 * massless.ball_load.max()
        for race in range(2):
            angle = state.contact_angle[race][loaded]
            assert angle == pytest.approx(massless.contact_angle[loaded], abs=1e-9)


def test_centrifugal_loads_as_published() -> None:
    """Fan rig at 7 Hz 0.0154 N (7850 kg/m³); 6205 at 1796 rpm 0.224 N, at 15,000 rpm 15.62 N.

    An NU 208's roller of 11 x 11 mm, cage at 0.5 (1 − 11/60.5) of 3000 rpm: closed form.
    """
    bearing = presets["6205"].bearing
    assert bearing.centrifugal_load(15_000 * math.pi / 30.0) == pytest.approx(15.62, abs=0.01)
    assert bearing.centrifugal_load(1796 * math.pi / 30.0) == pytest.approx(0.224, abs=0.001)
    fan = presets["fan-rig"].bearing.replace(density=7850.0)
    assert fan.centrifugal_load(2.0 * math.pi * 7.0) == pytest.approx(0.0154, abs=1e-4)
    roller = presets["nu208"].bearing
    mass, cage = math.pi / 4.0 * 0.011**3 * 7800.0, 50.0 * math.pi * (1.0 - 11.0 / 60.5)
    assert roller.ball_mass == pytest.approx(mass)
    assert roller.centrifugal_load(100.0 * math.pi) == pytest.approx(mass * cage**2 * 30.25e-3)


@witness(
    "balls: with mass",
    "function: ball_positions",
    by="Harris and Mindel (1973), Fig. 15",
    compared="balance of a ball between both races; as its angle is fitted, not the stiffness K",
    within=1e-3,
)
def test_force_balance_of_harris_and_mindel() -> None:
    """Fig. 15 of Harris and Mindel (1973): 21 balls, 3000 lb along the shaft, F_c 303.45 lb.

    The contact angle is chosen so that the inner one comes out as printed (its geometry is not an
    equilibrium of its angles); the other three numbers then follow from balance alone.
    """

    def solve(contact_angle: float):
        bearing = Bearing.from_drawing(
            21, 22.225e-3, 205e-3, 0.52 * 22.225e-3, 0.52 * 22.225e-3, contact_angle=contact_angle
        )
        scene = Scene(bearing, presets["fan-rig"].healthy().defect, Load(fz=3000.0 * POUND), 1e3,
                      presets["fan-rig"].support)  # fmt: skip
        return ball_positions(scene, [0.0], centrifugal_load=303.45 * POUND)

    printed = math.radians(29.762)
    angle = brentq(
        lambda a: solve(a).contact_angle[0, 0, 0] - printed, math.radians(5.0), math.radians(35.0)
    )
    positions = solve(angle)
    Q_i, Q_e = positions.load[:, 0, 0] / POUND
    alpha_i, alpha_e = positions.contact_angle[:, 0, 0]
    assert Q_i == pytest.approx(287.76, rel=1e-3)
    assert Q_e == pytest.approx(571.07, rel=1e-3)
    assert math.degrees(alpha_e) == pytest.approx(14.475, rel=1e-3)
    assert 21 * Q_i * math.sin(alpha_i) == pytest.approx(2999.7, rel=1e-3)
    assert Q_e * math.cos(alpha_e) - Q_i * math.cos(alpha_i) == pytest.approx(303.14, rel=1.1e-3)


def test_random_scenes_are_right_or_say_that_they_are_not() -> None:
    rng = np.random.default_rng(7)
    solved = 0
    for _ in range(150):
        positions = ball_positions(random_scene(rng), [rng.uniform(0.0, 6.3)])
        solved += int(positions.converged[0])
        assert faults(positions, 0) == ""
    assert solved >= 140


FAST = presets["7208-25deg"].replace(shaft_speed=1500.0, balls="with mass")


def test_the_static_state_is_what_the_scene_asks_for() -> None:
    """Massless balls: `equilibrium`. With mass: on each ball the races' loads differ by F_c."""
    massless = FAST.replace(balls="massless")
    plain = static_state(massless, [0.1])
    assert not isinstance(plain, EquilibriumWithMass)
    assert np.array_equal(plain.ball_load, equilibrium(massless, [0.1]).ball_load)
    state = static_state(FAST)
    assert isinstance(state, EquilibriumWithMass)
    assert state.converged.all()
    F_c = FAST.bearing.centrifugal_load(1500.0)
    inner, outer = state.inner_load, state.ball_load
    carries = inner > 0.0
    alpha_i, alpha_o = state.inner_contact_angle[carries], state.contact_angle[carries]
    Q_i, Q_o = inner[carries], outer[carries]
    size = Q_o.max()
    assert Q_o * np.cos(alpha_o) - Q_i * np.cos(alpha_i) == pytest.approx(F_c, abs=1e-7 * size)
    assert Q_o * np.sin(alpha_o) == pytest.approx(Q_i * np.sin(alpha_i), abs=1e-7 * size)
    assert outer[~carries] == pytest.approx(F_c, rel=1e-6), "the others ride on the outer race"
    assert np.array_equal(state.loaded_balls, carries.sum(axis=1))
    changed = np.abs(state.term("k_yy") / static_state(massless).term("k_yy") - 1.0)
    assert changed.max() > 1e-3
