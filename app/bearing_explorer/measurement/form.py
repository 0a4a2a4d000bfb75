"""The questions that make a table of numbers a measurement, and guesses at their answers.

Which columns are the housing's acceleration along x and y, in what unit, how often it was sampled,
how fast the shaft turned. The form holds text, as a person types it.

`questions` have to be answered before anything is drawn. `size_questions` are about the size of the
numbers, which is never guessed; until they are answered the numbers are taken as they are, for what
does not depend on it.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from bearing_explorer.measurement.signal import Origin
from bearing_explorer.state.bearing_list import BearingTable
from bearing_explorer.state.sentences import sentence_of
from bearingcore import Bearing, CatalogueBearing, Recording, Table
from bearingcore.bearings.frequencies import FREQUENCIES, bearing_of_frequencies
from bearingcore.common.numbers import number, span, with_prefix
from bearingcore.errors import FieldError
from bearingcore.files.facts import Finding
from bearingcore.files.units import (
    STANDARD_GRAVITY,
    UNITS,
    VOLTAGES,
    kind_of,
    level_doubt,
)

FIELDS = (
    "x", "y", "unit", "full_scale", "sensitivity", "sample_rate", "shaft_speed", "bearing",
    *FREQUENCIES,
)  # fmt: skip
LONGEST_TEXT = 40
NONE = ""
"""The choice of no column."""
NOT_KNOWN = ""
"""A unit or a sensitivity that has not been answered."""
SCENE_BEARING, BY_FREQUENCIES = "", "frequencies"
"""The bearing that was measured: that of the scene, or the one whose parts have the frequencies in
the form; else it is the name of a listed one."""
SAME_ORDERS = 0.01
"""Relative difference up to which a bearing's frequencies are those of a file."""
SIZES = ("unit", "sensitivity")
"""Fields that say how large the numbers of a file are."""

find_published = BearingTable().find
"""The published bearing of a name, or the one of a designation."""

MOST_COLUMNS_NAMED = 24  # characters of a heading in a list

MOST_SAID = 12
"""Numbers and words of a file that are shown."""

_WORDS = {
    "sample_rate": ("The sample rate", "Hz", 10.0, 1e7),
    "full_scale": ("The value of a 1 in the file", "", 1e-12, 1e12),
    "sensitivity": ("The sensitivity of the sensor", "mV/g", 1e-3, 1e6),
    "shaft_speed": ("The shaft speed", "Hz", 1e-3, 1e4),
}
PITCH_DIAMETER = 39e-3
"""[m] of bearings known by their frequencies, for their picture: no answer depends on it."""
USUAL_SENSITIVITY = 100
"""[mV/g]"""


@dataclass(frozen=True)
class FormResult:
    """A form as it is read: a recording, its shaft speed [rad/s], its origin, its bearing.

    Without `in_si` the recording holds the numbers of the file: their unit is not known. Without a
    `bearing` it is that of the scene.
    """

    recording: Recording
    shaft_speed: float
    origin: Origin
    in_si: bool = True
    bearing: Bearing | None = None


class FormError(ValueError):
    """Sentences by the fields that they belong to."""

    def __init__(self, sentences: Mapping[str, str]) -> None:
        super().__init__(" ".join(sentences.values()))
        self.sentences = dict(sentences)


def guess(table: Table, shaft_speed_hz: float) -> dict[str, str]:
    """The first values of the form; the shaft speed is `shaft_speed_hz` where the file has none."""
    contents = table.contents
    rate, speed = contents.sample_rate, contents.shaft_speed
    chosen = contents.choice.columns
    return {
        "x": str(chosen.get("x", NONE)),
        "y": str(chosen.get("y", NONE)),
        "unit": contents.unit.value if contents.unit.taken else NOT_KNOWN,
        "full_scale": "1",
        "sensitivity": NOT_KNOWN,
        "sample_rate": "" if rate is None else f"{rate.value:.8g}",
        "shaft_speed": f"{shaft_speed_hz:g} Hz" if speed is None else _written(speed),
        **_bearing(table),
    }


def _bearing(table: Table) -> dict[str, str]:
    """The first values of the bearing and of its frequencies.

    What the file says of frequencies is taken before what its collection is known for.
    """
    contents = table.contents
    texts = dict.fromkeys(FREQUENCIES, "")
    said, speed, listed = contents.frequencies, contents.shaft_speed, contents.bearing
    if {"bpfo", "bpfi"} <= set(said):
        texts |= {name: f"{value:.6g} Hz" for name, value in said.items()}
        if listed is None or speed is None or not _agree(listed.value, said, speed.value):
            return {"bearing": BY_FREQUENCIES, **texts}
    if contents.orders is not None:
        texts |= {
            name: f"{order:.6g} x"
            for name, order in zip(("bpfo", "bpfi"), contents.orders.value, strict=True)
        }
        return {"bearing": BY_FREQUENCIES, **texts}
    return {"bearing": SCENE_BEARING if listed is None else listed.value, **texts}


def _agree(name: str, said: Mapping[str, float], speed: float) -> bool:
    """Whether a listed bearing has the frequencies [Hz] that a file says, at a speed [rad/s]."""
    bearing = find_published(name).bearing
    own = {"bpfo": bearing.bpfo(speed), "bpfi": bearing.bpfi(speed)}
    return all(abs(said[key] / value - 1.0) < SAME_ORDERS for key, value in own.items())


def bearings_of(table: Table | None, found: Sequence[str] = ()) -> list[list[str]]:
    """[value, words] of the bearings to choose from: also those that were `found` to explain it."""
    listed = None if table is None else table.contents.bearing
    names = dict.fromkeys([*([] if listed is None else [listed.value]), *found])
    return [
        [SCENE_BEARING, "that of the scene"],
        *([name, name] for name in names),
        [BY_FREQUENCIES, "by its frequencies"],
    ]


def _written(speed: Finding[float]) -> str:
    """A speed in rpm where the file gives it so, else in Hz."""
    hertz = speed.value / (2.0 * math.pi)
    return f"{60.0 * hertz:.6g} rpm" if speed.unit == "rpm" else f"{hertz:.6g} Hz"


def reasons(table: Table) -> dict[str, str]:
    """Why the form is filled in as it is, by field: what the file says, and what is a guess."""
    contents = table.contents
    rate, speed, choice = contents.sample_rate, contents.shaft_speed, contents.choice
    found = dict.fromkeys(choice.columns, choice.reason)
    found["unit"] = _because(contents.unit) if contents.unit.taken else "The file does not say it."
    if not table.full_scale_known:
        found["full_scale"] = "Full scale of the recorder, in the unit."
    found["sensitivity"] = "See the label of the sensor."
    found["sample_rate"] = "The file does not say it." if rate is None else _because(rate)
    if contents.frequencies:
        found["bearing"] = "Its frequencies are in the file."
    elif (guessed := contents.bearing or contents.orders) is not None:
        found["bearing"] = _because(guessed)
    found["shaft_speed"] = (
        "The file does not say it; this is the scene's." if speed is None else _because(speed)
    )
    return {name: words[:1].upper() + words[1:] for name, words in found.items()}


def _because(finding: Finding[Any]) -> str:
    return f"{'Said by' if finding.stated else 'A guess:'} {finding.reason}"


def questions(table: Table) -> dict[str, str]:
    """Questions to answer before the signal can be drawn, by field."""
    contents = table.contents
    asked: dict[str, str] = {}
    choice = contents.choice
    if choice.question:
        asked["y"] = choice.question + (f" A guess: {choice.reason}." if choice.columns else "")
    rate = contents.sample_rate
    if rate is not None and not rate.taken:
        trouble = contents.sampling.trouble if contents.sampling is not None else ""
        question = f"Is {rate.value:.6g} Hz the sample rate? A guess: {rate.reason}."
        asked["sample_rate"] = f"{trouble} {question}".strip()
    return asked


def proposed_unit(table: Table) -> str | None:
    """The unit that is likely where the file does not say it, "" where none is; None if it does."""
    unit = table.contents.unit
    if unit.stated:
        return None
    return unit.value if unit.supported else ""


def size_questions(table: Table, form: Mapping[str, str]) -> dict[str, str]:
    """Questions to answer before the signal has a size, by field."""
    if form["unit"] == NOT_KNOWN:
        likely = proposed_unit(table)
        why = f" {likely} is likely: {table.contents.unit.reason}." if likely else ""
        return {"unit": f"In what unit is it? The file does not say.{why}"}
    if form["unit"] in VOLTAGES and not form["sensitivity"].strip():
        return {
            "sensitivity": "What is the sensitivity of the sensor? See its label; "
            f"{USUAL_SENSITIVITY} mV/g is usual."
        }
    return {}


def said(table: Table) -> str:
    """Other numbers and words of a file, in a line; its load in newtons."""
    contents = table.contents
    stated = [
        f"{_short(name)} {_short(text)}" for name, text in list(contents.said.items())[:MOST_SAID]
    ]
    words = f"The file says: {', '.join(stated)}." if stated else ""
    if contents.load is not None:
        sure = "" if contents.load.stated else " if it is in pounds"
        words += f" Its load is {with_prefix(contents.load.value, 'N', 4)}{sure}."
    return words.strip()


def load_of(table: Table) -> float | None:
    """The load [N] that a file gives, where there is one."""
    load = table.contents.load
    return load.value if load is not None and load.value > 0.0 else None


def columns_of(table: Table) -> list[list[str]]:
    """[value, words] of the columns to choose from; none first, no times."""
    offered = {NONE: "not measured"}
    for index, column in enumerate(table.contents.columns):
        if column.role == "time":
            continue
        words = _short(column.name) + (f" ({column.place})" if column.place else "")
        taken = words in offered.values()
        offered[str(index)] = f"{words}, column {index + 1}" if taken else words
    return [[value, words] for value, words in offered.items()]


def usable(table: Table) -> bool:
    """True where any of the columns could be a signal."""
    for index, column in enumerate(table.contents.columns):
        signal = table.columns[:, index]
        filled = np.flatnonzero(~np.isnan(signal))
        if column.role != "time" and filled.size:
            signal = signal[: filled[-1] + 1]  # a shorter column ends earlier
            if np.isfinite(signal).all() and np.ptp(signal) > 0.0:
                return True
    return False


def read_form(
    table: Table,
    form: Mapping[str, Any],
    speed_known: bool = True,
    find: Callable[[str], CatalogueBearing] = find_published,
) -> FormResult:
    """The recording that a form describes; `FormError` with sentences where it describes none.

    `speed_known` says whether the shaft speed is that of the measurement, or only the scene's;
    `find` gives the bearing of a name.
    """
    texts = {name: str(form.get(name, ""))[:LONGEST_TEXT].strip() for name in FIELDS}
    refused: dict[str, str] = {}
    numbers: dict[str, float] = {}
    voltage = texts["unit"] in VOLTAGES
    stated = table.contents.unit.stated
    in_si = not size_questions(table, texts) or (texts["unit"] == NOT_KNOWN and stated)
    for name in _WORDS:
        if name == "sensitivity" and not (voltage and in_si):
            continue
        try:
            numbers[name] = _speed(texts[name]) if name == "shaft_speed" else _read(name, texts)
        except ValueError as error:
            refused[name] = str(error)
    chosen = {name: texts[name] for name in ("x", "y") if texts[name] != NONE}
    if not chosen:
        refused["y"] = table.contents.choice.question or (
            "Choose the column of at least one direction."
        )
    elif len(set(chosen.values())) < len(chosen):
        refused["x"] = "x and y cannot be the same column."
    elif not all(_is_index(text, len(table.names)) for text in chosen.values()):
        refused["y"] = "There is no such column."
    else:
        refused |= _unfit(table, {name: int(text) for name, text in chosen.items()}, texts["unit"])
    if texts["unit"] not in UNITS and in_si:
        refused["unit"] = f"The unit is one of {', '.join(UNITS)}."
    bearing = None
    if "shaft_speed" in numbers:
        try:
            bearing = bearing_of(texts, numbers["shaft_speed"], find)
        except ValueError as error:
            refused["bearing"] = sentence_of(error)
    if refused:
        raise FormError(refused)
    columns = tuple(int(text) for text in chosen.values())
    speed = 2.0 * math.pi * numbers["shaft_speed"]
    # [V/(m/s²)], of a number in mV/g
    sensitivity = 1e-3 * numbers["sensitivity"] / STANDARD_GRAVITY if voltage and in_si else None
    try:
        recording = table.recording(
            columns,
            list(chosen),
            texts["unit"] if in_si else "m/s²",  # as they are
            numbers["sample_rate"],
            numbers["full_scale"],
            sensitivity=sensitivity,
            shaft_speed=speed if speed_known else None,
        )
    except ValueError as error:
        raise FormError(
            {next(iter(chosen)): f"These columns are no signal: {_said_by(error)}."}
        ) from None
    origin = Origin(table.name, columns, texts["unit"], numbers["full_scale"], sensitivity)
    sized = recording if in_si else _without_size(recording)
    return FormResult(sized, speed, origin, in_si, bearing)


def bearing_of(
    texts: Mapping[str, str], turns: float, find: Callable[[str], CatalogueBearing]
) -> Bearing | None:
    """The bearing of a form at so many `turns` of the shaft a second; None: that of the scene.

    ValueError for frequencies that are those of no bearing, and for a name that is not known.
    """
    name = texts["bearing"]
    if name != BY_FREQUENCIES:
        return None if name == SCENE_BEARING else find(name).bearing
    orders = {key: _order(key, texts[key], turns) for key in FREQUENCIES if texts[key]}
    return bearing_of_frequencies(orders, PITCH_DIAMETER)


def _order(name: str, text: str, turns: float) -> float:
    """A frequency in turns of the shaft, out of "81.1 Hz" or "3.245 x"."""
    bare = re.sub(r"\s*(x|×|orders?)$", "", text.lower())
    least, most = 1e-3, 1e5
    if bare != text.lower():
        return number_of(bare, name.upper(), "", least, most)
    return number_of(bare, name.upper(), "Hz", least, most) / turns


def _without_size(recording: Recording) -> Recording:
    """The recording without notes about its size, which is not known."""
    doubts = {level_doubt(float(level)) for level in recording.acceleration.std(axis=0)}
    notes = tuple(note for note in recording.notes if note not in doubts)
    return dataclasses.replace(recording, notes=notes)


def _unfit(table: Table, chosen: Mapping[str, int], unit: str) -> dict[str, str]:
    """Sentences on columns that cannot be directions of one bearing's acceleration."""
    refused: dict[str, str] = {}
    columns = {name: table.contents.columns[index] for name, index in chosen.items()}
    places = {column.place for column in columns.values()} - {""}
    if len(places) > 1:
        refused["x"] = (
            f"These are sensors at two places ({' and '.join(sorted(places))}), not two directions "
            "of one bearing: choose one place."
        )
    units = {column.unit for column in columns.values()} - {None}
    if len(units) > 1:
        refused["x"] = (
            f"The headings give two units ({' and '.join(sorted(map(str, units)))}): choose one of "
            "these columns."
        )
    for name, column in columns.items():
        if column.unit is not None and column.unit not in UNITS:
            refused[name] = f"“{_short(column.name)}” is in {column.unit}: no acceleration."
        elif column.unit is not None and unit in UNITS and kind_of(column.unit) != kind_of(unit):
            refused["unit"] = (
                f"“{_short(column.name)}” says {column.unit}, which is no {kind_of(unit)}."
            )
    return refused


def _said_by(error: ValueError) -> str:
    """The refusal of a signal in words."""
    if isinstance(error, FieldError) and error.field == "acceleration":
        return f"the acceleration is {error.value}; allowed: {error.allowed_text}"
    return str(error)


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
        raise ValueError(
            f"{words} is {number(value, 6)} Hz; possible: {span(least, most, 'Hz', 6)}."
        )
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
        allowed = (
            span(least, most, unit, 6).rstrip()
            if math.isfinite(most)
            else f"at least {number(least, 6)} {unit}".rstrip()
        )
        raise ValueError(f"{words} is {number(value, 6)}; possible: {allowed}.")
    return value


def _is_index(text: str, count: int) -> bool:
    return text.isascii() and text.isdecimal() and len(text) < 5 and int(text) < count


def _short(name: str) -> str:
    return name if len(name) <= MOST_COLUMNS_NAMED else name[: MOST_COLUMNS_NAMED - 1] + "…"
