"""Self-aligning ball bearings: two rows in a spherical outer race about the bearing's middle.

All outer groove centres are in the middle of the bearing. A0 = R_e + r_i − D_b is therefore the
distance of the inner ones from the middle, with r_d = A0 cos α0 and z_k = ± A0 sin α0. An inner
ring that tilts about the middle compresses no ball.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from bearingcore.bearings import _drawing as drawing
from bearingcore.bearings._hertz import RaceContact, race_contact, series_factor, spherical_contact
from bearingcore.bearings._in_rows import InRows
from bearingcore.bearings._kind import ISO_76_SELF_ALIGNING, Kind, Picture, Variant
from bearingcore.bearings._kinematics import check_contact_angle
from bearingcore.bearings._row import Row
from bearingcore.common import _checks as checks

POISSON = 0.3
"""Poisson's ratio of ball and rings; the modulus is the one that gives the factor K."""

ASSUMED_ANGLE = math.radians(10.0)
USUAL_GROOVE = 0.53
"""Contact angle [rad], and inner groove radius over ball diameter, of a new bearing."""

_DRAWN_BY = ("ball_diameter", "outer_raceway_radius", "inner_groove_radius", "contact_angle")
_DERIVED = (
    *("pitch_diameter", "groove_center_radius", "groove_center_distance"),
    *("inner_raceway_radius", "outer_groove_radius", "roller_length"),
)


def self_aligning_numbers(
    n_balls: int,
    ball_diameter: float,
    sphere_radius: float,
    inner_groove_radius: float,
    contact_angle: float,
    radial_clearance: float,
    youngs_modulus: float = 210e9,
    poisson: float = 0.3,
) -> dict[str, Any]:
    """Return the fields of a self-aligning bearing; see `Bearing.self_aligning`."""
    angle = check_contact_angle(contact_angle)
    checks.real_number("contact_angle", angle, above=0.0, unit="rad")
    diameter = checks.real_number("ball_diameter", ball_diameter, above=0.0, unit="m")
    sphere = checks.real_number("sphere_radius", sphere_radius, above=diameter, unit="m")
    drawing.check_groove("inner", inner_groove_radius, diameter)
    pitch = (2.0 * (sphere - 0.5 * diameter)) * math.cos(angle)
    distance = sphere + inner_groove_radius - diameter
    sizes = (diameter, pitch, sphere, inner_groove_radius, angle)
    place = distance * math.sin(angle)
    return {
        "kind": SELF_ALIGNING,
        "n_balls": n_balls,
        "ball_diameter": diameter,
        "pitch_diameter": pitch,
        "contact_angle": angle,
        "groove_center_radius": distance * math.cos(angle),
        "groove_center_distance": distance,
        "radial_clearance": radial_clearance,
        "load_deflection_factor": _factor(*_contacts(*sizes, youngs_modulus, poisson)),
        "outer_raceway_radius": sphere,
        "inner_raceway_radius": 0.5 * pitch - 0.5 * diameter * math.cos(angle),
        "rows": (Row(-place, -1), Row(place, 1)),
    }


def _contacts(
    ball: float,
    pitch: float,
    sphere: float,
    groove: float,
    angle: float,
    modulus: float,
    poisson: float,
) -> tuple[RaceContact, RaceContact]:
    """Return the contacts of a ball with the inner groove and with the sphere."""
    inner = race_contact("inner", ball, pitch, groove, angle, modulus, poisson)
    return inner, spherical_contact(ball, sphere, modulus, poisson)


def _factor(inner: RaceContact, outer: RaceContact) -> float:
    return series_factor(inner.load_deflection_factor, outer.load_deflection_factor)


def inner_groove(bearing: InRows) -> float:
    """Return the inner groove radius r_i = A0 + D_b − R_e [m]."""
    distance = bearing.groove_center_distance
    assert distance is not None  # `recognizes` has checked it
    return distance + bearing.ball_diameter - bearing.outer_raceway_radius


class SelfAligning(Kind):
    """Two equal rows of balls that run on one sphere about the middle of the bearing."""

    name = "self-aligning"
    element = "ball"
    variants = (
        Variant(
            "self-aligning",
            "Self-aligning, two rows",
            "Two rows on one spherical outer race: the inner ring tilts freely, so the shaft's "
            "other bearing holds it. Inputs are ball, sphere, inner groove and contact angle.",
        ),
    )
    picture = Picture(
        element="ball",
        outer="sphere",
        inner="groove",
        dimensions=(),
        notes=("a ball in its grooves, gaps drawn large",),
    )
    directions = needed_directions = ("x", "y", "z")
    carries = "the ring of a self-aligning bearing tilts freely and carries no moment"
    left_out = "the ring of a self-aligning bearing tilts freely"
    shoulders = ("inner",)
    rating_unknown = "computed for a self-aligning bearing"
    static_pressure = ISO_76_SELF_ALIGNING
    has_drawing = False

    def recognizes(self, bearing: InRows) -> bool:
        if len(bearing.rows) != 2 or bearing.contact_angle == 0.0 or bearing.is_drawn:
            return False
        if bearing.groove_center_distance is None or bearing.roller_length is not None:
            return False
        radius = bearing.groove_center_distance * math.cos(bearing.contact_angle)
        place = bearing.groove_center_distance * math.sin(bearing.contact_angle)
        return math.isclose(bearing.groove_center_radius, radius, rel_tol=1e-9) and all(
            not bearing.unlike(row) and math.isclose(row.place, row.facing * place, rel_tol=1e-9)
            for row in bearing.rows
        )

    def check(self, bearing: InRows) -> None:
        if not self.recognizes(bearing):
            raise checks.refuse(
                "rows",
                len(bearing.rows),
                "two rows on one sphere where the kind is 'self-aligning': see "
                "Bearing.self_aligning",
            )

    def inputs(self, bearing: InRows) -> tuple[str, ...]:
        return ("n_balls", *_DRAWN_BY, "radial_clearance", "density")

    def facts(self, bearing: InRows) -> tuple[str, ...]:
        return ("sphere_rows_apart", "load_deflection_factor", "groove_center_distance")

    def completed(self, bearing: InRows, changes: dict[str, Any]) -> dict[str, Any]:
        """Add the fields derived from the drawing if some of its dimensions change."""
        if "rows" in changes:
            return super().completed(bearing, changes)
        inputs = {name: value for name, value in changes.items() if name not in _DERIVED}
        for name in _DERIVED:
            value, old = changes.get(name), getattr(bearing, name)
            if value is not None and (old is None or not math.isclose(value, old, rel_tol=1e-9)):
                raise checks.refuse(
                    name, value, "the value by ball, sphere, groove and contact angle"
                )
        if not any(inputs.get(name) is not None for name in _DRAWN_BY):
            return inputs
        new = _numbers_with(bearing, inputs)
        # K may differ from the factor of the drawing: their ratio is kept
        ratio = bearing.load_deflection_factor
        ratio /= _numbers_with(bearing, {})["load_deflection_factor"]
        new["load_deflection_factor"] *= ratio
        new["rows"] = tuple(
            dataclasses.replace(row, place=fresh.place)
            for row, fresh in zip(bearing.rows, new["rows"], strict=True)
        )
        return new | {name: value for name, value in inputs.items() if name not in _DRAWN_BY}

    def race_contact(self, bearing: InRows, race: str) -> RaceContact:
        """Return a contact of a ball; the modulus is the one that gives K."""
        sizes = (
            bearing.ball_diameter,
            bearing.pitch_diameter,
            bearing.outer_raceway_radius,
            inner_groove(bearing),
            bearing.contact_angle,
        )
        modulus = bearing.load_deflection_factor / _factor(*_contacts(*sizes, 1.0, POISSON))
        inner, outer = _contacts(*sizes, modulus, POISSON)
        return inner if race == "inner" else outer

    def carries_thrust_one_way(self, bearing: InRows) -> bool:
        return False  # the two rows of one ring together carry thrust both ways

    def groove_radius(self, bearing: InRows, race: str) -> float:
        return inner_groove(bearing) if race == "inner" else bearing.outer_raceway_radius


def _numbers_with(bearing: InRows, fields: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of the bearing after some dimensions of its drawing have changed."""
    get = fields.get
    return self_aligning_numbers(
        n_balls=get("n_balls", bearing.n_balls),
        ball_diameter=get("ball_diameter", bearing.ball_diameter),
        sphere_radius=get("outer_raceway_radius", bearing.outer_raceway_radius),
        inner_groove_radius=get("inner_groove_radius") or inner_groove(bearing),
        contact_angle=get("contact_angle", bearing.contact_angle),
        radial_clearance=get("radial_clearance", bearing.radial_clearance),
    )


SELF_ALIGNING = SelfAligning()
