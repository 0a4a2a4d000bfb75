"""The signal of a session in words: a summary, a line, and what is asked about its size."""

from __future__ import annotations

import math
from collections.abc import Mapping

from bearing_explorer.diagnosis.form import SIGNAL_FIELDS
from bearing_explorer.diagnosis.measurement_state import FIRST_WORDS
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.upload import NAME_IN_LINE, without_middle
from bearingcore import Table
from bearingcore.common import number, thousands, with_prefix

_WITHOUT_SIZE = (
    "The diagnosis of the damaged part does not depend on it. The size of the defect and the "
    "comparison with the model wait for the answer."
)


def about_size(sizes: Mapping[str, str]) -> str:
    """The questions about a signal's size, and what waits for the answers."""
    return " ".join([*sizes.values(), _WITHOUT_SIZE]) if sizes else ""


def _known_fields(table: Table, form: Mapping[str, str], first: Mapping[str, str]) -> set[str]:
    """Fields that the file says itself, or that a person has answered."""
    contents = table.contents
    said = {"unit": contents.unit, "sample_rate": contents.sample_rate}
    sure = {name for name, finding in said.items() if finding is not None and finding.stated}
    return sure | {name for name in form if form[name] != first.get(name)}


def name_of(measured: Measured, name: str = "") -> str:
    """The recording's name, or a shorter `name`, and which it is of several in the file."""
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
    pass_ = "ball passes" if round(passes) == 1 else "balls pass"
    return f"{words}, {thousands(passes)} {pass_} a point of the outer race."


def in_short(
    measured: Measured | None,
    table: Table | None,
    form: Mapping[str, str],
    first: Mapping[str, str],
    cut: str,
) -> dict[str, str]:
    """The signal in a line, and what is odd about it.

    `form` is as answered, `first` as the file filled it in; `cut` says what was left out of the
    file.
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
    asked = (
        {name for name in ("unit", "sample_rate") if name not in sure}
        | machine.guessed
        | machine.kept
    )
    asked |= {"speed"} if machine.shaft_speed is None else set()
    asked |= {"bearing"} if machine.bearing is None else set()
    words = [text + "?" * (name in asked) for name, text in facts.items()]
    return {
        "line": " · ".join(words),
        "whole_name": recording.name if name != recording.name else "",
        "remarks": " ".join((cut, *recording.notes)),
    }
