"""Pairs of tapered roller bearings: where their lines of contact meet the shaft."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearingcore import Bearing, equilibrium, presets
from bearingcore.bearings import read_designation
from tests.outside.witness import witness

CENTRES_MM = {
    "30206": (27.6, 6.9),
    "32208": (37.8, 11.7),
    "30310": (45.8, 12.7),
}
"""Pressure centres apart [mm] back to back (2 a) and face to face (2 (T − a)).

Source: makers' a of 13.8, 18.9 and 22.9 mm with T of ISO 355; NSK E1102 prints 13.9, 18.9, 23.1.
"""

KOYO_A_MM = {
    **{"30205": 12.9, "32205": 13.5, "30305": 12.9, "30206": 14.1, "30208": 17.0, "30309": 21.3},
    **{"32309": 26.8, "30210": 20.1, "32210": 20.6, "30310": 22.9, "32310": 29.4, "32307": 20.6},
}
"""a [mm]. Source: Koyo general catalogue, tables of 30205JR to 32310JR."""

SKF_A_MM = {
    **{"30204": 11, "30304": 11, "32304": 14, "30205": 12, "30305": 13, "32305": 15},
    **{"30206": 14, "32206": 15, "30306": 15, "32306": 18},
}
"""The same, in whole mm. Source: SKF data in bd_warehouse 0.4.0 (PyPI)."""


@pytest.mark.parametrize("number", CENTRES_MM)
def test_pressure_centres_are_the_makers(number: str) -> None:
    """Sources stand at CENTRES_MM."""
    centres = [1e3 * (_pair(number, way).pressure_centers_apart or 0.0) for way in ("DB", "DF")]
    assert centres == pytest.approx(CENTRES_MM[number], abs=0.45)


def test_other_makers_print_nearly_the_same() -> None:
    """Koyo and SKF; the wide 323 differ most, by up to 7 %."""
    for number, a in (KOYO_A_MM | SKF_A_MM).items():
        own = 0.5e3 * (_pair(number, "DB").pressure_centers_apart or 0.0)
        assert own == pytest.approx(a, rel=0.07, abs=0.6), number


@witness(
    "tapered bearing: stiffness",
    by="cones at a fixed angle in three dimensions",
    compared="k_rxrx over k_yy of six pairs, at the distance of their pressure centres",
    within=1e-9,
)
@pytest.mark.parametrize("number", CENTRES_MM)
@pytest.mark.parametrize("way", ["DB", "DF"])
def test_a_pair_resists_tilt_by_its_pressure_centres(number: str, way: str) -> None:
    """Source: statics of cones whose contacts keep their angle, in three dimensions.

    Forces along lines through (0, 0, ±c) make k_rxrx = Σ k (p × n)_x² and k_yy = Σ k n_y² with one
    stiffness k of all contacts, whatever it is. c is half the distance that the pair has. With the
    distances at CENTRES_MM, of makers whose a differ by 0.1 to 0.2 mm, the same ratio is up to 7 %
    off face to face, where that is the small difference 2 (T − a).
    """
    pair = _pair(number, way).replace(preload=5e-6)
    scene = presets["30206-back-to-back"].replace(bearing=pair, extent=0.0, fy=0.0, fz=0.0)
    state = equilibrium(scene, [0.0])
    assert state.converged.all()
    phi, alpha = 2.0 * math.pi / pair.n_balls * np.arange(pair.n_balls), pair.contact_angle
    half = 0.5 * (pair.pressure_centers_apart or 0.0)
    tilt = radial = 0.0
    for end in (-1.0, 1.0):
        n = np.stack([np.cos(phi), np.sin(phi), end * math.tan(alpha) + 0.0 * phi], axis=1)
        p = np.broadcast_to([0.0, 0.0, end * half], n.shape)
        tilt += (np.cross(p, n)[:, 0] ** 2).sum()
        radial += (n[:, 1] ** 2).sum()
    own = state.term("k_rxrx")[0] / state.term("k_yy")[0]
    assert own == pytest.approx(tilt / radial, rel=1e-9)


def _pair(number: str, way: str) -> Bearing:
    return read_designation(f"{number} {way}").bearing
