"""Diagnosis of the damaged part of a bearing from a signal, the geometry and the speed.

Knocks of a damaged part repeat at a frequency that follows from the geometry. The signal is
whitened, so that tones of shaft, mesh and mains lose their weight (Sawalhi & Randall's
pre-whitening, smoothed). Squared envelopes are computed in the bands of the fast kurtogram. Their
spectra are searched for combs of lines with one common slip (see `combs`, `judged`, `spin`). The
evidence gives a probability for each part (`probability`), and a part is named if it is more
probable than not. The few constants are the same for every machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bearingcore.bearings import Bearing, BearingLike, bearing_of
from bearingcore.common import _checks as checks
from bearingcore.measured.diagnosis._part import say
from bearingcore.measured.diagnosis._part.decide import ENOUGH_SWING, decide, no_diagnosis
from bearingcore.measured.diagnosis._part.evidence import CANNOT_TELL, NONE_SEEN, Diagnosis
from bearingcore.measured.diagnosis._part.judged import judge
from bearingcore.measured.diagnosis._part.listened_signal import ListenedSignal, unfit
from bearingcore.measured.diagnosis._part.over_turns import resample_to_steady_speed, speed_change
from bearingcore.measured.diagnosis._part.parts import BALL, INNER, OUTER, PartLines, part_lines
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus
from bearingcore.measured.diagnosis._part.unknown_speed import NARROW, diagnose_in_range
from bearingcore.recordings import Recording

SLIP = 0.02
"""Largest relative difference between the passing rate of balls and that by the shaft speed."""

SPEEDS = (2.0 * math.pi * 5.0, 2.0 * math.pi * 100.0)
"""Least and greatest speed [rad/s] in the search for an unknown one."""

UNWHITENED_FACTOR = 0.6
"""Factor of a swing that was measured without whitening, which leaves tones in it."""

ELSEWHERE = (0.5, 1.9)
"""Range, relative to the stated speed, in which the shaft's lines are searched if none are there.
Lines at twice the speed and below half of it may be multiples and parts of the shaft's own."""

CONTRADICTED = 0.5
"""Factor of a probability if the lines of the shaft contradict the stated speed."""

SOURCES = ("given", "from the file", "assumed")
"""Origins of a speed and a bearing; "given" means by a person, for this measurement."""


def diagnose_recording(
    recording: Recording,
    bearing: BearingLike | None = None,
    shaft_speed: float | tuple[float, float] | None = None,
    *,
    slip: float = SLIP,
    shaft_ratio: float = 1.0,
    speed_source: str = "given",
    bearing_source: str = "given",
) -> Diagnosis:
    """Diagnose a recording; `diagnose` describes the arguments."""
    checks.instance("recording", recording, Recording)
    bearing = None if bearing is None else bearing_of(bearing)
    for name, source in (("speed_source", speed_source), ("bearing_source", bearing_source)):
        checks.choice(name, source.partition(":")[0], SOURCES)
    ratio = checks.real_number("shaft_ratio", shaft_ratio, at_least=0.01, at_most=100.0)
    speeds = _speeds(recording, shaft_speed, speed_source, ratio)
    slip = checks.real_number("slip", slip, at_least=0.0, at_most=0.1)
    behind_gear = recording if ratio == 1.0 else recording.scale_shaft(ratio)
    steady, low, high, source = resample_to_steady_speed(behind_gear, *speeds)
    speeds, measured = (low, high, source), recording.shaft_angle is not None
    diagnosis = _diagnose(steady, bearing, speeds, ratio, slip, speed_source, measured)
    return replace(
        diagnosis,
        bearing_source="unknown" if bearing is None else bearing_source,
        shaft_ratio=ratio,
        steady_recording=None if steady is behind_gear else steady,
    )


def _diagnose(
    recording: Recording,
    bearing: Bearing | None,
    speeds: tuple[float, float, str],
    ratio: float,
    slip: float,
    speed_source: str,
    measured: bool,
) -> Diagnosis:
    """Diagnose a recording of a steady speed, and check the answer against the shaft's lines."""
    low, high, source = speeds
    signal = ListenedSignal(recording)
    if signal.unusable is not None:
        return no_diagnosis(*signal.unusable, source)
    if bearing is None:
        return no_diagnosis(DiagnosisStatus.BEARING_OPEN, say.WHICH_BEARING, source)
    answer = _diagnose_between(signal, bearing, low, high, slip, source, speed_source)
    # sidebands of an inner race or a ball confirm the speed; an outer race has none
    if high > NARROW * low or answer.fault in (INNER, BALL):
        return answer
    speed, reach = 0.5 * (low + high), (high - low) / (high + low) + slip
    checked = _check_against_shaft(signal, answer, speed, reach, speed / ratio)
    if measured or checked.names_a_part or not checked.evidence:
        return checked
    change = speed_change(signal.columns, signal.rate, speed)
    if not change:
        return checked
    return replace(
        checked,
        fault=CANNOT_TELL,
        status=DiagnosisStatus.SPEED_CHANGES,
        detail=say.speed_changes(change),
        probability=max(part.probability for part in checked.evidence),
    )


def _diagnose_between(
    signal: ListenedSignal,
    bearing: Bearing,
    low: float,
    high: float,
    slip: float,
    source: str,
    speed_source: str,
) -> Diagnosis:
    """Return the diagnosis at a speed between two [Hz], which may be equal."""
    if high <= low * (1.0 + 1e-9):
        return _diagnose_at(signal, bearing, low * (1.0 - slip), low * (1.0 + slip), slip, source)
    if high <= low * (1.0 + 2.0 * slip):  # slip is as large: a part's lines give no better speed
        source = f"{speed_source} as a range"
        return _diagnose_at(signal, bearing, low, high, slip, source, 0.5 * (high / low - 1.0))
    answer = diagnose_in_range(signal, bearing, low, high, slip, source)
    if answer.shaft_speed is None:
        return answer
    shaft = answer.shaft_speed / (2.0 * math.pi)
    return _second_opinion(signal, part_lines(bearing), answer, shaft, shaft, slip)


def _check_against_shaft(
    signal: ListenedSignal, answer: Diagnosis, speed: float, reach: float, driving: float
) -> Diagnosis:
    """Check an answer against lines of the shaft at another speed than the stated one [Hz].

    If the lines of the shaft are elsewhere and none is at the stated speed, either that speed or
    the sample rate is wrong: no part is named, and the answer says which speed the lines show. At
    60 times the speed or a 60th of it, Hz and rpm were probably confused. Lines of the shaft that
    drives this one by a gear, at `driving` [Hz], contradict nothing.
    """
    stated = signal.shaft(speed * (1.0 - reach), speed * (1.0 + reach))
    if stated.clear:
        return answer
    least, most = (turning / (2.0 * math.pi) for turning in SPEEDS)
    for other in (60.0 * speed, speed / 60.0):
        if answer.names_a_part or not least <= other <= most:
            continue
        if signal.shaft(other * (1.0 - reach), other * (1.0 + reach)).clear:
            return replace(answer, detail=f"{answer.detail} {say.other_unit(speed, other)}")
    if stated.excess >= 0.0:
        return answer
    shown = signal.shaft_tones(ELSEWHERE[0] * speed, ELSEWHERE[1] * speed)
    if not shown.clear or abs(shown.frequency / driving - 1.0) <= reach:
        return answer
    words = say.lines_elsewhere(speed, shown.frequency)
    if not answer.names_a_part:
        return replace(answer, detail=f"{answer.detail} {words}")
    return replace(
        answer,
        fault=CANNOT_TELL,
        status=DiagnosisStatus.OTHER_SHAFT,
        detail=f"{say.against_the_shaft(answer.of(answer.fault))} {words}",
        probability=CONTRADICTED * answer.probability,
        evidence=tuple(
            replace(part, probability=CONTRADICTED * part.probability) for part in answer.evidence
        ),
    )


def _speeds(
    recording: Recording, shaft_speed: float | tuple[float, float] | None, source: str, ratio: float
) -> tuple[float, float, str]:
    """Return the range (from, to) [Hz] of the speed of the bearing's shaft, and its source."""
    turn = 2.0 * math.pi / ratio
    if shaft_speed is None:
        if recording.shaft_speed is None:
            return SPEEDS[0] / (2.0 * math.pi), SPEEDS[1] / (2.0 * math.pi), "looked for"
        shaft_speed, source = recording.shaft_speed, "given by the recording"
    if np.ndim(shaft_speed) == 0:
        speed = checks.real_number("shaft_speed", shaft_speed, above=0.0, unit="rad/s") / turn  # type: ignore[arg-type]
        return speed, speed, source
    try:
        first, last = shaft_speed  # type: ignore[misc]
    except (TypeError, ValueError):
        raise checks.refuse(
            "shaft_speed", shaft_speed, "a number [rad/s], a pair of them, or None"
        ) from None
    first = checks.real_number("lower shaft_speed", first, above=0.0, unit="rad/s")
    last = checks.real_number("upper shaft_speed", last, at_least=first, unit="rad/s")
    return first / turn, last / turn, "looked for"


def _diagnose_at(
    signal: ListenedSignal,
    bearing: Bearing,
    low: float,
    high: float,
    slip: float,
    source: str,
    reach: float = 0.0,
) -> Diagnosis:
    """Return the diagnosis at the speed between two [Hz] that the shaft's lines show.

    Without such lines it is at the middle; `reach` is the largest relative error of the middle.
    """
    parts = part_lines(bearing)
    shaft = 0.5 * (low + high)
    reason = unfit(signal, parts, shaft)
    if reason is not None:
        return no_diagnosis(*reason, source, shaft)
    stated, lines = shaft, signal.shaft(low, high)
    # lines that are broader than their window give no finer speed
    if lines.clear and signal.duration * (high - low) > 1.0:
        shaft = lines.frequency
        stated = shaft if reach else stated
        source += ", refined from the shaft lines in the signal"
    else:
        slip += reach
        source += ", its middle" if reach else ""
    answer = decide(signal, judge(signal, parts, shaft, slip, stated), shaft, source)
    return _second_opinion(signal, parts, answer, shaft, stated, slip)


_IN_DOUBT = (
    DiagnosisStatus.PERHAPS_A_BALL,
    DiagnosisStatus.MAGNETIC,
    DiagnosisStatus.UNMODULATED,
)
"""Outcomes that keep a bearing from being called healthy."""

_INSTEAD_OF = {
    DiagnosisStatus.NONE_SEEN: _IN_DOUBT,
    **dict.fromkeys(
        (DiagnosisStatus.IRREGULAR, DiagnosisStatus.INSENSITIVE, DiagnosisStatus.FAINT),
        (
            *_IN_DOUBT,
            DiagnosisStatus.ALIKE,
            DiagnosisStatus.NOT_ALONE,
            DiagnosisStatus.OTHER_SOURCE,
        ),
    ),
}
"""For outcomes without lines: those of a second opinion that replace them."""


def _second_opinion(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    answer: Diagnosis,
    shaft: float,
    stated: float,
    slip: float,
) -> Diagnosis:
    """Diagnose the signal without whitening, if the whitened one names no race.

    A steady cage makes lines as sharp as tones, and whitening weakens those. Without whitening
    foreign tones show too, so that lines count with a part of their swing. If they do not name a
    part, they keep a bearing from being called healthy.
    """
    if answer.fault in (OUTER, INNER) or answer.status == DiagnosisStatus.OTHER_SHAFT:
        return answer
    judged = judge(signal.unwhitened(), parts, shaft, slip, stated).scale_swings(UNWHITENED_FACTOR)
    second = decide(signal, judged, shaft, answer.speed_source)
    if answer.fault == BALL:  # sharp lines without modulation are not a ball's
        foreign = second.status == DiagnosisStatus.UNMODULATED and not second.of(BALL).modulated
        return second if foreign else answer
    if second.fault in (OUTER, INNER):
        return second
    is_faint = answer.fault == NONE_SEEN and judged.leading.swing < ENOUGH_SWING
    replaces = second.status in _INSTEAD_OF.get(answer.status, ())
    return second if replaces and not is_faint else answer
