"""Data of a kind of bearing; each kind is a file that fills this in.

A `Bearing` uses its kind, and everything else reads data of `bearing.kind`: a flag, a sentence, a
tuple of names. Nothing outside this package compares numbers to find out what a bearing is.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from bearingcore.bearings._contact import Contact
from bearingcore.bearings._drawing import Derived
from bearingcore.bearings._hertz import RaceContact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._line_contact import RollerContact
from bearingcore.common import Array
from bearingcore.common import _checks as checks

DIRECTIONS = ("x", "y", "z", "rx", "ry")
"""Displacements of the inner ring against the outer one: along x, y, z, rotations about x, y."""

ISO_76_BALLS, ISO_76_SELF_ALIGNING, ISO_76_ROLLERS = 4.2e9, 4.6e9, 4.0e9
"""Contact pressures [Pa] that ISO 76 allows at rest."""


class Variant(NamedTuple):
    """A way in which a kind of bearing is offered: its name, its label and what it is."""

    name: str
    label: str
    about: str


class Picture(NamedTuple):
    """The cross-section of a kind: shapes of the rolling element and of both races.

    `element` is "ball" or "roller", `outer` "groove", "sphere" or "cylinder", `inner` "groove" or
    "flat" (no shoulders); `dimensions` the fields of a `Bearing` that are drawn as arrows besides
    those that all kinds have, `notes` the lines below the enlarged contact.
    """

    element: str
    outer: str
    inner: str
    dimensions: tuple[str, ...]
    notes: tuple[str, ...]


class Kind:
    """A kind of bearing; the functions of its file are methods of a subclass.

    Attributes
    ----------
    name
        as files have it.
    element
        what a rolling element is called: "ball" or "roller".
    variants
        how the kind is offered, the usual one first.
    exponent, exponent_text
        of load over compression, as a number and raised in print.
    line_contact
        True where elements touch straight races along a line, which is fixed (see `Contact`): life,
        film and ratings differ, and there are no groove centres.
    directions
        out of DIRECTIONS in which the inner ring can move.
    needed_directions
        those which a load in general moves, where nothing but this bearing holds the shaft.
    carries
        a sentence on what the others would need; empty where there are none.
    left_out
        why fewer directions than five are all there is; empty where all five are.
    shoulders
        races that have shoulders which a contact may climb.
    tilt_unknown
        a sentence where elements do not follow a tilt; else empty.
    rating_unknown
        the words in which a dynamic load rating is refused; empty where one is computed.
    static_pressure
        [Pa] that ISO 76 allows in a contact at rest.
    mass_unknown
        elements whose mass cannot be reckoned with, and why; empty where it can.
    estimate_spread
        of insides that are estimated: the relative error of element over pitch diameter that 19 of
        20 stay below, and how many elements there may be more or less. None: as measured of balls.
    has_drawing
        True where a bearing is given either by a drawing or by the numbers of its contacts.
    picture
        how its cross-section is drawn.
    """

    name: str
    element: str
    variants: tuple[Variant, ...]
    picture: Picture
    exponent: float = 1.5
    exponent_text: str = "¹·⁵"
    line_contact: bool = False
    directions: tuple[str, ...] = DIRECTIONS
    needed_directions: tuple[str, ...] = DIRECTIONS
    carries: str = ""
    left_out: str = ""
    shoulders: tuple[str, ...] = ("inner", "outer")
    tilt_unknown: str = ""
    rating_unknown: str = ""
    mass_unknown: str = ""
    static_pressure: float = ISO_76_BALLS
    estimate_spread: tuple[float, int] | None = None
    has_drawing: bool = True

    def __reduce__(self) -> str:
        """A kind sent to another process is the one of its file there, named in capitals."""
        return self.name.replace("-", "_").upper()

    def __repr__(self) -> str:
        return repr(self.name)

    @property
    def elements(self) -> str:
        """Name of several rolling elements."""
        return f"{self.element}s"

    def recognizes(self, bearing: InRows) -> bool:
        """True where numbers without the name of a kind, as in old files, are of this one."""
        raise NotImplementedError

    def check(self, bearing: InRows) -> None:
        """ValueError where a bearing has numbers that this kind cannot have."""
        raise NotImplementedError

    def variant(self, bearing: InRows) -> str:
        """Which of `variants` a bearing is; empty where it is none of them."""
        return self.variants[0].name

    def arrangement(self, bearing: InRows) -> str:
        """Arrangement of a pair, out of ARRANGEMENTS; empty of one row and of any other rows."""
        return ""

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        """Names of the fields that a bearing is given by; all others follow."""
        raise NotImplementedError

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        """Names of the numbers worth showing that follow from the fields."""
        raise NotImplementedError

    def derived(self, bearing: InRows) -> Derived | None:
        """The fields that follow from others, or None where nothing follows."""
        return None

    def completed(self, bearing: InRows, changes: dict[str, Any]) -> dict[str, Any]:
        """Add to changed fields what has to change with them; see `Bearing.replace`."""
        # a row more or less makes another kind
        return {"kind": ""} | changes if "rows" in changes else changes

    def race_contact(self, bearing: InRows, race: str) -> RaceContact | RollerContact:
        """Contact of a rolling element with a race, "outer" or "inner"; see `Bearing`."""
        raise NotImplementedError

    def knows_contacts(self, bearing: InRows) -> bool:
        """True where `race_contact` has an answer."""
        return True

    def carries_thrust_one_way(self, bearing: InRows) -> bool:
        """True where one of its rows has a shoulder on one side of each race alone.

        Contacts at an angle have; at 0 they carry thrust both ways, or not at all.
        """
        return bearing.contact_angle > 0.0

    def groove_radius(self, bearing: InRows, race: str) -> float | None:
        """Radius [m] of a race across the rolling; None where it is not known, or no groove."""
        return None

    def profile_drop(self, bearing: InRows, place: Array) -> Array:
        """Drop P [m] of a roller's profile at places [m] from its middle; see `statics.laminae`."""
        raise NotImplementedError

    def volume(self, bearing: InRows) -> float:
        """Volume [m³] of a rolling element; a ball's, π D_b³/6."""
        return math.pi / 6.0 * bearing.ball_diameter**3

    def contact(self, bearing: InRows) -> Contact:
        """The contact of each element of a bearing, or of one of its rows."""
        return Contact(
            angle=bearing.contact_angle,
            lever=bearing.groove_center_radius,
            beyond=0.0,
            factor=bearing.load_deflection_factor,
            exponent=self.exponent,
            room=bearing.ball_radius,
            center_distance=bearing.groove_center_distance,
        )

    def race_factors(self, bearing: InRows) -> tuple[float, float]:
        """Load-deflection factors [N/m^n] of an element's contacts with inner and outer race.

        Their ratio is that of Hertz's contacts where the drawing is known and 1 elsewhere, and in
        series they are `load_deflection_factor`: of both contacts alike each is 2^n of it.
        """
        inner, outer = (
            (self.race_contact(bearing, race).load_deflection_factor for race in ("inner", "outer"))
            if self.groove_radius(bearing, "inner") is not None
            else (1.0, 1.0)
        )
        n = self.exponent
        scale = bearing.load_deflection_factor * (inner ** (-1.0 / n) + outer ** (-1.0 / n)) ** n
        return scale * inner, scale * outer

    def race_distances(self, bearing: InRows) -> tuple[float, float]:
        """Unloaded distances [m] of a ball's centre from the inner and outer groove's centre.

        r_i − D_b/2 and r_o − D_b/2, in proportion to make A0; halves of it without a drawing. 0
        and 0 where there are no such centres.
        """
        if bearing.groove_center_distance is None:
            return 0.0, 0.0
        r_i, r_o = self.groove_radius(bearing, "inner"), self.groove_radius(bearing, "outer")
        inner, outer = 1.0, 1.0
        if r_i is not None and r_o is not None:
            inner, outer = r_i - bearing.ball_radius, r_o - bearing.ball_radius
        scale = bearing.groove_center_distance / (inner + outer)
        return scale * inner, scale * outer

    def check_mass(self) -> None:
        """ValueError where the mass of the elements cannot be reckoned with."""
        if self.mass_unknown:
            raise checks.refuse("balls", "with mass", f'"massless" of {self.mass_unknown}')

    def check_directions(self, dofs: tuple[str, ...]) -> None:
        """ValueError for directions in which a bearing of this kind cannot move."""
        if not set(dofs) <= set(self.directions):
            allowed = f"{' and '.join(self.directions)}, as {self.carries}"
            raise checks.refuse("dofs", " ".join(dofs), allowed)
