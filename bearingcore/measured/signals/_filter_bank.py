"""Squared envelopes of a signal in bands of many widths, with their kurtosis.

The bands are those of the fast kurtogram (Antoni, 2007): the whole range, halves, thirds, quarters
and so on. Filters are windows in the frequency domain, so no phase moves and no delay is added.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array
from bearingcore.measured.signals._whitening import whiten

BAND_COUNTS = (1, 2, 3, 4, 6, 8, 12, 16)
"""Numbers of equal bands into which the range is split."""

LOWEST = 20.0
"""Lowest frequency [Hz] that is used: below it sensors drift."""

LOUDEST_ENVELOPE = 12.0
"""Greatest value of a squared envelope over its mean: noise reaches it once in 160,000 samples, and
a single strong blow must not outweigh all others."""

TAPER = 0.01
"""Share of a signal at either end that is faded out and not used."""


class Band(NamedTuple):
    """Lower and upper end of a band [Hz]."""

    low: float
    high: float


class Envelope(NamedTuple):
    """A squared envelope in a band.

    Attributes
    ----------
    band
        [Hz]
    values : (n,)
        relative to their mean.
    rate
        samples a second [Hz].
    kurtosis
        of the signal in the band: 2 for noise, 1 for a tone, more for knocks.
    """

    band: Band
    values: Array
    rate: float
    kurtosis: float


def split(sample_rate: float, narrowest: float, into: Sequence[int] = BAND_COUNTS) -> list[Band]:
    """Return bands [Hz] up to half the sample rate; only the first may be below `narrowest`."""
    half = 0.5 * sample_rate
    bands = []
    for parts in into:
        if parts > 1 and half / parts < narrowest:
            break
        edges = np.linspace(0.0, half, parts + 1).tolist()
        bands += [Band(max(low, LOWEST), high) for low, high in itertools.pairwise(edges)]
    return bands


def squared_envelopes(
    samples: Array,
    sample_rate: float,
    bands: Sequence[Band],
    highest: float,
    dropped: NDArray[np.bool_] | None = None,
    whitening: float | None = None,
    loudest: float = LOUDEST_ENVELOPE,
) -> list[Envelope]:
    """Compute squared envelopes of a signal (n,) in bands, with frequencies up to `highest` [Hz].

    Parameters
    ----------
    dropped : (n,) bool
        samples that were not measured; there the envelope is set to its mean.
    whitening
        width [Hz] over which the signal is whitened first; None: not whitened.
    loudest
        greatest value of a squared envelope over its mean.
    """
    from scipy.fft import ifft, next_fast_len, rfft  # imported late: see `spectrum`

    count = len(samples)
    kept = samples - samples.mean()
    if dropped is not None and dropped.any():
        kept = np.where(dropped, 0.0, samples - samples[~dropped].mean())
    # both ends of a signal differ: without a taper the step of a loud tone from one end to the
    # other would be a knock in every quiet band
    taper = max(4, round(TAPER * count))
    rise = 0.5 - 0.5 * np.cos(np.pi / taper * (np.arange(taper) + 0.5))
    kept = np.concatenate((kept[:taper] * rise, kept[taper:-taper], kept[-taper:] * rise[::-1]))
    size = next_fast_len(count, real=True)
    transform = rfft(kept, size)
    resolution = sample_rate / size
    if whitening is not None:
        transform = whiten(transform, resolution, whitening)
    transform = transform.astype(np.complex64)
    envelopes = []
    for band in bands:
        first = max(1, round(band.low / resolution))
        last = min(len(transform), round(band.high / resolution))
        inside = transform[first:last]
        if len(inside) < 16:
            continue
        # twice the band's width, because a squared envelope has frequencies up to that width
        length = next_fast_len(2 * len(inside))
        rate = length * resolution
        analytic = ifft(inside, length)[: int(count / sample_rate * rate)]
        squared = (analytic.real**2 + analytic.imag**2).astype(np.float64)
        good = np.ones(len(squared), dtype=bool)
        if dropped is not None and dropped.any():
            good = ~_dropped_on_grid(
                dropped, sample_rate, len(squared), rate, 4.0 / (band[1] - band[0])
            )
        end = math.ceil(TAPER * len(squared)) + 2
        good[:end] = good[-end:] = False
        mean = float(squared[good].mean()) if good.any() else 0.0
        if not mean > 0.0:
            continue
        squared /= mean
        squared[~good] = 1.0
        # the rest of a tone that was whitened away swells at the ends
        middle = squared[len(squared) // 8 : -(len(squared) // 8)]
        kurtosis = float((middle**2).mean() / middle.mean() ** 2)
        np.minimum(squared, loudest, out=squared)
        envelopes.append(Envelope(band, *downsample(squared, rate, highest), kurtosis))
    return envelopes


def downsample(values: Array, rate: float, highest: float) -> tuple[Array, float]:
    """Return values without frequencies above `highest` [Hz], and their new rate [Hz]."""
    from scipy.fft import irfft, next_fast_len, rfft

    if rate <= 3.0 * highest:
        return values, rate
    count = len(values)
    padded = next_fast_len(count, real=True)
    mean = values.mean()
    transform = rfft((values - mean).astype(np.float32), padded)
    size = next_fast_len(max(64, int(2.5 * highest / rate * padded)), real=True)
    kept = transform[: size // 2 + 1]
    coarse = irfft(kept, size).astype(np.float64) * (size / padded)
    new_rate = rate * size / padded
    return mean + coarse[: int(count / rate * new_rate)], new_rate


def _dropped_on_grid(
    dropped: NDArray[np.bool_], sample_rate: float, count: int, rate: float, margin: float
) -> NDArray[np.bool_]:
    """Mark dropped samples on a grid of `count` at `rate` [Hz], with a margin [s] around."""
    places = np.flatnonzero(dropped) / sample_rate
    steps = np.zeros(count + 1)
    begins = np.clip(((places - margin) * rate).astype(int), 0, count)
    ends = np.clip(((places + margin) * rate).astype(int) + 1, 0, count)
    np.add.at(steps, begins, 1.0)
    np.add.at(steps, ends, -1.0)
    return np.cumsum(steps[:-1]) > 0.5
