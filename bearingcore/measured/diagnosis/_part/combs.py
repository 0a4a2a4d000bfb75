"""Combs: a line and its harmonics in the spectrum of an envelope.

The level of a comb is the mean level [dB] of its first HARMONICS lines without the loudest one.
Repeated knocks show in several harmonics, so no single line may decide: it may be a tone, a line of
the shaft, or chance.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.signals._line_levels import LineLevels

HARMONICS = 6
"""Number of lines of a comb."""

FAINTEST, LOUDEST = -3.0, 40.0
"""Least and greatest level [dB] of a line: others are limited to them."""

_DRAWS = 40_000
_TAIL = 0.005


def lines_at(values: NDArray[np.float64], step: float, frequency: NDArray[np.float64],
             count: int = HARMONICS, away: float = 0.0) -> NDArray[np.float64]:  # fmt: skip
    """Return the greatest values within one step of the places `away` [Hz] from each harmonic.

    The shape is (count, len(frequency)); 0 where a place is above the last frequency or below 0.
    """
    peak = values.copy()
    np.maximum(peak[1:], values[:-1], out=peak[1:])
    np.maximum(peak[:-1], values[1:], out=peak[:-1])
    places = np.arange(1, count + 1)[:, None] * (frequency / step) + away / step
    index = np.rint(places).astype(np.int64)
    beyond = (index >= len(peak)) | (index < 1)
    level = peak[np.clip(index, 0, len(peak) - 1)]
    level[beyond] = 0.0
    return np.asarray(level)


def limit_levels(levels: LineLevels, hidden: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Limit levels (m,) [dB] to FAINTEST and LOUDEST, and to at most 0 where `hidden`."""
    level = np.clip(levels.level, FAINTEST, LOUDEST)
    return np.asarray(np.where(hidden, np.minimum(level, 0.0), level))


def mark_multiples(
    levels: LineLevels, spacing: float, width: float, error: float
) -> NDArray[np.bool_]:
    """Mark frequencies (m,) within `width` [Hz] of multiples of a spacing with an `error`."""
    frequency = levels.step * np.arange(len(levels.level))
    if spacing <= 0.0:
        return np.zeros(len(frequency), dtype=bool)
    multiple = np.rint(frequency / spacing)
    return np.asarray(np.abs(frequency - spacing * multiple) <= width + error * multiple)


def comb_level(lines: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the level [dB] of combs from their lines (HARMONICS, n): the mean but the loudest."""
    return np.asarray((lines.sum(axis=0) - lines.max(axis=0)) / (len(lines) - 1))


def noise_level(chance: float, averages: float, lines: int = HARMONICS) -> float:
    """Return the level [dB] that noise reaches with a small chance in a comb of some lines."""
    sorted_levels, edge, scale = _noise(max(1, round(4.0 * averages)), lines)
    if chance <= _TAIL:
        return float(edge + scale * np.log(_TAIL / chance))
    return float(np.quantile(sorted_levels, 1.0 - min(chance, 1.0)))


@lru_cache(maxsize=256)
def _noise(quarters: int, count: int) -> tuple[NDArray[np.float64], float, float]:
    """Simulate comb levels of noise: sorted, the edge of their tail, and its scale by e [dB].

    The power of a line is the mean of `quarters`/4 independent spectra. It is the greatest of three
    neighbours at half the resolution, which equals the greatest of 1.8 independent ones.
    """
    averages = 0.25 * quarters
    rng = np.random.default_rng(quarters)
    draws = rng.gamma(averages, 1.0 / averages, (2, count, _DRAWS))
    greater = np.where(rng.random((count, _DRAWS)) < 0.8, draws.max(axis=0), draws[0])
    lines = np.clip(10.0 * np.log10(np.maximum(greater, 1e-12)), FAINTEST, LOUDEST)
    levels = np.sort(comb_level(lines))
    tail = levels[-round(_TAIL * _DRAWS) :]
    return levels, float(tail[0]), float((tail - tail[0]).mean())
