"""Measured signals: reading them from files, and what is told beside them.

A file is read in two steps, as it seldom says all that is needed. `read_table` finds its columns
of numbers; `Table.recording` makes a `Recording` of the columns that are the housing's
acceleration, once their unit, direction and sample rate are told.

Whatever is wrong with a file is said in one sentence, as a ValueError.
"""

from __future__ import annotations

import io
import math
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import checks
from bearingcore.signals.matlab_file import read_matrices

STANDARD_GRAVITY = 9.80665
"""[m/s²]"""

UNITS: Mapping[str, float] = MappingProxyType({"m/s²": 1.0, "g": STANDARD_GRAVITY})
"""Units of acceleration [m/s²]."""

DIRECTIONS = ("x", "y")

MOST_BYTES = 64 * 2**20
"""Of a file, and of what a compressed one holds at MOST_EXPANSION times as much."""

MOST_EXPANSION = 4

MOST_NUMBERS = 16_000_000
"""Numbers in a file, all columns together."""

MOST_COLUMNS = 64

MOST_HEADINGS = 100
"""Lines before the first line of numbers."""

LINES_AT_ONCE = 4096
"""Of a text that are read without a pause for other threads."""

FEWEST_SAMPLES = 256

UNEVEN = 0.5
"""How far a column of times may stray from even steps, in steps: printed times are rounded, but
they do not wander, and none is left out."""


@dataclass(frozen=True)
class Recording:
    """Acceleration of the housing as it was measured, in SI units.

    Attributes
    ----------
    acceleration : (n, d) [m/s²]
        one column a direction.
    sample_rate
        [Hz]
    directions
        of the columns: "x" (horizontal), "y" (vertical, up).
    name
        where it comes from.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """

    acceleration: NDArray[np.float64] = field(repr=False)
    sample_rate: float
    directions: tuple[str, ...] = ("x", "y")
    name: str = ""

    def __post_init__(self) -> None:
        def keep(name: str, value: object) -> None:
            object.__setattr__(self, name, value)

        keep("sample_rate", checks.number("sample_rate", self.sample_rate, above=0.0, unit="Hz"))
        keep("directions", check_directions(self.directions))
        signal = np.array(self.acceleration, dtype=float)
        if signal.ndim == 1:
            signal = signal[:, None]
        if signal.ndim != 2 or signal.shape[1] != len(self.directions):
            raise checks.refuse(
                "acceleration",
                f"of shape {np.shape(self.acceleration)}",
                f"a column for each direction: {', '.join(self.directions)}",
            )
        if len(signal) < FEWEST_SAMPLES:
            raise checks.refuse(
                "acceleration", f"{len(signal)} samples long", f"at least {FEWEST_SAMPLES} samples"
            )
        bad = np.flatnonzero(~np.isfinite(signal).all(axis=1))
        if bad.size:
            raise checks.refuse(
                "acceleration",
                f"not a finite number in {bad.size} samples, first in number {bad[0] + 1}",
                "finite numbers",
            )
        swings = zip(self.directions, np.ptp(signal, axis=0), strict=True)
        still = [direction for direction, swing in swings if not swing]
        if still:
            raise checks.refuse(
                "acceleration", f"the same number throughout along {still[0]}", "a signal"
            )
        signal.setflags(write=False)
        keep("acceleration", signal)

    @property
    def duration(self) -> float:
        """[s]"""
        return len(self.acceleration) / self.sample_rate


@dataclass(frozen=True)
class Table:
    """Columns of numbers out of a file.

    Attributes
    ----------
    names
        of the columns.
    columns : (n, c)
        their numbers; gaps are NaN.
    sample_rate
        [Hz] where the file tells it, else None.
    scalars
        single numbers that the file names, such as a speed or a rate.
    name
        of the file.
    """

    names: tuple[str, ...]
    columns: NDArray[np.float64] = field(repr=False)
    sample_rate: float | None = None
    scalars: Mapping[str, float] = field(default_factory=dict)
    name: str = ""

    @property
    def time_column(self) -> int | None:
        """Which column looks like a time: named so, or first and rising in even steps."""
        for index, name in enumerate(self.names):
            if _time_unit(name) is not None:
                return index
        if len(self.names) > 1 and _even_step(self.columns[:, 0]) is not None:
            return 0
        return None

    @property
    def suggested_rate(self) -> float | None:
        """Sample rate [Hz] that the file tells, by its header, its time column or a scalar."""
        if self.sample_rate is not None:
            return self.sample_rate
        time = self.time_column
        if time is not None:
            step = _even_step(self.columns[:, time])
            if step is not None:
                return 1.0 / (step * (_time_unit(self.names[time]) or 1.0))
        for name, value in self.scalars.items():
            if name.lower() in _RATES and value > 0.0:
                return value
        return None

    def recording(
        self,
        columns: Sequence[int | str],
        directions: Sequence[str],
        unit: str,
        sample_rate: float | None = None,
        full_scale: float = 1.0,
    ) -> Recording:
        """The acceleration in some of the columns.

        Parameters
        ----------
        columns
            which, by number from 0 or by name.
        directions
            of those columns.
        unit
            "m/s²" or "g".
        sample_rate
            [Hz]; None takes what the file tells.
        full_scale
            what the number 1 in the file stands for [unit]: the full scale of a WAV file, or the
            inverse of a sensor's sensitivity.

        Raises
        ------
        ValueError
            for an unknown column, direction or unit, or a rate that nobody tells.
        """
        picked = [self._index(column) for column in columns]
        if len(set(picked)) != len(picked) or len(picked) != len(directions):
            raise checks.refuse(
                "columns", list(columns), f"{len(directions)} different ones, one a direction"
            )
        checks.choice("unit", unit, tuple(UNITS))
        scale = checks.number("full_scale", full_scale, above=0.0, unit=unit)
        rate = self.suggested_rate if sample_rate is None else sample_rate
        if rate is None:
            raise checks.refuse("sample_rate", None, "a number [Hz]: the file does not tell it")
        signal = self.columns[:, picked] * (scale * UNITS[unit])
        return Recording(signal, rate, tuple(directions), self.name)

    def _index(self, column: int | str) -> int:
        if isinstance(column, str) and column in self.names:
            return self.names.index(column)
        if isinstance(column, int) and 0 <= column < len(self.names):
            return column
        raise checks.refuse("column", column, "one of " + ", ".join(self.names))


_TIMES = {"t", "time", "seconds", "zeit", "temps"}
_TIME_UNITS = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6}
_RATES = {"fs", "sample_rate", "samplerate", "sampling_rate", "samplingrate", "rate", "sr"}


def check_directions(directions: Sequence[str]) -> tuple[str, ...]:
    """`directions` as a tuple; ValueError unless they are different ones of x and y."""
    names = (directions,) if isinstance(directions, str) else tuple(directions)
    if not names or len(set(names)) != len(names) or not set(names) <= set(DIRECTIONS):
        raise checks.refuse("directions", names, "x, y or both")
    return names


def _time_unit(heading: str) -> float | None:
    """Seconds in the unit of a column headed like a time, such as "time [ms]"; else None."""
    word, _, unit = re.sub(r"[\[(/,_]", " ", heading.lower().strip(" ])")).partition(" ")
    return _TIME_UNITS.get(unit.strip()) if word in _TIMES else None


def read_table(name: str, content: bytes) -> Table:
    """The columns of numbers in a file: text (CSV), WAV or MATLAB (up to version 7).

    What it is shows in its first bytes; `name` only names it.

    Raises
    ------
    ValueError
        saying what is wrong with a broken, empty, huge or mis-shaped file.
    """
    size = len(content)
    if size == 0:
        raise checks.refuse("file", name, "one that is not empty")
    if size > MOST_BYTES:
        raise checks.refuse(
            f"size of {name}", f"{size / 2**20:.0f} MB", f"at most {MOST_BYTES // 2**20} MB"
        )
    if content[:4] in (b"RIFF", b"RIFX", b"RF64"):
        return _read_wav(name, content)
    marked = content[:6] == b"MATLAB" or content[126:128] in (b"IM", b"MI")
    if marked or name.lower().endswith(".mat"):
        return _read_matlab(name, content)
    return _read_text(name, content)


def _even_step(time: NDArray[np.float64]) -> float | None:
    """The step of a column that rises in even steps, or None."""
    if len(time) < 3 or not np.isfinite(time).all():
        return None
    step = float(time[-1] - time[0]) / (len(time) - 1)
    straight = time[0] + step * np.arange(len(time))
    if step <= 0.0 or np.abs(time - straight).max() > UNEVEN * step:
        return None
    return step


def _table(
    name: str,
    names: Sequence[str],
    columns: NDArray[np.float64],
    sample_rate: float | None = None,
    scalars: Mapping[str, float] | None = None,
) -> Table:
    if columns.shape[1] > MOST_COLUMNS:
        raise checks.refuse(
            f"number of columns in {name}", columns.shape[1], f"at most {MOST_COLUMNS}"
        )
    if columns.size > MOST_NUMBERS:
        raise checks.refuse(f"count of numbers in {name}", columns.size, f"at most {MOST_NUMBERS}")
    if len(columns) < FEWEST_SAMPLES:
        raise checks.refuse(
            f"number of rows in {name}", len(columns), f"at least {FEWEST_SAMPLES} samples"
        )
    return Table(tuple(names), columns, sample_rate, scalars or {}, name)


# -- text ------------------------------------------------------------------------------------------


def _read_text(name: str, content: bytes) -> Table:
    lines = [line.strip() for line in _decoded(name, content).splitlines()]
    lines = [line if not line.startswith(("#", "%")) else "" for line in lines]
    filled = [index for index, line in enumerate(lines) if line]
    if not filled:
        raise checks.refuse("file", name, "one that holds lines of numbers")
    styles = (_style(lines[index]) for index in filled[: MOST_HEADINGS + 1])
    first, style = next(
        ((place, style) for place, style in enumerate(styles) if style is not None), (0, None)
    )
    if style is None:
        raise checks.refuse(
            f"start of {name}", lines[filled[0]][:40], "a table of numbers, headings above it"
        )
    body = filled[first:]
    width = len(_cells(lines[body[0]], style))
    if width * len(body) > MOST_NUMBERS:
        raise checks.refuse(
            f"count of numbers in {name}", width * len(body), f"at most {MOST_NUMBERS}"
        )
    columns = _numbers(name, lines, body, style, width)
    names = [f"column {i + 1}" for i in range(width)]
    if first:
        headings = lines[filled[first - 1]]
        told = [cell.strip().strip('"') for cell in _cells(headings, style, width)]
        if len(told) == width and all(told) and len(set(told)) == width:
            names = told
    return _table(name, names, columns)


def _decoded(name: str, content: bytes) -> str:
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        encoding = "utf-16"
    elif b"\x00" in content[:4096]:
        raise checks.refuse("file", name, "text with numbers (CSV), WAV or MATLAB")
    else:
        encoding = "utf-8-sig"
    try:
        return content.decode(encoding)
    except UnicodeDecodeError:
        # headings in an old one-byte encoding, a degree sign perhaps: numbers read the same
        return content.decode("latin-1")


@dataclass(frozen=True)
class _Style:
    """How a line of numbers is written."""

    delimiter: str | None
    decimal_comma: bool


_STYLES = (
    _Style(";", True),
    _Style("\t", True),
    _Style(";", False),
    _Style("\t", False),
    _Style(",", False),
    _Style(None, False),
    _Style(None, True),
)


def _cells(line: str, style: _Style, width: int | None = None) -> list[str]:
    cells = line.split(style.delimiter)
    # a delimiter at the end may close the last cell, or open an empty one
    closed = len(cells) > 1 if width is None else len(cells) == width + 1
    return cells[:-1] if closed and not cells[-1].strip() else cells


def _number(cell: str, style: _Style) -> float:
    cell = cell.strip().strip('"')
    if not cell:
        return math.nan  # a gap
    if style.decimal_comma:
        cell = cell.replace(",", ".")
    return float(cell)


def _style(line: str) -> _Style | None:
    """The first style in which every cell of a line is a number, or None."""
    for style in _STYLES:
        if style.delimiter is not None and style.delimiter not in line:
            continue
        if style.decimal_comma and "," not in line:
            continue
        try:
            numbers = [_number(cell, style) for cell in _cells(line, style)]
        except ValueError:
            continue
        if not all(math.isnan(number) for number in numbers):
            return style
    return None


def _numbers(
    name: str, lines: list[str], body: list[int], style: _Style, width: int
) -> NDArray[np.float64]:
    """The numbers of the lines `body`, quickly where all are plain, else cell by cell."""
    columns = np.empty((len(body), width))
    if not style.decimal_comma:
        try:
            # in pieces: loadtxt lets no other thread go on meanwhile
            for begin in range(0, len(body), LINES_AT_ONCE):
                piece = body[begin : begin + LINES_AT_ONCE]
                columns[begin : begin + len(piece)] = np.loadtxt(
                    [lines[index] for index in piece],
                    delimiter=style.delimiter,
                    comments=None,
                    ndmin=2,
                    dtype=float,
                ).reshape(len(piece), width)
            return columns
        except ValueError:
            pass  # the slow way finds gaps, quotation marks, or the line to blame
    for row, index in enumerate(body):
        cells = _cells(lines[index], style, width)
        try:
            columns[row] = [_number(cell, style) for cell in cells]
        except ValueError:
            what = "numbers" if len(cells) == width else f"{width} columns as in the first"
            raise checks.refuse(f"line {index + 1} of {name}", lines[index][:40], what) from None
    return columns


# -- WAV -------------------------------------------------------------------------------------------


def _read_wav(name: str, content: bytes) -> Table:
    """Whole numbers come out as parts of full scale, −1 to 1."""
    from scipy.io import wavfile  # imported late: see `spectrum`

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # chunks with remarks that it does not know
            rate, data = wavfile.read(io.BytesIO(content))
    except Exception as error:  # a broken file raises almost anything in there
        raise checks.refuse("file", name, f"a whole WAV file ({error})") from None
    data = np.atleast_2d(np.asarray(data).T).T
    if data.dtype.kind == "u":
        columns = data / 128.0 - 1.0
    elif data.dtype.kind == "i":
        columns = data / float(np.iinfo(data.dtype).max + 1)
    else:
        columns = data.astype(float)
    if rate <= 0 or columns.size == 0:
        raise checks.refuse("file", name, "a WAV file with samples and a sample rate")
    names = [f"channel {i + 1}" for i in range(columns.shape[1])]
    return _table(name, names, columns, float(rate))


# -- MATLAB ----------------------------------------------------------------------------------------


def _read_matlab(name: str, content: bytes) -> Table:
    """Vectors and matrices of real numbers with as many rows as the longest of them."""
    try:
        matrices = read_matrices(content, MOST_BYTES * MOST_EXPANSION)
    except ValueError as error:
        raise checks.refuse(
            "file", name, f"a whole MATLAB file of version 4 to 7; this has {error}"
        ) from None
    scalars: dict[str, float] = {}
    parts: dict[str, NDArray[np.float64]] = {}
    for variable, matrix in matrices.items():
        if matrix.size == 1:
            scalars[variable] = float(matrix[0, 0])
        elif matrix.size:
            parts[variable] = matrix.T if matrix.shape[0] < matrix.shape[1] else matrix
    if not parts:
        raise checks.refuse("file", name, "a MATLAB file with a vector or matrix of real numbers")
    rows = max(len(part) for part in parts.values())
    parts = {variable: part for variable, part in parts.items() if len(part) == rows}
    names = [
        variable if part.shape[1] == 1 else f"{variable}(:,{i + 1})"
        for variable, part in parts.items()
        for i in range(part.shape[1])
    ]
    return _table(name, names, np.hstack(list(parts.values())), None, scalars)


def as_recording(
    signal: ArrayLike, sample_rate: float, directions: Sequence[str] | None = None
) -> Recording:
    """A recording of a signal (n,) or (n, d) [m/s²]: along y where there is one, else x and y."""
    samples = np.asarray(signal, dtype=float)
    if directions is None:
        directions = ("y",) if samples.ndim == 1 or samples.shape[-1:] == (1,) else DIRECTIONS
    return Recording(samples, sample_rate, check_directions(directions))
