"""The bearing: what is true of all kinds."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import Any, Self, cast

from bearingcore.bearings import (
    _ball as ball,
)
from bearingcore.bearings import (
    _drawing as drawing,
)
from bearingcore.bearings import (
    _inside as inside,
)
from bearingcore.bearings import (
    _roller as roller,
)
from bearingcore.bearings import (
    _self_aligning as self_aligning,
)
from bearingcore.bearings import (
    _tapered as tapered,
)
from bearingcore.bearings._contact import Contact
from bearingcore.bearings._hertz import RaceContact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import Kind
from bearingcore.bearings._kinds import kind_of
from bearingcore.bearings._line_contact import RollerContact
from bearingcore.bearings._material import BALL_MATERIALS, STEEL_DENSITY
from bearingcore.bearings._rows import MOST_ROWS, Row, paired, pressure_centers_apart, respaced
from bearingcore.common import _checks as checks
from bearingcore.common import _scene_file as scene_file

ESTIMATES = ("n_balls", "ball_diameter", "pitch_diameter", "roller_length")
"""Fields that may be estimates."""

RATED = (
    *("n_balls", "ball_diameter", "pitch_diameter", "contact_angle", "roller_length"),
    *("inner_groove_radius", "outer_groove_radius", "groove_center_distance"),
    *("ball_youngs_modulus", "ball_poisson"),
)
"""Fields that C_r depends on, besides how many rows there are and what each has of its own."""
_ABOVE_0 = (
    *("groove_center_radius", "load_deflection_factor"),
    *("outer_raceway_radius", "inner_raceway_radius"),
)


@dataclass(frozen=True)
class Bearing(InRows):
    """A ball or roller bearing as the contact model sees it (SI units, angles in rad).

    Parameters
    ----------
    n_balls
        number of balls N_b.
    ball_diameter, pitch_diameter
        D_b and D_p [m].
    contact_angle
        unloaded contact angle α0 [rad], at least 0 and at most 80°.
    groove_center_radius
        radius r_d [m] of the circle on which the inner groove's centres of curvature are: the
        lever with which a tilt of the ring moves a ball's contact along z (Eq. 12).
    groove_center_distance
        distance A0 [m] between the groove centres of an unloaded ball (Eqs. 9, 10). None of
        rollers, whose line of contact is fixed; a number of old files is taken off.
    radial_clearance
        r_L [m], on top of the contact angle (Eq. 11); below 0 an interference fit, which
        compresses the elements by as much without a load.
    load_deflection_factor
        K [N/m^1.5] of both contacts of a ball in series (Eq. 13).
    outer_raceway_radius, inner_raceway_radius
        radii R_o and R_i [m] at the bottom of the grooves; defects are cut there (Eq. 6).
    inner_groove_radius, outer_groove_radius, youngs_modulus, poisson
        r_i, r_o [m], E [Pa] and ν where the drawing is known, all four of them: contact pressure
        needs them. `from_drawing` derives K, A0, r_d, R_o and R_i from them, `replace` again.
    rows
        none for one row at the middle of the bearing; else each `Row`. `n_balls` and dimensions are
        those of every row that has none of its own.
    roller_length
        [m] of cylindrical rollers, which replace balls: line contact, K in N/m^(10/9),
        radial directions only. None for balls.
    density
        of the balls [kg/m³]; 7800 for steel, 3200 for silicon nitride. Only balls with mass need
        it.
    ball_youngs_modulus, ball_poisson
        E [Pa] and ν of balls of another material than the rings, as of a hybrid bearing, whose
        `youngs_modulus` and `poisson` are then those of the rings; see `with_balls_of`. None: as of
        the rings. Only with a drawing: K given as a number is that of both materials together.
    kind
        a `Kind` or its name, out of `bearingcore.bearings._kinds`. Empty: the one whose numbers
        these are, as in files that do not say it.
    estimated
        names of fields out of ESTIMATES whose numbers are estimates, as of bearings known by their
        designation alone (`bearingcore.bearings._designation`). `replace` takes those off that it
        gives a number.
    dynamic_load_rating
        C_r [N] of the whole bearing by a catalogue, as of bearings known by their designation; None
        where it is not known. `replace` takes it off where it changes what is rated.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.

    Source: Petersen, Howard & Prime (2014), Sections 2.1 and 2.3.
    """

    groove_center_radius: float
    groove_center_distance: float | None
    radial_clearance: float
    load_deflection_factor: float
    outer_raceway_radius: float
    inner_raceway_radius: float
    inner_groove_radius: float | None = None
    outer_groove_radius: float | None = None
    youngs_modulus: float | None = None
    poisson: float | None = None
    rows: tuple[Row, ...] = ()
    roller_length: float | None = None
    density: float = field(default=STEEL_DENSITY, metadata=scene_file.LEFT_OUT)
    kind: Kind = field(default="")  # type: ignore[assignment]  # a name becomes its kind
    estimated: tuple[str, ...] = field(default=(), metadata=scene_file.LEFT_OUT)
    ball_youngs_modulus: float | None = None
    ball_poisson: float | None = None
    dynamic_load_rating: float | None = None

    from_drawing = classmethod(ball.from_drawing)
    cylindrical = classmethod(roller.cylindrical)
    tapered = classmethod(tapered.tapered)
    self_aligning = classmethod(self_aligning.self_aligning)
    paired = paired
    respaced = respaced
    pressure_centers_apart = property(pressure_centers_apart)
    seated = ball.seated
    with_balls_of = ball.with_balls_of
    frequency_spread = inside.frequency_spread

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in _ABOVE_0:
            checks.keep_number(self, name, above=0.0)
        for name in ("groove_center_distance", "roller_length"):
            checks.keep_number(self, name, optional=True, above=0.0)
        checks.keep_number(self, "density", above=0.0, unit="kg/m³")
        checks.keep_number(self, "dynamic_load_rating", optional=True, above=0.0, unit="N")
        least = -self.ball_radius  # more than any contact could be compressed
        checks.keep_number(self, "radial_clearance", at_least=least, unit="m")
        drawing.check_fit(vars(self))
        checks.keep(self, **drawing.checked(vars(self)))
        rows = self.rows if isinstance(self.rows, tuple | list) else (self.rows,)
        checks.keep(self, rows=tuple(rows))
        if len(self.rows) > MOST_ROWS or not all(isinstance(row, Row) for row in self.rows):
            raise checks.refuse("rows", self.rows, f"at most {MOST_ROWS} of Row")
        names: object = self.estimated
        for name in names if isinstance(names, tuple | list) else (names,):
            checks.choice("estimated", name, ESTIMATES)
        checks.keep(self, estimated=tuple(self.estimated))
        checks.keep(self, kind=kind_of(self))
        self.kind.check(self)
        if self.kind.line_contact:
            checks.keep(self, groove_center_distance=None)
        else:
            drawing.center_distance(self.groove_center_distance)
        for k in range(len(self.rows)):
            self.of_row(k)  # refuses dimensions that do not fit each other

    def __repr__(self) -> str:
        """Rolling elements and their places, in a line."""
        rows = f", {len(self.rows)} rows" if len(self.rows) > 1 else ""
        angle = f", {math.degrees(self.contact_angle):.4g}°" if self.contact_angle else ""
        return (
            f"<Bearing: {self.n_balls} {self.kind.elements} of {1e3 * self.ball_diameter:.4g} mm "
            f"on {1e3 * self.pitch_diameter:.4g} mm{angle}{rows}>"
        )

    @property
    def row_distance(self) -> float | None:
        """Distance [m] of two rows along the shaft; None of another number of rows."""
        return self.rows[1].place - self.rows[0].place if len(self.rows) == 2 else None

    @property
    def preload(self) -> float | None:
        """Displacement [m] of the inner grooves of a pair against each other; None of any other."""
        if not self.arrangement:
            return None
        low, high = self.rows
        return abs(high.offset - low.offset)

    @property
    def arrangement(self) -> str:
        """Arrangement of a pair, out of ARRANGEMENTS; empty of one row and of any other rows."""
        return self.kind.arrangement(self)

    @property
    def contact(self) -> Contact:
        """The contact of each element, by the bearing's own numbers; of a row, `of_row`'s."""
        return self.kind.contact(self)

    @property
    def is_flat(self) -> bool:
        """True where a radial load moves nothing out of the plane of the balls."""
        return self.contact_angle == 0.0 and all(
            row.place == 0.0 and not self.unlike(row) for row in self.all_rows
        )

    def replace(self, **changes: Any) -> Self:
        """A bearing with fields changed. What follows from a drawing, or of rollers, follows.

        A derived field (A0, r_d, K, R_o, R_i) that was set apart from what the drawing gives keeps
        its proportion to it; one named in `changes` is taken as it is.
        """
        kept: dict[str, Any] = {
            "estimated": tuple(name for name in self.estimated if name not in changes)
        }
        new = cast(Self, self.kind.replaced(self, kept | changes))
        if "dynamic_load_rating" in changes:
            return new
        rating = self.dynamic_load_rating if new.rated == self.rated else None
        return dataclasses.replace(new, dynamic_load_rating=rating)

    @property
    def rated(self) -> tuple[object, ...]:
        """Numbers that C_r depends on: dimensions, and what each row has of its own.

        Not among them is what shifts loads, but no dimension: clearance, preload, the places of
        rows and how they face.
        """
        rows = tuple(tuple(self.unlike(row).items()) for row in self.all_rows)
        return tuple(getattr(self, name) for name in RATED), rows

    @property
    def ball_material(self) -> str:
        """Name out of `BALL_MATERIALS` that the balls are of; empty where it is none of them.

        The density does not count: it may be set apart from the stiffness.
        """
        if not self.is_hybrid:
            return "steel"
        pair = (self.ball_youngs_modulus, self.ball_poisson)
        return next((name for name, material in BALL_MATERIALS.items() if material[:2] == pair), "")

    @property
    def is_hybrid(self) -> bool:
        """True where the balls are of another material than the rings."""
        pair = (self.ball_youngs_modulus, self.ball_poisson)
        rings = (self.youngs_modulus, self.poisson)
        return any(name not in (None, ring) for name, ring in zip(pair, rings, strict=True))

    @property
    def is_drawn(self) -> bool:
        """True where the bearing carries its groove radii and material."""
        return any(getattr(self, name) is not None for name in drawing.OPTIONAL_FIELDS)

    @property
    def knows_contacts(self) -> bool:
        """True where `race_contact` has an answer."""
        return self.kind.knows_contacts(self)

    def race_contact(self, race: str) -> RaceContact | RollerContact:
        """Hertzian contact of a ball or roller with a race, "outer" or "inner".

        Rollers are of steel. Of a self-aligning bearing groove radius and modulus follow from its
        numbers, with a Poisson's ratio of 0.3. ValueError where a bearing does not carry its
        drawing.
        """
        return self.kind.race_contact(self, checks.choice("race", race, ("outer", "inner")))

    def groove_radius(self, race: str) -> float | None:
        """Radius [m] of a race across the rolling, "outer" or "inner"; None where not known.

        Of a self-aligning bearing R_e and r_i = A0 + D_b − R_e; rollers run in no groove.
        """
        return self.kind.groove_radius(self, checks.choice("race", race, ("outer", "inner")))

    @property
    def diametral_play(self) -> float:
        """Sideways play of the inner ring from contact to contact [m], see `Contact.play`."""
        return self.contact.play(self.radial_clearance)

    @property
    def free_contact_angle(self) -> float:
        """Contact angle α_f [rad] with the balls pushed home, see `Contact.free_angle`."""
        return self.contact.free_angle(self.radial_clearance)

    @property
    def ball_mass(self) -> float:
        """Mass of a ball or roller [kg], of its density throughout."""
        return self.density * self.kind.volume(self)

    def centrifugal_load(self, shaft_speed: float) -> float:
        """Centrifugal load F_c = m ω_c² D_p/2 [N] of a ball on the pitch circle; speed in rad/s."""
        return self.ball_mass * self.cage_speed(shaft_speed) ** 2 * 0.5 * self.pitch_diameter

    @property
    def race_factors(self) -> tuple[float, float]:
        """Load-deflection factors [N/m^n] of contacts with inner and outer race, see `Kind`."""
        return self.kind.race_factors(self)
