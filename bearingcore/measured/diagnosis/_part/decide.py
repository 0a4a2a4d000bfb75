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
"""Least probability of a part that is named."""

LEAST_SWING = 0.03
"""Least swing of the envelope at lines that count, relative to its mean. Lines of healthy bearings
swing it by 1 or 2 %."""

ENOUGH_SWING = 0.06
"""Greatest detectable swing with which the absence of lines means that there is no damage."""

SURELY = 2.0
"""Ratio of the swing that nine of ten signals show to that whose lines just reach the least level:
lines of noise scatter, and the loudest of a comb does not count. Measured with noise of 2 to 20 s
whose power swings at six harmonics."""

SILENT = 0.25
"""Share of damaged bearings among those without any sign. Of 55 damaged bearings of a motor 5
showed nothing at a distant sensor, and most bearings that are measured are suspected."""

SMOOTH = 2.4
"""Kurtosis of a band (2 for noise) above which there are knocks of any kind: no bearing is called
healthy then. Noise whose power swings by more than six tenths of its mean has the same kurtosis."""

MUCH_DROPPED, MUCH_CLIPPED = 0.1, 0.02
"""Shares above which the absence of lines means nothing."""

SOME_DROPPED = 1e-3
"""Share of dropped samples above which a remark mentions them."""

FAINT, FAINT_RACE = 2.5, 4.0
"""Deviations of lines of a ball or a race from which on a bearing is not called healthy, although
they are too faint to name the part."""


def decide(signal: ListenedSignal, judged: Judged, shaft: float | None, source: str) -> Diagnosis:
    """Return the answer with its sentence; `shaft` [Hz] is None where no speed is known."""
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
    elif (reason := _doubt_of_silence(signal, judged)) is not None:
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
    """Return the envelope's spectrum in the band of the best evidence, at the finest resolution."""
    envelope = judged.resolutions[-1].envelope_of(judged.leading)
    frequency = envelope.levels.step * np.arange(len(envelope.levels.level), dtype=float)
    return EnvelopeLines(frequency, envelope.levels.level, envelope.band, envelope.direction)


def _cause_outside(judged: Judged) -> Reason | None:
    """Return the source outside the bearing that may make the lines: mains, shaft, bearing."""
    doubtful = max(judged.evidence, key=lambda part: part.without_magnetic)
    if doubtful.magnetic > 0.0 and doubtful.without_magnetic >= NAMED:
        return DiagnosisStatus.MAGNETIC, say.magnetic(doubtful)
    leading = [part for part in judged.evidence if part.line_lead >= LEAD]
    for part in leading:
        if not math.isnan(part.foreign_spacing):
            return DiagnosisStatus.OTHER_SHAFT, say.other_shaft(part, judged.shaft)
    # under a load that stands still the part's turning modulates its blows: equally strong blows
    # may come from elsewhere
    unmodulated = [
        part
        for part in leading
        if _is_seen(part) and part.modulation < 0.0 and part.level > judged.other.level
    ]
    if not unmodulated:
        return None
    loudest = max(unmodulated, key=lambda part: part.line_lead)
    if loudest.magnetic > 0.0:
        return DiagnosisStatus.MAGNETIC, say.magnetic(loudest)
    return DiagnosisStatus.UNMODULATED, say.unmodulated(loudest)


def _parts_in_doubt(judged: Judged) -> Reason | None:
    """Return the doubt if lines of this bearing fit several parts, or none well enough."""
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
    """Return True if the lines of a part stand out of noise and swing the envelope enough."""
    return part.level - part.noise >= NOISE_MARGIN and part.swing >= LEAST_SWING


def _hidden(signal: ListenedSignal) -> Reason | None:
    """Return the fault of the signal that may hide damage, or None."""
    if signal.dropped > MUCH_DROPPED:
        words = say.nothing_but("parts of the signal dropped out", signal.dropped)
        return DiagnosisStatus.DROPPED_OUT, words
    if signal.clipped > MUCH_CLIPPED:
        return DiagnosisStatus.CLIPPED, say.nothing_but("the signal is clipped", signal.clipped)
    return None


def _doubt_of_silence(signal: ListenedSignal, judged: Judged) -> Reason | None:
    """Return the reason why the absence of lines means nothing, or None."""
    blows = _impulsiveness(judged, signal)
    if blows > SMOOTH:
        return DiagnosisStatus.IRREGULAR, say.blows(blows, signal.duration)
    if signal.only_rounding:
        return DiagnosisStatus.ROUNDED, say.ROUNDED
    if judged.detectable > ENOUGH_SWING:
        return DiagnosisStatus.INSENSITIVE, say.weak(SURELY * judged.detectable, signal.duration)
    clearest = max(judged.evidence, key=lambda part: part.deviations)
    if clearest.deviations >= FAINT_RACE:
        return DiagnosisStatus.FAINT, say.faint(clearest)
    return None


def _impulsiveness(judged: Judged, signal: ListenedSignal) -> float:
    """Return the greatest kurtosis of broad bands below the filter of the recorder.

    Above five sixths of the range a recorder often filters out everything. Five deviations of the
    kurtosis of noise, sqrt(20/N), are subtracted, because chance adds as much in a short signal.
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


def no_diagnosis(
    status: DiagnosisStatus, detail: str, source: str, shaft: float | None = None
) -> Diagnosis:
    """Return the diagnosis of a signal that cannot be analysed, with the reason."""
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
