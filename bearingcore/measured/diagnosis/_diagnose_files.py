"""Diagnosis of a recording, of a file, or of all files of a folder, in one call."""

from __future__ import annotations

import math
import os
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from textwrap import fill
from typing import Any, overload

from bearingcore.bearings import BearingLike, read_designation
from bearingcore.common import ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.measured.diagnosis._part.diagnose import diagnose_recording
from bearingcore.measured.diagnosis._part.evidence import Diagnosis
from bearingcore.measured.files import Finding
from bearingcore.measured.files._by_hand import recording_of, table_at
from bearingcore.measured.files._libraries import DOCUMENT
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
        a `Diagnosis` each; None for a file that cannot be read.
    sentences
        of the answers, or the reason why a file cannot be read.
    """

    names: tuple[str, ...]
    answers: tuple[Diagnosis | None, ...]
    sentences: tuple[str, ...]

    def __str__(self) -> str:
        """Return a complete paragraph for each file."""
        named = zip(self.names, self.sentences, strict=True)
        lines = (
            fill(f"{name}: {words.removeprefix(f'{name}: ')}", 100, subsequent_indent="    ")
            for name, words in named
        )
        return "\n".join(lines)

    def table(self) -> ResultTable:
        """Return a row for each file: part, probability, shaft speed and the answer in words."""
        answers = self.answers
        faults = ["not read" if answer is None else answer.fault for answer in answers]
        odds = [math.nan if answer is None else answer.probability for answer in answers]
        speeds = [
            math.nan if answer is None else answer.shaft_speed or math.nan for answer in answers
        ]
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
) -> Diagnosis | Any: ...  # a FolderDiagnosis for a folder, whose path has the same type
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
        the one from the shaft speed. `shaft_ratio` (1): turns of the bearing's shaft for each turn
        of the shaft whose speed is given, such as 0.657 or 23/47, behind a gear or a belt.
        `speed_source`, `bearing_source`: "given", "from the file" or "assumed", with more words
        after a colon.

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
    visible = [path for path in sorted(folder.iterdir()) if path.name[0] != "." and path.is_file()]
    files = [path for path in visible if not DOCUMENT.search(path.name)]
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
    """Diagnose a file; arguments that are missing are taken from the file if it is sure of them."""
    table = table_at(path)
    contents = table.contents
    finding, speed = contents.bearing, contents.shaft_speed
    if finding is None and contents.designation is not None:
        with suppress(ValueError):  # the number may be that of no bearing
            read_designation(contents.designation.value)
            finding = contents.designation
    if bearing is None and finding is not None and finding.taken:
        bearing = finding.value
        more = {"bearing_source": _source(finding, f"{bearing}, ")} | more
    if shaft_speed is None and speed is not None and speed.taken:
        shaft_speed = speed.value
        more = {"speed_source": _source(speed)} | more
    recording = recording_of(table, with_guesses=True, **choices)
    return diagnose_recording(recording, bearing, shaft_speed, **more)


def _source(finding: Finding[Any], words: str = "") -> str:
    """Return the origin of a fact in the words of `diagnose`."""
    return "from the file" if finding.stated else f"assumed: {words}{finding.reason}"
