"""Looking for combs: in every band, every direction and at several resolutions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.diagnosis.part.combs import (
    HARMONICS,
    comb_level,
    harmonics,
    noise_chance,
    noise_level,
    without,
)
from bearingcore.diagnosis.part.parts import BALL, PartLines
from bearingcore.signals.filter_bank import Band, Envelope
from bearingcore.signals.line_levels import LineLevels, line_levels

TURNS = (15.0, 60.0, 240.0)
"""Turns of the shaft in a spectrum's segment: long ones show faint lines of a steady cage, short
ones the lines of a cage that wanders."""

FINENESS = 4
"""Steps of frequency in which a comb is looked for, in the resolution of its first line."""

LOWEST_ORDER = 1.05
"""Combs below a line each turn are the shaft's or the cage's own."""

INDEPENDENT_BANDS = 0.5
"""Bands overlap: of so many, this share counts as independent."""

SURROUNDINGS = 2.0
"""Turns of the shaft a second over which a line's background is taken."""

WANDER = 0.003
"""By how much a cage's speed may wander while it is measured, as a fraction."""

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


@dataclass(frozen=True)
class Found:
    """The best comb of a part.

    Attributes
    ----------
    lines
        the part.
    frequency
        of its first line [Hz].
    level
        [dB], see `combs`.
    place
        of the band in which it was seen.
    chance
        how often noise alone does as well, somewhere in the part's window and any band.
    """

    lines: PartLines
    frequency: float
    level: float
    place: int
    chance: float


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
    found
        the best comb of each part.
    """

    turns: float
    shaft: float
    envelopes: tuple[Listened, ...]
    frequency: NDArray[np.float64] = field(repr=False)
    level: NDArray[np.float64] = field(repr=False)
    found: tuple[Found, ...]

    @property
    def averages(self) -> float:
        """Independent spectra in a mean."""
        return self.envelopes[0].levels.averages

    @property
    def noise(self) -> float:
        """The level [dB] that noise reaches in one of a thousand signals, in any part's window."""
        cells = sum(self.cells(found.lines, found.frequency) for found in self.found)
        return noise_level(RARE / cells, self.averages)

    def cells(self, lines: PartLines, frequency: float, slip: float = 0.02) -> float:
        """Independent combs among those within slip of a frequency [Hz], in all bands."""
        segment = self.turns / self.shaft
        places = 1.0 + 2.0 * slip * frequency * segment * 0.5 * HARMONICS
        either = 2.0 if lines.part == BALL else 1.0
        return places * either * max(1.0, INDEPENDENT_BANDS * len(self.envelopes)) * len(TURNS)


def listen(
    envelopes: Sequence[tuple[str, Envelope]],
    parts: Sequence[PartLines],
    shaft: float,
    known_speed: bool,
    slip: float,
    turns: float,
    given: float | None = None,
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
    given
        [Hz] the speed as given, from which lines may not be farther than the slip either.
    """
    segment = turns / shaft
    top = max(lines.order for lines in parts) * (1.0 + slip)
    highest = (HARMONICS * top + 1.5) * shaft
    listened = []
    for direction, envelope in envelopes:
        levels = line_levels(envelope.values, envelope.rate, segment, highest, SURROUNDINGS * shaft)
        width = 1.5 / segment + 5e-4 * shaft
        cleared = without(levels, shaft if known_speed else 0.0, width)
        listened.append(Listened(direction, envelope.band, envelope.kurtosis, levels, cleared))
    duration = max(len(envelope.values) / envelope.rate for _, envelope in envelopes)
    resolution = 1.0 / min(segment, duration)
    slowest = 0.9 * min(lines.order for lines in parts) * (1.0 - slip)
    frequency = np.arange(
        min(LOWEST_ORDER, slowest) * shaft, 1.25 * top * shaft, resolution / FINENESS
    )
    level = np.stack(
        [comb_level(harmonics(one.cleared, one.levels.step, frequency)) for one in listened]
    )
    combs = Combs(turns, shaft, tuple(listened), frequency, level, ())
    found = tuple(_best(combs, lines, slip, given or shaft) for lines in parts)
    return Combs(turns, shaft, tuple(listened), frequency, level, found)


def _best(combs: Combs, lines: PartLines, slip: float, given: float) -> Found:
    nominal = lines.order * combs.shaft
    inside = np.flatnonzero(within(combs, lines, slip, given, combs.frequency))
    level = combs.level[:, inside]
    if lines.part == BALL:
        level = np.stack(
            [
                comb_level(_with_sidebands(one, combs.frequency[inside], lines, combs.shaft))
                for one in combs.envelopes
            ]
        )
    place, column = np.unravel_index(int(level.argmax()), level.shape)
    frequency, best = float(combs.frequency[inside[column]]), float(level[place, column])
    chance = noise_chance(best, combs.averages) * combs.cells(lines, nominal, slip)
    return Found(lines, frequency, best, int(place), min(1.0, chance))


def within(
    combs: Combs, lines: PartLines, slip: float, given: float, frequency: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Which frequencies [Hz] may be a part's first line.

    Within the slip of the speed that the shaft's lines show and of the speed as given: otherwise a
    shaft found wrongly would open the window to twice the slip.
    """
    middle = 0.5 * (combs.shaft + given) * lines.order
    reach = slip * middle - 0.5 * abs(combs.shaft - given) * lines.order
    reach = max(reach, 0.6 * (combs.frequency[1] - combs.frequency[0]))
    return np.asarray(np.abs(frequency - middle) <= reach)


def _with_sidebands(
    one: Listened, frequency: NDArray[np.float64], lines: PartLines, shaft: float
) -> NDArray[np.float64]:
    """Lines of a ball: each itself, or its two sidebands if both are louder."""
    return np.maximum(
        harmonics(one.cleared, one.levels.step, frequency),
        np.minimum(*side_levels(one, frequency, lines.sidebands * shaft)),
    )


def side_levels(
    one: Listened, frequency: NDArray[np.float64], spacing: float, count: int = HARMONICS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Levels [dB] at a distance [Hz] below and above each harmonic: twice (count, n)."""
    step = one.levels.step
    level = one.cleared  # where a sideband falls on a line of the shaft it is no evidence
    peak = level.copy()
    np.maximum(peak[1:], level[:-1], out=peak[1:])
    np.maximum(peak[:-1], level[1:], out=peak[:-1])
    order = np.arange(1, count + 1)[:, None]
    sides = []
    for away in (-spacing, spacing):
        index = np.rint((order * frequency + away) / step).astype(np.int64)
        beyond = (index >= len(peak)) | (index < 1)
        side = peak[np.clip(index, 0, len(peak) - 1)]
        side[beyond] = 0.0
        sides.append(side)
    return sides[0], sides[1]


def excess(combs: Combs) -> float:
    """By how much [dB] the best comb of any part is above the level of noise."""
    return max(found.level for found in combs.found) - combs.noise


def near(combs: Combs, frequency: float, other: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask of frequencies [Hz] too near one to be distinguished: segments end, cages wander."""
    resolution = (combs.frequency[1] - combs.frequency[0]) * FINENESS
    return np.asarray(np.abs(other - frequency) <= resolution + WANDER * frequency)


def multiples(combs: Combs, frequency: float, factors: Sequence[float]) -> NDArray[np.bool_]:
    """Which combs (n,) are multiples of a frequency [Hz] by some factors."""
    hit = np.zeros(len(combs.frequency), dtype=bool)
    for factor in factors:
        hit |= near(combs, factor * frequency, combs.frequency)
    return hit


def sideband_combs(
    combs: Combs, frequency: float, spacings: Sequence[float], orders: int = 3
) -> NDArray[np.bool_]:
    """Which combs (n,) are made by sidebands of a frequency [Hz] at distances [Hz]."""
    hit = np.zeros(len(combs.frequency), dtype=bool)
    for spacing in spacings:
        for order in range(1, orders + 1):
            hit |= near(combs, frequency + order * spacing, combs.frequency)
            hit |= near(combs, abs(frequency - order * spacing), combs.frequency)
    return hit
