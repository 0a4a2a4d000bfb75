"""The table of choices: it says what the core knows, and what a scene has."""

import pytest
from bearing_explorer.explorer.state.address import place_of, read, write
from bearing_explorer.explorer.state.choice_list import (
    CHOICE_LIST,
    IN_PART,
    OF_DEFECT,
    OF_SCENE,
    Choice,
    chosen_of,
)
from bearing_explorer.explorer.state.scene_editor import SceneEditor

from bearingcore import CONTACT_LAWS, EDGES, RACES
from bearingcore.model.scene import TILT_FREE
from bearingcore.model.scene._scene import BALLS


def test_every_option_of_the_core_can_be_chosen() -> None:
    offered = {choice.name: choice.names for choice in CHOICE_LIST}
    assert offered["race"] == RACES
    assert offered["edge"] == EDGES
    assert offered["law"] == CONTACT_LAWS
    assert offered["balls"] == BALLS


def test_a_shaft_is_held_freed_or_held_in_part() -> None:
    editor = SceneEditor("liew-lim")
    assert chosen_of(editor.scene)["dofs"] == TILT_FREE
    for chosen, dofs in (("auto", None), (TILT_FREE, TILT_FREE)):
        assert editor.choose({"dofs": chosen}) == {}
        assert (editor.scene.dofs, editor.state()["choices"]["dofs"]) == (dofs, chosen)
    editor.take_scene(editor.scene.replace(dofs=("x", "y")))
    assert editor.state()["choices"]["dofs"] == IN_PART
    assert "a link or a file" in editor.choose({"dofs": IN_PART})["dofs"]
    assert editor.scene.dofs == ("x", "y"), "what is refused changes nothing"


@pytest.mark.parametrize("choice", [*OF_SCENE, *OF_DEFECT], ids=lambda choice: choice.name)
def test_what_is_chosen_is_in_the_scene_the_link_and_back(choice: Choice) -> None:
    for option in choice.options:
        editor = SceneEditor("7208-back-to-back" if choice.name == "row" else "fan-rig")
        assert editor.choose({choice.name: option.name}) == {}
        assert chosen_of(editor.scene)[choice.name] == option.name
        assert editor.state()["choices"][choice.name] == option.name
        place = read(write(place_of(editor)))
        assert place is not None
        assert place.scene == editor.scene
