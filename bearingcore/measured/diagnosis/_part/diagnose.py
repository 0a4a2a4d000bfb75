"""Diagnosis of the damaged part of a bearing from a signal, the geometry and the speed.

Knocks of a damaged part repeat at a frequency that the geometry gives. The signal is whitened, so
that tones of shaft, mesh and mains lose their weight (Sawalhi & Randall's pre-whitening, smoothed);
squared envelopes are taken in the bands of the fast kurtogram; in their spectra combs of lines are
looked for, with one common slip (see `combs`, `judged`, `spin`). What they are worth is a
probability for each part (`probability`), and a part is named if it is more probable than not.
The numbers in it are few, and the same for every machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bearingcore.bearings import Bearing, BearingLike, bearing_of
from bearingcore.common import _checks as checks
from bearingcore.measured.diagnosis._part import say
from bearingcore.measured.diagnosis._part.decide import ENOUGH_SWING, decide, silent
from bearingcore.measured.diagnosis._part.evidence import CANNOT_TELL, NONE_SEEN, Diagnosis
from bearingcore.measured.diagnosis._part.judged import judge
from bearingcore.measured.diagnosis._part.listened_signal import ListenedSignal, unfit
from bearingcore.measured.diagnosis._part.over_turns import (
    followed_change,
    resample_to_steady_speed,
)
from bearingcore.measured.diagnosis._part.parts import BALL, INNER, OUTER, PartLines, part_lines
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus
from bearingcore.measured.diagnosis._part.unknown_speed import NARROW, diagnose_in_range
from bearingcore.recordings import Recording

SLIP = 0.02
"""Fraction by which balls may pass faster or slower than the shaft speed says."""

SPEEDS = (2.0 * math.pi * 5.0, 2.0 * math.pi * 100.0)
"""Least and greatest speed [rad/s] at which an unknown shaft is looked for."""

TONES_COUNT = 0.6
"""Share of a swing that counts where tones are not whitened away."""

ELSEWHERE = (0.5, 1.9)
"""Times the stated speed between which the shaft's own lines are looked for, where it has none.
Twice the speed, and half of it, are multiples and parts of its own lines."""

CONTRADICTED = 0.5
"""Share of a probability that is left where the shaft's lines contradict the stated speed."""

SOURCES = ("given", "from the file", "assumed")
"""Origins of a speed and a bearing; "given" is what a person has said of this measurement."""


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
    for name, said in (("speed_source", speed_source), ("bearing_source", bearing_source)):
        checks.choice(name, said.partition(":")[0], SOURCES)
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
    low, high, source = speeds
    signal = ListenedSignal(recording)
    if signal.unusable is not None:
        return silent(*signal.unusable, source)
    if bearing is None:
        return silent(DiagnosisStatus.BEARING_OPEN, say.WHICH_BEARING, source)
    answer = _diagnose_between(signal, bearing, low, high, slip, source, speed_source)
    # sidebands of an inner race or a ball confirm the speed, an outer race has none
    if high > NARROW * low or answer.fault in (INNER, BALL):
        return answer
    speed, reach = 0.5 * (low + high), (high - low) / (high + low) + slip
    held = _held_against_the_shaft(signal, answer, speed, reach, speed / ratio)
    if measured or held.names_a_part or not held.evidence:
        return held
    change = followed_change(signal.columns, signal.rate, speed)
    if not change:
        return held
    return replace(
        held,
        fault=CANNOT_TELL,
        status=DiagnosisStatus.SPEED_CHANGES,
        detail=say.speed_changes(change),
        probability=max(part.probability for part in held.evidence),
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
    """The diagnosis at a speed between two [Hz], which may be one and the same."""
    if high <= low * (1.0 + 1e-9):
        return _diagnose_at(signal, bearing, low * (1.0 - slip), low * (1.0 + slip), slip, source)
    if high <= low * (1.0 + 2.0 * slip):  # lines of a part, which slips, give a speed no better
        source = f"{speed_source} as a range"
        return _diagnose_at(signal, bearing, low, high, slip, source, 0.5 * (high / low - 1.0))
    answer = diagnose_in_range(signal, bearing, low, high, slip, source)
    if answer.shaft_speed is None:
        return answer
    shaft = answer.shaft_speed / (2.0 * math.pi)
    return _second_opinion(signal, part_lines(bearing), answer, shaft, shaft, slip)


def _held_against_the_shaft(
    signal: ListenedSignal, answer: Diagnosis, speed: float, reach: float, driving: float
) -> Diagnosis:
    """The answer, held against lines of the shaft at another speed than the stated one [Hz].

    Lines of the shaft elsewhere, and none at the stated speed, mean that speed or sample rate are
    wrong: no part is named then, and the answer says which speed the lines show. At 60 times the
    speed or a 60th of it, Hz and rpm are confused most likely. Lines of the shaft that is `driving`
    [Hz] the bearing's by a gear contradict nothing.
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
    recording: Recording, shaft_speed: float | tuple[float, float] | None, said: str, ratio: float
) -> tuple[float, float, str]:
    """The speed of the bearing's shaft from, to [Hz], and where it is from."""
    turn = 2.0 * math.pi / ratio
    if shaft_speed is None:
        if recording.shaft_speed is None:
            return SPEEDS[0] / (2.0 * math.pi), SPEEDS[1] / (2.0 * math.pi), "looked for"
        shaft_speed, said = recording.shaft_speed, "given by the recording"
    if np.ndim(shaft_speed) == 0:
        speed = checks.real_number("shaft_speed", shaft_speed, above=0.0, unit="rad/s") / turn  # type: ignore[arg-type]
        return speed, speed, said
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
    """The diagnosis at the middle of two speeds [Hz], or where the shaft's own lines are between.

    `reach` is by how much the middle may be off, as a fraction.
    """
    parts = part_lines(bearing)
    shaft = 0.5 * (low + high)
    refused = unfit(signal, parts, shaft)
    if refused is not None:
        return silent(*refused, source, shaft)
    stated, turning = shaft, signal.shaft(low, high)
    # lines broader than the window that they are looked for in make nothing finer
    if turning.clear and signal.duration * (high - low) > 1.0:
        shaft = turning.frequency
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
"""Outcomes of a second opinion that take the place of one that has seen no lines."""


def _second_opinion(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    answer: Diagnosis,
    shaft: float,
    stated: float,
    slip: float,
) -> Diagnosis:
    """Diagnosis of the signal without whitening, where the whitened one names no race.

    A cage that keeps its speed makes lines as sharp as tones, and whitening cuts those. Tones that
    are none of the bearing's show too, so that lines count by a part of their swing; where they do
    not name a part, they keep a bearing from being called healthy.
    """
    if answer.fault in (OUTER, INNER) or answer.status == DiagnosisStatus.OTHER_SHAFT:
        return answer
    judged = judge(signal.unwhitened(), parts, shaft, slip, stated).counting(TONES_COUNT)
    again = decide(signal, judged, shaft, answer.speed_source)
    if answer.fault == BALL:  # whitening hides how sharp lines are which nothing modulates
        alone = again.status == DiagnosisStatus.UNMODULATED and not again.of(BALL).modulated
        return again if alone else answer
    if again.fault in (OUTER, INNER):
        return again
    faint = answer.fault == NONE_SEEN and judged.leading.swing < ENOUGH_SWING
    seen = again.status in _INSTEAD_OF.get(answer.status, ())
    return again if seen and not faint else answer
