"""A bearing of one's own: dimensions, kinds, names, second units."""

import math

import pytest
from bearing_explorer.explorer.state.address import place_of, read, write
from bearing_explorer.explorer.state.bearing_kinds import hidden_of
from bearing_explorer.explorer.state.choice_list import KIND
from bearing_explorer.explorer.state.scene_editor import SceneEditor

from bearingcore import Bearing, Scene, equilibrium, presets
from bearingcore.bearings import Row

KINDS = KIND.names


@pytest.fixture
def editor() -> SceneEditor:
    return SceneEditor("6205")


def test_dimensions_that_do_not_fit_are_refused_and_those_that_do_are_taken(
    editor: SceneEditor,
) -> None:
    """The ball of a 209 is too large for a 6205 until the pitch circle is its own."""
    before = editor.scene
    refused, changed = editor.set({"ball_diameter_mm": "17.462"})
    assert changed == {}
    assert "at most" in refused["ball_diameter_mm"]
    assert (
        "pitch diameter of 39.04 mm"
        in editor.set({"ball_diameter_mm": "50"})[0]["ball_diameter_mm"]
    )
    assert editor.scene is before
    assert editor.set({"fy_n": "-1500"}) == ({}, {"fy_n": -1500.0})
    assert editor.set({"pitch_diameter_mm": "85"})[0] == {}
    refused, changed = editor.set({"ball_diameter_mm": "17.462"})
    assert refused == {}
    assert {"ball_diameter_mm", "inner_groove_radius_mm"} <= set(changed)
    assert editor.scene.bearing.ball_diameter == pytest.approx(17.462e-3)


@pytest.mark.parametrize("start", ["6205", "fan-rig", "7208-back-to-back", "1208", "nu208"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_can_be_made_of_every_bearing(start: str, kind: str) -> None:
    editor = SceneEditor(start)
    assert editor.choose({"kind": kind}) == {}
    scene = editor.scene
    assert scene.bearing.kind.variant(scene.bearing) == kind
    assert scene.bearing.n_balls == presets[start].bearing.n_balls
    assert scene.bearing.ball_diameter == presets[start].bearing.ball_diameter
    state = editor.state()
    assert state["choices"]["kind"] == kind
    assert ("row" in state["hidden"]) == (not scene.bearing.rows)
    assert ("roller_length_mm" in state["hidden"]) == (scene.bearing.roller_length is None)
    thrust = 500.0 if kind == "tapered" else scene.load.fz  # without it the cone leaves its cup
    answer = equilibrium(scene.replace(fy=-500.0, fz=thrust), [0.1])
    assert answer.converged.all(), answer.reason(0)
    place = read(write(place_of(editor)))
    assert place is not None
    assert place.scene == scene


def test_rollers_take_axial_loads_and_rows_of_defects_out_of_the_scene() -> None:
    editor = SceneEditor("7208-back-to-back")
    assert editor.scene.load.fz != 0.0
    editor.choose({"kind": "rollers"})
    assert editor.scene.load.fz == 0.0
    assert editor.scene.defects[0].row is None
    assert {"fz_n", "mx_nm", "my_nm", "contact_angle_deg"} <= set(hidden_of(editor.scene.bearing))
    editor.set({"roller_length_mm": 20.0})
    longer = editor.scene.bearing
    assert longer.load_deflection_factor == pytest.approx(
        Bearing.cylindrical(14, longer.ball_diameter, 20e-3, 60e-3).load_deflection_factor
    )


def test_the_second_row_of_a_pair_has_numbers_of_its_own() -> None:
    editor = SceneEditor("7208-back-to-back")
    assert math.isnan(editor.values["second_n_balls"]), "left open: as in the first row"
    assert not {name for name in hidden_of(editor.scene.bearing) if name.startswith("second_")}
    editor.set({"second_n_balls": "11", "second_ball_diameter_mm": "10"})
    editor.set({"second_contact_angle_deg": 40})
    own = editor.scene.bearing.rows[1].own
    assert own == {"n_balls": 11, "ball_diameter": 0.01, "contact_angle": math.radians(40.0)}
    assert editor.scene.bearing.of_row(1).inner_groove_radius == pytest.approx(5.2e-3)
    editor.set({"n_balls": 12, "row_distance_mm": 20.0})
    assert editor.scene.bearing.of_row(0).n_balls == 12
    assert editor.scene.bearing.of_row(1).n_balls == 11
    for name, value in (("n_balls", 11), ("contact_angle_deg", 40.0), ("contact_angle_deg", 25.0)):
        editor.set({name: value})  # past the second row's numbers and back
    assert editor.scene.bearing.rows[1].own == own
    editor.choose({"kind": "face-to-face"})
    assert editor.scene.bearing.rows[1].own == own
    assert "balls of 10 mm" in editor.set({"second_n_balls": "40"})[0]["second_n_balls"]
    editor.set({"second_n_balls": ""})
    editor.set({"second_ball_diameter_mm": "", "second_contact_angle_deg": ""})
    assert editor.scene.bearing.rows_are_alike
    direct = SceneEditor("7208-back-to-back")
    direct.choose({"numbers": "direct"})
    hidden = hidden_of(direct.scene.bearing)
    assert "second_ball_diameter_mm" in hidden
    assert "second_n_balls" not in hidden


def test_a_self_aligning_bearing_stays_one_when_it_is_changed() -> None:
    editor = SceneEditor("1208")
    before = editor.scene.bearing
    editor.set({"ball_diameter_mm": 9.0})
    editor.set({"outer_raceway_radius_mm": 35.0, "contact_angle_deg": 12.0})
    after = editor.scene.bearing
    assert after.kind.name == "self-aligning"
    assert after.groove_radius("inner") / after.ball_diameter == pytest.approx(
        before.groove_radius("inner") / before.ball_diameter
    )
    made = Bearing.self_aligning(
        16, 9e-3, 35e-3, after.groove_radius("inner"), math.radians(12.0), 5e-6
    )
    assert after.pitch_diameter == pytest.approx(made.pitch_diameter)
    assert after.load_deflection_factor == pytest.approx(made.load_deflection_factor)


def test_a_bearing_has_the_name_that_was_typed() -> None:
    editor = SceneEditor("6205")
    assert editor.name == "6205, deep groove bearing"
    editor.set({"n_balls": 8})
    assert editor.name == "6205, deep groove bearing, changed"
    assert "its sources no longer apply" in editor.note
    kept = editor.snapshot()
    editor.choose({"name": "  Pump \n 3, drive end "})
    assert editor.state()["bearing"]["own"] == "Pump 3, drive end"
    assert editor.snapshot() != kept, "a name can be undone"
    place = read(write(place_of(editor)))
    assert place is not None
    assert place.name == "Pump 3, drive end"
    other = SceneEditor("fan-rig")
    other.take_scene(place.scene, place.preset, name=place.name)
    assert other.name == "Pump 3, drive end"
    editor.choose({"preset": "6206"})
    assert editor.name == "6206, deep groove bearing"


def test_a_listed_bearing_that_is_changed_is_so_in_its_link_too() -> None:
    editor = SceneEditor("fan-rig")
    editor.take_bearing(presets["6205"].bearing, "6205 C3", "From a list.")
    for changes, name in (({}, "6205 C3"), ({"n_balls": 8}, "6205 C3, changed")):
        editor.set(changes)
        assert editor.name == name
        place = read(write(place_of(editor)))
        assert place is not None
        other = SceneEditor("fan-rig")
        other.take_scene(place.scene, place.preset, name=place.name)
        assert other.name == name


def test_second_units_are_the_first_times_a_factor() -> None:
    editor = SceneEditor("6205")
    units = editor.state()["second_units"]
    bearing, defect = editor.scene.bearing, editor.scene.defects[0]
    values = editor.values
    assert values["shaft_speed_hz"] * units["shaft_speed_hz"]["factor"] == pytest.approx(1797.0)
    on_race = defect.extent * bearing.outer_raceway_radius * 1e3
    assert values["extent_deg"] * units["extent_deg"]["factor"] == pytest.approx(on_race)
    editor.choose({"race": "inner"})
    shorter = editor.state()["second_units"]["extent_deg"]["factor"]
    assert shorter / units["extent_deg"]["factor"] == pytest.approx(
        bearing.inner_raceway_radius / bearing.outer_raceway_radius
    )


def test_more_rows_than_the_page_shows_are_refused() -> None:
    rows = (Row(-0.01), Row(), Row(0.01))
    bearing = presets["fan-rig"].bearing.replace(rows=rows)
    scene: Scene = presets["fan-rig"].replace(bearing=bearing)
    with pytest.raises(ValueError, match="number of rows is 3; allowed: at most 2 here"):
        SceneEditor("fan-rig").take_scene(scene)
