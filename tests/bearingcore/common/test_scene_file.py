"""Scenes as text: every scene comes back as it was, and nothing else is let in."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from bearingcore import Defect, MeasuredFloor, RoughFloor, Scene, presets
from bearingcore.common import LARGEST_TEXT
from bearingcore.errors import FieldError
from bearingcore.model.scene import MOST_ROWS
from tests.fuzz.targets import unclear


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


GOOD = presets["fan-rig"].to_toml()
SPEED = next(line for line in GOOD.splitlines() if line.startswith("shaft_speed"))


def text_with_speed(value: str) -> str:
    """A good scene but for one number."""
    return GOOD.replace(SPEED, f"shaft_speed = {value}")


TEXTS = {
    "digits": text_with_speed("9" * 1_000_000),
    "hexadecimal digits": text_with_speed("0x" + "f" * 1_500_000),
    "lists in lists": text_with_speed("[" * 9000 + "]" * 9000),
    "tables in tables": text_with_speed("{b=" * 9000 + "1" + "}" * 9000),
    "a table many times": GOOD + "[a]\n" * 9000,
    "many tables of many parts": GOOD + "".join(f"[a.{'b.' * 15}c{i}]\n" for i in range(9000)),
    "many names": "".join(f"k{i} = 1\n" for i in range(9900)) + GOOD,
    "a text that does not end": GOOD + 'a = """' + '"' * 1_500_000,
    "a text of escapes": GOOD + 'a = "' + "\\u0041" * 300_000 + '"',
    "no number": text_with_speed("nan"),
    "a sign that is none": text_with_speed('"\x00"'),
    "half a sign": text_with_speed('"\ud800"'),
    "twice": GOOD + SPEED,
}


COUNTED = {
    "many values": "a=[" + "1," * 900_000 + "]",  # 5.6 s to read
    "many parts": "a" + ".a" * 30_000 + "=1",  # a minute
    "parts of many names": "\n".join("a." * 40 + f"k{k}=1" for k in range(9000)),
    "many lines": "\n" * 1_900_000,
    "many tables": "\n".join(f"[a{k}]" for k in range(200_000)),
    "lists in many lists": "a=" + "[" * 900_000,
    "tables in many tables": "a=" + "{b=" * 20_000,
}


@pytest.mark.parametrize("text", COUNTED.values(), ids=COUNTED)
def test_what_would_take_long_to_read_is_counted_and_not_read(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bearingcore.common._scene_file.tomllib.loads", None)
    with pytest.raises(ValueError, match="in the text is"):
        Scene.from_toml(text)


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_a_hostile_text_is_refused_with_a_sentence(text: str) -> None:
    with pytest.raises(ValueError, match=r"\w") as caught:
        Scene.from_toml(text)
    words = str(caught.value)
    assert unclear(words) is None
    assert "sys." not in words, "no advice for programmers"


def test_the_good_text_is_taken() -> None:
    assert Scene.from_toml(GOOD) == presets["fan-rig"]
    assert Scene.from_toml(text_with_speed("1" + "0" * 30)).shaft_speed == 1e30
