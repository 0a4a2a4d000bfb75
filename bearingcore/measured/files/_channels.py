"""Channels of a file: the columns that are signals, with places and directions of their sensors."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bearingcore.measured.files._units import SPEEDS, TIMES, UNITS, VOLTAGES, unit_in, unit_named

SIGNAL, TIME, SPEED, OTHER = "signal", "time", "speed", "other"
ROLES = (SIGNAL, TIME, SPEED, OTHER)

_DIRECTION_WORDS = {
    "x": {"x", "ax", "accx", "xacc", "hor", "horiz", "horizontal", "h", "lateral"},
    "y": {"y", "ay", "accy", "yacc", "ver", "vert", "vertical", "vertikal", "v"},
    "z": {"z", "az", "accz", "zacc", "axial"},
}
_PLACES = {
    "de": "drive end",
    "nde": "non-drive end",
    "ode": "non-drive end",
    "inboard": "inboard",
    "outboard": "outboard",
    "fe": "fan end",
    "ba": "base",
    "base": "base",
    "gearbox": "gearbox",
}
PLACES = tuple(dict.fromkeys(_PLACES.values()))
"""Places of sensors that the names of columns may state."""

_PHRASES = (
    ("nondriveend", "non-drive end"),
    ("oppositedriveend", "non-drive end"),
    ("driveend", "drive end"),
    ("fanend", "fan end"),
)
PULSES = {
    "tacho", "tachometer", "tach", "keyphasor", "keyphaser", "keyphase", "trigger", "encoder",
    "pulse", "pulses",
}  # fmt: skip
"""Words for a tachometer's signal."""

QUANTITIES = {
    "an envelope": ("gE", ""),
    "a current": ("A mA kA", "current currents strom amps courant"),
    "a displacement": ("µm mm mil", "displacement displ disp proximity prox weg verschiebung"),
    "a sound": ("Pa", "microphone mic sound"),
    "a pressure": ("bar", "pressure druck"),
    "a force or a strain": ("N kN", "force kraft strain dehnung"),
    "a torque": ("Nm", "torque drehmoment"),
    "a temperature": ("°C", "temperature temperatur temp"),
    "a rotation": ("deg/s deg rad/s", "gyro gyroscope gyr"),
    "a level": ("dB", "db"),
    "a speed": ("rpm", "speed rpm drehzahl"),
    "a tachometer's signal": ("", " ".join(PULSES)),
}
"""Quantities that are no vibration: their units, and words of their headings."""

_NOT_SIGNALS = {word for _, words in QUANTITIES.values() for word in words.split()} | {
    "power", "humidity", "flow", "load", "magnetic", "magnetometer", "quat", "quaternion",
}  # fmt: skip
_COUNTS = {"index", "sample", "samples", "row", "no"}
"""Words for a number of rows. Only the last part of a name counts: "samples.x" is a signal."""

_TIMES = {
    "t", "time", "times", "zeit", "temps", "tiempo", "tempo", "timestamp", "timestamps", "clock",
    "zeitstempel", "uhrzeit", "date", "datetime", "datum", "elapsed", "epoch", "utc", "unix",
    "timedelta", "ts",
}  # fmt: skip
_BEFORE_TIME = {
    "elapsed", "relative", "rel", "absolute", "abs", "sample", "sampling", "system", "local",
    "measurement", "recording", "record", "log", "run", "scan", "host", "device", "unix", "time",
}  # fmt: skip
"""Words before "time"; elsewhere it may end the name of a signal, as in "X105_DE_time"."""


@dataclass(frozen=True)
class Column:
    """Meaning of a column.

    Attributes
    ----------
    name
        its heading.
    role
        one of `ROLES`: "signal", "time", "speed" or "other".
    unit
        unit in the heading, one of `UNITS` for a signal; None if there is none.
    direction
        "x", "y" or "z" by the heading, else empty.
    place
        place of the sensor by the heading, else empty.
    """

    name: str
    role: str
    unit: str | None = None
    direction: str = ""
    place: str = ""


@dataclass(frozen=True)
class Choice:
    """The columns of this bearing by direction, and the reason.

    With a question nothing is chosen. `options` are then the indices of possible answers: one
    column, or two that are directions of one place. A `note` says that the only signal was chosen
    in spite of its name.
    """

    columns: Mapping[str, int]
    reason: str
    question: str = ""
    options: tuple[int, ...] = ()
    note: str = ""


def column_of(name: str) -> Column:
    """Return the meaning of a column by its heading."""
    words = words_of(name) | words_of(re.sub(r"(?<=[a-z])(?=[XYZ]\b)", " ", name))
    unit = unit_in(name)
    leaf = re.sub(r"^[\w.{}()]*\.(?=[A-Za-z])", "", name.strip())  # a field of a struct
    bare = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", leaf)
    first, *more = [word for word in re.split(r"[\W_]+", bare.lower()) if word] or [""]
    if unit is None and len(first) > 1 and more in ([], ["elapsed"]):
        unit = named if (named := unit_named(first)) in TIMES else None  # "seconds_elapsed"
    if unit in TIMES or (unit is None and _names_a_time(first, more)):
        return Column(name, TIME, unit)
    if unit in SPEEDS:
        is_an_axis = names_a_frequency(name) and "rpm" not in name.lower()
        return Column(name, OTHER if is_an_axis else SPEED, unit)
    other = words & _NOT_SIGNALS or {first, *more} & _COUNTS or first == "mag"
    if unit not in (None, *UNITS) or (other and unit in (None, *VOLTAGES)):  # another quantity
        return Column(name, OTHER, unit)
    if place_in(name) and re.search(r"[\s_.]V$", name):
        unit, words = None, {"v"}  # the vertical direction at a place, no voltage
    direction = next((axis for axis, known in _DIRECTION_WORDS.items() if words & known), "")
    return Column(name, SIGNAL, unit, direction, place_in(name))


def _names_a_time(first: str, more: Sequence[str]) -> bool:
    """Return True if a heading with this first word and these others is that of times."""
    before = first in _BEFORE_TIME and bool(more) and more[0] in _TIMES | {"stamp"}
    is_labview = first == "x" and more in (["value"], ["values"])
    return first in _TIMES or before or is_labview


def names_a_frequency(name: str) -> bool:
    """Return True if a heading is that of frequencies other than those of a shaft."""
    words = words_of(name)
    return bool(words & _OF_A_FREQUENCY) and not words & _OF_A_SHAFT


_OF_A_FREQUENCY = {
    "f", "freq", "frequency", "frequencies", "frequenz", "fréquence", "hz", "khz", "cpm", "order",
    "orders", "ordnung", "ordnungen", "ordre",
}  # fmt: skip
_OF_A_SHAFT = {
    "shaft", "rot", "rotation", "rotational", "rotor", "running", "speed", "turning", "welle",
}  # fmt: skip


def place_in(name: str) -> str:
    """Return the place of the sensor by a heading or the name of a variable.

    >>> place_in("X105_DE_time"), place_in("Bearing 3 y"), place_in("vertical")
    ('drive end', 'bearing 3', '')
    """
    return next(iter(places_in(name)), "")


def places_in(name: str) -> list[str]:
    """Return all places in a name, those of a motor's ends first.

    >>> places_in("pump_DE_NDE.csv"), places_in("non drive end, bearing 1")
    (['drive end', 'non-drive end'], ['non-drive end', 'bearing 1'])
    """
    squeezed, words = re.sub(r"[\W_]+", "", name.lower()), words_of(name)
    places = []
    for phrase, place in _PHRASES:
        if phrase in squeezed:
            places.append(place)
            squeezed = squeezed.replace(phrase, " ")
    places += [place for word, place in _PLACES.items() if word in words]
    numbered = re.findall(
        r"(?:bearing|lager|brg)[ _-]?(\d+)|(?<![a-z0-9])b(\d)(?![a-z0-9])", name.lower()
    )
    places += [f"bearing {number or other}" for number, other in numbered]
    places += re.findall(r"(?<![a-z])point \d+", name.lower())
    return list(dict.fromkeys(places))


def words_of(heading: str) -> set[str]:
    """Return the words of a heading without units in brackets and numbers, as in "tacho2"."""
    bare = re.sub(r"[\[(].*?[\])]|(?<=[a-z]{4})\d{1,2}(?![a-z0-9])", " ", heading.lower())
    return {word for word in re.split(r"[^a-z0-9]+", bare) if word}


def choose(
    columns: Sequence[Column],
    moving: Sequence[bool],
    why: str,
    file_name: str = "",
    place: str = "",
) -> Choice:
    """Return the columns that are likely this bearing's, or a question about them.

    Sensors at several places never count as several directions.

    Parameters
    ----------
    columns
        columns of the table.
    moving
        True for each column whose numbers vary.
    why
        reason why the directions of the columns are known.
    file_name
        name of the file, which may name the place.
    place
        place of the bearing, if it is known.
    """
    signals = [
        index
        for index, column in enumerate(columns)
        if column.role == SIGNAL and moving[index] and column.direction != "z"
    ]
    axial = [i for i, column in enumerate(columns) if column.direction == "z" and moving[i]]
    if not signals and len(axial) == 1:
        return only_signal(columns[axial[0]].name, axial[0], why)
    if not signals and axial:
        words = "By their names all signals are along the shaft (z). Which is at this bearing?"
        return Choice({}, "", words, tuple(axial))
    if not signals and any(column.role == SIGNAL for column in columns):
        return Choice({}, "", "Every column is the same number throughout.")
    if not signals:
        return Choice({}, "", "No column looks like a signal of acceleration.")
    if len({columns[index].place for index in signals} - {""}) > 1:
        return _choose_by_place(columns, signals, why, file_name, place)
    return _choose_by_direction(columns, signals, why)


def _choose_by_place(
    columns: Sequence[Column], signals: Sequence[int], why: str, file_name: str, place: str
) -> Choice:
    """Choose the signals of the place that the file's name states, or that is known."""
    places = {columns[index].place for index in signals} - {""}
    named = [place for place in places_in(file_name) if place in places]
    stated = named[0] if len(named) == 1 else ""  # two places describe all of the file
    place = stated or place
    at_place = [index for index in signals if place and columns[index].place == place]
    if at_place:
        reason = f"the file's name says {stated}" if stated else why
        return _choose_by_direction(columns, at_place, reason)
    known = ", ".join(sorted(places))
    question = f"The file holds signals of several places ({known}). Which is at this bearing?"
    return Choice({}, "", question, tuple(signals))


def only_signal(name: str, index: int, why: str) -> Choice:
    """Choose the only signal of a file, without regard to its name."""
    reason = f"{why}, the only signal there" if why else "the only signal there"
    note = f"“{name}” is read as the vibration across the shaft, since it is the only signal."
    return Choice({"y": index}, reason, note=note)


def _choose_by_direction(columns: Sequence[Column], signals: Sequence[int], why: str) -> Choice:
    """Choose the signals of one place by their directions."""
    named = {axis: [i for i in signals if columns[i].direction == axis] for axis in ("x", "y")}
    if any(len(indices) > 1 for indices in named.values()):
        question = "The file holds several signals of one direction. Which is at this bearing?"
        return Choice({}, "", question, tuple(signals))
    by_name = {axis: indices[0] for axis, indices in named.items() if indices}
    if by_name:
        return Choice(by_name, why)
    if len(signals) == 1:
        only = "the only signal there; its direction is not stated"
        return Choice({"y": signals[0]}, f"{why}, {only}" if why else only)
    question = (
        f"The file holds {len(signals)} signals, and nothing says where or in which direction they "
        "were measured. Which is at this bearing?"
    )
    return Choice({}, "", question, tuple(signals))
