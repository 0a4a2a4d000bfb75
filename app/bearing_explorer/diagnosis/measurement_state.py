"""The state of the panels of a measurement, as values, with its sentences."""

from __future__ import annotations

from dataclasses import dataclass, field

from bearing_explorer.diagnosis.form import ShownColumns

FIRST_WORDS = (
    "No signal yet. Once there is one, the damaged part, the length of its spall, trend, "
    "indicators and spectra appear here."
)

REFUSED = "An answer on bearing, speed or columns is refused; this is for the one before."
CHANGED = "Your answers have changed since."
NOT_YET = "The signal is being analysed with the newest answers."
"""Why an answer is out of date, or not there yet."""


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
    #: why the fields are filled in as they are
    reasons: dict[str, str] = field(default_factory=dict)
    #: fields that a person has to answer: before the signal is taken, or before it has a size
    open: list[str] = field(default_factory=list)
    #: the unit that is likely where the file does not say it, "" where none is; None if it does
    proposed: str | None = None
    #: other numbers and words of the file
    said: str = ""
    #: [N] in the file, None where it has none
    load: float | None = None
    scaled: bool = False
    #: whether the sensitivity of a sensor is needed
    voltage: bool = False
    #: bearings to choose from, as [value, words, heading], and answers on the speed
    bearings: list[list[str]] = field(default_factory=list)
    #: recordings in the file, as [value, words], where there are several
    recordings: list[list[str]] = field(default_factory=list)
    speeds: list[list[str]] = field(default_factory=list)
    #: whether changed answers are still being read
    settling: bool = False
    #: the file before, where bearing or speed are those that a person gave for that
    kept_from: str = ""
    #: the signal in a line, as it is drawn; a guess has a question mark. Empty without a signal
    line: str = ""
    #: the whole name of its file, where the line has less of it
    whole_name: str = ""
    #: what is odd about the signal; empty where nothing is
    remarks: str = ""
    #: number of the file or simulation that is shown
    arrival: int = 0


@dataclass(frozen=True)
class AboutMeasurement:
    """Words for reports, which a person types once for all files of a session."""

    machine: str = ""
    point: str = ""
    date: str = ""
