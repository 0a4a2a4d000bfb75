"""Rows of balls, self-aligning bearings and rollers: other numbers, not other code."""

import dataclasses
import math
from functools import partial

import numpy as np
import pytest

from bearingcore import Bearing, Scene, equilibrium, presets, simulate
from bearingcore.bearings.hertz import spherical_contact
from bearingcore.bearings.rows import Row
from bearingcore.errors import FieldError

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
UNLOADED = LIEW_LIM.replace(fy=0.0, fz=0.0, extent=0.0)
LOW_HIGH = {"face-to-face": 15_157.0, "back-to-back": 147_945.0}


def preloaded(bearing: Bearing, by: float) -> Bearing:
    """All rows with a radial clearance of −by [m]."""
    clearance = -by - bearing.radial_clearance
    rows = tuple(dataclasses.replace(row, clearance=clearance) for row in bearing.rows)
    return bearing.replace(rows=rows)


@pytest.mark.parametrize("arrangement", list(LOW_HIGH))
def test_pairs_have_the_stiffness_that_an_independent_program_found(arrangement: str) -> None:
    pair = preloaded(LIEW_LIM.bearing.paired(16e-3, arrangement), 5e-6)
    state = equilibrium(UNLOADED.replace(bearing=pair), [0.0, 0.07])
    assert state.converged.all()
    assert state.term("k_yy") == pytest.approx(437.4e6, rel=1e-4)
    assert state.term("k_rxrx") == pytest.approx(LOW_HIGH[arrangement], rel=1e-4)
    assert np.abs(state.term("k_yrx")).max() < 1e-9 * state.term("k_yy").max()


def test_a_preload_by_distance_presses_both_rows_and_not_in_tandem() -> None:
    for arrangement in LOW_HIGH:
        pair = LIEW_LIM.bearing.paired(16e-3, arrangement, preload=8e-6)
        state = equilibrium(UNLOADED.replace(bearing=pair), [0.0])
        assert state.converged.all()
        assert state.ball_load.min() > 10.0
        np.testing.assert_allclose(state.ball_load, state.ball_load[0, 0], rtol=1e-9)
    with pytest.raises(ValueError, match="preload"):
        LIEW_LIM.bearing.paired(16e-3, "tandem", preload=8e-6)
    with pytest.raises(ValueError, match="arrangement is 'side by side'"):
        LIEW_LIM.bearing.paired(16e-3, "side by side")


def test_turning_a_self_aligning_bearing_moves_no_ball() -> None:
    bearing = Bearing.self_aligning(12, 7.94e-3, 20e-3, 4.13e-3, math.radians(12.0))
    stiff = []
    for by in (5e-6, 1e-6):
        tight = preloaded(bearing, by)
        state = equilibrium(UNLOADED.replace(bearing=tight), [0.0])
        lever = tight.groove_center_radius
        share = state.term("k_rxrx")[0] / (lever**2 * state.term("k_yy")[0])
        left = (state.ball_load.sum() * tight.groove_center_distance) / (
            lever**2 * state.term("k_yy")[0]
        )
        assert share < 0.5 * left  # what linearised rotations leave: of the order of Σ Q A0
        stiff.append(share)
    assert stiff[0] == pytest.approx(5.0 * stiff[1], rel=0.01)  # and falls with the preload
    assert stiff[0] < 3e-4


def test_a_ball_in_a_sphere_is_hertz_for_two_spheres() -> None:
    D, R, E, nu = 8e-3, 20e-3, 210e9, 0.3
    radius = 1.0 / (2.0 / D - 1.0 / R)
    expected = 4.0 / 3.0 * E / (2.0 * (1.0 - nu**2)) * math.sqrt(radius)
    assert spherical_contact(D, R, E, nu).load_deflection_factor == pytest.approx(expected)


ROLLERS = Bearing.cylindrical(12, 10e-3, 10e-3, 50e-3)


def test_one_and_two_loaded_rollers_follow_the_line_law() -> None:
    """Q = 35 948 l^(8/9) δ^(10/9), N and mm; straight below, or half a spacing to either side."""
    K = 35_948.0 * 10.0 ** (8.0 / 9.0)
    loose = dataclasses.replace(ROLLERS, radial_clearance=20e-6)  # neighbours stay free
    scene = FAN_RIG.replace(bearing=loose, extent=0.0, fy=-100.0)
    below = equilibrium(scene, [math.radians(270.0)])
    assert (below.ball_load > 0.0).sum() == 1
    mm = (100.0 / K) ** 0.9
    assert -below.displacement[0, 1] == pytest.approx(20e-6 + 1e-3 * mm, rel=1e-9)
    beside = equilibrium(scene, [math.radians(270.0) + 0.5 * ROLLERS.ball_spacing])
    assert (beside.ball_load > 0.0).sum() == 2
    lean = math.cos(0.5 * ROLLERS.ball_spacing)
    mm = (50.0 / lean / K) ** 0.9
    assert -beside.displacement[0, 1] == pytest.approx((20e-6 + 1e-3 * mm) / lean, rel=1e-9)
    assert 1e3 * mm < 1.0


def test_rollers_carry_radial_loads_only_and_say_so() -> None:
    scene = FAN_RIG.replace(bearing=ROLLERS, depth=20e-6)
    assert scene.active_dofs == ("x", "y")
    assert simulate(scene, 0.02).completed
    with pytest.raises(ValueError, match="cylindrical rollers carry radial loads only"):
        scene.replace(fz=10.0)
    words = "x and y, as cylindrical rollers carry radial loads only"
    for ask in (scene.replace, partial(equilibrium, scene)):
        with pytest.raises(FieldError, match=words) as found:
            ask(dofs=("x", "y", "z"))
        assert found.value.field == "dofs"
    assert Scene.from_toml(scene.to_toml()) == scene


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"facing": 0}, "facing of a row is 0; allowed: 1 or -1"),
        ({"place": math.inf}, "place of a row"),
        ({"clearance": 1.0}, "clearance of a row"),
    ],
)
def test_rows_refuse_what_cannot_be(change: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Row(**change)


@pytest.mark.parametrize("arrangement", ["back-to-back", "face-to-face", "tandem"])
def test_a_pair_knows_how_it_stands_and_can_be_moved(arrangement: str) -> None:
    preload = 0.0 if arrangement == "tandem" else 6e-6
    pair = LIEW_LIM.bearing.paired(16e-3, arrangement, preload)
    assert pair.arrangement == arrangement
    assert (pair.row_distance, pair.preload) == (pytest.approx(16e-3), pytest.approx(preload))
    assert pair.total_balls == 24
    assert pair.respaced(20e-3) == LIEW_LIM.bearing.paired(20e-3, arrangement, preload)
    if preload:
        assert pair.respaced(preload=2e-6) == LIEW_LIM.bearing.paired(16e-3, arrangement, 2e-6)
    assert LIEW_LIM.bearing.arrangement == ""
    with pytest.raises(ValueError, match="two rows that form a pair"):
        LIEW_LIM.bearing.respaced(20e-3)


def test_a_self_aligning_bearing_carries_its_contacts() -> None:
    """Groove radius and modulus come back from its numbers; contacts in series make K."""
    made = Bearing.self_aligning(
        12, 7.94e-3, 20e-3, 4.13e-3, math.radians(12.0), youngs_modulus=205e9
    )
    assert made.groove_radius("inner") == pytest.approx(4.13e-3, rel=1e-12)
    inner = made.race_contact("inner")
    assert inner.youngs_modulus == pytest.approx(205e9, rel=1e-9)
    factors = made.race_factors
    assert factors[0] == pytest.approx(inner.load_deflection_factor, rel=1e-9)
    assert factors[1] == pytest.approx(
        spherical_contact(7.94e-3, 20e-3, 205e9, 0.3).load_deflection_factor, rel=1e-9
    )
    distances = made.kind.race_distances(made)
    assert sum(distances) == pytest.approx(made.groove_center_distance)
    assert distances[1] == pytest.approx(20e-3 - 3.97e-3)
    scene = FAN_RIG.replace(bearing=made, depth=20e-6)
    assert scene.active_dofs == ("x", "y", "z")


def test_pressure_of_a_roller_is_that_of_hertz() -> None:
    """The load is the pressure over the contact's half ellipse, and b is that of the textbook."""
    contact = ROLLERS.race_contact("inner")
    a, b = contact.semi_axes(1000.0)
    p = contact.greatest_pressure(1000.0)
    assert float(a) == pytest.approx(5e-3)
    assert float(0.5 * math.pi * p * b * 2.0 * a) == pytest.approx(1000.0)
    radius = 1.0 / (1.0 / 5e-3 + 1.0 / 20e-3)  # roller on the inner race of 20 mm
    E = 210e9 / (2.0 * (1.0 - 0.3**2))
    assert float(b) == pytest.approx(math.sqrt(4.0 * 1000.0 * radius / (math.pi * 10e-3 * E)))
    assert ROLLERS.race_contact("outer").greatest_pressure(1000.0) < p
    assert float(contact.semi_axes(0.0)[0]) == float(contact.semi_axes(0.0)[1]) == 0.0


def test_rollers_follow_their_dimensions_and_never_become_balls() -> None:
    longer = ROLLERS.replace(roller_length=20e-3, pitch_diameter=60e-3)
    assert longer == Bearing.cylindrical(12, 10e-3, 20e-3, 60e-3)
    with pytest.raises(ValueError, match="roller_length"):
        ROLLERS.replace(roller_length=None)
    with pytest.raises(ValueError, match="roller_length"):
        FAN_RIG.bearing.replace(roller_length=10e-3)
    with pytest.raises(ValueError, match=r"roller_length is 0\.01"):
        presets["1208"].bearing.replace(roller_length=0.01)
