"""Trend of a machine: the numbers of one recording, and of many in their order."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from bearingcore.bearings import Bearing, BearingLike, bearing_of
from bearingcore.common import Array, ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.measured.diagnosis import CANNOT_TELL, NARROWEST, PARTS, SLIP, diagnose, part_lines
from bearingcore.measured.files import time_in
from bearingcore.measured.signals import indicators, kurtogram, local_median
from bearingcore.recordings import Recording, Spectrum, envelope_spectrum
from bearingcore.sizing._measure_extent import MeasuredExtent, measure_extent

LINES = ("bpfo", "bpfi", "bsf_2", "ftf")
"""Lines of outer race, inner race, ball (twice its spin) and cage."""

LINES_A_TURN = 16.0
"""Resolution of the envelope spectrum in parts of the shaft speed, if the signal is so long."""

LOWEST_LINE = 3.0
"""Lowest frequency of a line that is searched, relative to the resolution."""

SURROUNDINGS, FEWEST_AROUND = 2.0, 9
"""Width over which the median is the background, in shaft frequencies; fewest lines in it."""

CHANCE = 1e-3
"""Probability that noise alone reaches the level above which a line counts."""

OF_THE_SHAFT = 0.6
"""Greatest distance of a shaft's tone from a multiple of the shaft speed, in lines of the finest
spectrum: a steady tone shows at most half a line away."""

HANN_WIDTH = 1.5
"""Noise bandwidth of Hann's window, in lines."""

FIRST_BAND = 5.0
"""Lowest frequency at which the band of the envelope is searched, over BPFO."""

HIGHEST_SHARE = 0.49
"""Share of the sample rate that a band may reach."""


@dataclass(frozen=True)
class TrendPoint:
    """Numbers of one recording along one direction.

    Attributes
    ----------
    name
        of the recording.
    shaft_speed
        [rad/s]; NaN if it is neither given nor shown by the signal.
    rms, peak
        [m/s²]
    crest_factor, kurtosis
        see `indicators`.
    lines, noise : (4,) [m/s²]
        amplitude of each of `LINES` in the envelope, and the level that noise reaches there in one
        of a thousand recordings. NaN if the recording is too short or does not cover the band, if
        bearing or speed are unknown, or if the highest line is a multiple of the shaft's.
    fault, probability
        see `Diagnosis`; "cannot tell" and NaN for an unknown bearing.
    extent
        extent of the spall if a race is named.
    recorded
        date and time of the recording, or those in its name; None if it has neither.
    """

    name: str
    shaft_speed: float
    rms: float
    peak: float
    crest_factor: float
    kurtosis: float
    lines: Array
    noise: Array
    fault: str
    probability: float
    extent: MeasuredExtent
    recorded: datetime | None = None


@shown_as_table
@dataclass(frozen=True)
class Trend:
    """Trend of k recordings of one machine, in their order.

    Attributes
    ----------
    points
        the numbers of each recording.
    direction
        direction of the signal.
    band
        [Hz] of the envelope, the same for all.
    baseline
        number of the recording with which the others are compared.
    """

    points: tuple[TrendPoint, ...]
    direction: str
    band: tuple[float, float]
    baseline: int = 0

    def __post_init__(self) -> None:
        last = max(len(self.points) - 1, 0)
        checks.whole_number("baseline", self.baseline, at_least=0, at_most=last)

    def column(self, name: str) -> Array:
        """Return an attribute of all points, (k,) or (k, 4)."""
        return np.array([getattr(point, name) for point in self.points], dtype=float)

    @property
    def clear_lines(self) -> Array:
        """Amplitudes (k, 4) [m/s²] of lines that are more than noise; NaN for the others."""
        lines, noise = self.column("lines"), self.column("noise")
        return np.where(lines > noise, lines, math.nan)

    @property
    def rms_change(self) -> Array:
        """Root mean square (k,) over that of the baseline."""
        rms = self.column("rms")
        return np.asarray(rms / rms[self.baseline])

    def line_change(self, part: str) -> Array:
        """Return the amplitude (k,) of a part's line over that of the baseline; NaN without a line.

        If the baseline has no line, the ratio is to the noise there, which makes it a lower bound.
        """
        place = PARTS.index(part)
        first = np.fmax(self.column("lines"), self.column("noise"))[self.baseline, place]
        return np.asarray(self.clear_lines[:, place] / first)

    @property
    def hours(self) -> Array:
        """Time (k,) since the first recording [h]; NaN unless all have a date."""
        dates = [point.recorded for point in self.points if point.recorded is not None]
        if len(dates) < len(self.points):
            return np.full(len(self.points), math.nan)
        return np.array([(date - dates[0]).total_seconds() / 3600.0 for date in dates])

    def seen_since(self, part: str) -> int | None:
        """Return the number of the recording from which on a part's line is more than noise.

        None if it is not in the last recording.
        """
        hidden = np.flatnonzero(np.isnan(self.clear_lines[:, PARTS.index(part)]))
        first = int(hidden[-1]) + 1 if hidden.size else 0
        return first if first < len(self.points) else None

    def table(self) -> ResultTable:
        """Return a row for each recording."""
        points, clear = self.points, self.clear_lines
        extents = [point.extent for point in points]
        return table_of(
            ("recording", "", [point.name for point in points]),
            ("time", "s", 3600.0 * self.hours, "since the first"),
            ("shaft_speed", "rad/s", self.column("shaft_speed")),
            ("rms", "m/s²", self.column("rms")),
            ("rms_change", "1", self.rms_change, "over that of the baseline"),
            ("peak", "m/s²", self.column("peak")),
            ("crest_factor", "1", self.column("crest_factor")),
            ("kurtosis", "1", self.column("kurtosis")),
            *(
                (f"{name}_line", "m/s²", clear[:, k], "in the envelope; NaN: below noise")
                for k, name in enumerate(LINES)
            ),
            ("fault", "", [point.fault for point in points]),
            ("probability", "1", self.column("probability")),
            ("extent", "rad", [extent.extent for extent in extents]),
            ("extent_low", "rad", [extent.low for extent in extents], "95 % from here"),
            ("extent_high", "rad", [extent.high for extent in extents], "to here, or a bound"),
            ("extent_status", "", [str(extent.status.value) for extent in extents]),
        )


def trend(
    recordings: Sequence[Recording],
    bearing: BearingLike | None,
    shaft_speed: float | tuple[float, float] | None = None,
    *,
    direction: str | None = None,
    band: tuple[float, float] | None = None,
    baseline: int = 0,
    goes_on: Callable[[Trend, int], bool] = lambda so_far, of: True,
) -> Trend:
    """Compute the trend of several recordings of one machine, in the order given.

    Parameters
    ----------
    recordings
        recordings, at least one.
    bearing
        the measured bearing; None if it is unknown: no part is then named.
    shaft_speed
        [rad/s] of recordings that state none, a pair (from, to) if it is rough, None if it is
        unknown: `diagnose` then searches for it in each recording.
    direction
        "x" or "y"; None: the last of the last recording.
    band
        [Hz] of the envelope; None: the band where the kurtogram of the last recording is highest.
    baseline
        number of the recording with which the others are compared.
    goes_on
        called with the trend so far and the number of recordings; False ends the work.

    Raises
    ------
    ValueError
        for no recording, a recording without the direction, a baseline out of range, an impossible
        band or speed, and for unlike rows of balls.
    """
    bearing = None if bearing is None else bearing_of(bearing)
    if not recordings:
        raise checks.refuse("recordings", "none", "one at least")
    checks.whole_number("baseline", baseline, at_least=0, at_most=len(recordings) - 1)
    along = recordings[-1].directions[-1] if direction is None else direction
    for recording in recordings:
        checks.instance("recordings", recording, Recording, "a sequence of Recording")
        checks.choice(f"direction of {recording.name}", along, recording.directions)
    last = recordings[-1]
    if band is None:
        band = _impulsive_band(last, bearing, _known_speed(last.shaft_speed or shaft_speed), along)
    low = checks.real_number("lower end of the band", band[0], above=0.0, unit="Hz")
    high = checks.real_number("upper end of the band", band[1], above=low, unit="Hz")
    done: tuple[TrendPoint, ...] = ()
    for recording in recordings:
        speed = recording.shaft_speed or shaft_speed
        done += (trend_point(recording, bearing, speed, along, (low, high)),)
        so_far = Trend(done, along, (low, high), baseline if baseline < len(done) else 0)
        if not goes_on(so_far, len(recordings)):
            break
    return so_far


def trend_point(
    recording: Recording,
    bearing: BearingLike | None,
    shaft_speed: float | tuple[float, float] | None,
    direction: str,
    band: tuple[float, float],
) -> TrendPoint:
    """Compute the numbers of one recording; all arguments of `trend` are necessary."""
    checks.instance("recording", recording, Recording)
    bearing = None if bearing is None else bearing_of(bearing)
    column = recording.directions.index(direction)
    speed = _known_speed(shaft_speed)
    fault, probability, extent = CANNOT_TELL, math.nan, MeasuredExtent()
    lines = noise = np.full(len(LINES), math.nan)
    if bearing is not None:
        answer = diagnose(recording, bearing, shaft_speed)
        fault, probability = answer.fault, answer.probability
        extent = measure_extent(recording, bearing, shaft_speed, diagnosis=answer)
        steady = answer.steady_recording or recording
        exact_speed = answer.shaft_speed or speed  # by the lines of the shaft, if they show it
        speed = speed or exact_speed
        if exact_speed is not None:
            lines, noise = _line_amplitudes(steady, bearing, exact_speed, column, band)
    values = indicators(recording, speed)
    return TrendPoint(
        recording.name,
        math.nan if speed is None else speed,
        float(values.rms[column]),
        float(values.peak[column]),
        float(values.crest_factor[column]),
        float(values.kurtosis[column]),
        lines,
        noise,
        fault,
        probability,
        extent,
        recording.recorded or time_in(recording.name),
    )


def _known_speed(shaft_speed: float | tuple[float, float] | None) -> float | None:
    """Return a known shaft speed [rad/s]; None where it is rough or unknown."""
    if shaft_speed is None or isinstance(shaft_speed, tuple):
        return None
    return checks.real_number("shaft_speed", shaft_speed, above=0.0, unit="rad/s")


def _impulsive_band(
    recording: Recording, bearing: Bearing | None, shaft_speed: float | None, direction: str
) -> tuple[float, float]:
    """Return the band [Hz] where the kurtogram of a recording is highest."""
    signal = recording.acceleration[:, recording.directions.index(direction)]
    highest = HIGHEST_SHARE * recording.sample_rate
    speed = shaft_speed or 0.0
    passing = 0.0 if bearing is None else bearing.bpfo(speed)
    lowest = min(FIRST_BAND * passing, 0.25 * highest)
    narrowest = NARROWEST * speed / (2.0 * math.pi)
    low, high = kurtogram(signal, recording.sample_rate, narrowest).best(lowest)
    return low, min(high, highest)


def _line_amplitudes(
    recording: Recording,
    bearing: Bearing,
    shaft_speed: float,
    column: int,
    band: tuple[float, float],
) -> tuple[Array, Array]:
    """Return amplitudes (4,) of `LINES` in the envelope, and the levels of noise there [m/s²]."""
    from scipy.special import gammaincinv  # imported late: see `spectrum`

    shaft = shaft_speed / (2.0 * math.pi)
    orders = [*(line.order for line in part_lines(bearing)), bearing.ftf(2.0 * math.pi)]
    unknown = np.full(len(LINES), math.nan)
    if band[1] > HIGHEST_SHARE * recording.sample_rate:
        return unknown, unknown
    step = max(1.0 / recording.duration, shaft / LINES_A_TURN)
    signal = recording.acceleration[:, column]
    frequency, density = envelope_spectrum(signal, recording.sample_rate, band, step)
    step = float(frequency[1] - frequency[0])
    averages = max(1, math.floor(recording.duration * step))
    around = max(round(SURROUNDINGS * shaft / step), FEWEST_AROUND) | 1
    if len(frequency) < around:
        return unknown, unknown
    # means of so many spectra of noise have a gamma distribution, whose median is not its mean
    background = local_median(density, around) / float(gammaincinv(averages, 0.5))
    finest = envelope_spectrum(signal, recording.sample_rate, band)
    lines, noise = unknown.copy(), unknown.copy()
    for k, order in enumerate(orders):
        middle, reach = order * shaft / step, order * shaft * SLIP / step + 1.0
        first, last = math.floor(middle - reach), math.ceil(middle + reach) + 1
        if middle < LOWEST_LINE or last > len(density):
            continue
        if _is_shaft_line(finest, order * shaft, shaft):
            continue
        limit = float(gammaincinv(averages, 1.0 - CHANCE / (last - first)))
        peak = first + int(density[first:last].argmax())
        # the peak alone has 0.72 of the power of a tone between two lines, three lines 0.98 to 1
        near = slice(max(peak - 1, 0), peak + 2)
        whole = float((density[near] - background[near]).sum()) / HANN_WIDTH
        power = max(density[peak], whole), limit * background[first:last].max()
        lines[k], noise[k] = np.sqrt(2.0 * HANN_WIDTH * step * np.array(power))
    return lines, noise


def _is_shaft_line(finest: Spectrum, line: float, shaft: float) -> bool:
    """Return True if the highest line near one of the bearing [Hz] is a multiple of the shaft's.

    Such lines come from gears, vanes and loose parts, not from damage of the bearing.
    """
    first, last = np.searchsorted(finest.frequency, line * np.array([1.0 - SLIP, 1.0 + SLIP]))
    peak = finest.frequency[first + int(finest.density[first : last + 1].argmax())]
    multiple = round(peak / shaft) * shaft
    return bool(multiple and abs(peak - multiple) <= OF_THE_SHAFT * finest.frequency[1])
