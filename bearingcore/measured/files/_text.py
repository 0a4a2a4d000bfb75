"""Tables of numbers written as text, in the many styles of different programs.

Commas, semicolons, tabs or blanks separate columns; numbers have points or commas; there are
headings, remarks, gaps, quotation marks, dates and times of day. The first lines show the style of
a text; pandas reads the rest. This code runs only in the process of `_child`.
"""

from __future__ import annotations

import csv
import dataclasses
import io
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import islice
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, _checks as checks, thousands
from bearingcore.measured.files import _facts as facts
from bearingcore.measured.files._channels import TIME, column_of
from bearingcore.measured.files._units import UNITS, unit_in, unit_named
from bearingcore.measured.files._variables import MOST_COLUMNS, MOST_NUMBERS, Answer, check_size
from bearingcore.recordings import FEWEST_SAMPLES

LONGEST_REMARK = 200
"""Greatest length [characters] of a kept line above the numbers."""

LONGEST_LINE = 2**15
"""Greatest length [characters] of such a line that may have the names of columns."""

SAMPLE = 30
"""Number of lines of numbers from which the style is determined."""

READABLE = (
    "text with numbers (CSV, TXT, LVM), WAV, MATLAB, HDF5, NumPy, UFF, TDMS, "
    "Parquet, Excel (.xlsx), or a zip of one of these; export it as CSV where it is none of them"
)
"""The readable formats of files, in words."""

LONG_ROW = 64
"""Rows with more numbers than this may be signals, one in each row, if there are at most this many
rows; if a table could not have so many columns, there may be as many rows as numbers in each."""

MOST_WRONG = 0.01
"""Greatest share of lines without numbers in a table."""

MOST_MISSING, MOST_MISSING_WORDS = 0.5, 8
"""Greatest share of lines with words in place of numbers, and most different words."""

MOST_CHANGES = 0.1
"""Greatest share of rows with another word than the row before; with more, they mix signals."""

MOST_SIGNALS_MIXED = 32
"""Most different words in such a column."""


def read_text(
    name: str, content: bytes, most_numbers: int = MOST_NUMBERS, most_columns: int = MOST_COLUMNS
) -> Answer:
    """Read the table in a text of UTF-8, UTF-16 with its mark, or one byte a character.

    Returns
    -------
    about
        the fields of `_contents.FileColumns` about names, remarks, times and lines not read.
    columns : (n, c)
        the numbers; gaps are NaN, dates and times of day are seconds since the first of them.
        Columns of words, and empty ones, are left out.

    Raises
    ------
    FieldError
        naming the fault and its line.
    """
    content = _decode_to_utf8(name, content)
    # the first lines of numbers show the style of all: delimiter, decimal sign, width
    style, begin, remarks = _beginning(name, content)
    if style.width > min(LONG_ROW, most_columns):
        # few long rows are signals, not columns
        answer = _signals_in_rows(name, content[begin:], style, remarks, most_numbers, most_columns)
        if answer is not None:
            return answer
        check_size(name, 1, style.width, most_numbers, most_columns)
    columns, words, notes = _read_numbers(name, content, begin, style, remarks, most_numbers)
    headings = _headings(remarks, style, columns)
    if not headings:
        columns = _one_after_another(columns, remarks)
    elif any(column_of(name).role == TIME for name in headings):
        columns = columns[~np.isnan(columns).all(axis=1)]  # the times still show the missing rows
    # leave out columns of words, which were read as gaps, but keep dates
    filled = [not np.isnan(column).all() for column in columns.T]
    kept = [i for i, is_filled in enumerate(filled) if i in style.stamps or is_filled]
    if kept:
        columns, headings = columns[:, kept], headings and [headings[i] for i in kept]
    stamps = [kept.index(i) for i in style.stamps]
    for index, heading in enumerate(headings or ()):
        if _SENSOR.fullmatch(heading.strip()):
            refuse_mixed_rows(name, columns[:, index])
    return _text_fields(columns, headings, remarks + words, stamps=stamps, notes=notes)


_COUNT = re.compile(r"(?i)\W*(number|no|nr|n|count|anzahl)?\W*(of|der)?\W*(points|samples)\b")


def _one_after_another(columns: Array, remarks: Sequence[str]) -> Array:
    """Join columns row by row to one signal, if a remark states this number of samples."""
    width, samples = columns.shape[1], columns.ravel()
    counts = [item.value for item in facts.named_in(remarks) if _COUNT.match(item.name)]
    present = int(np.isfinite(samples).sum())
    # the last row may lack some numbers
    is_one = any(present <= count < present + width for count in counts)
    return samples[:present, None] if width > 1 and is_one else columns


def _read_numbers(
    name: str, content: bytes, begin: int, style: _Style, remarks: list[str], most_numbers: int
) -> tuple[Array, list[str], list[str]]:
    """Read the numbers from a byte on; return them, lines of words between them, and notes."""
    body = content[begin:]
    words: list[str] = []
    notes: list[str] = []
    most_rows = most_numbers // style.width + 1
    columns = _numbers(name, body, style, most_rows)
    if columns is None:  # some lines are no numbers
        above = content.count(b"\n", 0, begin) + 1
        body, notes, words = _mend(name, body, style, above, remarks)
        columns = _numbers(name, body, style, most_rows)
    if columns is None:
        raise checks.refuse("file", name, READABLE)
    check_size(name, len(columns), columns.shape[1], most_numbers, MOST_COLUMNS)
    return columns, words, notes


_SENSOR = re.compile(r"(?i)(sensor|channel|axis|device|node)([ _.-]?(id|no|nr|num|number|index))?")


def refuse_mixed_rows(name: str, labels: NDArray[Any], columns: Iterable[Array] = ()) -> None:
    """Refuse rows whose labels (n,) are those of several sensors, in turn or as equal blocks.

    As one signal they would be a vibration that no sensor has measured. If times, in one of the
    `columns` of numbers, rise through all blocks, these are labels along one signal.
    """
    names, counts = np.unique(labels, return_counts=True)
    if not 1 < len(names) <= MOST_SIGNALS_MIXED or len(labels) < FEWEST_SAMPLES:
        return
    changes = int((labels[1:] != labels[:-1]).sum())
    blocks = changes + 1 == len(names) and counts.min() == counts.max() >= FEWEST_SAMPLES
    rises = any((np.diff(c) > 0.0).all() and not _counts_rows(c) for c in columns)
    if (blocks and not rises) or changes > MOST_CHANGES * len(labels):
        raise checks.refuse(
            f"column of {', '.join(map(str, names[:4]))} in {name}",
            "rows of several sensors",
            "a column for each sensor, or a file for each",
        )


_BASIC_DATE = re.compile(rb"\b(\d{4})([01]\d)([0-3]\d)[T_]([0-2]\d)([0-5]\d)([0-5]\d)(?!\d)")
"""A date and time without marks between their parts: 20250102T030405.6Z."""


def _decode_to_utf8(name: str, content: bytes) -> bytes:
    """Return a text without byte marks, with ends of lines, and not in two bytes a character."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        content = content.decode("utf-16", "replace").encode()
    if b"\x00" in content[:4096]:
        raise checks.refuse("file", name, READABLE)
    content = content.removeprefix(b"\xef\xbb\xbf").rstrip(b"\x00")
    if _BASIC_DATE.search(content[:4096]):
        content = _BASIC_DATE.sub(rb"\1-\2-\3T\4:\5:\6", content)
    if re.match(rb"\s*\[", content) and b"\n" not in content.strip():
        content = content.translate(None, b"[]")  # one array as NumPy and MATLAB print it
    return content if b"\n" in content else content.replace(b"\r", b"\n")


def _text_fields(
    columns: Array, headings: list[str] | None, remarks: list[str], **more: list[Any]
) -> Answer:
    names = headings or [f"column {i + 1}" for i in range(columns.shape[1])]
    kept = [line[:LONGEST_REMARK] for line in remarks]
    return {"names": names, "remarks": kept, "headed": headings is not None, **more}, columns


# -- how numbers are written -----------------------------------------------------------------------

_DAY = r"\d{4}([-/.])\d\d?\2\d\d?|\d\d?\.\d\d?\.\d{4}|\d\d?/\d\d?/\d{4}|\d\d?-[A-Za-z]{3}-\d{4}"
_DATE = rf"(?:{_DAY})[T _;,\t]+"
_SECOND = rf"(?:{_DATE}|\d+ days? \+?)?\d\d?:\d\d?:\d\d?"
_ZONE = r"(\s?Z|{space}[+-]\d\d:?\d\d|\s?[AaPp]\.?[Mm]\b\.?)?"
_POINT_STAMP, _COMMA_STAMP = (
    # minutes and seconds alone are recognised by a part of a second behind them
    re.compile(
        rf"(?<![\w.:-])({_SECOND}|\d\d?:[0-5]\d(?={point}\d))({point}\d+|:\d{{3}}(?!\d))?"
        + _ZONE.format(space=space)
    )
    # where blanks separate columns, a number may follow
    for point, space in ((r"\.", r"\s?"), ("[.,]", ""))
)


class _Clock:
    """Replacement of dates and times of day by seconds since the first one."""

    def __init__(self) -> None:
        self._first: int | None = None
        self._last = 0
        self._midnights = 0

    def __call__(self, stamp: re.Match[str]) -> str:
        second, _, part, zone = stamp.groups()
        try:
            whole = self._whole(second, (zone or "").strip().lower()[:1])
        except ValueError:
            return stamp[0]  # a day that does not exist stays text
        if part and whole < 0:
            return repr(whole + float(f"0.{part[1:]}"))
        return f"{whole}.{part[1:]}" if part else str(whole)

    def _whole(self, text: str, half: str) -> int:
        """Return whole seconds since the first stamp; `half` is "a" or "p" of a 12-hour clock."""
        parts = [int(number) for number in re.split(r"[T _;,\t+]", text)[-1].split(":")]
        if half in ("a", "p"):
            parts[0] = parts[0] % 12 + 12 * (half == "p")
        whole = sum(part * size for part, size in zip(reversed(parts), (1, 60, 3600), strict=False))
        if " day" in text:
            whole += 86_400 * int(text.split()[0])
        elif len(text) > 8:
            whole += 86_400 * _day(re.split(r"[T _;,\t]", text, maxsplit=1)[0])
        else:
            self._midnights += whole < self._last - 43_200
            self._last = whole
            whole += 86_400 * self._midnights
        if self._first is None:
            self._first = whole
        return whole - self._first


@lru_cache(maxsize=64)
def _day(text: str) -> int:
    """Return the number of a day; ValueError for one that does not exist."""
    import pandas as pd

    return int(pd.to_datetime(text, dayfirst=bool(re.match(r"\d\d?[.-]", text))).toordinal())


@dataclass(frozen=True)
class _Style:
    """Style of lines with `width` numbers each; blanks if the delimiter is None."""

    delimiter: str | None
    decimal_comma: bool
    width: int = 0
    stamps: tuple[int, ...] = ()
    words: tuple[int, ...] = ()
    clock: Callable[[re.Match[str]], str] | None = field(default=None, compare=False)

    @property
    def stamp(self) -> re.Pattern[str]:
        """The regular expression of a date or time of day."""
        return _POINT_STAMP if self.delimiter == "," else _COMMA_STAMP

    def plain(self, text: str) -> str:
        """Return a text with decimal points, without quotation marks, and with times in seconds."""
        if self.delimiter == "," and _QUOTED_DECIMALS.search(text):
            text = re.sub(r'("[-+]?\d*),(\d+(?:[eE][-+]?\d+)?")', r"\1.\2", text)
        if '"' in text:
            if not (self.decimal_comma and _QUOTED_DECIMALS.search(text)):
                text = _QUOTED.sub(lambda match: match[0].replace(",", ""), text)
            text = text.replace('"', "")
        if self.clock is not None:
            text = self.stamp.sub(self.clock, text)
        if self.delimiter and ("'" in text or (self.decimal_comma and " " in text)):
            text = re.sub(r"(?<=\d)['\xa0 ](?=\d{3}(?!\d))", "", text)
        if not self.decimal_comma:
            return text
        if re.search(r"\.\d{3},\d", text):  # 1.234,5: points before three digits are not decimal
            text = re.sub(r"(?<=\d)\.(?=\d{3}(?!\d))", "", text)
        return text.replace(",", "" if re.search(r",\d{3}\.\d", text) else ".")


_QUOTED = re.compile(r'"-?\d{1,3}(?:,\d{3})+(?:\.\d*)?"')
_QUOTED_DECIMALS = re.compile(r'"[-+]?\d*,(?:\d{1,2}|\d{4,})(?:[eE][-+]?\d+)?"')
"""A number with commas between thousands, and one whose comma can only be decimal."""

_STYLES = (
    _Style(";", True),
    _Style("\t", True),
    _Style(",", False),
    _Style("|", False),
    _Style(None, False),
    _Style(None, True),
)


def _cells(line: str, delimiter: str | None) -> list[str]:
    if delimiter and '"' in line:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [""])]
    return [cell.strip() for cell in line.split(delimiter)]


MISSING = {
    "", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "...", "<na>", "nat", "?", "*",
}  # fmt: skip
"""Cells of missing numbers, in lower case, in addition to "nan"."""


def _number(cell: str) -> float | None:
    """Return the number in a cell, NaN for a missing one; None for anything else."""
    if cell.lower() in MISSING:
        return math.nan
    try:
        return None if "_" in cell else float(cell)  # for Python 1_000 is a number
    except ValueError:
        return None


def _row(line: str, delimiter: str | None, words: Sequence[int] = ()) -> list[float] | None:
    """Return the numbers of a plain line; None if it has anything else, or nothing.

    Cells of columns of `words` are NaN.
    """
    cells, of_words = _cells(line, delimiter), set(words)
    numbers = [math.nan if i in of_words else _number(cell) for i, cell in enumerate(cells)]
    present = [number for number in numbers if number is not None]
    if len(present) < len(numbers) or all(math.isnan(number) for number in present):
        return None
    return present


def _style(lines: Sequence[str], above: str) -> _Style | None:
    """Return the style of the first line; None if it has anything but numbers.

    If several styles fit, the following lines and the headings `above` decide.
    """
    fits = [pair for style in _STYLES if (pair := _fit_style(style, lines, above)) is not None]
    return max(fits, key=itemgetter(0))[1] if fits else None


def _fit_style(style: _Style, lines: Sequence[str], above: str) -> tuple[int, _Style] | None:
    """Return the number of lines that a style reads, and the style with the first line's width.

    All lines count twice if there are as many headings `above` them as columns.
    """
    if style.delimiter is not None and style.delimiter not in lines[0]:
        return None
    has_stamp = style.stamp.search(lines[0]) is not None
    trial = dataclasses.replace(style, clock=_Clock() if has_stamp else None)
    plain = trial.plain("\n".join(lines)).split("\n")
    if style.delimiter is None and not style.decimal_comma and any("," in p for p in plain):
        return None
    words = _columns_of_words(plain, style.delimiter)
    first = _row(plain[0], style.delimiter, words) or _row_of_labview(plain, style.delimiter)
    if first is None:
        return None
    rows = [_row(line, style.delimiter, words) for line in plain]
    # a delimiter at the end of each line makes an empty last column, which is NaN in all rows
    is_closed = style.delimiter is not None and plain[0].rstrip(" ").endswith(style.delimiter)
    is_closed &= not any(row and len(row) == len(first) and row[-1] == row[-1] for row in rows)
    width = len(first) - (is_closed and len(first) > 1)
    fits = sum(len(row or ()) in (width, width + 1) for row in rows)
    if style.delimiter == "," and _looks_decimal(plain, above):
        fits = 0
    fits += len(lines) * (width > 1 and len(_cells(above, style.delimiter)) == width)
    marked = style.stamp.sub("?", lines[0]).replace('"', "")
    cells = _cells(marked, style.delimiter)[:width]
    stamps = tuple(i for i, cell in enumerate(cells) if cell == "?")
    clock = _Clock() if has_stamp else None
    return fits, _Style(style.delimiter, style.decimal_comma, width, stamps, words, clock)


def _row_of_labview(lines: Sequence[str], delimiter: str | None) -> list[float] | None:
    """Return the numbers of the first line, if only this line ends with a comment."""
    if len(lines) < SAMPLE or delimiter is None:
        return None
    second = _row(lines[1].rstrip(f"{delimiter} "), delimiter) or []
    line = delimiter.join(_cells(lines[0], delimiter)[: len(second)])
    return _row(line, delimiter) if len(second) > 1 else None


def _columns_of_words(lines: Sequence[str], delimiter: str | None) -> tuple[int, ...]:
    """Return the columns with a word in every line, if there are many lines or long ones."""
    rows = [_cells(line, delimiter) for line in lines]
    if len(rows) < SAMPLE and len(rows[0]) <= FEWEST_SAMPLES:
        return ()
    places = {tuple(i for i, cell in enumerate(row) if _number(cell) is None) for row in rows}
    words = places.pop()
    if places or len(words) == len(rows[0]) or len({len(row) for row in rows}) > 1:
        return ()
    # "000125 −0" between two decimal commas is no word
    has_numbers = any(" " in rows[0][i] and not re.search(r"[^\W\d]", rows[0][i]) for i in words)
    return () if has_numbers else words


_TWO_WHOLE = re.compile(r"\s*(-?\d+),(\d+)\s*")


def _looks_decimal(lines: Sequence[str], above: str) -> bool:
    """Return True if "0,051" is one number, because 051 and −0 are not written as numbers.

    Below a heading of one word, pairs that begin with the same number are also one number each.
    """
    pairs = [pair.groups() for line in lines if (pair := _TWO_WHOLE.fullmatch(line)) is not None]
    if len(pairs) < len(lines):
        return False
    one_heading = (
        above
        and not re.search(r"[,;\t]", above)
        and len({whole for whole, _ in pairs}) < len(pairs)
    )
    return bool(one_heading) or any(
        whole == "-0" or (len(part) > 1 and part[0] == "0") for whole, part in pairs
    )


# -- lines above the numbers -----------------------------------------------------------------------


def _decode(line: bytes) -> str:
    """Decode a line, from an old encoding of one byte a character if it is not UTF-8."""
    try:
        return line.decode().rstrip("\r\n")
    except UnicodeDecodeError:
        return line.decode("cp1252", "replace").rstrip("\r\n")


def _beginning(name: str, content: bytes) -> tuple[_Style, int, list[str]]:
    """Return the style of the numbers, the place of their first byte, and the lines above."""
    remarks: list[str] = []
    words, begin, place = 0, "", 0
    for line in io.BytesIO(content):
        bare = _decode(line).strip()
        if bare[:1] in ("#", "%"):
            if len(remarks) < facts.MOST_REMARKS:
                remarks.append(bare.lstrip("#% ")[:LONGEST_LINE])
        elif bare:
            begin = begin or bare
            rest = io.BytesIO(content)
            rest.seek(place)
            sample = [text for _, text in islice(_lines_of_numbers(rest), SAMPLE)]
            is_heading = _is_numbered(sample)
            style = None if is_heading else _style(sample, remarks[-1] if remarks else "")
            second = _style(sample[1:], "") if style and style.width == 1 < len(sample) else None
            if second is not None and second.width > 2:
                style = None  # a single number above a wide table is the number of its lines
            if style is not None:
                return style, place, remarks
            words += 1
            remarks.append(_decode(line) if is_heading else bare[:LONGEST_LINE])
            if words > facts.MOST_REMARKS:
                break
        place += len(line)
    if not begin:
        raise checks.refuse("file", name, "one that holds lines of numbers")
    raise checks.refuse(f"start of {name}", begin[:40], "a table of numbers, headings above it")


def _is_numbered(lines: Sequence[str]) -> bool:
    """Return True if the first line has the headings 0, 1, 2, ... of a data frame."""
    match = re.fullmatch(r'(?:"")?([,;\t]?)"?0"?(?:[,;\t]"?\d+"?)*', lines[0])
    names = re.findall(r"\d+", lines[0])
    are_counted = names == [str(index) for index in range(len(names))]
    are_names = match is not None and (match[1] or ("." in "".join(lines[1:2]) and len(names) > 1))
    return bool(are_names and are_counted)


def _lines_of_numbers(lines: Iterable[bytes]) -> Iterator[tuple[int, str]]:
    """Yield lines that are neither empty nor remarks, with their numbers from 0."""
    for index, line in enumerate(lines):
        text = _decode(line)
        if text.strip() and text[0] not in "#%":
            yield index, text


def _headings(remarks: Sequence[str], style: _Style, columns: Array) -> list[str] | None:
    """Return the names of the columns with units, from the last line above them that fits.

    A line of units alone may be between names and numbers. Columns without a name get their number.
    """
    width = columns.shape[1]
    remarks = [re.sub(r"Unnamed: \d+", "", line) for line in remarks]  # pandas' name of an index
    # leave out facts, such as a rate; names and units are in the last three of the other lines
    lines = [
        line
        for line in remarks
        if re.search(r"[^\W_]", line) and not _is_remark(line, style, width)
    ][-3:]
    names = _names(lines[-1], style, columns) if lines else None
    if names is None:
        return None
    for line in lines[-2::-1] or [""]:
        names = _join_units(names, _names(line, style, columns))
    headings = [name for name in names if name]
    if any(re.fullmatch(r"-?\d*[.,]\d+", name) for name in headings):
        return None  # the line has numbers beside the settings of an instrument
    if not headings or all(_row(cell, None) for cell in headings):
        return None
    return [
        name if name and names.count(name) == 1 else f"{name}, column {index + 1}".strip(", ")
        for index, name in enumerate(names)
    ]


def _join_units(names: list[str], above: list[str] | None) -> list[str]:
    """Return the names of a line; if it has units or ends of names, joined to the line above."""
    units = [_unit_alone(cell) for cell in names]
    like_units = (
        unit or _UNIT_LIKE.fullmatch(cell) for unit, cell in zip(units, names, strict=True)
    )
    if above is not None and any(units) and all(like_units):
        pairs = [(name, cell.strip("[]() ")) for name, cell in zip(above, names, strict=True)]
        return [f"{name} [{unit}]" if unit.strip("- ") else name for name, unit in pairs]
    if above is not None and len(set(names)) < len(names) and len(set(above)) > 1:
        return [f"{a} {b}".strip() for a, b in zip(above, names, strict=True)]  # pandas' two levels
    if len(names) > 1 and all(units):
        return [f"column {i + 1} [{unit}]" for i, unit in enumerate(units)]
    return names


def _is_remark(line: str, style: _Style, width: int) -> bool:
    """Return True if a line has other words than the names of columns."""
    has_mark, has_unit = ":" in line or "=" in line, bool(facts.stated_units([line], {}))
    if width == 1:
        return not (unit_in(line) in UNITS and re.search(r"[\[(]", line)) and (
            has_unit
            or has_mark
            # a name and its value
            or re.search(r"[;\t]\s*[^;\t\s]|(^|\s)-?\d[\d.,]*\d", line) is not None
            or len(line.split()) > LONGEST_HEADING
            or bool(facts.named_in([line]))
        )
    cells = [cell for cell in _cells(line, style.delimiter) if cell]
    if has_mark and len(cells) == width and all(re.search(r"[:=]", cell) for cell in cells):
        return False  # "Ch 1: acc [g], Ch 2: acc [g]"
    if has_unit or (len(cells) > 1 and _is_a_value(cells)):
        return True
    return (has_mark or any(re.match(_VALUE, cell) for cell in cells)) and facts.names_a_fact(line)


_VALUE = r"[-+]?\d[\d.,]*([eE][-+]?\d+)?(\s*[^\W\d]\S{0,9})?$"
"""A number with or without a unit."""

LONGEST_HEADING = 4
"""Most words in the name of a single column; a longer line is a remark."""

_WORDS_OF_A_ROW = {
    "comment", "comments", "kommentar", "bemerkung", "remark", "remarks", "note", "notes",
    "flag", "flags", "marker", "event", "events", "annotation", "status", "untitled", "start",
    "increment",
}  # fmt: skip
_UNIT_LIKE = re.compile(r"[\[(]?(?:[a-zA-Zµμ°%]{0,5}(?:[/·*]s(?:\^?2|²|\*\*2)?)?|-)[\])]?")


def _unit_alone(cell: str) -> str | None:
    """Return the unit of a cell without other words; a single letter must have its usual case."""
    bare = cell.strip("[]() ")
    unit = unit_named(bare)
    return unit if len(bare) > 1 or bare in ("g", "s", unit) or bare != cell else None


_BLANKS = (r"\s{2,}", r"\s+(?![\[(])")


def _names(line: str, style: _Style, columns: Array) -> list[str] | None:
    """Return the cells of a heading, by any delimiter, if there are as many as columns.

    The names of columns of words, and of a column that counts rows, may be missing.
    """
    width = columns.shape[1]
    if width == 1:
        return [line.strip(' "\t,;')]
    ways = [_cells(line, delimiter) for delimiter in (style.delimiter, ";", "\t", ",")]
    if not re.search(r"[,;\t]", line):
        ways += [re.split(blanks, line) for blanks in _BLANKS]
    for cells in ways:
        names = [cell.strip().strip('"').strip() for cell in cells]
        if not _is_a_value(names) and len(fitting := _fit_width(names, style, columns)) == width:
            return fitting
    names = [cell.strip(' "') for cell in line.split(style.delimiter or "\n")]
    meanings = [column_of(name) for name in names]
    known = [bool(c.unit or c.direction or c.place or c.role == TIME) for c in meanings]
    if len(names) > width and any(known[:width]) and not any(known[width:]):
        return names[:width]  # columns of words at the end, empty and not delimited
    return None


def _fit_width(names: list[str], style: _Style, columns: Array) -> list[str]:
    """Return the names of a heading without surplus ones, and with those that may be missing."""
    width = columns.shape[1]
    while len(names) > width and (
        _number(names[-1]) is not None or names[-1].lower() in _WORDS_OF_A_ROW
    ):
        names.pop()  # LabVIEW names an empty column of words; oscilloscopes have settings
    if len(names) == width + 1 and re.fullmatch(r"\W*(headers|columns|fields)", names[0].lower()):
        names.pop(0)
    if 1 < len(names) < width and np.isnan(columns[:, len(names) :]).all():
        names += [""] * (width - len(names))  # rows with empty cells at their ends
    if len(names) == width - 1 and _counts_rows(columns[:, 0]):
        names.insert(0, "")  # R has no heading above the names of rows
    if len(names) == width + 1 and style.stamps and re.search("date|dat", names[0].lower()):
        names[:2] = [f"{names[0]} {names[1]}"]  # date and time have separate columns
    return names


def _is_a_value(cells: Sequence[str]) -> bool:
    """Return True if cells are a name and its number, such as "block 3", not names of columns."""
    values = set(cells[1:])
    is_number = len(values) == 1 and "" not in values and _number(*values) is not None
    return is_number and _number(cells[0]) is None and column_of(cells[0]).role != TIME


def _counts_rows(column: Array) -> bool:
    return len(column) > 1 and column[0] in (0.0, 1.0) and bool(np.all(np.diff(column) == 1.0))


# -- numbers ---------------------------------------------------------------------------------------


def _numbers(name: str, body: bytes, style: _Style, most_rows: int) -> Array | None:
    """Return the numbers (n, width) of lines; None if one is not `width` numbers and gaps."""
    import pandas as pd

    width = style.width
    plain = style.plain(body.decode("latin-1"))
    if "%" in plain or "\n " in plain:
        plain = re.sub(r"(?m)^(?: +\r?|%.*)$\n?", "", plain)
    text = io.BytesIO(plain.encode("latin-1"))
    del plain
    try:
        frame = pd.read_csv(
            text,
            sep=style.delimiter or r"\s+",
            header=None,
            names=range(width + 1),
            index_col=False,
            comment="#",
            skipinitialspace=True,
            dtype={i: (str if i in style.words else float) for i in range(width + 1)},
            na_values=sorted(MISSING),
            encoding="latin-1",
            nrows=most_rows,
        )
    except ValueError:  # text in place of a number, or a line that is too long
        return None
    words = [frame[index].fillna("").to_numpy(dtype=str) for index in style.words]
    frame[list(style.words)] = np.nan
    columns = frame.to_numpy(dtype=float)
    for labels in words:
        refuse_mixed_rows(name, labels, columns.T)
    # pandas fills short lines with gaps: then check each line
    doubtful = not np.isnan(columns[:, width]).all() or np.isnan(columns[:, width - 1]).any()
    if doubtful and next(_wrong_lines(io.BytesIO(body), style), None) is not None:
        return None
    return columns[:, :width]


def _wrong_lines(
    lines: Iterable[bytes], style: _Style
) -> Iterator[tuple[int, str, list[str], str]]:
    """Yield lines that are not `width` numbers and gaps: number from 0, text, cells, fault."""
    width = style.width
    for index, text in _lines_of_numbers(lines):
        cells = _cells(style.plain(text).partition("#")[0], style.delimiter)
        if len(cells) == width + 1 and not cells[-1]:
            cells.pop()
        words = [_number(cell) is None for cell in cells]
        short = re.sub(r"[^ -\uffff]", "", text.strip())[:40]
        if any(word for i, word in enumerate(words[:width]) if i not in style.words):
            yield index, short, cells, "numbers"
        elif len(cells) != width:
            comment = len(cells) > width and all(words[width:])
            yield index, short, cells, "" if comment else f"{width} columns as in the first"


def _mend(
    name: str, body: bytes, style: _Style, above: int, remarks: Sequence[str]
) -> tuple[bytes, list[str], list[str]]:
    """Replace words by gaps in a few lines; return the lines, sentences on them, and the words.

    The first line has the number `above`. Settings of an oscilloscope beside its first numbers are
    cut off. The last of many lines may be incomplete, and is then left out.
    """
    lines, width = body.rstrip().splitlines(keepends=True), style.width
    many_lines = len(lines) > FEWEST_SAMPLES
    few, many = (
        int(share * len(lines)) + 1 if many_lines else 0 for share in (MOST_WRONG, MOST_MISSING)
    )
    wrong: list[tuple[int, str, str]] = []
    words: set[str] = set()  # in place of numbers in lines of the right width
    n_torn = 0  # lines of another width
    notes: list[str] = []
    for index, text, cells, allowed in _wrong_lines(lines, style):
        if allowed and index == len(lines) - 1 and many_lines:
            lines[index] = b""
            notes = [f"The last line, “{text}”, is cut off: it is not used."]
            break
        if allowed:
            wrong.append((index, text, allowed))
            bad = [i for i, c in enumerate(cells) if i not in style.words and _number(c) is None]
            if len(cells) == width and bad:
                words |= {cells[i] for i in bad}
                cells = ["nan" if i in bad else cell for i, cell in enumerate(cells)]
            else:
                n_torn, cells = n_torn + 1, ["nan"] * width
            most = many if len(words) <= MOST_MISSING_WORDS else few
            if n_torn > few or len(wrong) > most:
                raise checks.refuse(f"line {above + wrong[0][0]} of {name}", *wrong[0][1:])
        text = (style.delimiter or " ").join(cells[:width])
        text = text.replace(".", ",") if style.decimal_comma else text
        lines[index] = text.encode("latin-1", "replace") + b"\n"
    repeated = {line[:40] for line in remarks}  # headings of a further recording need no note
    lacking = [(above + index, text) for index, text, _ in wrong if text not in repeated]
    if lacking:
        lack = "One line lacks" if len(lacking) == 1 else f"{thousands(len(lacking))} lines lack"
        number, text = lacking[0]
        notes.append(f"{lack} numbers (line {number}, “{text}”), which count as missing.")
    return b"".join(lines), notes, [text for _, text in lacking[:SAMPLE]]


def _signals_in_rows(
    name: str, body: bytes, style: _Style, remarks: list[str], most_numbers: int, most_columns: int
) -> Answer | None:
    """Read signals that are written in a row each; None for any other table."""
    width = style.width
    most_rows = min(most_columns if width > most_columns else LONG_ROW, width)
    lines = [line for _, line in islice(_lines_of_numbers(io.BytesIO(body)), most_rows + 1)]
    rows = [_row(style.plain(line).rstrip(" "), style.delimiter, style.words) for line in lines]
    whole = [row[:width] for row in rows if row is not None and len(row) in (width, width + 1)]
    if width < FEWEST_SAMPLES or not len(whole) == len(rows) <= most_rows:
        return None
    if remarks and len(_cells(remarks[-1], style.delimiter)) >= width:  # facts before the samples
        allowed = "a column for each signal: turn the table, without the facts before its samples"
        raise checks.refuse("file", name, allowed)
    columns = np.delete(np.array(whole).T, style.words, axis=0)
    check_size(name, len(columns), columns.shape[1], most_numbers, MOST_COLUMNS)
    names = [_cells(line, style.delimiter)[0] for line in lines] if style.words == (0,) else None
    return _text_fields(columns, names or _headings(remarks, style, columns), remarks)
