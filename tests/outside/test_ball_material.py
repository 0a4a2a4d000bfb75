"""Balls of another material than the rings, against Hertz's theory in Johnson's form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from bearingcore import Bearing, Scene, life, presets, scene_of
from bearingcore.bearings import BALL_MATERIALS, read_designation
from bearingcore.errors import FieldError
from bearingcore.model.statics import dynamic_load_rating
from tests.outside.witness import witness

STEEL, NITRIDE = (210e9, 0.3), (310e9, 0.26)
"""E [Pa] and ν. Source: SKF general catalogue, 210 and 310 GPa; the ratios are the usual ones."""

BALL, PITCH, R_I, R_O = 7.94e-3, 39.04e-3, 4.13e-3, 4.21e-3


def hertz(groove: float, side: int, materials: tuple[tuple[float, float], ...]) -> np.ndarray:
    """K [N/m^1.5] and pressure [Pa] at 1 N (Johnson, Contact Mechanics, section 4.2)."""
    r = 0.5 * BALL
    A, B = 0.5 * (1 / r - 1 / groove), 0.5 * (1 / r + side / (0.5 * PITCH - side * r))
    modulus = 1.0 / sum((1.0 - nu**2) / E for E, nu in materials)

    def off(m: float) -> float:
        return (ellipe(m) / (1.0 - m) - ellipk(m)) / (ellipk(m) - ellipe(m)) - B / A

    m = brentq(off, 1e-9, 1.0 - 1e-12, xtol=1e-15)
    a = np.cbrt(3.0 * (ellipk(m) - ellipe(m)) / (2.0 * math.pi * A * m * modulus))
    approach = 3.0 * ellipk(m) / (2.0 * math.pi * a * modulus)
    return np.array([approach**-1.5, 3.0 / (2.0 * math.pi * a**2 * math.sqrt(1.0 - m))])


@pytest.fixture
def steel() -> Bearing:
    return Bearing.from_drawing(9, BALL, PITCH, R_I, R_O, contact_angle=0.0)


@witness(
    "material: *",
    by="Johnson, Contact Mechanics, by SciPy's integrals",
    compared="K and pressure of steel and silicon nitride",
    within=1e-6,
)
@pytest.mark.parametrize("balls", ["steel", "silicon nitride"])
def test_contacts_are_those_of_two_materials(steel: Bearing, balls: str) -> None:
    """Source: Johnson's equations 4.25 to 4.28 by SciPy's elliptic integrals."""
    bearing = steel.with_balls_of(BALL_MATERIALS[balls])
    materials = (STEEL, NITRIDE if balls != "steel" else STEEL)
    inner, outer = hertz(R_I, 1, materials), hertz(R_O, -1, materials)
    for race, (K, pressure) in (("inner", inner), ("outer", outer)):
        contact = bearing.race_contact(race)
        assert contact.load_deflection_factor == pytest.approx(K, rel=1e-6)
        assert float(contact.greatest_pressure(1.0)) == pytest.approx(pressure, rel=1e-6)
    both = (inner[0] ** (-2 / 3) + outer[0] ** (-2 / 3)) ** -1.5
    assert bearing.load_deflection_factor == pytest.approx(both, rel=1e-6)


def test_silicon_nitride_in_steel_rings_is_1_18_times_as_stiff(steel: Bearing) -> None:
    """Source: Hertz, K goes with 2/((1 − ν²)/E of ball + ring); 3.2 g/cm³ by SKF."""
    hybrid = steel.with_balls_of(BALL_MATERIALS["silicon nitride"])
    ratio = hybrid.load_deflection_factor / steel.load_deflection_factor
    assert ratio == pytest.approx(2.0 / (1.0 + 210 / 310 * (1 - 0.26**2) / (1 - 0.3**2)), rel=1e-12)
    assert ratio == pytest.approx(1.18, abs=0.001)
    assert hybrid.ball_mass / steel.ball_mass == pytest.approx(3200 / 7800)
    # replaced by numbers it is the same, and steel again is what it was
    assert steel.replace(ball_youngs_modulus=310e9, ball_poisson=0.26, density=3200.0) == hybrid
    assert hybrid.with_balls_of(BALL_MATERIALS["steel"]) == steel


def test_the_rating_of_steel_balls_is_not_that_of_a_hybrid(steel: Bearing) -> None:
    """ISO 281 is for steel; ISO 20056 rates hybrid bearings."""
    hybrid = steel.with_balls_of(BALL_MATERIALS["silicon nitride"])
    with pytest.raises(FieldError, match="ISO 20056"):
        dynamic_load_rating(hybrid)
    with pytest.raises(FieldError, match="maker's catalogue"):
        life(scene_of("6205/HC5"))
    assert dynamic_load_rating(steel) > 0.0
    designation = read_designation("6205-2RSLTN9/HC5C3WT")
    assert (designation.dynamic_load_rating, designation.clearance_class) == (None, "C3")
    assert designation.bearing.ball_material == "silicon nitride"
    with pytest.raises(FieldError, match="steel rollers"):
        read_designation("NU 208 ECP/HC5")


def test_hybrid_bearings_are_kept_in_files_and_old_files_are_of_steel(steel: Bearing) -> None:
    """A file without the two numbers has balls as the rings."""
    scene = presets["6205"].replace(bearing=steel)
    assert "ball_youngs" not in scene.to_toml()
    hybrid = scene.replace(bearing=steel.with_balls_of(BALL_MATERIALS["silicon nitride"]))
    assert Scene.from_toml(hybrid.to_toml()) == hybrid
    with pytest.raises(FieldError, match="ball_youngs_modulus"):
        presets["liew-lim"].bearing.replace(ball_youngs_modulus=310e9)
