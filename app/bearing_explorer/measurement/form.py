"""What a table of numbers is asked about before it is a measurement, and what is guessed.

Which columns are the housing's acceleration along x and y, in what unit, how often it was sampled,
how fast the shaft turned. The form holds text, as a person types it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from bearing_explorer.measurement.signal import Origin
from bearingcore import Recording, Table
from bearingcore.signals.recording import UNITS

FIELDS = ("x", "y", "unit", "full_scale", "sample_rate", "shaft_speed")
LONGEST_TEXT = 40
NONE = ""
"""The choice of no column."""

MOST_COLUMNS_NAMED = 24  # characters of a heading in a list

_WORDS = {
    "sample_rate": ("The sample rate", "Hz", 10.0, 1e7),
    "full_scale": ("What a 1 in the file stands for", "", 1e-12, 1e12),
    "shaft_speed": ("The shaft speed", "Hz", 1e-3, 1e4),
}
_SAYS_X = {"x", "ax", "hor", "horiz", "horizontal", "h"}
_SAYS_Y = {"y", "ay", "ver", "vert", "vertical", "v"}


@dataclass(frozen=True)
class Asked:
    """The form as it is understood: a recording, the shaft speed [rad/s] at it, its origin."""

    recording: Recording
    shaft_speed: float
    origin: Origin


class FormError(ValueError):
    """Sentences by the fields that they belong to."""

    def __init__(self, sentences: Mapping[str, str]) -> None:
        super().__init__(" ".join(sentences.values()))
        self.sentences = dict(sentences)


def guess(table: Table, shaft_speed_hz: float) -> dict[str, str]:
    """What stands in the form at first; `shaft_speed_hz` where the file does not tell it."""
    data = [index for index in range(len(table.names)) if index != table.time_column]
    x = next((i for i in data if _tokens(table.names[i]) & _SAYS_X), None)
    y = next((i for i in data if _tokens(table.names[i]) & _SAYS_Y and i != x), None)
    if x is None and y is None and data:
        x, y = (data[0], data[1]) if len(data) == 2 else (None, data[0])
    rate = table.suggested_rate
    headings = " ".join(table.names[i] for i in (x, y) if i is not None)
    return {
        "x": NONE if x is None else str(x),
        "y": NONE if y is None else str(y),
        "unit": "g" if _in_g(headings) else "m/s²",
        "full_scale": "1",
        "sample_rate": "" if rate is None else f"{rate:.8g}",
        "shaft_speed": speed_told(table.scalars) or f"{shaft_speed_hz:g} Hz",
    }


def columns_of(table: Table) -> list[list[str]]:
    """[value, words] of the columns to choose from; times and none first."""
    time = table.time_column
    return [[NONE, "not measured"]] + [
        [str(index), _short(name)] for index, name in enumerate(table.names) if index != time
    ]


def usable(table: Table) -> bool:
    """Whether any of the columns could be a signal."""
    signals = [table.columns[:, i] for i in range(len(table.names)) if i != table.time_column]
    return any(np.isfinite(signal).all() and np.ptp(signal) > 0.0 for signal in signals)


def understood(table: Table, form: Mapping[str, Any]) -> Asked:
    """The recording that a form asks for; `FormError` with sentences where it cannot be."""
    texts = {name: str(form.get(name, ""))[:LONGEST_TEXT].strip() for name in FIELDS}
    refused: dict[str, str] = {}
    numbers: dict[str, float] = {}
    for name in _WORDS:
        try:
            numbers[name] = _speed(texts[name]) if name == "shaft_speed" else _read(name, texts)
        except ValueError as error:
            refused[name] = str(error)
    chosen = {name: texts[name] for name in ("x", "y") if texts[name] != NONE}
    if not chosen:
        refused["y"] = "Choose the column of at least one direction."
    elif len(set(chosen.values())) < len(chosen):
        refused["x"] = "x and y cannot be the same column."
    elif not all(_is_index(text, len(table.names)) for text in chosen.values()):
        refused["y"] = "There is no such column."
    if texts["unit"] not in UNITS:
        refused["unit"] = "The unit is m/s² or g."
    if refused:
        raise FormError(refused)
    try:
        recording = table.recording(
            [int(text) for text in chosen.values()],
            list(chosen),
            texts["unit"],
            numbers["sample_rate"],
            numbers["full_scale"],
        )
    except ValueError as error:
        raise FormError({next(iter(chosen)): f"These columns are no signal: {error}."}) from None
    columns = tuple(int(text) for text in chosen.values())
    origin = Origin(table.name, columns, texts["unit"], numbers["full_scale"])
    return Asked(recording, 2.0 * math.pi * numbers["shaft_speed"], origin)


def _read(name: str, texts: Mapping[str, str]) -> float:
    words, unit, least, most = _WORDS[name]
    return number_of(texts[name], words, unit, least, most)


def _speed(text: str) -> float:
    """[Hz], of a number with or without its unit."""
    words, unit, least, most = _WORDS["shaft_speed"]
    bare = text.lower()
    per_minute = bare.endswith(("rpm", "/min", "u/min", "1/min"))
    bare = re.sub(r"\s*(rpm|[u1]?/min|hz)$", "", bare)
    value = number_of(bare, words, "rpm" if per_minute else unit, 0.0, math.inf)
    value = value / 60.0 if per_minute else value
    if not least <= value <= most:
        raise ValueError(f"{words} of {value:g} Hz is not possible: {least:g} to {most:g} Hz are.")
    return value


def number_of(text: str, words: str, unit: str, least: float, most: float) -> float:
    """The number that a person typed; ValueError with a sentence."""
    bare = re.sub(r"(?<=\d)[\s'](?=\d{3}\b)", "", text.strip()).replace("−", "-")
    bare = re.sub(rf"\s*{re.escape(unit)}$", "", bare, flags=re.IGNORECASE) if unit else bare
    if not bare:
        raise ValueError(f"{words} is missing: type it in{f' ({unit})' if unit else ''}.")
    try:
        value = float(bare.replace(",", "."))
    except ValueError:
        raise ValueError(f"{words} must be a number, not “{text[:20]}”.") from None
    if not math.isfinite(value) or not least <= value <= most:
        span = f"{least:g} to {most:g}" if math.isfinite(most) else f"at least {least:g}"
        raise ValueError(f"{words} is {value:g}; possible: {span}{f' {unit}' if unit else ''}.")
    return value


def _is_index(text: str, count: int) -> bool:
    return text.isascii() and text.isdecimal() and len(text) < 5 and int(text) < count


def _tokens(heading: str) -> set[str]:
    """The words of a heading, without units in brackets."""
    bare = re.sub(r"[\[(].*?[\])]", " ", heading.lower())
    return {word for word in re.split(r"[^a-z0-9]+", bare) if word}


def _in_g(headings: str) -> bool:
    """Whether a heading gives g as its unit."""
    return re.search(r"[\[(/_\s]g[\])\s]|[\[(/_\s]g$", headings) is not None


def speed_told(scalars: Mapping[str, float]) -> str:
    """Shaft speed among the single numbers of a file, with its unit; empty without one."""
    for name, value in scalars.items():
        if math.isfinite(value) and value > 0.0:
            if "rpm" in name.lower():
                return f"{value:g} rpm"
            if name.lower() in ("shaft_speed_hz", "shaft_frequency", "fr", "f_shaft", "speed_hz"):
                return f"{value:g} Hz"
    return ""


def _short(name: str) -> str:
    return name if len(name) <= MOST_COLUMNS_NAMED else name[: MOST_COLUMNS_NAMED - 1] + "…"
