"""Scenes as text: every scene comes back as it was, and nothing else is let in."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from bearingcore import Defect, MeasuredFloor, RoughFloor, Scene, presets
from bearingcore.common import LARGEST_TEXT
from bearingcore.errors import FieldError
from bearingcore.model.scene import MOST_ROWS


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
    with pytest.raises(FieldError, match="text is None; allowed: a text"):
        Scene.from_toml(None)
