"""Finding the shaft's own lines, which give its speed better than a nameplate.

A comb of lines is the shaft's only where nothing else makes it: neither the mains, whose multiples
are next to those of a motor's shaft, nor something two or three times as fast. The lines that each
of these leaves must stand out by themselves. A speed is as good as `ERROR`, or not taken.
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
"""Turns of the shaft a second over which a signal is whitened before its envelope is taken: tones
of the mains would beat with those of the shaft, at lines beside the shaft's."""

GREATEST_SHAFT_LEVEL = 80.0
"""Greatest level [dB] of a line: higher ones are cut to it."""

SUBMULTIPLES = (5, 4, 3, 2)
"""Parts of a frequency that may be the shaft's instead."""

CLEAR = 3.0
"""Lead [dB] over what noise reaches from which the shaft's lines count."""

FEWEST = 3
"""Lines that must be left where others may be of another source: the loudest of them counts for
nothing, and no single one decides."""

ERROR = 1e-3
"""Error of a speed taken from the shaft's lines, as a fraction: two standard errors at most."""

DISAGREE = 9.0
"""Mean square, in squared standard errors, by which lines may be off one comb: beyond three
standard errors each they are lines of several sources."""


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
        """Return True if the lines count, and give the speed."""
        return self.excess >= CLEAR and 2.0 * self.error <= ERROR


def shaft_lines(
    columns: Sequence[NDArray[np.float64]],
    sample_rate: float,
    low: float,
    high: float,
    *,
    envelopes: bool = True,
) -> ShaftLines:
    """The strongest comb between two frequencies [Hz], in vibration and, if wanted, envelope.

    Parameters
    ----------
    columns
        signals (n,), one a direction.
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
        turn = _slowest(levels, float(frequency[index]), low, noise)
        # without the lines of both mains, where enough are left, as there is but one
        either = hidden[0] | hidden[1]
        fits = [_fine(levels, lines, turn, resolution, noise) for lines in (either, *hidden)]
        turn, error = fits[0] if np.isfinite(fits[0][1]) else _finest(fits[1:])
        inside = min(max(turn, low), high)
        if abs(turn - inside) > 2.0 * error:  # lines of something beyond
            error = np.inf
        best = ShaftLines(inside, float(excess[index]), error / inside)
    return best


def _excess(
    levels: LineLevels,
    mains: Sequence[NDArray[np.bool_]],
    frequency: NDArray[np.float64],
    chance: float,
) -> NDArray[np.float64]:
    """Level [dB] of combs (n,) above noise, without what each other source may make."""
    lines = _lines(levels, frequency, HARMONICS)
    order = np.arange(1, HARMONICS + 1)[:, None]
    left = [np.broadcast_to(order % part != 0, lines.shape) for part in (2, 3)]
    left += [lines_at(hidden.astype(float), levels.step, frequency) == 0.0 for hidden in mains]
    noise = [
        noise_level(chance, levels.averages, count) if count >= FEWEST else np.inf
        for count in range(HARMONICS + 1)
    ]
    above = np.full(len(frequency), np.inf)
    for seen in left:
        count = seen.sum(axis=0)
        kept = np.where(seen, lines, 0.0)
        loudest = np.where(seen, lines, -np.inf).max(axis=0)
        mean = (kept.sum(axis=0) - np.where(count > 0, loudest, 0.0)) / np.maximum(count - 1, 1)
        above = np.minimum(above, mean - np.array(noise)[count])
    return above


def _lines(levels: LineLevels, frequency: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Levels (count, n) [dB] of the lines of combs."""
    return lines_at(
        np.clip(levels.level, FAINTEST, GREATEST_SHAFT_LEVEL), levels.step, frequency, count
    )


def _finest(fits: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The frequency [Hz] of two that has the less error, infinite where they disagree by more."""
    (best, error), (other, wider) = sorted(fits, key=lambda fit: fit[1])
    apart = abs(best - other) > 2.0 * (error + wider)
    return best, np.inf if apart else error


def _fine(
    levels: LineLevels,
    mains: NDArray[np.bool_],
    frequency: float,
    resolution: float,
    noise: float,
) -> tuple[float, float]:
    """The frequency [Hz] by the peaks of all lines that are the shaft's alone, and its error."""
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
        below, at, above = levels.level[peak - 1 : peak + 2].tolist()
        bend = below - 2.0 * at + above
        place = peak + (0.5 * (below - above) / bend if bend < 0.0 else 0.0)
        places.append((k, place * levels.step))
        heights.append(at)
    if len(places) < FEWEST:
        return frequency, np.inf
    k, place = np.array(places).T
    # a peak's place is as good as its height over the noise, at most a tenth of the resolution
    spread = resolution * np.maximum(0.1, 0.5 * 10.0 ** (-0.05 * np.array(heights)))
    weight = spread**-2.0
    fitted = float((weight * k * place).sum() / (weight * k * k).sum())
    scatter = float((weight * (place - k * fitted) ** 2).sum()) / (len(k) - 1)
    if scatter > DISAGREE:
        return fitted, np.inf
    return fitted, float(np.sqrt(max(1.0, scatter) / (weight * k * k).sum()))


def _slowest(levels: LineLevels, frequency: float, low: float, noise: float) -> float:
    """The part of a frequency [Hz] of which all lines show: three turns are no turn."""
    for parts in SUBMULTIPLES:
        part = frequency / parts
        if part < low:
            continue
        lines = _lines(levels, np.array([part]), 2 * HARMONICS)[:, 0]
        between = np.sort(lines[np.arange(1, len(lines) + 1) % parts != 0])
        if between[:-1].mean() >= noise + CLEAR:
            return part
    return frequency
