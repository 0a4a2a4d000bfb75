"""Tapered rollers, against straight races written out here, closed forms and ISO 281."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from bearingcore import (
    Bearing,
    Scene,
    dynamic_load_rating,
    equilibrium,
    life,
    limits,
    modes,
    presets,
    simulate,
)
from bearingcore.errors import FieldError

PAIR = presets["30206-back-to-back"].healthy()
ROW = PAIR.bearing.replace(rows=())
K, ALPHA, Z = ROW.load_deflection_factor, ROW.contact_angle, ROW.n_balls
HELD = ("x", "y", "z")


def of(bearing: Bearing, **changes: object) -> Scene:
    dofs = None if bearing.rows else HELD
    return dataclasses.replace(PAIR, bearing=bearing, dofs=dofs).replace(**changes)


def test_an_axial_load_is_shared_and_moves_the_ring_in_closed_form() -> None:
    found = equilibrium(of(ROW, fy=0.0, fz=5000.0), [0.0])
    Q = 5000.0 / (Z * math.sin(ALPHA))
    assert found.ball_load[0] == pytest.approx(np.full(Z, Q), rel=1e-5)
    assert found.displacement[0, 2] == pytest.approx((Q / K) ** 0.9 / math.sin(ALPHA), rel=1e-5)


def test_half_a_load_zone_needs_the_axial_load_of_line_contact() -> None:
    """Harris: F_a = 0.3090/0.2453 F_r tan α where half carry (NSK: 1.26)."""
    many = Bearing.tapered(90, 1e-3, 8e-3, 46e-3, ALPHA)
    scene = of(many, fy=-2000.0, fz=0.3090 / 0.2453 * 2000.0 * math.tan(ALPHA))
    found = equilibrium(scene, [0.0])
    heaviest = found.ball_load.max() * math.cos(ALPHA)
    assert 2000.0 / (90 * heaviest) == pytest.approx(0.2453, rel=4e-3)
    assert (found.ball_load > 0.0).mean() == pytest.approx(0.5, abs=0.03)


def test_the_rating_is_the_catalogues_and_of_two_rows_that_of_iso_281() -> None:
    """C_r 43.5 kN of a 30206 (Nachi), of which the preset was made; two rows: 2^(7/9) as much."""
    C = dynamic_load_rating(ROW)
    assert pytest.approx(43_500.0, rel=2e-3) == C
    assert dynamic_load_rating(PAIR.bearing) == pytest.approx(2.0 ** (7.0 / 9.0) * C, rel=1e-9)


def test_axial_life_is_that_of_the_standards_axial_factor() -> None:
    """ISO 281: P = Y F_a, Y = 0.4 cot α, of a load along the shaft alone; of 0.378 it rounds."""
    found = life(of(ROW, fy=0.0, fz=5000.0), dynamic_load_rating(ROW))
    assert found.equivalent_load == pytest.approx(0.378 / math.tan(ALPHA) * 5000.0, rel=0.01)
    assert found.equivalent_load == pytest.approx(0.4 / math.tan(ALPHA) * 5000.0, rel=0.08)


def test_radial_life_is_that_of_the_standard_where_half_of_the_rollers_carry() -> None:
    scene = of(ROW, fy=-4000.0, fz=1.24 * 4000.0 * math.tan(ALPHA))
    found = life(scene, dynamic_load_rating(ROW), positions="all")
    assert found.equivalent_load == pytest.approx(4000.0, rel=0.03)


def test_frequencies_take_the_angle_of_the_outer_race() -> None:
    gamma = ROW.ball_diameter * math.cos(ALPHA) / ROW.pitch_diameter
    assert ROW.bpfo(2.0 * math.pi) == pytest.approx(0.5 * Z * (1.0 - gamma))
    assert ROW.bpfi(2.0 * math.pi) == pytest.approx(0.5 * Z * (1.0 + gamma))


def test_back_to_back_is_stiffer_against_tilt_and_without_an_angle_rollers_are_cylindrical() -> (
    None
):
    stiff, soft = (
        equilibrium(of(ROW.paired(30e-3, one, 6e-6)), [0.0]).stiffness[0, 3, 3]
        for one in ("back-to-back", "face-to-face")
    )
    assert stiff > 2.0 * soft


def test_next_to_no_angle_makes_cylindrical_rollers() -> None:
    nearly = dataclasses.replace(PAIR, bearing=ROW.replace(contact_angle=1e-6), dofs=("x", "y"))
    flat = nearly.replace(fy=-4000.0, fz=0.0)
    length = ROW.roller_length or 0.0
    straight = Bearing.cylindrical(Z, ROW.ball_diameter, length, ROW.pitch_diameter)
    cylindrical = dataclasses.replace(flat, bearing=straight)
    loads = [equilibrium(one, [0.1]).ball_load for one in (flat, cylindrical)]
    assert loads[0] == pytest.approx(loads[1], rel=1e-6, abs=1e-3)


def test_what_it_cannot_do_is_said_or_refused() -> None:
    said = {one.name: one.sentence for one in limits(PAIR)}
    assert "swivelling" in said["tilt of the rollers"]
    assert "friction of the rib" in said["tilt of the rollers"]
    assert "rib" in said["change by centrifugal force"]
    with pytest.raises(FieldError, match="a rib holds them"):
        dataclasses.replace(PAIR, balls="with mass")
    with pytest.raises(FieldError, match="contact_angle"):
        ROW.replace(contact_angle=0.0)
    row = PAIR.bearing.rows[0]
    with pytest.raises(FieldError, match="alike"):
        PAIR.bearing.replace(rows=(row, dataclasses.replace(row, n_balls=11)))


def test_it_goes_through_files_modes_and_motion() -> None:
    scene = presets["30206-back-to-back"]
    assert Scene.from_toml(scene.to_toml()) == scene
    assert scene.bearing.respaced(preload=8e-6).preload == pytest.approx(8e-6)
    assert modes(scene, [0.0]).frequency.min() > 0.0
    assert np.isfinite(simulate(scene, 5e-3, 50e3).outer_acceleration).all()
