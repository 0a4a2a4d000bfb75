"""Film thickness: roughness, ellipses, refusals; the formulas are held from outside."""

import math

import pytest

from bearingcore import equilibrium, presets
from bearingcore.model.statics import film

OIL = {"viscosity": 0.02, "pressure_viscosity": 2.0e-8}


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
