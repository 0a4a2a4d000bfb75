"""Units of measured signals: spellings in headings, and factors to SI units.

Kind         | SI unit | Conversion to acceleration
------------ | ------- | ------------------
acceleration | m/s²    | none
velocity     | m/s     | differentiated
voltage      | V       | divided by the sensor's sensitivity
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from types import MappingProxyType

import numpy as np

from bearingcore.common import Array, number
from bearingcore.units import INCH, STANDARD_GRAVITY

ACCELERATIONS: Mapping[str, float] = MappingProxyType(
    {
        "m/s²": 1.0,
        "g": STANDARD_GRAVITY,
        "mg": 1e-3 * STANDARD_GRAVITY,
        "mm/s²": 1e-3,
        "cm/s²": 1e-2,
        "in/s²": INCH,
        "ft/s²": 0.3048,
    }
)
"""[m/s²]"""

VELOCITIES: Mapping[str, float] = MappingProxyType(
    {"m/s": 1.0, "mm/s": 1e-3, "µm/s": 1e-6, "in/s": INCH}
)
"""[m/s]"""

VOLTAGES: Mapping[str, float] = MappingProxyType({"V": 1.0, "mV": 1e-3})
"""[V]"""

UNITS: Mapping[str, float] = MappingProxyType({**ACCELERATIONS, **VELOCITIES, **VOLTAGES})
"""All units that can be converted to acceleration, in the SI unit of their kind."""

_TIMES = {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0, "d": 86_400.0}
TIMES: Mapping[str, float] = MappingProxyType(_TIMES)
"""[s]"""

FORCES: Mapping[str, float] = MappingProxyType(
    {"N": 1.0, "kN": 1e3, "lb": 4.4482216, "kg": STANDARD_GRAVITY}
)
"""[N]"""

SPEEDS: Mapping[str, float] = MappingProxyType(
    {"rpm": 2.0 * np.pi / 60.0, "Hz": 2.0 * np.pi, "rad/s": 1.0}
)
"""[rad/s]"""

PULSE_TRAIN = "pulses"
"""The unit, given by hand, of a column that holds a tachometer's signal."""

_OTHERS = (
    "µm", "mm", "mil", "°C", "A", "%", "Pa", "bar", "Nm", "deg", "deg/s", "µT", "kHz", "dB", "km/h",
    "W", "kW", "l/min", "mA", "kA", "gE",
)  # fmt: skip

_WRITTEN = {
    "m/s²": "m/s2 m/s/s m/s^2 m/s**2 ms-2 ms^-2 ms⁻² m·s-2 m·s⁻² m*s-2 m*s^-2 mps2 m_s2 ms2 "
    "m_per_s2 m/sec2 m/sec^2 m/sec²",
    "g": "gs gn g_n g's g's g-s g-force gforce gee gees grav gravity gravities",
    "mg": "millig milli-g mgs",
    "mm/s²": "mm/s2 mm/s^2 mm/s**2 mms-2 mm_s2 mm_per_s2 mm/sec2 mm/sec²",
    "cm/s²": "cm/s2 cm/s^2 gal",
    "in/s²": "in/s2 in/s^2 in/sec2 in/sec^2 in/sec² ips2 in_per_s2 inch/s2 inch/s²",
    "ft/s²": "ft/s2 ft/s^2 ft/sec2",
    "m/s": "m/sec ms-1 mps m_per_s",
    "mm/s": "mm/sec mms-1 mm_s mm_per_s mmps",
    "µm/s": "um/s um/sec",
    "in/s": "ips in/sec inch/s in_per_s inch/sec",
    "V": "volt volts",
    "mV": "millivolt millivolts",
    "s": "sec secs second seconds sekunden sekunde",
    "ms": "msec msecs millis millisecond milliseconds millisekunden",
    "µs": "us usec usecs micros microsecond microseconds mikrosekunden",
    "ns": "nsec nsecs nanos nanosecond nanoseconds",
    "min": "minute minutes",
    "h": "hour hours",
    "d": "days",
    "N": "newton",
    "kN": "kilonewton",
    "lb": "lbs lbf",
    "kg": "kgf",
    "rpm": "1/min u/min r/min tr/min rev/min min-1 min^-1 cpm",
    "Hz": "1/s rev/s rps hertz sps s/s sa/s samples/s",
    "kHz": "ksps ks/s ksa/s",
    "rad/s": "rad_per_s",
    "µm": "um micron microns",
    "mil": "mils",
    "°C": "degc celsius",
    "deg": "°",
    "deg/s": "dps °/s",
    "µT": "ut",
    "A": "amp amps ampere amperes",
    "gE": "gse env-g g-env genv",
}
_ALIASES = {unit.lower(): unit for unit in (*UNITS, *_TIMES, *FORCES, *SPEEDS, *_OTHERS)}
_ALIASES |= {word: unit for unit, words in _WRITTEN.items() for word in words.split()}

_IN_BRACKETS = re.compile(r"[\[(]\s*([^\[\]()]{1,12}?(?:\(s\S{0,3}\))?)\s*[\])]")
_LOOSE = {
    "g", "gs", "mg", "v", "mv", "s", "ms", "us", "ns", "volt", "volts", "rpm", "g's", "hz", "n",
    "kn", "ips", "um", "µm", "mm", "mil", "mils", "db", "ge", "cpm",
}  # fmt: skip
"""Short words that are units at the end of a name, as in "sensor_g"."""

_DETECTOR = re.compile(r"[-_(]*(?:pk-?pk|p-?p|0-?pk?|rms|peak|pk|eff)\)?$")
"""A way to take the size of a signal, at the end of its unit: "g-pk", "mm/s RMS"."""

LEAST_LEVEL, GREATEST_LEVEL = 3e-3, 2e3
"""Least and greatest root mean square [m/s²] on housings of running bearings: from a shaft that
turns a few times a second (0.3 mg) to a machine that breaks apart (200 g)."""


def unit_named(text: str) -> str | None:
    """Return the unit that a text names, in the spelling of this module; None if it names none.

    >>> unit_named("m/s^2"), unit_named("in/sec²"), unit_named("furlongs")
    ('m/s²', 'in/s²', None)
    """
    bare = re.sub(r"\s+", "", text).replace("μ", "µ").rstrip(".").lower()
    bare = re.sub(r"\((s\S{0,3}?)\)", r"\1", bare)  # m/(s²)
    return _ALIASES.get(bare) or _ALIASES.get(_DETECTOR.sub("", bare))


def unit_in(heading: str) -> str | None:
    """Return the unit in the heading of a column, or None.

    >>> unit_in("acc x [mm/s^2]"), unit_in("sensor_g"), unit_in("acceleration_y_m_per_s2")
    ('mm/s²', 'g', 'm/s²')
    >>> unit_in("1/min")
    'rpm'
    """
    return next(filter(None, map(unit_named, _parts_like_units(heading))), None)


def _parts_like_units(heading: str) -> Iterator[str]:
    """Yield the parts of a heading that may be a unit, the most certain first."""
    heading = re.sub(r"(?i)[\[(](pk-?pk|peak|pk|rms)[\])]", "", heading)
    yield from _IN_BRACKETS.findall(heading)
    bare = heading.strip().lower()
    if "/" in bare:
        yield bare
    last = bare.split()[-1:]
    if last and len(bare) > len(last[0]) and re.search(r"/|²|s\^?-?2$", last[0]):
        yield last[0].lstrip("/")
    for mark in ("/", " in ", ","):
        before, _, after = bare.partition(mark)
        if before.strip():
            yield after
    words = re.split(r"[\s_.,;]+", bare)
    for count in (3, 2):  # "m_per_s2" is three words at the end of a name
        if len(words) > count:
            yield "_".join(words[-count:])
    # "g" or "s" alone may be a name
    short = words[-1] in _LOOSE or re.search(r"[/²]|2$", words[-1])
    if short and len(words[-1]) > (len(words) == 1):
        yield words[-1]


def kind_of(unit: str) -> str:
    """Return the quantity of a unit: "acceleration", "velocity", "voltage", "time" or "other"."""
    kinds = {"acceleration": ACCELERATIONS, "velocity": VELOCITIES}
    kinds |= {"voltage": VOLTAGES, "time": TIMES}
    return next((kind for kind, units in kinds.items() if unit in units), "other")


def differentiate(signal: Array, sample_rate: float) -> Array:
    """Return the rate of change of columns (n, d) at `sample_rate` [Hz], below half of it.

    The spectrum is multiplied by i·2πf. Before that the signal is extended by its point reflection
    at the last sample, so that no step appears at its ends.
    """
    n = len(signal)
    first, last = signal[:1], signal[-1:]
    extended = np.concatenate([signal, 2.0 * last - signal[-2:0:-1]])
    # without a straight line, both ends of the extended signal are equal
    slope = 2.0 * (last - first) / len(extended)
    line = slope * np.arange(len(extended))[:, None]
    frequency = np.fft.rfftfreq(len(extended), 1.0 / sample_rate)
    spectrum = np.fft.rfft(extended - line, axis=0) * (2j * np.pi * frequency)[:, None]
    if len(extended) % 2 == 0:
        spectrum[-1] = 0.0  # at half the rate the sign of a slope is unknown
    return np.fft.irfft(spectrum, len(extended), axis=0)[:n] + slope * sample_rate


def level_doubt(level: float) -> str:
    """Return a sentence if a root mean square [m/s²] is unusual for a running bearing, else "".

    >>> level_doubt(3.0)
    ''
    """
    size = "more" if level > GREATEST_LEVEL else "less" if level < LEAST_LEVEL else ""
    words = f"{number(level, 2)} m/s² ({number(level / STANDARD_GRAVITY, 2)} g) is {size}"
    return size and f"A root mean square of {words} than bearings give: the unit may be another."
