"""From the dimensions on a drawing to the numbers of the contact model.

Quantity                                    | Symbol | Name                     | Unit
------------------------------------------- | ------ | ------------------------ | ----
groove radii                                | r_i, r_o | inner_, outer_groove_radius | m
groove radius over ball diameter            | f      | conformity               |
unloaded distance of the groove centres     | A0     | groove_center_distance   | m
radius on which inner groove centres lie    | r_d    | groove_center_radius     | m
unloaded, free contact angle                | α0, α_f | contact_angle, free_contact_angle | rad
radial clearance on top of α0               | r_L    | radial_clearance         | m

The contact angle and the clearance describe one freedom. With the rings concentric and their
grooves opposite each other, the groove centres are A0 cos α0 − r_L apart. Pushed along the shaft
until the balls touch, the inner ring moves them to the distance A0, at the free contact angle

    cos α_f = cos α0 − r_L / A0,

which for α0 = 0 and the diametral clearance s = 2 r_L is Harris's cos α_f = 1 − s/(2 A0). Pushed
sideways instead, it moves A0 (1 − cos α0) + r_L either way.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from bearingcore.bearings.hertz import in_series, race_contact
from bearingcore.common import checks
from bearingcore.errors import FieldError
from bearingcore.fields import WIDEST_CONFORMITY

GREATEST_CONTACT_ANGLE = math.radians(80.0)
"""Beyond this a bearing is a thrust bearing, for which the radial clearance loses its meaning."""

GROOVES = ("inner_groove_radius", "outer_groove_radius")
OPTIONAL_FIELDS = (*GROOVES, "youngs_modulus", "poisson")
"""Fields of a `Bearing` that only one with a drawing has."""

BALL_MATERIAL = ("ball_youngs_modulus", "ball_poisson")
"""Those that such a one may have: None where the balls are of the material of the rings."""

DIMENSIONS = ("ball_diameter", "pitch_diameter", "contact_angle", *OPTIONAL_FIELDS, *BALL_MATERIAL)
"""Fields of a `Bearing` that others are derived from."""


class Derived(NamedTuple):
    """Numbers that follow from a drawing, under the names of the fields of `Bearing`."""

    groove_center_radius: float
    groove_center_distance: float
    load_deflection_factor: float
    outer_raceway_radius: float
    inner_raceway_radius: float


def check_groove(race: str, radius: float | None, ball_diameter: float) -> float:
    """The groove radius [m] of a race as a float; ValueError where no ball runs in such a groove.

    It must pass freely around the ball, and guide it.
    """
    name = f"{race}_groove_radius"
    return checks.real_number(
        name,
        radius,  # type: ignore[arg-type]  # None is refused there
        above=0.5 * ball_diameter,
        at_most=WIDEST_CONFORMITY * ball_diameter,
        unit="m",
    )


def check_contact_angle(angle: float) -> float:
    """Unloaded contact angle [rad] as a float, else ValueError."""
    return checks.real_number(
        "contact_angle",
        angle,
        at_least=0.0,
        at_most=GREATEST_CONTACT_ANGLE,
        unit="rad",
        note="0 to 80 degrees",
    )


def check_material(name: str, value: float | None) -> float:
    """A Young's modulus [Pa] or a Poisson's ratio as a float, else ValueError."""
    if name.endswith("modulus"):
        return checks.real_number(name, value, above=0.0, unit="Pa")  # type: ignore[arg-type]  # None is refused there
    return checks.real_number(name, value, at_least=0.0, below=0.5)  # type: ignore[arg-type]


def faults(values: Mapping[str, float | None]) -> Iterator[FieldError]:
    """Each way in which dimensions do not fit together, as what a `Bearing` is refused with.

    `values` are in SI, by the names of the fields; what is None or not there is passed over. The
    `numbers` of a fault name the other fields that it is about.
    """
    ball, pitch, count = (values.get(n) for n in ("ball_diameter", "pitch_diameter", "n_balls"))
    if count is not None and count != int(count):
        yield checks.refuse("n_balls", count, "a whole number")
    if ball is not None and pitch is not None:
        if not 0.0 < ball < pitch:
            yield checks.refuse(
                "ball_diameter",
                ball,
                "above 0 and below the {pitch_diameter} of {pitch_diameter:m}",
                "m",
                pitch_diameter=pitch,
            )
        elif count is not None and count > 1 and pitch * math.sin(math.pi / count) < ball:
            most = math.floor(math.pi / math.asin(ball / pitch) + 1e-9)
            yield checks.refuse(
                "n_balls",
                count,
                "so few that balls of {ball_diameter:m} do not overlap on a circle of "
                f"{{pitch_diameter:m}}, here at most {most}",
                ball_diameter=ball,
                pitch_diameter=pitch,
            )
    for race in ("outer", "inner"):
        radius = values.get(f"{race}_groove_radius")
        if ball is not None and radius is not None:
            try:
                check_groove(race, radius, ball)
            except FieldError as fault:
                fault.numbers["ball_diameter"] = ball
                yield fault
    inner, outer = values.get("inner_raceway_radius"), values.get("outer_raceway_radius")
    if inner is not None and outer is not None and not inner < outer:
        yield checks.refuse(
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
    """A0, r_d, K and the raceway radii from the drawing (SI, rad).

    - A0 = r_i + r_o − D_b;
    - r_d = D_p/2 + (r_i − D_b/2) cos α0: a ball on the pitch circle touches the inner groove on
      the far side of its centre from the groove's (Harris, locus of the inner groove centres);
    - K of both Hertzian contacts in series, see `bearingcore.bearings.hertz`;
    - raceway radii D_p/2 ± D_b/2, at the bottom of the grooves. Left out: a quarter of the
      diametral play, some µm; and that balls which touch at α0 roll on a track that is
      (1 − cos α0) D_b/2 nearer to the pitch circle: at 40° an outer-race defect of a given angle
      is there 4 % shorter.
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
        load_deflection_factor=in_series(*factors),
        outer_raceway_radius=pitch_radius + r_b,
        inner_raceway_radius=pitch_radius - r_b,
    )


def check_clearance(
    diametral_clearance: float, contact_angle: float, groove_center_distance: float
) -> float:
    """The clearance [m] on top of a contact angle [rad], if the balls still lock the ring.

    ValueError where the ring would have to move so far along the shaft that the free contact angle
    passes GREATEST_CONTACT_ANGLE.
    """
    most = 2.0 * groove_center_distance
    most *= math.cos(contact_angle) - math.cos(GREATEST_CONTACT_ANGLE)
    return checks.real_number(
        "diametral_clearance",
        diametral_clearance,
        at_least=0.0,
        at_most=most,
        unit="m",
        note="more would need a free contact angle above "
        f"{math.degrees(GREATEST_CONTACT_ANGLE):.0f} degrees",
    )


def fields(
    *,
    ball_diameter: float,
    pitch_diameter: float,
    inner_groove_radius: float,
    outer_groove_radius: float,
    contact_angle: float | None,
    diametral_clearance: float | None,
    youngs_modulus: float,
    poisson: float,
    ball_youngs_modulus: float | None = None,
    ball_poisson: float | None = None,
) -> dict[str, Any]:
    """All fields of a `Bearing` but the number of balls; see `Bearing.from_drawing`."""
    D_b = checks.real_number("ball_diameter", ball_diameter, above=0.0, unit="m")
    if contact_angle is None and diametral_clearance is None:
        raise checks.refuse(
            "contact_angle", None, "a number [rad], unless diametral_clearance is given"
        )
    dimensions: dict[str, Any] = {
        "ball_diameter": D_b,
        "pitch_diameter": checks.real_number("pitch_diameter", pitch_diameter, above=D_b, unit="m"),
        "contact_angle": check_contact_angle(0.0 if contact_angle is None else contact_angle),
        "inner_groove_radius": check_groove("inner", inner_groove_radius, D_b),
        "outer_groove_radius": check_groove("outer", outer_groove_radius, D_b),
        "youngs_modulus": check_material("youngs_modulus", youngs_modulus),
        "poisson": check_material("poisson", poisson),
        "ball_youngs_modulus": ball_youngs_modulus,
        "ball_poisson": ball_poisson,
    }
    for name in BALL_MATERIAL:
        if dimensions[name] is not None:
            check_material(name, dimensions[name])
    derived = derive(**dimensions)
    s = 0.0 if diametral_clearance is None else diametral_clearance
    s = check_clearance(s, dimensions["contact_angle"], derived.groove_center_distance)
    return {**dimensions, **derived._asdict(), "radial_clearance": 0.5 * s}
