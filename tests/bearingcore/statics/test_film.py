"""Film thickness: the published formula by hand, its parts by geometry, and how it scales."""

import math

import pytest

from bearingcore import equilibrium, presets
from bearingcore.statics.film import (
    film,
    least_thickness,
    least_thickness_of_line,
    rolling_speed,
)

OIL = {"viscosity": 0.02, "pressure_viscosity": 2.0e-8}


def test_the_printed_formula() -> None:
    """U = 1e-11, G = 5000, W = 1e-6, k = 6: h/R_x = 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^-4.08).

    By logarithms: 0.68 · -25.3284 + 0.49 · 8.51719 + 0.073 · 13.81551 + ln 3.63 + ln 0.98309
    = -10.7692, so 2.1038e-5.
    """
    modulus, radius = 2.3e11, 5e-3
    h = least_thickness(
        speed=1e-11 * modulus * radius / 0.04,
        load=1e-6 * modulus * radius**2,
        radius=radius,
        ellipse_ratio=6.0,
        modulus=modulus,
        viscosity=0.04,
        pressure_viscosity=5000.0 / modulus,
    )
    assert h / radius == pytest.approx(2.1038e-5, rel=1e-4)


MAKE_LINE = {"speed": 10.0, "radius": 6.4e-3, "viscosity": 0.01, "pressure_viscosity": 2.2e-8}
"""A roller of 16 mm on an inner race of 64 mm [SI]."""
STEEL = 2.28e11
"""The modulus E' [Pa] that the textbook takes for steel on steel."""


@pytest.mark.parametrize("load", [3e4, 3e5, 1e6])
def test_the_printed_formula_of_lines(load: float) -> None:
    """For steel it is printed with units too: 1.806 (Q/l)^-0.128 (η0 u)^0.694 ξ^0.568 R_x^0.434.

    Hamrock, Schmid and Jacobson, Fundamentals of Fluid Film Lubrication, Eq. 18.73.
    """
    h = least_thickness_of_line(**MAKE_LINE, load_per_length=load, modulus=STEEL)
    speed, xi = 0.01 * 10.0, 2.2e-8
    printed = 1.806 * load**-0.128 * speed**0.694 * xi**0.568 * 6.4e-3**0.434
    assert h == pytest.approx(printed, rel=1e-3)


def test_rollers_have_a_film_by_the_load_on_their_length() -> None:
    scene = presets["nu208"]
    found = film(scene, **OIL)
    bearing = scene.bearing
    gamma = bearing.ball_diameter / bearing.pitch_diameter
    for race, side in ((found.inner, -1.0), (found.outer, 1.0)):
        assert math.isinf(race.ellipse_ratio)
        h = least_thickness_of_line(
            speed=found.rolling_speed,
            load_per_length=race.load / 11e-3,
            radius=5.5e-3 * (1.0 + side * gamma),
            modulus=210e9 / 0.91,
            viscosity=0.02,
            pressure_viscosity=2e-8,
        )
        assert race.thickness == pytest.approx(h, rel=1e-12)
    longer = film(scene.replace(roller_length=22e-3), **OIL).inner
    lighter = found.inner.load / (0.5 * longer.load)  # N on a metre, before over after
    assert longer.thickness / found.inner.thickness == pytest.approx(lighter**0.128, rel=1e-9)
    assert "roller" in found.sentence
    assert "ball" not in found.sentence


@pytest.mark.parametrize("name", ["6205", "7208-25deg"])
def test_rolling_speed_from_the_cage(name: str) -> None:
    """Seen from the cage both races move past the contact, with the surface speed of the ball."""
    scene = presets[name]
    bearing, shaft, cage = scene.bearing, scene.shaft_speed, scene.cage_speed
    reach = 0.5 * bearing.ball_diameter * math.cos(bearing.contact_angle)
    inner = (shaft - cage) * (0.5 * bearing.pitch_diameter - reach)
    outer = cage * (0.5 * bearing.pitch_diameter + reach)
    assert inner == pytest.approx(outer, rel=1e-12)
    assert rolling_speed(bearing, shaft) == pytest.approx(inner, rel=1e-12)


def test_roughness_of_both_surfaces() -> None:
    found = film(
        presets["6205"], **OIL, roughness_inner=0.3e-6, roughness_outer=0.0, roughness_ball=0.4e-6
    )
    assert found.inner.roughness == pytest.approx(0.5e-6)
    assert found.outer.roughness == pytest.approx(0.4e-6)
    assert found.inner.film_parameter == pytest.approx(found.inner.thickness / 0.5e-6)


@pytest.mark.parametrize("conformity", [0.53, 0.6])
def test_ellipses_reach_across_the_rolling(conformity: float) -> None:
    """As k = 1.0339 (R_y/R_x)^0.636, within 3 % (Brewe and Hamrock 1977); wide ones let oil out."""
    scene = presets["6205"]
    D = scene.bearing.ball_diameter
    grooves = {f"{race}_groove_radius": conformity * D for race in ("inner", "outer")}
    scene = scene.replace(bearing=scene.bearing.replace(**grooves))
    gamma = D / scene.bearing.pitch_diameter
    across = 1.0 / (2.0 / D - 1.0 / (conformity * D))
    found = film(scene, **OIL)
    for race, side in ((found.inner, -1.0), (found.outer, 1.0)):
        along = 0.5 * D * (1.0 + side * gamma)
        k = 1.0339 * (across / along) ** 0.636
        h = least_thickness(found.rolling_speed, race.load, along, k, 210e9 / 0.91, 0.02, 2e-8)
        assert race.ellipse_ratio == pytest.approx(k, rel=0.03)
        assert race.thickness == pytest.approx(h, rel=0.02)


def test_a_standing_shaft_has_no_film() -> None:
    found = film(presets["6205"].replace(shaft_speed=0.0), **OIL)
    assert found.inner.thickness == found.inner.film_parameter == 0.0
    assert "at rest" in found.sentence
    assert found.limit.crossed


@pytest.mark.parametrize(
    ("changes", "why"), [({"fy": 0.0}, "no ball is loaded"), ({"n_balls": 2}, "no cage angle")]
)
def test_no_known_load_no_film(changes: dict[str, float], why: str) -> None:
    """Two balls beside the load line carry nothing."""
    scene = presets["6205"].replace(**changes)
    found = film(scene, **OIL, state=equilibrium(scene, [0.0]))
    assert math.isnan(found.inner.thickness)
    assert math.isnan(found.outer.film_parameter)
    assert "not known" in found.sentence
    assert why in found.inner.sentence
    assert not found.limit.crossed


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ({"viscosity": 0.0}, "viscosity"),
        ({"pressure_viscosity": -1.0}, "pressure_viscosity"),
        ({"roughness_ball": math.nan}, "roughness_ball"),
        ({"roughness_ball": 0.0, "roughness_inner": 0.0}, "roughness_inner"),
    ],
)
def test_bad_input_is_named(changes: dict[str, float], name: str) -> None:
    with pytest.raises(ValueError, match=name):
        film(presets["6205"], **{**OIL, **changes})


def test_a_bearing_without_drawing_is_refused() -> None:
    with pytest.raises(ValueError, match="inner_groove_radius"):
        film(presets["fan-rig"], **OIL)
    with pytest.raises(ValueError, match="state"):
        film(presets["6205"], **OIL, state=equilibrium(presets["6206"]))
