"""Evidence of each part in all bands and at all resolutions, and the probability of its damage.

A comb of lines at a race's frequency is judged in the band that shows it best, by two numbers:

- its lead: the height above noise, above every other comb in that band except those that follow
  from it (multiples, sidebands), and above the other race's comb; on a part that turns, also the
  height of its sidebands. It shows if the race's lines are in the signal at all.
- its swing: the swing of the envelope at the lines and first sidebands. Balls of a healthy bearing,
  and marks that a damaged ball has pressed into a race, also make faint lines; a race that every
  ball strikes makes strong ones.

The axes of balls wander and balls slip, so their lines are broad: see `spin`.
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
    rank,
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
    BandLines,
    Combs,
    listen,
    mark_near,
    mark_window,
    tolerance,
)
from bearingcore.measured.diagnosis._part.spin import AHEAD, LAG, find_spin, may_be_ball

NOISE_MARGIN = 2.0
"""Distance [dB] of clear lines from the level that noise reaches in one of a thousand signals."""

SIDEBAND_MARGIN = 2.0
"""Amount [dB] by which sidebands may fall short before the lead becomes negative."""

SIDEBAND_LEAD = 6.0
"""Amount [dB] by which sidebands that the part does not make may exceed those it makes."""

SIDEBAND_REACH = 10.0
"""Greatest depth [dB] of the sidebands of a load zone below the lines: that of impacts whose
squared envelope swings by a third of its mean."""

SIDEBAND_CHANCE = 0.01
"""Probability that noise reaches the level at which sidebands are as likely there as not: one in a
hundred, because the band is chosen by the lines and not by the sidebands."""

SIDEBAND_SCALE = 0.77
"""Scale [dB] over which that probability falls by a factor e in one spectrum: a line of noise
has 1 % at 6.6 dB and 0.1 % at 8.4 dB. The scatter of noise falls with the root of the averages."""

SIDEBAND_EXCESS = 2.5
"""Greatest height [dB] of a comb at a sideband above the lines that it follows from."""

BALL_MARGIN = 3.0
"""Least lead [dB] over the combs of the races with which a comb counts as a ball's."""

WEAK_SIDEBANDS = 14.0
"""Depth [dB] below the lines: cage sidebands of a race are fainter, those of a ball are not."""

SLOWER, FAINTER = (2, 3), 0.7
"""Divisors of a comb's frequency at which the comb may also show, and the greatest height of the
lines in between, relative to its own, if it does."""

GAPS = 0.25
"""Least height of the lines in between that belong to a comb, relative to its own."""

ALIKE = 7.0
"""Amount [dB] by which lines of a second damaged race may be below those of the first. In 51
measured records with a rightly named race, the other race has a probability of at most 15 %."""

FOREIGN = (0.2, 0.95)
"""Range, in turns of the shaft, in which sidebands of another shaft are searched. Lines of an inner
race or a ball on a slower shaft, which look like those of an outer race, have theirs there. Above,
real outer races have sidebands of the load zone that mix shaft and cage."""

FOREIGN_LEAD = 2.0
"""Lead [dB] over sidebands of another shaft at which half of such lines are an outer race's. All 29
measured outer races are 7.8 dB or more above the strongest sideband; lines of inner races of a
slower shaft are about as strong as their sidebands."""

SELDOM, SLIPS = 0.26, 0.25
"""Damaged balls for each damaged race (15 and 57 of the measured records), and the share of the
slip over which the number of races falls by a factor e: 2 % slip more. See `_race_or_ball`."""

CAGE_REACH = 15.0
"""Greatest depth [dB] below a ball's lines at which the cage's sidebands are expected: a load zone
of half a turn makes the first three on each side 5 to 8 dB fainter than the line, on average."""

MOST_BANDS = 12
"""Number of bands of a resolution, the loudest at a part's line, in which its lead is computed."""


@dataclass(frozen=True)
class Judged:
    """The evidence of each part, and the other lines in the signal.

    Attributes
    ----------
    shaft
        turns a second [Hz].
    evidence
        evidence of outer race, inner race and ball.
    other
        the strongest lines that do not belong to the bearing.
    other_above_noise, other_swing
        height [dB] of these lines above noise, and their swing of the envelope.
    detectable
        the least detectable swing of the envelope, relative to its mean.
    resolutions
        the combs at all resolutions on which the evidence rests.
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
        return max(self.evidence, key=rank)

    def scale_swings(self, factor: float) -> Judged:
        """Return the evidence with each swing times a factor."""
        scaled = [replace(part, swing=factor * part.swing) for part in self.evidence]
        return replace(self, evidence=_with_probabilities(scaled))

    def divide_odds(self, speeds: float) -> Judged:
        """Return the evidence with odds divided by the number of possible `speeds`.

        With more possible speeds, lines of another source fit one of them more often.
        """
        divided = (
            replace(
                part, probability=part.probability / (speeds + (1.0 - speeds) * part.probability)
            )
            for part in self.evidence
        )
        return replace(self, evidence=tuple(divided))


def judge(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    stated: float | None = None,
) -> Judged:
    """Return the evidence of the parts at a speed [Hz]."""
    return compare(all_combs(signal, parts, shaft, slip, True, stated), parts, slip, stated)


def all_combs(
    signal: ListenedSignal,
    parts: Sequence[PartLines],
    shaft: float,
    slip: float,
    known_speed: bool,
    stated: float | None = None,
) -> tuple[Combs, ...]:
    """Compute the combs at all resolutions, the coarsest first."""
    top = max(lines.order for lines in parts) * (1.0 + slip)
    envelopes = signal.envelopes(shaft, (HARMONICS * top + 2.0) * shaft)
    resolutions: list[Combs] = []
    for turns in TURNS:
        resolutions.append(listen(envelopes, parts, shaft, known_speed, slip, turns, stated))
        if turns / shaft >= signal.duration:
            break  # longer segments would be the whole signal again
    return tuple(resolutions)


def compare(
    resolutions: tuple[Combs, ...],
    parts: Sequence[PartLines],
    slip: float,
    stated: float | None = None,
) -> Judged:
    """Return the evidence of the parts in combs at all resolutions."""
    shaft = resolutions[0].shaft
    compared = [_Comparison(combs, parts, slip, stated or shaft) for combs in resolutions]
    first, ball = compared[0], compared[0].lines_of(BALL)
    # where a ball's broad lines are, in the short segments of the first resolution
    spin, deviations = find_spin(first.combs, parts, lambda hz: first.explained(hz, ball))
    if _cage_lead(compared, spin) < 0.0:
        deviations[BALL] = min(deviations[BALL], 0.0)
    evidence = []
    for lines in parts:
        if lines.part == BALL:
            best = _clearest(compared, lines, spin)
            lead = _cage_lead(compared, best.frequency)
            best = replace(best, lead=min(best.lead, lead), modulation=min(best.modulation, lead))
        else:
            best = _race_evidence(compared, lines)
        evidence.append(replace(best, deviations=deviations[lines.part]))
    other, above, swing = max(
        (comparison.others(evidence) for comparison in compared), key=lambda rival: rival[1]
    )
    return Judged(
        shaft=shaft,
        evidence=_judge_other_race(compared, _with_probabilities(evidence)),
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
    """Return the evidence of a part at the resolution that makes it most probable."""
    # the lines alone choose the band: sidebands would choose one where noise looks like them
    best = max((c.clearest(lines, around, beside) for c in compared), key=log_probability)
    return max((comparison.weigh_sidebands(best) for comparison in compared), key=log_probability)


def _race_evidence(
    compared: Sequence[_Comparison], lines: PartLines, beside: PartEvidence | None = None
) -> PartEvidence:
    """Return the evidence of a race; `beside` is a damaged other race, which is no rival."""
    best = _clearest(compared, lines, beside=beside)
    source = compared[-1].lead_over_source(best.frequency)
    best = replace(best, lead=min(best.lead, source), line_lead=min(best.line_lead, source))
    if lines.part == INNER:
        return best
    # short segments do not separate foreign sidebands from those of the cage
    foreign, spacing = min(c.lead_over_foreign(best) for c in compared[1:] or compared)
    spacing = spacing if foreign < LEAD else math.nan
    return replace(best, lead=min(best.lead, foreign), foreign_spacing=spacing)


def _judge_other_race(
    compared: Sequence[_Comparison], evidence: tuple[PartEvidence, ...]
) -> tuple[PartEvidence, ...]:
    """If one race is damaged, judge the other one again without the first as a rival.

    Both races often wear together. The louder lines of the first race are then no reason against a
    second whose lines are about as loud. The second is no more probable than the first.
    """
    first = max(evidence, key=rank)
    if first.part == BALL or first.probability < BESIDE:
        return evidence
    lines = next(part for part in compared[0].parts if part.part not in (first.part, BALL))
    second = _race_evidence(compared, lines, first)
    second = replace(second, lead=min(second.lead, first.lead))
    parts = _with_probabilities(second if p.part == second.part else p for p in evidence)
    return tuple(replace(p, probability=min(p.probability, first.probability)) for p in parts)


def _with_probabilities(evidence: Iterable[PartEvidence]) -> tuple[PartEvidence, ...]:
    """Return the evidence with the probabilities that follow from it."""
    parts = tuple(evidence)
    chances = probabilities(parts, CALIBRATION)
    return tuple(replace(part, probability=chances[part.part]) for part in parts)


def _detectable(combs: Combs) -> float:
    """Return the least detectable swing of the envelope in the widest band."""
    widest = max(combs.envelopes, key=lambda envelope: envelope.band.high - envelope.band.low)
    needed = 10.0 ** (0.1 * (combs.noise + NOISE_MARGIN)) - 1.0
    return float(np.median(widest.levels.floor)) * math.sqrt(max(needed, 0.0))


@dataclass(frozen=True)
class _Comparison:
    """Comparison of the combs of one resolution with each other."""

    combs: Combs
    parts: Sequence[PartLines]
    slip: float
    stated: float

    @property
    def cage(self) -> float:
        """Turns of the cage a second [Hz]."""
        return self.combs.shaft * self.lines_of(BALL).sidebands

    def lines_of(self, part: str) -> PartLines:
        """Return the lines of a part by its name."""
        return next(lines for lines in self.parts if lines.part == part)

    def clearest(
        self, lines: PartLines, around: float | None, beside: PartEvidence | None
    ) -> PartEvidence:
        """Return the lines of a part in the band that makes them most probable.

        `around` is the frequency [Hz] of a ball's broad lines. `beside` is a race that is damaged
        too: its lines, and combs that follow from them, are no rivals.
        """
        combs = self.combs
        window = mark_window(combs, lines, self.slip, self.stated)
        if around is not None:  # without the lines of races, which are not a ball's
            window |= np.abs(combs.frequency - around) <= combs.shaft / TURNS[0]
            window &= ~self._windows_of(OUTER, INNER)
            window[np.abs(combs.frequency - around).argmin()] = True
        inside = np.flatnonzero(window)
        level = combs.level[:, inside]
        if lines.part == BALL:
            at, away = combs.frequency[inside], self.cage
            level = np.stack([comb_level(_or_sidebands(e, at, away)) for e in combs.envelopes])
        # in each of the loudest bands, compare the highest comb with those that it does not explain
        explained: dict[float, NDArray[np.float64]] = {}
        candidates = []
        for place in np.argsort(-level.max(axis=1))[:MOST_BANDS].tolist():
            frequency = float(combs.frequency[inside[level[place].argmax()]])
            if frequency not in explained:
                explained[frequency] = self.explained(frequency, lines)
                if beside is not None:
                    also = self.explained(beside.frequency, self.lines_of(beside.part))
                    explained[frequency] = np.maximum(explained[frequency], also)
            others = float((combs.level[place] - explained[frequency]).max())
            evidence = self._evidence(lines, combs.envelopes[place], frequency, others)
            candidates.append(self._limit_to_rivals(evidence, 0.0 if beside is None else ALIKE))
        return max(candidates, key=log_probability)

    def explained(self, frequency: float, lines: PartLines) -> NDArray[np.float64]:
        """Return the heights [dB] by which combs (n,) that a part's lines explain may exceed them.

        They are infinite for multiples of its frequency [Hz] and in the windows of other parts.
        """
        # the spin frequency of a ball is half that of its line
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
        """Mark the combs (n,) in the windows of some parts."""
        combs, slip = self.combs, self.slip + 0.005
        windows = [mark_window(combs, self.lines_of(name), slip, self.stated) for name in names]
        return np.asarray(np.any(windows, axis=0))

    def _slower(self, frequency: float) -> NDArray[np.bool_]:
        """Mark the combs (n,) of a frequency [Hz] that show at a half or a third of it.

        A motion may repeat only every second or third knock. It then has fainter lines between
        those of the knocks. A source that itself knocks so seldom has equal lines.
        """
        combs = self.combs
        slower = np.zeros(len(combs.frequency), dtype=bool)
        for part in SLOWER:
            near = np.flatnonzero(mark_near(combs, (frequency / part,)))
            if not len(near):
                continue
            column = int(near[combs.level[:, near].max(axis=0).argmax()])
            loudest = combs.envelopes[int(combs.level[:, column].argmax())]
            loudest_line = np.array([combs.frequency[column]])
            count = part * (HARMONICS // part)
            depth = lines_at(loudest.levels.depth, loudest.levels.step, loudest_line, count)[:, 0]
            shared = np.arange(1, len(depth) + 1) % part == 0
            if depth[~shared].mean() < FAINTER * depth[shared].mean():
                slower[near] = True
        return slower

    def _limit_to_rivals(self, part: PartEvidence, margin: float) -> PartEvidence:
        """Limit the lead of a part to the height [dB] of its comb above those of the races.

        Races at the same frequency or at a multiple are no rivals: where both have the same lines,
        sidebands decide. A damaged ball marks races, so its lines are no rivals of theirs, see
        `probabilities`. A ball's own lines must be clearly stronger, because sidebands and halves
        of a race's lines may be at the same places.
        """
        is_ball = part.part == BALL
        same = part.frequency * np.array([1.0] if is_ball else [1.0, 2.0, 3.0])
        above = [
            part.level - level - (BALL_MARGIN if is_ball else 0.0)
            for lines, (frequency, level) in self.combs.best.items()
            if lines.part not in (part.part, BALL)
            and not (np.abs(frequency - same) <= tolerance(self.combs, same)).any()
        ]
        lead = min([part.lead, *(level + margin for level in above)])
        return replace(part, lead=lead, line_lead=lead)

    def weigh_sidebands(self, part: PartEvidence) -> PartEvidence:
        """Limit the lead by the sidebands that the part's own turning makes.

        An outer race stands still and needs none. If a line may belong to a race or a ball, cage
        sidebands are evidence for the ball.
        """
        combs = self.combs
        envelope = combs.envelope_of(part)
        level = float(comb_level(_lines(envelope, envelope.cleared, part.frequency)[:, None])[0])

        def sideband_level(spacing: float) -> float:
            lines = [
                _lines(envelope, envelope.cleared, part.frequency, away)[: HARMONICS // 2]
                for away in (-spacing, spacing)
            ]
            return float(comb_level(np.concatenate(lines)[:, None])[0])

        shaft, cage = sideband_level(combs.shaft), sideband_level(self.cage)
        above = modulation = math.inf
        if part.part in (INNER, BALL):
            turning, other = (shaft, cage) if part.part == INNER else (cage, shaft)
            averages = envelope.levels.averages
            modulation = turning - _sidebands_of_noise(level, averages)
            modulation *= math.sqrt(averages) / SIDEBAND_SCALE
            above = turning - other + SIDEBAND_LEAD + SIDEBAND_MARGIN
        # a line in the windows of a race and of a ball: cage sidebands decide
        place = int(np.abs(combs.frequency - part.frequency).argmin())
        as_race = max(level - WEAK_SIDEBANDS, shaft - SIDEBAND_LEAD) - cage
        ball = self.lines_of(BALL).order * combs.shaft
        if part.part != BALL and may_be_ball(part.frequency, ball):
            above = min(above, as_race, LEAD + LEAD_SCALE * _race_or_ball(part.slip, self.slip))
        if part.part == BALL and self._windows_of(OUTER, INNER)[place]:
            above = min(above, -as_race)
        return replace(part, modulation=modulation, lead=min(part.lead, above, modulation + LEAD))

    def lead_over_foreign(self, part: PartEvidence) -> tuple[float, float]:
        """Return the lead [dB] of an outer race over sidebands of another shaft; and their spacing.

        An outer race stands still: only this shaft and its cage change the size of its blows.
        Sidebands at another distance on both sides of its lines come from a part that turns with
        another shaft, or at another speed than the stated one. The lead is infinite if noise may
        make these sidebands.
        """
        combs = self.combs
        envelope = combs.envelope_of(part)
        resolution = (combs.frequency[1] - combs.frequency[0]) * FINENESS
        low, high = (turns * combs.shaft for turns in FOREIGN)
        spacing = np.arange(low, high, resolution / FINENESS)
        # a coarse resolution may show the lines slightly off their place
        near = np.abs(combs.frequency - part.frequency) <= 0.5 * combs.shaft / TURNS[0]
        row = next(k for k, other in enumerate(combs.envelopes) if other is envelope)
        levels = np.where(near, combs.level[row], -np.inf)
        place = int(levels.argmax())
        frequency = float(combs.frequency[place])
        lines = frequency * np.arange(1, HARMONICS // 2 + 1)
        sides = [
            [lines_at(envelope.cleared, envelope.levels.step, np.abs(line + away), 1)[0]
             for away in (-spacing, spacing)]
            for line in lines.tolist()
        ]  # fmt: skip
        level = np.min(sides, axis=1).mean(axis=0)  # both sidebands of a line must show
        # spacings of this bearing's own sidebands, and of parts of the lines
        known = [k * self.cage for k in (1, 2)] + [k * combs.shaft for k in (0.5, 1.0)]
        known += [frequency / k for k in (2, 3, 4)]
        for expected in known:
            level[np.abs(spacing - expected) <= 1.5 * resolution + 0.005 * expected] = -np.inf
        best = int(level.argmax())
        if level[best] < noise_level(RARE / len(spacing), envelope.levels.averages):
            return math.inf, math.nan
        return float(levels[place] - level[best]) - FOREIGN_LEAD + LEAD, float(spacing[best])

    def cage_lead(self, around: float) -> float:
        """Return the lead [dB] of cage sidebands of lines around a frequency [Hz].

        The cage carries a ball through the load zone. Its sidebands are therefore above those of
        the shaft, which the inner race of another bearing has, and not far below the lines. The
        lead is infinite without clear lines: broad lines of a ball that slips hide their sidebands.
        """
        combs = self.combs
        place, column = self._loudest(around)
        envelope, frequency = combs.envelopes[place], float(combs.frequency[column])
        level = float(combs.level[place, column])
        if self.clearness(around) < NOISE_MARGIN:
            return math.inf
        visible = np.where(envelope.hidden, np.nan, envelope.cleared)

        def mean_level(spacing: float) -> float:
            sides = np.array([
                _lines(envelope, visible, frequency, order * spacing)[: HARMONICS // 2]
                for order in (-3, -2, -1, 1, 2, 3)
            ])  # fmt: skip
            return float(np.nanmean(sides)) if np.isfinite(sides).any() else math.nan

        shaft, cage = mean_level(combs.shaft), mean_level(self.cage)
        if math.isnan(shaft + cage):  # lines of the shaft hide the sidebands
            return -math.inf
        noise = noise_level(SIDEBAND_CHANCE, envelope.levels.averages)
        return min(cage - shaft, cage - level + CAGE_REACH, cage - noise)

    def lead_over_source(self, frequency: float) -> float:
        """Return the lead [dB] of a race's lines over lines whose sidebands they may be.

        Lines whole turns of the shaft away are at most a little louder. Louder ones are those of a
        race of another bearing, whose sidebands are at the lines of this one.
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
        """Return the level [dB] above noise of the loudest comb around a frequency [Hz]."""
        return float(self.combs.level[self._loudest(around)]) - self.combs.noise

    def _loudest(self, around: float) -> tuple[int, int]:
        """Return band and column of the loudest comb around a frequency [Hz]."""
        level = np.where(
            np.abs(self.combs.frequency - around) <= self.combs.shaft / TURNS[0],
            self.combs.level,
            -np.inf,
        )
        place, column = np.unravel_index(int(level.argmax()), level.shape)
        return int(place), int(column)

    def _evidence(
        self, lines: PartLines, envelope: BandLines, frequency: float, others: float
    ) -> PartEvidence:
        """Return the evidence of lines at a frequency [Hz] in a band; `others` [dB] are rivals."""
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
            # the frequency is as exact as its highest harmonic gives it
            magnetic=magnetic_share(frequency, tolerance(combs, 0.0).item() / HARMONICS, self.slip),
            sidebands=np.stack(sidebands, axis=1),
            sideband_spacing=spacing,
            sideband_source="cage" if lines.part == BALL else "shaft",
            band=envelope.band,
            direction=envelope.direction,
            kurtosis=envelope.kurtosis,
        )

    def others(self, evidence: Sequence[PartEvidence]) -> tuple[OtherLines, float, float]:
        """Return the strongest comb of no part, its height [dB] above noise, and its swing."""
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


def _cage_lead(compared: Iterable[_Comparison], frequency: float) -> float:
    """Return `cage_lead` at the resolution that shows lines around a frequency [Hz] best."""
    clearest = max(compared, key=lambda comparison: comparison.clearness(frequency))
    return clearest.cage_lead(frequency)


def _lines(
    envelope: BandLines, values: NDArray[np.float64], frequency: float, away: float = 0.0
) -> NDArray[np.float64]:
    """Return levels [dB] or shares `away` [Hz] from the harmonics of a frequency [Hz]."""
    return lines_at(values, envelope.levels.step, np.array([frequency]), away=away)[:, 0]


def _sidebands_of_noise(level: float, averages: float) -> float:
    """Return the level [dB] at which sidebands of lines of a level [dB] are no longer chance.

    Beside faint lines, noise is independent at each of the sidebands. Beside loud lines, noise
    changes the sizes of the impacts, and so has the same chance at all sidebands at once; they need
    not be higher there than a load zone makes them.
    """
    from scipy.special import gammainccinv  # imported late: see `spectrum`

    independent = noise_level(SIDEBAND_CHANCE, averages)
    common = 10.0 * math.log10(float(gammainccinv(averages, SIDEBAND_CHANCE)) / averages)
    return max(independent, min(common, level - SIDEBAND_REACH))


def _race_or_ball(deviation: float, slip: float) -> float:
    """Return the logarithm of the odds that lines in both windows are a race's, not a ball's.

    Bayes' rule: lines of a race are rarer the larger their relative `deviation` from rolling. Lines
    of a ball are equally likely anywhere in its window; without cage sidebands, if a large thrust
    leaves no load zone.
    """
    reach = SLIPS * slip
    race = math.exp(-abs(deviation) / reach) / (2.0 * reach)
    return math.log(race * (LAG + AHEAD) / SELDOM)


def _lead_over_gaps(depth: NDArray[np.float64]) -> float:
    """Return the level [dB] of lines (HARMONICS,) between those of a comb at a multiple, over GAPS.

    Blows show in all lines. Beats of tones, such as those of an inverter, at twice or three times
    the frequency leave gaps between their lines.
    """
    number = np.arange(1, len(depth) + 1)
    above = [
        max(float(depth[number % part != 0].mean()), 1e-9)
        / max(float(depth[number % part == 0].mean()), 1e-9)
        for part in SLOWER
    ]
    return 20.0 * math.log10(min(above) / GAPS)


def _or_sidebands(
    envelope: BandLines, frequency: NDArray[np.float64], spacing: float
) -> NDArray[np.float64]:
    """Return the lines (HARMONICS, n) of a ball, or their sidebands where both are louder.

    A line may coincide with one of the shaft, or be fainter than its sidebands of the cage.
    """
    line, below, above = (
        lines_at(envelope.cleared, envelope.levels.step, frequency, away=away)
        for away in (0.0, -spacing, spacing)
    )
    return np.maximum(line, np.minimum(below, above))


def _trimmed_mean(values: NDArray[np.float64]) -> float:
    """Return the mean of all values but the greatest, so that no single line decides."""
    return float(np.sort(values)[:-1].mean())
