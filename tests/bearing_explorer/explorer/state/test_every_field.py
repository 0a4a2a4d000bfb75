"""Every field of FIELDS.md and every choice can be changed, kept in a file and sent as a link."""

import math

import pytest
from bearing_explorer.explorer.state import address
from bearing_explorer.explorer.state.address import place_of, read, write
from bearing_explorer.explorer.state.choice_list import (
    CHOICE_LIST,
    IN_PART,
    OF_DEFECT,
    OF_SCENE,
    Choice,
    chosen_of,
)
from bearing_explorer.explorer.state.field_values import number_of, shown_number
from bearing_explorer.explorer.state.scene_editor import SceneEditor

from bearingcore import CONTACT_LAWS, EDGES, RACES, RoughFloor, Scene, presets
from bearingcore.fields import SCENE_FIELDS, Field
from bearingcore.model.scene import TILT_FREE
from bearingcore.model.scene._scene import BALLS
from bearingcore.model.sweeps._grid import Grid

OF_PARTS = {"pair": "7208-back-to-back", "second": "7208-back-to-back"}
"""Presets that have the fields of a part."""


def other_value(scene: Scene, field: Field, preset: str) -> float:
    """A number [SI] that the field may have and has not."""
    now = number_of(scene, field)
    if field.part == "second":
        now = getattr(scene.bearing, field.name)
    if field.whole:
        return (now or 0) - 1
    if now:
        return 1.02 * now
    limits = field.range_for(presets[preset], math.nan if now is None else 0.0)
    shown = limits.least + 0.3 * (limits.most - limits.least)
    return float(f"{shown:.3g}") * field.factor


def base_of(field: Field) -> tuple[str, Scene]:
    """A preset that has the field, and its scene."""
    preset = "nu208" if field.name == "roller_length" else OF_PARTS.get(field.part, "6205")
    scene = presets[preset].replace(extent=0.1, depth=20e-6)
    rough = RoughFloor(2e-6, 200e-6, 4) if field.part == "floor" else None
    return preset, scene.replace(floor=rough)


@pytest.mark.parametrize("field", SCENE_FIELDS, ids=lambda field: field.full_name)
def test_a_field_is_replaced_swept_filed_sent_and_dragged(field: Field) -> None:
    preset, scene = base_of(field)
    value = other_value(scene, field, preset)
    changed = scene.replace(**{field.full_name: value})
    assert changed != scene
    assert number_of(changed, field) == pytest.approx(value, rel=1e-9)
    assert Scene.from_toml(changed.to_toml()) == changed
    swept = Grid.of(scene, {field.full_name: [value]}, ["k_yy_mean"])
    assert swept.scene_at([0]) == changed
    read = address.read(address.write(address.Place(changed, preset)))
    assert read is not None
    assert read.scene == changed
    if not field.group:
        return
    shown = shown_number(field, value)
    editor = SceneEditor(preset)
    editor.take_scene(scene, preset, 0)
    refused, _ = editor.set({field.key: shown})
    assert not refused
    assert number_of(editor.scene, field) == pytest.approx(value, rel=1e-9)
    floor = {"rms_height_um": "2", "correlation_length_um": "200", "seed": "4"}
    pairs = {"v": "1", "preset": preset, **(floor if field.part == "floor" else {})}
    pairs[field.key] = f"{shown:.12g}"
    read = address.read("&".join(f"{name}={text}" for name, text in pairs.items()))
    assert read is not None
    assert number_of(read.scene, field) == pytest.approx(value, rel=1e-9)


def test_numbers_that_a_scene_has_not_are_refused_by_name() -> None:
    for name, value in (("preload", 1e-6), ("second_n_balls", 9), ("preload_force", 100.0)):
        with pytest.raises(ValueError, match=f"two rows that form a pair, where {name} is set"):
            presets["6205"].replace(**{name: value})
        with pytest.raises(ValueError, match="two rows"):
            Grid.of(presets["6205"], {name: [value]}, ["k_yy_mean"])
    flat = presets["6205"].replace(extent=0.1, depth=20e-6)
    with pytest.raises(ValueError, match="rms_height is 1e-06; allowed: left out, unless"):
        flat.replace(rms_height=1e-6)


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
