"""Load zones by Sjövall's integrals, taken here by SciPy's quadrature."""

import dataclasses
import math

import pytest
from scipy.integrate import quad

from bearingcore import Bearing, Scene, equilibrium, presets, read_designation
from tests.outside.witness import witness

BALLS, MANY = 1.5, 61
"""Exponent of point contact, and so many elements that sums are integrals but for 0.1 %."""


def sjovall(zone: float, exponent: float) -> tuple[float, float]:
    """J_r, J_a of a load zone ε: means of (1 − (1 − cos ψ)/(2 ε))^n, J_r with cos ψ."""
    end = math.acos(1.0 - 2.0 * zone) if zone < 1.0 else math.pi

    def mean(power: int) -> float:
        def part(psi: float) -> float:
            share = max(1.0 - (1.0 - math.cos(psi)) / (2.0 * zone), 0.0)
            return float(share**exponent * math.cos(psi) ** power)

        return float(quad(part, 0.0, end, epsabs=1e-13)[0] / math.pi)

    return mean(1), mean(0)


def scene_of(bearing: Bearing, dofs: tuple[str, ...], **load: float) -> Scene:
    scene = dataclasses.replace(presets["fan-rig"].healthy(), bearing=bearing, dofs=dofs)
    return scene.replace(**{"fx": 0.0, "fy": 0.0, "fz": 0.0} | load)


@witness(
    "ball bearing: statics",
    "roller bearing: statics",
    by="Sjövall's integrals by SciPy's quadrature",
    compared="displacement, greatest load of five load zones",
    within=0.0015,
)
@pytest.mark.parametrize("zone", [0.1, 0.2, 0.3, 0.4, 0.49])
@pytest.mark.parametrize("element", ["ball", "roller"])
def test_radial_load_with_clearance(zone: float, element: str) -> None:
    """ε = (1 − clearance/δ_r)/2; F_r = Z K δ_max^n J_r."""
    if element == "ball":
        bearing = presets["fan-rig"].bearing.replace(n_balls=MANY, pitch_diameter=0.2)
        exponent = BALLS
    else:
        bearing, exponent = Bearing.cylindrical(MANY, 6e-3, 8e-3, 0.2), 10.0 / 9.0
    way, K = 20e-6, bearing.load_deflection_factor
    clearance = (1.0 - 2.0 * zone) * way
    load = MANY * K * (way - clearance) ** exponent * sjovall(zone, exponent)[0]
    state = equilibrium(
        scene_of(bearing.replace(radial_clearance=clearance), ("x", "y"), fx=load), [0.0]
    )
    assert state.displacement[0, 0] == pytest.approx(way, rel=1.5e-3)
    assert state.ball_load.max() == pytest.approx(K * (way - clearance) ** exponent, rel=1.5e-3)


@witness(
    "tapered bearing: statics",
    by="Sjövall's integrals by SciPy's quadrature",
    compared="displacements, greatest load of eleven load zones",
    within=0.003,
)
@pytest.mark.parametrize("zone", [0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.25, 1.67, 2.5, 5.0])
def test_combined_load_at_a_fixed_angle(zone: float) -> None:
    """ε = (1 + δ_a tan α/δ_r)/2; F_r = Z Q cos α J_r, F_a = Z Q sin α J_a: tapered rollers."""
    bearing = Bearing.tapered(MANY, 6e-3, 8e-3, 0.2, math.radians(15.0))
    exponent, alpha, K = 10.0 / 9.0, bearing.contact_angle, bearing.load_deflection_factor
    radial = 8e-6
    axial = (2.0 * zone - 1.0) * radial / math.tan(alpha)
    Q = K * (radial * math.cos(alpha) + axial * math.sin(alpha)) ** exponent
    J_r, J_a = sjovall(zone, exponent)
    load = {"fx": MANY * Q * math.cos(alpha) * J_r, "fz": MANY * Q * math.sin(alpha) * J_a}
    state = equilibrium(scene_of(bearing, ("x", "y", "z"), **load), [0.0])
    assert state.ball_load.max() == pytest.approx(Q, rel=1.5e-3)
    assert state.displacement[0, 0] == pytest.approx(radial, rel=3e-3)
    assert state.displacement[0, 2] == pytest.approx(axial, rel=3e-3, abs=1e-8)


@witness(
    "ball bearing: statics", "tapered bearing: statics",
    by="NSK, Rolling Bearings E1102, Appendix 15: axial load and axial displacement",
    compared="axial displacement by number: balls all 6 %, rollers all 3 % above the formulas: "
    "how it goes with angle and size, K itself to 10 %",
    within=0.02,
)  # fmt: skip
@pytest.mark.parametrize("name", ["7210 B", "7305 A", "30206", "32315"])
def test_axial_displacements_of_a_makers_formulas(name: str) -> None:
    """δ_a = 0.00044/sin α (Q²/D)^(1/3) and 0.000077 F^0.9/(sin^1.9 α Z^0.9 l^0.8), N and mm."""
    b, load = read_designation(name).bearing, 20.0
    sine, D = math.sin(b.contact_angle), 1e3 * b.ball_diameter
    Q = load / (b.n_balls * sine)
    known = 1.06 * 0.00044 / sine * (Q**2 / D) ** (1.0 / 3.0)
    if b.roller_length is not None:
        known = (
            1.03
            * 0.000077
            * load**0.9
            / (sine**1.9 * b.n_balls**0.9 * (1e3 * b.roller_length) ** 0.8)
        )
    scene = scene_of(b, ("z",), fz=load)
    assert 1e3 * equilibrium(scene, [0.0]).displacement[0, 2] == pytest.approx(known, rel=0.02)
