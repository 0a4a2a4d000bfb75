"""Finding the shaft's own lines, which give its speed better than a nameplate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.diagnosis.part.combs import (
    FAINTEST,
    HARMONICS,
    comb_level,
    lines_at,
    noise_level,
)
from bearingcore.diagnosis.part.search import RARE
from bearingcore.signals.filter_bank import LOWEST, Band, squared_envelopes, thinned
from bearingcore.signals.line_levels import line_levels

TURNS = 240.0
"""Of the shaft in a spectrum's segment."""

LOUDEST = 80.0
"""[dB] to which a line's level is cut."""

PLATEAU = 0.5
"""[dB] below the best in which a comb counts as equally good: the middle of those is the answer."""

SUBMULTIPLES = (5, 4, 3, 2)
"""Parts of a frequency that may be the shaft's instead."""

CLEAR = 3.0
"""[dB] above what noise reaches from which the shaft's lines count as found."""


class ShaftLines(NamedTuple):
    """Where a signal repeats once a turn.

    Attributes
    ----------
    frequency
        turns a second [Hz].
    excess
        [dB] above what noise reaches anywhere in the range.
    """

    frequency: float
    excess: float

    @property
    def clear(self) -> bool:
        """Whether the lines count as found."""
        return self.excess >= CLEAR


def shaft_lines(
    columns: Sequence[NDArray[np.float64]], sample_rate: float, low: float, high: float
) -> ShaftLines:
    """The strongest comb between two frequencies [Hz], in vibration and envelope.

    Parameters
    ----------
    columns
        signals (n,), one a direction.
    """
    segment, top = TURNS / low, (2 * HARMONICS + 1) * high
    best = ShaftLines(0.5 * (low + high), -np.inf)
    full = [Band(LOWEST, 0.5 * sample_rate)]
    for samples in columns:
        series = [thinned(samples - samples.mean(), sample_rate, top)]
        envelopes = squared_envelopes(samples, sample_rate, full, top)
        series += [(envelope.values, envelope.rate) for envelope in envelopes]
        for values, rate in series:
            levels = line_levels(values, rate, segment, top, 2.0 * low)
            resolution = 1.0 / min(segment, len(values) / rate)
            step = 0.25 * resolution / HARMONICS  # the highest line resolves the most
            frequency = np.arange(low, high + step, step)
            cut = np.clip(levels.level, FAINTEST, LOUDEST)
            level = comb_level(lines_at(cut, levels.step, frequency, HARMONICS))
            cells = 1.0 + (high - low) / resolution * 0.5 * HARMONICS
            index = int(level.argmax())
            noise = noise_level(RARE / cells, levels.averages)
            above = float(level[index]) - noise
            if above > best.excess:
                near = np.flatnonzero(level >= level[index] - PLATEAU)
                near = near[np.abs(frequency[near] - frequency[index]) <= resolution]
                found = float(frequency[near].mean())
                best = ShaftLines(_slowest(cut, levels.step, found, low, noise), above)
    return best


def _slowest(
    level: NDArray[np.float64], step: float, frequency: float, low: float, noise: float
) -> float:
    """The part of a frequency [Hz] of which all lines show: three turns are no turn."""
    for parts in SUBMULTIPLES:
        part = frequency / parts
        if part < low:
            continue
        lines = lines_at(level, step, np.array([part]), 2 * HARMONICS)[:, 0]
        between = np.sort(lines[np.arange(1, len(lines) + 1) % parts != 0])
        if between[:-1].mean() >= noise + CLEAR:
            return part
    return frequency
