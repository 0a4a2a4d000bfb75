"""Reading a file as a signal, with guesses at its contents or with the answers of a person.

For any thread: nothing here knows a session.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from types import MappingProxyType

from bearing_explorer.diagnosis.form import fill, questions, read_form, size_questions, usable
from bearing_explorer.diagnosis.machine import (
    FIELDS as MACHINE_FIELDS,
    NOT_KNOWN,
    FormError,
    Machine,
    kept_answers,
)
from bearing_explorer.diagnosis.series import MOST_FILES, MOST_NUMBERS, Series, cut
from bearing_explorer.diagnosis.signal import Measured
from bearingcore import Table, read_table
from bearingcore.common import thousands
from bearingcore.errors import FieldError
from bearingcore.measured.files import files_inside

log = logging.getLogger(__name__)

MOST_NAMED = 3
"""Greatest number of left-out files that are named."""


@dataclass
class Arrival:
    """Files that arrive one after the other: file `number` of `count`, out of all `chosen` ones.

    `why`: the sentence on the first file that cannot be read. `lines`: its first lines, if it came
    alone.
    """

    count: int
    chosen: int
    series: Series
    number: int = 1
    newest: Read | None = None
    why: str = ""
    lines: str = ""

    @property
    def words(self) -> str:
        """Number of the file and of all, in words; empty for a single file."""
        if self.count == 1:
            return ""
        of = f" (out of {self.chosen}, evenly spread)" if self.chosen > self.count else ""
        return f"{self.number} of {self.count} files{of}: "

    @property
    def notes(self) -> str:
        """Sentences on left-out rows; for several files, also on the shown and left-out files."""
        if self.newest is None:
            return ""
        words, count = [self.newest.cut], len(self.series.tables)
        if self.series.together and count > 1:
            words.append(f"{self.newest.table.name} is shown, the last of {count} files.")
        if self.series.together and self.series.left_out:
            words.append(f"Left out: {' '.join(self.series.left_out[:MOST_NAMED])}")
            if (more := len(self.series.left_out) - MOST_NAMED) > 0:
                words.append(f"And {more} more.")
        return " ".join(filter(None, words))

    def take(self, name: str, read: Read | str, inside: int = 1) -> None:
        """Take a file that was read, or the reason why not; a zip has several files `inside`."""
        if inside > 1 and self.count == 1 and not self.series.together:
            self.series = Series(together=True)  # the files of a zip
        if isinstance(read, str):
            sentence = read if name in read else f"{name}: {read}"
            self.series, self.why = self.series.leave_out(sentence), self.why or sentence
        else:
            self.series = self.series.with_table(read.table, self.count * inside)
            if self.newest is None or read.recorded >= self.newest.recorded:
                self.newest = read


@dataclass(frozen=True)
class Read:
    """A file's table, the form on it, and the signal that they describe.

    Attributes
    ----------
    table
        with the roles that the form gives its columns.
    first
        the form as the file alone fills it in.
    form
        the form with the answers.
    signal
        None where the form describes none.
    refused
        sentences on answers that cannot be used, by field.
    cut
        sentence on rows that were left out.
    kept
        answers for the previous file that the form takes over.
    """

    table: Table
    first: dict[str, str]
    form: dict[str, str]
    signal: Measured | None
    refused: dict[str, str]
    cut: str = ""
    kept: dict[str, str] = field(default_factory=dict)

    @property
    def asks(self) -> dict[str, str]:
        """Questions to answer before the signal can be drawn."""
        return questions(self.table)

    @property
    def sizes(self) -> dict[str, str]:
        """Questions to answer before its unit is known."""
        return size_questions(self.table, self.form)

    @property
    def recorded(self) -> datetime:
        """The date of the recording; the earliest possible one if the file states none."""
        recorded = self.table.contents.recorded
        return datetime.min if recorded is None else recorded.value


def read_files(
    name: str,
    content: bytes,
    scene: Machine,
    kept: Mapping[str, str],
    give_up: Callable[[], bool],
) -> Iterator[tuple[str, Read | str, int]]:
    """Read all files of a zip, or a single file.

    Yields for each file its name, what `read_file` returns or a sentence why it cannot be read, and
    the number of files. Once `give_up()` is True, the rest is not read, and the reading process
    ends.
    """
    try:
        names = files_inside(name, content, give_up)[:MOST_FILES]
    except ValueError:
        names = [name]  # reading it gives the reason
    for file in names:
        if give_up():
            why = f"{file} was not read: all files of an upload have one minute together."
            yield file, why, len(names)
            continue
        read: Read | str
        try:
            read = read_file(file, content, scene, kept, give_up)
        except ValueError as error:
            read = str(error)
        except Exception:
            log.exception("a file could not be read")
            read = f"{file} could not be read."
        yield file, read, len(names)


def read_file(
    name: str,
    content: bytes,
    scene: Machine,
    kept: Mapping[str, str] = MappingProxyType({}),
    give_up: Callable[[], bool] | None = None,
) -> Read:
    """Read a file and guess at its contents. For any thread; ValueError with a sentence.

    `kept`: answers on the machine for the previous file, used where this file states nothing.
    """
    try:
        whole = read_table(name, content, give_up)
        table, words = cut(whole, MOST_NUMBERS), ""
        if table is not whole:
            used, total = (thousands(len(rows.columns)) for rows in (table, whole))
            words = f"Only the first {used} of {total} rows are used."
    except FieldError as error:
        names_file = error.field == "file" and error.value == name
        why = f"; allowed: {error.allowed_text}" if names_file else f": {error}"
        raise ValueError(f"{name} cannot be used{why}.") from None
    except ValueError as error:
        raise ValueError(f"{name} cannot be used: {error}.") from None
    except MemoryError:
        raise ValueError(f"{name} is too large for this server.") from None
    return _propose(table, words, scene, kept)


def _propose(table: Table, rows_cut: str, scene: Machine, kept: Mapping[str, str]) -> Read:
    """Read a table with guesses at its contents; `rows_cut` says which rows were left out."""
    _, first = fill(table, {})
    kept = kept_answers(first, kept)
    form = {**first, **kept}
    signal, refused = _signal_or_reasons(table, form, scene)
    if refused and set(refused) <= set(MACHINE_FIELDS):
        # the file is a signal even if its statement on the bearing cannot be used
        signal, more = _signal_or_reasons(table, {**form, "bearing": NOT_KNOWN}, scene)
        refused = refused | more
    if signal is None and not usable(table):
        raise ValueError(f"{table.name} cannot be used. {' '.join(refused.values())}")
    return Read(table, first, form, signal, refused, rows_cut, kept)


def read_answers(table: Table, changed: Mapping[str, str], scene: Machine) -> Read:
    """Read a table with answers of a person in place of guesses."""
    _, first = fill(table, {})
    try:
        table, form = fill(table, changed)
    except FormError as error:
        return Read(table, first, {**first, **changed}, None, error.sentences)
    return Read(table, fill(table, {})[1], form, *_signal_or_reasons(table, form, scene))


def _signal_or_reasons(
    table: Table, form: Mapping[str, str], scene: Machine
) -> tuple[Measured | None, dict[str, str]]:
    """The signal that a form describes; or None, with the sentences why it describes none."""
    try:
        return read_form(table, form, scene), {}
    except FormError as error:
        return None, error.sentences
