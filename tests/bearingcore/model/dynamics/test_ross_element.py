"""The bearing of a scene for rotors in ROSS."""

import math
import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from bearingcore import equilibrium, presets, static_state, to_ross
from bearingcore.model.dynamics import contact_damping
from bearingcore.model.dynamics._modes import modes_at
from bearingcore.model.statics import default_cage_angles

SCENE = presets["6205"].replace(fx=300.0)
SPEEDS = (0.0, 1000.0, 2000.0, 3000.0)


@pytest.fixture
def element(monkeypatch: pytest.MonkeyPatch) -> Any:
    """ROSS as something that keeps what it is given, so that numbers are tested without it."""
    monkeypatch.setitem(sys.modules, "ross", SimpleNamespace(BearingElement=SimpleNamespace))
    return to_ross


def test_stiffness_is_the_mean_of_the_static_states_at_each_speed(element: Any) -> None:
    bearing = element(SCENE, SPEEDS, node=3, tag="drive end")
    assert (bearing.n, bearing.tag, list(bearing.frequency)) == (3, "drive end", list(SPEEDS))
    angles = default_cage_angles(SCENE)[:-1]
    assert bearing.kyy[0] == pytest.approx(equilibrium(SCENE, angles).term("k_yy").mean(), rel=1e-6)
    fast = static_state(SCENE.replace(shaft_speed=3000.0, balls="with mass"), angles)
    for name in ("xx", "yy", "zz", "xy"):
        term = getattr(bearing, f"k{name}")
        assert term[3] == pytest.approx(fast.term(f"k_{name}").mean(), rel=1e-12)
    assert bearing.kyy[3] > 1.01 * bearing.kyy[0], "centrifugal load counts"
    assert abs(bearing.kxy[3]) > 1e6


def test_damping_is_that_of_the_loaded_contacts(element: Any) -> None:
    bearing = element(SCENE.healthy(), [0.0])
    loaded = equilibrium(SCENE.healthy(), default_cage_angles(SCENE)[:-1]).loaded_balls.mean()
    whole = bearing.cxx[0] + bearing.cyy[0] + bearing.czz[0]
    assert whole == pytest.approx(contact_damping(SCENE) * loaded, rel=1e-3)


def test_rollers_without_known_mass_are_the_same_at_all_speeds(element: Any) -> None:
    bearing = element(presets["30206-back-to-back"], [0.0, 300.0])
    assert bearing.kxx[0] == bearing.kxx[1] > 0.0


def test_what_cannot_be_had_is_refused(element: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ValueError, match="increasing"):
        element(SCENE, [2.0, 1.0])
    with pytest.raises(ValueError, match="speeds"):
        element(SCENE, [])
    with pytest.raises(ValueError, match="at 5 rad/s"):
        element(SCENE.healthy().replace(fx=0.0, fy=0.0), [5.0])
    monkeypatch.setitem(sys.modules, "ross", None)
    with pytest.raises(ImportError, match=r"bearing-explorer\[ross\]"):
        element(SCENE, [1.0])


def test_a_rotor_in_ross_rings_at_the_frequencies_of_its_mass_on_these_bearings() -> None:
    ross = pytest.importorskip("ross")
    steel = ross.Material("steel", rho=7800.0, E=2.1e15, G_s=8.1e14)  # as good as rigid
    shaft = [ross.ShaftElement(L=0.05, idl=0.0, odl=0.025, material=steel) for _ in range(4)]
    disc = ross.DiskElement(n=2, m=20.0, Id=0.02, Ip=0.04)
    bearings = [to_ross(SCENE, SPEEDS, node=node) for node in (0, 4)]
    rotor = ross.Rotor(shaft, [disc], bearings)
    actual = rotor.run_modal(speed=0.0, num_modes=24).wn
    for term in np.linalg.eigvalsh(bearings[0].K(0.0)[:2, :2]):
        expected = math.sqrt(2.0 * term / rotor.m)
        assert np.abs(actual / expected - 1.0).min() < 3e-3


def test_balls_that_only_the_outer_race_holds_damp_nothing() -> None:
    scene = SCENE.healthy().replace(shaft_speed=1.0)
    thrown = modes_at(static_state(scene.replace(balls="with mass")))
    assert thrown.damping_ratio == pytest.approx(
        modes_at(equilibrium(scene)).damping_ratio, rel=1e-4
    )
