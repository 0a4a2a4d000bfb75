"""What a session remembers: steps, compared scenes, the address; and what strangers ask of it."""

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
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from hypothesis import given, strategies as st

from bearingcore import Scene, presets


@pytest.fixture
def editor() -> SceneEditor:
    return SceneEditor("fan-rig")


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
    history.moved(1, "extent")
    history.moved(0, "extent")
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
