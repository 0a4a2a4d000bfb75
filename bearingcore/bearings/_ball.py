"""One row of balls: deep groove, or angular contact where the contact angle is not 0."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

from bearingcore.bearings import _drawing as drawing
from bearingcore.bearings._hertz import RaceContact, race_contact
from bearingcore.bearings._kind import Kind, Picture, Variant
from bearingcore.bearings._kinematics import check_contact_angle
from bearingcore.bearings._material import BallMaterial
from bearingcore.common import _checks as checks

if TYPE_CHECKING:
    from bearingcore.bearings._bearing import Bearing

USUAL_GROOVES = {"inner": 0.52, "outer": 0.53}
"""Groove radii over the ball diameter where none are given: the widest that ISO 281 rates fully."""

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


def from_drawing(
    cls: type[Bearing],
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
) -> Bearing:
    """Make a bearing from its dimensions; A0, r_d, K and the raceway radii follow.

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
        the equivalent angle, `seated()` the same bearing given by that angle.
        Angle alone: r_L = 0; `diametral_play` is the equivalent clearance.
        Both, as in Petersen, Howard & Prime (2014): r_L = s/2 in addition to the angle.
        A negative clearance is an interference.
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
        "pitch_diameter": checks.real_number("pitch_diameter", pitch_diameter, above=D_b, unit="m"),
        "contact_angle": angle,
        "inner_groove_radius": inner_groove_radius,
        "outer_groove_radius": outer_groove_radius,
        "youngs_modulus": youngs_modulus,
        "poisson": poisson,
        "ball_youngs_modulus": ball_youngs_modulus,
        "ball_poisson": ball_poisson,
    }
    dimensions |= drawing.checked(dimensions)
    follows = drawing.derive(**dimensions)._asdict()
    s = 0.0 if diametral_clearance is None else diametral_clearance
    s = drawing.check_clearance(s, angle, D_b, follows["groove_center_distance"])
    if groove_center_radius is not None:
        follows["groove_center_radius"] = groove_center_radius
    return cls(n_balls=n_balls, **dimensions, **follows, radial_clearance=0.5 * s)


def drawn(bearing: Bearing) -> Bearing:
    """One row of steel balls with the dimensions of a bearing, in usual grooves.

    The inner groove is the bearing's own, where it has one.
    """
    ball = bearing.ball_diameter
    return bearing.from_drawing(
        bearing.n_balls,
        ball,
        bearing.pitch_diameter,
        bearing.groove_radius("inner") or USUAL_GROOVES["inner"] * ball,
        USUAL_GROOVES["outer"] * ball,
        contact_angle=bearing.contact_angle,
        diametral_clearance=2.0 * bearing.radial_clearance,
    )


def seated(self: Bearing) -> Bearing:
    """Return the same bearing given by its free contact angle, without a clearance.

    Its axial origin is where the balls touch, A0 (sin α_f − sin α0) further along z: at the
    same loads δz is smaller by that distance and all else is equal. Two results differ, as
    they depend on α0 and not on the angle under load: a defect lowers the ball along the
    unloaded line of contact, here at α_f; and the cage turns a little faster. Raises
    ValueError for an interference, which has no equivalent contact angle.
    """
    if self.diametral_play < 0.0:
        raise checks.refuse("radial_clearance", self.radial_clearance, "one that leaves play", "m")
    return dataclasses.replace(self, contact_angle=self.free_contact_angle, radial_clearance=0.0)


def with_balls_of(self: Bearing, material: BallMaterial) -> Bearing:
    """Return the bearing with balls of another material; ValueError without a drawing."""
    return self.replace(
        ball_youngs_modulus=material.youngs_modulus,
        ball_poisson=material.poisson,
        density=material.density,
    )


class Ball(Kind):
    """A row of balls in grooves, given by a drawing or by the numbers of its contacts."""

    name = "ball"
    element = "ball"
    variants: tuple[Variant, ...] = (
        Variant("single", "One row of balls", "Deep groove, or angular contact with an angle."),
    )
    picture = SECTION

    def recognizes(self, bearing: Bearing) -> bool:
        return bearing.roller_length is None and len(bearing.rows) < 2

    def check(self, bearing: Bearing) -> None:
        if len(bearing.rows) > 1:
            raise checks.refuse(
                "rows", len(bearing.rows), "one row where the kind is 'ball': see Bearing.replace"
            )
        self._check_balls(bearing)

    def _check_balls(self, bearing: Bearing) -> None:
        if bearing.roller_length is not None:
            raise checks.refuse(
                "roller_length", bearing.roller_length, "None of balls: see Bearing.cylindrical"
            )

    def nearest(self, bearing: Bearing, variant: str) -> Bearing:
        return bearing.replace(rows=()) if bearing.kind.has_drawing else drawn(bearing)

    def inputs(self, bearing: Bearing) -> tuple[str, ...]:
        if not bearing.is_drawn:
            return (*_ALWAYS, *drawing.Derived._fields)
        return (*_ALWAYS, *drawing.OPTIONAL_FIELDS, *drawing.BALL_MATERIAL)

    def facts(self, bearing: Bearing) -> tuple[str, ...]:
        drawn = ("groove_center_radius", "raceway_radii", "outer_conformity", "inner_conformity")
        return (
            *("free_contact_angle", "diametral_play"),
            *("load_deflection_factor", "groove_center_distance"),
            *(drawn if bearing.is_drawn else ()),
        )

    def derived(self, bearing: Bearing) -> drawing.Derived | None:
        if not bearing.is_drawn:
            return None
        dimensions: dict[str, Any] = {name: getattr(bearing, name) for name in drawing.DIMENSIONS}
        return drawing.derive(**dimensions)

    def race_contact(self, bearing: Bearing, race: str) -> RaceContact:
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

    def knows_contacts(self, bearing: Bearing) -> bool:
        return bearing.is_drawn

    def groove_radius(self, bearing: Bearing, race: str) -> float | None:
        radius: float | None = getattr(bearing, f"{race}_groove_radius")
        return radius


BALL = Ball()
