"""A recording from a file in one call, with facts that a person gives."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from bearingcore.common import _checks as checks
from bearingcore.measured.files._channels import OTHER, SIGNAL, SPEED, TIME, Column
from bearingcore.measured.files._table import Table, check_bytes, path_in, read_table
from bearingcore.measured.files._units import PULSE_TRAIN, SPEEDS, kind_of
from bearingcore.recordings import Recording

OneOrMore = int | str | Sequence[int | str] | None


def read_recording(
    file: str | os.PathLike[str],
    content: bytes | None = None,
    *,
    columns: Mapping[str, OneOrMore] | OneOrMore = None,
    directions: str | Sequence[str] | None = None,
    time_unit: str | None = None,
    unit: str | None = None,
    speed_unit: str | None = None,
    sample_rate: float | None = None,
    shaft_speed: float | None = None,
    full_scale: float = 1.0,
    sensitivity: float | None = None,
    part: int | None = None,
) -> Recording:
    """Read the acceleration in a file. Arguments take precedence over statements of the file.

    Parameters
    ----------
    file
        its path, or its name if `content` is given.
    content
        the bytes of the file.
    columns
        the signals, by number from 0 or by name; or roles "signal" (one or more), "time", "speed"
        and "nothing", each with its columns. Roles that are left out follow the file; None for
        "time" or "speed" means that no column has this role.
    directions
        "x" or "y" of each signal; "xy" is both.
    time_unit, unit, speed_unit
        units of these columns: one of `TIMES`, `UNITS` or `SPEEDS`; a speed may also be in
        "pulses", those of a tachometer or an encoder.
    sample_rate
        [Hz]
    shaft_speed
        [rad/s]
    full_scale, sensitivity
        see `Table.recording`.
    part
        number of the recording in the file, from 1; None takes the longest.

    Returns
    -------
    Recording
        the longest part without a gap; its notes list omissions.

    Raises
    ------
    FieldError
        for a file that cannot be read, or for a fact that is missing; the error names the argument.

    Examples
    --------
    ``read_recording("run.csv", columns={"time": 0, "signal": 2}, time_unit="ms", unit="g")``
    """
    table = table_at(file) if content is None else read_table(os.fspath(file), content)
    roles = columns if isinstance(columns, Mapping) else {"signal": columns}
    table = _assign_roles(table, roles, time_unit, unit, speed_unit)
    return recording_of(
        table if part is None else table.one_of_recordings(part),
        roles.get("signal"),
        directions,
        unit,
        sample_rate=sample_rate,
        full_scale=full_scale,
        sensitivity=sensitivity,
        shaft_speed=shaft_speed,
    )


def table_at(file: str | os.PathLike[str]) -> Table:
    """Read the table of a file by its path, which may lead into a zip.

    Raises
    ------
    FieldError
        for a file that does not exist, or that `read_table` refuses.
    """
    path = os.fspath(file)
    try:
        place = Path(path_in(path))
        check_bytes(place.name, place.stat().st_size)
        content = place.read_bytes()
    except OSError as error:
        raise checks.refuse("file", path, f"one to read ({error.strerror})") from None
    return read_table(path if ".zip/" in path else Path(path).name, content)


def _as_list(columns: OneOrMore) -> list[int | str]:
    return [columns] if isinstance(columns, int | str) else list(columns or ())


def _assign_roles(
    table: Table,
    columns: Mapping[str, OneOrMore],
    time_unit: str | None,
    unit: str | None,
    speed_unit: str | None,
) -> Table:
    """Return the table with the given roles; a role replaces the file's guesses."""
    for role in columns:
        checks.choice("columns", role, (SIGNAL, TIME, SPEED, "nothing"))
    if columns.get("speed") is not None and speed_unit is None:
        raise checks.missing("speed_unit", "one of " + ", ".join((*SPEEDS, PULSE_TRAIN)))
    guessed = table.contents.columns
    assigned: dict[int | str, Column] = {}
    units = {SIGNAL: unit, TIME: time_unit, SPEED: speed_unit, "nothing": None}
    for key in (name for name in units if name in columns):
        role = OTHER if key == "nothing" else key
        if role in (TIME, SPEED):  # no other column keeps this role
            assigned |= {i: Column("", OTHER) for i, c in enumerate(guessed) if c.role == role}
        for index in map(table.index_of, _as_list(columns[key])):
            column = guessed[index]
            file_unit = column.unit if column.role == role else None
            direction = column.direction if role == SIGNAL else ""
            assigned[index] = Column("", role, units[key] or file_unit, direction)
    if time_unit is not None and "time" not in columns:
        timed = [index for index, column in enumerate(guessed) if column.role == TIME]
        assigned |= {index: Column("", TIME, time_unit) for index in timed[:1]}
    return table.with_columns(assigned)


def recording_of(
    table: Table,
    columns: OneOrMore,
    directions: str | Sequence[str] | None = None,
    unit: str | None = None,
    *,
    sample_rate: float | None = None,
    sensitivity: float | None = None,
    with_guesses: bool = False,
    **more: Any,
) -> Recording:
    """Return the recording of the signals in some columns, or in those that the file chooses.

    Parameters
    ----------
    columns, directions, unit, sample_rate, sensitivity, more
        see `Table.recording`.
    with_guesses
        True if the scale of the signal does not matter: missing units and directions are assumed,
        and likely rates are used.

    Raises
    ------
    FieldError
        for a missing fact, naming the argument.
    """
    contents = table.contents
    choice, rate = contents.choice, contents.sample_rate
    picked = [table.index_of(column) for column in _as_list(columns)]
    picked = picked or list(choice.columns.values())
    if not picked:
        options = choice.options or range(len(table.names))
        names = ", ".join(f"{index} (“{table.names[index]}”)" for index in options)
        words = f"{table.name}: {choice.question or choice.reason}"
        if not choice.options:  # no column looks like a vibration
            raise ValueError(f"{words} If one is a signal nevertheless, pass columns=...: {names}.")
        raise checks.missing("columns", f"one or two signals of {names}. {words}")
    if directions is None:
        by_choice = {index: axis for axis, index in choice.columns.items()}
        known = [by_choice.get(index) or contents.columns[index].direction for index in picked]
        is_assumed = len(picked) == 1 or (with_guesses and not all(known))
        directions = ("x", "y")[-len(picked) :] if is_assumed else known
    if with_guesses:
        if unit is None and not all(contents.columns[index].unit for index in picked):
            unit = contents.unit.value if contents.unit.taken else "m/s²"
        units = [unit or contents.columns[index].unit or "" for index in picked]
        if (sensitivity or contents.sensitivity) is None and "voltage" in map(kind_of, units):
            unit = "m/s²"  # without the sensor's sensitivity, volts are used as they are
        if sample_rate is None and rate is not None and rate.taken:
            sample_rate = rate.value
    return table.recording(
        picked, list(directions), unit, sample_rate, sensitivity=sensitivity, **more
    )
