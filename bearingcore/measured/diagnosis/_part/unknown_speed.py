"""Diagnosis and search for a speed that is known only roughly or not at all."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from bearingcore.bearings import Bearing
from bearingcore.measured.diagnosis._part import say
from bearingcore.measured.diagnosis._part.decide import NAMED, decide, no_diagnosis
from bearingcore.measured.diagnosis._part.evidence import CANNOT_TELL, Diagnosis
from bearingcore.measured.diagnosis._part.judged import (
    NOISE_MARGIN,
    Judged,
    all_combs,
    compare,
    judge,
)
from bearingcore.measured.diagnosis._part.listened_signal import ListenedSignal, unfit
from bearingcore.measured.diagnosis._part.parts import PartLines, part_lines
from bearingcore.measured.diagnosis._part.probability import SURE
from bearingcore.measured.diagnosis._part.shaft import ERROR, ShaftLines
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus

NARROW = 1.3
"""Greatest ratio of the ends of a range of speeds that needs no lines of the shaft."""

SHAFT_MARGIN = 6.0
"""Least lead [dB] of the shaft's lines at one speed over those at another."""


def diagnose_in_range(
    signal: ListenedSignal, bearing: Bearing, low: float, high: float, slip: float, source: str
) -> Diagnosis:
    """Search for the speed between two [Hz], and return the diagnosis.

    The strongest comb in the signal may belong to any part that has its line there at a speed in
    the range. The shaft's own lines at these speeds decide between them.
    """
    parts = part_lines(bearing)
    if (reason := _unfit_in_range(signal, parts, low, high)) is not None:
        return no_diagnosis(*reason, source)
    shaft = signal.shaft(low, high)
    hypotheses = []
    if shaft.clear:
        hypotheses.append(_Hypothesis(shaft, judge(signal, parts, shaft.frequency, slip)))
    middle, reach = 0.5 * (low + high), (high - low) / (high + low) + slip
    resolutions = all_combs(signal, parts, middle, reach, known_speed=False)
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
                near, speed = signal.shaft(*ends), min(max(speed, low), high)
                speed = near.frequency if near.clear else speed
                hypotheses.append(_Hypothesis(near, judge(signal, parts, speed, slip)))
    probable = [guess for guess in hypotheses if guess.judged.leading.probability >= NAMED]
    if probable:
        probable.sort(key=lambda guess: -guess.shaft.excess)
        return _choose(signal, probable, slip, low, high, source)
    if shaft.clear:
        return decide(signal, hypotheses[0].judged, shaft.frequency, _BY_SHAFT_LINES)
    if hypotheses:
        return _undecided_speed(signal, hypotheses, strongest, source)
    # there are no lines, or no part has them at any of these speeds
    judged = compare(resolutions, parts, reach)
    answer = decide(signal, judged, None, f"{source}, not found")
    if not answer.names_a_part:
        return answer
    # lines that fit a part only outside the range, or that are too faint to give a speed
    best = judged.leading
    beyond = replace(judged, shaft=best.frequency / best.nominal_order)
    return _undecided_speed(signal, [_Hypothesis(shaft, beyond)], best.frequency, source)


def _unfit_in_range(
    signal: ListenedSignal, parts: Sequence[PartLines], low: float, high: float
) -> tuple[DiagnosisStatus, str] | None:
    """Return the reason why a signal cannot be analysed at some speed [Hz] of a range, or None."""
    slow, fast = unfit(signal, parts, low), unfit(signal, parts, high)
    if slow is not None and fast is not None and slow[0] == fast[0]:  # so at all speeds between
        return fast if slow[0] == DiagnosisStatus.TOO_SHORT else slow
    known = "is known only roughly" if high <= NARROW * low else "is not known"
    if slow is not None:
        return DiagnosisStatus.SPEED_OPEN, say.too_far(known, "slowest", low, slow[1])
    if fast is not None:
        return DiagnosisStatus.SPEED_OPEN, say.too_far(known, "fastest", high, fast[1])
    return None


def _choose(
    signal: ListenedSignal,
    probable: Sequence[_Hypothesis],
    slip: float,
    low: float,
    high: float,
    source: str,
) -> Diagnosis:
    """Return the diagnosis at the speed with the clearest shaft, if no other is nearly as clear."""
    first = probable[0]
    rival = next((guess for guess in probable[1:] if not guess.agrees(first, slip)), None)
    is_only_one = high <= NARROW * low and rival is None
    if not (first.shaft.clear or is_only_one):
        return _undecided_speed(signal, probable, first.judged.leading.frequency, source)
    if rival is not None and first.shaft.excess < rival.shaft.excess + SHAFT_MARGIN:
        return _undecided_speed(signal, [first, rival], first.judged.leading.frequency, source)
    if first.shaft.clear:
        return decide(signal, first.judged, first.judged.shaft, _BY_SHAFT_LINES)
    # lines of another source anywhere in the range would look like the part's
    width = 2.0 * math.atanh(max(slip, ERROR))
    judged = first.judged.divide_odds(1.0 + math.log(high / low) / width)
    part = first.judged.leading.part
    return decide(signal, judged, judged.shaft, f"taken from the lines of the {part}")


_BY_SHAFT_LINES = "found by the shaft's own lines"


def _undecided_speed(
    signal: ListenedSignal, hypotheses: Sequence[_Hypothesis], frequency: float, source: str
) -> Diagnosis:
    """Return the diagnosis of knocks whose part depends on the unknown speed."""
    readings: dict[str, float] = {}
    for guess in hypotheses:
        readings.setdefault(guess.judged.leading.part, guess.judged.shaft)
    decided = decide(signal, hypotheses[0].judged, None, source)
    # all readings are equally probable, so the evidence of each counts with an equal share
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
        """Return True if speed and leading part of another hypothesis are the same."""
        ratio = self.judged.shaft / other.judged.shaft
        same = self.judged.leading.part == other.judged.leading.part
        return same and abs(ratio - 1.0) <= 2.0 * slip
