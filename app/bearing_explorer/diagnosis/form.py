"""The questions that make a table of numbers a measurement, and guesses at their answers.

Which columns are the housing's acceleration along x and y, in what unit, how often it was sampled;
which bearing and shaft speed it was, see `machine`. The form holds text, as a person types it.

`questions` have to be answered before anything is drawn. `size_questions` are about the size of the
numbers, which is never guessed; until they are answered the numbers are taken as they are, for what
does not depend on it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from bearing_explorer.diagnosis import machine
from bearing_explorer.diagnosis.machine import FormError, Machine, find_published
from bearing_explorer.diagnosis.signal import Origin
from bearing_explorer.kit.typed_number import number_of
from bearingcore import CatalogueBearing, Recording, Table, catalogue
from bearingcore.common import with_prefix
from bearingcore.errors import FieldError
from bearingcore.files import (
    STANDARD_GRAVITY,
    UNITS,
    VOLTAGES,
    Finding,
    kind_of,
    level_doubt,
    longest_run,
)
from bearingcore.signals import FEWEST_SAMPLES

SIGNAL_FIELDS = ("x", "y", "unit", "full_scale", "sensitivity", "sample_rate")
"""Fields about the numbers of a file; those about the machine are `machine.FIELDS`."""
FIELDS = (*SIGNAL_FIELDS, *machine.FIELDS)
LONGEST_TEXT = 40
NONE = ""
"""The choice of no column."""
NOT_KNOWN = ""
"""A unit or a sensitivity that has not been answered."""
WAYS, LIKELY = "Say it", "Likely"
"""Headings in the list of bearings."""
SIZES = ("unit", "sensitivity")
"""Fields that say how large the numbers of a file are."""

MOST_COLUMNS_NAMED = 24  # characters of a heading in a list

MOST_SAID = 12
"""Numbers and words of a file that are shown."""

_WORDS = {
    "sample_rate": ("The sample rate", "Hz", 10.0, 1e7),
    "full_scale": ("The value of a 1 in the file", "", 1e-12, 1e12),
    "sensitivity": ("The sensitivity of the sensor", "mV/g", 1e-3, 1e6),
}
USUAL_SENSITIVITY = 100
"""[mV/g]"""


@dataclass(frozen=True)
class FormResult:
    """A form as it is read: a recording, its origin, and the machine.

    Without `in_si` the recording holds the numbers of the file: their unit is not known. The
    recording carries no shaft speed: it is that of the machine, where it is known.
    """

    recording: Recording
    origin: Origin
    machine: Machine
    in_si: bool = True


def guess(table: Table) -> dict[str, str]:
    """The first values of the form: what the file says, and good guesses."""
    contents = table.contents
    rate = contents.sample_rate
    chosen = contents.choice.columns
    return {
        "x": str(chosen.get("x", NONE)),
        "y": str(chosen.get("y", NONE)),
        "unit": contents.unit.value if contents.unit.taken else NOT_KNOWN,
        "full_scale": "1",
        "sensitivity": NOT_KNOWN,
        "sample_rate": "" if rate is None else f"{rate.value:.8g}",
        **machine.guess(contents),
    }


def bearings_of(
    table: Table | None, found: Sequence[str] = (), own: Sequence[str] = ()
) -> list[list[str]]:
    """[value, words, heading] of the bearings to choose from.

    The one of the file's collection and those that were `found` to explain the signal come first;
    `own` are those of a person's table.
    """
    listed = None if table is None else table.contents.bearing
    likely = dict.fromkeys([*([] if listed is None else [listed.value]), *found])
    others = dict.fromkeys(name for name in (*own, *catalogue()) if name not in likely)
    return [
        [NOT_KNOWN, "choose", WAYS],
        [machine.BY_DESIGNATION, "by its designation", WAYS],
        [machine.BY_FREQUENCIES, "by its frequencies", WAYS],
        [machine.SCENE, "that of the scene", WAYS],
        *([name, name, LIKELY] for name in likely),
        *([name, name, "From the list"] for name in others),
    ]


def speeds_of(table: Table | None) -> list[list[str]]:
    """[value, words] of the answers on the shaft speed."""
    speed = None if table is None else table.contents.shaft_speed
    of_file = []
    if speed is not None:
        words = "from the file" if speed.stated else "a guess from the file"
        of_file = [[machine.FILE, f"{words}: {machine.written(speed)}"]]
    return [
        [NOT_KNOWN, "not known: find it"],
        *of_file,
        [machine.GIVEN, "given:"],
        [machine.ROUGH, "given, good to 10 %:"],
        [machine.SCENE, "that of the scene"],
    ]


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
    if speed is not None:
        found["speed"] = _because(speed)
    return {name: words[:1].upper() + words[1:] for name, words in found.items()}


def _because(finding: Finding[Any]) -> str:
    return f"{'Said by' if finding.stated else 'A guess:'} {finding.reason}"


def questions(table: Table) -> dict[str, str]:
    """Questions to answer before the signal can be drawn, by field."""
    contents = table.contents
    asked: dict[str, str] = {}
    choice = contents.choice
    if choice.question:
        asked["y"] = choice.question
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
        if column.role != "time":
            first, last = longest_run(np.isfinite(signal))
            if last - first >= FEWEST_SAMPLES and np.ptp(signal[first:last]) > 0.0:
                return True
    return False


def read_form(
    table: Table,
    form: Mapping[str, Any],
    scene: Machine,
    find: Callable[[str], CatalogueBearing] = find_published,
) -> FormResult:
    """The recording that a form describes; `FormError` with sentences where it describes none.

    `scene` has the bearing and the speed of the scene, see `machine.of_scene`, for a form that says
    so; `find` gives the bearing of a name.
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
            numbers[name] = _read(name, texts)
        except ValueError as error:
            refused[name] = str(error)
    chosen = {name: texts[name] for name in ("x", "y") if texts[name] != NONE}
    if not chosen:
        refused["y"] = (
            table.contents.choice.question or "Choose the column of at least one direction."
        )
    elif len(set(chosen.values())) < len(chosen):
        refused["x"] = "x and y cannot be the same column."
    elif not all(_is_index(text, len(table.names)) for text in chosen.values()):
        refused["y"] = "There is no such column."
    else:
        refused |= _unfit(table, {name: int(text) for name, text in chosen.items()}, texts["unit"])
    if texts["unit"] not in UNITS and in_si:
        refused["unit"] = f"The unit is one of {', '.join(UNITS)}."
    try:
        found_machine = machine_of(table, texts, scene, find)
    except FormError as error:
        refused |= error.sentences
    if refused:
        raise FormError(refused)
    columns = tuple(int(text) for text in chosen.values())
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
        )
    except ValueError as error:
        raise FormError(
            {next(iter(chosen)): f"These columns are no signal: {_said_by(error)}."}
        ) from None
    origin = Origin(table.name, columns, texts["unit"], numbers["full_scale"], sensitivity)
    sized = dataclasses.replace(recording, shaft_speed=None)
    return FormResult(sized if in_si else _without_size(sized), origin, found_machine, in_si)


def machine_of(
    table: Table,
    form: Mapping[str, str],
    scene: Machine,
    find: Callable[[str], CatalogueBearing] = find_published,
) -> Machine:
    """The machine that a form describes, see `machine.read_machine`."""
    texts = {name: form[name] for name in machine.FIELDS}
    contents = table.contents
    return machine.read_machine(texts, machine.guess(contents), contents, scene, find)


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


def _is_index(text: str, count: int) -> bool:
    return text.isascii() and text.isdecimal() and len(text) < 5 and int(text) < count


def _short(name: str) -> str:
    return name if len(name) <= MOST_COLUMNS_NAMED else name[: MOST_COLUMNS_NAMED - 1] + "…"
