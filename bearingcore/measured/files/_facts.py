"""Facts of a file other than its signals: sample rate, shaft speed, load.

They are in single numbers of MATLAB files, in lines above a table, and in the file's name.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise, takewhile
from typing import Any, Generic, TypeVar

import numpy as np

from bearingcore.common import Array
from bearingcore.measured.files._units import FORCES, SPEEDS, TIMES, VOLTAGES, unit_in, unit_named
from bearingcore.units import STANDARD_GRAVITY

T = TypeVar("T")


@dataclass(frozen=True)
class Finding(Generic[T]):
    """A fact that a file states, or a guess.

    Attributes
    ----------
    value
        value in SI units (a sample rate in Hz, a shaft speed in rad/s, a load in N), or a name.
    reason
        place of the fact, or the reason why it is likely, in a few words.
    stated
        True if the file states it; False for a guess to be confirmed.
    supported
        True if there is evidence for a guess; False for a default.
    file_unit
        the unit in the file, if it is known; `value` is in SI units nevertheless.
    strong
        True if a guess is good enough to be used before it is confirmed, such as one that follows
        from a known collection.
    """

    value: T
    reason: str
    stated: bool = True
    supported: bool = True
    file_unit: str = ""
    strong: bool = False

    @property
    def in_file_unit(self) -> float:
        """The number of a shaft speed in the file's unit [file_unit]; in SI without a unit."""
        return float(self.value) / SPEEDS[self.file_unit or "rad/s"]  # type: ignore[arg-type]

    @property
    def taken(self) -> bool:
        """True if it is used without a question."""
        return self.stated or self.strong


@dataclass(frozen=True)
class Named:
    """A number with a name in a file, and with its unit if the file states it.

    `thousands` is True if its point may separate thousands: "12.000".
    """

    name: str
    value: float
    unit: str | None = None
    thousands: bool = False


_STEADY = 0.02


def is_steady(values: Array) -> bool:
    """Return True if numbers, such as speeds, vary so little that they count as constant."""
    return values.size > 0 and float(np.ptp(values)) <= _STEADY * float(values.mean())


MOST_REMARKS = 100
"""Greatest number of lines above the numbers."""

_NUMBER = r"[-+]?\.?\d(?:[\d.,]| (?=\d{3}\b))*(?:[eE][-+]?\d+)?"
_REMARK = re.compile(
    r"\W*([^\W\d][\w .()/\[\]°²µ-]{0,40}?)\s*[:=;,\t]\s*\"?"
    rf"({_NUMBER})\"?"
    r"[\s;,]*([^\W\d_][\w./^²-]{0,9}|1/min|°C)?\s*\W*"
)

_SEVERAL = re.compile(
    rf"([^\W\d][\w .()/\[\]°²µ-]{{0,40}}?)\s*[:=]\s*({_NUMBER})[ \t]*"
    r"([^\W\d_][\w/^²]{0,9}(?![\w ]*[:=])|1/min)?"
)
_WITH_UNIT = re.compile(
    rf"([^\W\d]\D{{0,40}}?)?\s*(?<![^\W_])({_NUMBER})\s*([^\W\d_][\w/]{{0,9}}|1/min)?\W*",
    re.IGNORECASE,
)
_OF_A_RATE = re.compile(r"k?hz|[km]?s(?:a|amples)?/s(?:ec)?|k?sps|rpm|1/min", re.IGNORECASE)
"""A number with a unit but without a mark or name before it; the units of a rate or a speed."""

_RATES = {
    "fs", "datarate", "acquisitionrate", "samplingrate", "odr", "samplespersec", "samplerate",
    "scanrate", "sr", "samplefrequency", "samplingfrequency", "samplefreq",
    "samplingfreq", "sampfreq", "samprate", "abtastrate", "abtastfrequenz", "samplespersecond",
    "fsample", "fsamp", "outputdatarate", "fsampling", "freqsampling",
}  # fmt: skip
_INTERVALS = {
    "dt", "deltat", "deltax", "sampleinterval", "samplinginterval", "timestep", "sampleperiod",
    "samplingperiod", "timeincrement", "abtastintervall", "ts", "wfincrement", "xincrement",
    "increment", "xincr", "xaxisdelta", "interval", "intervall", "sampleintervall",
    "samplespacing", "abscissainc", "horizontalinterval",
    "tinterval", "δt", "timeresolution", "sampletime", "samplestep", "xstep", "deltatime",
}  # fmt: skip
_FREQUENCIES = {
    "fr", "fshaft", "shaftfrequency", "shaftrate", "rotationfrequency", "rotationalfrequency",
    "shaftspeedhz", "speedhz", "rotationfreq", "shaftfreq", "frot", "drehfrequenz",
}  # fmt: skip
_SPEEDS = {
    "speed", "shaftspeed", "rotationspeed", "rotationalspeed", "rotatingspeed", "runningspeed",
    "motorspeed", "drehzahl", "shaft", "rotor", "welle",
}  # fmt: skip
BEARING_FREQUENCIES = ("bpfo", "bpfi", "ftf", "bsf")
"""Outer and inner race, cage, and one turn of a ball."""
_LOADS = {"load", "radialload", "last", "radiallast", "force", "radialforce", "loadn", "loadlb"}
_FACTS = _RATES | _INTERVALS | _FREQUENCIES | _SPEEDS | _LOADS | {"rpm"}

LEAST_STATED, GREATEST_STATED = 90.0, 5e6
"""Least and greatest sample rate [Hz] that needs no question; phones have inexact 100 Hz."""

LEAST_RATE = 500.0
"""Least "rate" [Hz] that is a sample rate; a lower one is that of the shaft."""

FASTEST_IN_HZ = 150.0
"""Greatest "speed" without a unit that is in Hz; a greater one is in rpm."""


def named_in(lines: Iterable[str]) -> list[Named]:
    """Return the numbers with a name in lines above a table, as in "Sample rate: 25.6 kHz"."""
    kept = [line.replace('"', "").strip() for line in islice(lines, MOST_REMARKS)]
    below = [item for pair in pairwise(kept) for item in _read_below(*pair)]
    return [*(item for line in kept for item in _read_line(line)), *below]


def _read_below(names: str, values: str) -> Iterator[Named]:
    """Yield a rate or an interval below its name, in a cell of an oscilloscope's headings."""
    above, below = ([c.strip(' "') for c in re.split(r"[\t;,]", line)] for line in (names, values))
    for name, text in zip(above, below, strict=False) if min(len(above), len(below)) > 1 else ():
        value = _number(text) if re.fullmatch(_NUMBER, text) else None
        if value is not None and _rate_key(name) in _FACTS:
            yield Named(name, value, unit_in(name))


def _read_line(line: str) -> Iterator[Named]:
    """Yield the numbers with a name in one line."""
    single = _REMARK.fullmatch(line)
    cells = [cell.strip(' "') for cell in re.split("\t" if "\t" in line else "[;,]", line)]
    several = len(cells) > 2 and re.match(r"[^\W\d]", cells[0]) and _number(cells[1]) is not None
    # the same number for each channel, or the setting of an instrument beside its numbers
    if several and (len({cell for cell in cells[1:] if cell}) == 1 or not cells[2]):
        named: list[tuple[Any, ...]] = [(cells[0], cells[1], None)]
    else:
        matches = [single] if single else [] if several else _SEVERAL.finditer(line)
        named = [match.groups() for match in matches]
    for name, text, unit in named or _read_unmarked(line):
        value = _number(text)
        if value is not None:
            unit = unit_named(unit) if unit else unit_in(name)
            grouped = re.fullmatch(r"\d{1,3}[.,]\d{3}", text) is not None
            yield Named(name.strip(" :;,=\t"), value, unit, grouped)


def _read_unmarked(line: str) -> Iterator[tuple[str, str, str | None]]:
    """Yield names, numbers and units of a line without marks between them, as in "1500 rpm"."""
    for part in dict.fromkeys((line, *re.split(r"[,;]\s", line))):
        match = _WITH_UNIT.fullmatch(part.strip())
        if match is not None and match[3] and _OF_A_RATE.fullmatch(match[3]):
            turns = unit_named(match[3]) == "rpm"
            yield match[1] or ("rpm" if turns else "rate"), match[2], match[3]
        elif match is not None and match[1] and {_key(match[1]), _rate_key(match[1])} & _FACTS:
            yield match[1], match[2], match[3]


def named_at(scalars: Mapping[str, float], texts: Mapping[str, str]) -> list[Named]:
    """Return single numbers with their units, which are in their names or in words beside them."""
    beside = {name: texts.get(f"{name.removesuffix('.value')}.unit", "") for name in scalars}
    return [Named(n, value, unit_in(n) or unit_named(beside[n])) for n, value in scalars.items()]


def names_a_fact(line: str) -> bool:
    """Return True if a line states a rate, a speed, a load, or anything after a mark."""
    keys = {_rate_key(item.name) for item in named_in([line])}
    return bool(keys & _FACTS) or any("rpm" in key for key in keys) or ":" in line or "=" in line


def _number(text: str) -> float | None:
    """Return a number that a person has written, with a point or a comma; None if it is none."""
    text = re.sub(r"(?<=\d) (?=\d{3}\b)", "", text.rstrip(".,"))
    if re.fullmatch(r"\d{1,3}(,\d{3})+(\.\d+)?", text):
        text = text.replace(",", "")
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _key(name: str) -> str:
    """Return letters and digits of a name's last part: "sr" of "bearing.sr", "samplerate"."""
    bare = re.sub(r"[\[(].*?[\])]|\.value$", "", name).rstrip(" _").rsplit(".", 1)[-1]
    return re.sub(r"[\W_]+", "", re.sub(r"_\d{1,2}$", "", bare)).lower()  # "Unit_1" of a channel


def _rate_key(name: str) -> str:
    """Return the key of a rate without its unit ("fs_hz") and its owner ("NI_CM_Dt")."""
    key = re.sub(r"(?<=\w\w)(in)?[km]?hz$", "", _key(name))
    bare, last = _OWNERS.sub("", key), re.sub(r".*[\s_]", "", name).lower()
    if last in ("odr", "fs", "dt") and not _OTHER_RATE.search(name):  # "LIS2DH12 ODR"
        return last
    return bare if bare in _RATES | _INTERVALS else key


_OWNERS = re.compile(
    r"^(nicm|ni|daq|adc|accel(eration)?|acc|imu|signal|waveform|sensor|vib|vibration|channel|ch"
    r"|measured|actual|effective)+"
)


_OTHER_RATE = re.compile(
    r"(?i)filter|cut.?off|pass|band|resonan|natural|alias|corner|start|stop|bw|span|bpf|bsf|ftf|max|lines|baud|bit"
)


def sample_rate_in(named: Sequence[Named], file_name: str) -> Finding[float] | None:
    """Return the sample rate [Hz] in facts or in the file's name."""
    rates: list[Finding[float]] = []
    in_hz = False
    for item in named:
        key, value = _rate_key(item.name), item.value
        if not (math.isfinite(value) and value > 0.0):
            continue
        if key in _RATES:
            rate = value * (1e3 if item.unit == "kHz" else 1.0)
            in_hz |= item.unit == "Hz" and not item.thousands
            rates.append(Finding(rate, f"“{item.name}” in the file"))
        step = value * TIMES.get(item.unit or "s", 1.0)
        # an interval without "sample" in its name may be that between recordings
        longest = 1.0 / LEAST_STATED if key.startswith("interval") else 1.0
        if key in _INTERVALS and step < longest:
            rates.append(Finding(1.0 / step, f"“{item.name}” in the file"))
    if rates:
        first = _doubt_if_others(rates[0], rates)
        if not first.stated or LEAST_STATED <= first.value <= GREATEST_STATED:
            return first
        if not in_hz and LEAST_RATE <= 1e3 * first.value <= GREATEST_STATED:
            return Finding(1e3 * first.value, f"{first.reason}, if it is in kHz", False)
        return dataclasses.replace(first, stated=False)
    return _likely_rate(named, file_name)


def _likely_rate(named: Sequence[Named], file_name: str) -> Finding[float] | None:
    """Return a likely sample rate [Hz]: from a number in Hz, or from the file's name."""
    for item in named:
        value = item.value * (1e3 if item.unit == "kHz" else 1.0)
        likely = _key(item.name).endswith("rate") or item.unit in ("Hz", "kHz")
        if value >= LEAST_RATE and likely and not _OTHER_RATE.search(item.name):
            return Finding(value, f"“{item.name}” in the file, if it is that of the samples", False)
    name = file_name.lower()
    for match in re.finditer(r"(?<![a-z0-9])(\d+\.?\d*)[ _-]?(k(?:hz|sps)?|hz)(?![a-z0-9])", name):
        value = float(match[1]) * (1.0 if match[2] == "hz" else 1e3)
        if value >= LEAST_RATE:
            words = f"“{match[0]}” in the file's name"
            return Finding(value, words, match[2] in ("khz", "ksps"), strong=True)
    return None


SLOWEST_RPM = 10.0
"""Speed below which a point before three digits probably separates thousands: 1.480."""

_OTHER_SPEED = re.compile(
    r"max|(?<![\dur])min|limit|rated|nominal|nenn|range|critical|full|set|soll|ref|target|command|cmd"
)


def names_a_limit(name: str) -> bool:
    """Return True if a speed with this name is set or allowed, but not measured."""
    return _OTHER_SPEED.search(_key(name)) is not None


def shaft_speed_in(named: Sequence[Named], file_name: str) -> Finding[float] | None:
    """Return the shaft speed [rad/s] in facts or in the file's name."""
    has_rate = bool({_key(item.name) for item in named} & (_RATES | _INTERVALS))
    speeds = [speed for item in named if (speed := _speed_of(item, has_rate)) is not None]
    match = re.search(
        r"(?:(?<![a-z0-9])|(?<=[a-z])(?=\d{3}))(\d+(?:\.\d+)?)[ _-]?rpm(?![a-z])", file_name.lower()
    )
    if match is not None and float(match[1]) > 0.0:
        words = f"“{match[0]}” in the file's name"
        turning = float(match[1]) * SPEEDS["rpm"]
        speeds.append(Finding(turning, words, stated=False, strong=True, file_unit="rpm"))
    if not speeds:
        return None
    first = next((other for other in speeds if other.stated), speeds[-1])
    return _doubt_if_others(first, filter(lambda other: other.taken, speeds))


def _speed_of(named: Named, has_rate: bool) -> Finding[float] | None:
    """Return the speed [rad/s] by one number; `has_rate` if another one is the sample rate."""
    key, value, unit = _key(named.name), named.value, named.unit
    words = f"“{named.name}” in the file"
    if not (math.isfinite(value) and value > 0.0):
        return None
    if ("rpm" in key or unit == "rpm") and names_a_limit(named.name):
        return None
    if "rpm" in key or unit == "rpm":
        grouped = named.thousands and value < SLOWEST_RPM  # 1.480
        turning = value * SPEEDS["rpm"] * (1e3 if grouped else 1.0)
        return Finding(turning, words, not grouped, strong=not grouped, file_unit="rpm")
    if key in _FREQUENCIES | _SPEEDS and unit is not None and unit in SPEEDS:
        return Finding(value * SPEEDS[unit], words, file_unit=unit)
    if key in _FREQUENCIES:
        return Finding(value * SPEEDS["Hz"], words, file_unit="Hz")
    if key in _SPEEDS and unit is None:
        unit = "Hz" if value <= FASTEST_IN_HZ else "rpm"
        reason = f"{words}, taken as {unit}"
        return Finding(value * SPEEDS[unit], reason, stated=False, file_unit=unit)
    if key == "rate" and value < LEAST_RATE and unit != "kHz":
        # one of two rates is that of the samples, the other that of the shaft
        return Finding(value * SPEEDS["Hz"], f"{words}, taken as Hz", stated=has_rate)
    return None


def _doubt_if_others(first: Finding[float], others: Iterable[Finding[float]]) -> Finding[float]:
    """Return the first of several findings; it is not stated if the file has another number."""
    if all(abs(other.value / first.value - 1.0) <= 0.005 for other in others):
        return first
    reason = f"{first.reason}, which names another one too"
    return dataclasses.replace(first, reason=reason, stated=False, strong=False)


def pulses_a_turn_in(named: Sequence[Named]) -> float | None:
    """Return the pulses of a tachometer in a turn, if the file states them."""
    return next((item.value for item in named if _PULSES.search(_key(item.name))), None)


_PULSES = re.compile(r"^ppr$|(puls\w*|teeth|marks|impulse)(per|pro|a)(rev|turn|umdrehung|u$)")


def load_in(named: Sequence[Named]) -> Finding[float] | None:
    """Return the load [N], if its unit is stated."""
    for item in named:
        key = _key(item.name)
        unit = item.unit or {"loadn": "N", "loadlb": "lb"}.get(key)
        if key in _LOADS and unit is not None and unit in FORCES and math.isfinite(item.value):
            return Finding(item.value * FORCES[unit], f"“{item.name}” in the file")
    return None


def bearing_frequencies_in(named: Sequence[Named]) -> dict[str, float]:
    """Return the stated frequencies [Hz] of a bearing, by the names of BEARING_FREQUENCIES."""
    return {
        key: item.value
        for item in named
        if (key := _key(item.name).removesuffix("hz")) in BEARING_FREQUENCIES
        and 0.0 < item.value < math.inf
    }


_SENSITIVITY = re.compile(rf"(?i)({_NUMBER})\s*(mV|V)\s?(?:/|per)\s?(g\b|\(?m/?s\S{{0,3}}[2²])")
"""A sensitivity, with any words around it: nothing else has this unit."""


def sensitivity_in(lines: Iterable[str]) -> Finding[float] | None:
    """Return the sensitivity [V/(m/s²)], if all lines with one agree."""
    values: dict[float, str] = {}
    for match in filter(None, map(_SENSITIVITY.search, lines)):
        per = STANDARD_GRAVITY if match[3].lower() == "g" else 1.0
        scale = VOLTAGES["V" if match[2] in "Vv" else "mV"] / per
        if value := _number(match[1]):
            values[value * scale] = f"“{match[0]}” in the file"
    return Finding(*values.popitem()) if len(values) == 1 else None


_DESIGNATION = re.compile(
    r"\b(?i:bearing|lager|wälzlager|roulement|rodamiento|cuscinetto)"
    r"(?:\s+(?i:type|typ|number|no|designation|code))?\W{1,6}"
    r"((?:[A-Z]{1,4}[ -]?)?\d{3,5}(?:[ /-]?[A-Z\d]{1,6})*)\b"
)


def designation_in(lines: Iterable[str]) -> Finding[str] | None:
    """Return the number of the bearing in lines such as "Bearing: SKF 6205-2RS C3".

    It is the text in the file; such a bearing may not exist. None for several numbers.
    """
    names = {match[1]: match[0] for line in lines for match in _DESIGNATION.finditer(line)}
    (text, words), *others = [*names.items()] or [("", "")]
    return Finding(text, f"“{words}” in the file") if text and not others else None


_OF_A_UNIT = re.compile(
    r"(ni|x?y|z|vertical|axis|accel(eration)?|acc|engineering|eng|data|signal|channel|sensor|value"
    r"|amplitude|measure(d|ment)|physical|ordinate)*"
    r"(units?|einheit(en)?|eu|quantity|measurand|ordinate)(string|label|name|description|ofmeasure)?"
    r"|(y|vertical|value)(axis(label|title)?|label)"
)
"""The name of a unit or of a quantity, as a key: "yunitlabel", "unitstring", "measuredquantity"."""


def unit_of(name: str, text: str) -> str | None:
    """Return the unit in a text whose name is such as "unit" or "quantity", or None."""
    bare = text.strip(" ;,\t\"'[]()")
    is_unit = _OF_A_UNIT.fullmatch(_key(name))
    return unit_named(bare) or unit_in(text.strip(' "')) if is_unit else None


def stated_units(lines: Iterable[str], texts: Mapping[str, str]) -> list[str | None]:
    """Return units in lines such as "Unit: g": one for all columns, or one for each channel."""
    for line in lines:
        name, _, text = re.sub(r"[:=\t;,]", "\0", line, count=1).partition("\0")
        cells = re.split(r"[\t;,]", text.strip(" \t;,"))
        pairs = [(cell.strip(), unit_of(name, cell)) for cell in takewhile(str.strip, cells)]
        # skip words and numbers, such as a quantity or the number of a column before its unit
        units = [unit for cell, unit in pairs if unit or not re.search(r"\w", cell)]
        if any(units):
            return units if len(set(units)) > 1 else units[:1]
    shared = {unit_of(name, text) for name, text in texts.items()} - {None, *TIMES, *SPEEDS}
    return list(shared) if len(shared) == 1 else []
