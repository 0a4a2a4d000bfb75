"""Search for combs in every band and direction, at several resolutions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.diagnosis._part.combs import (
    HARMONICS,
    comb_level,
    limit_levels,
    lines_at,
    mark_multiples,
    noise_level,
)
from bearingcore.measured.diagnosis._part.evidence import PartEvidence
from bearingcore.measured.diagnosis._part.parts import PartLines
from bearingcore.measured.signals._filter_bank import Band, Envelope
from bearingcore.measured.signals._line_levels import LineLevels, line_levels

TURNS = (15.0, 60.0, 240.0)
"""Turns of the shaft in a segment of the spectrum: long segments show faint lines of a steady cage,
short ones the lines of a cage that wanders."""

FINENESS = 4
"""Number of frequencies of the search in the resolution of a comb's first line."""

LOWEST_ORDER = 1.05
"""Lowest order of a comb: lower ones are those of shaft and cage."""

INDEPENDENT_BANDS = 0.5
"""Share of the bands that counts as independent, because bands overlap."""

SURROUNDINGS = 2.0
"""Width over which the median is the background of a line, in shaft frequencies."""

WANDER = 0.003
"""Largest relative change of a cage's speed during a measurement."""

RARE = 1e-3
"""Probability that noise reaches its level anywhere in a signal."""


@dataclass(frozen=True)
class BandLines:
    """The lines of an envelope in one band and direction, at one resolution."""

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
    envelopes: tuple[BandLines, ...]
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

    def envelope_of(self, part: PartEvidence) -> BandLines:
        """Return the envelope that shows the lines of a part."""
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
    """Compute the combs at one resolution.

    Parameters
    ----------
    envelopes
        each with the name of its direction.
    shaft
        turns of the shaft a second [Hz].
    known_speed
        True if the speed is known well enough to leave out the shaft's own lines.
    stated
        stated speed [Hz], from which lines may also be no farther than the slip.
    """
    segment = turns / shaft
    duration = max(len(envelope.values) / envelope.rate for _, envelope in envelopes)
    resolution = 1.0 / min(segment, duration)
    top = max(lines.order for lines in parts) * (1.0 + slip)
    highest = (HARMONICS * top + 1.5) * shaft
    band_lines = []
    for direction, envelope in envelopes:
        levels = line_levels(envelope.values, envelope.rate, segment, highest, SURROUNDINGS * shaft)
        width = 1.5 * resolution + 5e-4 * shaft
        # the speed is known to a tenth of the resolution of its highest line
        error = 0.1 / HARMONICS / min(TURNS[-1] / shaft, duration)
        hidden = mark_multiples(levels, shaft if known_speed else 0.0, width, error)
        cleared = limit_levels(levels, hidden)
        band_lines.append(
            BandLines(direction, envelope.band, envelope.kurtosis, levels, cleared, hidden)
        )
    slowest = 0.9 * min(lines.order for lines in parts) * (1.0 - slip)
    frequency = np.arange(
        min(LOWEST_ORDER, slowest) * shaft, 1.25 * top * shaft, resolution / FINENESS
    )
    levels_of = [comb_level(lines_at(e.cleared, e.levels.step, frequency)) for e in band_lines]
    combs = Combs(turns, shaft, tuple(band_lines), frequency, np.stack(levels_of), {})
    for lines in parts:
        inside = np.flatnonzero(mark_window(combs, lines, slip, stated or shaft))
        level = combs.level[:, inside].max(axis=0)
        column = int(level.argmax())
        combs.best[lines] = float(frequency[inside[column]]), float(level[column])
    return combs


def mark_window(combs: Combs, lines: PartLines, slip: float, stated: float) -> NDArray[np.bool_]:
    """Mark the combs (n,) that may belong to a part.

    They are within the slip of both the speed by the shaft's lines and the stated speed. Otherwise
    lines of another shaft would widen the window to twice the slip.
    """
    middle = 0.5 * (combs.shaft + stated) * lines.order
    reach = slip * middle - 0.5 * abs(combs.shaft - stated) * lines.order
    reach = max(reach, 0.6 * (combs.frequency[1] - combs.frequency[0]))
    return np.asarray(np.abs(combs.frequency - middle) <= reach)


def tolerance(combs: Combs, frequency: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Return the distance [Hz] below which frequencies count as equal: resolution and wander."""
    resolution = (combs.frequency[1] - combs.frequency[0]) * FINENESS
    return np.asarray(resolution + WANDER * np.asarray(frequency))


def mark_near(combs: Combs, frequencies: Iterable[float]) -> NDArray[np.bool_]:
    """Mark the combs (n,) that cannot be distinguished from those at some frequencies [Hz]."""
    lines = np.array(list(frequencies))[:, None]
    return np.asarray((np.abs(combs.frequency - lines) <= tolerance(combs, lines)).any(axis=0))
