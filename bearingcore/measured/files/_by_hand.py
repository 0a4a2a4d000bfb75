"""A recording out of a file in one call, with whatever is known of it said by hand."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from bearingcore.common import _checks as checks
from bearingcore.measured.files._channels import OTHER, SIGNAL, SPEED, TIME, Column
from bearingcore.measured.files._table import Table, path_in, read_table
from bearingcore.measured.files._units import PULSE_TRAIN, SPEEDS
from bearingcore.recordings import Recording

OneOrMore = int | str | Sequence[int | str] | None


def read_recording(
    file: str | os.PathLike[str],
    content: bytes | None = None,
    *,
    columns: Mapping[str, OneOrMore] | None = None,
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
        roles "signal" (one or more), "time", "speed" and "nothing", each with columns by number
        from 0 or by name. Roles that are left out follow the file; None under "time" or "speed"
        means that no column has it.
    directions
        "x" or "y" of each signal; "xy" is both.
    time_unit, unit, speed_unit
        of these columns: one of `units.TIMES`, `units.UNITS`, `units.SPEEDS`; a speed may be in
        "pulses" too, those of a tachometer or an encoder.
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
    if content is None:
        try:
            content = Path(path_in(os.fspath(file))).read_bytes()
        except OSError as error:
            raise checks.refuse(
                "file", os.fspath(file), f"one to read ({error.strerror})"
            ) from None
    path = os.fspath(file)
    table = read_table(path if ".zip/" in path else Path(path).name, content)
    table = _assign_roles(table, columns or {}, time_unit, unit, speed_unit)
    return _recording(
        table if part is None else table.one_of_recordings(part),
        _listed((columns or {}).get("signal")),
        directions,
        unit,
        sample_rate=sample_rate,
        full_scale=full_scale,
        sensitivity=sensitivity,
        shaft_speed=shaft_speed,
    )


def _listed(columns: OneOrMore) -> list[int | str]:
    return [columns] if isinstance(columns, int | str) else list(columns or ())


def _assign_roles(
    table: Table,
    columns: Mapping[str, OneOrMore],
    time_unit: str | None,
    unit: str | None,
    speed_unit: str | None,
) -> Table:
    """The table with the roles that are given."""
    for role in columns:
        checks.choice("columns", role, ("signal", "time", "speed", "nothing"))
    if columns.get("speed") is not None and speed_unit is None:
        raise checks.missing("speed_unit", "one of " + ", ".join((*SPEEDS, PULSE_TRAIN)))
    guessed = table.contents.columns
    given: dict[int | str, Column] = {}
    for role, key, of_role in (
        (SIGNAL, "signal", unit), (TIME, "time", time_unit), (SPEED, "speed", speed_unit),
        (OTHER, "nothing", None),
    ):  # fmt: skip
        if key in columns and role in (TIME, SPEED):  # it is this one, or none
            given |= {i: Column("", OTHER) for i, one in enumerate(guessed) if one.role == role}
        for column in _listed(columns.get(key)):
            index = table.index_of(column)
            known = guessed[index]
            fits = known.role == role
            given[index] = Column(
                "",
                role,
                of_role or (known.unit if fits else None),
                known.direction if role == SIGNAL else "",
            )
    if time_unit is not None and "time" not in columns:
        timed = [index for index, column in enumerate(guessed) if column.role == TIME]
        given |= {index: Column("", TIME, time_unit) for index in timed[:1]}
    return table.with_columns(given)


def _recording(
    table: Table,
    signals: Sequence[int | str],
    directions: str | Sequence[str] | None,
    unit: str | None,
    **given: Any,
) -> Recording:
    """The recording of the signals given, or of those the file speaks for."""
    choice = table.contents.choice
    picked = [table.index_of(column) for column in signals] or list(choice.columns.values())
    if not picked:
        names = ", ".join(table.names)
        raise checks.missing("columns", f'"signal" with one or two of {names}. {choice.question}')
    if directions is None:
        named = {index: axis for axis, index in choice.columns.items()}
        known = [named.get(i) or table.contents.columns[i].direction for i in picked]
        directions = ["y"] if len(picked) == 1 else known
    return table.recording(picked, list(directions), unit, **given)
