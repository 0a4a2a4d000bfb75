"""What a person builds on the page and goes back from, what a link keeps, and what is refused."""

import math
from itertools import pairwise

import pytest
from bearing_explorer.explorer.state.bookmarks import (
    LONGEST_NAME,
    Bookmarks,
    name_of,
    open_request_of,
    read_request,
)
from bearing_explorer.explorer.state.history import History
from bearing_explorer.explorer.state.references import MOST_COMPARED
from bearing_explorer.explorer.state.scene_editor import MOST_DEFECTS, SceneEditor
from hypothesis import given, strategies as st

from bearingcore import RoughFloor, Scene, presets, read_floor


@pytest.fixture
def editor() -> SceneEditor:
    return SceneEditor("fan-rig")


@pytest.mark.parametrize("name", list(presets))
def test_a_preset_is_taken_as_it_is_and_one_number_moves_nothing_else(name: str) -> None:
    editor = SceneEditor(name)
    assert editor.scene == presets[name]
    assert not editor.changed
    refused, changed = editor.set({"outer_mass": 3.25})
    assert (refused, changed) == ({}, {"outer_mass": 3.25})
    assert editor.scene == presets[name].replace(outer_mass=3.25)


def test_a_drawing_gives_what_follows_from_it(editor: SceneEditor) -> None:
    assert editor.choose({"numbers": "drawing"}) == {}
    drawn = editor.scene.bearing
    assert drawn.is_drawn
    assert drawn.inner_groove_radius == pytest.approx(0.52 * drawn.ball_diameter)
    assert drawn.outer_groove_radius == pytest.approx(0.53 * drawn.ball_diameter)
    assert "0.52" in editor.state()["effects"]["numbers"]
    hidden = editor.state()["hidden"]
    assert "load_deflection_factor" in hidden
    assert "inner_groove_radius_mm" not in hidden
    refused, changed = editor.set({"inner_groove_radius_mm": 4.2})
    assert refused == {}
    assert editor.scene.bearing.groove_center_distance == pytest.approx(440e-6)
    assert editor.scene.bearing.load_deflection_factor < drawn.load_deflection_factor
    assert changed["groove_center_distance_um"] == pytest.approx(440.0)
    refused, _ = editor.set({"inner_groove_radius_mm": 3.9})
    assert "inner groove radius" in refused["inner_groove_radius_mm"]
    editor.choose({"numbers": "direct"})
    assert not editor.scene.bearing.is_drawn
    assert editor.scene.bearing.groove_center_distance == pytest.approx(440e-6)
    assert editor.state()["effects"] == {}


def test_the_note_on_a_bearing_belongs_to_the_scene_it_describes(editor: SceneEditor) -> None:
    def note() -> str:
        return editor.state()["effects"].get("preset", "")

    editor.choose({"bearing": "NU 208"})
    assert "3710 N down" in note()
    roller = editor.snapshot()
    editor.choose({"bearing": "6205"})
    assert "933 N down" in note()
    ball = editor.snapshot()
    editor.restore(roller)
    assert "3710 N down" in note()
    editor.restore(ball)
    assert "933 N down" in note()
    editor.set({"fy_n": -500.0})
    assert note() == ""
    editor.take_preset("fan-rig")
    assert note() == ""


def test_grooves_go_with_their_ball() -> None:
    editor = SceneEditor("6205")
    before = editor.scene.bearing
    refused, changed = editor.set({"ball_diameter_mm": 9.0})
    after = editor.scene.bearing
    assert refused == {}
    for race in ("inner", "outer"):
        name = f"{race}_groove_radius"
        assert getattr(after, name) / after.ball_diameter == pytest.approx(
            getattr(before, name) / before.ball_diameter
        )
        assert changed[f"{name}_mm"] == pytest.approx(1e3 * getattr(after, name))
        limit = editor.limits[f"{name}_mm"]
        assert limit.least < 1e3 * getattr(after, name) < limit.most


def test_what_is_typed_past_a_slider_stretches_it(editor: SceneEditor) -> None:
    assert editor.set({"extent_deg": "300"})[0] == {}
    assert editor.limits["extent_deg"].most == 360.0
    assert "out of range" in editor.set({"extent_deg": "400"})[0]["extent_deg"]
    assert editor.scene.defect.extent == pytest.approx(math.radians(300.0))
    editor.set({"fy_n": "-100000"})
    assert editor.limits["fy_n"].least <= -100000


@pytest.mark.parametrize(
    ("name", "text", "second", "wanted"),
    [
        ("extent_deg", "20", False, 20.0),
        ("extent_deg", "1/4 in", False, math.degrees(6.35e-3 / 26.5e-3)),
        ("extent_deg", "6,35", True, math.degrees(6.35e-3 / 26.5e-3)),
        ("extent_deg", "1/4 in", True, math.degrees(6.35e-3 / 26.5e-3)),
        ("extent_deg", "20 °", True, 20.0),
        ("radial_clearance_um", "30 µm", False, 30.0),
        ("radial_clearance_um", "30 µm", True, 15.0),  # a diametral one
        ("shaft_speed_hz", "900 rpm", False, 15.0),
        ("shaft_speed_hz", "900", True, 15.0),
        ("shaft_speed_hz", "15 Hz", True, 15.0),
    ],
)
def test_a_number_names_either_unit_in_either_box(
    editor: SceneEditor, name: str, text: str, second: bool, wanted: float
) -> None:
    refused, _ = editor.set(editor.read_units({name: text}, second))
    assert refused == {}
    assert editor.values[name] == pytest.approx(wanted, rel=1e-9)


def test_what_is_a_number_in_neither_unit_is_refused(editor: SceneEditor) -> None:
    for text in ("a lot", "5 N", ""):
        numbers = editor.read_units({"extent_deg": text}, second=True)
        assert numbers == {"extent_deg": text}
        assert "from 0 to 360°" in editor.set(numbers)[0]["extent_deg"]


def test_an_optional_number_may_be_left_open(editor: SceneEditor) -> None:
    assert editor.state()["values"]["contact_damping"] is None
    editor.set({"contact_damping": "250"})
    assert editor.scene.contact_damping == 250.0
    refused, _ = editor.set({"contact_damping": ""})
    assert refused == {}
    assert editor.scene.contact_damping is None
    refused, _ = editor.set({"stiffness_x": ""})
    assert "missing" in refused["stiffness_x"]


def test_defects_are_added_chosen_moved_and_removed(editor: SceneEditor) -> None:
    first = editor.scene.defect
    assert editor.choose({"defect": "add"}) == {}
    assert editor.selected == 1
    assert editor.scene.defects[0] == first
    assert editor.scene.defects[1].center == pytest.approx(math.pi / 2)  # opposite the first
    editor.choose({"race": "inner"})
    editor.set({"extent_deg": 20, "center_deg": 45})
    assert [d.race for d in editor.scene.defects] == ["outer", "inner"]
    assert editor.scene.defects[0] == first
    assert editor.scene.defects[1].extent == pytest.approx(math.radians(20))
    editor.choose({"defect": "0"})
    assert editor.values["extent_deg"] == pytest.approx(12.9)
    assert editor.state()["choices"]["race"] == "outer"
    assert editor.state()["defects"]["names"] == ["outer race at 270°", "inner race at 45°"]
    editor.choose({"defect": "remove"})
    assert len(editor.scene.defects) == 1
    assert editor.scene.defect.race == "inner"
    editor.choose({"defect": "remove"})
    assert len(editor.defects) == 1, "the last one stays: its sliders do"


def test_the_list_of_defects_ends_and_a_race_can_be_full(editor: SceneEditor) -> None:
    for _ in range(MOST_DEFECTS - 1):
        assert editor.choose({"defect": "add"}) == {}
    assert len(editor.scene.defects) == MOST_DEFECTS
    assert "the most there can be" in editor.choose({"defect": "add"})["defect"]
    edges = sorted((d.center - 0.5 * d.extent, d.center + 0.5 * d.extent) for d in editor.defects)
    assert all(end < start for (_, end), (start, _) in pairwise(edges))
    full = SceneEditor("fan-rig")
    full.set({"extent_deg": 360})
    assert "no room" in full.choose({"defect": "add"})["defect"]


def test_defects_that_run_together_keep_to_what_the_core_allows(editor: SceneEditor) -> None:
    editor.choose({"defect": "add"})
    editor.choose({"floor": "rough"})
    before = editor.scene
    refused, _ = editor.set({"center_deg": 268})
    assert "flat floors where defects touch" in refused["center_deg"]
    assert editor.scene == before
    editor.choose({"floor": "flat"})
    assert editor.set({"center_deg": 262})[0] == {}
    editor.choose({"edge": "exact"})
    assert {d.edge for d in editor.scene.defects} == {"exact"}


def test_a_rough_floor_is_the_same_surface_for_the_same_seed(editor: SceneEditor) -> None:
    refused, _ = editor.set({"rms_height_um": 7.0})
    assert "flat" in refused["rms_height_um"], "a flat floor has no roughness"
    editor.choose({"floor": "rough"})
    editor.set({"rms_height_um": 7.0, "correlation_length_um": 150, "seed": 3})
    assert editor.scene.defect.floor == RoughFloor(7e-6, 150e-6, 3)
    assert "seed" not in editor.state()["hidden"]
    assert "whole number" in editor.set({"seed": 2.5})[0]["seed"]
    editor.choose({"floor": "rough"})
    assert editor.scene.defect.floor == RoughFloor(7e-6, 150e-6, 3), "it is so already"
    editor.choose({"floor": "flat"})
    assert editor.scene == presets["fan-rig"]


def test_a_measured_floor_stays_as_the_scene_brought_it(editor: SceneEditor) -> None:
    assert "read_floor" in editor.choose({"floor": "measured"})["floor"]
    floor, extent, depth, _ = read_floor("250 0\n265 60\n280 0\n")
    scene = presets["fan-rig"].replace(floor=floor, extent=extent, depth=depth)
    editor.take_scene(scene, "fan-rig")
    assert editor.state()["choices"]["floor"] == "measured"
    assert editor.choose({"floor": "measured"}) == {}
    assert editor.scene.defect.floor == floor
    assert editor.choose({"floor": "flat"}) == {}
    assert editor.scene.defect.floor is None


@pytest.fixture
def bookmarks(editor: SceneEditor) -> Bookmarks:
    return Bookmarks(editor)


def test_presets_editors_and_floors_are_undone(editor: SceneEditor, bookmarks: Bookmarks) -> None:
    seen = [editor.snapshot()]

    def note(message: dict) -> None:
        bookmarks.follow(message)
        seen.append(editor.snapshot())
        assert seen[-1] != seen[-2]

    editor.choose({"floor": "rough"})
    note({"choose": {"floor": "rough"}})
    editor.set({"rms_height_um": 7})
    note({"typed": {"rms_height_um": 7}})
    editor.choose({"defect": "add"})
    note({"choose": {"defect": "add"}})
    editor.choose({"numbers": "drawing"})
    note({"choose": {"numbers": "drawing"}})
    editor.choose({"preset": "6205"})
    note({"choose": {"preset": "6205"}})
    for kept in seen[-2::-1]:
        assert bookmarks.go({"undo": True})
        assert editor.snapshot() == kept
        assert editor.values == kept.values
    for kept in seen[1:]:
        assert bookmarks.go({"redo": True})
        assert editor.snapshot() == kept
    assert not bookmarks.go({"redo": True})


def test_looking_at_another_defect_is_no_step(editor: SceneEditor, bookmarks: Bookmarks) -> None:
    editor.choose({"defect": "add"})
    bookmarks.follow({"choose": {"defect": "add"}})
    editor.choose({"defect": "0"})
    bookmarks.follow({"choose": {"defect": "0"}})
    bookmarks.go({"undo": True})
    assert len(editor.defects) == 1


def test_scenes_that_are_compared_are_a_step_too(bookmarks: Bookmarks) -> None:
    for message in ({"compare_here": "a"}, {"compare_here": "b"}, {"number": 0, "remove": True}):
        bookmarks.change_compared(message)
        bookmarks.follow(message)
    for way, names in (("undo", "ab"), ("undo", "a"), ("undo", ""), ("redo", "a")):
        assert bookmarks.go({way: True})
        assert "".join(reference.name for reference in bookmarks.compared) == names


def test_no_more_scenes_are_compared_than_there_are_colours(bookmarks: Bookmarks) -> None:
    for _ in range(MOST_COMPARED + 1):
        bookmarks.change_compared({"compare_here": ""})
    assert len(bookmarks.compared) == MOST_COMPARED
    assert "remove one first" in bookmarks.state()["said"]["words"]


def test_a_link_holds_the_compared_scenes(editor: SceneEditor, bookmarks: Bookmarks) -> None:
    bookmarks.change_compared({"compare_here": "as it was & is"})
    editor.take_preset("liew-lim")
    editor.choose({"defect": "add"})
    editor.set({"extent_deg": 40.1})
    bookmarks.change_compared({"compare_here": ""})
    editor.choose({"floor": "rough"})
    bookmarks.change_compared({"compare_here": ""})
    address = bookmarks.state()["address"]
    assert address.endswith("&tab=overview") or "&tab=overview&" in address
    again = Bookmarks(other := SceneEditor("fan-rig"), address)
    assert again.compared == bookmarks.compared
    assert other.scene == editor.scene
    assert again.state()["address"] == address


@pytest.mark.parametrize(
    "address",
    [
        "compare5.extent_deg=1",
        "compare1.tab=load",
        "compare1.compare2.extent_deg=1",
        "compare1.v=1",
    ],
)
def test_what_compares_nothing_is_passed_over(editor: SceneEditor, address: str) -> None:
    bookmarks = Bookmarks(editor, f"v=1&preset=6205&{address}")
    assert bookmarks.compared == ()
    assert "ignored" in bookmarks.state()["said"]["words"]


def test_a_file_is_the_scene_and_a_bad_one_a_sentence(
    editor: SceneEditor, bookmarks: Bookmarks
) -> None:
    file = bookmarks.toml()
    assert Scene.from_toml(file["text"]) == editor.scene
    for text, words in (
        (presets["6205"].to_toml(), "is open"),
        ("nonsense [", "allowed: TOML"),
        ("version = 7", "version"),
        ('[bearing]\nn_balls = "many"', "bearing"),
        (file["text"].replace("n_balls = 14", "n_balls = 1000000000"), "number of balls"),
        (presets["fan-rig"].replace(fy=-1e9).to_toml(), "out of range"),
        ("x" * 3_000_000, "longer"),
    ):
        before = editor.snapshot()
        request = open_request_of({"file": {"name": "scene.toml", "text": text}})
        assert request is not None
        taken = bookmarks.take(request, read_request(request))
        assert words in bookmarks.state()["said"]["words"]
        assert bookmarks.state()["said"]["words"].startswith("scene.toml")
        assert taken == (words == "is open")
        assert taken or editor.snapshot() == before
    assert editor.preset == "6205", "the preset whose bearing it has"


@pytest.mark.parametrize(
    ("text", "name"),
    [("", "Unnamed"), ("\n\t\0", "Unnamed"), (" a  b ", "a b"), ("x" * 999, "x" * LONGEST_NAME)],
)
def test_names_are_short_and_on_one_line(text: str, name: str) -> None:
    assert name_of(text) == name


def test_what_ends_where_it_began_is_no_step() -> None:
    history = History(0)
    history.move(1, "extent")
    history.move(0, "extent")
    assert not history.can_undo
    history.settle()
    history.step(0)
    assert history.undo() is None


def test_only_so_many_steps_are_kept() -> None:
    history = History(0, most=3)
    for now in range(1, 10):
        history.step(now)
    assert [history.undo() for _ in range(4)] == [8, 7, 6, None]


@given(st.lists(st.one_of(st.integers(0, 3), st.sampled_from(["undo", "redo"])), max_size=40))
def test_as_a_list_and_a_place_in_it(acts: list) -> None:
    history, states, at = History(0), [0], 0
    for act in acts:
        if act == "undo":
            entry = history.undo()
            assert entry == (states[at - 1] if at else None)
            at = max(at - 1, 0)
        elif act == "redo":
            entry = history.redo()
            assert entry == (states[at + 1] if at + 1 < len(states) else None)
            at = min(at + 1, len(states) - 1)
        else:
            history.step(act)
            if act != states[at]:
                states[at + 1 :] = [act]
                at += 1
        assert (history.can_undo, history.can_redo) == (at > 0, at + 1 < len(states))
