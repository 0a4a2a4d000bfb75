"""Film thickness: roughness, ellipses, refusals; the formulas are held from outside."""

import math

import pytest

from bearingcore import equilibrium, presets
from bearingcore.model.statics import film

OIL = {"viscosity": 0.02, "pressure_viscosity": 2.0e-8}


def test_roughness_of_both_surfaces() -> None:
    oil_film = film(
        presets["6205"], **OIL, roughness_inner=0.3e-6, roughness_outer=0.0, roughness_ball=0.4e-6
    )
    assert oil_film.inner.roughness == pytest.approx(0.5e-6)
    assert oil_film.outer.roughness == pytest.approx(0.4e-6)
    assert oil_film.inner.film_parameter == pytest.approx(oil_film.inner.thickness / 0.5e-6)


def test_a_standing_shaft_has_no_film() -> None:
    oil_film = film(presets["6205"].replace(shaft_speed=0.0), **OIL)
    assert oil_film.inner.thickness == oil_film.inner.film_parameter == 0.0
    assert "at rest" in oil_film.sentence
    assert oil_film.limit.crossed


@pytest.mark.parametrize(
    ("changes", "why"), [({"fy": 0.0}, "no ball is loaded"), ({"n_balls": 2}, "no cage angle")]
)
def test_no_known_load_no_film(changes: dict[str, float], why: str) -> None:
    """Two balls beside the load line carry nothing."""
    scene = presets["6205"].replace(**changes)
    oil_film = film(scene, **OIL, state=equilibrium(scene, [0.0]))
    assert math.isnan(oil_film.inner.thickness)
    assert math.isnan(oil_film.outer.film_parameter)
    assert "not known" in oil_film.sentence
    assert why in oil_film.inner.sentence
    assert not oil_film.limit.crossed
