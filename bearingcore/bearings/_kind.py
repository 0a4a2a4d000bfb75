"""Base class of the kinds of bearings; each kind is a file with a subclass.

A `Bearing` uses its kind, and everything else reads data of `bearing.kind`: a flag, a sentence, a
tuple of names. No code outside this package infers the kind of a bearing from its numbers.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from bearingcore.bearings._contact import Contact
from bearingcore.bearings._drawing import Derived
from bearingcore.bearings._hertz import RaceContact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._line_contact import RollerContact
from bearingcore.common import Array, _checks as checks

DIRECTIONS = ("x", "y", "z", "rx", "ry")
"""Displacements of the inner ring against the outer one: along x, y, z, rotations about x, y."""

ISO_76_BALLS, ISO_76_SELF_ALIGNING, ISO_76_ROLLERS = 4.2e9, 4.6e9, 4.0e9
"""Contact pressures [Pa] that ISO 76 allows at rest."""


class Variant(NamedTuple):
    """A variant of a kind in a list of choices: its name, its label and a description."""

    name: str
    label: str
    about: str


class Picture(NamedTuple):
    """The cross-section of a kind: shapes of the rolling element and of both races.

    `element` is "ball" or "roller", `outer` "groove", "sphere" or "cylinder", `inner` "groove" or
    "flat" (no shoulders). `dimensions` are fields of a `Bearing` that are drawn as arrows, in
    addition to those of all kinds; `notes` are the lines below the enlarged contact.
    """

    element: str
    outer: str
    inner: str
    dimensions: tuple[str, ...]
    notes: tuple[str, ...]


class Kind:
    """A kind of bearing: its words, numbers and rules.

    Attributes
    ----------
    name
        name of the kind in files.
    element
        word for a rolling element: "ball" or "roller".
    variants
        variants in lists of choices, the usual one first.
    exponent, exponent_text
        exponent of load over compression, as a number and as superscript text.
    line_contact
        True if elements touch straight races along a fixed line (see `Contact`): life, film and
        ratings differ, and there are no groove centres.
    directions
        directions, out of DIRECTIONS, in which the inner ring can move.
    needed_directions
        directions that a general load moves if this bearing alone holds the shaft.
    carries
        a clause on the loads that the bearing carries; empty if all five directions are possible.
    left_out
        the reason why fewer than five directions are possible; empty if all five are.
    shoulders
        races with shoulders that a contact may climb.
    tilt_unknown
        a sentence if elements do not follow a tilt; else empty.
    rating_unknown
        the words that refuse a dynamic load rating; empty if one is computed.
    static_pressure
        pressure [Pa] that ISO 76 allows in a contact at rest.
    mass_unknown
        words for elements whose mass is not modelled, with the reason; empty if it is modelled.
    estimate_spread
        for estimated insides: the relative error of element over pitch diameter that 19 of 20 stay
        below, and the possible error of the number of elements. None: as measured for balls.
    has_drawing
        True if a bearing can be given by a drawing or by the numbers of its contacts.
    picture
        description of the drawn cross-section.
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
        """Pickle a kind as the module constant of its name, in capitals."""
        return self.name.replace("-", "_").upper()

    def __repr__(self) -> str:
        return repr(self.name)

    @property
    def elements(self) -> str:
        """Name of several rolling elements."""
        return f"{self.element}s"

    def recognizes(self, bearing: InRows) -> bool:
        """Return True if numbers without a named kind, as in old files, belong to this kind."""
        raise NotImplementedError

    def check(self, bearing: InRows) -> None:
        """Raise ValueError if a bearing has numbers that this kind cannot have."""
        raise NotImplementedError

    def variant(self, bearing: InRows) -> str:
        """Return the name of a bearing's variant; empty if it is none of `variants`."""
        return self.variants[0].name

    def arrangement(self, bearing: InRows) -> str:
        """Return the arrangement of a pair, out of ARRANGEMENTS; empty without a pair."""
        return ""

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        """Return the names of the fields that define a bearing; all others follow."""
        raise NotImplementedError

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        """Return the names of derived numbers that are worth showing."""
        raise NotImplementedError

    def derived(self, bearing: InRows) -> Derived | None:
        """Return the derived fields, or None if there are none."""
        return None

    def completed(self, bearing: InRows, changes: dict[str, Any]) -> dict[str, Any]:
        """Add to changed fields what has to change with them; see `Bearing.replace`."""
        # a row more or less makes another kind
        return {"kind": ""} | changes if "rows" in changes else changes

    def race_contact(self, bearing: InRows, race: str) -> RaceContact | RollerContact:
        """Return the contact of an element with a race, "outer" or "inner"; see `Bearing`."""
        raise NotImplementedError

    def knows_contacts(self, bearing: InRows) -> bool:
        """Return True if `race_contact` has an answer."""
        return True

    def carries_thrust_one_way(self, bearing: InRows) -> bool:
        """Return True if a row has a shoulder on only one side of each race.

        This holds at a contact angle; at angle 0 a row carries thrust both ways or not at all.
        """
        return bearing.contact_angle > 0.0

    def groove_radius(self, bearing: InRows, race: str) -> float | None:
        """Return the radius [m] of a race across the rolling direction; None if unknown."""
        return None

    def profile_drop(self, bearing: InRows, place: Array) -> Array:
        """Return the drop P [m] of a roller's profile at distances [m] from its middle."""
        raise NotImplementedError

    def volume(self, bearing: InRows) -> float:
        """Return the volume [m³] of a rolling element; π D_b³/6 for a ball."""
        return math.pi / 6.0 * bearing.ball_diameter**3

    def contact(self, bearing: InRows) -> Contact:
        """Return the contact of each element of a bearing, or of one of its rows."""
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
        """Return the load-deflection factors [N/m^n] of contacts with inner and outer race.

        Their ratio is that of Hertzian contacts if the drawing is known, and else 1. In series they
        make `load_deflection_factor`: two equal contacts have 2^n times that factor each.
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
        """Return the unloaded distances [m] of a ball's centre from both groove centres.

        They are r_i − D_b/2 and r_o − D_b/2, scaled so that their sum is A0; without a drawing each
        is half of A0. Both are 0 without groove centres.
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
        """Raise ValueError if the mass of the elements is not modelled."""
        if self.mass_unknown:
            raise checks.refuse("balls", "with mass", f'"massless" for {self.mass_unknown}')

    def check_directions(self, dofs: tuple[str, ...]) -> None:
        """Raise ValueError for directions in which a bearing of this kind cannot move."""
        if not set(dofs) <= set(self.directions):
            allowed = f"{' and '.join(self.directions)}, as {self.carries}"
            raise checks.refuse("dofs", " ".join(dofs), allowed)
