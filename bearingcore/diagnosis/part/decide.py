"""The answer that the margins allow, and its sentence."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.diagnosis.part import say
from bearingcore.diagnosis.part.combs import harmonics
from bearingcore.diagnosis.part.evidence import CANNOT_TELL, NONE_SEEN, Diagnosis, EnvelopeLines
from bearingcore.diagnosis.part.judged import (
    LEAST_DEPTH,
    NOISE_MARGIN,
    OTHER_MARGIN,
    PART_MARGIN,
    Judged,
)
from bearingcore.diagnosis.part.listened_signal import ListenedSignal
from bearingcore.diagnosis.part.search import Combs

ENOUGH_POWER = 0.06
"""The swing that must be visible before the absence of lines means anything."""

SMOOTH = 3.3
"""Kurtosis of a band's envelope (2 for noise) above which something knocks, whatever it is: no
bearing is called healthy then."""

MUCH_DROPPED, MUCH_CLIPPED = 0.1, 0.02
"""Shares from which the absence of lines means nothing."""

FAINT = 1.0
"""[dB] above the level of noise from which lines, too faint to name a part, forbid to call it
healthy."""

SURE = 0.99
"""The greatest probability: a cause outside the model is always possible."""


def decide(signal: ListenedSignal, judged: Judged, shaft: float | None, source: str) -> Diagnosis:
    """The answer, and its sentence; `shaft` [Hz] is None where no speed was found."""
    own, other = judged.own, judged.other
    others_stand_out = other.level - judged.combs.noise >= NOISE_MARGIN
    blows = _impulsiveness(judged.combs, signal)
    fault, chance = CANNOT_TELL, _likely(judged)
    if judged.seen and judged.margin >= 0.0:
        fault = own.part
        status = say.damaged(own)
    elif judged.seen:
        status = _undecided(judged)
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
    one = judged.combs.envelopes[judged.best.place]
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


def _undecided(judged: Judged) -> str:
    """Reason why visible lines do not identify one part."""
    if judged.above_second < PART_MARGIN:
        return say.alike(judged.own, judged.second.lines.part, judged.second.level)
    if judged.above_other < OTHER_MARGIN:
        return say.no_stronger(judged.own, judged.other)
    return say.no_sidebands(judged.own)


def _impulsiveness(combs: Combs, signal: ListenedSignal) -> float:
    """The greatest kurtosis of broad bands below the recorder's own filter.

    Above five sixths of the range there is often nothing but that filter's rest. What chance adds
    in a short signal is taken off: five deviations of the kurtosis of noise, sqrt(20/N).
    """
    sixth = signal.rate / 12.0
    broad = [
        one.kurtosis - 5.0 * math.sqrt(20.0 / (signal.duration * (one.band.high - one.band.low)))
        for one in combs.envelopes
        if one.band.high <= 5.05 * sixth and one.band.high - one.band.low >= 0.95 * sixth
    ]
    return max(broad or [one.kurtosis for one in combs.envelopes])


def _deep(judged: Judged) -> bool:
    """Whether the lines of something else swing the envelope as damage does."""
    combs, frequency = judged.combs, judged.other.frequency
    index = int(np.abs(combs.frequency - frequency).argmin())
    one = combs.envelopes[int(combs.level[:, index].argmax())]
    depths = np.sort(harmonics(one.levels.depth, one.levels.step, np.array([frequency]))[:, 0])
    return bool(depths[:-1].mean() >= LEAST_DEPTH)


def _likely(judged: Judged) -> float:
    """Probability that the leading part is the damaged one."""
    return SURE / (1.0 + math.exp(-(judged.margin + 1.0) / 1.0))


def _unharmed(judged: Judged) -> float:
    """Probability that nothing is damaged where nothing is seen."""
    return min(SURE, 1.0 - judged.detectable)


def silent(status: str, source: str, shaft: float | None = None) -> Diagnosis:
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
