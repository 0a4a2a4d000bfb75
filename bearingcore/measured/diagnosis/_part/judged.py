"""Evidence of each part in all bands and at all resolutions, and how probable its damage is.

A comb of lines at a race's frequency is judged in the band that shows it best, by two numbers:

- its lead: how far it stands above noise, above every other comb in that band but those that
  follow from it (multiples, sidebands), above the other race's comb, and, on a part that turns,
  how far its sidebands do. It says whether the race's lines are in the signal at all.
- its swing: by how much lines and first sidebands swing the envelope. Balls of a sound bearing and
  marks that a damaged ball has pressed into a race make faint lines too; a race that every ball
  strikes makes strong ones.

Balls wander and slip, so their lines are broad: see `spin`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.diagnosis._part.combs import HARMONICS, comb_level, lines_at, noise_level
from bearingcore.measured.diagnosis._part.evidence import (
    BESIDE,
    OtherLines,
    PartEvidence,
    leading_by,
)
from bearingcore.measured.diagnosis._part.listened_signal import ListenedSignal
from bearingcore.measured.diagnosis._part.mains import magnetic_share
from bearingcore.measured.diagnosis._part.parts import BALL, INNER, OUTER, PARTS, PartLines
from bearingcore.measured.diagnosis._part.probability import (
    CALIBRATION,
    LEAD,
    LEAD_SCALE,
    log_probability,
    probabilities,
)
from bearingcore.measured.diagnosis._part.search import (
    FINENESS,
    RARE,
    TURNS,
    Combs,
    Listened,
    listen,
    mark_near,
    mark_window,
    tolerance,
)
from bearingcore.measured.diagnosis._part.spin import AHEAD, LAG, may_be, spin

NOISE_MARGIN = 2.0
"""Distance [dB] of clear lines from the level that noise reaches in one of a thousand signals."""

SIDEBAND_MARGIN = 2.0
"""Amount [dB] by which sidebands may miss what is asked before the lead becomes negative."""

SIDEBAND_LEAD = 6.0
"""Amount [dB] by which sidebands that the part does not make may exceed those it makes."""

SIDEBAND_REACH = 10.0
"""Depth [dB] below the lines down to which the sidebands of a load zone lie: the squared
envelope of impacts that swing by a third of their mean has them there."""

SIDEBAND_CHANCE = 0.01
"""Probability with which noise reaches the level at which sidebands are there as probably as not:
one in a hundred, as the band is chosen by the lines and not by these."""

SIDEBAND_SCALE = 0.77
"""Scale [dB] on which that probability falls by e in a single spectrum: at a line of noise it is
1 % at 6.6 dB and 0.1 % at 8.4 dB. The scatter of noise falls with the root of the averages."""

SIDEBAND_EXCESS = 2.5
"""Amount [dB] by which a comb at a sideband may be above the lines that it follows from."""

BALL_MARGIN = 3.0
"""Lead [dB] of a ball's comb over those of the races that lets it count as the ball's."""

WEAK_SIDEBANDS = 14.0
"""Depth [dB] below the lines: cage sidebands of a race's line are fainter, a ball's are not."""

SLOWER, FAINTER = (2, 3), 0.7
"""Parts of a comb's frequency at which it may be seen too, and how much fainter the lines between
its own are then."""

GAPS = 0.25
"""Share of a comb's height that the lines in between reach where they belong to that comb."""

ALIKE = 7.0
"""Amount [dB] by which lines of a second damaged race may be below those of the first. Of 51
measured records whose race was named rightly the other race comes to at most 15 %."""

FOREIGN = (0.2, 0.95)
"""Turns of the shaft between which sidebands of another shaft are looked for: lines of an outer
race that are an inner race's or a ball's of a slower shaft have theirs there. Above it, real outer
races have sidebands of the load zone that mix shaft and cage."""

FOREIGN_LEAD = 2.0
"""Lead [dB] over sidebands of another shaft at which half of such lines are an outer race's. All 29
measured outer races are 7.8 dB or more above the strongest; lines of inner races of a slower
shaft are about as strong as their sidebands."""

SELDOM, SLIPS = 0.26, 0.25
"""Damaged balls for each damaged race (15 and 57 of the records measured), and the share of the
slip by which e times fewer races are off: beyond the slip are 2 %. See `_race_or_ball`."""

CARRIED_REACH = 15.0
"""Depth [dB] below a ball's lines down to which the cage's sidebands are expected: a load zone of
half a turn makes the first three of each side 5 to 8 dB fainter than the line, on average."""

MOST_BANDS = 12
"""Bands of a resolution, the loudest at a part's line, in which its lead is looked for."""


@dataclass(frozen=True)
class Judged:
    """The evidence of each part, and what else is in the signal.

    Attributes
    ----------
    shaft
        turns a second [Hz].
    evidence
        of outer race, inner race and ball.
    other
        the strongest lines that are none of the bearing's.
    other_above_noise, other_swing
        [dB] of these, and by how much they swing the envelope.
    detectable
        the least swing of the envelope, as a share of its mean, that would have been seen.
    resolutions
        resolutions that the evidence rests on.
    """

    shaft: float
    evidence: tuple[PartEvidence, ...]
    other: OtherLines
    other_above_noise: float
    other_swing: float
    detectable: float
    resolutions: tuple[Combs, ...]

    @property
    def leading(self) -> PartEvidence:
        """Evidence of the part that leads."""
        return max(self.evidence, key=leading_by)

    def counting(self, share: float) -> Judged:
        """Judge anew with a share of each swing."""
        counted = [replace(part, swing=share * part.swing) for part in self.evidence]
        return replace(self, evidence=_weighed(counted))

    def discounted(self, speeds: float) -> Judged:
        """Judge anew where several `speeds` were open: another source fits one more often.

        The odds that lines are those of the bearing fall by that number.
        """
        tried = (
            replace(
                part, probability=part.probability / (speeds + (1.0 - speeds) * part.probability)
            )
            for part in self.evidence
        )
        return replace(self, evidence=tuple(tried))


def judge(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    stated: float | None = None,
) -> Judged:
    """The evidence of the parts at a speed [Hz]."""
    return compare(listened(signal, parts, shaft, slip, True, stated), parts, slip, stated)


def listened(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    known_speed: bool,
    stated: float | None = None,
) -> tuple[Combs, ...]:
    """The combs at all resolutions, the coarsest first."""
    top = max(lines.order for lines in parts) * (1.0 + slip)
    envelopes = signal.envelopes(shaft, (HARMONICS * top + 2.0) * shaft)
    resolutions: list[Combs] = []
    for turns in TURNS:
        resolutions.append(listen(envelopes, parts, shaft, known_speed, slip, turns, stated))
        if turns / shaft >= signal.duration:
            break  # longer segments than the signal are the same again
    return tuple(resolutions)


def compare(
    resolutions: tuple[Combs, ...],
    parts: Sequence[PartLines],
    slip: float,
    stated: float | None = None,
) -> Judged:
    """The evidence of the parts in combs at all resolutions."""
    shaft = resolutions[0].shaft
    compared = [_Comparison(combs, parts, slip, stated or shaft) for combs in resolutions]
    first, ball = compared[0], compared[0].lines_of(BALL)
    spinning, deviations = spin(first.combs, parts, lambda at: first.explained(at, ball))
    if _carried(compared, spinning) < 0.0:
        deviations[BALL] = min(deviations[BALL], 0.0)
    evidence = []
    for lines in parts:
        if lines.part == BALL:
            best = _clearest(compared, lines, spinning)
            carried = _carried(compared, best.frequency)
            best = replace(
                best, lead=min(best.lead, carried), modulation=min(best.modulation, carried)
            )
        else:
            best = _race(compared, lines)
        evidence.append(replace(best, deviations=deviations[lines.part]))
    other, above, swing = max(
        (comparison.others(evidence) for comparison in compared), key=lambda rival: rival[1]
    )
    return Judged(
        shaft=shaft,
        evidence=_judge_other_race(compared, _weighed(evidence)),
        other=other,
        other_above_noise=above,
        other_swing=swing,
        detectable=min(_detectable(combs) for combs in resolutions),
        resolutions=resolutions,
    )


def _clearest(
    compared: Sequence[_Comparison],
    lines: PartLines,
    around: float | None = None,
    beside: PartEvidence | None = None,
) -> PartEvidence:
    """The evidence of a part at the resolution that speaks most for it."""
    # the band is chosen by the lines alone: chosen by the sidebands, it is where noise has some
    best = max((c.clearest(lines, around, beside) for c in compared), key=log_probability)
    return max((comparison.weigh_sidebands(best) for comparison in compared), key=log_probability)


def _race(
    compared: Sequence[_Comparison], lines: PartLines, beside: PartEvidence | None = None
) -> PartEvidence:
    """The evidence of a race; `beside` another race that is damaged, which is no rival then."""
    best = _clearest(compared, lines, beside=beside)
    source = compared[-1].lead_over_source(best.frequency)
    best = replace(best, lead=min(best.lead, source), line_lead=min(best.line_lead, source))
    if lines.part == INNER:
        return best
    # short segments do not resolve what lies beside the cage's lines
    foreign, spacing = min(c.lead_over_foreign(best) for c in compared[1:] or compared)
    spacing = spacing if foreign < LEAD else math.nan
    return replace(best, lead=min(best.lead, foreign), foreign_spacing=spacing)


def _judge_other_race(
    compared: Sequence[_Comparison], evidence: tuple[PartEvidence, ...]
) -> tuple[PartEvidence, ...]:
    """The evidence, where one race is damaged with the other judged as damaged beside it.

    Both races wear together often. The lines of the first, which are louder, are then no reason
    against a second whose lines are about as loud. It is no more probable than the first.
    """
    first = max(evidence, key=leading_by)
    if first.part == BALL or first.probability < BESIDE:
        return evidence
    lines = next(part for part in compared[0].parts if part.part not in (first.part, BALL))
    second = _race(compared, lines, first)
    second = replace(second, lead=min(second.lead, first.lead))
    told = _weighed(second if part.part == second.part else part for part in evidence)
    return tuple(replace(p, probability=min(p.probability, first.probability)) for p in told)


def _weighed(evidence: Iterable[PartEvidence]) -> tuple[PartEvidence, ...]:
    """The evidence with the probabilities that follow."""
    parts = tuple(evidence)
    told = probabilities(parts, CALIBRATION)
    return tuple(replace(part, probability=told[part.part]) for part in parts)


def _detectable(combs: Combs) -> float:
    """The least swing of the envelope in the widest band that would have been seen."""
    widest = max(combs.envelopes, key=lambda envelope: envelope.band.high - envelope.band.low)
    needed = 10.0 ** (0.1 * (combs.noise + NOISE_MARGIN)) - 1.0
    return float(np.median(widest.levels.floor)) * math.sqrt(max(needed, 0.0))


@dataclass(frozen=True)
class _Comparison:
    """The combs of one resolution against each other."""

    combs: Combs
    parts: Sequence[PartLines]
    slip: float
    stated: float

    @property
    def cage(self) -> float:
        """Turns of the cage a second [Hz]."""
        return self.combs.shaft * self.lines_of(BALL).sidebands

    def lines_of(self, part: str) -> PartLines:
        """The lines of a part, by its name."""
        return next(lines for lines in self.parts if lines.part == part)

    def clearest(
        self, lines: PartLines, around: float | None, beside: PartEvidence | None
    ) -> PartEvidence:
        """The lines of a part in the band that speaks most for it, perhaps around a place [Hz].

        `beside` is a race that is damaged too: what follows from its lines, and these themselves,
        are no rivals.
        """
        combs = self.combs
        near_it = mark_window(combs, lines, self.slip, self.stated)
        if around is not None:  # a race's own lines are none of a ball's
            near_it |= np.abs(combs.frequency - around) <= combs.shaft / TURNS[0]
            near_it &= ~self._windows_of(OUTER, INNER)
            near_it[np.abs(combs.frequency - around).argmin()] = True
        inside = np.flatnonzero(near_it)
        level = combs.level[:, inside]
        if lines.part == BALL:
            at, away = combs.frequency[inside], self.cage
            level = np.stack([comb_level(_or_sidebands(e, at, away)) for e in combs.envelopes])
        explained: dict[float, NDArray[np.float64]] = {}
        directions = []
        for place in np.argsort(-level.max(axis=1))[:MOST_BANDS].tolist():
            frequency = float(combs.frequency[inside[level[place].argmax()]])
            if frequency not in explained:
                explained[frequency] = self.explained(frequency, lines)
                if beside is not None:
                    also = self.explained(beside.frequency, self.lines_of(beside.part))
                    explained[frequency] = np.maximum(explained[frequency], also)
            others = float((combs.level[place] - explained[frequency]).max())
            evidence = self._evidence(lines, combs.envelopes[place], frequency, others)
            directions.append(self._limit_to_rivals(evidence, 0.0 if beside is None else ALIKE))
        return max(directions, key=log_probability)

    def explained(self, frequency: float, lines: PartLines) -> NDArray[np.float64]:
        """Return how much higher [dB] combs (n,) may be because they follow from a part's lines.

        Infinity for multiples of its frequency [Hz] and for what another part may have.
        """
        # a ball's spin itself is half its line
        firsts = (1.0, 0.5) if lines.part == BALL else (1.0,)
        factors = (1.0, 2.0, 3.0, 0.5, 1.5) if lines.part == BALL else (1.0, 2.0, 3.0)
        free = mark_near(self.combs, (factor * frequency for factor in factors))
        free |= self._windows_of(*PARTS) | self._slower(frequency)
        sidebands = (
            abs(first * frequency + order * spacing)
            for first in firsts
            for spacing in (self.combs.shaft, self.cage)
            for order in (-3, -2, -1, 1, 2, 3)
        )
        follows = mark_near(self.combs, sidebands)
        return np.where(free, np.inf, np.where(follows, SIDEBAND_EXCESS, 0.0))

    def _windows_of(self, *names: str) -> NDArray[np.bool_]:
        """Mark the combs (n,) that some parts may have."""
        combs, slip = self.combs, self.slip + 0.005
        windows = [mark_window(combs, self.lines_of(name), slip, self.stated) for name in names]
        return np.asarray(np.any(windows, axis=0))

    def _slower(self, frequency: float) -> NDArray[np.bool_]:
        """Mark the combs (n,) of a frequency [Hz] that are seen at a half or a third of it.

        A motion may repeat every second or third knock only, and then lines are between the knocks'
        own; they are the fainter ones. Of a source that itself knocks that seldom all are alike.
        """
        combs = self.combs
        slower = np.zeros(len(combs.frequency), dtype=bool)
        for part in SLOWER:
            near_it = np.flatnonzero(mark_near(combs, (frequency / part,)))
            if not len(near_it):
                continue
            column = int(near_it[combs.level[:, near_it].max(axis=0).argmax()])
            loudest = combs.envelopes[int(combs.level[:, column].argmax())]
            at = np.array([combs.frequency[column]])
            count = part * (HARMONICS // part)
            depth = lines_at(loudest.levels.depth, loudest.levels.step, at, count)[:, 0]
            shared = np.arange(1, len(depth) + 1) % part == 0
            if depth[~shared].mean() < FAINTER * depth[shared].mean():
                slower[near_it] = True
        return slower

    def _limit_to_rivals(self, part: PartEvidence, margin: float) -> PartEvidence:
        """The evidence, its lead no more than the [dB] by which a part's comb is above the races'.

        A race has the lines of one that is its multiple for free, and sidebands decide where both
        have the same. A damaged ball marks races, so its lines are no rivals of theirs, see
        `probabilities`; its own must be clearly stronger, as races have sidebands and halves of
        their lines where a ball's may be.
        """
        ball = part.part == BALL
        same = part.frequency * np.array([1.0] if ball else [1.0, 2.0, 3.0])
        above = [
            part.level - level - (BALL_MARGIN if ball else 0.0)
            for lines, (frequency, level) in self.combs.best.items()
            if lines.part not in (part.part, BALL)
            and not (np.abs(frequency - same) <= tolerance(self.combs, same)).any()
        ]
        lead = min([part.lead, *(level + margin for level in above)])
        return replace(part, lead=lead, line_lead=lead)

    def weigh_sidebands(self, part: PartEvidence) -> PartEvidence:
        """The evidence with what its sidebands say: those that the part's own turning makes.

        An outer race stands still and needs none. Where a line may be a race's or a ball's, cage
        sidebands speak for the ball.
        """
        combs = self.combs
        envelope = combs.envelope_of(part)
        level = float(comb_level(_lines(envelope, envelope.cleared, part.frequency)[:, None])[0])

        def sides(spacing: float) -> float:
            lines = [
                _lines(envelope, envelope.cleared, part.frequency, away)[: HARMONICS // 2]
                for away in (-spacing, spacing)
            ]
            return float(comb_level(np.concatenate(lines)[:, None])[0])

        shaft, cage = sides(combs.shaft), sides(self.cage)
        above = modulation = math.inf
        if part.part in (INNER, BALL):
            turning, other = (shaft, cage) if part.part == INNER else (cage, shaft)
            averages = envelope.levels.averages
            modulation = turning - _sidebands_of_noise(level, averages)
            modulation *= math.sqrt(averages) / SIDEBAND_SCALE
            above = turning - other + SIDEBAND_LEAD + SIDEBAND_MARGIN
        place = int(np.abs(combs.frequency - part.frequency).argmin())
        race = max(level - WEAK_SIDEBANDS, shaft - SIDEBAND_LEAD) - cage
        if part.part != BALL and may_be(part.frequency, self.lines_of(BALL).order * combs.shaft):
            above = min(above, race, LEAD + LEAD_SCALE * _race_or_ball(part.slip, self.slip))
        if part.part == BALL and self._windows_of(OUTER, INNER)[place]:
            above = min(above, -race)
        return replace(part, modulation=modulation, lead=min(part.lead, above, modulation + LEAD))

    def lead_over_foreign(self, part: PartEvidence) -> tuple[float, float]:
        """Lead [dB] of an outer race's lines over sidebands of another shaft; their spacing [Hz].

        An outer race stands still: only this shaft and its cage change the size of its blows.
        Sidebands at another distance on both sides of its lines mean that the lines are those of a
        part that turns with another shaft, or at another speed than the one stated. Infinity where
        noise reaches as far.
        """
        combs = self.combs
        envelope = combs.envelope_of(part)
        resolution = (combs.frequency[1] - combs.frequency[0]) * FINENESS
        low, high = (turns * combs.shaft for turns in FOREIGN)
        spacing = np.arange(low, high, resolution / FINENESS)
        # a coarse resolution may show the lines a little beside their place
        near_it = np.abs(combs.frequency - part.frequency) <= 0.5 * combs.shaft / TURNS[0]
        row = next(k for k, other in enumerate(combs.envelopes) if other is envelope)
        levels = np.where(near_it, combs.level[row], -np.inf)
        place = int(levels.argmax())
        frequency = float(combs.frequency[place])
        lines = frequency * np.arange(1, HARMONICS // 2 + 1)
        sides = [
            [lines_at(envelope.cleared, envelope.levels.step, np.abs(line + away), 1)[0]
             for away in (-spacing, spacing)]
            for line in lines.tolist()
        ]  # fmt: skip
        level = np.min(sides, axis=1).mean(axis=0)  # both sidebands of a line, or none
        made = [k * self.cage for k in (1, 2)] + [k * combs.shaft for k in (0.5, 1.0)]
        made += [frequency / k for k in (2, 3, 4)]  # halves of the lines lie between them
        for known in made:
            level[np.abs(spacing - known) <= 1.5 * resolution + 0.005 * known] = -np.inf
        best = int(level.argmax())
        if level[best] < noise_level(RARE / len(spacing), envelope.levels.averages):
            return math.inf, math.nan
        return float(levels[place] - level[best]) - FOREIGN_LEAD + LEAD, float(spacing[best])

    def carried(self, around: float) -> float:
        """Return by how much [dB] lines around a frequency [Hz] have a ball's kind of sidebands.

        The cage carries a ball through the load zone: its sidebands are above those of the shaft,
        which the inner race of another bearing has, and not far below the lines themselves.
        Infinity where no lines are clear: those of a ball that slips are broad, and show nothing
        of their sidebands.
        """
        combs = self.combs
        place, column = self._loudest(around)
        envelope, frequency = combs.envelopes[place], float(combs.frequency[column])
        level = float(combs.level[place, column])
        if self.clearness(around) < NOISE_MARGIN:
            return math.inf
        seen = np.where(envelope.hidden, np.nan, envelope.cleared)

        def mean(spacing: float) -> float:
            sides = np.array([
                _lines(envelope, seen, frequency, order * spacing)[: HARMONICS // 2]
                for order in (-3, -2, -1, 1, 2, 3)
            ])  # fmt: skip
            return float(np.nanmean(sides)) if np.isfinite(sides).any() else math.nan

        shaft, cage = mean(combs.shaft), mean(self.cage)
        if math.isnan(shaft + cage):  # lines of the shaft hide them
            return -math.inf
        noise = noise_level(SIDEBAND_CHANCE, envelope.levels.averages)
        return min(cage - shaft, cage - level + CARRIED_REACH, cage - noise)

    def lead_over_source(self, frequency: float) -> float:
        """Return by how much [dB] lines of a race are too loud to be sidebands of others.

        In whatever band shows them best, lines that are whole turns of the shaft away are at most a
        little louder; where they are more, they are the race of another bearing, with its sidebands
        where this one has its lines.
        """
        combs = self.combs
        sources = mark_near(
            combs, (abs(frequency + k * combs.shaft) for k in (-3, -2, -1, 1, 2, 3))
        )
        sources &= ~mark_near(combs, (frequency * factor for factor in (0.5, 1.0, 1.5, 2.0, 3.0)))
        if not sources.any():
            return math.inf
        level = float(combs.level[self._loudest(frequency)])
        return level - float(combs.level[:, sources].max()) + SIDEBAND_EXCESS

    def clearness(self, around: float) -> float:
        """Level [dB] of the loudest comb around a frequency [Hz] above noise."""
        return float(self.combs.level[self._loudest(around)]) - self.combs.noise

    def _loudest(self, around: float) -> tuple[int, int]:
        """Band and column of the loudest comb around a frequency [Hz]."""
        level = np.where(
            np.abs(self.combs.frequency - around) <= self.combs.shaft / TURNS[0],
            self.combs.level,
            -np.inf,
        )
        place, column = np.unravel_index(int(level.argmax()), level.shape)
        return int(place), int(column)

    def _evidence(
        self, lines: PartLines, envelope: Listened, frequency: float, others: float
    ) -> PartEvidence:
        combs = self.combs
        spacing = self.cage if lines.part == BALL else combs.shaft
        gaps = math.inf
        if lines.part == BALL:
            levels = _or_sidebands(envelope, np.array([frequency]), spacing)[:, 0]
        else:
            levels = _lines(envelope, envelope.cleared, frequency)
            gaps = _lead_over_gaps(_lines(envelope, envelope.levels.depth, frequency))
        depth = np.where(envelope.hidden, 0.0, envelope.levels.depth)
        sides = -spacing, spacing
        swings = [_lines(envelope, depth, frequency, away) for away in (0.0, *sides)]
        sidebands = [_lines(envelope, envelope.cleared, frequency, away) for away in sides]
        nominal = lines.order * combs.shaft
        level = float(comb_level(levels[:, None])[0])
        lead = min(level - max(others, combs.noise), gaps)
        return PartEvidence(
            part=lines.part,
            nominal_frequency=nominal,
            nominal_order=lines.order,
            frequency=frequency,
            order=frequency / combs.shaft,
            slip=frequency / nominal - 1.0,
            harmonics=levels,
            level=level,
            noise=combs.noise,
            lead=lead,
            line_lead=lead,
            depth=_trimmed_mean(swings[0]),
            swing=_trimmed_mean(np.sqrt(np.square(swings).sum(axis=0))),
            # the highest line of a comb resolves the most
            magnetic=magnetic_share(frequency, tolerance(combs, 0.0).item() / HARMONICS, self.slip),
            sidebands=np.stack(sidebands, axis=1),
            sideband_spacing=spacing,
            sideband_source="cage" if lines.part == BALL else "shaft",
            band=envelope.band,
            direction=envelope.direction,
            kurtosis=envelope.kurtosis,
        )

    def others(self, evidence: Sequence[PartEvidence]) -> tuple[OtherLines, float, float]:
        """The strongest comb of no part, how far above noise it is [dB], and its swing."""
        combs = self.combs
        explained = np.where(self._windows_of(*PARTS), np.inf, 0.0)
        for lines, part in zip(self.parts, evidence, strict=True):
            if part.level > part.noise:
                explained = np.maximum(explained, self.explained(part.frequency, lines))
        level = np.where(explained > 0.0, -np.inf, combs.level)
        place, column = np.unravel_index(int(level.argmax()), level.shape)
        frequency, envelope = float(combs.frequency[column]), combs.envelopes[int(place)]
        depths = _lines(envelope, envelope.levels.depth, frequency)
        rival = OtherLines(frequency, frequency / combs.shaft, float(level[place, column]))
        return rival, rival.level - combs.noise, _trimmed_mean(depths)


def _carried(compared: Iterable[_Comparison], frequency: float) -> float:
    """`carried` at the resolution that shows the lines around a frequency [Hz] best."""
    return max(compared, key=lambda comparison: comparison.clearness(frequency)).carried(frequency)


def _lines(
    envelope: Listened, values: NDArray[np.float64], frequency: float, away: float = 0.0
) -> NDArray[np.float64]:
    """Values [dB] or shares at some distance [Hz] from the harmonics of a frequency."""
    return lines_at(values, envelope.levels.step, np.array([frequency]), away=away)[:, 0]


def _sidebands_of_noise(level: float, averages: float) -> float:
    """The level [dB] at which sidebands of lines of a level [dB] are no longer chance.

    Noise that the lines hardly stand out of has other chances at each of the sidebands. Beside loud
    lines it is the noise at the impacts that counts, which changes their sizes and so has the same
    chance at all sidebands at once; there they need be no higher than a load zone makes them.
    """
    from scipy.special import gammainccinv  # imported late: see `spectrum`

    apart = noise_level(SIDEBAND_CHANCE, averages)
    together = 10.0 * math.log10(float(gammainccinv(averages, SIDEBAND_CHANCE)) / averages)
    return max(apart, min(together, level - SIDEBAND_REACH))


def _race_or_ball(away: float, slip: float) -> float:
    """Logarithm of the odds that lines which may be either's are a race's, not a ball's.

    Bayes' rule: those of a race are the rarer the farther they are `away` from rolling, as a
    fraction; those of a ball, which need not be carried through a load zone where the thrust is
    great, are anywhere in its window.
    """
    reach = SLIPS * slip
    race = math.exp(-abs(away) / reach) / (2.0 * reach)
    return math.log(race * (LAG + AHEAD) / SELDOM)


def _lead_over_gaps(depth: NDArray[np.float64]) -> float:
    """Level [dB] of lines (HARMONICS,) above the gaps between those of a multiple's comb.

    Blows show in their first line; beats of tones, as of an inverter, at twice or three times it
    are lines that leave others out.
    """
    number = np.arange(1, len(depth) + 1)
    above = [
        max(float(depth[number % part != 0].mean()), 1e-9)
        / max(float(depth[number % part == 0].mean()), 1e-9)
        for part in SLOWER
    ]
    return 20.0 * math.log10(min(above) / GAPS)


def _or_sidebands(
    envelope: Listened, frequency: NDArray[np.float64], spacing: float
) -> NDArray[np.float64]:
    """Lines of a ball (HARMONICS, n): each itself, or its two sidebands if both are louder.

    A line may lie on one of the shaft, or be fainter than what the cage makes of it.
    """
    line, below, above = (
        lines_at(envelope.cleared, envelope.levels.step, frequency, away=away)
        for away in (0.0, -spacing, spacing)
    )
    return np.maximum(line, np.minimum(below, above))


def _trimmed_mean(values: NDArray[np.float64]) -> float:
    """Mean of all values but the greatest: no single line decides."""
    return float(np.sort(values)[:-1].mean())
