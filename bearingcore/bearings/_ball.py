"""One row of balls: deep groove, or angular contact where the contact angle is not 0."""

from __future__ import annotations

from typing import Any

from bearingcore.bearings import _drawing as drawing
from bearingcore.bearings._hertz import RaceContact, race_contact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import Kind, Picture, Variant
from bearingcore.common import _checks as checks

_ALWAYS = (
    *("n_balls", "ball_diameter", "pitch_diameter", "contact_angle", "radial_clearance"),
    "density",
)

SECTION = Picture(
    element="ball",
    outer="groove",
    inner="groove",
    dimensions=("groove_center_radius", "groove_center_distance"),
    notes=("a ball in its grooves, gaps drawn large",),
)


class Ball(Kind):
    """A row of balls in grooves, given by a drawing or by the numbers of its contacts."""

    name = "ball"
    element = "ball"
    variants: tuple[Variant, ...] = (
        Variant("single", "One row of balls", "Deep groove, or angular contact with an angle."),
    )
    picture = SECTION

    def recognizes(self, bearing: InRows) -> bool:
        return bearing.roller_length is None and len(bearing.rows) < 2

    def check(self, bearing: InRows) -> None:
        if len(bearing.rows) > 1:
            raise checks.refuse(
                "rows", len(bearing.rows), "one row where the kind is 'ball': see Bearing.replace"
            )
        self._check_balls(bearing)

    def _check_balls(self, bearing: InRows) -> None:
        if bearing.roller_length is not None:
            raise checks.refuse(
                "roller_length", bearing.roller_length, "None for balls: see Bearing.cylindrical"
            )

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        if not bearing.is_drawn:
            return (*_ALWAYS, *drawing.Derived._fields)
        return (*_ALWAYS, *drawing.OPTIONAL_FIELDS, *drawing.BALL_MATERIAL)

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        drawn = ("groove_center_radius", "raceway_radii", "outer_conformity", "inner_conformity")
        return (
            *("free_contact_angle", "diametral_play"),
            *("load_deflection_factor", "groove_center_distance"),
            *(drawn if bearing.is_drawn else ()),
        )

    def derived(self, bearing: InRows) -> drawing.Derived | None:
        if not bearing.is_drawn:
            return None
        dimensions: dict[str, Any] = {name: getattr(bearing, name) for name in drawing.DIMENSIONS}
        return drawing.derive(**dimensions)

    def race_contact(self, bearing: InRows, race: str) -> RaceContact:
        name = f"{race}_groove_radius"
        radius = getattr(bearing, name)
        if radius is None or bearing.youngs_modulus is None or bearing.poisson is None:
            raise checks.refuse(name, radius, "a number, for contact pressure")
        return race_contact(
            race,
            bearing.ball_diameter,
            bearing.pitch_diameter,
            radius,
            bearing.contact_angle,
            bearing.youngs_modulus,
            bearing.poisson,
            bearing.ball_youngs_modulus,
            bearing.ball_poisson,
        )

    def knows_contacts(self, bearing: InRows) -> bool:
        return bearing.is_drawn

    def groove_radius(self, bearing: InRows, race: str) -> float | None:
        radius: float | None = getattr(bearing, f"{race}_groove_radius")
        return radius


BALL = Ball()
