"""Bearings by designation, and a workshop's own table."""

import math

import pytest
from bearing_explorer.explorer.state import address
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.kit.bearing_list import search_bearings

from bearingcore import catalogue, equilibrium, limits, scene_of


def test_a_published_bearing_is_put_into_the_scene() -> None:
    editor = SceneEditor("6205")
    assert editor.choose({"bearing": "209, Harris"}) == {}
    assert editor.scene.bearing == catalogue()["209, Harris"].bearing
    assert editor.name == "209, Harris"
    assert "Harris, Rolling Bearing Analysis" in editor.note
    editor.choose({"bearing": "6804RS, FEMTO-ST"})
    assert "Assumed here: an inner groove of 0.52 ball diameters" in editor.note


def matches(text: str) -> list[tuple[str, str]]:
    return [(bearing["label"], bearing["mark"]) for bearing in search_bearings(text)["entries"]]


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("6208", ("6208", "estimated")),
        ("6208-2RS/C3", ("6208-2RS/C3", "estimated")),
        ("7208 bep", ("7208 BEP", "estimated")),  # 40°, and the preset has 15°
        ("7208", ("7208", "estimated")),  # before presets that begin like it
        ("6205 C3", ("6205 C3", "estimated")),
        ("7208 pair", ("7208 pair, back to back (O)", "")),
        ("nu", ("NU 208, cylindrical rollers", "")),
        ("30206", ("30206", "estimated")),
        ("nj 208", ("NJ 208", "estimated")),
        ("nj 2", ("NJ204", "estimated")),
        ("32208", ("32208", "estimated")),
        ("320 08", ("32008", "estimated")),
        ("30308 face to face", ("30308 face to face", "estimated")),
        ("paderborn", ("6203, Paderborn", "")),
    ],
)
def test_one_search_finds_everything(text: str, first: tuple[str, str]) -> None:
    assert matches(text)[0] == first


def test_a_search_without_a_match_says_what_is_known() -> None:
    answer = search_bearings("22208")
    assert answer["entries"] == []
    assert "60, 62, 63" in answer["words"]
    assert "60, 62, 63" in SceneEditor("6205").choose({"bearing": "<script>"})["bearing"]


def test_every_entry_can_be_taken() -> None:
    for text in ("", "62", "nj 3", "12", "73", "323"):
        for bearing in search_bearings(text)["entries"]:
            assert SceneEditor("fan-rig").choose(bearing["choose"]) == {}


PARTS = ("load", "shaft_speed", "support")
"""Parts of a scene that come with a bearing, as its defect does."""


def test_a_bearing_by_number_comes_sound_and_keeps_what_a_person_set() -> None:
    editor = SceneEditor("liew-lim")
    editor.choose({"bearing": "6208"})
    assert editor.effects["preset"].startswith("The defect of 40° is gone.")
    for name in ("6205", "NU 208", "NJ 208", "7208 DT", "30206", "608"):
        editor.choose({"bearing": name})
        usual, scene = scene_of(name), editor.scene
        assert [getattr(scene, part) for part in PARTS] == [getattr(usual, part) for part in PARTS]
        assert scene.defects == ()
        assert scene.dofs is None
        said = editor.state()["effects"]["preset"]
        assert f"{-scene.load.fy:.0f} N down" in said
        assert ("no load along the shaft, which the flanges" in said) == (name == "NJ 208")
    editor.set({"fy_n": -500.0, "extent_deg": 4.0})
    editor.choose({"bearing": "6208"})
    assert editor.scene.load.fy == -500.0
    assert len(editor.scene.defects) == 1
    assert editor.scene.shaft_speed == scene_of("6208").shaft_speed
    assert "Kept as you set it: defect, load" in editor.state()["effects"]["preset"]
    kept = editor.snapshot()
    editor.take_preset("fan-rig")
    editor.restore(kept)
    editor.choose({"bearing": "6308"})
    assert editor.scene.load.fy == -500.0
    assert editor.scene.shaft_speed == scene_of("6308").shaft_speed


def test_a_row_or_tandem_with_a_contact_angle_gets_the_axial_load_that_it_needs() -> None:
    editor = SceneEditor("fan-rig")
    editor.set({"fy_n": -100.0 - 1e-9})
    editor.choose({"bearing": "7208 BEP"})
    assert editor.scene.load.fz == pytest.approx(
        2.0 * math.tan(math.radians(40.0)) * 100.0, rel=0.01
    )
    assert "168 N" in editor.state()["effects"]["preset"]
    assert equilibrium(editor.scene).converged.all()
    editor.choose({"bearing": "7308 BEP"})
    assert "Added" not in editor.state()["effects"]["preset"]  # there is an axial load by now
    tandem = SceneEditor("fan-rig")
    tandem.choose({"bearing": "7208 BECBP DT"})
    assert tandem.scene.bearing.arrangement == "tandem"
    assert tandem.scene.load.fz > 100.0
    assert equilibrium(tandem.scene).converged.all()


def test_an_estimated_bearing_says_so_wherever_its_name_is() -> None:
    editor = SceneEditor("fan-rig")
    editor.choose({"bearing": "6208-2RS/C3"})
    assert editor.name == "6208-2RS/C3 (inside estimated)"
    assert "Estimated" in editor.note
    link = address.write(address.place_of(editor))
    again = SceneEditor("6205")
    address.show_text(link, again)
    assert again.name == editor.name
    assert again.scene == editor.scene
    editor.choose({"kind": "back-to-back"})
    assert editor.scene.bearing.estimated
    assert any("inside dimensions" in limit.name for limit in limits(editor.scene))
    for name in ("n_balls", "ball_diameter_mm", "pitch_diameter_mm"):
        editor.set({name: editor.values[name] * 0.999 if name != "n_balls" else 8})
    assert editor.scene.bearing.estimated == ()
    assert "estimated" not in editor.name
    assert not any("inside dimensions" in limit.name for limit in limits(editor.scene))


def test_a_suffix_that_is_not_known_says_what_may_be_written() -> None:
    for name, words in (("2x7208", "DB (back to back)"), ("6308 E", "reinforced")):
        answer = search_bearings(name)
        assert answer["entries"] == []
        assert words in answer["words"]
        assert words in SceneEditor("6205").choose({"bearing": name})["bearing"]


def test_balls_of_another_material_are_chosen_and_kept_in_links() -> None:
    editor = SceneEditor("6205")
    steel = editor.scene
    assert editor.choose({"ball_material": "silicon nitride"}) == {}
    assert editor.state()["choices"]["ball_material"] == "silicon nitride"
    assert editor.scene.bearing.density == 3200.0
    again = SceneEditor("fan-rig")
    address.show_text(address.write(address.place_of(editor)), again)
    assert again.scene == editor.scene
    editor.set({"ball_youngs_modulus_gpa": 250.0})
    assert editor.state()["choices"]["ball_material"] == ""
    assert editor.choose({"ball_material": "steel"}) == {}
    assert editor.scene == steel
    editor.choose({"ball_material": "silicon nitride"})
    assert editor.choose({"numbers": "direct"}) == {}
    assert not editor.scene.bearing.is_hybrid
    assert "ball_material" in editor.state()["hidden"]
