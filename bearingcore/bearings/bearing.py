"""The bearing: its geometry, its kinematics and the frequencies at which it announces defects.

Quantity                                    | Symbol | Name                     | Unit
------------------------------------------- | ------ | ------------------------ | ---------
number of balls                             | N_b    | n_balls                  |
ball diameter                               | D_b    | ball_diameter            | m
pitch diameter                              | D_p    | pitch_diameter           | m
unloaded contact angle                      | α0     | contact_angle            | rad
radius on which inner groove centres lie    | r_d    | groove_center_radius     | m
unloaded distance of the groove centres     | A0     | groove_center_distance   | m
radial clearance                            | r_L    | radial_clearance         | m
load-deflection factor of a ball            | K      | load_deflection_factor   | N/m^1.5
outer, inner raceway radius (groove bottom) | R_o, R_i | outer_, inner_raceway_radius | m
inner, outer groove radius, if known        | r_i, r_o | inner_, outer_groove_radius | m
Young's modulus and Poisson's ratio, if known | E, ν | youngs_modulus, poisson  | Pa,
the same of balls of another material       | E_b, ν_b | ball_youngs_modulus, ball_poisson | Pa,
density and mass of a ball                  | ρ, m   | density, ball_mass       | kg/m³, kg
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import accumulate
from typing import Any, Self, cast

from bearingcore.bearings import KINDS, drawing, inside, roller, self_aligning, tapered
from bearingcore.bearings.hertz import RaceContact
from bearingcore.bearings.kind import Kind, kind_named
from bearingcore.bearings.line_contact import RollerContact
from bearingcore.bearings.material import BALL_MATERIALS, STEEL_DENSITY, BallMaterial
from bearingcore.bearings.rows import LENGTHS, MOST_ROWS, Row, pair, spaced
from bearingcore.common import checks, scene_file
from bearingcore.common.lazy import cached_property
from bearingcore.errors import FieldError

ESTIMATES = ("n_balls", "ball_diameter", "pitch_diameter", "roller_length")
"""Fields that may be estimates."""

NOT_RATED = ("radial_clearance", "density", "estimated", "kind", "dynamic_load_rating")
"""Fields that C_r does not depend on."""

_ONE_ROW = (Row(),)


@dataclass(frozen=True)
class Bearing:
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
        distance A0 [m] between the groove centres of an unloaded ball (Eqs. 9, 10).
    radial_clearance
        r_L [m], on top of the contact angle (Eq. 11).
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
        a `Kind` or its name, out of `bearingcore.bearings.KINDS`. Empty: the one whose numbers
        these are, as in files that do not say it.
    estimated
        names of fields out of ESTIMATES whose numbers are estimates, as of bearings known by their
        designation alone (`bearingcore.bearings.designation`). `replace` takes those off that it
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

    n_balls: int
    ball_diameter: float
    pitch_diameter: float
    contact_angle: float
    groove_center_radius: float
    groove_center_distance: float
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

    def __post_init__(self) -> None:
        def keep(name: str, value: float) -> None:
            object.__setattr__(self, name, value)

        keep("n_balls", checks.whole_number("n_balls", self.n_balls, at_least=1, at_most=500))
        for name in (
            "ball_diameter",
            "pitch_diameter",
            "groove_center_radius",
            "groove_center_distance",
            "load_deflection_factor",
            "outer_raceway_radius",
            "inner_raceway_radius",
        ):
            keep(name, checks.real_number(name, getattr(self, name), above=0.0))
        keep("density", checks.real_number("density", self.density, above=0.0, unit="kg/m³"))
        if self.dynamic_load_rating is not None:
            rating = checks.real_number(
                "dynamic_load_rating", self.dynamic_load_rating, above=0.0, unit="N"
            )
            keep("dynamic_load_rating", rating)
        keep("contact_angle", drawing.check_contact_angle(self.contact_angle))
        keep(
            "radial_clearance",
            checks.real_number("radial_clearance", self.radial_clearance, at_least=0.0, unit="m"),
        )
        for fault in drawing.faults(vars(self)):
            raise fault
        if self.is_drawn:
            for race in ("inner", "outer"):
                name = f"{race}_groove_radius"
                keep(name, drawing.check_groove(race, getattr(self, name), self.ball_diameter))
        for name in ("youngs_modulus", "poisson", *drawing.BALL_MATERIAL):
            held = getattr(self, name)
            if self.is_drawn and (held is not None or name not in drawing.BALL_MATERIAL):
                keep(name, drawing.check_material(name, held))
            elif held is not None:
                raise checks.refuse(name, held, "None, unless the bearing has groove radii")

        rows = self.rows if isinstance(self.rows, tuple | list) else (self.rows,)
        object.__setattr__(self, "rows", tuple(rows))
        if len(self.rows) > MOST_ROWS or not all(isinstance(row, Row) for row in self.rows):
            raise checks.refuse("rows", self.rows, f"at most {MOST_ROWS} of Row")
        if self.roller_length is not None:
            keep(
                "roller_length", checks.real_number("roller_length", self.roller_length, above=0.0)
            )
        object.__setattr__(self, "kind", _kind_of(self))
        for name in self.estimated:
            checks.choice("estimated", name, ESTIMATES)
        object.__setattr__(self, "estimated", tuple(self.estimated))
        self.kind.check(self)
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

    @classmethod
    def cylindrical(
        cls,
        n_rollers: int,
        roller_diameter: float,
        roller_length: float,
        pitch_diameter: float,
        radial_clearance: float = 0.0,
    ) -> Self:
        """A cylindrical roller bearing of steel, its line contacts as stiff as ISO 16281 has them.

        K = 35 948 l^(8/9) N/mm^(10/9), l [mm] the length of a roller, both contacts in series.
        Lengths in m. A roller does not tilt here and carries nothing along the shaft.

        Raises
        ------
        ValueError
            naming the field, its value and what is allowed.
        """
        return cls(
            **roller.fields(
                n_rollers, roller_diameter, roller_length, pitch_diameter, radial_clearance
            )
        )

    @classmethod
    def tapered(
        cls,
        n_rollers: int,
        roller_diameter: float,
        roller_length: float,
        pitch_diameter: float,
        contact_angle: float,
        radial_clearance: float = 0.0,
    ) -> Self:
        """One row of tapered rollers of steel; `paired` makes two of it.

        See `bearingcore.bearings.tapered` for what it leaves out. Diameters [m] are those of the
        middles of the rollers, the angle [rad] is that of the outer race.

        Raises
        ------
        ValueError
            naming the field, its value and what is allowed.
        """
        return cls(
            **tapered.fields(
                n_rollers,
                roller_diameter,
                roller_length,
                pitch_diameter,
                contact_angle,
                radial_clearance,
            )
        )

    @classmethod
    def self_aligning(
        cls,
        n_balls: int,
        ball_diameter: float,
        sphere_radius: float,
        inner_groove_radius: float,
        contact_angle: float,
        radial_clearance: float = 0.0,
        youngs_modulus: float = 210e9,
        poisson: float = 0.3,
    ) -> Self:
        """A self-aligning ball bearing: two rows in a spherical outer race about its centre.

        See `bearingcore.bearings.self_aligning` for what follows from these.

        Parameters
        ----------
        n_balls
            of each row.
        ball_diameter, sphere_radius, inner_groove_radius
            D_b, R_e and r_i [m].
        contact_angle
            α0 [rad] of both rows, above 0.
        radial_clearance
            r_L [m].
        youngs_modulus, poisson
            E [Pa] and ν; steel by default.

        Raises
        ------
        ValueError
            for a drawing that cannot be built.
        """
        return cls(
            **self_aligning.fields(
                n_balls,
                ball_diameter,
                sphere_radius,
                inner_groove_radius,
                contact_angle,
                radial_clearance,
                youngs_modulus,
                poisson,
            )
        )

    def paired(self, distance: float, arrangement: str, preload: float = 0.0) -> Self:
        """Two rows like this one, `distance` [m] apart on the shaft.

        `arrangement` is "back-to-back", "face-to-face" or "tandem"; `preload` [m] is how far the
        inner grooves are pushed along the shaft against each other.

        Raises
        ------
        ValueError
            for a bearing that has rows already, or without a contact angle for a preload.
        """
        if self.rows:
            raise checks.refuse("rows", len(self.rows), "none yet, where a bearing is paired")
        if preload > 0.0 and self.contact_angle == 0.0:
            raise checks.refuse("preload", preload, "0 m at a contact angle of 0")
        return self.replace(rows=pair(distance, arrangement, preload))

    def respaced(self, distance: float | None = None, preload: float | None = None) -> Self:
        """The pair with another distance of its rows, or another preload [m]; see `paired`.

        ValueError for a bearing that is no pair.
        """
        if not self.arrangement:
            raise checks.refuse("rows", len(self.all_rows), "two rows that form a pair")
        if preload is not None and preload > 0.0 and self.contact_angle == 0.0:
            raise checks.refuse("preload", preload, "0 m at a contact angle of 0")
        return self.replace(rows=spaced(self.rows, distance, preload))

    @property
    def row_distance(self) -> float | None:
        """Distance [m] of two rows along the shaft; None of another number of rows."""
        return self.rows[1].place - self.rows[0].place if len(self.rows) == 2 else None

    @property
    def pressure_centers_apart(self) -> float | None:
        """Distance [m] of the points in which the lines of contact of a pair meet the shaft.

        With it a pair resists tilt. None of a bearing that is no pair, or one in tandem.
        """
        if self.arrangement not in ("back-to-back", "face-to-face"):
            return None
        meets = [
            row.place - row.facing * 0.5 * own.pitch_diameter * math.tan(own.contact_angle)
            for row, own in ((row, self.of_row(k)) for k, row in enumerate(self.rows))
        ]
        return abs(meets[1] - meets[0])

    @property
    def preload(self) -> float | None:
        """Displacement [m] of the inner grooves of a pair against each other; None of any other."""
        if not self.arrangement:
            return None
        low, high = self.rows
        return abs(high.offset - low.offset)

    @property
    def all_rows(self) -> tuple[Row, ...]:
        """The rows, also where there is but one."""
        return self.rows or _ONE_ROW

    def of_row(self, row: int) -> Bearing:
        """The bearing with the numbers of a row and what follows from them, without rows.

        The bearing itself where all rows are alike.

        Raises
        ------
        ValueError
            for dimensions of the row that do not fit each other, or that nothing follows from as
            the bearing does not carry its drawing.
        """
        if self.rows_are_alike:
            return self
        try:
            return _with_own(self, tuple(self.unlike(self.rows[row]).items()))
        except FieldError as refused:
            raise refused.inside(f"row {row + 1}") from None

    @property
    def rows_are_alike(self) -> bool:
        """True where no row has balls or dimensions of its own; places and turns may differ."""
        return not any(row.own and self.unlike(row) for row in self.rows)

    def unlike(self, row: Row) -> dict[str, float]:
        """Numbers of a row that differ from the bearing's."""
        return {name: held for name, held in row.own.items() if held != getattr(self, name)}

    @property
    def unlike_rows(self) -> tuple[tuple[Bearing, slice], ...]:
        """The bearing of each row, see `of_row`, and the places of its balls among all of them.

        Rows that are alike are listed once: the bearing with all balls.
        """
        if self.rows_are_alike:
            return ((self, slice(0, self.total_balls)),)
        return tuple((self.of_row(k), own) for k, own in enumerate(self.balls_of_rows))

    @property
    def balls_of_rows(self) -> tuple[slice, ...]:
        """Places of the balls of each row among all of them: row after row."""
        ends = list(accumulate(row.n_balls or self.n_balls for row in self.all_rows))
        return tuple(slice(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True))

    def row_of_ball(self, ball: int) -> tuple[int, int]:
        """Row of a ball out of all of them, and its number in the row, both counted from 0."""
        for row, own in enumerate(self.balls_of_rows):
            if own.start <= ball < own.stop:
                return row, ball - own.start
        raise checks.refuse("ball", ball, f"0 to {self.total_balls - 1}")

    def pace(self, row: int) -> float:
        """Speed of a row's cage, over that of the bearing's own numbers."""
        own = self.of_row(row)
        return 1.0 if own._ratio == self._ratio else own.cage_ratio / self.cage_ratio

    @property
    def has_one_cage_speed(self) -> bool:
        """True where the cages of all rows turn at one speed."""
        return len({self.pace(k) for k in range(len(self.all_rows))}) == 1

    @property
    def period(self) -> float:
        """Cage angle [rad] after which balls are again where balls were.

        A ball spacing where all rows have as many balls; else what the spacings of the rows have in
        common. Cages that turn at speeds of their own come back at no angle: then a whole turn.
        """
        if not self.has_one_cage_speed:
            return 2.0 * math.pi
        counts = (row.n_balls or self.n_balls for row in self.all_rows)
        return 2.0 * math.pi / math.gcd(*counts) / self.pace(0)

    @property
    def contact_exponent(self) -> float:
        """Exponent of load over compression: 3/2 for balls, 10/9 for rollers (ISO 16281)."""
        return self.kind.exponent

    @property
    def is_flat(self) -> bool:
        """True where a radial load moves nothing out of the plane of the balls."""
        return self.contact_angle == 0.0 and all(
            row.place == 0.0 and not self.unlike(row) for row in self.all_rows
        )

    @classmethod
    def from_drawing(
        cls,
        n_balls: int,
        ball_diameter: float,
        pitch_diameter: float,
        inner_groove_radius: float,
        outer_groove_radius: float,
        contact_angle: float | None = None,
        diametral_clearance: float | None = None,
        youngs_modulus: float = 210e9,
        poisson: float = 0.3,
        groove_center_radius: float | None = None,
        ball_youngs_modulus: float | None = None,
        ball_poisson: float | None = None,
    ) -> Self:
        """A bearing from its dimensions: A0, r_d, K and the raceway radii follow.

        Parameters
        ----------
        n_balls
            N_b.
        ball_diameter, pitch_diameter
            D_b, D_p [m].
        inner_groove_radius, outer_groove_radius
            r_i, r_o [m], above D_b/2 and at most 0.6 D_b.
        contact_angle, diametral_clearance
            α0 [rad] and s [m], at least one of them, as they describe the same freedom.
            Clearance alone: a deep-groove bearing, α0 = 0 and r_L = s/2; `free_contact_angle` is
            the angle that it amounts to, `seated()` the same bearing given by that angle.
            Angle alone: r_L = 0; `diametral_play` is the clearance that it amounts to.
            Both, as Petersen, Howard & Prime (2014) have it: r_L = s/2 on top of the angle.
        youngs_modulus, poisson
            E [Pa] and ν of the rings; steel by default.
        groove_center_radius
            r_d [m]; None: D_p/2 + (r_i − D_b/2) cos α0.
        ball_youngs_modulus, ball_poisson
            E [Pa] and ν of the balls; None: as of the rings.

        Raises
        ------
        ValueError
            for a drawing that cannot be built, with the numbers.

        Examples
        --------
        >>> import math
        >>> bearing = Bearing.from_drawing(
        ...     9, 7.94e-3, 39.04e-3, 4.13e-3, 4.21e-3, diametral_clearance=10e-6
        ... )
        >>> round(math.degrees(bearing.free_contact_angle), 2)
        9.07
        """
        fields = drawing.fields(
            ball_diameter=ball_diameter,
            pitch_diameter=pitch_diameter,
            inner_groove_radius=inner_groove_radius,
            outer_groove_radius=outer_groove_radius,
            contact_angle=contact_angle,
            diametral_clearance=diametral_clearance,
            youngs_modulus=youngs_modulus,
            poisson=poisson,
            ball_youngs_modulus=ball_youngs_modulus,
            ball_poisson=ball_poisson,
        )
        if groove_center_radius is not None:
            fields["groove_center_radius"] = groove_center_radius
        return cls(n_balls=n_balls, **fields)

    def replace(self, **changes: Any) -> Self:
        """A bearing with fields changed. What follows from a drawing, or of rollers, follows.

        A derived field (A0, r_d, K, R_o, R_i) that was set apart from what the drawing gives keeps
        its proportion to it; one named in `changes` is taken as it is.
        """
        kept: dict[str, Any] = {
            "estimated": tuple(name for name in self.estimated if name not in changes)
        }
        changed = {name for name, value in changes.items() if getattr(self, name, None) != value}
        if changed - set(NOT_RATED):
            kept["dynamic_load_rating"] = None
        return cast(Self, self.kind.replaced(self, kept | changes))

    def with_balls_of(self, material: BallMaterial) -> Self:
        """The bearing with balls of a material and their density; ValueError without a drawing."""
        return self.replace(
            ball_youngs_modulus=material.youngs_modulus,
            ball_poisson=material.poisson,
            density=material.density,
        )

    @property
    def rating_unknown(self) -> str:
        """Words in which a load rating by ISO 281 is refused; empty where it is computed."""
        hybrid = "to be computed for balls of another material than the rings (ISO 20056)"
        return self.kind.rating_unknown or (hybrid if self.is_hybrid else "")

    @property
    def ball_material(self) -> str:
        """Name out of `BALL_MATERIALS` that the balls are of; empty where it is none of them.

        The density does not count: it may be set apart from the stiffness.
        """
        own = (self.ball_youngs_modulus, self.ball_poisson)
        if not self.is_hybrid:
            return "steel"
        return next((name for name, one in BALL_MATERIALS.items() if one[:2] == own), "")

    @property
    def is_hybrid(self) -> bool:
        """True where the balls are of another material than the rings."""
        own = (self.ball_youngs_modulus, self.ball_poisson)
        return any(
            one not in (None, ring)
            for one, ring in zip(own, (self.youngs_modulus, self.poisson), strict=True)
        )

    @property
    def is_drawn(self) -> bool:
        """True where the bearing carries its groove radii and material."""
        return any(getattr(self, name) is not None for name in drawing.OPTIONAL_FIELDS)

    @property
    def arrangement(self) -> str:
        """Arrangement of a pair, out of ARRANGEMENTS; empty of one row and of any other rows."""
        return self.kind.arrangement(self)

    @property
    def total_balls(self) -> int:
        """Balls or rollers of all rows."""
        return self.balls_of_rows[-1].stop

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
        checks.choice("race", race, ("outer", "inner"))
        return self.kind.race_contact(self, race)

    def groove_radius(self, race: str) -> float | None:
        """Radius [m] of a race across the rolling, "outer" or "inner"; None where not known.

        Of a self-aligning bearing R_e and r_i = A0 + D_b − R_e; rollers run in no groove.
        """
        return self.kind.groove_radius(self, checks.choice("race", race, ("outer", "inner")))

    @property
    def diametral_play(self) -> float:
        """Sideways play of the inner ring from contact to contact [m], grooves opposite.

        2 (A0 (1 − cos α0) + r_L): the clearance that a contact angle and a clearance on top of it
        amount to together.
        """
        # 1 − cos α0 without cancellation
        return (
            4.0 * self.groove_center_distance * math.sin(0.5 * self.contact_angle) ** 2
            + 2.0 * self.radial_clearance
        )

    @property
    def free_contact_angle(self) -> float:
        """Contact angle α_f [rad] of the bearing pushed along the shaft until the balls touch.

        cos α_f = cos α0 − r_L/A0. ValueError where the clearance lets the ring slip through.
        """
        cosine = math.cos(self.contact_angle) - self.radial_clearance / self.groove_center_distance
        if cosine < 0.0:
            most = self.groove_center_distance * math.cos(self.contact_angle)
            raise checks.refuse(
                "radial_clearance",
                self.radial_clearance,
                "at most {most:m}, or the ring slips through along the shaft",
                most=most,
            )
        # half-angle form: sharp where α_f is small
        return 2.0 * math.asin(math.sqrt(0.25 * self.diametral_play / self.groove_center_distance))

    def seated(self) -> Self:
        """The same bearing given by its free contact angle, without clearance on top.

        Its axial origin is where the balls touch, A0 (sin α_f − sin α0) further along z: at the
        same loads δz is smaller by that and all else is equal. Two things are not the same, as
        both depend on α0 and not on the angle under load: a defect lowers the ball along the
        unloaded line of contact, here at α_f; and the cage turns a little faster.
        """
        return dataclasses.replace(
            self, contact_angle=self.free_contact_angle, radial_clearance=0.0
        )

    @property
    def ball_radius(self) -> float:
        """Ball radius r_b [m]."""
        return 0.5 * self.ball_diameter

    @property
    def ball_mass(self) -> float:
        """Mass of a ball or roller [kg], of its density throughout."""
        return self.density * self.kind.volume(self)

    def centrifugal_load(self, shaft_speed: float) -> float:
        """Centrifugal load F_c = m ω_c² D_p/2 [N] of a ball on the pitch circle; speed in rad/s."""
        return self.ball_mass * self.cage_speed(shaft_speed) ** 2 * 0.5 * self.pitch_diameter

    @property
    def race_factors(self) -> tuple[float, float]:
        """Load-deflection factors [N/m^n] of a ball's contacts with the inner and outer race.

        Their ratio is that of Hertz's contacts where the drawing is known and 1 elsewhere, and in
        series they are `load_deflection_factor`: of both contacts alike each is 2^n of it, n being
        `contact_exponent`.
        """
        inner, outer = (
            (self.race_contact(race).load_deflection_factor for race in ("inner", "outer"))
            if self.groove_radius("inner") is not None
            else (1.0, 1.0)
        )
        n = self.contact_exponent
        scale = self.load_deflection_factor * (inner ** (-1.0 / n) + outer ** (-1.0 / n)) ** n
        return scale * inner, scale * outer

    @property
    def race_distances(self) -> tuple[float, float]:
        """Unloaded distances [m] of a ball's centre from the inner and outer groove's centre.

        r_i − D_b/2 and r_o − D_b/2, in proportion to make A0; halves of it without a drawing.
        """
        r_i, r_o = self.groove_radius("inner"), self.groove_radius("outer")
        inner, outer = 1.0, 1.0
        if r_i is not None and r_o is not None:
            inner, outer = r_i - self.ball_radius, r_o - self.ball_radius
        scale = self.groove_center_distance / (inner + outer)
        return scale * inner, scale * outer

    @property
    def ball_spacing(self) -> float:
        """Angle between neighbouring balls, 2π/N_b [rad] (Eq. 4).

        Of the rows that have no number of balls of their own: see `period`.
        """
        return 2.0 * math.pi / self.n_balls

    @cached_property
    def _ratio(self) -> float:
        """D_b cos α0 / D_p, the number that all kinematics depend on."""
        return self.ball_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def cage_ratio(self) -> float:
        """Cage speed over shaft speed, (1 − D_b cos α0 / D_p)/2 (Eq. 3).

        Of the bearing's own numbers, as all speeds and frequencies: those of a row that has numbers
        of its own are `of_row(k)`'s.
        """
        return 0.5 * (1.0 - self._ratio)

    def cage_speed(self, shaft_speed: float) -> float:
        """Cage speed ω_c [rad/s] at a shaft speed ω_s [rad/s] (Eq. 3)."""
        return self.cage_ratio * shaft_speed

    def ftf(self, shaft_speed: float) -> float:
        """Fundamental train (cage) frequency f_c [Hz] at a shaft speed [rad/s]."""
        return self.cage_speed(shaft_speed) / (2.0 * math.pi)

    def bpfo(self, shaft_speed: float) -> float:
        """Ball-pass frequency of the outer race, N_b f_c [Hz], shaft speed in rad/s (Eq. 5)."""
        return self.n_balls * self.ftf(shaft_speed)

    def bpfi(self, shaft_speed: float) -> float:
        """Ball-pass frequency of the inner race, N_b (f_s − f_c) [Hz], shaft speed in rad/s."""
        return self.n_balls * (shaft_speed / (2.0 * math.pi) - self.ftf(shaft_speed))

    def bsf(self, shaft_speed: float) -> float:
        """Ball spin frequency, f_s D_p/(2 D_b) (1 − (D_b cos α0/D_p)²) [Hz], speed in rad/s."""
        shaft_frequency = shaft_speed / (2.0 * math.pi)
        lever = self.pitch_diameter / (2.0 * self.ball_diameter)
        return lever * shaft_frequency * (1.0 - self._ratio**2)

    def frequency_spread(self, name: str) -> float:
        """Relative error of a frequency that 19 of 20 estimates stay below; 0 of no estimate.

        `name` is "bpfo", "bpfi", "ftf" or "bsf". It is what the estimated ratio of ball and pitch
        diameter may do: a number of balls that is estimated too may be one more or less, which
        moves BPFO and BPFI by a whole part in that number and is not in here. Of tapered rollers,
        whose number is less sure, it is.
        """
        checks.choice("name", name, ("bpfo", "bpfi", "ftf", "bsf"))
        ratio, counted = self.kind.estimate_spread or (inside.MEASURED.ratio_spread, 0)
        spread = 0.0
        if {"ball_diameter", "pitch_diameter"} & set(self.estimated):
            gamma = self._ratio
            part = {
                "bpfo": gamma / (1.0 - gamma),
                "ftf": gamma / (1.0 - gamma),
                "bpfi": gamma / (1.0 + gamma),
                "bsf": (1.0 + gamma**2) / (1.0 - gamma**2),
            }
            spread = ratio * part[name]
        if "n_balls" in self.estimated and name in ("bpfo", "bpfi"):
            spread += counted / self.n_balls
        return spread


@lru_cache(maxsize=256)
def _with_own(bearing: Bearing, own: tuple[tuple[str, float], ...]) -> Bearing:
    """The bearing without rows and with what one of them has of its own."""
    values: dict[str, Any] = dict(own)
    if not bearing.is_drawn:
        for name in LENGTHS:
            if name in values:
                raise checks.refuse(
                    f"{name} of a row", values[name], "None, unless the bearing has groove radii"
                )
    elif "ball_diameter" in values:
        larger = values["ball_diameter"] / bearing.ball_diameter
        for name in drawing.GROOVES:
            values.setdefault(name, larger * getattr(bearing, name))
    return bearing.replace(rows=()).replace(**values)


def recognized(bearing: Bearing) -> Kind:
    """The kind that recognizes the numbers of a bearing, as of files that do not name it."""
    return next(kind for kind in KINDS.values() if kind.recognizes(bearing))


def _kind_of(bearing: Bearing) -> Kind:
    """The kind that a bearing is made with, by itself or by its name."""
    given: object = bearing.kind
    if isinstance(given, Kind):
        return given
    return kind_named(given) if given else recognized(bearing)  # type: ignore[arg-type]
