"""Diagnosis of a recording, of a file, or of all files of a folder, in one call."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from textwrap import fill
from typing import Any, overload

from bearingcore.bearings import BearingLike, read_designation
from bearingcore.common import ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.measured.diagnosis._part.diagnose import diagnose as diagnose_recording
from bearingcore.measured.diagnosis._part.evidence import Diagnosis
from bearingcore.measured.files import Finding, Table, kind_of, read_table
from bearingcore.measured.files._libraries import DOCUMENT
from bearingcore.measured.files._table import MOST_BYTES
from bearingcore.recordings import Recording

FILE_OR_FOLDER = "a Recording, or the path of a file or folder that is there"


@shown_as_table
@dataclass(frozen=True)
class FolderDiagnosis:
    """Diagnoses of the files of a folder, in the order of their names.

    Attributes
    ----------
    names
        of the files.
    answers
        a `Diagnosis` each; None of a file that cannot be read.
    sentences
        of the answers, or why a file cannot be read.
    """

    names: tuple[str, ...]
    answers: tuple[Diagnosis | None, ...]
    sentences: tuple[str, ...]

    def __str__(self) -> str:
        """A paragraph a file, whole."""
        named = zip(self.names, self.sentences, strict=True)
        lines = (
            fill(f"{name}: {words.removeprefix(f'{name}: ')}", 100, subsequent_indent="    ")
            for name, words in named
        )
        return "\n".join(lines)

    def table(self) -> ResultTable:
        """A row for each file: part, probability, shaft speed and the answer in words."""
        answers = self.answers
        faults = ["not read" if answer is None else answer.fault for answer in answers]
        odds = [math.nan if answer is None else answer.probability for answer in answers]
        speeds = [math.nan if one is None else one.shaft_speed or math.nan for one in answers]
        return table_of(
            ("file", "", self.names),
            ("fault", "", faults),
            ("probability", "1", odds),
            ("shaft_speed", "rad/s", speeds),
            ("sentence", "", self.sentences),
        )


@overload
def diagnose(
    recording: Recording,
    bearing: BearingLike | None = None,
    shaft_speed: float | tuple[float, float] | None = None,
    **more: Any,
) -> Diagnosis: ...
@overload
def diagnose(
    recording: str | os.PathLike[str],
    bearing: BearingLike | None = None,
    shaft_speed: float | tuple[float, float] | None = None,
    **more: Any,
) -> Diagnosis | Any: ...  # of a folder a FolderDiagnosis, which the type of a path does not say
def diagnose(
    recording: Recording | str | os.PathLike[str],
    bearing: BearingLike | None = None,
    shaft_speed: float | tuple[float, float] | None = None,
    *,
    columns: int | str | tuple[int | str, ...] | None = None,
    directions: tuple[str, ...] | None = None,
    unit: str | None = None,
    sample_rate: float | None = None,
    sensitivity: float | None = None,
    **more: Any,
) -> Diagnosis | FolderDiagnosis:
    """Diagnose the damaged part of a bearing from a signal, a file, or a folder of files.

    Parameters
    ----------
    recording
        acceleration of the housing, one direction or two; or the path of a file that `read_table`
        reads, or of a folder of such files; documents and pictures beside them are left out.
    bearing
        its geometry, its designation, or its name in `catalogue()`; only balls, diameters and
        contact angle count. None: the bearing of the public collection that the file belongs to;
        if there is none, no part is named and the status says so.
    shaft_speed
        [rad/s], accurate to `slip`; a pair (from, to) if it is rough; None: the speed stated
        by recording or file, or else a search between 300 and 6000 turns a minute.
    columns, directions, unit, sample_rate, sensitivity
        facts that the file lacks or states wrongly: see `Table.recording`. Without a unit, or in
        volts without a sensitivity, the numbers are used as they are; their scale does not
        matter here.
    **more
        `slip` (0.02): largest relative difference between the true passing rate of the balls and
        that by the shaft speed. `most_samples` (20,000,000): limit on the samples of all
        directions; a longer signal is not analysed, and the status says so. `speed_source`,
        `bearing_source`: "given", "from the file" or "assumed", with more words after a colon.

    Returns
    -------
    Diagnosis or FolderDiagnosis
        a `FolderDiagnosis` for a folder, with a row for each file; the row of a file that cannot be
        read has the reason.

    Raises
    ------
    ValueError
        for an impossible speed, slip or source, for bearings with unlike rows, for a path that does
        not exist, and for a file that cannot be read or lacks columns or a rate; the error names
        the argument to pass.
    """
    choices: dict[str, Any] = {"columns": columns, "directions": directions, "unit": unit}
    choices |= {"sample_rate": sample_rate, "sensitivity": sensitivity}
    if isinstance(recording, Recording):
        for name, value in choices.items():
            if value is not None:
                raise checks.refuse(name, value, "None for a recording, which has it")
        return diagnose_recording(recording, bearing, shaft_speed, **more)
    if not isinstance(recording, os.PathLike):
        recording = checks.instance("recording", recording, str, FILE_OR_FOLDER)
    path = Path(recording)
    if path.is_dir():
        return _diagnose_folder(path, bearing, shaft_speed, choices, more)
    return _diagnose_file(path, bearing, shaft_speed, choices, more)


def _diagnose_folder(
    folder: Path, bearing: BearingLike | None, shaft_speed: Any, choices: Any, more: Any
) -> FolderDiagnosis:
    named = [path for path in sorted(folder.iterdir()) if path.name[0] != "." and path.is_file()]
    files = [path for path in named if not DOCUMENT.search(path.name)]
    if not files:
        raise checks.refuse("recording", str(folder), "a folder with records in it")
    answers: list[Diagnosis | None] = []
    sentences = []
    for file in files:
        try:
            answer = _diagnose_file(file, bearing, shaft_speed, choices, more)
            answers.append(answer)
            sentences.append(answer.sentence)
        except ValueError as error:
            answers.append(None)
            sentences.append(str(error))
    return FolderDiagnosis(tuple(file.name for file in files), tuple(answers), tuple(sentences))


def _diagnose_file(
    path: Path, bearing: BearingLike | None, shaft_speed: Any, choices: Any, more: Any
) -> Diagnosis:
    if not path.is_file():
        raise checks.refuse("recording", str(path), FILE_OR_FOLDER)
    if (size := path.stat().st_size) > MOST_BYTES:
        most = f"at most {MOST_BYTES // 2**20} MB: split it, or export less of it"
        raise checks.refuse(f"size of {path.name}", f"{size / 2**20:.0f} MB", most)
    table = read_table(path.name, path.read_bytes())
    says = table.contents
    named = says.bearing or _known(says.designation)
    if bearing is None and named is not None and named.taken:
        bearing = named.value
        more = {"bearing_source": _source(named, f"{bearing}, ")} | more
    if shaft_speed is None and says.shaft_speed is not None and says.shaft_speed.taken:
        shaft_speed = says.shaft_speed.value
        more = {"speed_source": _source(says.shaft_speed)} | more
    return diagnose_recording(_recording(table, **choices), bearing, shaft_speed, **more)


def _known(designation: Finding[str] | None) -> Finding[str] | None:
    """The designation that a file gives, where a bearing has it."""
    if designation is not None:
        try:
            read_designation(designation.value)
        except ValueError:
            return None
    return designation


def _source(finding: Finding[Any], words: str = "") -> str:
    """Where a fact is from, as `diagnose` says it."""
    return "from the file" if finding.stated else f"assumed: {words}{finding.reason}"


def _recording(
    table: Table,
    columns: int | str | tuple[int | str, ...] | None,
    directions: tuple[str, ...] | None,
    unit: str | None,
    sample_rate: float | None,
    sensitivity: float | None,
) -> Recording:
    """The recording in a table, with what the file says where nothing else is given."""
    says = table.contents
    if isinstance(columns, (int, str)):
        columns = (columns,)
    if columns is None:
        chosen = _chosen_columns(table)
        directions, columns = directions or tuple(chosen), tuple(chosen.values())
    if directions is None:
        directions = ("x", "y")[-len(columns) :]
    units: dict[int | str, str | None] = {column.name: column.unit for column in says.columns}
    units |= {number: column.unit for number, column in enumerate(says.columns)}
    if unit is None and not all(units.get(column) for column in columns):
        unit = says.unit.value if says.unit.taken else "m/s²"
    used = {unit or units.get(column) or "" for column in columns} - {""}
    if sensitivity is None and "voltage" in map(kind_of, used):
        unit = "m/s²"  # without the sensor's sensitivity, as they are
    rate = says.sample_rate
    if sample_rate is None and rate is not None and rate.taken:
        sample_rate = rate.value
    return table.recording(columns, directions, unit, sample_rate, sensitivity=sensitivity)


def _chosen_columns(table: Table) -> Mapping[str, int]:
    """Columns of the signal by direction, if the file says them; else ValueError."""
    choice = table.contents.choice
    if choice.columns:
        return choice.columns
    options = choice.options or range(len(table.names))
    names = ", ".join(f'"{table.names[i]}"' for i in options)
    why = choice.question or choice.reason or "Which column is the signal?"
    way = "Say it with" if choice.options else "If one is a signal all the same, use"
    raise ValueError(
        f"{table.name}: {why} {way} columns=[...], one or two of {names}, or by "
        f"numbers from 0: {', '.join(map(str, options))}."
    )
