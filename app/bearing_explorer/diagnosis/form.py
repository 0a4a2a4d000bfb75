"""The questions that make a table of numbers a measurement, and guesses at their answers.

They ask for the role of each column (the time, the housing's acceleration along x or y, the shaft
speed, or nothing), for its unit and sample rate, and for the bearing and shaft speed, see
`machine`. The form holds text, as a person types it. An answer of a person takes precedence over
the file; where they differ, a note of the recording says so.

`questions` have to be answered before anything is drawn. `size_questions` are about the size of the
numbers, which is never guessed. Until they are answered, only results that do not depend on the
size are computed, from the numbers as they are in the file.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from bearing_explorer.diagnosis import machine
from bearing_explorer.diagnosis.machine import FormError, Machine
from bearing_explorer.diagnosis.signal import Measured, Origin
from bearing_explorer.kit.sentences import number_of, sentence_of
from bearingcore import Recording, Table, catalogue
from bearingcore.common import with_prefix
from bearingcore.errors import FieldError
from bearingcore.measured.files import (
    OTHER,
    SIGNAL,
    SPEED,
    SPEEDS,
    TIME,
    TIMES,
    UNITS,
    VOLTAGES,
    Column,
    Finding,
    kind_of,
    level_doubt,
    longest_run,
    unit_in,
)
from bearingcore.recordings import FEWEST_SAMPLES
from bearingcore.units import STANDARD_GRAVITY

SIGNAL_FIELDS = ("columns", "part", "unit", "full_scale", "sensitivity", "sample_rate")
"""Fields about the numbers of a file; those about the machine are `machine.FIELDS`."""
FIELDS = (*SIGNAL_FIELDS, *machine.FIELDS)
LONGEST_TEXT = 40
LONGEST_ROLES = 20_000
"""Longest text [characters] of a field, and of the field with the roles of all columns."""
NOTHING = ""
"""The role of a column that is not used."""
ROLES = (
    (NOTHING, "nothing"),
    ("y", "signal along y, up"),
    ("x", "signal along x, sideways"),
    ("time", "time"),
    *((f"time {unit}", f"time in {unit}") for unit in TIMES),
    *((f"speed {unit}", f"shaft speed in {unit}") for unit in SPEEDS),
)
"""Possible roles of a column, as the form has them and in words."""
DIRECTIONS = ("x", "y")
"""Roles that are signals; each may have its unit behind it: "x g"."""
SEPARATOR = ";"
"""Sign between the roles of the columns in their field."""
NOT_KNOWN = ""
"""A unit or a sensitivity that has not been answered."""
AS_HEADED = "units of their own"
"""The unit of two signals with different units, stated by their headings or by a person."""
WAYS, LIKELY = "Say it", "Likely"
"""Headings in the list of bearings."""
SIZES = ("unit", "sensitivity")
"""Fields that say how large the numbers of a file are."""

LONGEST_HEADING = 24  # characters

SHOWN_LINES = 5

MOST_SAID = 12
"""Most numbers and words of a file that are shown."""

_WORDS = {
    "sample_rate": ("The sample rate", "Hz", 1.0, 1e7),
    "full_scale": ("The value of a 1 in the file", "", 1e-12, 1e12),
    "sensitivity": ("The sensitivity of the sensor", "mV/g", 1e-3, 1e6),
}
USUAL_SENSITIVITY = 100
"""[mV/g]"""


def guess(table: Table) -> dict[str, str]:
    """Return the first values of the form: facts of the file, and good guesses."""
    contents = table.contents
    rate, sensor = contents.sample_rate, contents.sensitivity
    sensitivity = NOT_KNOWN if sensor is None else f"{1e3 * STANDARD_GRAVITY * sensor.value:.6g}"
    return {
        "columns": SEPARATOR.join(roles_of(table)),
        "part": "",
        "unit": _unit(table),
        "full_scale": "1",
        "sensitivity": sensitivity,
        "sample_rate": "" if rate is None else f"{rate.value:.8g}",
        **machine.guess(contents),
    }


def fill(table: Table, changed: Mapping[str, str]) -> tuple[Table, dict[str, str]]:
    """Return the table with the roles that a person gave its columns, and its form.

    Answers that a person `changed` stay; all others follow from the roles.

    Raises
    ------
    FormError
        for impossible roles, and for a recording that does not exist.
    """
    if "columns" in changed:
        table = give_roles(table, changed["columns"])
    if part := changed.get("part"):
        try:
            table = table.one_of_recordings(int(part))
        except ValueError:
            raise FormError({"part": f"{table.name} has no such recording."}) from None
    return table, {**guess(table), **changed}


def roles_of(table: Table) -> list[str]:
    """The role of each column, out of `ROLES`: as given, or guessed."""
    contents, roles = table.contents, []
    by_hand = any(column.role == SIGNAL for column in table.given.values())
    chosen = {} if by_hand else {i: axis for axis, i in contents.choice.columns.items()}
    for index, column in enumerate(contents.columns):
        role = chosen.get(index, NOTHING)
        if column.role == SIGNAL and index in table.given:
            role = column.direction
        elif column.role in (TIME, SPEED):
            role = f"{column.role} {column.unit or ''}".strip()
        roles.append(role)
    return roles


def give_roles(table: Table, text: str) -> Table:
    """Return the table with the roles in `text`; raise `FormError` for impossible ones."""
    roles, guessed = text.split(SEPARATOR), roles_of(table)
    if roles == guessed:
        return table
    known = {role for role, _ in ROLES} | {
        f"{axis} {unit}" for axis in DIRECTIONS for unit in UNITS
    }
    columns = table.contents.columns
    if len(roles) != len(guessed) or not known.issuperset(roles):
        raise FormError({"columns": f"{table.name} has other columns."})
    by_hand: dict[int | str, Column] = {}
    for index, (role, before) in enumerate(zip(roles, guessed, strict=True)):
        column, (kind, _, unit) = columns[index], role.partition(" ")
        if kind in DIRECTIONS:
            headed = column.unit if column.unit in UNITS else None
            by_hand[index] = Column("", SIGNAL, unit or headed, kind, column.place)
        elif role != before:
            by_hand[index] = Column("", kind if kind in (TIME, SPEED) else OTHER, unit or None)
    try:
        return table.with_columns(by_hand)
    except FieldError as error:
        raise FormError({"columns": sentence_of(error)}) from None


def change_role(
    roles: Sequence[str],
    units: Sequence[str],
    index: int,
    role: str,
    unit: str,
) -> dict[str, str]:
    """Return the fields "columns" and "unit" with another role or unit of a column.

    No other column keeps that role. Signals share one unit until a person gives them two.
    """
    kind = role.partition(" ")[0]
    roles = [NOTHING if kind and r.partition(" ")[0] == kind else r for r in roles]
    roles[index] = role
    units_of = {i: unit if i == index else units[i] for i, r in enumerate(roles) if r in DIRECTIONS}
    known = set(units_of.values()) - {NOT_KNOWN}
    if len(known) > 1:
        roles = [f"{r} {units_of.get(i, '')}".strip() for i, r in enumerate(roles)]
    unit_field = {"unit": AS_HEADED if len(known) > 1 else known.pop()} if known else {}
    return {"columns": SEPARATOR.join(roles), **unit_field}


def roles_and_units(text: str) -> tuple[list[str], list[str]]:
    """Split the field of roles into the roles and the units that a person gave signals."""
    roles = text.split(SEPARATOR)
    signals = [r.partition(" ") if r[:2] in ("x ", "y ") else (r, "", "") for r in roles]
    return [role for role, _, _ in signals], [unit for _, _, unit in signals]


def is_unchanged(name: str, text: str, first: str) -> bool:
    """True where a field has the value that the file alone gave it.

    The field of columns also holds units. They do not count here.
    """
    if name != "columns":
        return text == first
    return roles_and_units(text)[0] == roles_and_units(first)[0]


def _unit(table: Table) -> str:
    """Return the unit of the signals that the file states, or `NOT_KNOWN`."""
    contents = table.contents
    roles = zip(roles_of(table), contents.columns, strict=True)
    units = {column.unit for role, column in roles if role in DIRECTIONS}
    if len(units) > 1 and None not in units:
        return AS_HEADED
    return contents.unit.value if contents.unit.taken else NOT_KNOWN


def bearings_of(table: Table) -> list[list[str]]:
    """Rows [value, words, heading] of the bearings to choose from.

    The bearing of the file's collection comes before the other listed ones.
    """
    listed = table.contents.bearing
    likely = [] if listed is None else [listed.value]
    others = [name for name in catalogue() if name not in likely]
    return [
        [NOT_KNOWN, "choose", WAYS],
        [machine.BY_DESIGNATION, "by its designation", WAYS],
        [machine.BY_FREQUENCIES, "by its frequencies", WAYS],
        [machine.SCENE, "that of the scene", WAYS],
        *([name, name, LIKELY] for name in likely),
        *([name, name, "From the list"] for name in others),
    ]


def recordings_of(table: Table) -> list[list[str]]:
    """Rows [value, words] of the recordings in a file; none where there is only one."""
    rows = [f"{k}: rows {a + 1} to {b}" for k, (a, b) in enumerate(table.recordings, 1)]
    longest = [["", "the longest"]] if rows else []
    return [*longest, *([str(k), words] for k, words in enumerate(rows, 1))]


def speeds_of(table: Table) -> list[list[str]]:
    """Rows [value, words] of the answers on the shaft speed."""
    speed = table.contents.shaft_speed
    of_file = []
    if speed is not None:
        rpm = 30.0 / math.pi * speed.value
        words = f"{'from the file' if speed.stated else 'a guess from the file'}: {rpm:.4g} rpm"
        if not speed.supported:  # a tachometer may give several pulses a turn
            words = f"from the tachometer: about {float(f'{rpm:.3g}'):g} rpm"
        of_file = [[machine.FILE, words]]
    return [
        [NOT_KNOWN, "not known: find it"],
        *of_file,
        [machine.GIVEN, "given:"],
        [machine.ROUGH, "given, good to 10 %:"],
        [machine.SCENE, "that of the scene"],
    ]


def reasons(table: Table) -> dict[str, str]:
    """Reasons for the values of the form, by field: a statement of the file, or a guess."""
    contents = table.contents
    rate, speed, choice = contents.sample_rate, contents.shaft_speed, contents.choice
    texts = {"columns": choice.reason} if choice.reason else {}
    texts["unit"] = _reason(contents.unit) if contents.unit.taken else "The file does not say it."
    if _unit(table) == AS_HEADED:
        texts["unit"] = "From the heading of each column, or from the list above it."
    if not table.full_scale_known:
        texts["full_scale"] = "Full scale of the recorder, in the unit."
    sensor = contents.sensitivity
    texts["sensitivity"] = "See the label of the sensor." if sensor is None else _reason(sensor)
    texts["sample_rate"] = "The file does not say it." if rate is None else _reason(rate)
    if contents.frequencies:
        texts["bearing"] = "Its frequencies are in the file."
    elif contents.bearing is not None:
        texts["bearing"] = _reason(contents.bearing)
    elif contents.designation is not None and machine.guess(contents)["designation"]:
        texts["designation"] = _reason(contents.designation)
    if speed is not None:
        texts["speed"] = _reason(speed)
    return {name: words[:1].upper() + words[1:] for name, words in texts.items()}


def _reason(finding: Finding[Any]) -> str:
    return f"{'Said by' if finding.stated else 'A guess:'} {finding.reason}"


def questions(table: Table) -> dict[str, str]:
    """Questions to answer before the signal can be drawn, by field."""
    contents = table.contents
    asked: dict[str, str] = {}
    if not set(DIRECTIONS) & set(roles_of(table)):
        asked["columns"] = _which_column(table)
    rate = contents.sample_rate
    if rate is not None and not rate.taken:
        trouble = _faults(table)
        question = f"Is {rate.value:.6g} Hz the sample rate? A guess: {rate.reason}."
        asked["sample_rate"] = f"{trouble} {question}".strip()
    return asked


def _faults(table: Table) -> str:
    """Faults of the times of the file."""
    sampling = table.contents.sampling
    return "" if sampling is None else sampling.trouble


NO_SIGNAL = "Which column is the signal? Say it above the column."


def _which_column(table: Table) -> str:
    asked = "" if table.given else table.contents.choice.question
    return f"{asked} Say it above the columns." if asked.endswith("?") else asked or NO_SIGNAL


def proposed_unit(table: Table) -> str | None:
    """Return the likely unit, "" where none is likely; None if the file states the unit."""
    unit = table.contents.unit
    if unit.stated:
        return None
    return unit.value if unit.supported else ""


def size_questions(table: Table, form: Mapping[str, str]) -> dict[str, str]:
    """Questions to answer before the signal has a size, by field."""
    units = [unit for _, unit in _signals(table, form)] if form["unit"] == AS_HEADED else []
    if form["unit"] == NOT_KNOWN or None in units:
        likely = proposed_unit(table)
        why = f" {likely} is likely: {table.contents.unit.reason}." if likely else ""
        return {"unit": f"In what unit is it? The file does not say.{why}"}
    if is_voltage(table, form) and not form["sensitivity"].strip():
        return {
            "sensitivity": "What is the sensitivity of the sensor? See its label; "
            f"{USUAL_SENSITIVITY} mV/g is usual."
        }
    return {}


def is_voltage(table: Table, form: Mapping[str, str]) -> bool:
    """True where any of the signals that a form names is in volts."""
    if form["unit"] != AS_HEADED:
        return form["unit"] in VOLTAGES
    return any(unit in VOLTAGES for _, unit in _signals(table, form))


def _signals(table: Table, form: Mapping[str, str]) -> list[tuple[str, str | None]]:
    """Direction and unit of the columns that are signals."""
    roles = zip(roles_and_units(form["columns"])[0], table.contents.columns, strict=False)
    return [(role, column.unit) for role, column in roles if role in DIRECTIONS]


def other_facts(table: Table) -> str:
    """Other numbers and words of a file in a line, with its load in newtons."""
    contents = table.contents
    stated = [
        f"{_short(name)} {_short(text)}" for name, text in list(contents.said.items())[:MOST_SAID]
    ]
    words = f"The file says: {', '.join(stated)}." if stated else ""
    if contents.load is not None:
        words += f" Its load is {with_prefix(contents.load.value, 'N', 4)}."
    return words.strip()


def load_of(table: Table) -> float | None:
    """The load [N] that a file gives, where there is one."""
    load = table.contents.load
    return load.value if load is not None and load.value > 0.0 else None


@dataclass(frozen=True)
class ShownColumns:
    """The first lines of a file under the names and places of its columns, to choose their roles.

    `headed` are the units of signals by the names, `rows` is how many lines the file has.
    """

    names: list[str]
    places: list[str]
    headed: list[str]
    lines: list[list[str]]
    rows: int


def columns_of(table: Table) -> ShownColumns:
    """Describe the columns of a file for the page."""
    return ShownColumns(
        [_short(name) for name in table.names],
        [column.place for column in table.contents.columns],
        [unit if (unit := c.unit) in UNITS and unit else "" for c in table.contents.columns],
        [[_cell(value) for value in line] for line in table.first_rows[:SHOWN_LINES]],
        len(table.columns),
    )


def _cell(value: float) -> str:
    digits = 10 if abs(value) < 1e10 else 15  # milliseconds since 1970 have 13
    return f"{value:.{digits}g}" if np.isfinite(value) else "–"


def usable(table: Table) -> bool:
    """True where any of the columns could be a signal."""
    for column, signal in zip(table.contents.columns, table.columns.T, strict=True):
        first, last = longest_run(np.isfinite(signal))
        if column.role == TIME and len(table.names) > 1:
            continue
        if last - first >= FEWEST_SAMPLES and np.ptp(signal[first:last]) > 0.0:
            return True
    return False


def read_form(
    table: Table,
    form: Mapping[str, Any],
    scene: Machine,
) -> Measured:
    """Return the signal that a form describes; `FormError` with sentences where it describes none.

    Where its unit is not known the recording holds the numbers of the file. The shaft speed is in
    the machine, not in the recording.

    `scene` has the bearing and the speed of the scene, for a form that chooses them.
    """
    texts = bounded_texts(form, FIELDS)
    table = give_roles(table, texts["columns"])
    stated = table.contents.unit.stated
    in_si = not size_questions(table, texts) or (texts["unit"] == NOT_KNOWN and stated)
    # collect all refusals, so that the form shows them together
    numbers, refused = _numbers_of(table, texts, in_si and is_voltage(table, texts))
    chosen, trouble = _signal_columns(table, texts)
    if trouble:
        refused["columns"] = trouble
    if texts["unit"] not in (*UNITS, AS_HEADED) and in_si:
        refused["unit"] = f"The unit is one of {', '.join(UNITS)}."
    try:
        measured_machine = machine_of(table, texts, scene)
    except FormError as error:
        refused |= error.sentences
    if refused:
        raise FormError(refused)
    directions = sorted(chosen)
    columns = tuple(chosen[direction] for direction in directions)
    unit = None if texts["unit"] == AS_HEADED else texts["unit"]
    typed = numbers.get("sensitivity")  # [mV/g]
    sensitivity = None if typed is None else 1e-3 * typed / STANDARD_GRAVITY  # [V/(m/s²)]
    try:
        recording = table.recording(
            columns,
            directions,
            unit if in_si else "m/s²",  # so that the numbers stay as they are
            numbers["sample_rate"],
            numbers["full_scale"],
            sensitivity=sensitivity,
        )
    except ValueError as error:
        raise FormError({"columns": f"These columns are not signals: {_refusal(error)}."}) from None
    contents = table.contents
    places = sorted({contents.columns[i].place for i in columns} - {""})
    point = "" if contents.point is None else contents.point.value
    origin = Origin(
        table.name, columns, unit, numbers["full_scale"], sensitivity, dict(table.given),
        place=" and ".join(places) or point, part=int(texts["part"] or 0), which=table.which,
        machine="" if contents.machine is None else contents.machine.value,
    )  # fmt: skip
    notes = (*recording.notes, *_doubts(table, columns, unit))
    # turns of a measured shaft become those of the bearing's; the machine holds the speed
    recording = recording.scale_shaft(measured_machine.ratio)
    recording = dataclasses.replace(recording, shaft_speed=None, notes=notes)
    if not in_si:
        recording = _without_size(recording)
    return Measured(recording, measured_machine, origin=origin, in_si=in_si)


def _signal_columns(table: Table, texts: Mapping[str, str]) -> tuple[dict[str, int], str]:
    """Columns of the signal by direction, and a sentence where they are none."""
    roles, _ = roles_and_units(texts["columns"])
    chosen = {role: index for index, role in enumerate(roles) if role in DIRECTIONS}
    if not chosen:
        return chosen, _which_column(table)
    if len(chosen) < sum(role in DIRECTIONS for role in roles):
        return chosen, "Two columns are the signal along one direction: choose one of them."
    return chosen, ""


def _numbers_of(
    table: Table, texts: Mapping[str, str], by_sensitivity: bool
) -> tuple[dict[str, float], dict[str, str]]:
    """Numbers that were typed, by field, and sentences on texts that are no numbers."""
    numbers: dict[str, float] = {}
    refused: dict[str, str] = {}
    for name in _WORDS:
        if name == "sensitivity" and not by_sensitivity:
            continue
        try:
            numbers[name] = _read(name, texts)
        except ValueError as error:
            refused[name] = f"{_faults(table) if name == 'sample_rate' else ''} {error}".strip()
    return numbers, refused


def bounded_texts(form: Mapping[str, Any], names: Sequence[str]) -> dict[str, str]:
    """The fields of a form as texts of a bounded length."""
    longest = dict.fromkeys(names, LONGEST_TEXT) | {"columns": LONGEST_ROLES}
    return {name: str(form.get(name, ""))[: longest[name]].strip() for name in names}


def machine_of(
    table: Table,
    form: Mapping[str, str],
    scene: Machine,
) -> Machine:
    """The machine that a form describes, see `machine.read_machine`."""
    texts = {name: form[name] for name in machine.FIELDS}
    contents = table.contents
    return machine.read_machine(texts, machine.guess(contents), contents, scene)


def _without_size(recording: Recording) -> Recording:
    """The recording without notes about its size, which is not known."""
    doubts = {level_doubt(float(level)) for level in recording.acceleration.std(axis=0)}
    notes = tuple(note for note in recording.notes if note not in doubts)
    return dataclasses.replace(recording, notes=notes)


def _doubts(table: Table, chosen: Sequence[int], unit: str | None) -> list[str]:
    """Notes on headings that contradict the answers."""
    columns = [table.contents.columns[index] for index in chosen]
    places = sorted({column.place for column in columns} - {""})
    doubts = []
    if len(places) > 1:
        doubts.append(
            f"These are sensors at two places ({' and '.join(places)}); as you chose them they "
            "count as two directions of one bearing."
        )
    for name in (table.names[index] for index in chosen):
        headed = unit_in(name)
        if headed and unit and kind_of(headed) != kind_of(unit):
            doubts.append(f"The heading “{_short(name)}” says {headed}; {unit} is taken, as given.")
    return doubts


def _refusal(error: ValueError) -> str:
    """Return the refusal of a signal in words."""
    if isinstance(error, FieldError) and error.field == "acceleration":
        return f"the acceleration is {error.value}; allowed: {error.allowed_text}"
    return str(error)


def _read(name: str, texts: Mapping[str, str]) -> float:
    words, unit, least, most = _WORDS[name]
    if unit == "Hz" and re.search("rpm|min", texts[name], re.IGNORECASE):
        raise ValueError(f"{words} is in Hz, not in turns a minute.")
    return number_of(texts[name], words, unit, least, most)


def _short(name: str) -> str:
    return name if len(name) <= LONGEST_HEADING else name[: LONGEST_HEADING - 1] + "…"
