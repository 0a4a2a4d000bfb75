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
"""Largest number of files in a series."""

MOST_NUMBERS = 4_000_000
"""Largest count of numbers that a session keeps, in all tables of a series together."""

ROOM_FOR = 8
"""Number of files for which a series keeps room: a long table is cut to its share."""


def cut(table: Table, most: int) -> Table:
    """Return the table with at most `most` numbers; its last rows are left out."""
    rows = most // table.columns.shape[1]
    if len(table.columns) <= rows:
        return table
    return dataclasses.replace(table, columns=table.columns[:rows].copy())


@dataclass(frozen=True, eq=False)
class Series:
    """Files of a session, each as a table.

    Attributes
    ----------
    tables
        of the files, cut short where all together would be too long.
    left_out
        sentences on files that could not be read.
    together
        True if the files were chosen together, as a series.
    """

    tables: tuple[Table, ...] = ()
    left_out: tuple[str, ...] = ()
    together: bool = False

    def with_table(self, table: Table, count: int = 1) -> Series:
        """Return the series with one more file of `count`; it replaces a file of the same name."""
        table = cut(table, MOST_NUMBERS // max(count, ROOM_FOR))
        others = [other for other in self.tables if other.name != table.name]
        tables = [*others, table]
        while sum(kept.columns.size for kept in tables) > MOST_NUMBERS or len(tables) > MOST_FILES:
            tables.pop(0)
        return dataclasses.replace(self, tables=tuple(tables))

    def leave_out(self, sentence: str) -> Series:
        """Return the series with a sentence on a file that could not be read."""
        return dataclasses.replace(self, left_out=(*self.left_out, sentence))


@dataclass(frozen=True)
class SeriesRecordings:
    """Recordings of a series, the origin of each, and sentences on the files left out."""

    recordings: tuple[Recording, ...]
    origins: tuple[Origin | None, ...]
    left_out: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class ComputedTrend:
    """A trend, and the files and the shown signal that it was computed from."""

    trend: Trend
    recordings: SeriesRecordings
    series: Series
    measured: Measured

    @property
    def complete(self) -> bool:
        """True once the trend has a point for each recording."""
        return len(self.trend.points) == len(self.recordings.recordings)


def recordings_of(
    series: Series,
    shown: Measured,
    changed: Mapping[str, str],
    kept: Mapping[str, str],
    direction: str,
    scene: Machine,
) -> SeriesRecordings:
    """Return the recordings of a series along a direction; without files, the `shown` one.

    The form of each file is filled in from the file. Fields that a person `changed` for the shown
    file replace its values: columns and unit only in files of the same suffix and column names.
    `kept` holds answers on the machine for files that do not name theirs. A file whose unit differs
    or is not known cannot be compared and is left out. Recordings are sorted by date if all have
    one.
    """
    if not series.tables:
        return SeriesRecordings((shown.recording,), (shown.origin,), ())
    pairs: list[tuple[Recording, Origin | None]] = []
    left_out = list(series.left_out)
    families = {table.name: (Path(table.name).suffix, *table.names) for table in series.tables}
    family = families.get(shown.recording.name)
    general = {name: text for name, text in changed.items() if name not in ("unit", "columns")}
    for table in series.tables:
        answers = dict(changed if families[table.name] == family else general)
        if table.name != shown.recording.name:
            answers.pop("part", None)
        try:
            chosen, form = fill(table, answers)
            answer = read_form(chosen, {**form, **kept_answers(form, kept)}, scene)
        except FormError as error:
            why = str(error)
            left_out.append(why if why.startswith(table.name) else f"{table.name}: {why}")
            continue
        if answer.in_si != shown.in_si:
            left_out.append(f"{table.name}: its unit is not that of {shown.recording.name}.")
        elif direction not in answer.recording.directions:
            left_out.append(f"{table.name}: nothing is measured along {direction}.")
        else:
            speed = answer.machine.exact_speed
            recording = dataclasses.replace(answer.recording, shaft_speed=speed)
            pairs.append((recording, answer.origin))
    dates = {id(recording): recording.recorded for recording, _ in pairs}
    if None not in dates.values():
        pairs.sort(key=lambda pair: dates[id(pair[0])] or datetime.min)
    recordings, origins = zip(*pairs, strict=True) if pairs else ((), ())
    return SeriesRecordings(recordings, origins, tuple(left_out))
