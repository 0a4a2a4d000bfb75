"""Columns of numbers from a file, and the recording that is made from some of them.

A file is read in two steps, because it seldom states all that is needed. `read_table` returns its
columns of numbers; `Table.contents` are its statements about them. `Table.recording` makes a
`Recording` from the columns that are the housing's acceleration, with the missing facts as
arguments. Facts by hand, in `Table.with_columns` or `read_recording`, precede every guess.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from bearingcore.common import Array, _checks as checks, cached_property, count, number, runs
from bearingcore.measured.files._channels import OTHER, ROLES, SIGNAL, SPEED, TIME, Column
from bearingcore.measured.files._child import read_file
from bearingcore.measured.files._contents import FileColumns, FileContents, contents_of
from bearingcore.measured.files._sampling import Sampling, long_parts, longest_run, single_gaps
from bearingcore.measured.files._shaft_angle import angle_columns, shaft_angle
from bearingcore.measured.files._units import (
    PULSE_TRAIN,
    SPEEDS,
    TIMES,
    UNITS,
    VELOCITIES,
    VOLTAGES,
    differentiate,
    level_doubt,
)
from bearingcore.measured.files._variables import MOST_NUMBERS
from bearingcore.measured.signals._dropouts import cut_off
from bearingcore.recordings import FEWEST_SAMPLES, Recording

MOST_BYTES = 64 * 2**20
"""Greatest size of a file."""

SHOWN_ROWS = 8

MOST_NAMED = 4
"""Most unused columns that a sentence names."""

RATE_DOUBT = 0.005
"""Largest relative difference between a typed rate and that of the times without a remark."""


_UNITS_OF: Mapping[str, Mapping[str, float]] = {
    SIGNAL: UNITS, TIME: TIMES, SPEED: {**SPEEDS, PULSE_TRAIN: 1.0}, OTHER: {}
}  # fmt: skip


@dataclass(frozen=True)
class Table(FileColumns):
    """Columns of numbers from a file, with their meaning, from which a recording is made.

    `chosen` names the chosen one of several recordings in the file, in words.
    """

    chosen: str = ""

    @cached_property
    def contents(self) -> FileContents:
        """Statements of the file about itself, and guesses at the rest."""
        return contents_of(self)

    @property
    def recordings(self) -> tuple[tuple[int, int], ...]:
        """Rows (last excluded) of each recording; times jump or numbers are missing between them.

        Empty for a single recording.
        """
        sampling, picked = self.contents.sampling, list(self.contents.choice.columns.values())
        if sampling is not None and sampling.parts:
            return sampling.parts
        whole = np.logical_and.reduce(np.isfinite(self.columns[:, picked]), axis=1)
        whole[single_gaps(whole)] = True
        parts = np.stack(runs(whole), axis=1)
        return long_parts(parts.tolist()) if picked else ()

    def one_of_recordings(self, number: int) -> Table:
        """Return the table of one of the `recordings` in the file, counted from 1.

        Raises
        ------
        FieldError
            for a number out of range.
        """
        parts = self.recordings
        checks.whole_number("part", number, at_least=1, at_most=max(len(parts), 1))
        if not parts:
            return self
        first, last = parts[number - 1]
        which = f"recording {number} of {len(parts)}"
        words = f"{which.capitalize()} in the file is read, from row {first + 1}."
        columns = self.columns[first:last]
        return dataclasses.replace(self, columns=columns, notes=(*self.notes, words), chosen=which)

    @property
    def which(self) -> str:
        """The selected one of several recordings, in words; else empty."""
        parts = self.recordings
        if self.chosen or not parts:
            return self.chosen
        longest = max(range(len(parts)), key=lambda k: parts[k][1] - parts[k][0])
        return f"recording {longest + 1} of {len(parts)}"

    @property
    def first_rows(self) -> list[list[float]]:
        """The first rows of numbers, to show below the columns' names."""
        return self.columns[:SHOWN_ROWS].tolist()

    def with_columns(self, given: Mapping[int | str, Column]) -> Table:
        """Return the table with the meaning of some columns set; it replaces all guesses.

        Parameters
        ----------
        given
            role, unit, direction and place, by number from 0 or by name. A missing unit is guessed:
            that of a time by its rate, that of a signal by its level.

        Raises
        ------
        FieldError
            for an unknown column, role, unit or direction, or a second column of times.
        """
        columns = dict(self.given)
        for key, column in given.items():
            index = self.index_of(key)
            checks.choice("role", column.role, ROLES)
            units = _UNITS_OF[column.role]
            if column.unit is not None and units:
                checks.choice("unit", column.unit, tuple(units))
            if column.direction:
                checks.choice("direction", column.direction, ("x", "y", "z"))
            columns[index] = dataclasses.replace(column, name=self.names[index])
        timed = [self.names[i] for i, column in columns.items() if column.role == TIME]
        if len(timed) > 1:
            raise checks.refuse("columns", " and ".join(timed), "one column of times")
        return dataclasses.replace(self, given=columns)

    def recording(
        self,
        columns: Sequence[int | str],
        directions: Sequence[str],
        unit: str | None = None,
        sample_rate: float | None = None,
        full_scale: float = 1.0,
        *,
        sensitivity: float | None = None,
        shaft_speed: float | None = None,
    ) -> Recording:
        """Return the acceleration in some of the columns.

        Parameters
        ----------
        columns
            the columns, by number from 0 or by name.
        directions
            directions of those columns.
        unit
            one of `UNITS`; None takes that of the headings. Velocities are differentiated, voltages
            divided by `sensitivity`.
        sample_rate
            [Hz]; None takes that of the file.
        full_scale
            meaning of the number 1 in the file [unit]: the full scale of a WAV file.
        sensitivity
            of the sensor [V/(m/s²)], for voltages; None takes that of the file.
        shaft_speed
            [rad/s]; None takes that of the file, if it has one.

        Raises
        ------
        ValueError
            for an unknown column, direction or unit, an unknown rate, columns of several
            bearings, or a voltage without a sensitivity.
        """
        picked = [self.index_of(column) for column in columns]
        if len(set(picked)) != len(picked) or len(picked) != len(directions):
            raise checks.refuse(
                "columns", list(columns), f"{len(directions)} different ones, one a direction"
            )
        contents = self.contents
        guessed = [index for index in picked if index not in self.given]
        places = {contents.columns[index].place: self.names[index] for index in guessed}
        places.pop("", None)
        if len(places) > 1:
            sensors = " and ".join(f"{name} ({place})" for place, name in places.items())
            raise checks.refuse(
                "columns", sensors, "directions of one place; these are sensors at two places"
            )
        units = [self._unit(index, unit) for index in picked]
        scale = checks.real_number("full_scale", full_scale, above=0.0, unit=unit or "")
        rate, notes = self._rate(sample_rate)
        signal, begin, gaps = self._longest_part(picked)
        cut = dict.fromkeys(cut_off(column[np.isfinite(column)]) for column in signal.T)
        chosen = contents.choice.note if picked == [*contents.choice.columns.values()] else ""
        angle, angle_column = self._angle(slice(begin, begin + len(signal)), rate)
        notes += [gaps, *cut, self._not_used(picked, angle_column), chosen]
        notes, signal = [*self.notes, *notes], signal * scale
        if sensitivity is None and contents.sensitivity is not None:
            sensitivity = contents.sensitivity.value
        with np.errstate(over="ignore", invalid="ignore"):  # the recording refuses infinite numbers
            notes += self._make_acceleration(signal, units, rate, sensitivity)
            notes += [*filter(None, map(level_doubt, signal.std(axis=0).tolist()))][:1]
        speed = contents.shaft_speed
        if shaft_speed is None and speed is not None and speed.stated:
            shaft_speed = speed.value
        return Recording(
            signal, rate, tuple(directions), self.name, shaft_speed, tuple(filter(None, notes)),
            angle, None if contents.recorded is None else contents.recorded.value,
        )  # fmt: skip

    def _angle(self, rows: slice, rate: float) -> tuple[Array | None, int | None]:
        """Return the shaft's angle (n,) [rad] in some rows and its column, or None for both."""
        columns = self.contents.columns
        for index in angle_columns(columns):
            angle = shaft_angle(self.columns[rows, index], columns[index].unit, rate)
            if angle is not None:
                return angle, index
        return None, None

    def _not_used(self, picked: Sequence[int], angle_column: int | None) -> str:
        """Return a sentence on columns that are not read although their numbers vary."""
        speed, unused = self.contents.shaft_speed, []
        for index, column in enumerate(self.contents.columns):
            steps = np.diff(self.columns[:, index])
            steps = steps[np.isfinite(steps)]
            is_used = index in (*picked, *self.given, angle_column) or column.role in (TIME, SPEED)
            if is_used or not steps.size or np.ptp(steps) == 0.0:  # constant, or counts rows
                continue
            reason = "along the shaft" if column.direction == "z" else "another signal"
            if speed is not None and f"“{column.name}”" in speed.reason:
                reason = f"a guess at the shaft speed: {speed.reason}"
            elif column.role == OTHER:
                reason = "no signal of acceleration"
            elif column.place:
                reason = column.place
            unused.append(f"“{column.name}” ({reason})")
        more = f" and {len(unused) - MOST_NAMED} more" if len(unused) > MOST_NAMED else ""
        words = f"Not used: {', '.join(unused[:MOST_NAMED])}{more}." if unused else ""
        if angle_column is not None and self.contents.columns[angle_column].role != SPEED:
            words += f" The pulses in “{self.names[angle_column]}” give the shaft's angle."
        return words.strip()

    def _make_acceleration(
        self, signal: Array, units: Sequence[str], rate: float, sensitivity: float | None
    ) -> list[str]:
        """Convert columns in `units` to accelerations [m/s²] in place; return sentences on it."""
        notes = []
        for index, unit in enumerate(units):
            signal[:, index] *= UNITS[unit]
            if unit in VOLTAGES:
                if sensitivity is None:
                    wanted = "that of the sensor [V/(m/s²)]: 100 mV/g is 0.1 / 9.80665"
                    raise checks.missing("sensitivity", wanted)
                signal[:, index] /= checks.real_number(
                    "sensitivity", sensitivity, above=0.0, unit="V/(m/s²)"
                )
            elif unit in VELOCITIES and len(signal) >= FEWEST_SAMPLES:
                if np.isfinite(signal[:, index]).all():
                    signal[:, [index]] = differentiate(signal[:, [index]], rate)
                notes = [
                    "A velocity was differentiated. It lacks the frequencies that its recorder "
                    "left out, often all above 1 kHz."
                ]
        return notes

    def _unit(self, index: int, unit: str | None) -> str:
        shared = self.contents.unit
        if unit is None:
            unit = self.contents.columns[index].unit or (shared.value if shared.stated else None)
        if unit is None:
            raise checks.missing("unit", f"one of {', '.join(UNITS)}: the file does not state it")
        return checks.choice("unit", unit, tuple(UNITS))

    def _rate(self, typed: float | None) -> tuple[float, list[str]]:
        """Return the sample rate [Hz], and sentences about it."""
        sampling, known = self.contents.sampling, self.contents.sample_rate
        trouble = sampling.trouble if sampling is not None else ""
        if typed is None:
            if known is not None and known.stated:
                return known.value, [trouble]
            words = "a number [Hz]: the file does not state it"
            if known is not None:
                words += f"; {number(known.value, 6)} is likely ({known.reason})"
            raise checks.missing("sample_rate", f"{words}. {trouble}".strip())
        rate = checks.real_number("sample_rate", typed, above=0.0, unit="Hz")
        words = f"The sample rate was typed as {number(rate, 6)} Hz"
        if known is None:
            words += ". Nothing in the file confirms it, but every frequency depends on it."
        elif abs(rate / known.value - 1.0) > RATE_DOUBT:
            says = "says" if known.stated else "suggests"
            words += f"; {known.reason} {says} {number(known.value, 6)} Hz."
        else:
            words = ""
        return rate, [trouble, words]

    def _longest_part(self, picked: Sequence[int]) -> tuple[Array, int, str]:
        """Return the longest part without a jump or gap, its first row, and words on gaps."""
        sampling = self.contents.sampling or Sampling(None, False, 0, len(self.columns))
        first, last = sampling.first, sampling.last
        signal = self.columns[first:last, picked]
        whole = np.isfinite(signal).all(axis=1)
        complete = np.flatnonzero(whole)
        # rows behind the last complete one belong to longer columns
        rest = complete[-1:] + 1
        signal, whole = np.split(signal, rest)[0], np.split(whole, rest)[0]
        words = []
        single = single_gaps(whole)
        single = single[~np.isinf(signal[single]).any(axis=1)]  # infinity is an overflow, no gap
        if single.size:
            between = 0.5 * (signal[single - 1] + signal[single + 1])
            signal[single] = np.where(np.isfinite(signal[single]), signal[single], between)
            whole[single] = True
            words.append(
                f"Single numbers are missing in {count(single.size, 'row')}. Each is bridged by "
                "the mean of its neighbours."
            )
        missing = int((~whole).sum())
        begin, end = longest_run(whole)
        if missing and end - begin >= FEWEST_SAMPLES:  # else `Recording` refuses the numbers
            words.append(
                f"Numbers are missing in {count(missing, 'row')}. Only the longest whole part is "
                f"used: rows {first + begin + 1} to {first + end} of {len(self.columns)}."
            )
            signal, first = signal[begin:end], first + begin
        return signal, first, " ".join(words)

    def index_of(self, column: int | str) -> int:
        """Return the number from 0 of a column, by number or name; `FieldError` if missing."""
        if isinstance(column, str) and column in self.names:
            return self.names.index(column)
        if isinstance(column, int) and 0 <= column < len(self.names):
            return column
        names = f"one of {', '.join(self.names)}, or by numbers from 0 to {len(self.names) - 1}"
        raise checks.refuse("column", column, names)


def files_inside(name: str, content: bytes, give_up: Callable[[], bool] | None = None) -> list[str]:
    """Return names for `read_table` of all files in a zip of several, in order; else only `name`.

    `give_up`: see `read_table`.

    Raises
    ------
    ValueError
        for a damaged zip.
    """
    if content[:4] != b"PK\x03\x04" or ".zip/" in name:
        return [name]
    about, _ = read_file(name, content, give_up=give_up)
    inside = sorted(
        about.get("inside", ()),  # run2 before run10
        key=lambda file: [(int(n or 0), word) for word, n in re.findall(r"(\D*)(\d{0,18})", file)],
    )
    packed = re.sub(r"(?i)\.zip$", "", name) + ".zip"
    return [f"{packed}/{name}" for name in inside] or [name]


def path_in(name: str) -> str:
    """Return the path of the file to open for a name such as "rig.zip/run1.csv"."""
    before, mark, _ = name.partition(".zip/")
    return before + mark.rstrip("/")


def read_table(name: str, content: bytes, give_up: Callable[[], bool] | None = None) -> Table:
    """Read the columns of numbers in a file: text (CSV), WAV, MATLAB, HDF5, and others.

    NumPy's files are read too; with the packages of the extra `files` also UFF, TDMS, Parquet and
    Excel's .xlsx; and a zip or gzip of one of them. The first bytes decide the format. A separate
    process with limits of time and memory reads the file: see `bearingcore.measured.files._child`.

    Parameters
    ----------
    name
        name of the file, which may hold a hint ("12k", "1797rpm"); "rig.zip/run1.csv" names a file
        in a zip.
    content
        the bytes of the whole file.
    give_up
        called repeatedly during reading; if it returns True, the reading process ends.

    Raises
    ------
    ValueError
        for a damaged, empty, huge or mis-shaped file, with the reason in one sentence.
    """
    check_bytes(name, len(content))
    about, columns = read_file(name, content, give_up=give_up)
    if inside := about.get("inside"):
        raise checks.refuse(
            "file",
            name,
            f"a zip of one file, not of {len(inside)} ({', '.join(inside[:6])}): unpack it, or "
            f"write which one after the zip's name, as in {name}/{inside[0]}",
        )
    about |= {key: tuple(about.get(key, ())) for key in ("names", "remarks", "stamps", "notes")}
    return Table(columns=columns, **{"name": name, **about})


def check_bytes(name: str, size: int) -> None:
    """Refuse a file of more than MOST_BYTES."""
    if size > MOST_BYTES:
        raise checks.refuse(
            f"size of {name}",
            f"{size / 2**20:.0f} MB",
            f"at most {MOST_BYTES >> 20} MB: split it by rows into files of that size and join "
            "their tables, or export a shorter part",
        )


def join_tables(tables: Sequence[Table]) -> Table:
    """Join the files of one signal, in their order, into a table of all rows.

    Times that continue from file to file show gaps between files. If times restart in each file, or
    there are none, the files are joined without gaps, and a note says so.

    Raises
    ------
    FieldError
        for files whose columns or sample rates differ, that are not in the order of their times, or
        that hold too many numbers together.
    """
    if not tables:
        raise checks.refuse("tables", "none", "one or more")
    first = tables[0]
    for other in tables[1:]:
        if other.names != first.names:
            names = ", ".join(other.names)
            raise checks.refuse(f"columns of {other.name}", names, f"those of {first.name}")
        rates = [part.contents.sample_rate for part in (first, other)]
        known = [rate.value for rate in rates if rate is not None]
        if len(known) == 1 or (len(known) == 2 and abs(known[1] / known[0] - 1.0) > RATE_DOUBT):
            raise checks.refuse(
                f"sample rate of {other.name}", known[-1], "that of the first", "Hz"
            )
    if sum(table.columns.size for table in tables) > MOST_NUMBERS:
        raise checks.refuse("count of numbers in all files", "more", f"at most {MOST_NUMBERS}")
    columns = np.concatenate([table.columns for table in tables])
    ends = np.cumsum([len(table.columns) for table in tables])
    timed = [i for i, column in enumerate(first.contents.columns) if column.role == TIME]
    restarts = len(timed) != 1
    for start, end in pairwise(ends) if len(timed) == 1 else ():
        time = columns[:, timed[0]]
        step = float(np.nanmedian(np.diff(time[:start])))
        if abs(time[start] - time[0]) < 0.5 * step or timed[0] in first.stamps:
            time[start:end] += time[start - 1] + step - time[start]
            restarts = True
        elif time[start] <= time[start - 1]:
            raise checks.refuse("tables", "not in their order", "files in the order of their times")
    notes = [note for table in tables for note in table.notes]
    if len(tables) > 1:
        gap = " as if nothing were missing between them" if restarts else ""
        notes.append(f"{len(tables)} files are joined{gap}.")
    name = first.name if len(tables) == 1 else f"{first.name} to {tables[-1].name}"
    return dataclasses.replace(first, columns=columns, name=name, notes=tuple(notes))
