"""Tapered rollers, against straight races written out here, closed forms and ISO 281."""

import dataclasses

import pytest

from bearingcore import Bearing, Scene, equilibrium, limits, presets
from bearingcore.errors import FieldError

PAIR = presets["30206-back-to-back"].healthy()
ROW = PAIR.bearing.replace(rows=())
Z = ROW.n_balls
HELD = ("x", "y", "z")


def of(bearing: Bearing, **changes: object) -> Scene:
    dofs = "tilt free" if bearing.rows else HELD
    return dataclasses.replace(PAIR, bearing=bearing, dofs=dofs).replace(**changes)


def test_next_to_no_angle_makes_cylindrical_rollers() -> None:
    nearly = dataclasses.replace(PAIR, bearing=ROW.replace(contact_angle=1e-6), dofs=("x", "y"))
    flat = nearly.replace(fy=-4000.0, fz=0.0)
    length = ROW.roller_length or 0.0
    straight = Bearing.cylindrical(Z, ROW.ball_diameter, length, ROW.pitch_diameter)
    cylindrical = dataclasses.replace(flat, bearing=straight)
    loads = [equilibrium(bearing, [0.1]).ball_load for bearing in (flat, cylindrical)]
    assert loads[0] == pytest.approx(loads[1], rel=1e-6, abs=1e-3)


def test_what_it_cannot_do_is_said_or_refused() -> None:
    said = {limit.name: limit.sentence for limit in limits(PAIR)}
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
