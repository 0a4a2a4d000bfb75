"""Numbers of the contact model, derived from the dimensions on a drawing.

Quantity                                    | Symbol | Name                     | Unit
------------------------------------------- | ------ | ------------------------ | ----
groove radii                                | r_i, r_o | inner_, outer_groove_radius | m
groove radius over ball diameter            | f      | conformity               |
unloaded distance of the groove centres     | A0     | groove_center_distance   | m
radius on which inner groove centres lie    | r_d    | groove_center_radius     | m
unloaded, free contact angle                | α0, α_f | contact_angle, free_contact_angle | rad
radial clearance in addition to α0          | r_L    | radial_clearance         | m

The contact angle and the clearance describe one freedom. With the rings concentric and their
grooves opposite each other, the groove centres are A0 cos α0 − r_L apart. Pushed along the shaft
until the balls touch, the inner ring moves them to the distance A0, at the free contact angle

    cos α_f = cos α0 − r_L / A0,

which for α0 = 0 and the diametral clearance s = 2 r_L is Harris's cos α_f = 1 − s/(2 A0). Pushed
sideways instead, it moves A0 (1 − cos α0) + r_L either way.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from bearingcore.bearings._hertz import race_contact, series_factor
from bearingcore.common import _checks as checks
from bearingcore.fields import WIDEST_CONFORMITY

USUAL_GROOVES = {"inner": 0.52, "outer": 0.53}
"""Groove radii over the ball diameter by default: the widest with the full rating of ISO 281."""

GROOVES = ("inner_groove_radius", "outer_groove_radius")
OPTIONAL_FIELDS = (*GROOVES, "youngs_modulus", "poisson")
"""Fields of a `Bearing` that only one with a drawing has."""

BALL_MATERIAL = ("ball_youngs_modulus", "ball_poisson")
"""Fields that may be set with a drawing: None where balls and rings are of one material."""

DIMENSIONS = ("ball_diameter", "pitch_diameter", "contact_angle", *OPTIONAL_FIELDS, *BALL_MATERIAL)
"""Fields of a `Bearing` that others are derived from."""


class Derived(NamedTuple):
    """Numbers that follow from a drawing, under the names of the fields of `Bearing`."""

    groove_center_radius: float
    groove_center_distance: float | None
    load_deflection_factor: float
    outer_raceway_radius: float
    inner_raceway_radius: float


def check_groove(race: str, radius: float | None, ball_diameter: float) -> float:
    """Return the groove radius [m] of a race as a float; raise ValueError if no ball fits it.

    The groove must clear the ball and still guide it.
    """
    name = f"{race}_groove_radius"
    return checks.real_number(
        name,
        radius,  # type: ignore[arg-type]  # None is refused there
        above=0.5 * ball_diameter,
        at_most=WIDEST_CONFORMITY * ball_diameter,
        unit="m",
    )


def center_distance(distance: float | None) -> float:
    """Return A0 [m] as a float; raise ValueError without groove centres, as for rollers."""
    return checks.real_number("groove_center_distance", distance, above=0.0, unit="m")  # type: ignore[arg-type]


def checked(values: Mapping[str, Any]) -> dict[str, float]:
    """Return groove radii and materials of a `Bearing` as floats; {} for one without a drawing.

    ValueError for a wrong or missing number, or for a material of balls without groove radii.
    """
    if all(values[name] is None for name in OPTIONAL_FIELDS):
        for name in BALL_MATERIAL:
            if values[name] is not None:
                raise checks.refuse(name, values[name], "None, unless the bearing has groove radii")
        return {}
    numbers = {}
    for name in GROOVES:
        race = name.partition("_")[0]
        numbers[name] = check_groove(race, values[name], values["ball_diameter"])
    for name in ("youngs_modulus", "poisson", *BALL_MATERIAL):
        if values[name] is None and name in BALL_MATERIAL:
            continue
        limits: dict[str, Any] = {"at_least": 0.0, "below": 0.5}
        if name.endswith("modulus"):
            limits = {"above": 0.0, "unit": "Pa"}
        numbers[name] = checks.real_number(name, values[name], **limits)
    return numbers


def check_fit(values: Mapping[str, Any]) -> None:
    """Raise FieldError if dimensions of a `Bearing` [SI] do not fit together.

    Its `numbers` name the other fields of the conflict.
    """
    ball, pitch, count = (values[name] for name in ("ball_diameter", "pitch_diameter", "n_balls"))
    if count != int(count):
        raise checks.refuse("n_balls", count, "a whole number")
    if not 0.0 < ball < pitch:
        raise checks.refuse(
            "ball_diameter",
            ball,
            "above 0 and below the {pitch_diameter} of {pitch_diameter:m}",
            "m",
            pitch_diameter=pitch,
        )
    if count > 1 and pitch * math.sin(math.pi / count) < ball:
        most = math.floor(math.pi / math.asin(ball / pitch) + 1e-9)
        raise checks.refuse(
            "n_balls",
            count,
            "so few that balls of {ball_diameter:m} do not overlap on a circle of "
            f"{{pitch_diameter:m}}, here at most {most}",
            ball_diameter=ball,
            pitch_diameter=pitch,
        )
    inner, outer = values["inner_raceway_radius"], values["outer_raceway_radius"]
    if not inner < outer:
        raise checks.refuse(
            "inner_raceway_radius",
            inner,
            "below the {outer_raceway_radius} of {outer_raceway_radius:m}",
            "m",
            outer_raceway_radius=outer,
        )


def derive(
    *,
    ball_diameter: float,
    pitch_diameter: float,
    contact_angle: float,
    inner_groove_radius: float,
    outer_groove_radius: float,
    youngs_modulus: float,
    poisson: float,
    ball_youngs_modulus: float | None = None,
    ball_poisson: float | None = None,
) -> Derived:
    """Derive A0, r_d, K and the raceway radii from the drawing (SI, rad).

    - A0 = r_i + r_o − D_b;
    - r_d = D_p/2 + (r_i − D_b/2) cos α0, as the centre of a ball on the pitch circle is between its
      inner contact and the centre of the inner groove (Harris, locus of the groove centres);
    - K of both Hertzian contacts in series, see `bearingcore.bearings._hertz`;
    - raceway radii D_p/2 ± D_b/2, at the bottom of the grooves. This leaves out a quarter of the
      diametral play, some µm. It also leaves out that balls which touch at α0 roll on a track that
      is (1 − cos α0) D_b/2 nearer to the pitch circle: at 40° this makes an outer-race defect of a
      given angle 4 % shorter.
    """
    material = (youngs_modulus, poisson, ball_youngs_modulus, ball_poisson)
    factors = [
        race_contact(
            race, ball_diameter, pitch_diameter, radius, contact_angle, *material
        ).load_deflection_factor
        for race, radius in (("inner", inner_groove_radius), ("outer", outer_groove_radius))
    ]
    pitch_radius, r_b = 0.5 * pitch_diameter, 0.5 * ball_diameter
    return Derived(
        groove_center_radius=pitch_radius + (inner_groove_radius - r_b) * math.cos(contact_angle),
        groove_center_distance=inner_groove_radius + outer_groove_radius - ball_diameter,
        load_deflection_factor=series_factor(*factors),
        outer_raceway_radius=pitch_radius + r_b,
        inner_raceway_radius=pitch_radius - r_b,
    )
