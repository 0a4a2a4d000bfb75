"""Point contact by Hertz and the thrust of a Harris 218 by Jones, with elliptic integrals here."""

import dataclasses
import math

import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from bearingcore import Bearing, catalogue, equilibrium, presets
from tests.outside.witness import witness


def point_contact(D: float, groove: float, across: float, side: float) -> tuple[float, float]:
    """K [N/m^1.5] and greatest pressure [Pa] at 1 N; steel of 210 GPa and 0.3 (Harris, Chapter 6).

    Groove radius, and radius of the race along the rolling [m]; side 1 inside, −1 outside.
    """
    total = 4.0 / D + side / across - 1.0 / groove
    wanted = (side / across + 1.0 / groove) / total

    def off(ratio: float) -> float:
        m = 1.0 - ratio**-2
        return 1.0 - 2.0 / (ratio**2 - 1.0) * (ellipk(m) / ellipe(m) - 1.0) - wanted

    k = brentq(off, 1.0001, 1e4, xtol=1e-13, rtol=1e-14)
    K, E = ellipk(1.0 - k**-2), ellipe(1.0 - k**-2)
    modulus = 210e9 / 0.91
    factor = math.pi / math.sqrt(4.5) * k * modulus * math.sqrt(E / (total * K**3))
    b = (6.0 * E / (math.pi * k * total * modulus)) ** (1.0 / 3.0)
    return factor, 1.5 / (math.pi * k * b * b)


def both(bearing: Bearing) -> list[tuple[float, float]]:
    """Inner and outer contact of a bearing, from its drawing alone."""
    D, cosine = bearing.ball_diameter, math.cos(bearing.contact_angle)
    found = []
    for race, side in (("inner", 1.0), ("outer", -1.0)):
        across = 0.5 * (bearing.pitch_diameter / cosine - side * D)
        found.append(point_contact(D, bearing.groove_radius(race), across, side))
    return found


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
        found = bearing.race_contact(race)
        assert found.load_deflection_factor == pytest.approx(factor, rel=1e-10)
        for load in (1.0, 3000.0):
            assert float(found.greatest_pressure(load)) == pytest.approx(
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
