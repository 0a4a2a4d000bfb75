"""Search for the shaft's own lines, which give its speed more exactly than a nameplate.

A comb of lines belongs to the shaft only if nothing else can make it: neither the mains, whose
multiples are next to those of a motor's shaft, nor a source two or three times as fast. The lines
that are not explained by these must stand out by themselves. A speed with a larger error than
`ERROR` is not used.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.measured.diagnosis._part.combs import FAINTEST, HARMONICS, lines_at, noise_level
from bearingcore.measured.diagnosis._part.mains import MAINS, mains_lines
from bearingcore.measured.diagnosis._part.search import RARE
from bearingcore.measured.signals._filter_bank import LOWEST, Band, downsample, squared_envelopes
from bearingcore.measured.signals._line_levels import LineLevels, line_levels

SEGMENT_TURNS = 240.0
"""Number of turns of the shaft in a segment of the spectrum."""

SHAFT_WHITENING = 3.0
"""Width, in shaft frequencies, over which a signal is whitened before its envelope is computed:
otherwise tones of the mains would beat with those of the shaft, at lines beside the shaft's."""

GREATEST_SHAFT_LEVEL = 80.0
"""Greatest level [dB] of a line: higher ones are limited to it."""

SUBMULTIPLES = (5, 4, 3, 2)
"""Divisors of a frequency that may give that of the shaft."""

CLEAR = 3.0
"""Least lead [dB] of the shaft's lines over noise."""

FEWEST = 3
"""Least number of the shaft's lines that no other source explains. Their mean level leaves out the
loudest, so that no single line decides."""

ERROR = 1e-3
"""Greatest relative error of a speed from the shaft's lines, in two standard errors."""

DISAGREE = 9.0
"""Greatest mean square deviation of lines from one comb, in squared standard errors: beyond three
standard errors they belong to several sources."""


class ShaftLines(NamedTuple):
    """The frequency at which a signal repeats once a turn.

    Attributes
    ----------
    frequency
        turns a second [Hz].
    excess
        [dB] above what noise reaches anywhere in the range.
    error
        standard error of the frequency, as a fraction.
    """

    frequency: float
    excess: float
    error: float

    @property
    def clear(self) -> bool:
        """True if the lines stand out and give the speed exactly enough."""
        return self.excess >= CLEAR and 2.0 * self.error <= ERROR


def shaft_lines(
    columns: Sequence[NDArray[np.float64]],
    sample_rate: float,
    low: float,
    high: float,
    *,
    envelopes: bool = True,
) -> ShaftLines:
    """Find the strongest comb between two frequencies [Hz], in the vibration and its envelope.

    Parameters
    ----------
    columns
        signals (n,), one for each direction.
    envelopes
        False searches the vibration alone.
    """
    segment, top = SEGMENT_TURNS / low, (2 * HARMONICS + 1) * high
    best = ShaftLines(0.5 * (low + high), -np.inf, np.inf)
    series = [downsample(samples - samples.mean(), sample_rate, top) for samples in columns]
    whole, width = [Band(LOWEST, 0.5 * sample_rate)], SHAFT_WHITENING * low
    for samples in columns if envelopes else ():
        whitened = squared_envelopes(samples, sample_rate, whole, top, None, width)
        series += [(envelope.values, envelope.rate) for envelope in whitened]
    for values, rate in series:
        if len(values) < rate / low:  # less than a turn
            continue
        levels = line_levels(values, rate, segment, top, 2.0 * low)
        resolution = 1.0 / min(segment, len(values) / rate)
        count = 1 + int(np.ceil((high - low) * 4.0 * HARMONICS / resolution))
        frequency = np.linspace(low, high, count)  # the highest line resolves the most
        cells = 1.0 + (high - low) / resolution * 0.5 * HARMONICS
        hidden = [mains_lines(levels, mains, resolution) for mains in MAINS]
        excess = _excess(levels, hidden, frequency, RARE / cells)
        index = int(excess.argmax())
        if excess[index] <= best.excess:
            continue
        noise = noise_level(RARE / cells, levels.averages)
        shaft = _slowest_comb(levels, float(frequency[index]), low, noise)
        # fit without the lines of both mains if enough remain, else without those of one of them
        either = hidden[0] | hidden[1]
        fits = [_fit_comb(levels, mains, shaft, resolution, noise) for mains in (either, *hidden)]
        shaft, error = fits[0] if np.isfinite(fits[0][1]) else _better_fit(fits[1:])
        inside = min(max(shaft, low), high)
        if abs(shaft - inside) > 2.0 * error:  # the lines belong to a frequency outside the range
            error = np.inf
        best = ShaftLines(inside, float(excess[index]), error / inside)
    return best


def _excess(
    levels: LineLevels,
    mains: Sequence[NDArray[np.bool_]],
    frequency: NDArray[np.float64],
    chance: float,
) -> NDArray[np.float64]:
    """Leave out the lines of each other source; return the least level [dB] of combs over noise."""
    lines = _lines(levels, frequency, HARMONICS)
    order = np.arange(1, HARMONICS + 1)[:, None]
    masks = [np.broadcast_to(order % part != 0, lines.shape) for part in (2, 3)]
    masks += [lines_at(hidden.astype(float), levels.step, frequency) == 0.0 for hidden in mains]
    noise = [
        noise_level(chance, levels.averages, count) if count >= FEWEST else np.inf
        for count in range(HARMONICS + 1)
    ]
    above = np.full(len(frequency), np.inf)
    for mask in masks:
        count = mask.sum(axis=0)
        kept = np.where(mask, lines, 0.0)
        loudest = np.where(mask, lines, -np.inf).max(axis=0)
        mean = (kept.sum(axis=0) - np.where(count > 0, loudest, 0.0)) / np.maximum(count - 1, 1)
        above = np.minimum(above, mean - np.array(noise)[count])
    return above


def _lines(levels: LineLevels, frequency: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Return the levels (count, n) [dB] of the lines of combs."""
    return lines_at(
        np.clip(levels.level, FAINTEST, GREATEST_SHAFT_LEVEL), levels.step, frequency, count
    )


def _better_fit(fits: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Return the frequency [Hz] of the better fit and its error, infinite if the two disagree."""
    (best, error), (other, larger) = sorted(fits, key=lambda fit: fit[1])
    disagree = abs(best - other) > 2.0 * (error + larger)
    return best, np.inf if disagree else error


def _fit_comb(
    levels: LineLevels,
    mains: NDArray[np.bool_],
    frequency: float,
    resolution: float,
    noise: float,
) -> tuple[float, float]:
    """Fit a frequency [Hz] to peaks that are not of the mains; return it and its error."""
    order = np.arange(1, 2 * HARMONICS + 1)
    hidden = lines_at(mains.astype(float), levels.step, np.array([frequency]), len(order))[:, 0]
    places, heights = [], []
    for k in order[hidden == 0.0].tolist():
        reach = max(1, round(resolution / levels.step))
        middle = round(k * frequency / levels.step)
        near = levels.level[max(middle - reach, 0) : middle + reach + 1]
        inside = reach < middle < len(levels.level) - reach - 1
        if not inside or near.max() < noise + CLEAR:
            continue
        peak = middle - reach + int(near.argmax())
        below, top, above = levels.level[peak - 1 : peak + 2].tolist()
        bend = below - 2.0 * top + above
        place = peak + (0.5 * (below - above) / bend if bend < 0.0 else 0.0)
        places.append((k, place * levels.step))
        heights.append(top)
    if len(places) < FEWEST:
        return frequency, np.inf
    k, place = np.array(places).T
    # the error of a peak's place falls with its height over noise, down to a tenth of a resolution
    spread = resolution * np.maximum(0.1, 0.5 * 10.0 ** (-0.05 * np.array(heights)))
    weight = spread**-2.0
    fitted = float((weight * k * place).sum() / (weight * k * k).sum())
    scatter = float((weight * (place - k * fitted) ** 2).sum()) / (len(k) - 1)
    if scatter > DISAGREE:
        return fitted, np.inf
    return fitted, float(np.sqrt(max(1.0, scatter) / (weight * k * k).sum()))


def _slowest_comb(levels: LineLevels, frequency: float, low: float, noise: float) -> float:
    """Return the lowest submultiple of a frequency [Hz] whose lines all show: the shaft's."""
    for divisor in SUBMULTIPLES:
        submultiple = frequency / divisor
        if submultiple < low:
            continue
        lines = _lines(levels, np.array([submultiple]), 2 * HARMONICS)[:, 0]
        between = np.sort(lines[np.arange(1, len(lines) + 1) % divisor != 0])
        if between[:-1].mean() >= noise + CLEAR:
            return submultiple
    return frequency
