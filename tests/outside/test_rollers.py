"""Stiffness of roller bearings: ISO 16281's line contact, and a closed form of rotor dynamics."""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
import pytest
from scipy.optimize import brentq, root

from bearingcore import (
    Bearing,
    Scene,
    equilibrium,
    frequency_bands,
    presets,
    read_designation,
    scene_of,
)
from tests.outside.witness import witness

C_L = 35_948.0
"""[N/mm^2] of l^(8/9): ISO 16281, both contacts of a steel roller in series (Eq. 35), as the public
programs minzhun/ISO16281 and AxisForge have it."""

BELOW = math.radians(270.0)


def compression(load: float, count: int, length: float, clearance: float = 0.0) -> float:
    """Displacement [mm] under a load [N] on the line of a roller; mm and diametral clearance."""
    cosine = np.cos(2.0 * math.pi * np.arange(count) / count)

    def missing(way: float) -> float:
        pressed = np.maximum(way * cosine - 0.5 * clearance, 0.0)
        return float(C_L * length ** (8.0 / 9.0) * pressed ** (10.0 / 9.0) @ cosine) - load

    return float(brentq(missing, 0.0, 1.0, xtol=1e-15))


def below(bearing: Bearing, load: float) -> Scene:
    """A healthy scene with a load [N] downwards."""
    scene = presets["fan-rig"].healthy()
    return dataclasses.replace(scene, bearing=bearing, dofs=None).replace(fy=-load)


SIX = Bearing.cylindrical(6, 9e-3, 13.6e-3, 43.5e-3)
NU208 = presets["nu208"].healthy()


@pytest.mark.parametrize("load", [1.0, 100.0, 1000.0, 20_000.0])
@pytest.mark.parametrize("clearance", [0.0, 10e-6])
def test_six_rollers_against_statics_of_their_own(load: float, clearance: float) -> None:
    """SciPy's brentq on c_L l^(8/9), six rollers of 13.6 mm."""
    scene = below(SIX.replace(radial_clearance=0.5 * clearance), load)
    sinking = -equilibrium(scene, [BELOW]).displacement[0, 1]
    expected = 1e-3 * compression(load, 6, 13.6, 1e3 * clearance)
    assert sinking == pytest.approx(expected, rel=1e-9)


@witness(
    "roller bearing: statics",
    by="minzhun/ISO16281",
    compared="displacements 3.502 and 22.6478 µm",
    within=1e-4,
)
def test_displacements_of_iso_16281() -> None:
    """3.502 µm: minzhun/ISO16281 without a profile; 22.6478 µm: the same for the preset's load."""
    assert -equilibrium(below(SIX, 1000.0), [BELOW]).displacement[0, 1] == pytest.approx(
        3.502e-6, rel=1e-4
    )
    state = equilibrium(NU208, [BELOW])
    assert -state.displacement[0, 1] == pytest.approx(22.6478e-6, rel=1e-5)
    assert state.ball_load.max() == pytest.approx(1348.0, rel=1e-3)
    assert compression(3000.0, 14, 11.0, 0.03) == pytest.approx(22.6478e-3, rel=1e-5)


def test_both_contacts_in_series_are_c_l_and_one_is_near_palmgren() -> None:
    """Palmgren: one steel contact yields 3.84e-5 Q^0.9/l^0.8 mm, half of what both yield."""
    for bearing in (SIX, presets["30206-back-to-back"].bearing):
        length, Q = 1e3 * bearing.roller_length, 750.0
        both = (Q / C_L / length ** (8.0 / 9.0)) ** 0.9
        K = bearing.load_deflection_factor
        assert pytest.approx(both, rel=1e-12) == 1e3 * (Q / K) ** 0.9
        for race, factor in zip(("inner", "outer"), bearing.race_factors, strict=True):
            alone = bearing.race_contact(race).load_deflection_factor
            assert alone == pytest.approx(factor, rel=1e-12)
            assert 1e3 * (Q / alone) ** 0.9 == pytest.approx(0.5 * both, rel=1e-12)
            assert 0.5 * both == pytest.approx(3.84e-5 * Q**0.9 / length**0.8, rel=0.04)


@witness(
    "roller bearing: stiffness",
    by="closed form of ROSS (Friswell and others)",
    compared="k_yy of 8 rollers under 500 N",
    within=0.01,
)
def test_stiffness_of_ross() -> None:
    """ROSS's roller case (8 rollers, 30 mm, 500 N) at α = 0: 1e9 Z^0.9 l^0.8 F^0.1 (Friswell)."""
    scene = below(Bearing.cylindrical(8, 15e-3, 30e-3, 80e-3), 500.0)
    state = equilibrium(scene, [BELOW])
    printed = 1e9 * 8**0.9 * 0.03**0.8 * 500.0**0.1
    assert printed == pytest.approx(7.32e8, rel=1e-3)
    assert state.term("k_yy")[0] == pytest.approx(printed, rel=0.01)
    assert (state.term("k_xx") / state.term("k_yy"))[0] == pytest.approx(0.49, abs=0.015)


def test_stiffness_and_bands_of_the_nu_208() -> None:
    """With c_L in the place of 8.06e4: k_yy 5.6e8 N/m, y₂ from 3767 to 4022 Hz."""
    assert equilibrium(NU208).term("k_yy").mean() == pytest.approx(5.6e8, rel=0.01)
    assert frequency_bands(NU208)["y2"] == pytest.approx((3767.0, 4022.0), rel=1e-3)


def rows_push(q: np.ndarray, rows: Sequence[tuple[float, int, float]]) -> np.ndarray:
    """Loads (5,) [N, N·mm] of rows of a 30206 (place, facing, offset) [mm]; α = 14°02′10″."""
    ca, sa = math.cos(math.radians(14.0361)), math.sin(math.radians(14.0361))
    x, y, z, rx, ry = q
    total = np.zeros(5)
    for place, facing, offset in rows:
        for phi in 2.0 * math.pi * np.arange(17) / 17:
            c, s = math.cos(phi), math.sin(phi)
            radial = (x + place * ry) * c + (y - place * rx) * s
            axial = z + 23.0 * (rx * s - ry * c) + offset
            pressed = max(radial * ca + facing * axial * sa, 0.0)
            Q = C_L * 10.3 ** (8.0 / 9.0) * pressed ** (10.0 / 9.0)
            a = facing * sa
            total += Q * np.array(
                [c * ca, s * ca, a, s * (23.0 * a - place * ca), c * (place * ca - 23.0 * a)]
            )
    return total


@witness(
    "tapered bearing: statics",
    "tapered bearing: stiffness",
    by="SciPy's root on straight races of c_L l^(8/9)",
    compared="loads, displacements, k_xx of a pair",
    within=1e-4,
)
def test_a_pair_of_tapered_rollers_against_statics_of_its_own() -> None:
    """SciPy's root on straight races of c_L l^(8/9), k_xx by differences: 1.7e9 N/m."""
    scene = presets["30206-back-to-back"].healthy()
    rows = [(1e3 * row.place, row.facing, 1e3 * row.offset) for row in scene.bearing.all_rows]
    load = np.array([0.0, -4000.0, 1000.0, 0.0, 0.0])
    start = [0.0, -3e-3, 1e-3, 0.0, 0.0]
    q = root(lambda q: rows_push(q, rows) - load, start, method="hybr", tol=1e-13).x
    state = equilibrium(scene, [0.0])
    displacement = state.displacement[0] * [1e3, 1e3, 1e3, 1.0, 1.0]
    assert displacement == pytest.approx(q, rel=1e-4, abs=1e-9)
    step = np.array([1e-7, 0.0, 0.0, 0.0, 0.0])
    k_xx = 1e3 * (rows_push(q + step, rows) - rows_push(q - step, rows))[0] / 2e-7
    assert state.term("k_xx")[0] == pytest.approx(k_xx, rel=1e-4)
    assert k_xx == pytest.approx(1.7e9, rel=0.02)


@pytest.mark.parametrize("name", ["nu208", "30206-back-to-back"])
def test_files_of_the_wrong_constant_open_with_the_right_one(name: str) -> None:
    """8.06e4 was saved in the place of 35 948; a factor that a person chose stays."""
    scene = presets[name]
    data = scene.to_data()
    K = data["bearing"]["load_deflection_factor"]
    data["bearing"]["load_deflection_factor"] = K * 8.06e4 / C_L
    assert Scene.from_data(data) == scene
    data["bearing"]["load_deflection_factor"] = 1.5 * K
    assert Scene.from_data(data).bearing.load_deflection_factor == 1.5 * K


@witness(
    "roller bearing: statics",
    by="Schaeffler, catalogue HR 1, Rigidity: δ = F^0.84/(K_c d^0.65) + half the clearance",
    compared="displacement of NU by number under C/10, between no clearance and CN", within=0.15,
)  # fmt: skip
@pytest.mark.parametrize(
    ("name", "factor"),
    [("NU 208", 11.1), ("NU 315", 11.3), ("NU 2210", 15.4), ("NU 2308", 16.9), ("NU 1012", 9.5)],
)
def test_displacements_of_a_makers_approximation(name: str, factor: float) -> None:
    """For usual clearances: the middle between none and CN, of which one is 3 to 34 % away."""
    designation = read_designation(name)
    load = 0.1 * float(designation.dynamic_load_rating or 0.0)
    known = load**0.84 / (factor * (1e3 * designation.bore) ** 0.65)
    over = []
    for clearance in (0.0, designation.bearing.radial_clearance):
        b = designation.bearing.replace(radial_clearance=clearance)
        scene = scene_of(name).healthy().replace(bearing=b, fx=0.0, fy=-load, fz=0.0)
        moved = 1e6 * (-float(equilibrium(scene, [0.0]).displacement[0, 1]) - clearance)
        over.append(moved / known - 1.0)
    assert over[0] < 0.0 < over[1] + 0.03
    assert abs(np.mean(over)) < 0.15
