"""The table of choices: it says what the core knows, and what a scene has."""

from __future__ import annotations

import pytest
from bearing_explorer.explorer.state.address import place_of, read, write
from bearing_explorer.explorer.state.choice_list import (
    CHOICE_LIST,
    OF_DEFECT,
    OF_SCENE,
    Choice,
    chosen_of,
)
from bearing_explorer.explorer.state.scene_editor import SceneEditor

from bearingcore import CONTACT_LAWS, EDGES, RACES
from bearingcore.scene.scene import BALLS


def test_every_option_of_the_core_can_be_chosen() -> None:
    offered = {choice.name: choice.names for choice in CHOICE_LIST}
    assert offered["race"] == RACES
    assert offered["edge"] == EDGES
    assert offered["law"] == CONTACT_LAWS
    assert offered["balls"] == BALLS


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
