"""The diagnosis where the speed is known roughly or not at all: it is looked for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from bearingcore.bearings import Bearing
from bearingcore.measured.diagnosis._part import say
from bearingcore.measured.diagnosis._part.decide import NAMED, decide, silent
from bearingcore.measured.diagnosis._part.evidence import CANNOT_TELL, Diagnosis
from bearingcore.measured.diagnosis._part.judged import (
    NOISE_MARGIN,
    Judged,
    compare,
    judge,
    listened,
)
from bearingcore.measured.diagnosis._part.listened_signal import ListenedSignal, unfit
from bearingcore.measured.diagnosis._part.parts import PartLines, part_lines
from bearingcore.measured.diagnosis._part.probability import SURE
from bearingcore.measured.diagnosis._part.shaft import ERROR, ShaftLines
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus

NARROW = 1.3
"""A range of speeds whose ends differ by this factor at most is believed without shaft lines."""

SHAFT_MARGIN = 6.0
"""Lead [dB] that the shaft's lines at one speed must have over those at another."""


def diagnose_in_range(
    signal: ListenedSignal, bearing: Bearing, low: float, high: float, slip: float, source: str
) -> Diagnosis:
    """The diagnosis at a speed between two [Hz], which is looked for.

    The strongest comb in the signal may be of each part that has its line there at some speed of
    the range. Which it is, the shaft's own lines at that speed decide.
    """
    parts = part_lines(bearing)
    if (refusal := _unfit_in_range(signal, parts, low, high)) is not None:
        return silent(*refusal, source)
    shaft = signal.shaft(low, high)
    hypotheses = []
    if shaft.clear:
        hypotheses.append(_Hypothesis(shaft, judge(signal, parts, shaft.frequency, slip)))
    middle, reach = 0.5 * (low + high), (high - low) / (high + low) + slip
    resolutions = listened(signal, parts, middle, reach, known_speed=False)
    strongest, above = max(
        (
            (frequency, level - combs.noise)
            for combs in resolutions
            for frequency, level in combs.best.values()
        ),
        key=lambda pair: pair[1],
    )
    if above >= NOISE_MARGIN:
        for lines in parts:
            speed = strongest / lines.order
            if low * (1.0 - slip) <= speed <= high * (1.0 + slip):
                ends = max(low, speed * (1.0 - slip)), min(high, speed * (1.0 + slip))
                turning, speed = signal.shaft(*ends), min(max(speed, low), high)
                speed = turning.frequency if turning.clear else speed
                hypotheses.append(_Hypothesis(turning, judge(signal, parts, speed, slip)))
    holding = [guess for guess in hypotheses if guess.judged.leading.probability >= NAMED]
    if holding:
        holding.sort(key=lambda guess: -guess.shaft.excess)
        return _choose(signal, holding, slip, low, high, source)
    if shaft.clear:
        return decide(signal, hypotheses[0].judged, shaft.frequency, _BY_SHAFT_LINES)
    if hypotheses:
        return _undecided_speed(signal, hypotheses, strongest, source)
    # no lines, or such as no part has at any of these speeds
    judged = compare(resolutions, parts, reach)
    answer = decide(signal, judged, None, f"{source}, not found")
    if not answer.names_a_part:
        return answer
    # of a part only at a speed outside the range, or too faint to find one
    best = judged.leading
    beyond = replace(judged, shaft=best.frequency / best.nominal_order)
    return _undecided_speed(signal, [_Hypothesis(shaft, beyond)], best.frequency, source)


def _unfit_in_range(
    signal: ListenedSignal, parts: Sequence[PartLines], low: float, high: float
) -> tuple[DiagnosisStatus, str] | None:
    """Return the reason why a signal does not serve at some speed [Hz] of a range, or None."""
    slow, fast = unfit(signal, parts, low), unfit(signal, parts, high)
    if slow is not None and fast is not None and slow[0] == fast[0]:  # at any speed between
        return fast if slow[0] == DiagnosisStatus.TOO_SHORT else slow
    known = "is known only roughly" if high <= NARROW * low else "is not known"
    if slow is not None:
        return DiagnosisStatus.SPEED_OPEN, say.too_far(known, "slowest", low, slow[1])
    if fast is not None:
        return DiagnosisStatus.SPEED_OPEN, say.too_far(known, "fastest", high, fast[1])
    return None


def _choose(
    signal: ListenedSignal,
    holding: Sequence[_Hypothesis],
    slip: float,
    low: float,
    high: float,
    source: str,
) -> Diagnosis:
    """The diagnosis of the speed at which the shaft shows best, if no other is nearly as good."""
    first = holding[0]
    rival = next((guess for guess in holding[1:] if not guess.agrees(first, slip)), None)
    alone = high <= NARROW * low and rival is None
    if not (first.shaft.clear or alone):
        return _undecided_speed(signal, holding, first.judged.leading.frequency, source)
    if rival is not None and first.shaft.excess < rival.shaft.excess + SHAFT_MARGIN:
        return _undecided_speed(signal, [first, rival], first.judged.leading.frequency, source)
    if first.shaft.clear:
        return decide(signal, first.judged, first.judged.shaft, _BY_SHAFT_LINES)
    # any source with lines somewhere in the range would have been taken for the part's
    width = 2.0 * math.atanh(max(slip, ERROR))
    judged = first.judged.discounted(1.0 + math.log(high / low) / width)
    part = first.judged.leading.part
    return decide(signal, judged, judged.shaft, f"taken from the lines of the {part}")


_BY_SHAFT_LINES = "found by the shaft's own lines"


def _undecided_speed(
    signal: ListenedSignal, hypotheses: Sequence[_Hypothesis], frequency: float, source: str
) -> Diagnosis:
    """Knocks that may be of one part or another, as the speed may be."""
    readings: dict[str, float] = {}
    for guess in hypotheses:
        readings.setdefault(guess.judged.leading.part, guess.judged.shaft)
    decided = decide(signal, hypotheses[0].judged, None, source)
    # each reading is as probable as the others: what holds at one speed counts by its share
    share = SURE / max(2, len(readings))
    evidence = [replace(part, probability=share * part.probability) for part in decided.evidence]
    return replace(
        decided,
        fault=CANNOT_TELL,
        status=DiagnosisStatus.SPEED_OPEN,
        detail=say.which_speed(frequency, list(readings.items())),
        probability=share,
        evidence=tuple(evidence),
    )


@dataclass(frozen=True)
class _Hypothesis:
    """A possible speed of the shaft, and the evidence of the signal at it."""

    shaft: ShaftLines
    judged: Judged

    def agrees(self, other: _Hypothesis, slip: float) -> bool:
        """Return True if another speed is the same, and the part."""
        ratio = self.judged.shaft / other.judged.shaft
        same = self.judged.leading.part == other.judged.leading.part
        return same and abs(ratio - 1.0) <= 2.0 * slip
