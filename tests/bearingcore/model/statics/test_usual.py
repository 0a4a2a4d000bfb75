"""Usual scenes: sound, at rest under their load, as hard as machines load their bearings."""

import math

import pytest

from bearingcore import equilibrium, life, limits, presets, scene_of

NAMES = ["6205", "61804", "6320", "7208 B", "7208 C", "7208 BECBP DB", "7208 DT", "2208", "NU 208",
         "30206", "32208", "30206 DB"]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_a_scene_of_a_number_is_usual_for_its_kind(name: str) -> None:
    scene = scene_of(name)
    assert not scene.defects
    assert scene.load.fy < 0.0
    mean_speed = scene.shaft_speed * 30.0 / math.pi * 1e3 * scene.bearing.pitch_diameter
    assert mean_speed == pytest.approx(150_000.0, rel=5e-3)
    rotor = scene.support
    assert rotor.inner_mass * 9.81 == pytest.approx(-scene.load.fy, rel=5e-3)
    state = equilibrium(scene)
    assert state.converged.all()
    rated = life(scene)
    assert rated.rating_source.startswith("of a catalogue")
    assert 10.0 < rated.dynamic_load_rating / rated.equivalent_load < 21.0
    assert 5e3 < rated.hours < 2e5
    assert [limit.name for limit in limits(scene, state) if limit.crossed] == []


def test_a_row_that_carries_thrust_one_way_has_enough_of_it() -> None:
    """1.3 times F_r tan α J_a/J_r, of rollers half of which carry 0.3090/0.2453 (Harris)."""
    for name, tandem in (("7208 B", 1), ("30206", 1), ("7208 DT", 2)):
        scene = scene_of(name)
        assert scene.load.fz > 0.0
        if name == "30206":
            induced = -scene.load.fy * math.tan(scene.bearing.contact_angle) * 0.3090 / 0.2453
            assert scene.load.fz == pytest.approx(1.3 * induced, rel=0.01)
        assert equilibrium(scene).loaded_balls.min() > 0.5 * scene.bearing.total_balls * tandem / 2


def test_a_bearing_without_a_rating_is_loaded_by_that_of_iso_281() -> None:
    bearing = presets["6205"].bearing
    assert scene_of(bearing).load.fy == pytest.approx(-14_000.0 / 15.0, rel=0.02)
    assert scene_of("6205 HC5").load.fy == pytest.approx(scene_of("6205").load.fy, rel=0.01)
    with pytest.raises(ValueError, match="dynamic_load_rating"):
        scene_of(presets["1208"].bearing)


def test_such_a_scene_takes_a_defect_as_any_other() -> None:
    damaged = scene_of("6205").replace(extent=0.1, depth=5e-5)
    assert life(damaged).share_of_healthy < 1.0
