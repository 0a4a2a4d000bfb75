"""Film thickness: the published formula by hand, its parts by geometry, and how it scales."""

from __future__ import annotations

import math

import pytest

from bearingcore import equilibrium, presets
from bearingcore.statics.film import (
    LUBRICATION,
    Film,
    film,
    least_thickness,
    rolling_radius,
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


@pytest.mark.parametrize("name", ["6205", "7208-40deg"])
def test_ellipse_ratio_beside_the_one_that_the_formula_was_fitted_with(name: str) -> None:
    """That is 1.03 (R_y/R_x)^0.64, a simplification within a few per cent of the exact ratio."""
    bearing = presets[name].bearing
    found = film(presets[name], **OIL)
    for race in (found.inner, found.outer):
        groove = getattr(bearing, f"{race.race}_groove_radius")
        R_y = 1.0 / (1.0 / bearing.ball_radius - 1.0 / groove)
        simple = 1.03 * (R_y / rolling_radius(bearing, race.race)) ** 0.64
        assert race.ellipse_ratio == pytest.approx(simple, rel=0.06)


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


def test_rolling_radius_from_the_curvatures() -> None:
    """Ball on the bottom of the race: 1/r_b + 1/R inside, 1/r_b − 1/R outside."""
    bearing = presets["6205"].bearing
    r, R = bearing.ball_radius, 0.5 * bearing.pitch_diameter
    assert rolling_radius(bearing, "inner") == pytest.approx(1.0 / (1.0 / r + 1.0 / (R - r)))
    assert rolling_radius(bearing, "outer") == pytest.approx(1.0 / (1.0 / r - 1.0 / (R + r)))


def test_how_it_scales() -> None:
    scene = presets["6205"]
    before = film(scene, **OIL).inner.thickness
    faster = film(scene.replace(shaft_speed=2.0 * scene.shaft_speed), **OIL).inner.thickness
    thicker = film(scene, viscosity=0.04, pressure_viscosity=2e-8).inner.thickness
    stiffer_oil = film(scene, viscosity=0.02, pressure_viscosity=4e-8).inner.thickness
    assert faster / before == pytest.approx(2.0**0.68)
    assert thicker / before == pytest.approx(2.0**0.68)
    assert stiffer_oil / before == pytest.approx(2.0**0.49)
    heavier = film(scene.replace(fy=-2000.0), **OIL).inner
    ratio = heavier.load / film(scene, **OIL).inner.load
    assert heavier.thickness / before == pytest.approx(ratio**-0.073)


def test_the_inner_race_has_the_thinner_film() -> None:
    """As it curves away from the ball."""
    for name in ("6205", "6206", "7208-25deg", "seven-ball"):
        found = film(presets[name], **OIL)
        assert found.inner.thickness < found.outer.thickness


@pytest.mark.parametrize(
    ("viscosity", "kind"), [(2e-3, LUBRICATION[0]), (3e-2, LUBRICATION[1]), (0.3, LUBRICATION[2])]
)
def test_kinds_of_lubrication(viscosity: float, kind: str) -> None:
    found = film(presets["6205"], viscosity=viscosity)
    assert found.inner.lubrication == kind
    assert kind in found.sentence
    assert "starvation" in found.sentence
    assert found.limits()[0].crossed == (found.inner.film_parameter < 1.0)


def test_roughness_of_both_surfaces() -> None:
    found = film(
        presets["6205"], **OIL, roughness_inner=0.3e-6, roughness_outer=0.0, roughness_ball=0.4e-6
    )
    assert found.inner.roughness == pytest.approx(0.5e-6)
    assert found.outer.roughness == pytest.approx(0.4e-6)
    assert found.inner.film_parameter == pytest.approx(found.inner.thickness / 0.5e-6)


def test_a_standing_shaft_has_no_film() -> None:
    found = film(presets["6205"].replace(shaft_speed=0.0), **OIL)
    assert found.inner.thickness == found.inner.film_parameter == 0.0
    assert "stands still" in found.sentence
    assert found.limits()[0].crossed


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
    assert not found.limits()[0].crossed


def test_table_repeats_the_result() -> None:
    found = film(presets["6205"], **OIL)
    assert isinstance(found, Film)
    table = found.table()
    for i, race in enumerate((found.inner, found.outer)):
        assert table["race"][i] == race.race
        assert table["film_thickness"][i] == race.thickness
        assert table["film_parameter"][i] == race.film_parameter
    assert table.unit("film_thickness") == "m"
    assert "film_thickness_um" in table.in_units().csv()


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
