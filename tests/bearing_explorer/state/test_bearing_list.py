"""Bearings by designation, and a workshop's own table."""

from __future__ import annotations

import pytest
from bearing_explorer.state.bearing_list import BearingTable, entry_words, read_table
from bearing_explorer.state.scene_editor import SceneEditor

from bearingcore import catalogue

TABLE = "name;balls;ball_diameter_mm;pitch_diameter_mm\nPump 3;9;7,94;39,04\n"


def test_a_published_bearing_is_put_into_the_scene() -> None:
    editor = SceneEditor("6205")
    load = editor.scene.load
    assert editor.choose({"bearing": "209, Harris"}) == {}
    assert editor.scene.bearing == catalogue()["209, Harris"].bearing
    assert editor.scene.load == load
    assert editor.name == "209, Harris"
    assert "Harris, Rolling Bearing Analysis" in editor.note
    editor.choose({"bearing": "6804RS, FEMTO-ST"})
    assert "Assumed: an inner groove of 0.52 ball diameters" in editor.note


def test_a_table_of_ones_own_stands_first_and_can_be_used() -> None:
    editor = SceneEditor("6205")
    before = editor.listed.version
    editor.listed.take("ours.csv", read_table(TABLE))
    assert editor.listed.version > before
    assert editor.listed.words == "ours.csv: 1 bearing added"
    first, own = editor.listed.all()[0]
    assert (first.name, own) == ("Pump 3", True)
    assert entry_words(first).startswith("9 balls of 7.94 mm on 39.04 mm")
    assert editor.choose({"bearing": "Pump 3"}) == {}
    assert "From a table of your own." in editor.note


def test_a_bearing_of_a_list_that_was_changed_says_so() -> None:
    editor = SceneEditor("6205")
    editor.choose({"bearing": "209, Harris"})
    kept = editor.snapshot()
    editor.set({"n_balls": 8})
    assert editor.name == "209, Harris, changed"
    assert editor.note.startswith("Edited from “209, Harris”")
    editor.choose({"name": "My own"})
    assert editor.name == "My own"
    assert "Harris" not in editor.note.split("Edited from “209, Harris”")[1]
    editor.restore(kept)
    assert editor.name == "209, Harris"
    assert "Harris, Rolling Bearing Analysis" in editor.note


def test_a_bearing_of_the_same_name_replaces_the_published_one() -> None:
    table = BearingTable()
    table.take("a.csv", read_table(TABLE.replace("Pump 3", "209, Harris")))
    names = [one.name for one, _ in table.all()]
    assert names.count("209, Harris") == 1
    assert table.find("209, Harris").bearing.ball_diameter == pytest.approx(7.94e-3)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "a line of headings"),
        ("name;balls\nx;9\n", "ball_diameter_mm"),
        (TABLE.replace("39,04", "x"), "line 2, column pitch_diameter_mm"),
        ("x" * 1_100_000, "longer than"),
    ],
)
def test_what_is_no_table_is_refused_in_sentences(text: str, words: str) -> None:
    found = read_table(text)
    assert isinstance(found, str)
    assert words in found
    table = BearingTable()
    table.take("a.csv", found)
    assert table.bad
    assert table.own == {}


def test_what_is_not_on_the_list_is_refused() -> None:
    editor = SceneEditor("6205")
    assert "one of the list" in editor.choose({"bearing": "<script>"})["bearing"]
