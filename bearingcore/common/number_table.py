"""Tables of numbers written as text, in the many habits of those who write them.

Columns stand between commas, semicolons, tabs or blanks; numbers have points or commas; there are
headings, remarks, gaps, quotation marks, dates and times of day. The work grows no faster than the
text, the memory stays below ten times its size, and there are limits to what is read at all.
"""

from __future__ import annotations

import codecs
import io
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from datetime import date

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks

MOST_LINES = 5_000_000
LONGEST_LINE = 2**16
"""[characters]"""

MOST_HEADINGS = 100
"""Lines with words before the first line of numbers."""

LONGEST_REMARK = 200
"""[characters] of a line above the numbers that are kept."""

BLOCK = 2**16
"""Characters that are read without a pause for other threads."""

SAMPLE = 30
"""Lines of numbers by which the way of writing is judged."""


@dataclass(frozen=True)
class NumberTable:
    """What a text holds.

    Attributes
    ----------
    columns : (n, c)
        the numbers; gaps are NaN, dates and times of day are seconds since the first of them.
    headings
        of the columns, where there are as many as columns.
    remarks
        the lines above the numbers, headings among them.
    stamps
        columns that were dates or times of day.
    """

    columns: NDArray[np.float64] = field(repr=False)
    headings: tuple[str, ...] | None
    remarks: tuple[str, ...]
    stamps: tuple[int, ...]


def read_numbers(name: str, content: bytes, *, most_numbers: int, most_columns: int) -> NumberTable:
    """The table in a text.

    Parameters
    ----------
    name
        of the file, for the sentences.
    content
        UTF-8, UTF-16 with its mark, or an encoding of one byte a character.
    most_numbers, most_columns
        that are taken.

    Raises
    ------
    ValueError
        that says what is wrong, and in which line.
    """
    count = max(content.count(b"\n"), content.count(b"\r"))
    if count > MOST_LINES:
        raise checks.refuse(f"number of lines in {name}", count, f"at most {MOST_LINES}")
    blocks = _blocks(name, content)
    head = _head(name, blocks)
    style, width = head.style, head.width
    if width > most_columns:
        raise checks.refuse(f"number of columns in {name}", width, f"at most {most_columns}")
    # no row is shorter than its columns; pages that are never written cost nothing
    most = min(count + 1, most_numbers // width, len(content) // width + 1)
    columns = np.empty((most, width))
    rows = 0
    for first, lines in _and(head.rest, blocks):
        kept = [line for line in lines if line and not line.isspace() and line[0] not in "#%"]
        if not kept:
            continue
        if rows + len(kept) > most:
            raise checks.refuse(
                f"count of numbers in {name}", f"over {most_numbers}", f"at most {most_numbers}"
            )
        part = _numbers(style.plain(kept), style.delimiter, width, style.closed)
        if part is None:
            number, line, what = _culprit(lines, style, width)
            raise checks.refuse(f"line {first + number} of {name}", line[:40], what)
        columns[rows : rows + len(kept)] = part
        rows += len(kept)
    found = columns[:rows] if 2 * rows > most else columns[:rows].copy()
    return NumberTable(found, head.names, head.remarks, style.stamps)


# -- lines -----------------------------------------------------------------------------------------


def _encoding(name: str, content: bytes) -> str:
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    if b"\x00" in content[:4096]:
        raise checks.refuse("file", name, "text with numbers (CSV), WAV or MATLAB")
    decoder = codecs.getincrementaldecoder("utf-8")()
    try:
        for begin in range(0, len(content), 2**20):
            decoder.decode(content[begin : begin + 2**20])
        decoder.decode(b"", final=True)
    except UnicodeDecodeError:
        # headings in an old one-byte encoding, a degree sign perhaps: numbers read the same
        return "latin-1"
    return "utf-8-sig"


def _blocks(name: str, content: bytes) -> Iterator[tuple[int, list[str]]]:
    """Lines a block at a time, with the number of the first from 1 on."""
    text = io.TextIOWrapper(
        io.BytesIO(content), _encoding(name, content), errors="replace", newline=None
    )
    first = 1
    while block := text.read(BLOCK):
        if block[-1] != "\n":
            block += text.readline(LONGEST_LINE + 1)
        if block.isspace() and len(block) > 2:
            first += block.count("\n")  # a file may be nothing else
            continue
        lines = block.split("\n")
        if not lines[-1]:
            lines.pop()
        if max(map(len, lines)) > LONGEST_LINE:
            raise checks.refuse(
                f"longest line of {name}",
                f"over {LONGEST_LINE} characters",
                f"at most {LONGEST_LINE} characters",
            )
        yield first, lines
        first += len(lines)


def _and(
    rest: tuple[int, list[str]], blocks: Iterator[tuple[int, list[str]]]
) -> Iterator[tuple[int, list[str]]]:
    yield rest
    yield from blocks


# -- how numbers are written -----------------------------------------------------------------------

_DATE = r"(?:\d{4}([-/.])\d\d?\2\d\d?|\d\d?\.\d\d?\.\d{4}|\d\d?/\d\d?/\d{4})[T _;,\t]+"
_SECOND = rf"((?:{_DATE})?\d\d?:\d\d:\d\d)"
_ZONE = r"(?:\s?Z|[+-]\d\d:?\d\d)?"
_POINT_STAMP = re.compile(rf"(?<![\w.:-]){_SECOND}(\.\d+)?{_ZONE}")
_COMMA_STAMP = re.compile(rf"(?<![\w.:-]){_SECOND}([.,]\d+)?{_ZONE}")


class _Clock:
    """Writes dates and times of day as seconds since the first one."""

    def __init__(self) -> None:
        self._first: int | None = None
        self._last = 0
        self._midnights = 0
        self._stamp = ("", 0)

    def __call__(self, stamp: re.Match[str]) -> str:
        second, _, part = stamp.groups()
        known, whole = self._stamp
        if second != known:
            try:
                whole = self._whole(second)
            except ValueError:
                return stamp[0]  # a day that is in no calendar is no number either
            self._stamp = second, whole
        if part and whole < 0:
            return repr(whole + float(f"0.{part[1:]}"))
        return f"{whole}.{part[1:]}" if part else str(whole)

    def _whole(self, text: str) -> int:
        """Whole seconds since the first stamp."""
        hour, minute, second = (int(number) for number in text[-8:].lstrip("T _;,\t").split(":"))
        whole = hour * 3600 + minute * 60 + second
        if len(text) > 8:
            whole += 86_400 * _day(re.split(r"[T _;,\t]", text, maxsplit=1)[0])
        else:
            if whole < self._last - 43_200:
                self._midnights += 1
            self._last = whole
            whole += 86_400 * self._midnights
        if self._first is None:
            self._first = whole
        return whole - self._first


def _day(text: str) -> int:
    """Number of a day; ValueError for one that is in no calendar."""
    one, two, three = (int(number) for number in re.split(r"[-/.]", text))
    if one > 31:
        year, month, day = one, two, three
    elif "/" in text and two <= 31 and one <= 12:
        year, month, day = three, one, two
    else:
        year, month, day = three, two, one
    return date(year, month, day).toordinal()


@dataclass(frozen=True)
class _Style:
    """How lines of numbers are written."""

    delimiter: str | None
    decimal_comma: bool
    #: whether a delimiter closes each line instead of opening an empty cell
    closed: bool = False
    stamps: tuple[int, ...] = ()
    clock: Callable[[re.Match[str]], str] | None = field(default=None, compare=False)

    def plain(self, lines: Sequence[str]) -> Sequence[str]:
        """The lines with points in their numbers, without quotation marks, times as seconds."""
        text = "\n".join(lines)
        changed = False
        if '"' in text:
            text, changed = text.replace('"', ""), True
        if self.clock is not None:
            pattern = _POINT_STAMP if self.delimiter == "," else _COMMA_STAMP
            text, changed = pattern.sub(self.clock, text), True
        if self.decimal_comma and "," in text:
            text, changed = text.replace(",", "."), True
        return text.split("\n") if changed else lines


_STYLES = (
    _Style(";", True),
    _Style("\t", True),
    _Style(",", False),
    _Style(None, False),
    _Style(None, True),
)


def _cells(line: str, delimiter: str | None) -> list[str]:
    return [cell.strip() for cell in line.split(delimiter)]


def _number(cell: str) -> float:
    return float(cell) if cell else math.nan  # a gap


def _row(line: str, delimiter: str | None) -> list[float] | None:
    """The numbers of a plain line, or None where there is anything else, or nothing."""
    try:
        numbers = [_number(cell) for cell in _cells(line, delimiter)]
    except ValueError:
        return None
    if "_" in line or all(math.isnan(number) for number in numbers):
        return None  # Python takes 1_000 for a number
    return numbers


def _style(lines: Sequence[str], above: str) -> tuple[_Style, int] | None:
    """How the first line is written, and its columns; None where it holds anything but numbers.

    The lines that follow, and the headings `above`, decide where more than one way would do.
    """
    found: list[tuple[int, _Style, int]] = []
    for style in _STYLES:
        if style.delimiter is not None and style.delimiter not in lines[0]:
            continue
        made = _fitted(style, lines)
        if made is not None:
            fits, full, width = made
            headed = width > 1 and len(_cells(above, style.delimiter)) == width
            found.append((fits + headed * len(lines), full, width))
    if not found:
        return None
    most = max(fits for fits, _, _ in found)
    _, best, width = next(made for made in found if made[0] == most)
    return best, width


def _fitted(style: _Style, lines: Sequence[str]) -> tuple[int, _Style, int] | None:
    """How many of the lines a style reads, the style in full, and the columns of the first."""
    stamp = (_POINT_STAMP if style.delimiter == "," else _COMMA_STAMP).search(lines[0])
    clocked = _Style(style.delimiter, style.decimal_comma, clock=_Clock() if stamp else None)
    plain = clocked.plain(lines)
    if style.delimiter is None and not style.decimal_comma and any("," in p for p in plain):
        return None
    first = _row(plain[0], style.delimiter)
    if first is None:
        return None
    closed = (
        style.delimiter is not None
        and len(first) > 1
        and plain[0].rstrip(" ")[-1:] == (style.delimiter)
    )
    width = len(first) - closed
    rows = [_row(line, style.delimiter) for line in plain]
    fits = sum(row is not None and len(row) in (width, width + 1) for row in rows)
    if style.delimiter == "," and _looks_decimal(plain):
        fits = 0
    stamps: tuple[int, ...] = ()
    if stamp is not None:
        marked = (_POINT_STAMP if style.delimiter == "," else _COMMA_STAMP).sub("?", lines[0])
        cells = _cells(marked.replace('"', ""), style.delimiter)
        stamps = tuple(index for index, cell in enumerate(cells[:width]) if cell == "?")
    made = _Style(style.delimiter, style.decimal_comma, closed, stamps, _Clock() if stamp else None)
    return fits, made, width


_TWO_WHOLE = re.compile(r"\s*(-?\d+),(\d+)\s*")


def _looks_decimal(lines: Sequence[str]) -> bool:
    """Whether "0,051" is one number with a comma rather than two: no one writes 051 or −0."""
    pairs = [_TWO_WHOLE.fullmatch(line) for line in lines]
    parts = [pair.groups() for pair in pairs if pair is not None]
    return len(parts) == len(lines) and any(
        whole == "-0" or (len(part) > 1 and part[0] == "0") for whole, part in parts
    )


# -- headings --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Head:
    style: _Style
    width: int
    names: tuple[str, ...] | None
    remarks: tuple[str, ...]
    rest: tuple[int, list[str]]


def _head(name: str, blocks: Iterator[tuple[int, list[str]]]) -> _Head:
    """What stands above the numbers, and how they are written."""
    remarks: list[str] = []
    words = 0
    begin = ""
    for first, lines in blocks:
        for index, line in enumerate(lines):
            bare = line.strip()
            if not bare:
                continue
            if bare[0] in "#%":
                if len(remarks) < MOST_HEADINGS:
                    remarks.append(bare.lstrip("#% ")[:LONGEST_REMARK])
                continue
            begin = begin or bare
            sample = [
                one for one in lines[index : index + SAMPLE] if one.strip() and one[0] not in "#%"
            ]
            found = _style(sample, remarks[-1] if remarks else "")
            if found is not None:
                style, width = found
                style, width = _one_column(style, width, sample, remarks)
                return _Head(
                    style,
                    width,
                    _headings(remarks, style, width),
                    tuple(remarks),
                    (first + index, lines[index:]),
                )
            words += 1
            remarks.append(bare[:LONGEST_REMARK])
            if words > MOST_HEADINGS:
                break
        if words > MOST_HEADINGS:
            break
    if not begin:
        raise checks.refuse("file", name, "one that holds lines of numbers")
    raise checks.refuse(f"start of {name}", begin[:40], "a table of numbers, headings above it")


def _one_column(
    style: _Style, width: int, lines: Sequence[str], remarks: Sequence[str]
) -> tuple[_Style, int]:
    """One column of numbers with commas, where a heading of one word stands above pairs."""
    if style.delimiter == "," and width == 2 and remarks and not re.search(r"[,;\t]", remarks[-1]):
        whole = all(_TWO_WHOLE.fullmatch(line.replace('"', "")) for line in lines)
        if whole and len({_cells(line, ",")[0] for line in lines}) < len(lines):
            return _Style(None, True), 1
    return style, width


def _headings(remarks: Sequence[str], style: _Style, width: int) -> tuple[str, ...] | None:
    """The names of the columns, out of the last line above them that fits; its unit beside each.

    A line of units alone may stand between the names and the numbers.
    """
    lines = list(remarks[-3:])
    if not lines:
        return None
    names = _names(lines[-1], style, width)
    if names is None:
        return None
    if len(lines) > 1 and all(_UNIT.fullmatch(cell) for cell in names):
        above = _names(lines[-2], style, width)
        if above is not None:
            names = [
                f"{name} [{unit.strip('[]() ')}]" if unit.strip("[]()- ") else name
                for name, unit in zip(above, names, strict=True)
            ]
    if not all(names) or len(set(names)) < width or all(_row(cell, None) for cell in names):
        return None
    return tuple(names)


_UNIT = re.compile(r"[\[(]?(?:[a-zA-Zµμ°%]{0,5}(?:[/·*]s(?:\^?2|²|\*\*2)?)?|-)[\])]?")


def _names(line: str, style: _Style, width: int) -> list[str] | None:
    """The cells of a heading, whatever stands between them, if there are as many as columns."""
    if width == 1:
        return [line.strip(' "\t,;')]
    for cells in (
        line.split(style.delimiter),
        *(line.split(delimiter) for delimiter in (";", "\t", ",")),
        re.split(r"\s{2,}", line),
        re.split(r"\s+(?![\[(])", line),
    ):
        names = [cell.strip().strip('"').strip() for cell in cells]
        if len(names) == width + 1 and not names[-1]:
            names.pop()
        if len(names) == width + 1 and style.stamps and re.search("date|dat", names[0].lower()):
            names[:2] = [f"{names[0]} {names[1]}"]  # date and time in a column each
        if len(names) == width:
            return names
    return None


# -- numbers ---------------------------------------------------------------------------------------


def _numbers(
    lines: Sequence[str], delimiter: str | None, width: int, closed: bool
) -> NDArray[np.float64] | None:
    """The numbers of plain lines; None where one of them is not `width` numbers and gaps."""
    if closed and delimiter is not None:
        lines = [line.rstrip(" ").removesuffix(delimiter) for line in lines]
    for mend in (False, True):
        try:
            found = np.loadtxt(
                _mended(lines, delimiter, width) if mend else lines,
                delimiter=delimiter,
                comments=None,
                ndmin=2,
                dtype=float,
            )
        except ValueError:
            continue
        if found.shape == (len(lines), width):
            return found
    return None


def _mended(lines: Sequence[str], delimiter: str | None, width: int) -> list[str]:
    """The lines with NaN in their gaps, without an empty cell more than there are columns."""
    if delimiter is None:
        return list(lines)  # blanks in a row are one
    text = "\n".join(
        [
            line[:-1] if line.endswith(delimiter) and line.count(delimiter) == width else line
            for line in lines
        ]
    )
    if " " in text:
        text = re.sub(rf" *([{delimiter}\n]) *", r"\1", text)
    gap = f"{delimiter}nan{delimiter}"
    text = f"\n{text}\n".replace(2 * delimiter, gap).replace(2 * delimiter, gap)
    text = text.replace(f"\n{delimiter}", f"\nnan{delimiter}")
    return text.replace(f"{delimiter}\n", f"{delimiter}nan\n")[1:-1].split("\n")


def _culprit(lines: Sequence[str], style: _Style, width: int) -> tuple[int, str, str]:
    """Which of the lines cannot be read, the line, and what is allowed there."""
    for index, line in enumerate(lines):
        if not line or line.isspace() or line[0] in "#%":
            continue
        (plain,) = style.plain([line])
        if _numbers([plain], style.delimiter, width, style.closed) is None:
            cells = len(_cells(plain, style.delimiter))
            what = "numbers" if cells == width else f"{width} columns as in the first"
            return index, line.strip(), what
    return 0, lines[0].strip(), "numbers"
