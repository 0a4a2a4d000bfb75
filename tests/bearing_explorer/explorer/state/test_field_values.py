"""From what a person gives to a Scene, and what is refused on the way."""

import math
import re

import pytest
from bearing_explorer.explorer.state.field_values import FIELD_BY_KEY, limits_of, read, values_of
from bearing_explorer.kit.sentences import sentence_of

from bearingcore import presets


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
