"""Which columns of a file are signals, where and in which direction they were measured."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bearingcore.files.units import UNITS, kind_of, unit_in

SIGNAL, TIME, OTHER = "signal", "time", "other"

_SAYS = {
    "x": {"x", "ax", "accx", "xacc", "hor", "horiz", "horizontal", "h", "lateral"},
    "y": {"y", "ay", "accy", "yacc", "ver", "vert", "vertical", "vertikal", "v"},
    "z": {"z", "az", "accz", "zacc", "axial"},
}
_PLACES = {
    "de": "drive end",
    "nde": "non-drive end",
    "fe": "fan end",
    "ba": "base",
    "base": "base",
    "gearbox": "gearbox",
}
_PHRASES = (("nondriveend", "non-drive end"), ("driveend", "drive end"), ("fanend", "fan end"))
_NOT_SIGNALS = {"rpm", "tacho", "tachometer", "temperature", "temp", "current", "torque", "speed"}
_NOT_SIGNALS |= {"load", "index", "sample", "samples", "row", "no"}
_TIMES = {"t", "time", "seconds", "zeit", "temps", "timestamp", "date", "datetime", "datum"}


@dataclass(frozen=True)
class Column:
    """Meaning of a column.

    Attributes
    ----------
    name
        its heading.
    role
        "signal", "time" or "other".
    unit
        that the heading gives, one of `UNITS` for a signal; None where it gives none.
    direction
        "x", "y" or "z" as the heading says, else empty.
    place
        of the sensor as the heading says, else empty.
    """

    name: str
    role: str
    unit: str | None = None
    direction: str = ""
    place: str = ""


@dataclass(frozen=True)
class Choice:
    """The columns of this bearing by direction, and the reason.

    Where there is a question the columns are no more than a guess, or none.
    """

    columns: Mapping[str, int]
    reason: str
    question: str = ""


def column_of(name: str) -> Column:
    """Meaning of a column by its heading."""
    words = words_of(name)
    unit = unit_in(name)
    first = re.split(r"[\s_\[(/,]", name.strip().lower(), maxsplit=1)[0]
    if first in _TIMES and (unit is None or kind_of(unit) == "time"):
        return Column(name, TIME, unit)
    if (unit is not None and unit not in UNITS) or (words & _NOT_SIGNALS and unit is None):
        return Column(name, OTHER, unit)
    direction = next((axis for axis, said in _SAYS.items() if words & said), "")
    return Column(name, SIGNAL, unit, direction, place_in(name))


def place_in(name: str) -> str:
    """Where a heading or a variable's name says that the sensor was.

    >>> place_in("X105_DE_time"), place_in("Bearing 3 y"), place_in("vertical")
    ('drive end', 'bearing 3', '')
    """
    words = words_of(name)
    squeezed = re.sub(r"[\W_]+", "", name.lower())
    for phrase, place in _PHRASES:
        if phrase in squeezed:
            return place
    for word in words:
        if word in _PLACES:
            return _PLACES[word]
    match = re.search(
        r"(?:bearing|lager|brg)[ _-]?(\d+)|(?<![a-z0-9])b(\d)(?![a-z0-9])", name.lower()
    )
    return f"bearing {match[1] or match[2]}" if match else ""


def words_of(heading: str) -> set[str]:
    """The words of a heading, without units in brackets."""
    bare = re.sub(r"[\[(].*?[\])]", " ", heading.lower())
    return {word for word in re.split(r"[^a-z0-9]+", bare) if word}


def choose(
    columns: Sequence[Column],
    moving: Sequence[bool],
    why: str,
    file_name: str = "",
    place: str = "",
) -> Choice:
    """The columns that are likely this bearing's, or the question which they are.

    Sensors at several places are never taken for several directions.

    Parameters
    ----------
    columns
        of the table.
    moving
        whether each holds a signal at all.
    why
        the directions of the columns are known.
    file_name
        which may say which place it is about.
    place
        that of the bearing, where it is known.
    """
    signals = [
        index
        for index, column in enumerate(columns)
        if column.role == SIGNAL and moving[index] and column.direction != "z"
    ]
    if not signals:
        still = any(column.role == SIGNAL for column in columns)
        words = (
            "Every column is the same number throughout."
            if still
            else ("No column looks like a signal of acceleration.")
        )
        return Choice({}, "", words)
    places = {columns[index].place for index in signals} - {""}
    if len(places) > 1:
        said = place_in(file_name)
        place = said or place
        there = [index for index in signals if place and columns[index].place == place]
        if there:
            return _by_direction(columns, there, f"the file's name says {said}" if said else why)
        known = ", ".join(sorted(places))
        question = f"The file holds signals of several places ({known}). Which is at this bearing?"
        return Choice({}, "", question)
    return _by_direction(columns, signals, why)


def _by_direction(columns: Sequence[Column], signals: Sequence[int], why: str) -> Choice:
    """Signals of one place by their directions."""
    named = {
        axis: next((i for i in signals if columns[i].direction == axis), None)
        for axis in ("x", "y")
    }
    by_name = {axis: index for axis, index in named.items() if index is not None}
    if by_name:
        return Choice(by_name, why)
    if len(signals) == 1:
        return Choice({"y": signals[0]}, f"{why}, the only signal there; its direction is not said")
    if len(signals) == 2:
        chosen = {"x": signals[0], "y": signals[1]}
        return Choice(chosen, "two signals, taken for the two directions; nothing says so")
    return Choice(
        {}, "", f"The file holds {len(signals)} signals. Which was measured at this bearing?"
    )
