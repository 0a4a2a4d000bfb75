"""The extent of a spall from entry to exit, with its interval."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.bearings.bearing import Bearing
from bearingcore.bearings.named import BearingLike, bearing_of
from bearingcore.common import checks
from bearingcore.common.table import ResultTable, shown_as_table, table_of
from bearingcore.diagnosis.extent.knocks import Knocks, MeanPass, Seen, find_knocks
from bearingcore.diagnosis.extent.release import plausible_offsets
from bearingcore.diagnosis.part.diagnose import diagnose
from bearingcore.diagnosis.part.evidence import Diagnosis
from bearingcore.diagnosis.part.parts import INNER, OUTER
from bearingcore.errors import Status
from bearingcore.scene.defect import RACES
from bearingcore.signals.averaging import least_passes
from bearingcore.signals.recording import Recording

SLIP = 0.02
"""By how much balls may pass faster or slower than the shaft speed says."""

SLIP_OF_LINES = 0.004
"""The same about lines that a diagnosis has found."""

SAMPLES_A_DEGREE = 1.0
"""Of the recording for a degree of the race, below which knocks cannot be located."""


NO_ANSWER = "no clear result"

LONGEST_BOUND = 1.0 / 3.0
"""Of a ball spacing, from which a bound would say nothing."""


class ExtentStatus(Status):
    """The outcome of a measurement of the extent."""

    MEASURED = "measured"
    EITHER = "either way round"
    SHORTER = "shorter"
    ONE_KNOCK = "one knock"
    UNCLEAR = "unclear"
    BOUNCES = "bounces"
    NO_RACE = "no race"
    NOT_VISIBLE = "not visible"
    TOO_SHORT = "too short"
    TOO_COARSE = "too coarse"

    @property
    def sentence(self) -> str:
        """The status as a sentence."""
        return _SENTENCES[self]


_SENTENCES = {
    ExtentStatus.MEASURED: "Entry and exit are separate in the mean ball pass.",
    ExtentStatus.EITHER: "Entry and exit are separate, but it is not clear which is which.",
    ExtentStatus.SHORTER: "Entry and exit are too close together to be separated.",
    ExtentStatus.ONE_KNOCK: (
        "There is one impact a ball pass: from a pit, or a longer spall with a faint entry."
    ),
    ExtentStatus.UNCLEAR: (
        "Frequency bands do not agree on two impacts a ball pass: ringing hides them, or the balls "
        "meet the damage differently."
    ),
    ExtentStatus.BOUNCES: (
        "Two impacts a ball pass differ in height, and the later is no sharper than the earlier: a "
        "ball that bounces or an echo, not entry and exit."
    ),
    ExtentStatus.NO_RACE: "No damaged race is named, so there is no extent to measure.",
    ExtentStatus.NOT_VISIBLE: "Nothing repeats clearly with the ball passes of this race.",
    ExtentStatus.TOO_SHORT: "The recording holds too few ball passes for a mean.",
    ExtentStatus.TOO_COARSE: "The sample rate is too low to locate impacts on the race.",
}


@shown_as_table
@dataclass(frozen=True)
class MeasuredExtent:
    """The extent of a spall, measured from entry to exit.

    Attributes
    ----------
    race
        "outer" or "inner"; "" where no race is named.
    extent, low, high
        [rad] and the interval in which it lies with 95 %. NaN where there is none; where there is
        only a bound, `extent` is NaN and `high` is the bound.
    separation, deviation
        [rad] of the race between the peaks of entry and exit, and its standard deviation. Where
        either may be the entry, the shorter way.
    offset
        [rad] added to it: the median of the angle over which a ball carries nothing yet or no
        longer, see `release`.
    ball_spacing
        [rad]. A longer spall with whole ball spacings more gives the same passes.
    passes
        mean ball passes of the bands that decided, the best first; empty where there are none.
    entry, exit
        places of the two peaks in the first of `passes`, as shares of a ball pass; NaN without.
    frequency
        ball passes a second over the race [Hz].
    n_passes
        how many were averaged.
    length
        of the extent along the race [m]; NaN where there is none.
    status
        how it ended.
    """

    race: str
    extent: float
    low: float
    high: float
    separation: float
    deviation: float
    offset: float
    ball_spacing: float
    passes: tuple[MeanPass, ...] = field(repr=False)
    entry: float
    exit: float
    frequency: float
    n_passes: int
    length: float
    status: ExtentStatus

    @property
    def measured(self) -> bool:
        """Whether there is an extent."""
        return self.status == ExtentStatus.MEASURED

    @property
    def answer(self) -> str:
        """The answer in a few words: "5.0° (4.3-5.9°), 2.0 mm, outer race"."""
        return f"{self.size}, {self.race} race" if self.size else NO_ANSWER

    @property
    def size(self) -> str:
        """The answer without its race: "5.0° (4.3-5.9°), 2.0 mm"; empty where there is none."""
        extent, low, high = np.degrees([self.extent, self.low, self.high])
        if self.status == ExtentStatus.MEASURED:
            long = f", {1e3 * self.length:.1f} mm" if math.isfinite(self.length) else ""
            return f"{extent:.1f}° ({low:.1f}-{high:.1f}°){long}"
        if self.status == ExtentStatus.EITHER:
            one, other = np.degrees(
                [self.separation + self.offset, self.ball_spacing - self.separation + self.offset]
            )
            return f"{one:.1f}° or {other:.1f}°"
        if self.status == ExtentStatus.SHORTER:
            return f"shorter than about {high:.0f}° or near whole ball spacings"
        return ""

    @property
    def sentence(self) -> str:
        """The answer in a sentence, or why there is none."""
        if self.answer == NO_ANSWER:
            return self.status.sentence
        spacing = math.degrees(self.ball_spacing)
        if self.status == ExtentStatus.SHORTER:
            return f"{self.answer} ({spacing:.1f}° each). {self.status.sentence}"
        words = f"{self.answer}; or that and whole ball spacings of {spacing:.1f}°."
        return words if self.measured else f"{words} {self.status.sentence}"

    def table(self) -> ResultTable:
        """One row with the answer; below it the mean ball pass of the best band over angle."""
        rows = table_of(
            ("race", "", [self.race]),
            ("status", "", [str(self.status)]),
            ("extent", "rad", [self.extent]),
            ("low", "rad", [self.low], "of the interval with 95 %"),
            ("high", "rad", [self.high], "of the interval with 95 %"),
            ("separation", "rad", [self.separation], "from the entry's peak to the exit's"),
            ("separation_deviation", "rad", [self.deviation]),
            ("offset", "rad", [self.offset], "over which a ball is not loaded at the edges"),
            ("length", "m", [self.length], "along the race"),
            ("frequency", "Hz", [self.frequency], "of ball passes"),
            ("ball_passes", "", [self.n_passes]),
        )
        if not self.passes:
            return rows
        best = self.passes[0]
        angle = self.ball_spacing * np.arange(len(best.envelope)) / len(best.envelope)
        return rows | table_of(
            ("angle", "rad", angle, "of the race, from an arbitrary start"),
            ("envelope", "1", best.envelope, "mean over the ball passes, of its mean"),
            ("envelope_error", "1", np.full(len(angle), best.error), "standard error"),
        )


def measure_extent(
    recording: Recording,
    bearing: BearingLike,
    shaft_speed: float | tuple[float, float] | None,
    *,
    race: str | None = None,
    load: float | None = None,
    clearance: float | None = None,
    diagnosis: Diagnosis | None = None,
) -> MeasuredExtent:
    """The extent of a spall from the knocks of balls that enter and leave it.

    The envelope of the signal is averaged over the ball passes, aligned against slip, in the bands
    that show them best. Two peaks on which bands agree are entry and exit; the exit is the one that
    grows with frequency, else the one that follows sooner. Their separation and the angle over
    which statics say that a ball carries nothing beside the edges are the extent, but for whole
    ball spacings, of which the pass itself says nothing.

    Parameters
    ----------
    recording
        acceleration of the housing.
    bearing
        its geometry and contacts.
    shaft_speed
        [rad/s], a pair (from, to) if it is rough, None if it is unknown: see `diagnose`.
    race
        "outer" or "inner" where it is known to be damaged; None: what `diagnose` names. A rough or
        unknown speed always asks `diagnose`.
    load, clearance
        radial load on the bearing [N] and radial clearance [m] where they are known: they narrow
        the interval.
    diagnosis
        what `diagnose` says, where that is known already.

    Returns
    -------
    A `MeasuredExtent`: with `status` "measured" an extent and its interval, else the reason why
    there is none.

    Raises
    ------
    ValueError
        for a race, load, clearance or speed that cannot be, and for rows that are not alike.
    """
    checks.instance("recording", recording, Recording)
    bearing = bearing_of(bearing)
    if race is not None:
        checks.choice("race", race, RACES)
    if load is not None:
        load = checks.real_number("load", load, above=0.0, unit="N")
    if clearance is not None:
        clearance = checks.real_number("clearance", clearance, at_least=0.0, unit="m")
    if race is None or not isinstance(shaft_speed, int | float):
        found = diagnosis or diagnose(recording, bearing, shaft_speed)
        named = {OUTER: "outer", INNER: "inner"}.get(found.fault)
        race = race or named
        if race is None or not found.evidence:
            return without_extent(race or "", bearing.ball_spacing, ExtentStatus.NO_RACE)
        nominal = found.of(f"{race} race").frequency
        slip = SLIP_OF_LINES
    else:
        speed = checks.real_number("shaft_speed", shaft_speed, above=0.0, unit="rad/s")
        nominal = bearing.bpfo(speed) if race == "outer" else bearing.bpfi(speed)
        slip = SLIP
    # a pass of envelopes is averaged from its own frequency on
    if recording.duration * nominal * (1.0 - slip) < least_passes(nominal, nominal):
        return without_extent(race, bearing.ball_spacing, ExtentStatus.TOO_SHORT)
    if recording.sample_rate < SAMPLES_A_DEGREE * nominal * math.degrees(bearing.ball_spacing):
        return without_extent(race, bearing.ball_spacing, ExtentStatus.TOO_COARSE)
    # the inner race turns with the shaft
    turns = 0.0 if race == "outer" else 1.0 / (2.0 * math.pi * bearing.bpfi(1.0))
    knocks = find_knocks(recording, nominal, slip, turns)
    return _answer(knocks, bearing, race, load, clearance)


_STATUS = {
    Seen.NOTHING: ExtentStatus.NOT_VISIBLE,
    Seen.ONE: ExtentStatus.ONE_KNOCK,
    Seen.UNCLEAR: ExtentStatus.UNCLEAR,
    Seen.ALIKE: ExtentStatus.BOUNCES,
    Seen.EITHER: ExtentStatus.EITHER,
    Seen.TWO: ExtentStatus.MEASURED,
}


def _answer(
    knocks: Knocks, bearing: Bearing, race: str, load: float | None, clearance: float | None
) -> MeasuredExtent:
    status = _STATUS[knocks.seen]
    spacing = bearing.ball_spacing
    separation, deviation = spacing * knocks.separation, spacing * knocks.deviation
    extent = low = high = length = offset = math.nan
    if math.isfinite(knocks.hidden):
        high = spacing * knocks.hidden + plausible_offsets(bearing, race, load, clearance).quantile(
            0.975
        )
        if high < LONGEST_BOUND * spacing:
            status, low = ExtentStatus.SHORTER, 0.0
        else:
            high = math.nan
    if math.isfinite(separation):
        offsets = plausible_offsets(bearing, race, load, clearance)
        least, offset, most = (offsets.quantile(share) for share in (0.025, 0.5, 0.975))
    if status == ExtentStatus.MEASURED:
        extent = separation + offset
        # both sides separately: offsets lean towards long ones
        low = max(extent - math.hypot(offset - least, 1.96 * deviation), 0.0)
        high = extent + math.hypot(most - offset, 1.96 * deviation)
        length = extent * _raceway_radius(bearing, race)
    return MeasuredExtent(
        race, extent, low, high, separation, deviation, offset, spacing, knocks.passes,
        knocks.entry, knocks.exit, knocks.frequency, knocks.n_passes, length, status,
    )  # fmt: skip


def without_extent(
    race: str = "", ball_spacing: float = math.nan, status: ExtentStatus = ExtentStatus.NO_RACE
) -> MeasuredExtent:
    """A measurement that gave no extent; the ball spacing is in [rad]."""
    none = math.nan
    return MeasuredExtent(
        race, none, none, none, none, none, none, ball_spacing, (), none, none, none, 0,
        none, status,
    )  # fmt: skip


def _raceway_radius(bearing: Bearing, race: str) -> float:
    """Radius [m] of the raceway at the bottom of its groove."""
    given: float | None = getattr(bearing, f"{race}_raceway_radius")
    if given is not None:
        return given
    sign: NDArray[np.float64] | float = 1.0 if race == "outer" else -1.0
    return float(0.5 * bearing.pitch_diameter + sign * bearing.ball_radius)
