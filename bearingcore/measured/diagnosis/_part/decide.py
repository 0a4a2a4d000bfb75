"""The answer that the evidence allows, its status and its sentence."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.measured.diagnosis._part import say
from bearingcore.measured.diagnosis._part.evidence import (
    BESIDE,
    CANNOT_TELL,
    LIKELY,
    NONE_SEEN,
    Diagnosis,
    EnvelopeLines,
    PartEvidence,
)
from bearingcore.measured.diagnosis._part.judged import NOISE_MARGIN, Judged
from bearingcore.measured.diagnosis._part.listened_signal import ListenedSignal
from bearingcore.measured.diagnosis._part.parts import BALL
from bearingcore.measured.diagnosis._part.probability import LEAD
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus, Reason

NAMED = 0.5
"""Probability from which a part is named."""

LEAST_SWING = 0.03
"""Share of its mean by which lines that count swing the envelope. Healthy bearings show their lines
too, by 1 or 2 %."""

ENOUGH_SWING = 0.06
"""The swing that must be visible before the absence of lines means anything."""

SURELY = 2.0
"""Times the swing whose lines reach the level that counts, from which on nine of ten signals show
it: lines of noise scatter, and the loudest of a comb does not count. Measured with noise whose
power swings at six harmonics, of 2 to 20 s."""

SILENT = 0.25
"""Share of bearings without any sign that are damaged all the same: of 55 damaged bearings of a
motor 5 showed nothing at a sensor away from them, and of bearings measured most are suspected."""

SMOOTH = 2.4
"""Kurtosis of a band (2 for noise) above which something knocks, of any kind: no bearing is
called healthy then. Noise whose power swings by more than six tenths of its mean has as much."""

MUCH_DROPPED, MUCH_CLIPPED = 0.1, 0.02
"""Shares from which the absence of lines means nothing."""

SOME_DROPPED = 1e-3
"""Share from which it is said that samples do not count."""

FAINT, FAINT_RACE = 2.5, 4.0
"""Deviations from which lines of a ball or a race, too faint to name it, forbid to call the bearing
healthy."""


def decide(signal: ListenedSignal, judged: Judged, shaft: float | None, source: str) -> Diagnosis:
    """The answer, and its sentence; `shaft` [Hz] is None where no speed is known."""
    part = judged.leading
    fault, probability = CANNOT_TELL, part.probability
    others_stand_out = judged.other_above_noise >= NOISE_MARGIN
    if part.probability >= NAMED:
        fault = part.part
        status, detail = DiagnosisStatus.PART_NAMED, say.damaged(part)
        if part.part != BALL and part.probability < LIKELY:
            detail += say.perhaps_a_ball()
        if part.magnetic > 0.0:
            detail += say.magnetic_alike(part)
        for other in judged.evidence:
            races = other is not part and BALL not in (part.part, other.part)
            if races and other.probability >= BESIDE:
                detail += say.beside(other)
    # a cause from outside the bearing explains all lines of a part, so it goes first
    elif reason := _cause_outside(judged) or _parts_in_doubt(judged) or _hidden(signal):
        status, detail = reason
    elif others_stand_out and judged.other_swing >= LEAST_SWING:
        status, detail = DiagnosisStatus.OTHER_SOURCE, say.unexplained(judged.other)
    elif (reason := _nothing_and_why(signal, judged)) is not None:
        status, detail = reason
    else:
        fault, probability = NONE_SEEN, (1.0 - SILENT) * (1.0 - judged.detectable)
        status, detail = DiagnosisStatus.NONE_SEEN, say.healthy(SURELY * judged.detectable)
    if signal.dropped > SOME_DROPPED and status is not DiagnosisStatus.DROPPED_OUT:
        detail += say.left_out(signal.dropped)
    return Diagnosis(
        fault=fault,
        probability=probability,
        status=status,
        detail=detail,
        evidence=judged.evidence,
        shaft_speed=None if shaft is None else 2.0 * math.pi * shaft,
        speed_source=source,
        other=judged.other if others_stand_out else None,
        detectable_depth=SURELY * judged.detectable,
        spectrum=_spectrum(judged),
    )


def _spectrum(judged: Judged) -> EnvelopeLines:
    """The envelope's spectrum in the band of the best evidence, at the finest resolution."""
    envelope = judged.resolutions[-1].envelope_of(judged.leading)
    frequency = envelope.levels.step * np.arange(len(envelope.levels.level), dtype=float)
    return EnvelopeLines(frequency, envelope.levels.level, envelope.band, envelope.direction)


def _cause_outside(judged: Judged) -> Reason | None:
    """Mains, another shaft or another bearing, to which lines of a part belong."""
    doubtful = max(judged.evidence, key=lambda part: part.without_magnetic)
    if doubtful.magnetic > 0.0 and doubtful.without_magnetic >= NAMED:
        return DiagnosisStatus.MAGNETIC, say.magnetic(doubtful)
    leading = [part for part in judged.evidence if part.line_lead >= LEAD]
    for part in leading:
        if not math.isnan(part.foreign_spacing):
            return DiagnosisStatus.OTHER_SHAFT, say.other_shaft(part, judged.shaft)
    # damage under a load that stands still is modulated once a turn of its part: blows of one size
    # may come from elsewhere
    even = [
        part
        for part in leading
        if _is_seen(part) and part.modulation < 0.0 and part.level > judged.other.level
    ]
    if not even:
        return None
    loudest = max(even, key=lambda part: part.line_lead)
    if loudest.magnetic > 0.0:
        return DiagnosisStatus.MAGNETIC, say.magnetic(loudest)
    return DiagnosisStatus.UNMODULATED, say.unmodulated(loudest)


def _parts_in_doubt(judged: Judged) -> Reason | None:
    """Lines of the bearing's own that fit several parts, or none well enough."""
    clear = [part for part in judged.evidence if part.part != BALL and _is_seen(part)]
    leading = max(judged.evidence, key=lambda part: (part in clear, part.lead))
    needed = LEAST_SWING if leading.lead >= LEAD else ENOUGH_SWING
    if leading.part != BALL and leading.lead >= 0.0 and leading.swing >= needed:
        return DiagnosisStatus.PERHAPS_A_BALL, say.marked(leading)
    ball = next(part for part in judged.evidence if part.part == BALL)
    if ball.deviations >= FAINT:
        return DiagnosisStatus.FAINT, say.faint(ball)
    if _is_seen(ball) and (leading is ball or ball.level > leading.level):
        return DiagnosisStatus.NOT_ALONE, say.not_carried(ball)
    if len(clear) > 1:
        return DiagnosisStatus.ALIKE, say.alike(*clear)
    if clear:
        return DiagnosisStatus.NOT_ALONE, say.not_alone(leading, judged.other)
    return None


def _is_seen(part: PartEvidence) -> bool:
    """True where the lines of a part stand out of noise and move the envelope enough."""
    return part.level - part.noise >= NOISE_MARGIN and part.swing >= LEAST_SWING


def _hidden(signal: ListenedSignal) -> Reason | None:
    """The fault of the signal that may hide damage, if it has one."""
    if signal.dropped > MUCH_DROPPED:
        words = say.nothing_but("parts of the signal dropped out", signal.dropped)
        return DiagnosisStatus.DROPPED_OUT, words
    if signal.clipped > MUCH_CLIPPED:
        return DiagnosisStatus.CLIPPED, say.nothing_but("the signal is clipped", signal.clipped)
    return None


def _nothing_and_why(signal: ListenedSignal, judged: Judged) -> Reason | None:
    """The reason why the absence of lines means nothing, if there is one."""
    blows = _impulsiveness(judged, signal)
    if blows > SMOOTH:
        return DiagnosisStatus.IRREGULAR, say.blows(blows, signal.duration)
    if signal.only_rounding:
        return DiagnosisStatus.ROUNDED, say.ROUNDED
    if judged.detectable > ENOUGH_SWING:
        return DiagnosisStatus.INSENSITIVE, say.weak(SURELY * judged.detectable, signal.duration)
    broadest = max(judged.evidence, key=lambda part: part.deviations)
    if broadest.deviations >= FAINT_RACE:
        return DiagnosisStatus.FAINT, say.faint(broadest)
    return None


def _impulsiveness(judged: Judged, signal: ListenedSignal) -> float:
    """The greatest kurtosis of broad bands below the recorder's own filter.

    Above five sixths of the range there is often nothing but that filter's rest. What chance adds
    in a short signal is taken off: five deviations of the kurtosis of noise, sqrt(20/N).
    """
    sixth, envelopes = signal.rate / 12.0, judged.resolutions[0].envelopes
    broad = [
        envelope.kurtosis
        - 5.0 * math.sqrt(20.0 / (signal.duration * (envelope.band.high - envelope.band.low)))
        for envelope in envelopes
        if envelope.band.high <= 5.05 * sixth
        and envelope.band.high - envelope.band.low >= 0.95 * sixth
    ]
    return max(broad or [envelope.kurtosis for envelope in envelopes])


def silent(
    status: DiagnosisStatus, detail: str, source: str, shaft: float | None = None
) -> Diagnosis:
    """The diagnosis where nothing can be looked at."""
    return Diagnosis(
        fault=CANNOT_TELL,
        probability=0.0,
        status=status,
        detail=detail,
        evidence=(),
        shaft_speed=None if shaft is None else 2.0 * math.pi * shaft,
        speed_source=source,
        other=None,
        detectable_depth=math.inf,
        spectrum=None,
    )
