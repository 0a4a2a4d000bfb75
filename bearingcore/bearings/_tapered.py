"""Tapered rollers: line contacts at a fixed contact angle, in one row or a pair.

Quantity                                    | Symbol | Name
------------------------------------------- | ------ | --------------
diameter of a roller in its middle          | D      | ball_diameter
length of a roller that lies on the races   | l      | roller_length
diameter of the circle of those middles     | D_p    | pitch_diameter
angle of the line of contact                | α      | contact_angle

The approach of both races along the line of contact, δ = δ_r cos α + δ_z sin α, compresses a
roller. It then carries Q = K δ^(10/9), with the K of a cylindrical roller. The line of contact goes
through the middle of the roller, which a tilt of the ring moves. Races are straight: no
displacement turns the line of contact. A ring that moves along its races by half the length of a
roller loses contact.
α is that of the outer race, which a catalogue's Y = 0.4 cot α gives (ISO 281).

Left out: the taper of a roller. It makes the inner race some 4° less steep than the outer one, and
the rib takes the rest of the load, a few per cent, with friction. Rollers neither swivel nor tilt
between their races.
"""

from __future__ import annotations

import math
from typing import Any

from bearingcore.bearings import _inside as inside
from bearingcore.bearings._contact import Contact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import DIRECTIONS, Picture, Variant
from bearingcore.bearings._line_contact import RollerContact, roller_contact, tapered_profile_drop
from bearingcore.bearings._roller import Roller, length_of
from bearingcore.bearings._row import arrangement_of
from bearingcore.common import Array, _checks as checks

USUAL_ANGLE = math.radians(14.0361)
"""14°02′10″, the angle of most bearings of the series 302 and 322 (ISO 355)."""

PAIR_PREFIX = "tapered-"
"""Prefix of the arrangement in the name of a pair."""


class Tapered(Roller):
    """Tapered rollers of steel, given by their middles and the angle of the outer race."""

    name = "tapered"
    variants = (
        Variant(
            "tapered",
            "Tapered rollers",
            "Line contact at an angle: an axial load has to hold the rings together.",
        ),
        Variant(
            "tapered-back-to-back",
            "Tapered pair, back to back (O)",
            "Two rows whose lines of contact meet the shaft far apart: stiff against tilt.",
        ),
        Variant(
            "tapered-face-to-face",
            "Tapered pair, face to face (X)",
            "Two rows whose lines of contact meet the shaft close together: soft against tilt.",
        ),
    )
    picture = Picture(
        element="roller",
        outer="cylinder",
        inner="cylinder",
        dimensions=("roller_length", "contact_angle"),
        notes=(
            "a roller on its races, its taper not drawn",
            "no load and no friction at its rib",
        ),
    )
    directions = needed_directions = DIRECTIONS
    carries = left_out = ""
    tilt_unknown = (
        "Tilt and swivelling of the rollers: not known, as a roller is pressed in its middle in "
        "this model. A ring that tilts presses their ends on the races. The friction of the rib, "
        "and the few per cent of the load that it takes, are left out."
    )
    estimate_spread = (inside.TAPERED_SPREAD, 1)
    mass_unknown = "tapered rollers: a rib holds them, which is left out"

    def recognizes(self, bearing: InRows) -> bool:
        return bearing.roller_length is not None and bearing.contact_angle != 0.0

    def check(self, bearing: InRows) -> None:
        length_of(bearing)
        checks.real_number("contact_angle", bearing.contact_angle, above=0.0, unit="rad")
        if bearing.is_drawn:
            raise checks.refuse(
                "inner_groove_radius", bearing.inner_groove_radius, "None for tapered rollers"
            )
        if any(row.own for row in bearing.rows):
            raise checks.refuse("rows", len(bearing.rows), "rows of tapered rollers that are alike")

    def arrangement(self, bearing: InRows) -> str:
        return arrangement_of(bearing.rows)

    def variant(self, bearing: InRows) -> str:
        if len(bearing.all_rows) == 1:
            return "tapered"
        name = PAIR_PREFIX + self.arrangement(bearing)
        return name if name in [offered.name for offered in self.variants] else ""

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        paired = ("row_distance", "preload") if self.arrangement(bearing) else ()
        return (*super().inputs(bearing), "contact_angle", *paired)

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        meet = ("preload_force", "pressure_centers_apart") if self.arrangement(bearing) else ()
        return (*meet, *super().facts(bearing))

    def completed(self, bearing: InRows, changes: dict[str, Any]) -> dict[str, Any]:
        return {"kind": self} | changes

    def contact(self, bearing: InRows) -> Contact:
        # the rib holds a roller on the inner race; after half its length the outer race loses it
        return super().contact(bearing)._replace(room=0.5 * length_of(bearing))

    def race_contact(self, bearing: InRows, race: str) -> RollerContact:
        across = bearing.pitch_diameter / math.cos(bearing.contact_angle)
        return roller_contact(race, bearing.ball_diameter, across, length_of(bearing))

    def profile_drop(self, bearing: InRows, place: Array) -> Array:
        return tapered_profile_drop(place, bearing.ball_diameter, length_of(bearing))


TAPERED = Tapered()
