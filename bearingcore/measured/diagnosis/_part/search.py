"""Looking for combs: in every band, every direction and at several resolutions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.diagnosis._part.combs import (
    HARMONICS,
    comb_level,
    cut,
    lines_at,
    mark_multiples,
    noise_level,
)
from bearingcore.measured.diagnosis._part.evidence import PartEvidence
from bearingcore.measured.diagnosis._part.parts import PartLines
from bearingcore.measured.signals._filter_bank import Band, Envelope
from bearingcore.measured.signals._line_levels import LineLevels, line_levels

TURNS = (15.0, 60.0, 240.0)
"""Turns of the shaft in a spectrum's segment: long ones show faint lines of a steady cage, short
ones the lines of a cage that wanders."""

FINENESS = 4
"""Steps of frequency in which a comb is looked for, in the resolution of its first line."""

LOWEST_ORDER = 1.05
"""Combs below a line each turn are the shaft's or the cage's own."""

INDEPENDENT_BANDS = 0.5
"""Share of the bands that counts as independent, because bands overlap."""

SURROUNDINGS = 2.0
"""Turns of the shaft a second over which a line's background is taken."""

WANDER = 0.003
"""Fraction by which a cage's speed may wander while it is measured."""

RARE = 1e-3
"""Probability with which noise reaches the level of noise anywhere."""


@dataclass(frozen=True)
class Listened:
    """An envelope, the direction it comes from, and its lines at one resolution."""

    direction: str
    band: Band
    kurtosis: float
    levels: LineLevels = field(repr=False)
    cleared: NDArray[np.float64] = field(repr=False)
    """Levels [dB] without the lines of the shaft."""
    hidden: NDArray[np.bool_] = field(repr=False)
    """Mask of the lines of the shaft."""


@dataclass(frozen=True)
class Combs:
    """All combs at one resolution.

    Attributes
    ----------
    turns
        of the shaft in a segment.
    shaft
        turns of the shaft a second [Hz].
    envelopes
        the bands.
    frequency : (n,) [Hz]
        first lines of combs.
    level : (bands, n) [dB]
    best
        frequency [Hz] and level [dB] of the highest comb of each part.
    """

    turns: float
    shaft: float
    envelopes: tuple[Listened, ...]
    frequency: NDArray[np.float64] = field(repr=False)
    level: NDArray[np.float64] = field(repr=False)
    best: dict[PartLines, tuple[float, float]]

    @property
    def noise(self) -> float:
        """The level [dB] that noise reaches in one of a thousand signals, in any part's window."""
        # independent combs among those within 2 % of each place, in all bands
        bands, segment = max(1.0, INDEPENDENT_BANDS * len(self.envelopes)), self.turns / self.shaft
        cells = sum(
            (1.0 + 2.0 * 0.02 * frequency * segment * 0.5 * HARMONICS) * bands * len(TURNS)
            for frequency, _ in self.best.values()
        )
        return noise_level(RARE / cells, self.envelopes[0].levels.averages)

    def envelope_of(self, part: PartEvidence) -> Listened:
        """Return the envelope in which the lines of a part were seen."""
        place = part.band, part.direction
        return next(e for e in self.envelopes if (e.band, e.direction) == place)


def listen(
    envelopes: Sequence[tuple[str, Envelope]],
    parts: Sequence[PartLines],
    shaft: float,
    known_speed: bool,
    slip: float,
    turns: float,
    stated: float | None = None,
) -> Combs:
    """The combs at one resolution.

    Parameters
    ----------
    envelopes
        with the name of the direction of each.
    shaft
        turns of the shaft a second [Hz].
    known_speed
        whether the shaft's own lines are known well enough to be left out.
    stated
        [Hz] the stated speed, from which lines may not be farther than the slip either.
    """
    segment = turns / shaft
    duration = max(len(envelope.values) / envelope.rate for _, envelope in envelopes)
    resolution = 1.0 / min(segment, duration)
    top = max(lines.order for lines in parts) * (1.0 + slip)
    highest = (HARMONICS * top + 1.5) * shaft
    listened = []
    for direction, envelope in envelopes:
        levels = line_levels(envelope.values, envelope.rate, segment, highest, SURROUNDINGS * shaft)
        width = 1.5 * resolution + 5e-4 * shaft
        # the speed is known to a tenth of what the highest of its lines resolves
        error = 0.1 / HARMONICS / min(TURNS[-1] / shaft, duration)
        hidden = mark_multiples(levels, shaft if known_speed else 0.0, width, error)
        cleared = cut(levels, hidden)
        listened.append(
            Listened(direction, envelope.band, envelope.kurtosis, levels, cleared, hidden)
        )
    slowest = 0.9 * min(lines.order for lines in parts) * (1.0 - slip)
    frequency = np.arange(
        min(LOWEST_ORDER, slowest) * shaft, 1.25 * top * shaft, resolution / FINENESS
    )
    level = np.stack([comb_level(lines_at(e.cleared, e.levels.step, frequency)) for e in listened])
    combs = Combs(turns, shaft, tuple(listened), frequency, level, {})
    for lines in parts:
        inside = np.flatnonzero(mark_window(combs, lines, slip, stated or shaft))
        highest_of = level[:, inside].max(axis=0)
        column = int(highest_of.argmax())
        combs.best[lines] = float(frequency[inside[column]]), float(highest_of[column])
    return combs


def mark_window(combs: Combs, lines: PartLines, slip: float, stated: float) -> NDArray[np.bool_]:
    """Mark the combs (n,) that may be a part's.

    Within the slip of the speed that the shaft's lines show and of the stated speed: otherwise a
    shaft mistaken for another would open the window to twice the slip.
    """
    middle = 0.5 * (combs.shaft + stated) * lines.order
    reach = slip * middle - 0.5 * abs(combs.shaft - stated) * lines.order
    reach = max(reach, 0.6 * (combs.frequency[1] - combs.frequency[0]))
    return np.asarray(np.abs(combs.frequency - middle) <= reach)


def tolerance(combs: Combs, frequency: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Distance [Hz] below which frequencies are the same: segments end, cages wander."""
    resolution = (combs.frequency[1] - combs.frequency[0]) * FINENESS
    return np.asarray(resolution + WANDER * np.asarray(frequency))


def mark_near(combs: Combs, frequencies: Iterable[float]) -> NDArray[np.bool_]:
    """Mark the combs (n,) that cannot be distinguished from one at a frequency [Hz]."""
    lines = np.array(list(frequencies))[:, None]
    return np.asarray((np.abs(combs.frequency - lines) <= tolerance(combs, lines)).any(axis=0))
