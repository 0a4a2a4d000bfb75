"""Point contact by Hertz and the thrust of a Harris 218 by Jones, with elliptic integrals."""

import dataclasses
import math

import pytest
from scipy.optimize import brentq

from bearingcore import Bearing, catalogue, equilibrium, presets
from tests.outside.elements import Array, point_contact
from tests.outside.witness import witness


def both(bearing: Bearing) -> list[Array]:
    """K and pressure at 1 N of the inner and outer contact, from the drawing alone."""
    D, cosine = bearing.ball_diameter, math.cos(bearing.contact_angle)
    return [
        point_contact(
            D,
            -1.0 / bearing.groove_radius(race),
            side / (0.5 * (bearing.pitch_diameter / cosine - side * D)),
        )[:2]
        for race, side in (("inner", 1.0), ("outer", -1.0))
    ]


@witness(
    "ball bearing: pressure",
    by="Hertz by SciPy's elliptic integrals (Harris, chapter 6)",
    compared="K and pressure of 209, 218, 6205",
    within=1e-10,
)
@pytest.mark.parametrize("name", ["209, Harris", "218, Harris", "6205"])
def test_factors_and_pressures_by_elliptic_integrals(name: str) -> None:
    bearing = presets[name].bearing if name == "6205" else catalogue()[name].bearing
    contacts = both(bearing)
    for race, (factor, pressure) in zip(("inner", "outer"), contacts, strict=True):
        contact = bearing.race_contact(race)
        assert contact.load_deflection_factor == pytest.approx(factor, rel=1e-10)
        for load in (1.0, 3000.0):
            assert float(contact.greatest_pressure(load)) == pytest.approx(
                pressure * load ** (1.0 / 3.0), rel=1e-10
            )
    series = sum(factor ** (-2.0 / 3.0) for factor, _ in contacts) ** -1.5
    assert bearing.load_deflection_factor == pytest.approx(series, rel=1e-10)


@witness(
    "ball bearing: statics",
    "function: catalogue",
    by="Jones's equation by SciPy (Harris 218, 17.8 kN)",
    compared="contact angle and axial displacement",
    within=1e-09,
)
def test_thrust_of_the_218_by_jones() -> None:
    """Harris 218, 17.8 kN: F = Z K A^1.5 sin α (cos α0/cos α − 1)^1.5, δz = A sin(α − α0)/cos α.

    Harris prints 41.6° and 0.0386 mm, which he reads from a chart.
    """
    bearing = catalogue()["218, Harris"].bearing
    D, a0 = bearing.ball_diameter, bearing.contact_angle
    A = bearing.groove_radius("inner") + bearing.groove_radius("outer") - D
    K = sum(factor ** (-2.0 / 3.0) for factor, _ in both(bearing)) ** -1.5

    def missing(a: float) -> float:
        return 16 * K * (A * (math.cos(a0) / math.cos(a) - 1.0)) ** 1.5 * math.sin(a) - 17_800.0

    a = brentq(missing, a0, 1.2, xtol=1e-14)
    way = A * math.sin(a - a0) / math.cos(a)
    assert (math.degrees(a), 1e3 * way) == pytest.approx((41.4838, 0.0356523), rel=2e-6)
    scene = dataclasses.replace(
        presets["7208-40deg"].healthy(), bearing=bearing, dofs=("x", "y", "z")
    )
    state = equilibrium(scene.replace(fx=0.0, fy=0.0, fz=17_800.0), [0.3])
    assert state.contact_angle[0] == pytest.approx([a] * 16, rel=1e-9)
    assert state.displacement[0, 2] == pytest.approx(way, rel=1e-9)
