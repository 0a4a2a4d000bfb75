"""The state of the panels of a measurement, as values, and the signal in words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from bearing_explorer.diagnosis.form import SIGNAL_FIELDS, ShownColumns
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.upload import NAME_IN_LINE, without_middle
from bearingcore import Table
from bearingcore.common import number, thousands, with_prefix

FIRST_WORDS = (
    "No signal yet. Once there is one, the damaged part, the length of its spall, trend, "
    "indicators and spectra appear here."
)

REFUSED = "An answer on bearing, speed or columns is refused; this uses the previous one."
CHANGED = "Your answers have changed since."
NOT_YET = "The signal is being analysed with the newest answers."
"""Reasons why an answer is out of date, or not there yet."""

_WITHOUT_SIZE = (
    "The diagnosis of the damaged part does not depend on it. The size of the defect and the "
    "comparison with the model wait for the answer."
)


@dataclass(frozen=True)
class MeasurementState:
    """The state of the panels of a measurement."""

    words: str = FIRST_WORDS
    bad: bool = False
    #: the first lines of a file that is refused
    lines: str = ""
    busy: bool = False
    columns: ShownColumns | None = None
    values: dict[str, str] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    #: reasons for the values of the fields
    reasons: dict[str, str] = field(default_factory=dict)
    #: fields that a person has to answer: before the signal is taken, or before it has a size
    open: list[str] = field(default_factory=list)
    #: the likely unit, "" where none is likely; None if the file states the unit
    proposed: str | None = None
    #: other numbers and words of the file
    facts: str = ""
    #: [N] in the file, None where it has none
    load: float | None = None
    scaled: bool = False
    #: True if the signal is in volts, so that the sensitivity of the sensor is needed
    voltage: bool = False
    #: bearings to choose from, as [value, words, heading], and answers on the speed
    bearings: list[list[str]] = field(default_factory=list)
    #: recordings in the file, as [value, words], where there are several
    recordings: list[list[str]] = field(default_factory=list)
    speeds: list[list[str]] = field(default_factory=list)
    #: True while changed answers are being read
    settling: bool = False
    #: name of the previous file, if bearing or speed are kept from it
    kept_from: str = ""
    #: the drawn signal in a line; a guess has a question mark. Empty without a signal
    line: str = ""
    #: the whole name of its file, if the line shortens it
    whole_name: str = ""
    #: sentences on oddities of the signal
    remarks: str = ""
    #: number of the file or simulation that is shown
    arrival: int = 0


@dataclass(frozen=True)
class AboutMeasurement:
    """Words for reports, which a person types once for all files of a session."""

    machine: str = ""
    point: str = ""
    date: str = ""


def about_size(sizes: Mapping[str, str]) -> str:
    """The questions about a signal's size, and what waits for the answers."""
    return " ".join([*sizes.values(), _WITHOUT_SIZE]) if sizes else ""


def _known_fields(table: Table, form: Mapping[str, str], first: Mapping[str, str]) -> set[str]:
    """Fields that the file says itself, or that a person has answered."""
    contents = table.contents
    findings = {"unit": contents.unit, "sample_rate": contents.sample_rate}
    sure = {name for name, finding in findings.items() if finding is not None and finding.stated}
    return sure | {name for name in form if form[name] != first.get(name)}


def name_of(measured: Measured, name: str = "") -> str:
    """The recording's name, or a shorter `name`, and its place among several in the file."""
    which = "" if measured.origin is None else measured.origin.which
    return ", ".join(filter(None, (name or measured.recording.name, which)))


def summary(measured: Measured | None) -> str:
    """The signal in a sentence."""
    if measured is None:
        return FIRST_WORDS
    recording, machine = measured.recording, measured.machine
    along = measured.along(" and ".join(recording.directions))
    words = (
        f"{name_of(measured)}: {with_prefix(recording.duration, 's')}{along} at "
        f"{thousands(recording.sample_rate)} Hz"
    )
    if machine.bearing is None or machine.shaft_speed is None:
        return f"{words}."
    passes = recording.duration * machine.bearing.bpfo(machine.shaft_speed)
    verb = "ball passes" if round(passes) == 1 else "balls pass"
    return f"{words}, {thousands(passes)} {verb} a point of the outer race."


def line_and_remarks(
    measured: Measured | None,
    table: Table | None,
    form: Mapping[str, str],
    first: Mapping[str, str],
    cut: str,
) -> dict[str, str]:
    """The signal in a line, and its oddities in sentences.

    `form` has the answers, `first` the values from the file; `cut` is the sentence on rows that
    were left out.
    """
    if measured is None:
        return {"line": "", "whole_name": "", "remarks": ""}
    recording, machine = measured.recording, measured.machine
    long = len(recording.name) if table is None else NAME_IN_LINE
    name = without_middle(recording.name, long)
    sure = set(SIGNAL_FIELDS) if table is None else _known_fields(table, form, first)
    unit = form.get("unit", "m/s²") or "unit"
    speed = "speed"
    if machine.shaft_speed is not None:
        speed = f"{number(30.0 / math.pi * machine.shaft_speed, 4)} rpm"
        speed += f" ({number(machine.ratio, 4)} ×)" if machine.ratio != 1.0 else ""
    facts = {
        "": name_of(measured, name),
        "duration": with_prefix(recording.duration, "s", 3),
        "sample_rate": with_prefix(recording.sample_rate, "Hz", 4),
        "speed": speed,
        "unit": unit,
        "bearing": machine.bearing_name
        or ("bearing" if machine.bearing is None else "the scene's bearing"),
    }
    asked = machine.guessed | machine.kept | ({"unit", "sample_rate"} - sure)
    asked |= {"speed"} if machine.shaft_speed is None else set()
    asked |= {"bearing"} if machine.bearing is None else set()
    words = [text + "?" * (name in asked) for name, text in facts.items()]
    return {
        "line": " · ".join(words),
        "whole_name": recording.name if name != recording.name else "",
        "remarks": " ".join((cut, *recording.notes)),
    }
