"""The bearing: the fields and methods that all kinds share."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import Any, Self

from bearingcore.bearings import _drawing as drawing
from bearingcore.bearings._contact import Contact
from bearingcore.bearings._hertz import RaceContact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._inside import RATIO_SPREAD
from bearingcore.bearings._kind import Kind
from bearingcore.bearings._kinds import kind_of
from bearingcore.bearings._kinematics import GREATEST_CONTACT_ANGLE, check_contact_angle
from bearingcore.bearings._line_contact import RollerContact
from bearingcore.bearings._material import BALL_MATERIALS, BallMaterial
from bearingcore.bearings._preload import ROW_CHANGES, change_rows, preload_force
from bearingcore.bearings._roller import ROLLER, roller_numbers
from bearingcore.bearings._row import pair
from bearingcore.bearings._self_aligning import self_aligning_numbers
from bearingcore.bearings._tapered import TAPERED
from bearingcore.common import _checks as checks

RATED = (
    *("n_balls", "ball_diameter", "pitch_diameter", "contact_angle", "roller_length"),
    *("inner_groove_radius", "outer_groove_radius", "groove_center_distance"),
    *("ball_youngs_modulus", "ball_poisson"),
)
"""Fields that C_r depends on, in addition to the rows and their own numbers."""


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
        distance A0 [m] between the groove centres of an unloaded ball (Eqs. 9, 10). None for
        rollers, whose line of contact is fixed; a number from an old file is dropped.
    radial_clearance
        r_L [m], in addition to the contact angle (Eq. 11); below 0 an interference fit, which
        compresses the elements by this amount without a load.
    load_deflection_factor
        K [N/m^1.5] of both contacts of a ball in series (Eq. 13).
    outer_raceway_radius, inner_raceway_radius
        radii R_o and R_i [m] at the bottom of the grooves; defects are cut there (Eq. 6).
    inner_groove_radius, outer_groove_radius, youngs_modulus, poisson
        r_i, r_o [m], E [Pa] and ν, all four of them, if the drawing is known: contact pressure
        needs them. `from_drawing` and `replace` derive K, A0, r_d, R_o and R_i from them.
    rows
        empty for one row at the middle of the bearing; else each `Row`. A row without its own
        number of balls or dimensions takes those of the bearing.
    roller_length
        [m] of cylindrical rollers, which replace balls: line contact, K in N/m^(10/9),
        radial directions only. None for balls.
    density
        of the balls [kg/m³]; 7800 for steel, 3200 for silicon nitride. Only balls with mass need
        it.
    ball_youngs_modulus, ball_poisson
        E [Pa] and ν of balls of another material than the rings, as in a hybrid bearing; see
        `with_balls_of`. None: balls have the `youngs_modulus` and `poisson` of the rings. Both need
        a drawing, because K given as a number already contains both materials.
    kind
        a `Kind` or its name, out of `bearingcore.bearings._kinds`. Empty: the kind follows from the
        other fields, as in files without it.
    estimated
        names of fields out of ESTIMATES whose numbers are estimates, as for bearings known by their
        designation (`bearingcore.bearings._designation`). `replace` removes a name when it sets
        the field.
    dynamic_load_rating
        C_r [N] of the whole bearing by a catalogue, as for bearings known by their designation;
        None if it is not known. `replace` removes it when a rated dimension changes.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.

    Source: Petersen, Howard & Prime (2014), Sections 2.1 and 2.3.
    """

    kind: Kind = field(default="")  # type: ignore[assignment]  # a name becomes its kind

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.keep(self, kind=kind_of(self))
        self.kind.check(self)
        if self.kind.line_contact:  # old scenes and links have a number here
            checks.keep(self, groove_center_distance=None)
        else:
            drawing.center_distance(self.groove_center_distance)
        for k in range(len(self.rows)):
            self.of_row(k)  # refuses dimensions that do not fit each other

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
        """Make a bearing from its dimensions, from which A0, r_d, K and raceway radii are derived.

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
            the equivalent angle.
            Angle alone: r_L = 0; `diametral_play` is the equivalent clearance.
            Both, as in Petersen, Howard & Prime (2014): r_L = s/2 in addition to the angle.
            Below 0 the clearance is an interference.
        youngs_modulus, poisson
            E [Pa] and ν of the rings; steel by default.
        groove_center_radius
            r_d [m]; None: D_p/2 + (r_i − D_b/2) cos α0.
        ball_youngs_modulus, ball_poisson
            E [Pa] and ν of the balls; None: those of the rings.

        Raises
        ------
        ValueError
            for a drawing that cannot be built, with the numbers.

        Examples
        --------
        >>> import math
        >>> from bearingcore import Bearing
        >>> bearing = Bearing.from_drawing(
        ...     9, 7.94e-3, 39.04e-3, 4.13e-3, 4.21e-3, diametral_clearance=10e-6
        ... )
        >>> round(math.degrees(bearing.free_contact_angle), 2)
        9.07
        """
        D_b = checks.real_number("ball_diameter", ball_diameter, above=0.0, unit="m")
        if contact_angle is None and diametral_clearance is None:
            raise checks.refuse(
                "contact_angle", None, "a number [rad], unless diametral_clearance is given"
            )
        angle = check_contact_angle(0.0 if contact_angle is None else contact_angle)
        dimensions: dict[str, Any] = {
            "ball_diameter": D_b,
            "pitch_diameter": checks.real_number(
                "pitch_diameter", pitch_diameter, above=D_b, unit="m"
            ),
            "contact_angle": angle,
            "inner_groove_radius": inner_groove_radius,
            "outer_groove_radius": outer_groove_radius,
            "youngs_modulus": youngs_modulus,
            "poisson": poisson,
            "ball_youngs_modulus": ball_youngs_modulus,
            "ball_poisson": ball_poisson,
        }
        dimensions |= drawing.checked(dimensions)
        derived = drawing.derive(**dimensions)._asdict()
        # s/(2 A0) at which the free contact angle is the greatest: above it the ring slips through
        most = math.cos(angle) - math.cos(GREATEST_CONTACT_ANGLE)
        s = checks.real_number(
            "diametral_clearance",
            0.0 if diametral_clearance is None else diametral_clearance,
            at_least=-D_b,
            at_most=2.0 * derived["groove_center_distance"] * most,
            unit="m",
            note="more would need a free contact angle above "
            f"{math.degrees(GREATEST_CONTACT_ANGLE):.0f} degrees",
        )
        if groove_center_radius is not None:
            derived["groove_center_radius"] = groove_center_radius
        return cls(n_balls=n_balls, **dimensions, **derived, radial_clearance=0.5 * s)

    @classmethod
    def cylindrical(
        cls,
        n_rollers: int,
        roller_diameter: float,
        roller_length: float,
        pitch_diameter: float,
        radial_clearance: float = 0.0,
    ) -> Self:
        """Make a cylindrical roller bearing of steel with the contact stiffness of ISO 16281.

        K = 35 948 l^(8/9) N/mm^(10/9), l [mm] the length of a roller, both contacts in series.
        Lengths in m. A roller does not tilt here and carries nothing along the shaft.

        Raises
        ------
        ValueError
            naming the field, its value and what is allowed.
        """
        sizes = (roller_diameter, roller_length, pitch_diameter)
        return cls(**roller_numbers(ROLLER, n_rollers, sizes, 0.0, radial_clearance))

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
        """Make one row of tapered rollers of steel; `Bearing.paired` makes a pair of it.

        Diameters [m] are those of the middles of the rollers, the angle [rad] is that of the outer
        race. `bearingcore.bearings._tapered` says what the model leaves out.

        Raises
        ------
        ValueError
            naming the field, its value and what is allowed.
        """
        sizes = (roller_diameter, roller_length, pitch_diameter)
        return cls(**roller_numbers(TAPERED, n_rollers, sizes, contact_angle, radial_clearance))

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
        """Make a self-aligning ball bearing: two rows in one spherical outer race.

        See `bearingcore.bearings._self_aligning` for the dimensions that are derived.

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
        sizes = (n_balls, ball_diameter, sphere_radius, inner_groove_radius, contact_angle)
        return cls(**self_aligning_numbers(*sizes, radial_clearance, youngs_modulus, poisson))

    def __repr__(self) -> str:
        """Return number, size, pitch diameter and rows of the elements in one line."""
        rows = f", {len(self.rows)} rows" if len(self.rows) > 1 else ""
        angle = f", {math.degrees(self.contact_angle):.4g}°" if self.contact_angle else ""
        return (
            f"<Bearing: {self.n_balls} {self.kind.elements} of {1e3 * self.ball_diameter:.4g} mm "
            f"on {1e3 * self.pitch_diameter:.4g} mm{angle}{rows}>"
        )

    @property
    def row_distance(self) -> float | None:
        """Distance [m] of two rows along the shaft; None for any other number of rows."""
        return self.rows[1].place - self.rows[0].place if len(self.rows) == 2 else None

    @property
    def preload(self) -> float | None:
        """Displacement [m] of a pair's inner grooves against each other; None without a pair.

        Below 0 it is an axial clearance between them.
        """
        if not self.arrangement:
            return None
        low, high = self.rows
        return (high.offset - low.offset) * high.facing

    @property
    def preload_force(self) -> float | None:
        """Axial force F0 [N] with which both rows of a pair press each other at rest, unloaded.

        0 where a clearance separates them. None without a pair, and for a pair in tandem.
        """
        return preload_force(self)

    @property
    def arrangement(self) -> str:
        """Arrangement of a pair, out of ARRANGEMENTS; empty without a pair."""
        return self.kind.arrangement(self)

    @property
    def contact(self) -> Contact:
        """The contact of each element by the bearing's own numbers; for a row see `of_row`."""
        return self.kind.contact(self)

    @property
    def is_flat(self) -> bool:
        """True if a radial load moves nothing out of the plane of the balls."""
        return self.contact_angle == 0.0 and all(
            row.place == 0.0 and not self.unlike(row) for row in self.all_rows
        )

    def replace(self, **changes: Any) -> Self:
        """Return the bearing with changed fields; derived fields follow.

        For two rows it also takes `row_distance` [m]; `preload` [m] or else `preload_force` [N];
        and the second row's own `second_n_balls`, `second_contact_angle`, `second_ball_diameter`
        and `second_pitch_diameter`.

        A derived field (A0, r_d, K, R_o, R_i) that differs from the value by the drawing keeps its
        ratio to that value; one that is named in `changes` is taken as it is.
        """
        row_changes = {name: changes.pop(name) for name in ROW_CHANGES if name in changes}
        if row_changes:
            new = self.replace(**changes)
            return new.replace(rows=change_rows(new, row_changes))
        kept = {"estimated": tuple(name for name in self.estimated if name not in changes)}
        changes = self.kind.completed(self, kept | changes)
        new = dataclasses.replace(self, **changes)
        before, after = self.kind.derived(self), new.kind.derived(new)
        if before is not None and after is not None:
            derived = {}
            for name in before._fields:
                value, old, now = getattr(self, name), getattr(before, name), getattr(after, name)
                if name not in changes and now != old:
                    derived[name] = now if value == old else value * (now / old)
            new = dataclasses.replace(new, **derived)
        if "dynamic_load_rating" in changes:
            return new
        rating = self.dynamic_load_rating if new.rated == self.rated else None
        return dataclasses.replace(new, dynamic_load_rating=rating)

    def paired(self, distance: float, arrangement: str, preload: float = 0.0) -> Self:
        """Return two rows like this one, `distance` [m] apart on the shaft.

        `arrangement` is "back-to-back", "face-to-face" or "tandem". `preload` [m] is the
        displacement of the inner grooves along the shaft against each other; below 0 it is a
        clearance between them. `replace(preload_force=...)` sets the preload by its force.

        Raises
        ------
        ValueError
            for a bearing that has rows already, or without a contact angle for a preload.
        """
        if self.rows:
            raise checks.refuse("rows", len(self.rows), "none: only a single row can be paired")
        return self.replace(rows=pair(distance, arrangement)).replace(preload=preload)

    @property
    def pressure_centers_apart(self) -> float | None:
        """Distance [m] between the points where the lines of contact of a pair meet the shaft.

        It is the lever with which a pair resists tilt. None without a pair, and for one in tandem.
        """
        if self.arrangement not in ("back-to-back", "face-to-face"):
            return None
        centers = [
            row.place - row.facing * 0.5 * single.pitch_diameter * math.tan(single.contact_angle)
            for row, single in ((row, self.of_row(k)) for k, row in enumerate(self.rows))
        ]
        return abs(centers[1] - centers[0])

    def with_balls_of(self, material: BallMaterial) -> Self:
        """Return the bearing with balls of a material; raise ValueError without a drawing."""
        return self.replace(
            ball_youngs_modulus=material.youngs_modulus,
            ball_poisson=material.poisson,
            density=material.density,
        )

    def frequency_spread(self, name: str) -> float:
        """Return the relative error of a frequency that 19 of 20 estimates stay below.

        `name` is "bpfo", "bpfi", "ftf" or "bsf". The error is that of the estimated ratio of ball
        and pitch diameter; it is 0 without an estimate. An estimated number of balls may also be
        wrong by one, which changes BPFO and BPFI by the fraction 1/n_balls. This is included for
        tapered rollers only, whose number is less sure.
        """
        checks.choice("name", name, ("bpfo", "bpfi", "ftf", "bsf"))
        ratio_error, count_error = self.kind.estimate_spread or (RATIO_SPREAD, 0)
        spread = 0.0
        if {"ball_diameter", "pitch_diameter"} & set(self.estimated):
            gamma = self.size_ratio
            sensitivity = {
                "bpfo": gamma / (1.0 - gamma),
                "ftf": gamma / (1.0 - gamma),
                "bpfi": gamma / (1.0 + gamma),
                "bsf": (1.0 + gamma**2) / (1.0 - gamma**2),
            }
            spread = ratio_error * sensitivity[name]
        if "n_balls" in self.estimated and name in ("bpfo", "bpfi"):
            spread += count_error / self.n_balls
        return spread

    @property
    def rated(self) -> tuple[object, ...]:
        """Numbers that C_r depends on: dimensions of the bearing and of each row.

        Clearance, preload, and the places and arrangement of rows are not among them: they shift
        loads only.
        """
        rows = tuple(tuple(self.unlike(row).items()) for row in self.all_rows)
        return tuple(getattr(self, name) for name in RATED), rows

    @property
    def ball_material(self) -> str:
        """Material of the balls, a name out of `BALL_MATERIALS`; empty for any other.

        The density does not matter: it may be set independently of the stiffness.
        """
        if not self.is_hybrid:
            return "steel"
        moduli = (self.ball_youngs_modulus, self.ball_poisson)
        named = (name for name, material in BALL_MATERIALS.items() if material[:2] == moduli)
        return next(named, "")

    @property
    def knows_contacts(self) -> bool:
        """True if `race_contact` has an answer."""
        return self.kind.knows_contacts(self)

    def race_contact(self, race: str) -> RaceContact | RollerContact:
        """Return the Hertzian contact of a ball or roller with a race, "outer" or "inner".

        Rollers are of steel. For a self-aligning bearing groove radius and modulus follow from its
        numbers, with a Poisson's ratio of 0.3. Raises ValueError for a bearing whose drawing is not
        known.
        """
        return self.kind.race_contact(self, checks.choice("race", race, ("outer", "inner")))

    def groove_radius(self, race: str) -> float | None:
        """Radius [m] of a race, "outer" or "inner", across the rolling direction; None if unknown.

        For a self-aligning bearing R_e and r_i = A0 + D_b − R_e; rollers have no groove.
        """
        return self.kind.groove_radius(self, checks.choice("race", race, ("outer", "inner")))

    @property
    def diametral_play(self) -> float:
        """Radial play of the inner ring from contact to contact [m], see `Contact.play`."""
        return self.contact.play(self.radial_clearance)

    @property
    def free_contact_angle(self) -> float:
        """Contact angle α_f [rad] of the ring pushed along the shaft, see `Contact.free_angle`."""
        return self.contact.free_angle(self.radial_clearance)

    @property
    def ball_mass(self) -> float:
        """Mass of a solid ball or roller [kg]."""
        return self.density * self.kind.volume(self)

    def centrifugal_load(self, shaft_speed: float) -> float:
        """Return the centrifugal load F_c = m ω_c² D_p/2 [N] of a ball; shaft speed in rad/s."""
        return self.ball_mass * self.cage_speed(shaft_speed) ** 2 * 0.5 * self.pitch_diameter

    @property
    def race_factors(self) -> tuple[float, float]:
        """Load-deflection factors [N/m^n] of contacts with inner and outer race, see `Kind`."""
        return self.kind.race_factors(self)
