"""Levels of the combs of the parts against noise, each other and all other lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bearingcore.diagnosis.part.combs import HARMONICS, harmonics
from bearingcore.diagnosis.part.evidence import OtherLines, PartEvidence
from bearingcore.diagnosis.part.listened_signal import ListenedSignal
from bearingcore.diagnosis.part.parts import BALL, INNER, OUTER, PartLines
from bearingcore.diagnosis.part.search import (
    TURNS,
    WANDER,
    Combs,
    Found,
    excess,
    listen,
    multiples,
    near,
    side_levels,
    sideband_combs,
    within,
)

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

ALONE = 3.0
"""[dB] beyond the margins by which a part leads that fills a band."""

LEAD_UNDER_NOISE = 2.0
"""[dB] below the level of noise down to which a part that leads may be borne out otherwise."""

SLOWER, FAINTER = (2, 3), 0.7
"""Parts of a comb's frequency at which it may be seen too, and how much fainter the lines between
its own are then."""

LEAST_DEPTH = 0.03
"""Share of its mean by which the envelope swings at each line of a damaged part. Healthy bearings
show their lines too, by 1 or 2 %."""


@dataclass(frozen=True)
class Judged:
    """The combs at the resolution that shows most, and how they compare."""

    combs: Combs
    best: Found
    second: Found
    other: OtherLines
    above_noise: float
    above_second: float
    above_other: float
    above_other_in_band: float
    """The same against those in the band alone in which the part is clearest."""
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
        """Whether any part's lines are clear at all."""
        return self.above_noise >= NOISE_MARGIN and self.own.depth >= LEAST_DEPTH

    @property
    def stands_alone(self) -> bool:
        """Whether a part fills a band by far, whatever else knocks in other bands."""
        margins = (
            self.above_noise - NOISE_MARGIN,
            self.above_second - PART_MARGIN,
            self.above_other_in_band - OTHER_MARGIN,
        )
        return self.seen and min(margins) >= ALONE and self.above_sidebands >= 0.0

    def leads_to(self, other: Judged) -> bool:
        """Whether the same part leads here as there, by the same lines and not under all noise."""
        apart = abs(self.best.frequency / other.best.frequency - 1.0)
        same = self.best.lines.part == other.best.lines.part
        return same and apart <= WANDER and self.above_noise >= -LEAD_UNDER_NOISE


def judge(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    given: float | None = None,
) -> Judged:
    """The best combs of the parts at a speed [Hz], compared."""
    combs, resolutions = most_telling(signal, parts, shaft, slip, True, given)
    return compare(signal, combs, resolutions, parts, slip, given)


def most_telling(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    known_speed: bool,
    given: float | None = None,
) -> tuple[Combs, list[Combs]]:
    """The combs at the resolution where one is highest above noise, and at all of them."""
    top = max(lines.order for lines in parts) * (1.0 + slip)
    envelopes = signal.envelopes(shaft, (HARMONICS * top + 2.0) * shaft)
    resolutions: list[Combs] = []
    for turns in TURNS:
        resolutions.append(listen(envelopes, parts, shaft, known_speed, slip, turns, given))
        if turns / shaft >= signal.duration:
            break  # longer segments than the signal are the same again
    return max(resolutions, key=excess), resolutions


def compare(
    signal: ListenedSignal,
    combs: Combs,
    resolutions: Sequence[Combs],
    parts: Sequence[PartLines],
    slip: float,
    given: float | None = None,
) -> Judged:
    """Levels of the combs of the parts against noise, each other and all other lines."""
    shaft = combs.shaft
    cage = next(lines.sidebands for lines in parts if lines.part == BALL) * shaft
    best, rivals = _ranked(combs, cage, slip, given or shaft)
    second = rivals[0]
    free = multiples(combs, best.frequency, (1, 2, 3))
    follows = sideband_combs(combs, best.frequency, (shaft, cage))
    if best.lines.part == BALL:  # its spin itself is half its line
        free |= multiples(combs, best.frequency, (0.5, 1.5))
        follows |= sideband_combs(combs, 0.5 * best.frequency, (shaft, cage))
    free |= _slower(combs, best)
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
    in_band = combs.level[best.place]
    in_band = float(np.where(free | follows | own, -np.inf, in_band).max())
    above_other = min(
        best.level - other.level, best.level - float(followers.max(initial=-np.inf)) + OTHER_MARGIN
    )
    evidence = tuple(
        _evidence(combs, best if found.lines == best.lines else found, cage)
        for found in combs.found
    )
    return Judged(
        combs=combs,
        best=best,
        second=second,
        other=other,
        above_noise=best.level - combs.noise,
        above_second=best.level - second.level,
        above_other=above_other,
        above_other_in_band=best.level - in_band,
        above_sidebands=_above_sidebands(combs, best, cage),
        evidence=evidence,
        detectable=min(_detectable(one, signal) for one in resolutions),
    )


def _slower(combs: Combs, best: Found) -> np.ndarray:
    """Which combs (n,) are the best one's own, seen at a half or a third of its frequency.

    A motion may repeat every second or third knock only, and then lines are between the knocks'
    own; they are the fainter ones. Of a source that itself knocks that seldom all are alike.
    """
    found = np.zeros(len(combs.frequency), dtype=bool)
    for part in SLOWER:
        near_it = np.flatnonzero(multiples(combs, best.frequency, (1.0 / part,)))
        if not len(near_it):
            continue
        column = int(near_it[combs.level[:, near_it].max(axis=0).argmax()])
        one = combs.envelopes[int(combs.level[:, column].argmax())]
        at = np.array([combs.frequency[column]])
        depth = harmonics(one.levels.depth, one.levels.step, at, part * (HARMONICS // part))[:, 0]
        shared = np.arange(1, len(depth) + 1) % part == 0
        if depth[~shared].mean() < FAINTER * depth[shared].mean():
            found[near_it] = True
    return found


def _ranked(combs: Combs, cage: float, slip: float, given: float) -> tuple[Found, list[Found]]:
    """The part whose comb is highest, and its rivals.

    No rival is a part whose comb is a multiple of the best one's, or its skirt: it has those lines
    for free. Where one comb is in the windows of two parts, as a ball's and an outer race's may,
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
    if not rivals:  # all that is left shares its lines: there is nothing else to distinguish
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
    one, at = combs.envelopes[found.place], np.array([found.frequency])

    def mean(spacing: float) -> float:
        sides = side_levels(one, at, spacing)
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
    one = combs.envelopes[found.place]
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
        sidebands=np.hstack(side_levels(one, at, spacing)),
        sideband_spacing=spacing,
        sideband_source="cage" if lines.part == BALL else "shaft",
        band=one.band,
        direction=one.direction,
        kurtosis=one.kurtosis,
        false_alarm=found.chance,
    )


def _detectable(combs: Combs, signal: ListenedSignal) -> float:
    """The least swing of the envelope in the widest band that would have been seen."""
    widest = max(combs.envelopes, key=lambda one: one.band.high - one.band.low)
    needed = 10.0 ** (0.1 * (combs.noise + NOISE_MARGIN)) - 1.0
    return float(np.median(widest.levels.floor)) * math.sqrt(max(needed, 0.0))
