"""Every field and choice: from what a person gives to a Scene, a range, a file and a link."""

import math
import re

import numpy as np
import pytest
from bearing_explorer.explorer.state import address
from bearing_explorer.explorer.state.choice_list import (
    CHOICE_LIST,
    IN_PART,
    OF_DEFECT,
    OF_SCENE,
    Choice,
    chosen_of,
)
from bearing_explorer.explorer.state.difference import difference, distinct_name
from bearing_explorer.explorer.state.field_values import (
    FIELD_BY_KEY,
    limits_of,
    number_of,
    read,
    shown_number,
    values_of,
)
from bearing_explorer.explorer.state.history import LastState
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.value_range import SWEEPABLE, sweep, usual_range
from bearing_explorer.kit.sentences import sentence_of
from hypothesis import given, strategies as st

from bearingcore import CONTACT_LAWS, EDGES, RACES, Defect, RoughFloor, Scene, presets
from bearingcore.fields import SCENE_FIELDS, Field
from bearingcore.model.scene import TILT_FREE
from bearingcore.model.scene._scene import BALLS
from bearingcore.model.sweeps._grid import Grid


@pytest.mark.parametrize("name", list(presets))
def test_the_sliders_reach_what_a_preset_starts_with(name: str) -> None:
    values, limits = values_of(presets[name]), limits_of(presets[name])
    assert set(values) == set(limits) == set(FIELD_BY_KEY)
    for quantity, value in values.items():
        if not math.isnan(value):
            assert limits[quantity].least <= value <= limits[quantity].most, quantity
        assert 0 < limits[quantity].step < limits[quantity].most - limits[quantity].least


@pytest.mark.parametrize(
    ("given", "value"), [("40", 40.0), (" 12,5 ", 12.5), (7, 7.0), ("1e1", 10.0), ("−50", -50.0)]
)
def test_numbers_are_read_as_people_write_them(given: object, value: float) -> None:
    assert read("fy_n", given, limits_of(presets["fan-rig"])) == value


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ("-1", "−1° is out of range: length of the defect goes from 0 to 360°."),
        (math.inf, "“inf” is not a number: length of the defect goes from 0 to 360°."),
        ("", "A number is missing: length of the defect goes from 0 to 360°."),
        (
            "1.2.3",
            "“1.2.3” is not a number in rad, deg, °, mrad: length of the defect goes from 0 "
            "to 360°.",
        ),
        ([1, 2], "“[1, 2]” is not a number: length of the defect goes from 0 to 360°."),
    ],
)
def test_what_is_refused_gets_a_sentence(given: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=r"length of the defect goes from") as refusal:
        read("extent_deg", given, limits_of(presets["fan-rig"]))
    assert str(refusal.value) == sentence


def test_turns_a_minute_typed_as_hertz_are_asked_about() -> None:
    with pytest.raises(ValueError, match=r"1797 Hz is out of range.*Did you mean 1797 rpm\?$"):
        read("shaft_speed_hz", "1797", limits_of(presets["fan-rig"]))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"shaft_speed": -1.0}, ("shaft speed is −0.15915 Hz", "0 Hz")),
        ({"depth": 0.01}, ("depth is 10000 µm", "µm", "the ball radius")),
        ({"extent": 7.0}, ("length of the defect is 401.07°", "360°")),
        ({"pitch_diameter": 1e-3}, ("pitch diameter", "mm")),
    ],
)
def test_what_the_core_refuses_is_said_in_the_units_of_the_page(
    change: dict[str, float], words: tuple[str, ...]
) -> None:
    with pytest.raises(ValueError, match=" is ") as refused:
        presets["6205"].replace(**change)
    said = sentence_of(refused.value)
    for part in words:
        assert part in said, said
    assert not re.search(r"\d ?(m|rad|rad/s)\b", said), said
    assert "_" not in said


RIG = presets["fan-rig"]
LIMITS = limits_of(RIG)


def test_values_are_taken_as_typed_and_go_to_the_core_in_si() -> None:
    speeds = sweep("shaft_speed_hz", "5", "30,5", 11, LIMITS)
    np.testing.assert_allclose(speeds.values, np.linspace(5.0, 30.5, 11))
    field, values = speeds.in_si
    assert field == "shaft_speed"
    np.testing.assert_allclose(values, 2.0 * math.pi * speeds.values)


def test_balls_come_whole() -> None:
    balls = sweep("n_balls", "7", "16", 4, LIMITS)
    assert balls.values.tolist() == [7.0, 10.0, 13.0, 16.0]
    assert balls.every(7) is balls


@pytest.mark.parametrize(
    ("name", "first", "last", "words"),
    [
        ("shaft_speed_hz", "0", "30", "must turn"),
        ("shaft_speed_hz", "30", "5", "greater"),
        ("shaft_speed_hz", "fast", "30", "not a number"),
        ("shaft_speed_hz", "1", "1e9", "out of range"),
        ("cage_angle_deg", "1", "5", "no such"),
        ("__class__", "1", "5", "no such"),
        ("n_balls", "7.2", "7.9", "whole"),
    ],
)
def test_what_cannot_be_is_refused_with_a_sentence(name, first, last, words) -> None:
    with pytest.raises(ValueError, match=words):
        sweep(name, first, last, 13, LIMITS)


@given(st.sampled_from([13, 25, 49, 97]), st.sampled_from([1, 2, 4, 8]))
def test_coarse_values_are_among_the_fine_ones(count: int, stride: int) -> None:
    fine = sweep("extent_deg", "1", "60", count, LIMITS)
    coarse = fine.every(stride)
    assert set(coarse.values) <= set(fine.values)
    assert coarse.values[[0, -1]].tolist() == [1.0, 60.0]
    np.testing.assert_allclose(np.diff(coarse.values), np.diff(coarse.values)[0])


@pytest.mark.parametrize("preset", list(presets))
def test_every_quantity_has_a_range_to_begin_with(preset: str) -> None:
    limits = limits_of(presets[preset])
    for name in SWEEPABLE:
        low, high = usual_range(name, limits)
        assert low < high
        assert limits[name].least <= low
        assert high <= limits[name].most


SCENE = presets["fan-rig"]
SPACING = SCENE.bearing.ball_spacing
TWO = SCENE.replace(defect=(Defect(0.2, 1e-5, 4.7), Defect(0.1, 2e-5, 1.0)))


@pytest.mark.parametrize(
    ("now", "before", "words"),
    [
        (SCENE.replace(extent=SCENE.defect.extent + SPACING), SCENE,
         "Defect longer by one ball spacing (12.9 → 38.61°)"),
        (SCENE, SCENE.replace(extent=SCENE.defect.extent + 2 * SPACING),
         "Defect shorter by 2 ball spacings (64.33 → 12.9°)"),
        (SCENE.replace(fy=-120.0), SCENE, "Load, downwards (100 → 120 N)"),
        (SCENE.replace(fy=-100.01), SCENE, "Load, downwards (100 → 100.01 N)"),
        (SCENE.replace(fy=-1e6), SCENE, "Load, downwards (100 → 1000000 N)"),
        (SCENE.replace(fy=-120.0, depth=8e-5), SCENE,
         "Depth (50 → 80 µm), load, downwards (100 → 120 N)"),
        (SCENE.healthy(), SCENE, "Without the defect"),
        (TWO, SCENE, "A defect more"),
        (presets["6205"], SCENE, "Another bearing"),
        (SCENE.replace(fx=1.0, fy=-2.0, fz=3.0, depth=8e-5), SCENE, "Several changes at once"),
        (TWO.replace(defect=(TWO.defects[0], Defect(0.1, 9e-5, 1.0))), TWO,
         "Another defect has changed"),
        (SCENE.replace(dofs=("y",)), SCENE, "Other free directions"),
    ],
)  # fmt: skip
def test_what_has_changed(now, before, words: str) -> None:
    assert difference(now, before) == words


LOADED, FAST = SCENE.replace(fy=-200.0), SCENE.replace(shaft_speed=SCENE.shaft_speed * 2.0)


@pytest.mark.parametrize(
    ("scene", "others", "name"),
    [
        (SCENE, [SCENE], "12.9°, 50 µm"),
        (SCENE, [LOADED], "100 N"),
        (SCENE, [SCENE.replace(fx=30.0)], "100 N at 270°"),
        (FAST, [SCENE, LOADED], "14 Hz, 100 N"),
        (SCENE.replace(race="inner"), [SCENE], "inner"),
        (SCENE.healthy(), [SCENE], "no defect"),
        (SCENE, [SCENE.replace(center=1.0, extent=0.1)], "12.9°, 50 µm, centre 270°"),
    ],
)
def test_a_scene_is_named_by_what_differs(scene, others, name: str) -> None:
    assert distinct_name(scene, others) == name


def test_the_scene_before_a_drag_is_where_it_began() -> None:
    last = LastState(SCENE)
    steps = [SCENE.replace(depth=depth) for depth in (6e-5, 7e-5, 8e-5)]
    last.follow(SCENE, moving=False)
    assert last.before is None
    for scene in steps:
        last.follow(scene, moving=True)
        assert last.before == SCENE
    last.follow(steps[-1], moving=False)
    assert last.before == SCENE, "until the next change begins"
    last.follow(steps[-1], moving=True)  # the bearing turns: no change of the scene
    assert last.before == SCENE
    other = steps[-1].replace(fy=-5.0)
    last.follow(other, moving=True)
    assert last.before == steps[-1]
    last.follow(other, moving=False)
    last.follow(SCENE, moving=False)  # at once, as an undo is
    assert last.before == other


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
        place = address.read(address.write(address.place_of(editor)))
        assert place is not None
        assert place.scene == editor.scene
