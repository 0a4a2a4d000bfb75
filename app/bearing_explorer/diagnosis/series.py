"""Files of one machine in their order, and the recordings in them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from bearing_explorer.diagnosis.form import fill, read_form
from bearing_explorer.diagnosis.machine import FormError, Machine, kept_answers
from bearing_explorer.diagnosis.signal import Measured, Origin
from bearingcore import Recording, Table, Trend

MOST_FILES = 200
"""Of a series."""

MOST_NUMBERS = 4_000_000
"""Of all tables of a series that a session keeps."""

ROOM_FOR = 8
"""Files at least for which there is room in a series."""


@dataclass(frozen=True, eq=False)
class Series:
    """Files of a session, a table each.

    Attributes
    ----------
    tables
        what they hold, shortened where all would be too long.
    left_out
        sentences on files that could not be read.
    together
        whether they were chosen together, as a series.
    """

    tables: tuple[Table, ...] = ()
    left_out: tuple[str, ...] = ()
    together: bool = False

    def with_table(self, table: Table, count: int = 1) -> Series:
        """With a further file, of `count` that come; it replaces an earlier one of its name."""
        rows, columns = table.columns.shape
        most = MOST_NUMBERS // max(count, ROOM_FOR) // columns
        if rows > most:
            table = dataclasses.replace(table, columns=table.columns[:most].copy())
        others = [one for one in self.tables if one.name != table.name]
        tables = [*others, table]
        while sum(one.columns.size for one in tables) > MOST_NUMBERS or len(tables) > MOST_FILES:
            tables.pop(0)
        return dataclasses.replace(self, tables=tuple(tables))

    def without(self, sentence: str) -> Series:
        """With a sentence on a file that could not be read."""
        return dataclasses.replace(self, left_out=(*self.left_out, sentence))


@dataclass(frozen=True)
class SeriesRecordings:
    """The recordings of a series, each with the origin of its numbers, and files left out."""

    recordings: tuple[Recording, ...]
    origins: tuple[Origin | None, ...]
    left_out: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class FoundTrend:
    """A trend, of which files it is, and what was left out."""

    trend: Trend
    recordings: SeriesRecordings
    series: Series
    measured: Measured

    @property
    def complete(self) -> bool:
        """Whether all recordings are in it."""
        return len(self.trend.points) == len(self.recordings.recordings)


def recordings_of(
    series: Series,
    shown: Measured,
    changed: Mapping[str, str],
    kept: Mapping[str, str],
    direction: str,
    scene: Machine,
) -> SeriesRecordings:
    """The recordings of a series along a direction; without files the one that is shown.

    Each file is read as it proposes itself, but for the fields that a person `changed` for the one
    that is `shown`; `kept` are answers on the machine for those that say nothing of it. Columns and
    a unit that a person gave hold for files of the same kind and columns. In another unit, or one
    that is not known, a file cannot be compared and is left out. They are in the order of their
    dates where all have one.
    """
    if not series.tables:
        return SeriesRecordings((shown.recording,), (shown.origin,), ())
    read: list[tuple[Recording, Origin | None]] = []
    left_out = list(series.left_out)
    families = {table.name: (Path(table.name).suffix, *table.names) for table in series.tables}
    family = families.get(shown.recording.name)
    for_others = {name: text for name, text in changed.items() if name not in ("unit", "columns")}
    for table in series.tables:
        answers = dict(changed if families[table.name] == family else for_others)
        if table.name != shown.recording.name:
            answers.pop("part", None)
        try:
            told, form = fill(table, answers)
            answer = read_form(told, {**form, **kept_answers(form, kept)}, scene)
        except FormError as error:
            words = str(error)
            left_out.append(words if words.startswith(table.name) else f"{table.name}: {words}")
            continue
        if answer.in_si != shown.in_si:
            left_out.append(f"{table.name}: its unit is not that of {shown.recording.name}.")
        elif direction not in answer.recording.directions:
            left_out.append(f"{table.name}: nothing is measured along {direction}.")
        else:
            speed = answer.machine.exact_speed
            recording = dataclasses.replace(answer.recording, shaft_speed=speed)
            read.append((recording, answer.origin))
    dates = {id(recording): recording.recorded for recording, _ in read}
    if None not in dates.values():
        read.sort(key=lambda pair: dates[id(pair[0])] or datetime.min)
    recordings, origins = zip(*read, strict=True) if read else ((), ())
    return SeriesRecordings(recordings, origins, tuple(left_out))
