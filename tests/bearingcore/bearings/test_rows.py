"""Rows of balls, self-aligning bearings and rollers: other numbers, not other code."""

import dataclasses
import math
from functools import partial

import numpy as np
import pytest

from bearingcore import Bearing, Scene, equilibrium, presets, simulate
from bearingcore.bearings._hertz import spherical_contact
from bearingcore.errors import FieldError

LIEW_LIM, FAN_RIG = presets["liew-lim"], presets["fan-rig"]
UNLOADED = LIEW_LIM.replace(fy=0.0, fz=0.0, extent=0.0)


def preloaded(bearing: Bearing, by: float) -> Bearing:
    """All rows with a radial clearance of −by [m]."""
    clearance = -by - bearing.radial_clearance
    rows = tuple(dataclasses.replace(row, clearance=clearance) for row in bearing.rows)
    return bearing.replace(rows=rows)


def test_a_preload_by_distance_presses_both_rows_and_not_in_tandem() -> None:
    for arrangement in ("face-to-face", "back-to-back"):
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


ROLLERS = Bearing.cylindrical(12, 10e-3, 10e-3, 50e-3)


def test_rollers_carry_radial_loads_only_and_say_so() -> None:
    scene = FAN_RIG.replace(bearing=ROLLERS, depth=20e-6)
    assert scene.active_dofs == ("x", "y")
    assert simulate(scene, 0.02).completed
    with pytest.raises(ValueError, match="cylindrical rollers carry radial loads only"):
        scene.replace(fz=10.0)
    words = "x and y, as cylindrical rollers carry radial loads only"
    for ask in (scene.replace, partial(equilibrium, scene)):
        with pytest.raises(FieldError, match=words) as refusal:
            ask(dofs=("x", "y", "z"))
        assert refusal.value.field == "dofs"
    assert Scene.from_toml(scene.to_toml()) == scene


@pytest.mark.parametrize("arrangement", ["back-to-back", "face-to-face", "tandem"])
def test_a_pair_knows_how_it_stands_and_can_be_moved(arrangement: str) -> None:
    preload = 0.0 if arrangement == "tandem" else 6e-6
    pair = LIEW_LIM.bearing.paired(16e-3, arrangement, preload)
    assert pair.arrangement == arrangement
    assert (pair.row_distance, pair.preload) == (pytest.approx(16e-3), pytest.approx(preload))
    assert pair.total_balls == 24
    assert pair.replace(row_distance=20e-3) == LIEW_LIM.bearing.paired(20e-3, arrangement, preload)
    if preload:
        assert pair.replace(preload=2e-6) == LIEW_LIM.bearing.paired(16e-3, arrangement, 2e-6)
    assert LIEW_LIM.bearing.arrangement == ""
    with pytest.raises(ValueError, match="two rows that form a pair"):
        LIEW_LIM.bearing.replace(row_distance=20e-3)


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


def test_rollers_follow_their_dimensions() -> None:
    longer = ROLLERS.replace(roller_length=20e-3, pitch_diameter=60e-3)
    assert longer == Bearing.cylindrical(12, 10e-3, 20e-3, 60e-3)
