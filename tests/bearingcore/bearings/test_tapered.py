"""Tapered rollers, against straight races written out here, closed forms and ISO 281."""

import dataclasses
import math

import numpy as np
import pytest

from bearingcore import Bearing, Scene, dynamic_load_rating, equilibrium, limits, presets
from bearingcore.errors import FieldError
from bearingcore.statics.life import LINE_CONTACT, million_revolutions, ratings_of_races

PAIR = presets["30206-back-to-back"].healthy()
ROW = PAIR.bearing.replace(rows=())
K, ALPHA, Z = ROW.load_deflection_factor, ROW.contact_angle, ROW.n_balls
HELD = ("x", "y", "z")


def of(bearing: Bearing, **changes: object) -> Scene:
    dofs = "tilt free" if bearing.rows else HELD
    return dataclasses.replace(PAIR, bearing=bearing, dofs=dofs).replace(**changes)


def test_an_axial_load_is_shared_and_moves_the_ring_in_closed_form() -> None:
    found = equilibrium(of(ROW, fy=0.0, fz=5000.0), [0.0])
    Q = 5000.0 / (Z * math.sin(ALPHA))  # but for the turn by 30 µm over races of 10 m
    assert found.ball_load[0] == pytest.approx(np.full(Z, Q), rel=2e-5)
    assert found.displacement[0, 2] == pytest.approx((Q / K) ** 0.9 / math.sin(ALPHA), rel=2e-5)


def test_the_rating_is_the_catalogues_and_of_two_rows_that_of_iso_281() -> None:
    """C_r 43.5 kN of a 30206 (Nachi), of which the preset was made; two rows: 2^(7/9) as much."""
    C = dynamic_load_rating(ROW)
    assert pytest.approx(43_500.0, rel=2e-3) == C
    assert dynamic_load_rating(PAIR.bearing) == pytest.approx(2.0 ** (7.0 / 9.0) * C, rel=1e-9)


def test_axial_rating_is_that_of_the_standards_axial_factor() -> None:
    """ISO 281: P = Y F_a, Y = 0.4 cot α, of a load along the shaft alone; of 0.378 it rounds.

    Of rollers that carry evenly, for which the standard's λν = 0.83 is made up.
    """
    C = dynamic_load_rating(ROW)
    gamma = ROW.ball_diameter * math.cos(ALPHA) / ROW.pitch_diameter
    ratings = ratings_of_races(LINE_CONTACT, C / (Z * math.cos(ALPHA)), gamma)
    Q = 5000.0 / (Z * math.sin(ALPHA))
    L = 0.83**4 * million_revolutions(LINE_CONTACT, ratings, (Q, Q))
    P = C * L**-0.25
    assert pytest.approx(0.378 / math.tan(ALPHA) * 5000.0, rel=0.01) == P
    assert pytest.approx(0.4 / math.tan(ALPHA) * 5000.0, rel=0.08) == P


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
