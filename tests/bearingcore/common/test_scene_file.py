"""Scenes as text: every scene comes back as it was, and nothing else is let in."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bearingcore import Defect, MeasuredFloor, RoughFloor, Scene, presets
from bearingcore.common.scene_file import LARGEST_TEXT
from bearingcore.scene.floor import MOST_ROWS


@pytest.mark.parametrize("name", list(presets))
def test_presets_come_back_as_they_were(name: str) -> None:
    assert Scene.from_toml(presets[name].to_toml()) == presets[name]


def test_floors_several_defects_and_options_come_back() -> None:
    scene = presets["fan-rig"].replace(
        defect=(
            Defect(0.1, 50e-6, 1.0, floor=RoughFloor(3e-6, 0.4e-3, 7)),
            Defect(0.2, 1.0 / 3.0 * 1e-4, 3.0, "inner", "exact"),
            Defect(0.2, 40e-6, 5.0, floor=MeasuredFloor((-1.0, 0.1, 1.0), (0.0, 1.0, 0.3))),
        ),
        contact_damping=math.pi,
        contact_law="no tension",
        dofs=("x", "y", "z"),
    )
    assert Scene.from_toml(scene.to_toml()) == scene


@settings(max_examples=60, derandomize=True, deadline=None)
@given(st.floats(0.0, 2.0 * math.pi), st.floats(0.0, 1e-3), st.floats(-1e9, 1e9))
def test_all_digits_are_kept(extent: float, depth: float, fy: float) -> None:
    scene = presets["liew-lim"].replace(extent=extent, depth=depth, fy=fy)
    again = Scene.from_toml(scene.to_toml())
    assert again.load == scene.load
    assert again.defects == scene.defects


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.update(version=2), "version is 2"),
        (lambda d: d.update(speed=1.0), "field of scene"),
        (lambda d: d["bearing"].update(n_balls=0), "n_balls"),
        (lambda d: d["bearing"].pop("pitch_diameter"), "pitch_diameter of bearing"),
        (lambda d: d.pop("bearing"), "bearing"),
        (lambda d: d["load"].update(fy="nan"), "fy"),
        (lambda d: d["defect"][0].update(race="middle"), "race"),
        (lambda d: d["defect"][0].update(floor={"kind": "lunar"}), "kind of the floor"),
        (lambda d: d.update(defect=[d["defect"][0]] * 21), "at most 20"),
        (lambda d: d.update(dofs="xy"), "dofs"),
        (lambda d: d.update(dofs=["w"]), "dofs"),
        (lambda d: d.update(shaft_speed=10**400), "shaft_speed|scene"),
    ],
)
def test_wrong_data_are_refused_by_name(change, words: str) -> None:
    data = presets["fan-rig"].to_data()
    change(data)
    with pytest.raises(ValueError, match=words):
        Scene.from_data(data)


def test_an_endless_text_is_not_parsed() -> None:
    with pytest.raises(ValueError, match="length of the text"):
        Scene.from_toml("#" * (LARGEST_TEXT + 1))


def test_a_long_measured_floor_is_read() -> None:
    # as few characters as there can be: 2,000,000 are read
    places = np.linspace(-0.999, 0.999, 40_000).round(6)
    floor = MeasuredFloor(tuple(places.tolist()), (0.5,) * len(places))
    assert len(places) <= MOST_ROWS
    (defect,) = presets["fan-rig"].defects
    scene = presets["fan-rig"].replace(
        defect=Defect(defect.extent, defect.depth, defect.center, floor=floor)
    )
    text = scene.to_toml()
    assert len(text) <= LARGEST_TEXT
    assert Scene.from_toml(text) == scene


def test_a_text_that_is_no_toml_is_quoted_on_one_line() -> None:
    with pytest.raises(ValueError, match="TOML") as refusal:
        Scene.from_toml('name = "a"\nload = = 3\n')
    assert "\\n" not in str(refusal.value)
    assert "line 2" in str(refusal.value)
