"""Which part of a bearing is damaged, from a signal, its geometry and its speed.

Knocks of a damaged part repeat at a frequency that the geometry gives. The signal is whitened, so
that tones of shaft, mesh and mains lose their weight (Sawalhi & Randall's pre-whitening, smoothed);
squared envelopes are taken in the bands of the fast kurtogram; in their spectra combs of six
harmonics are looked for, with one common slip (see `combs`). A part is named if its comb

- stands well above what noise reaches anywhere it was looked for (NOISE_MARGIN),
- swings the envelope by more than healthy bearings do (LEAST_DEPTH),
- stands well above the combs of the other parts (PART_MARGIN) and above every other comb there is
  (OTHER_MARGIN), of this bearing or not, but those that follow from it: multiples and sidebands,
- has the sidebands that its own turning makes: an inner race those of the shaft, a ball the cage's.

The margins are few, and the same for every machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bearingcore.common import checks
from bearingcore.diagnosis import say
from bearingcore.diagnosis.combs import HARMONICS, harmonics
from bearingcore.diagnosis.evidence import (
    CANNOT_TELL,
    NONE_SEEN,
    Diagnosis,
    EnvelopeLines,
    OtherLines,
    PartEvidence,
)
from bearingcore.diagnosis.parts import BALL, INNER, OUTER, PartLines, part_lines
from bearingcore.diagnosis.search import (
    TURNS,
    Combs,
    Found,
    beside,
    excess,
    listen,
    multiples,
    near,
    sideband_combs,
    within,
)
from bearingcore.diagnosis.shaft import ShaftLines, shaft_lines
from bearingcore.model.bearing import Bearing
from bearingcore.signals.dropouts import SignalFaults, signal_faults
from bearingcore.signals.filter_bank import Envelope, split, squared_envelopes
from bearingcore.signals.recording import Recording

NOISE_MARGIN = 2.0
"""[dB] above the level that noise reaches in one of a thousand signals."""

PART_MARGIN = 2.5
"""[dB] above the combs of the other parts."""

OTHER_MARGIN = 2.5
"""[dB] above combs of any other frequency."""

SIDEBAND_MARGIN = 2.0
"""[dB] above their surroundings that the sidebands of a turning part have on average."""

SIDEBAND_LEAD = 6.0
"""[dB] by which sidebands that the part does not make may be stronger than those it does."""

SIDEBAND_REACH = 25.0
"""[dB] below the lines themselves down to which sidebands are expected."""

STRONG_SIDEBANDS, WEAK_SIDEBANDS = 9.0, 14.0
"""[dB] below the lines: those of a part that turns through the load are not fainter than the one,
those of a part that stands still not louder than the other. They decide where lines do not."""

LEAST_DEPTH = 0.03
"""Share of its mean by which the envelope swings at each line of a damaged part. Healthy bearings
show their lines too, by 1 or 2 %."""

ENOUGH_POWER = 0.06
"""The swing that must be visible before the absence of lines means anything."""

SMOOTH = 3.3
"""Kurtosis of a band's envelope (2 for noise) above which something knocks, whatever it is: no
bearing is called healthy then."""

FEWEST_PASSES = 12
"""Knocks in a recording below which nothing is said."""

MOST_DROPPED = 0.5
"""Share of a recording without signal from which nothing is said."""

MUCH_DROPPED, MUCH_CLIPPED = 0.1, 0.02
"""Shares from which the absence of lines means nothing."""

NARROWEST = 16.0
"""Turns of the shaft a second that a band is wide at least."""

WHITENING = 3.0
"""Turns of the shaft a second over which a signal is whitened."""

FAINT = 1.0
"""[dB] above the level of noise from which lines, too faint to name a part, forbid to call it
healthy."""

NARROW = 1.3
"""A range of speeds whose ends differ by this factor at most is believed without shaft lines."""

SHAFT_MARGIN = 6.0
"""[dB] by which the shaft's lines at one speed must stand above those at another."""

SPEEDS = (2.0 * math.pi * 5.0, 2.0 * math.pi * 100.0)
"""[rad/s] between which an unknown shaft is looked for."""

SURE = 0.99
"""The greatest probability: there is always what nobody thought of."""


def diagnose(
    recording: Recording,
    bearing: Bearing,
    shaft_speed: float | tuple[float, float] | None,
    *,
    slip: float = 0.02,
) -> Diagnosis:
    """Which part of a bearing is damaged, if that can be told from a signal.

    Parameters
    ----------
    recording
        acceleration of the housing, one direction or two.
    bearing
        its geometry; only balls, diameters and contact angle count.
    shaft_speed
        [rad/s], good to `slip`; a pair (from, to) if it is rough; None if it is unknown: then that
        of the recording is taken if it carries one, else it is looked for between 300 and 6000
        turns a minute.
    slip
        by how much balls may pass faster or slower than the shaft speed says, as a fraction.

    Raises
    ------
    ValueError
        for a speed or slip that cannot be.
    """
    slip = checks.number("slip", slip, at_least=0.0, at_most=0.1)
    low, high, source = _speeds(recording, shaft_speed)
    signal = _Signal(recording)
    if signal.nothing_to_hear is not None:
        return _silent(signal.nothing_to_hear, source)
    if high <= low * (1.0 + 1e-9):
        return _at_speed(signal, bearing, low, slip, source)
    return _in_range(signal, bearing, low, high, slip, source)


def _speeds(
    recording: Recording, shaft_speed: float | tuple[float, float] | None
) -> tuple[float, float, str]:
    """The speed from, to [Hz], and where it is from."""
    turn = 2.0 * math.pi
    if shaft_speed is None:
        told = getattr(recording, "shaft_speed", None)
        if told is not None:
            speed = checks.number("shaft_speed", told, above=0.0, unit="rad/s") / turn
            return speed, speed, "told by the recording"
        return SPEEDS[0] / turn, SPEEDS[1] / turn, "looked for"
    if np.ndim(shaft_speed) == 0:
        speed = checks.number("shaft_speed", shaft_speed, above=0.0, unit="rad/s") / turn  # type: ignore[arg-type]
        return speed, speed, "given"
    try:
        first, last = shaft_speed  # type: ignore[misc]
    except (TypeError, ValueError):
        raise checks.refuse(
            "shaft_speed", shaft_speed, "a number [rad/s], a pair of them, or None"
        ) from None
    first = checks.number("lower shaft_speed", first, above=0.0, unit="rad/s")
    last = checks.number("upper shaft_speed", last, at_least=first, unit="rad/s")
    return first / turn, last / turn, "looked for"


class _Signal:
    """The directions of a recording, and what is wrong with each."""

    def __init__(self, recording: Recording) -> None:
        self.rate = recording.sample_rate
        self.duration = recording.duration
        columns = recording.acceleration.T
        faults = [signal_faults(column) for column in columns]
        usable = [index for index, one in enumerate(faults) if one.dropped_share <= MOST_DROPPED]
        self.names = [recording.directions[index] for index in usable]
        self.columns = [np.asarray(columns[index]) for index in usable]
        self.faults: list[SignalFaults] = [faults[index] for index in usable]
        self.nothing_to_hear: str | None = None
        if not usable:
            share = min(one.dropped_share for one in faults)
            self.nothing_to_hear = say.dropped(share)

    @property
    def dropped(self) -> float:
        """Share of the samples that dropped out."""
        return max(one.dropped_share for one in self.faults)

    @property
    def clipped(self) -> float:
        """Share of the samples that are clipped."""
        return max(one.clipped_share for one in self.faults)

    def heard(self, shaft: float, highest: float) -> list[tuple[str, Envelope]]:
        """Envelopes in all bands, with their directions."""
        bands = split(self.rate, NARROWEST * shaft)
        return [
            (name, envelope)
            for name, column, faults in zip(self.names, self.columns, self.faults, strict=True)
            for envelope in squared_envelopes(
                column, self.rate, bands, highest, faults.dropped, WHITENING * shaft
            )
        ]

    def shaft(self, low: float, high: float) -> ShaftLines:
        """The shaft's own lines between two frequencies [Hz]."""
        return shaft_lines(self.columns, self.rate, low, high)


@dataclass(frozen=True)
class _Judged:
    """The combs at the resolution that shows most, and how they compare."""

    combs: Combs
    best: Found
    second: Found
    other: OtherLines
    above_noise: float
    above_second: float
    above_other: float
    above_sidebands: float
    evidence: tuple[PartEvidence, ...]
    detectable: float

    @property
    def own(self) -> PartEvidence:
        """Evidence of the best part."""
        return next(one for one in self.evidence if one.part == self.best.lines.part)

    @property
    def margin(self) -> float:
        """[dB] by which the tightest of the conditions is met; below 0 if one is not."""
        return min(
            self.above_noise - NOISE_MARGIN,
            self.above_second - PART_MARGIN,
            self.above_other - OTHER_MARGIN,
            self.above_sidebands,
        )

    @property
    def seen(self) -> bool:
        """Whether any part's lines stand out at all."""
        return self.above_noise >= NOISE_MARGIN and self.own.depth >= LEAST_DEPTH


def _at_speed(
    signal: _Signal, bearing: Bearing, shaft: float, slip: float, source: str
) -> Diagnosis:
    """The diagnosis at a known speed [Hz]."""
    parts = part_lines(bearing)
    refused = _unfit(signal, parts, shaft)
    if refused is not None:
        return _silent(refused, source, shaft)
    given, own = shaft, signal.shaft(shaft * (1.0 - slip), shaft * (1.0 + slip))
    if own.clear:
        shaft = own.frequency
        source += ", made finer by the shaft's own lines"
    judged = _judge(signal, parts, shaft, slip, given)
    return _decide(signal, judged, shaft, source)


def _unfit(signal: _Signal, parts: Sequence[PartLines], shaft: float) -> str | None:
    """Why nothing can be said, or None."""
    slowest = min(lines.order for lines in parts) * shaft
    top = max(lines.order for lines in parts) * shaft
    if signal.duration * slowest < FEWEST_PASSES:
        return say.too_short(signal.duration, signal.duration * slowest, FEWEST_PASSES)
    if 0.5 * signal.rate < (HARMONICS + 2.0) * top:
        return say.too_slow(signal.rate, 2.0 * (HARMONICS + 2.0) * top)
    return None


def _judge(
    signal: _Signal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    given: float | None = None,
) -> _Judged:
    """The best combs of the parts at a speed [Hz], compared."""
    combs, resolutions = _most_telling(signal, parts, shaft, slip, True, given)
    return _compare(signal, combs, resolutions, parts, slip, given)


def _most_telling(
    signal: _Signal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    known_speed: bool,
    given: float | None = None,
) -> tuple[Combs, list[Combs]]:
    """The combs at the resolution where one stands highest above noise, and at all of them."""
    top = max(lines.order for lines in parts) * (1.0 + slip)
    envelopes = signal.heard(shaft, (HARMONICS * top + 2.0) * shaft)
    resolutions: list[Combs] = []
    for turns in TURNS:
        resolutions.append(listen(envelopes, parts, shaft, known_speed, slip, turns, given))
        if turns / shaft >= signal.duration:
            break  # longer segments than the signal are the same again
    return max(resolutions, key=excess), resolutions


def _compare(
    signal: _Signal,
    combs: Combs,
    resolutions: Sequence[Combs],
    parts: Sequence[PartLines],
    slip: float,
    given: float | None = None,
) -> _Judged:
    """How the combs of the parts stand against noise, each other and everything else."""
    shaft = combs.shaft
    cage = next(lines.sidebands for lines in parts if lines.part == BALL) * shaft
    best, rivals = _ranked(combs, cage, slip, given or shaft)
    second = rivals[0]
    free = multiples(combs, best.frequency, (1, 2, 3))
    follows = sideband_combs(combs, best.frequency, (shaft, cage))
    if best.lines.part == BALL:  # its spin itself is half its line
        free |= multiples(combs, best.frequency, (0.5, 1.5))
        follows |= sideband_combs(combs, 0.5 * best.frequency, (shaft, cage))
    own = np.zeros(len(combs.frequency), dtype=bool)
    for lines in parts:
        own |= within(combs, lines, slip + 0.005, given or shaft, combs.frequency)
    loudest = combs.level.max(axis=0)
    others = np.where(free | follows | own, -np.inf, loudest)
    followers = np.where(follows & ~free & ~own, loudest, -np.inf)
    index = int(others.argmax())
    other = OtherLines(
        float(combs.frequency[index]), float(combs.frequency[index]) / shaft, float(others[index])
    )
    above_other = min(
        best.level - other.level, best.level - float(followers.max(initial=-np.inf)) + OTHER_MARGIN
    )
    evidence = tuple(
        _evidence(combs, best if found.lines == best.lines else found, cage)
        for found in combs.found
    )
    return _Judged(
        combs=combs,
        best=best,
        second=second,
        other=other,
        above_noise=best.level - combs.noise,
        above_second=best.level - second.level,
        above_other=above_other,
        above_sidebands=_above_sidebands(combs, best, cage),
        evidence=evidence,
        detectable=min(_detectable(one, signal) for one in resolutions),
    )


def _ranked(combs: Combs, cage: float, slip: float, given: float) -> tuple[Found, list[Found]]:
    """The part whose comb stands highest, and its rivals.

    No rival is a part whose comb is a multiple of the best one's, or its skirt: it has those lines
    for free. Where one comb lies in the windows of two parts, as a ball's and an outer race's may,
    the sidebands decide.
    """
    ranked = sorted(combs.found, key=lambda found: -found.level)
    top = ranked[0]
    at = np.array([top.frequency])
    same = [found for found in ranked if within(combs, found.lines, slip, given, at)[0]]
    best = _by_sidebands(combs, top, same, cage) if len(same) > 1 else top
    if best is None:
        return top, [found for found in same if found is not top]
    for_free = [
        found
        for found in ranked
        if found is not best
        and any(
            near(combs, factor * top.frequency, np.array([found.frequency]))[0]
            for factor in (1, 2, 3)
        )
    ]
    rivals = [found for found in ranked if found is not best and found not in for_free]
    if not rivals:  # all that is left shares its lines: nothing else is there to be told from
        rivals = [replace(for_free[-1], level=combs.noise)]
    return best, rivals


def _by_sidebands(combs: Combs, top: Found, same: Sequence[Found], cage: float) -> Found | None:
    """Which of the parts that share a comb its sidebands speak for, or None."""
    shaft_level, cage_level = _sidebands(combs, top, cage)
    strong, weak = top.level - STRONG_SIDEBANDS, top.level - WEAK_SIDEBANDS
    with_inner = any(found.lines.part == INNER for found in same)
    fits = {
        OUTER: cage_level <= weak and (shaft_level <= weak or not with_inner),
        INNER: shaft_level >= strong and cage_level <= shaft_level - SIDEBAND_LEAD,
        BALL: cage_level >= strong and shaft_level <= cage_level - SIDEBAND_LEAD,
    }
    fitting = [found for found in same if fits[found.lines.part]]
    if len(fitting) != 1:
        return None
    # the comb is the same: so are its place and its level
    return replace(fitting[0], frequency=top.frequency, level=top.level, place=top.place)


def _sidebands(combs: Combs, found: Found, cage: float) -> tuple[float, float]:
    """Mean level [dB] of the first sidebands of shaft and of cage, about the first harmonics."""
    one, at = combs.heard[found.place], np.array([found.frequency])

    def mean(spacing: float) -> float:
        sides = beside(one, at, spacing)
        return float(np.mean([side[: HARMONICS // 2].mean() for side in sides]))

    return mean(combs.shaft), mean(cage)


def _above_sidebands(combs: Combs, best: Found, cage: float) -> float:
    """By how much [dB] the sidebands of a turning part are there, and more than those of another.

    An outer race stands still and needs none: infinity.
    """
    if best.lines.sidebands == 0.0:
        return math.inf
    shaft_level, cage_level = _sidebands(combs, best, cage)
    own, other = (
        (shaft_level, cage_level) if best.lines.part == INNER else (cage_level, shaft_level)
    )
    return min(
        own - SIDEBAND_MARGIN, own - other + SIDEBAND_LEAD, own - best.level + SIDEBAND_REACH
    )


def _evidence(combs: Combs, found: Found, cage: float) -> PartEvidence:
    one = combs.heard[found.place]
    lines, at = found.lines, np.array([found.frequency])
    spacing = cage if lines.part == BALL else combs.shaft
    levels = harmonics(one.cleared, one.levels.step, at)[:, 0]
    depths = np.sort(harmonics(one.levels.depth, one.levels.step, at)[:, 0])
    nominal = lines.order * combs.shaft
    return PartEvidence(
        part=lines.part,
        nominal_frequency=nominal,
        nominal_order=lines.order,
        frequency=found.frequency,
        order=found.frequency / combs.shaft,
        slip=found.frequency / nominal - 1.0,
        harmonics=levels,
        level=found.level,
        noise=combs.noise,
        depth=float(depths[:-1].mean()),
        sidebands=np.hstack(beside(one, at, spacing)),
        sideband_spacing=spacing,
        sideband_source="cage" if lines.part == BALL else "shaft",
        band=one.band,
        direction=one.direction,
        kurtosis=one.kurtosis,
        false_alarm=found.chance,
    )


def _detectable(combs: Combs, signal: _Signal) -> float:
    """The least swing of the envelope in the widest band that would have been seen."""
    widest = max(combs.heard, key=lambda one: one.band.high - one.band.low)
    needed = 10.0 ** (0.1 * (combs.noise + NOISE_MARGIN)) - 1.0
    return float(np.median(widest.levels.floor)) * math.sqrt(max(needed, 0.0))


def _decide(signal: _Signal, judged: _Judged, shaft: float | None, source: str) -> Diagnosis:
    """The answer, and its sentence; `shaft` [Hz] is None where no speed was found."""
    own, other = judged.own, judged.other
    others_stand_out = other.level - judged.combs.noise >= NOISE_MARGIN
    blows = _impulsiveness(judged.combs, signal)
    fault, chance = CANNOT_TELL, _likely(judged)
    if judged.seen and judged.margin >= 0.0:
        fault = own.part
        status = say.damaged(own, judged.combs)
    elif judged.seen:
        status = say.undecided(judged, PART_MARGIN, OTHER_MARGIN)
    elif judged.above_noise >= FAINT and own.depth >= LEAST_DEPTH:
        status = say.faint(own)
    elif others_stand_out and _deep(judged):
        status = say.unexplained(other)
    elif signal.dropped > MUCH_DROPPED:
        status = say.nothing_but("parts of the signal dropped out", signal.dropped)
    elif signal.clipped > MUCH_CLIPPED:
        status = say.nothing_but("the signal is clipped", signal.clipped)
    elif blows > SMOOTH:
        status = say.blows(blows, signal.duration)
    elif judged.detectable > ENOUGH_POWER:
        status = say.weak(judged.detectable, signal.duration)
    else:
        fault, chance = NONE_SEEN, _unharmed(judged)
        status = say.healthy(judged.detectable)
    one = judged.combs.heard[judged.best.place]
    frequency = one.levels.step * np.arange(len(one.levels.level), dtype=float)
    return Diagnosis(
        fault=fault,
        probability=chance,
        status=status + say.speed(shaft, source),
        evidence=judged.evidence,
        shaft_speed=None if shaft is None else 2.0 * math.pi * shaft,
        speed_source=source,
        other=other if others_stand_out else None,
        detectable_depth=judged.detectable,
        spectrum=EnvelopeLines(frequency, one.levels.level, one.band, one.direction),
    )


def _impulsiveness(combs: Combs, signal: _Signal) -> float:
    """The greatest kurtosis of broad bands below the recorder's own filter.

    Above five sixths of the range there is often nothing but that filter's rest. What chance adds
    in a short signal is taken off: five deviations of the kurtosis of noise, sqrt(20/N).
    """
    sixth = signal.rate / 12.0
    broad = [
        one.kurtosis - 5.0 * math.sqrt(20.0 / (signal.duration * (one.band.high - one.band.low)))
        for one in combs.heard
        if one.band.high <= 5.05 * sixth and one.band.high - one.band.low >= 0.95 * sixth
    ]
    return max(broad or [one.kurtosis for one in combs.heard])


def _deep(judged: _Judged) -> bool:
    """Whether the lines of something else swing the envelope as damage does."""
    combs, frequency = judged.combs, judged.other.frequency
    index = int(np.abs(combs.frequency - frequency).argmin())
    one = combs.heard[int(combs.level[:, index].argmax())]
    depths = np.sort(harmonics(one.levels.depth, one.levels.step, np.array([frequency]))[:, 0])
    return bool(depths[:-1].mean() >= LEAST_DEPTH)


def _likely(judged: _Judged) -> float:
    """Probability that the leading part is the damaged one."""
    return SURE / (1.0 + math.exp(-(judged.margin + 1.0) / 1.0))


def _unharmed(judged: _Judged) -> float:
    """Probability that nothing is damaged where nothing is seen."""
    return min(SURE, 1.0 - judged.detectable)


def _silent(status: str, source: str, shaft: float | None = None) -> Diagnosis:
    """The diagnosis where nothing can be looked at."""
    return Diagnosis(
        fault=CANNOT_TELL,
        probability=0.0,
        status=status,
        evidence=(),
        shaft_speed=None if shaft is None else 2.0 * math.pi * shaft,
        speed_source=source,
        other=None,
        detectable_depth=math.inf,
        spectrum=None,
    )


# -- speed unknown ---------------------------------------------------------------------------------


def _in_range(
    signal: _Signal, bearing: Bearing, low: float, high: float, slip: float, source: str
) -> Diagnosis:
    """The diagnosis at a speed that lies between two [Hz]: it is looked for.

    The strongest comb in the signal may be of each part that has its line there at some speed of
    the range. Which it is, the shaft's own lines at that speed decide.
    """
    parts = part_lines(bearing)
    refused = _unfit(signal, parts, low) or _unfit(signal, parts, high)
    if refused is not None:
        return _silent(refused, source)
    own = signal.shaft(low, high)
    hypotheses = []
    if own.clear:
        hypotheses.append(_Hypothesis(own, _judge(signal, parts, own.frequency, slip)))
    middle, reach = 0.5 * (low + high), (high - low) / (high + low) + slip
    combs = _most_telling(signal, parts, middle, reach, known_speed=False)[0]
    strongest = max(combs.found, key=lambda found: found.level)
    stands_out = strongest.level - combs.noise >= NOISE_MARGIN
    if stands_out:
        for lines in parts:
            speed = strongest.frequency / lines.order
            if low * (1.0 - slip) <= speed <= high * (1.0 + slip):
                hypotheses.append(_Hypothesis.at(signal, parts, speed, slip))
    holding = sorted((one for one in hypotheses if one.holds), key=lambda one: -one.shaft.excess)
    if not holding:
        if own.clear:
            return _decide(signal, hypotheses[0].judged, own.frequency, _FOUND)
        if not stands_out:
            judged = _compare(signal, combs, [combs], parts, reach)
            return _decide(signal, judged, None, f"{source}, not found")
        return _undecided_speed(signal, hypotheses, strongest.frequency, source)
    first = holding[0]
    rival = next((one for one in holding[1:] if not one.agrees(first, slip)), None)
    alone = high <= NARROW * low and rival is None
    if not (first.shaft.clear or alone):
        return _undecided_speed(signal, holding, first.judged.best.frequency, source)
    if rival is not None and first.shaft.excess < rival.shaft.excess + SHAFT_MARGIN:
        return _undecided_speed(signal, [first, rival], first.judged.best.frequency, source)
    part = first.judged.best.lines.part
    found = _FOUND if first.shaft.clear else f"taken from the lines of the {part}"
    return _decide(signal, first.judged, first.judged.combs.shaft, found)


_FOUND = "found by the shaft's own lines"


def _undecided_speed(
    signal: _Signal, hypotheses: Sequence[_Hypothesis], frequency: float, source: str
) -> Diagnosis:
    """Knocks that may be of one part or another, as the speed may be."""
    readings: dict[str, float] = {}
    for one in hypotheses:
        readings.setdefault(one.judged.best.lines.part, one.judged.combs.shaft)
    decided = _decide(signal, hypotheses[0].judged, None, source)
    return replace(
        decided,
        fault=CANNOT_TELL,
        status=say.which_speed(frequency, list(readings.items())),
        probability=SURE / max(2, len(readings)),
    )


@dataclass(frozen=True)
class _Hypothesis:
    """That the shaft turns at a speed, and what the signal says then."""

    shaft: ShaftLines
    judged: _Judged

    @classmethod
    def at(
        cls, signal: _Signal, parts: Sequence[PartLines], speed: float, slip: float
    ) -> _Hypothesis:
        """What follows if the shaft turns about `speed` times a second [Hz]."""
        shaft = signal.shaft(speed * (1.0 - slip), speed * (1.0 + slip))
        return cls(shaft, _judge(signal, parts, shaft.frequency if shaft.clear else speed, slip))

    @property
    def holds(self) -> bool:
        """Whether a part would be named at that speed."""
        return self.judged.seen and self.judged.margin >= 0.0

    def agrees(self, other: _Hypothesis, slip: float) -> bool:
        """Whether another speed is the same, and the part."""
        ratio = self.judged.combs.shaft / other.judged.combs.shaft
        same = self.judged.best.lines.part == other.judged.best.lines.part
        return same and abs(ratio - 1.0) <= 2.0 * slip
