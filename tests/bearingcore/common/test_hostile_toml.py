"""Texts that cost a parser much, or make it speak like a program: refused with a sentence."""

import pytest

from bearingcore import Scene, presets
from tests.fuzz.targets import unclear

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
