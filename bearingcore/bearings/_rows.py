"""Bearings of two rows of balls or more on one shaft."""

from __future__ import annotations

import math

from bearingcore.bearings._ball import SECTION, Ball
from bearingcore.bearings._contact import Contact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import Variant
from bearingcore.bearings._row import LENGTHS, OWN, arrangement_of
from bearingcore.common import _checks as checks


class Rows(Ball):
    """Two rows of balls or more, which may have balls and dimensions of their own."""

    name = "rows"
    element = "ball"
    variants = (
        Variant(
            "back-to-back",
            "Pair, back to back (O)",
            "Two rows whose lines of contact meet the shaft far apart: stiff against tilt.",
        ),
        Variant(
            "face-to-face",
            "Pair, face to face (X)",
            "Two rows whose lines of contact meet the shaft close together: soft against tilt.",
        ),
        Variant("tandem", "Pair, tandem", "Two rows that share an axial load one way."),
    )
    picture = SECTION._replace(dimensions=(*SECTION.dimensions, "row_distance"))

    def recognizes(self, bearing: InRows) -> bool:
        return bearing.roller_length is None and len(bearing.rows) > 1

    def check(self, bearing: InRows) -> None:
        if len(bearing.rows) < 2:
            raise checks.refuse("rows", len(bearing.rows), "at least 2 where the kind is 'rows'")
        self._check_balls(bearing)

    def arrangement(self, bearing: InRows) -> str:
        return arrangement_of(bearing.rows)

    variant = arrangement

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        names = super().inputs(bearing)
        arrangement = self.variant(bearing)
        if not arrangement:
            return names
        of_row = OWN if bearing.is_drawn else [name for name in OWN if name not in LENGTHS]
        second = (f"second_{name}" for name in of_row)
        return (*names, "row_distance", *(("preload",) if arrangement != "tandem" else ()), *second)

    def contact(self, bearing: InRows) -> Contact:
        """Return the contact of a row; at r_d, lines of contact meet the inner groove centres.

        These are (r_d − D_p/2) tan α0 beyond the centres of the balls; for a bearing with a drawing
        this is (r_i − D_b/2) sin α0.
        """
        beyond = bearing.groove_center_radius - 0.5 * bearing.pitch_diameter
        return super().contact(bearing)._replace(beyond=beyond * math.tan(bearing.contact_angle))

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        meet = self.variant(bearing) in ("back-to-back", "face-to-face")
        return (
            *(("preload_force", "pressure_centers_apart") if meet else ()),
            *super().facts(bearing),
        )


ROWS = Rows()
