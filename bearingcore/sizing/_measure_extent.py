"""The extent of a spall from entry to exit, with its interval."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from bearingcore.bearings import Bearing, BearingLike, bearing_of
from bearingcore.common import ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.measured.diagnosis import (
    INNER,
    OUTER,
    SLIP,
    Diagnosis,
    ExtentStatus,
    Knocks,
    MeanPass,
    diagnose,
    find_knocks,
    resample_to_steady_speed,
)
from bearingcore.measured.signals import least_passes
from bearingcore.model.scene import EDGES, RACES
from bearingcore.recordings import Recording
from bearingcore.sizing._release import plausible_offset

SLIP_OF_LINES = 0.004
"""Greatest relative difference between the rate of ball passes and the lines of a diagnosis."""

SAMPLES_A_DEGREE = 1.0
"""Fewest samples for a degree of the race with which knocks can be located."""

NO_ANSWER = "no clear result"

TURN = 2.0 * math.pi

LONGEST_BOUND = 1.0 / 3.0
"""Greatest bound that is worth stating, over a ball spacing."""


@shown_as_table
@dataclass(frozen=True)
class MeasuredExtent:
    """The extent of a spall, measured from entry to exit.

    Attributes
    ----------
    race
        "outer" or "inner"; "" where no race is named.
    extent, low, high
        [rad], with its 95 % interval. NaN if there is none or two are equally likely: see
        `alternatives`. If there is only a bound, `extent` is NaN and `high` is the bound.
    separation, deviation
        [rad] of the race between the peaks of entry and exit, the shorter way round, and its
        standard deviation.
    offset, offset_low, offset_high
        [rad] added to the separation, with its 95 % interval: the angle beside the edges over which
        a ball carries no load.
    ball_spacing
        [rad]. A spall longer by whole ball spacings gives the same passes.
    passes
        mean ball passes of the bands that decided, the best first; may be empty.
    entry, exit
        places of the two peaks in the first of `passes`, as shares of a ball pass, the shorter way
        round; NaN without peaks. If either peak may be the entry, the two may be exchanged.
    frequency
        ball passes a second over the race [Hz], at the mean speed where it changes.
    n_passes
        number of ball passes that were averaged.
    length
        of the extent along the race [m]; NaN if there is none.
    status
        the outcome.
    """

    race: str = ""
    extent: float = math.nan
    low: float = math.nan
    high: float = math.nan
    separation: float = math.nan
    deviation: float = math.nan
    offset: float = math.nan
    offset_low: float = math.nan
    offset_high: float = math.nan
    ball_spacing: float = math.nan
    passes: tuple[MeanPass, ...] = field(default=(), repr=False)
    entry: float = math.nan
    exit: float = math.nan
    frequency: float = math.nan
    n_passes: int = 0
    length: float = math.nan
    status: ExtentStatus = ExtentStatus.NO_RACE

    @property
    def measured(self) -> bool:
        """True if there is an extent."""
        return self.status == ExtentStatus.MEASURED

    @property
    def alternatives(self) -> tuple[tuple[float, float, float], ...]:
        """Possible extents [rad] for the two peaks, each with its interval, the likelier first.

        These are the shorter and the longer way round; the longer one is rare if the shorter one
        was `measured`. Empty without two peaks. Whole ball spacings may be added to both.
        """
        if not math.isfinite(self.separation):
            return ()
        spread = 1.96 * self.deviation
        below = math.hypot(self.offset - self.offset_low, spread)  # offsets are not symmetric
        above = math.hypot(self.offset_high - self.offset, spread)
        return tuple(
            (extent, max(extent - below, 0.0), extent + above)
            for apart in (self.separation, self.ball_spacing - self.separation)
            for extent in [apart + self.offset]
        )

    @property
    def answer(self) -> str:
        """The answer in a few words: "5.0° (4.3-5.9°), 2.0 mm, outer race"."""
        return f"{self.size}, {self.race} race" if self.size else NO_ANSWER

    @property
    def size(self) -> str:
        """The answer without its race: "5.0° (4.3-5.9°), 2.0 mm"; empty if there is none."""
        if self.status == ExtentStatus.MEASURED:
            extent, low, high = np.degrees([self.extent, self.low, self.high])
            long = f", {1e3 * self.length:.1f} mm" if math.isfinite(self.length) else ""
            return f"{extent:.1f}° ({low:.1f}-{high:.1f}°){long}"
        if self.status == ExtentStatus.EITHER:
            first, other = (math.degrees(extent) for extent, _, _ in self.alternatives)
            return f"about {first:.0f}° or {other:.0f}°"
        if self.status == ExtentStatus.SHORTER:
            return f"shorter than about {math.degrees(self.high):.0f}° or near whole ball spacings"
        return ""

    @property
    def sentence(self) -> str:
        """The answer in a sentence, or the reason why there is none."""
        if self.answer == NO_ANSWER:
            return self.status.sentence
        spacing = math.degrees(self.ball_spacing)
        if self.status == ExtentStatus.SHORTER:
            return f"{self.answer} ({spacing:.1f}° each). {self.status.sentence}"
        words = f"{self.answer}; or about that plus whole ball spacings of {spacing:.1f}°."
        if not self.measured:
            return f"{words} {self.status.sentence}"
        other = math.degrees(self.alternatives[1][0])
        return f"{words} {other:.0f}° would look the same, but spalls so long are rare."

    def table(self) -> ResultTable:
        """Return one row with the answer, and the mean ball pass of the best band over angle."""
        rows = table_of(
            ("race", "", [self.race]),
            ("status", "", [str(self.status)]),
            ("extent", "rad", [self.extent]),
            ("low", "rad", [self.low], "of the 95 % interval"),
            ("high", "rad", [self.high], "of the 95 % interval"),
            ("separation", "rad", [self.separation], "from the entry's peak to the exit's"),
            ("separation_deviation", "rad", [self.deviation]),
            ("offset", "rad", [self.offset], "over which a ball is not loaded at the edges"),
            ("offset_low", "rad", [self.offset_low], "of the 95 % interval"),
            ("offset_high", "rad", [self.offset_high], "of the 95 % interval"),
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
            ("envelope", "1", best.envelope, "mean over the ball passes, divided by its mean"),
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
    edge: str | None = None,
    diagnosis: Diagnosis | None = None,
) -> MeasuredExtent:
    """Measure the extent of a spall from the knocks of balls that enter and leave it.

    The envelope of the signal is averaged over the ball passes, aligned against slip, in the bands
    that show them best. Two peaks on which bands agree are entry and exit. The extent is their
    separation plus the angle beside the edges over which, by statics, a ball carries no load. It is
    known up to whole ball spacings, which do not change the mean pass. A changing speed that was
    measured with the signal is followed as in `diagnose`. The pass does not show which peak is the
    entry: if one way round is not much longer than the other, both are returned.

    Parameters
    ----------
    recording
        acceleration of the housing.
    bearing
        its geometry and contacts.
    shaft_speed
        [rad/s], a pair (from, to) if it is rough, None if it is unknown: see `diagnose`.
    race
        "outer" or "inner" if the damaged race is known; None: the race that `diagnose` names. With
        a rough or unknown speed `diagnose` is always called.
    load, clearance
        radial load on the bearing [N] and radial clearance [m], if known; they narrow the interval.
        Without a load, 0.1 to 5 % of the dynamic rating is assumed.
    edge
        model of the edges, see `Defect`, if it is known, as for a simulated signal; None: the
        offsets of measured spalls. The offsets of "published" are larger: with None, extents and
        bounds of a signal simulated with "published" are too small.
    diagnosis
        the result of `diagnose`, if it is known.

    Returns
    -------
    MeasuredExtent
        with `status` "measured" an extent and its interval, else the reason why there is none.

    Raises
    ------
    ValueError
        for an impossible race, load, clearance, edge or speed, and for unlike rows.
    """
    checks.instance("recording", recording, Recording)
    bearing = bearing_of(bearing)
    spacing = bearing.ball_spacing
    if race is not None:
        checks.choice("race", race, RACES)
    if load is not None:
        load = checks.real_number("load", load, above=0.0, unit="N")
    if clearance is not None:
        clearance = checks.real_number("clearance", clearance, at_least=0.0, unit="m")
    if edge is not None:
        checks.choice("edge", edge, EDGES)
    if race is None or not isinstance(shaft_speed, int | float):
        diagnosis = diagnosis or diagnose(recording, bearing, shaft_speed)
        race = race or {OUTER: "outer", INNER: "inner"}.get(diagnosis.fault)
        if race is None or not diagnosis.evidence:
            return MeasuredExtent(race or "", ball_spacing=spacing)
        nominal, slip = diagnosis.of(f"{race} race").frequency, SLIP_OF_LINES
        recording = diagnosis.steady_recording or recording
    else:
        turns = checks.real_number("shaft_speed", shaft_speed, above=0.0, unit="rad/s") / TURN
        recording, turns, _, _ = resample_to_steady_speed(recording, turns, turns, "")
        passing = bearing.bpfo if race == "outer" else bearing.bpfi
        nominal, slip = passing(TURN * turns), SLIP
    # the lowest line of an averaged envelope is the ball-pass frequency itself
    if recording.duration * nominal * (1.0 - slip) < least_passes(nominal, nominal):
        return MeasuredExtent(race, ball_spacing=spacing, status=ExtentStatus.TOO_SHORT)
    if recording.sample_rate < SAMPLES_A_DEGREE * nominal * math.degrees(spacing):
        return MeasuredExtent(race, ball_spacing=spacing, status=ExtentStatus.TOO_COARSE)
    # the inner race turns with the shaft
    turning = 0.0 if race == "outer" else 1.0 / (TURN * bearing.bpfi(1.0))
    knocks = find_knocks(recording, nominal, slip, turning)
    offset = (math.nan,) * 3
    if math.isfinite(knocks.separation) or math.isfinite(knocks.hidden):
        offset = plausible_offset(bearing, race, load, clearance, edge)
        if math.isnan(offset[1]):
            raise checks.refuse("load", load, "one that balls lose in a spall", "N")
    return _answer(knocks, bearing, race, offset)


def _answer(
    knocks: Knocks, bearing: Bearing, race: str, offsets: tuple[float, float, float]
) -> MeasuredExtent:
    """Return the extent by the knocks and the offsets (low, middle, high) [rad]."""
    spacing, (least, offset, most) = bearing.ball_spacing, offsets
    answer = MeasuredExtent(
        race,
        separation=spacing * knocks.separation,
        deviation=spacing * knocks.deviation,
        offset=offset,
        offset_low=least,
        offset_high=most,
        ball_spacing=spacing,
        passes=knocks.passes,
        entry=knocks.entry,
        exit=knocks.exit,
        frequency=knocks.frequency,
        n_passes=knocks.n_passes,
        status=knocks.status,
    )
    bound = spacing * knocks.hidden + most
    if bound < LONGEST_BOUND * spacing:
        return replace(answer, low=0.0, high=bound, status=ExtentStatus.SHORTER)
    if not answer.measured:
        return answer
    extent, low, high = answer.alternatives[0]
    radius = bearing.outer_raceway_radius if race == "outer" else bearing.inner_raceway_radius
    length = extent * radius
    return replace(answer, extent=extent, low=low, high=high, length=length)
