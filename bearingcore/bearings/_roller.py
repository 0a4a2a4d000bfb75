"""Cylindrical rollers: line contacts by ISO 16281, radial loads only."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bearingcore.bearings._drawing import Derived
from bearingcore.bearings._kind import ISO_76_ROLLERS, Kind, Picture, Variant
from bearingcore.bearings._line_contact import (
    RollerContact,
    profile_drop,
    roller_contact,
    series_factor,
)
from bearingcore.common import Array
from bearingcore.common import _checks as checks

if TYPE_CHECKING:
    from bearingcore.bearings._bearing import Bearing


def cylindrical(
    cls: type[Bearing],
    n_rollers: int,
    roller_diameter: float,
    roller_length: float,
    pitch_diameter: float,
    radial_clearance: float = 0.0,
) -> Bearing:
    """Make a cylindrical roller bearing of steel, with line contacts by ISO 16281.

    K = 35 948 l^(8/9) N/mm^(10/9), l [mm] the length of a roller, both contacts in series.
    Lengths in m. Rollers do not tilt in this model and carry no load along the shaft.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """
    sizes = (roller_diameter, roller_length, pitch_diameter)
    return rollers(cls, ROLLER, n_rollers, sizes, 0.0, radial_clearance)


def rollers(
    cls: type[Bearing],
    kind: Kind,
    n_rollers: int,
    sizes: tuple[float, float, float],
    contact_angle: float,
    radial_clearance: float,
) -> Bearing:
    """One row of rollers of steel; `sizes` [m] are diameter, length and pitch diameter."""
    diameter = checks.real_number("roller_diameter", sizes[0], above=0.0, unit="m")
    length = checks.real_number("roller_length", sizes[1], above=0.0, unit="m")
    pitch = checks.real_number("pitch_diameter", sizes[2], above=diameter, unit="m")
    return cls(
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


def length_of(bearing: Bearing) -> float:
    """Length of the rollers [m]. ValueError where there is none."""
    return checks.real_number("roller_length", bearing.roller_length, above=0.0, unit="m")  # type: ignore[arg-type]  # None is refused there


class Roller(Kind):
    """Cylindrical rollers of steel in one row: they neither tilt nor carry along the shaft."""

    name = "roller"
    element = "roller"
    variants: tuple[Variant, ...] = (
        Variant(
            "rollers",
            "Cylindrical rollers",
            "Line contact between cylindrical races, stiff as ISO 16281 has it for steel. Radial "
            "loads only: axial loads and moments are taken out of the scene. Rollers do not tilt.",
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

    def recognizes(self, bearing: Bearing) -> bool:
        return bearing.roller_length is not None and bearing.contact_angle == 0.0

    def check(self, bearing: Bearing) -> None:
        length = length_of(bearing)
        if bearing.contact_angle != 0.0 or bearing.rows or bearing.is_drawn:
            raise checks.refuse(
                "roller_length",
                length,
                "None, unless {contact_angle} is 0 with one row and no groove radii",
                contact_angle=bearing.contact_angle,
            )

    def nearest(self, bearing: Bearing, variant: str) -> Bearing:
        return bearing.cylindrical(
            bearing.n_balls,
            bearing.ball_diameter,
            bearing.ball_diameter,
            bearing.pitch_diameter,
            bearing.radial_clearance,
        )

    def inputs(self, bearing: Bearing) -> tuple[str, ...]:
        sizes = ("n_balls", "ball_diameter", "roller_length", "pitch_diameter", "radial_clearance")
        return sizes if self.mass_unknown else (*sizes, "density")

    def facts(self, bearing: Bearing) -> tuple[str, ...]:
        return ("line_load_deflection_factor",)

    def derived(self, bearing: Bearing) -> Derived:
        return _derived(
            bearing.ball_diameter,
            length_of(bearing),
            bearing.pitch_diameter,
            bearing.contact_angle,
        )

    def race_contact(self, bearing: Bearing, race: str) -> RollerContact:
        return roller_contact(
            race, bearing.ball_diameter, bearing.pitch_diameter, length_of(bearing)
        )

    def profile_drop(self, bearing: Bearing, place: Array) -> Array:
        return profile_drop(place, bearing.ball_diameter, length_of(bearing))

    def volume(self, bearing: Bearing) -> float:
        return math.pi / 4.0 * bearing.ball_diameter**2 * length_of(bearing)


ROLLER = Roller()
