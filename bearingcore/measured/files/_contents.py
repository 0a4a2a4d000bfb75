"""Meaning of the columns of a file: statements of the file, guesses, open questions."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from types import MappingProxyType

import numpy as np

from bearingcore.common import Array, _checks as checks, number
from bearingcore.measured.files import _dates as dates, _facts as facts, _shaft_angle as shafts
from bearingcore.measured.files._channels import (
    OTHER,
    SIGNAL,
    SPEED,
    TIME,
    Choice,
    Column,
    choose,
    column_of,
    names_a_frequency,
    only_signal,
)
from bearingcore.measured.files._collections import Collection, recognize
from bearingcore.measured.files._facts import Finding, Named, is_steady
from bearingcore.measured.files._other_kinds import kind_in_words, leave_out_spectra
from bearingcore.measured.files._sampling import (
    Sampling,
    clock_columns,
    clock_time,
    sampling_of,
    since_1970,
    times_of,
)
from bearingcore.measured.files._units import ACCELERATIONS, SPEEDS, TIMES, UNITS
from bearingcore.recordings import FEWEST_SAMPLES
from bearingcore.units import STANDARD_GRAVITY

LIKELY_IN_G, LIKELY_IN_SI = 0.299, 3.07
"""Root mean squares below which g is likely, and above which m/s² is: nine times as probable as the
other. In 88 public records with a stated unit the median level is 3 m/s², and the standard
deviation of its logarithm 1.1."""

TWO_RATES = 0.01
"""Relative difference above which a column of times and a remark give two sample rates."""

GRAVITY_SHARE = 0.1
"""Largest relative difference from gravity of a mean that counts as gravity."""


@dataclass(frozen=True)
class FileColumns:
    """Columns of numbers from a file.

    Attributes
    ----------
    names
        names of the columns.
    columns : (n, c)
        their numbers; NaN for gaps, and after the end of a shorter column.
    sample_rate
        [Hz] if the file's format has it (WAV), else None.
    scalars
        single numbers with a name in the file, such as a speed or a rate.
    name
        name of the file.
    texts
        words with a name in the file.
    remarks
        lines above the numbers.
    headed
        True if the file itself names its columns.
    stamps
        columns of dates or times of day, in seconds since the first.
    full_scale_known
        True if the numbers are in a unit; False for parts of full scale (WAV).
    notes
        sentences on parts that were not read.
    given
        facts on columns that a person gives, by index; they precede all guesses.

    Raises
    ------
    ValueError
        for too few rows.
    """

    names: tuple[str, ...]
    columns: Array = field(repr=False)
    sample_rate: float | None = None
    scalars: Mapping[str, float] = field(default_factory=dict)
    name: str = ""
    texts: Mapping[str, str] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    headed: bool = True
    stamps: tuple[int, ...] = ()
    full_scale_known: bool = True
    notes: tuple[str, ...] = ()
    given: Mapping[int, Column] = field(default_factory=dict)

    def __post_init__(self) -> None:
        rows = len(self.columns)
        if rows < FEWEST_SAMPLES:
            raise checks.refuse(
                f"number of rows in {self.name}", rows, f"at least {FEWEST_SAMPLES} samples"
            )
        for name in ("scalars", "texts", "given"):
            checks.keep(self, **{name: MappingProxyType(dict(getattr(self, name)))})


@dataclass(frozen=True)
class FileContents:
    """Statements of a file about itself, and guesses at the rest.

    Attributes
    ----------
    columns
        role, unit, direction and place of each column.
    choice
        the columns of this bearing by direction, or an open question.
    unit
        unit of the chosen columns, or of all signals if none are chosen.
    sample_rate
        [Hz]; None if there is not even a guess.
    shaft_speed
        [rad/s]
    load
        [N]
    sampling
        sampling by the column of times, if there is one.
    said
        all other facts with a name, in the words of the file.
    frequencies
        frequencies [Hz] of the bearing's parts in the file, by `BEARING_FREQUENCIES`.
    sensitivity
        [V/(m/s²)] of the sensor.
    collection
        public collection to which the file seems to belong; empty for none.
    bearing
        bearing of the collection, by its name in the catalogue or its designation.
    designation
        designation of the bearing in a line of the file; such a bearing may not exist.
    recorded
        date and time of the recording.
    machine, point
        names of the machine and of the measuring point.
    """

    columns: tuple[Column, ...]
    choice: Choice
    unit: Finding[str]
    sample_rate: Finding[float] | None
    shaft_speed: Finding[float] | None
    load: Finding[float] | None
    sampling: Sampling | None
    said: Mapping[str, str]
    frequencies: Mapping[str, float] = field(default_factory=dict)
    sensitivity: Finding[float] | None = None
    collection: str = ""
    bearing: Finding[str] | None = None
    designation: Finding[str] | None = None
    recorded: Finding[datetime] | None = None
    machine: Finding[str] | None = None
    point: Finding[str] | None = None


def contents_of(table: FileColumns) -> FileContents:
    """Return the statements of a table about itself, and guesses at the rest."""
    texts = [f"{name}: {text}" for name, text in table.texts.items()]
    lines = [*table.remarks, *texts]
    named = [
        *facts.named_at(table.scalars, table.texts),
        *facts.named_in(map(dates.remove_dates, table.remarks)),
        *facts.named_in(dates.remove_dates(text) for text in texts),
    ]
    hours = table.names[0].strip().lower() in ("hour", "hours", "h", "stunde")
    clock = clock_columns(table.columns) if hours or not table.headed else 0
    clock = 0 if any(index < clock for index in table.given) else clock
    known = recognize(table.names, clock, named)
    columns, sampling = _columns(table, clock, known)
    columns, choice = _choose(table, columns, sampling, known, lines)
    picked = list(choice.columns.values()) or [
        index
        for index, column in enumerate(columns)
        if column.role == SIGNAL and _moves(table.columns[:, index])
    ]
    rate = _rate(table, sampling, named, known)
    speed = _speed(table, columns, named) or known.guess("rpm", factor=SPEEDS["rpm"], unit="rpm")
    said = {item.name: f"{number(item.value, 6)} {item.unit or ''}".rstrip() for item in named}
    said |= {**dates.named_dates(lines), **table.texts}
    return FileContents(
        columns,
        choice,
        _unit(table, columns, picked, known),
        rate,
        speed or _speed_of_pulses(table, columns, rate, sampling, facts.pulses_a_turn_in(named)),
        facts.load_in(named),
        sampling,
        said,
        facts.bearing_frequencies_in(named),
        facts.sensitivity_in([*table.remarks, *(f"{k}: {v}" for k, v in said.items())]),
        known.name,
        known.guess("bearing"),
        facts.designation_in(lines),
        dates.recording_time(lines, table.name),
        dates.machine_or_point("machine", lines, table.name),
        dates.machine_or_point("point", lines, table.name),
    )


def _choose(
    table: FileColumns,
    columns: Sequence[Column],
    sampling: Sampling | None,
    known: Collection,
    lines: Sequence[str],
) -> tuple[tuple[Column, ...], Choice]:
    """Leave out the columns of spectra; choose those of this bearing, or ask a question."""
    headed = not all(re.fullmatch(r"column \d+|channel \d+", name) for name in table.names)
    why = known.why or ("as the headings say" if headed else "")
    moving = [_moves(values) for values in table.columns.T]
    if by_hand := {index for index, column in table.given.items() if column.role == SIGNAL}:
        moving = [moves and index in by_hand for index, moves in enumerate(moving)]
        return tuple(columns), choose(columns, moving, "as given", table.name, known.place)
    axis = _frequencies(table, columns, timed=sampling is not None)
    if not known.why:
        columns = leave_out_spectra(columns, table.columns, axis)
        name = "" if axis is None or sampling is not None else columns[axis].name
        if words := kind_in_words(columns, table.columns, lines, table.name, name):
            return tuple(columns), Choice({}, "", words)
    choice = choose(columns, moving, why, table.name, known.place)
    swings = np.any(table.columns < 0.0, axis=0) & np.any(table.columns > 0.0, axis=0)
    swinging = [
        index
        for index, column in enumerate(columns)
        if column.role == OTHER and column.unit is None and index != axis and swings[index]
    ]
    if len(swinging) != 1 or choice.columns or choice.options or known.why:
        return tuple(columns), choice
    # no heading is that of a signal: take the only column that swings about zero
    columns, index = list(columns), swinging[0]
    columns[index] = dataclasses.replace(columns[index], role=SIGNAL)
    return tuple(columns), only_signal(columns[index].name, index, why)


def _columns(
    table: FileColumns, clock: int, known: Collection
) -> tuple[tuple[Column, ...], Sampling | None]:
    """Return the columns, and the sampling by their times, if some are times."""
    columns = [_describe(column_of(name), table.texts) for name in table.names]
    columns = _add_units(table, columns)
    axes = known.directions
    for index, axis in enumerate(axes, len(columns) - len(axes)):
        columns[index] = dataclasses.replace(columns[index], direction=axis)
    for index, column in enumerate(columns):
        if column.role in (SIGNAL, TIME) and column.unit is None:
            values = table.columns[:, index]
            if values[0] == np.floor(values[0]) and (np.diff(values) == 1.0).all():
                columns[index] = Column(column.name, OTHER)  # 0, 1, 2, … are not times in seconds
    if clock:
        columns[:clock] = [Column(name, TIME) for name in table.names[:clock]]
        return tuple(columns), sampling_of(clock_time(table.columns, clock))
    stamped = [index for index in table.stamps if index not in table.given]
    for index in stamped:
        columns[index] = Column(table.names[index], TIME, "s")
    for index, column in table.given.items():
        columns[index] = column
    given_times = [index for index, column in table.given.items() if column.role == TIME]
    if not given_times:
        return _read_times(table, columns, stamped)
    unit, values = columns[given_times[0]].unit, table.columns[:, given_times[0]]
    if unit is None:
        return tuple(columns), times_of(values)
    sampling = sampling_of(values, TIMES[unit])
    return tuple(columns), dataclasses.replace(sampling, stated=sampling.sample_rate is not None)


def _add_units(table: FileColumns, columns: list[Column]) -> list[Column]:
    """Add the units in lines of the file to columns; one whose unit is another is no signal."""
    units = facts.stated_units(table.remarks, table.texts)
    signals = [index for index, column in enumerate(columns) if column.role == SIGNAL]
    if len(units) == 1:
        signals = [index for index in signals if columns[index].unit is None]
        units = [] if units[0] in {*UNITS, *TIMES} else units * len(signals)
    for index, unit in zip(signals, units, strict=True) if len(units) == len(signals) else ():
        role = SIGNAL if unit is None or unit in UNITS else TIME if unit in TIMES else OTHER
        columns[index] = dataclasses.replace(columns[index], unit=unit, role=role)
    return columns


def _read_times(
    table: FileColumns, columns: list[Column], stamped: Sequence[int]
) -> tuple[tuple[Column, ...], Sampling | None]:
    """Return the columns, and the sampling by those that are times by name or by rising evenly."""
    samplings: dict[int, Sampling] = {}
    for index, column in enumerate(columns):
        timed, values = column.role == TIME, table.columns[:, index]
        rises = column.role == SIGNAL and column.unit is None
        if index in table.given or not (timed or rises):
            continue
        if timed:
            samplings[index] = times_of(values, column.unit, sure=index in stamped)
        elif table.sample_rate is None and (
            (dated := since_1970(values)) or (sampling := sampling_of(values)).stated
        ):
            # a column that rises evenly all along is no vibration
            columns[index] = Column(column.name, OTHER)
            if (dated or not sampling.trouble) and not names_a_frequency(column.name):
                columns[index] = Column(column.name, TIME)
                sampling = times_of(values)
                reason, is_clear = f"{sampling.reason} “{column.name}”", True
                ends = f"{number(values[0], 4)} to {number(values[-1], 4)}"
                if not dated and ((index and not table.headed) or values[0] > np.ptp(values)):
                    reason, is_clear = f"{reason}, if it is no speed: it rises from {ends}", False
                stated = sampling.stated and is_clear
                samplings[index] = dataclasses.replace(sampling, stated=stated, reason=reason)
    return tuple(columns), _most_certain(samplings, [column.name for column in columns])


def _most_certain(samplings: Mapping[int, Sampling], names: Sequence[str]) -> Sampling | None:
    """Return the most certain sampling of columns of times; not stated if two disagree."""
    if not samplings:
        return None
    time = max(samplings, key=lambda i: (samplings[i].stated, samplings[i].sample_rate is not None))
    first = samplings[time]
    for index, other in samplings.items():
        rate = other.sample_rate if other.stated else None
        if rate and first.sample_rate and abs(rate / first.sample_rate - 1.0) > TWO_RATES:
            reason = f"“{names[time]}”, but “{names[index]}” says {number(rate, 6)} Hz"
            return dataclasses.replace(first, stated=False, reason=reason)
    return first


_DESCRIBES = ("name", "label", "channel", "position", "location", "place", "sensor", "direction")


def _describe(column: Column, texts: Mapping[str, str]) -> Column:
    """Add to a column the unit, place and direction in words beside it in its struct."""
    struct = column.name.rpartition(".")[0].lower()
    for name, text in texts.items():
        parent, _, end = name.lower().rpartition(".")
        unit = facts.unit_of(end, text)
        if not parent or parent not in (struct, column.name.lower()):
            continue
        if unit in TIMES and column.role == TIME:
            column = dataclasses.replace(column, unit=column.unit or unit)
        if unit is not None and column.role == SIGNAL and column.unit is None:
            role = SIGNAL if unit in UNITS else OTHER
            column = dataclasses.replace(column, unit=unit, role=role)
        if end in _DESCRIBES:
            words = column_of(text)
            place, direction = column.place or words.place, column.direction or words.direction
            column = dataclasses.replace(column, place=place, direction=direction)
    return column


def _frequencies(table: FileColumns, columns: Sequence[Column], *, timed: bool) -> int | None:
    """Return the column of the frequencies of a spectrum; with times its name does not matter."""
    for index, column in enumerate(columns):
        if index in table.given or column.role not in (OTHER, SPEED):
            continue
        is_named = names_a_frequency(column.name) or column.role == SPEED
        if (is_named or timed) and sampling_of(table.columns[:, index]).stated:
            return index
    return None


def _moves(signal: Array) -> bool:
    finite = signal[np.isfinite(signal)]
    return finite.size >= FEWEST_SAMPLES and bool(np.ptp(finite) > 0.0)


def _rate(
    table: FileColumns, sampling: Sampling | None, named: Sequence[Named], known: Collection
) -> Finding[float] | None:
    """Return the sample rate [Hz] by the format, by times and by facts; doubted if they differ."""
    if table.sample_rate is not None:
        return Finding(table.sample_rate, "the head of the file")
    fact = facts.sample_rate_in([*named, *_constants(table)], table.name)
    if sampling is None or sampling.sample_rate is None:
        return fact or known.guess("sample_rate", ", which has this rate")
    timed = Finding(sampling.sample_rate, sampling.reason, sampling.stated)
    if fact is None or timed.stated > fact.stated:
        return timed
    agree = abs(timed.value / fact.value - 1.0) <= TWO_RATES
    if agree or not fact.taken or timed.stated < fact.stated:
        return timed if timed.stated else fact
    reason = f"{timed.reason}, but {fact.reason} is {number(fact.value, 6)} Hz"
    return dataclasses.replace(timed, reason=reason, stated=False)


def _unit(
    table: FileColumns, columns: Sequence[Column], picked: Sequence[int], known: Collection
) -> Finding[str]:
    """Return the unit of the picked columns by headings, lines, the collection, or their level."""
    with_unit = [columns[index] for index in picked if columns[index].unit]
    if len({column.unit for column in with_unit}) == 1:
        return Finding(with_unit[0].unit or "", f"the name “{with_unit[0].name}”")
    stated = facts.stated_units(table.remarks, table.texts)
    if len(stated) == 1 and stated[0] is not None and stated[0] in UNITS:
        return Finding(stated[0], "a line of the file")
    if guess := known.guess("unit", f", which is in {known.unit}"):
        return guess
    if not picked:
        return Finding("m/s²", "nothing states it", False, supported=False)
    if table.full_scale_known is False:
        return Finding("m/s²", "nothing states the full scale", False, supported=False)
    signals = [index for index, column in enumerate(columns) if column.role == SIGNAL]
    return _unit_by_level(table.columns[:, list(picked)], table.columns[:, signals])


def _unit_by_level(signals: Array, all_signals: Array) -> Finding[str]:
    """Guess the unit with the most usual level, or with the mean of any signal as gravity."""
    finite = np.where(np.isfinite(signals), signals, 0.0)
    with np.errstate(over="ignore", invalid="ignore"):  # numbers of damaged files
        level = float(np.sqrt(np.mean((finite - finite.mean(axis=0)) ** 2)))
        means = np.abs(np.where(np.isfinite(all_signals), all_signals, 0.0).mean(axis=0))
    for unit in ("g", "m/s²", "mm/s²"):
        gravity = STANDARD_GRAVITY / ACCELERATIONS[unit]
        near_gravity = means[np.abs(means / gravity - 1.0) < GRAVITY_SHARE]
        if near_gravity.size and level < gravity:
            words = f"a mean of {number(float(near_gravity[0]))} is gravity in {unit}"
            return Finding(unit, words, False)
    if not 0.0 < level < np.inf:
        return Finding("m/s²", "nothing states it", False, supported=False)
    words = f"a root mean square of {number(level, 2)} is"
    if LIKELY_IN_G < level < LIKELY_IN_SI:
        return Finding("m/s²", f"{words} usual in g and in m/s²", False, supported=False)
    best, other = ("m/s²", "g") if level > LIKELY_IN_G else ("g", "m/s²")
    return Finding(best, f"{words} more usual in {best} than in {other}", False)


def _speed(
    table: FileColumns, columns: Sequence[Column], named: Sequence[Named]
) -> Finding[float] | None:
    """Return the shaft speed [rad/s] by a column of speeds, else by facts."""
    for index in shafts.angle_columns(columns):
        unit, words = columns[index].unit or "", f"the column “{columns[index].name}”"
        speeds = shafts.measured_speeds(table.columns[:, index]) if unit in SPEEDS else np.zeros(0)
        speeds = speeds[np.isfinite(speeds)]
        mean = float(speeds.mean()) if speeds.size else 0.0
        if mean > 0.0 and speeds.min() > -mean:  # a gyroscope swings about zero
            if not (steady := is_steady(speeds)):
                words += f", which goes from {number(speeds.min(), 4)} to {number(speeds.max(), 4)}"
            # a run-up or coast-down is followed, see `Recording.shaft_angle`
            stated = steady or bool(speeds.min() >= 0.0)
            return Finding(mean * SPEEDS[unit], words, stated, file_unit=unit)
    return facts.shaft_speed_in([*named, *_constants(table)], table.name)


def _speed_of_pulses(
    table: FileColumns,
    columns: Sequence[Column],
    rate: Finding[float] | None,
    sampling: Sampling | None,
    a_turn: float | None,
) -> Finding[float] | None:
    """Return the shaft speed by a tachometer's pulses `a_turn`; if unknown, guess one a turn."""
    for index in shafts.angle_columns(columns):
        column = columns[index]
        if rate is None or column.unit in SPEEDS:
            continue
        first, last = (None, None) if sampling is None else (sampling.first, sampling.last)
        begins = shafts.pulse_begins(table.columns[first:last, index])
        if len(begins) < shafts.FEWEST_PULSES:
            continue
        pulses = rate.value * (len(begins) - 1) / float(begins[-1] - begins[0])
        words = f"{number(pulses, 4)} pulses a second in “{column.name}”, "
        words += f"{number(a_turn)} a turn" if a_turn else "if one is a turn"
        is_known, speed = bool(a_turn), pulses / (a_turn or 1.0) * SPEEDS["Hz"]
        return Finding(speed, words, is_known, is_known, file_unit="Hz")
    return None


def _constants(table: FileColumns) -> list[Named]:
    """Return the numbers of columns with the same number in every row, or with a single one."""
    constants = []
    for name, column in zip(table.names, table.columns.T, strict=True):
        values = column[np.isfinite(column)]
        if is_steady(values):
            constants.append(Named(name, float(values.mean()), column_of(name).unit))
    return constants
