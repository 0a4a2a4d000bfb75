"""Life against a commercial code's results, other sums, and what must not change it."""

import dataclasses
import math

import numpy as np
import pytest

from bearingcore import DOF_NAMES, Load, Scene, equilibrium, presets, scene_of
from bearingcore.model.scene import FREE_TILT_WORDS
from bearingcore.model.scene._scene import HELD_TILT_WORDS
from bearingcore.model.statics import dynamic_load_rating, life
from bearingcore.model.statics._race_loads import race_loads
from tests.outside.witness import witness

P, E = 3.0, 10.0 / 9.0
RATING = 23_400.0


def seven_balls(clearance: float, **load: float) -> Scene:
    """The bearing that the commercial code's results belong to; its diametral clearance in m."""
    scene = presets["seven-ball"].healthy().replace(radial_clearance=0.5 * clearance)
    return scene.replace(load=Load(**load), dofs="tilt free")


COMMERCIAL = [
    pytest.param(0.0, {"fx": 1000.0}, 13163.019, 7e-5, id="radial"),
    pytest.param(0.0, {"fz": 1000.0}, 2222.7318, 7e-5, id="axial"),
    pytest.param(10e-6, {"fx": 1000.0}, 10795.7948, 7e-5, id="radial, clearance"),
    pytest.param(10e-6, {"fz": 1000.0}, 3115.8781, 7e-5, id="axial, clearance"),
    pytest.param(10e-6, {"fx": 1000.0, "fz": 1000.0}, 1630.5367, 7e-5, id="combined"),
    pytest.param(
        10e-6, {"fx": 1000.0, "fz": 1000.0, "mx": 1.0}, 1627.7479, 7e-5, id="combined, moment"
    ),
    # a moment alone presses along no line, and 0.022 % is left
    pytest.param(0.0, {"mx": 1.0}, 785144.7521, 3e-4, id="moment"),
]


@witness(
    "ball bearing: life",
    "function: life",
    by="a commercial code's results (GitHub, minzhun/ISO16281, Test_BallBearing.py)",
    compared="L_10r under seven loads",
    within=0.0003,
)
@pytest.mark.parametrize(("clearance", "load", "printed", "tolerance"), COMMERCIAL)
def test_commercial_code(
    clearance: float, load: dict[str, float], printed: float, tolerance: float
) -> None:
    """Printed in GitHub, minzhun/ISO16281, `Test_BallBearing.py`: C_r 23,400 N."""
    rated = life(seven_balls(clearance, **load), RATING, positions="load line")
    assert rated.million_revolutions == pytest.approx(printed, rel=tolerance)
    assert rated.known


def test_defects_of_both_races_by_counting() -> None:
    """Q_ei and Q_ee by equal bins: every ball at every place of both races at every shaft angle."""
    scene = presets["6206"].replace(race="inner", extent=math.radians(20.0))
    (inner,) = scene.defects
    outer = dataclasses.replace(inner, race="outer", center=math.radians(260.0))
    places, balls, ratio = 48, scene.bearing.n_balls, scene.bearing.cage_ratio
    total = places * balls
    used = np.zeros((2, total))
    for k in range(0, total, 4):
        for i in range(places):
            cage = (i + 0.5) * 2.0 * math.pi / total
            turned = inner.center + k * 2.0 * math.pi / total - cage / ratio
            both = (dataclasses.replace(inner, center=turned), outer)
            Q = equilibrium(scene.replace(defect=both), [cage]).ball_load[0]
            at = i + places * np.arange(balls)
            used[0, (at - k) % total] += Q**P
            used[1, at] += Q**P
    expected = np.mean((used * 4.0 / total) ** E, axis=1) ** (1.0 / (P * E))
    loads = race_loads(scene.replace(defect=(inner, outer)), P, E)
    assert (loads.inner[0], loads.outer[0]) == pytest.approx(tuple(expected), rel=2e-3)


def test_hours() -> None:
    rated = life(presets["6206"], 19_500.0)
    assert rated.hours == pytest.approx(rated.million_revolutions * 1e6 / (1470.0 * 60.0))
    sound = life(presets["6206"].healthy(), 19_500.0)
    assert sound.million_revolutions == rated.healthy_million_revolutions, "the same cage angles"
    standing = life(presets["6206"].replace(shaft_speed=0.0), 19_500.0)
    assert math.isnan(standing.hours)
    assert standing.million_revolutions == rated.million_revolutions
    assert "the shaft is at rest" in standing.sentence


def test_a_heavy_load_is_beyond_the_standard() -> None:
    hard = life(presets["6205"].replace(fy=-9000.0), 14e3).sentence
    assert "above 50 % the standard's formula is not valid" in hard  # ISO 281
    assert "not valid" not in life(presets["6205"], 14e3).sentence


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_no_equilibrium_no_life(race: str) -> None:
    """Two balls let a ring go sideways: no cage angle but those under the load carries it."""
    scene = presets["6205"].replace(n_balls=2, race=race)
    for looked_at in (scene, scene.healthy()):
        rated = life(looked_at, 14e3)
        assert not rated.known
        assert math.isnan(rated.hours)
        assert math.isnan(rated.equivalent_load)
        assert math.isnan(rated.share_of_healthy)
        assert "not known" in rated.sentence


def test_no_load_no_fatigue() -> None:
    rated = life(presets["6205"].replace(fy=0.0), 14e3)
    assert math.isinf(rated.million_revolutions)
    assert rated.equivalent_load == 0.0
    assert rated.share_of_healthy == 1.0
    assert "there is no fatigue" in rated.sentence


def test_wider_grooves_carry_less_and_closer_ones_count_as_usual() -> None:
    usual = presets["6205"].bearing
    D = usual.ball_diameter
    rating = dynamic_load_rating(usual)
    assert dynamic_load_rating(usual.replace(inner_groove_radius=0.54 * D)) < 0.9 * rating
    assert dynamic_load_rating(usual.replace(inner_groove_radius=0.51 * D)) == rating


def test_a_self_aligning_bearing_has_no_rating_but_a_life() -> None:
    with pytest.raises(ValueError, match="maker's catalogue"):
        dynamic_load_rating(presets["1208"].bearing)
    assert life(presets["1208"], 20e3).known


def test_a_bearing_by_its_number_brings_its_rating() -> None:
    """C_r of a 6205 in JTEKT's catalogue is 14.0 kN; a changed bearing has none."""
    scene = presets["6205"].healthy().replace(bearing="6205")
    known = life(scene)
    assert known.dynamic_load_rating == 14_000.0
    assert known.million_revolutions == life(scene, 14_000.0).million_revolutions
    assert known.rating_source == "of a catalogue, by the bearing's number"
    assert known.sentence.endswith("14\u202f000 N, of a catalogue, by the bearing's number.")
    assert life(scene, 14_000.0).rating_source == "given"
    assert life(scene.replace(radial_clearance=2e-6)).dynamic_load_rating == 14_000.0
    for changed in (scene.replace(n_balls=8), presets["fan-rig"]):
        with pytest.raises(ValueError, match="dynamic_load_rating is None; allowed: a number"):
            life(changed)
    assert scene.bearing.replace(n_balls=9).dynamic_load_rating == 14_000.0


def test_a_life_says_whether_the_shaft_may_tilt_and_a_second_bearing_can_hold_it() -> None:
    scene = scene_of("6208").replace(fy=-2000.0, fz=1000.0)
    free = scene.replace(dofs="tilt free")
    assert scene.active_dofs == scene.replace(dofs="tilt held").active_dofs == ("x", "y", "z")
    assert free.active_dofs == scene.replace(mx=1.0).active_dofs == DOF_NAMES
    alone, on_two = life(free), life(scene)
    assert on_two.million_revolutions > 1.5 * alone.million_revolutions
    assert FREE_TILT_WORDS in alone.sentence
    assert HELD_TILT_WORDS in on_two.sentence
    state = equilibrium(free, [0.0], "tilt held")
    assert state.dofs == scene.active_dofs
    assert state.sentence == f"Free are x, y, z. {HELD_TILT_WORDS}"
    assert str(state).startswith("Equilibrium: Free are x, y, z.")
    assert equilibrium(scene, [0.0]).displacement[0, 3:].tolist() == [0.0, 0.0]
    radial = scene_of("6208")
    assert radial.tilt_words() == "", "the load causes no tilt"
    assert radial.replace(dofs="tilt held").active_dofs == ("x", "y")
    assert scene_of("NU 208").replace(dofs="tilt held").active_dofs == ("x", "y")
