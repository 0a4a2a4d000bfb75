"""Cylindrical rollers: line contacts by ISO 16281, radial loads only."""

from __future__ import annotations

import math
from typing import Any

from bearingcore.bearings._drawing import Derived
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import ISO_76_ROLLERS, Kind, Picture, Variant
from bearingcore.bearings._line_contact import (
    RollerContact,
    profile_drop,
    roller_contact,
    series_factor,
)
from bearingcore.common import Array, _checks as checks


def roller_numbers(
    kind: Kind,
    n_rollers: int,
    sizes: tuple[float, float, float],
    contact_angle: float,
    radial_clearance: float,
) -> dict[str, Any]:
    """Return the fields of a row of steel rollers from diameter, length and pitch diameter [m]."""
    diameter = checks.real_number("roller_diameter", sizes[0], above=0.0, unit="m")
    length = checks.real_number("roller_length", sizes[1], above=0.0, unit="m")
    pitch = checks.real_number("pitch_diameter", sizes[2], above=diameter, unit="m")
    return dict(
        kind=kind,
        n_balls=n_rollers,
        ball_diameter=diameter,
        roller_length=length,
        pitch_diameter=pitch,
        contact_angle=contact_angle,
        radial_clearance=radial_clearance,
        **_derived(diameter, length, pitch, contact_angle)._asdict(),
    )


def _derived(
    ball_diameter: float, roller_length: float, pitch_diameter: float, contact_angle: float
) -> Derived:
    across = ball_diameter * math.cos(contact_angle)
    return Derived(
        groove_center_radius=0.5 * pitch_diameter,
        groove_center_distance=None,
        load_deflection_factor=series_factor(roller_length),
        outer_raceway_radius=0.5 * (pitch_diameter + across),
        inner_raceway_radius=0.5 * (pitch_diameter - across),
    )


def length_of(bearing: InRows) -> float:
    """Return the length of the rollers [m]; ValueError where there is none."""
    return checks.real_number("roller_length", bearing.roller_length, above=0.0, unit="m")  # type: ignore[arg-type]  # None is refused there


class Roller(Kind):
    """Cylindrical rollers of steel in one row: they neither tilt nor carry along the shaft."""

    name = "roller"
    element = "roller"
    variants: tuple[Variant, ...] = (
        Variant(
            "rollers",
            "Cylindrical rollers",
            "Line contact between cylindrical races, with the stiffness of ISO 16281. Radial loads "
            "only: axial loads and moments are removed from the scene. Rollers do not tilt.",
        ),
    )
    picture = Picture(
        element="roller",
        outer="cylinder",
        inner="flat",
        dimensions=("roller_length",),
        notes=(
            "a roller on its races, clearance drawn large",
            "no tilt, and nothing along the shaft",
        ),
    )
    exponent = 10.0 / 9.0
    exponent_text = "¹⁰⁄⁹"
    line_contact = True
    directions: tuple[str, ...] = ("x", "y")
    needed_directions: tuple[str, ...] = ("x", "y")
    carries = "cylindrical rollers carry radial loads only"
    left_out = "cylindrical rollers carry nothing along the shaft and resist no tilt"
    shoulders = ()
    tilt_unknown = (
        "Tilt of the rollers: not known, as rollers stay parallel to the shaft in this model. A "
        "ring that tilts presses their ends on the races."
    )
    static_pressure = ISO_76_ROLLERS
    has_drawing = False

    def recognizes(self, bearing: InRows) -> bool:
        return bearing.roller_length is not None and bearing.contact_angle == 0.0

    def check(self, bearing: InRows) -> None:
        length = length_of(bearing)
        if bearing.contact_angle != 0.0 or bearing.rows or bearing.is_drawn:
            raise checks.refuse(
                "roller_length",
                length,
                "None, unless {contact_angle} is 0 with one row and no groove radii",
                contact_angle=bearing.contact_angle,
            )

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        sizes = ("n_balls", "ball_diameter", "roller_length", "pitch_diameter", "radial_clearance")
        return sizes if self.mass_unknown else (*sizes, "density")

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        return ("line_load_deflection_factor",)

    def derived(self, bearing: InRows) -> Derived:
        return _derived(
            bearing.ball_diameter,
            length_of(bearing),
            bearing.pitch_diameter,
            bearing.contact_angle,
        )

    def race_contact(self, bearing: InRows, race: str) -> RollerContact:
        return roller_contact(
            race, bearing.ball_diameter, bearing.pitch_diameter, length_of(bearing)
        )

    def profile_drop(self, bearing: InRows, place: Array) -> Array:
        return profile_drop(place, bearing.ball_diameter, length_of(bearing))

    def volume(self, bearing: InRows) -> float:
        return math.pi / 4.0 * bearing.ball_diameter**2 * length_of(bearing)


ROLLER = Roller()
