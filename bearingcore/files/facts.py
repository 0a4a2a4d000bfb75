"""Facts in a file apart from its signals: sample rate, shaft speed, load.

They are in single numbers of MATLAB files, in lines above a table, and in the file's name.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from bearingcore.files.units import FORCES, SPEEDS, TIMES, unit_in, unit_named

T = TypeVar("T")


@dataclass(frozen=True)
class Finding(Generic[T]):
    """Something that a file says, or that is guessed.

    Attributes
    ----------
    value
        in SI units: Hz of a sample rate, rad/s of a shaft speed, N of a load; words of a name.
    reason
        its place, or why it is likely, in a few words.
    stated
        whether the file says so; else it is a guess to be confirmed.
    supported
        whether anything speaks for a guess; else the value is a default.
    file_unit
        the unit in which the file gives it, where that is known; `value` is in SI all the same.
    strong
        whether a guess is good enough to be taken before it is confirmed, as those that follow
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
        """The number of a shaft speed as the file gives it [file_unit]; in SI where no unit is."""
        return float(self.value) / SPEEDS[self.file_unit or "rad/s"]  # type: ignore[arg-type]

    @property
    def taken(self) -> bool:
        """Whether it is taken without a question."""
        return self.stated or self.strong


@dataclass(frozen=True)
class Named:
    """A number that a file names, with its unit where that is said."""

    name: str
    value: float
    unit: str | None = None


MOST_REMARKS = 100

_REMARK = re.compile(
    r"\W*([^\W\d][\w .()/\[\]°²µ-]{0,40}?)\s*[:=;,\t]\s*\"?([-+]?\d[\d.,]*(?:[eE][-+]?\d+)?)\"?"
    r"[\s;,]*([^\W\d_][\w./^²-]{0,9}|1/min|°C)?\s*\W*"
)

_RATES = {
    "fs", "sr", "samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "samplefreq",
    "samplingfreq", "sampfreq", "samprate", "abtastrate", "abtastfrequenz", "samplespersecond",
    "fsample", "fsamp", "fshz", "sampleratehz", "samplingratehz", "samplingfrequencyhz", "srhz",
}  # fmt: skip
_INTERVALS = {
    "dt", "deltat", "deltax", "sampleinterval", "samplinginterval", "timestep", "sampleperiod",
    "samplingperiod", "timeincrement", "abtastintervall", "ts",
}  # fmt: skip
_FREQUENCIES = {
    "fr", "fshaft", "shaftfrequency", "shaftrate", "rotationfrequency", "rotationalfrequency",
    "shaftspeedhz", "speedhz", "rotationfreq", "shaftfreq", "frot", "drehfrequenz",
}  # fmt: skip
_SPEEDS = {
    "speed", "shaftspeed", "rotationspeed", "rotationalspeed", "rotatingspeed", "runningspeed",
    "motorspeed", "drehzahl",
}  # fmt: skip
BEARING_FREQUENCIES = ("bpfo", "bpfi", "ftf", "bsf")
"""Outer and inner race, cage, and one turn of a ball."""
_LOADS = {"load", "radialload", "last", "radiallast", "force", "radialforce", "loadn", "loadlb"}

LEAST_RATE = 500.0
"""[Hz] below which a "rate" is the shaft's, not that of the samples."""

FASTEST_IN_HZ = 150.0
"""A "speed" without a unit is in Hz up to here, in rpm above."""


def named_in(lines: Iterable[str]) -> list[Named]:
    """The numbers that lines above a table name, such as "Sample rate: 25.6 kHz"."""
    found = []
    for number, line in enumerate(lines):
        if number >= MOST_REMARKS:
            break
        match = _REMARK.fullmatch(line.strip())
        if match is None:
            continue
        name, text, unit = match.groups()
        value = _number(text)
        if value is not None:
            of_unit = unit_named(unit) if unit else unit_in(name)
            found.append(Named(name.strip(), value, of_unit))
    return found


def _number(text: str) -> float | None:
    """A number as a person writes it, with a point or a comma."""
    if re.fullmatch(r"\d{1,3}(,\d{3})+(\.\d+)?", text):
        text = text.replace(",", "")
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _key(name: str) -> str:
    """The last part of a name, letters and digits only: "bearing.sr" and "Sample rate" as keys."""
    bare = re.sub(r"[\[(].*?[\])]", "", name).rsplit(".", 1)[-1]
    return re.sub(r"[\W_]+", "", bare).lower()


def sample_rate_in(named: Sequence[Named], file_name: str) -> Finding[float] | None:
    """[Hz]"""
    for one in named:
        key, value = _key(one.name), one.value
        if not (math.isfinite(value) and value > 0.0):
            continue
        if key in _RATES:
            rate = value * (1e3 if one.unit == "kHz" else 1.0)
            return Finding(rate, f"“{one.name}” in the file")
        if key in _INTERVALS and value < 1.0:
            step = value * TIMES.get(one.unit or "s", 1.0)
            return Finding(1.0 / step, f"“{one.name}” in the file")
    for one in named:
        if _key(one.name) == "rate" and one.value >= LEAST_RATE:
            return Finding(
                one.value, f"“{one.name}” in the file, if it is that of the samples", False
            )
    match = re.search(
        r"(?<![a-z0-9])(\d+(?:\.\d+)?)[ _-]?k(hz|sps)?(?![a-z0-9])", file_name.lower()
    )
    if match is not None and float(match[1]) > 0.0:
        words = f"“{match[0]}” in the file's name"
        return Finding(1e3 * float(match[1]), words, match[2] is not None, strong=True)
    return None


def shaft_speed_in(named: Sequence[Named], file_name: str) -> Finding[float] | None:
    """[rad/s]"""
    found: list[Finding[float]] = []
    rates = {_key(one.name) for one in named} & (_RATES | _INTERVALS)
    for one in named:
        key, value = _key(one.name), one.value
        if not (math.isfinite(value) and value > 0.0):
            continue
        words = f"“{one.name}” in the file"
        if "rpm" in key or (one.unit == "rpm" and key in _SPEEDS | {"n"}):
            found.append(Finding(value * SPEEDS["rpm"], words, file_unit="rpm"))
        elif key in _FREQUENCIES:
            unit = one.unit if one.unit is not None and one.unit in SPEEDS else "Hz"
            found.append(Finding(value * SPEEDS[unit], words, file_unit=unit))
        elif key in _SPEEDS:
            if one.unit is not None and one.unit in SPEEDS:
                found.append(Finding(value * SPEEDS[one.unit], words, file_unit=one.unit))
            else:
                unit = "Hz" if value <= FASTEST_IN_HZ else "rpm"
                taken = f"{words}, taken as {unit}"
                found.append(Finding(value * SPEEDS[unit], taken, False, file_unit=unit))
        elif key == "rate" and value < LEAST_RATE:
            stated = bool(rates)  # two rates: one is that of the samples, the other the shaft's
            found.append(Finding(value * SPEEDS["Hz"], f"{words}, taken as Hz", stated))
    match = re.search(r"(?<![a-z0-9])(\d+(?:\.\d+)?)[ _-]?rpm(?![a-z])", file_name.lower())
    if match is not None and float(match[1]) > 0.0:
        words = f"“{match[0]}” in the file's name"
        found.append(Finding(float(match[1]) * SPEEDS["rpm"], words, file_unit="rpm"))
    if not found:
        return None
    first = next((one for one in found if one.stated), found[0])
    if any(one.stated and abs(one.value / first.value - 1.0) > 0.005 for one in found):
        reason = f"{first.reason}, which names another one too"
        return dataclasses.replace(first, reason=reason, stated=False)
    return first


def load_in(named: Sequence[Named]) -> Finding[float] | None:
    """[N], where its unit is said."""
    for one in named:
        key = _key(one.name)
        unit = one.unit or {"loadn": "N", "loadlb": "lb"}.get(key)
        if key in _LOADS and unit is not None and unit in FORCES and math.isfinite(one.value):
            return Finding(one.value * FORCES[unit], f"“{one.name}” in the file")
    return None


def bearing_frequencies_in(named: Sequence[Named]) -> dict[str, float]:
    """[Hz] by the names of BEARING_FREQUENCIES, those that are there."""
    return {
        key: one.value
        for one in named
        if (key := _key(one.name).removesuffix("hz")) in BEARING_FREQUENCIES
        and math.isfinite(one.value)
        and one.value > 0.0
    }


def unit_said(lines: Iterable[str], texts: Mapping[str, str]) -> str | None:
    """The unit that a line such as "Unit: g" gives to all columns, or None."""
    pairs = [line.partition(mark)[::2] for line in lines for mark in (":", "=") if mark in line]
    for name, text in [*pairs, *texts.items()]:
        if _key(name) in ("unit", "units", "einheit", "yunit", "yunits", "yunitlabel"):
            unit = unit_named(text.strip(" ;,\t\"'[]()"))
            if unit is not None:
                return unit
    return None
