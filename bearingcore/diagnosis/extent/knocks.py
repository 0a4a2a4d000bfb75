"""Entry and exit of a ball in the mean ball pass of envelopes.

The envelope of each frequency band is cut into ball passes, which are aligned against slip and
averaged. A ball that enters a spall and one that leaves it each give a peak. What rings after a
single knock swells too, where two resonances beat; but that differs from band to band. So two peaks
count only where bands that have no frequency in common agree on their separation.

Quantity                                            | Name        | Unit
--------------------------------------------------- | ----------- | --------------
mean envelope over a ball pass                      | envelope    | of its mean
angle of the race between the two peaks             | separation  | rad
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.signals.averaging import BallPasses, average_passes
from bearingcore.signals.dropouts import signal_faults
from bearingcore.signals.filter_bank import Band, split, squared_envelopes
from bearingcore.signals.recording import Recording

Array = NDArray[np.float64]

HARMONICS = 100
"""Of the ball-pass frequency that a mean pass keeps: a hundredth of a ball pass is resolved."""

NARROWEST = 40.0
"""Ball-pass frequencies that a band is wide at least: narrower ones ring for longer."""

LOWEST = 10.0
"""Ball-pass frequencies from which bands are looked at: below lie shaft, cage and rigid bodies."""

WHITENING = 3.0
"""Ball-pass frequencies over which a signal is whitened."""

BEST_BANDS = 6
"""That decide."""

PLACES = 2048
"""In a mean ball pass."""

LEAST_CONTRAST = 8.0
"""Height of the highest peak, in standard errors of the mean pass, below which nothing is seen."""

FAINTEST = 0.1
"""Height of the second peak as a share of the first."""

THIRD = 0.6
"""Height of a third peak, as a share of the second, from which it is a train of peaks: ringing."""

LEAST_DIP = 0.25
"""How far the envelope falls between two peaks, as a share of the lower one, that count as two."""

SMOOTHING = (0.015, 0.007, 0.001)
"""Shares of a ball pass over which a mean pass is smoothed before its peaks are looked for."""

AGREE = 0.035
"""By how much bands may differ in the separation: a share of it, and of a ball pass a tenth of
this."""

AGREEING, SHOWING = 0.6, 0.35
"""Share of the weight of bands with two peaks that must agree, and of the weight of all bands. A
band without a second peak says nothing, one with another separation speaks against."""


@dataclass(frozen=True)
class MeanPass:
    """The mean ball pass of one band's envelope.

    Attributes
    ----------
    band
        [Hz]
    direction
        of the recording.
    envelope : (PLACES,)
        over one ball pass, its least value 0 and its mean over the whole signal 1.
    error
        standard error of `envelope`.
    """

    band: Band
    direction: str
    envelope: Array
    error: float

    @property
    def contrast(self) -> float:
        """Height of the highest peak in standard errors."""
        return float(self.envelope.max()) / max(self.error, 1e-12)


@dataclass(frozen=True)
class Knocks:
    """What the mean passes say.

    Attributes
    ----------
    passes
        of the bands that decide, the best first.
    frequency
        ball passes a second [Hz].
    n_passes
        how many were averaged.
    separation, deviation
        between entry and exit as a share of a ball pass, and its standard deviation; NaN where
        there are no two peaks on which the bands agree.
    resolution
        share of a ball pass below which a second peak hides in the first one's ringing.
    entry, exit
        places of the two peaks in the best band's envelope, as shares of a ball pass; NaN without.
    """

    passes: tuple[MeanPass, ...]
    frequency: float
    n_passes: int
    separation: float
    deviation: float
    resolution: float
    entry: float
    exit: float

    @property
    def visible(self) -> bool:
        """Whether anything repeats with the ball passes."""
        return bool(self.passes) and self.passes[0].contrast >= LEAST_CONTRAST


def find_knocks(recording: Recording, nominal: float, slip: float) -> Knocks:
    """The mean ball passes of a recording and the knocks in them.

    Parameters
    ----------
    nominal, slip
        ball passes a second [Hz] over the damaged race, and by how much they may differ, as a
        fraction.

    Raises
    ------
    ValueError
        where the recording holds too few ball passes.
    """
    names, envelopes, rate = _envelopes(recording, nominal)
    first = _averaged(envelopes, rate, nominal, slip, follow=False)
    contrast = [one.contrast for one in _mean_passes(first, names)]
    best = np.argsort(contrast)[::-1][:BEST_BANDS]
    names = [names[k] for k in best]
    found = _averaged(envelopes[:, best], rate, first.frequency, 0.005, follow=True)
    passes = sorted(_mean_passes(found, names), key=lambda one: -one.contrast)
    return _knocks(tuple(passes), found)


def _envelopes(recording: Recording, nominal: float) -> tuple[list[tuple[Band, str]], Array, float]:
    """Bands with their directions, envelopes (n, bands) of mean 1, and their sample rate [Hz]."""
    rate = min(3.0 * HARMONICS * nominal, recording.sample_rate)
    time = np.arange(int(recording.duration * rate)) / rate
    bands = [
        band
        for band in split(recording.sample_rate, NARROWEST * nominal)
        if band.low >= LOWEST * nominal or band.high >= 0.4 * recording.sample_rate
    ]
    bands = [Band(max(band.low, LOWEST * nominal), band.high) for band in bands]
    names, columns = [], []
    for direction, samples in zip(recording.directions, recording.acceleration.T, strict=True):
        dropped = signal_faults(samples).dropped
        for found in squared_envelopes(
            samples,
            recording.sample_rate,
            bands,
            HARMONICS * nominal,
            dropped,
            WHITENING * nominal,
            loudest=math.inf,
        ):
            values = np.sqrt(np.maximum(found.values, 0.0))
            values = np.interp(time, np.arange(len(values)) / found.rate, values)
            columns.append(values / values.mean())
            names.append((found.band, direction))
    return names, np.array(columns).T, rate


def _averaged(
    envelopes: Array, rate: float, nominal: float, slip: float, *, follow: bool
) -> BallPasses:
    widest = min(0.9 * HARMONICS * nominal, 0.38 * rate)
    return average_passes(
        envelopes, rate, nominal, slip, nominal, 20.0 * nominal, widest, follow=follow
    )


def _mean_passes(found: BallPasses, names: list[tuple[Band, str]]) -> list[MeanPass]:
    envelopes = found.waveform(PLACES)
    errors = np.sqrt(2.0 * found.scatter.sum(axis=0))
    return [
        MeanPass(band, direction, envelope - np.quantile(envelope, 0.1), float(error))
        for (band, direction), envelope, error in zip(names, envelopes.T, errors, strict=True)
    ]


def _knocks(passes: tuple[MeanPass, ...], found: BallPasses) -> Knocks:
    pairs = [two_peaks(one.envelope, one.error) for one in passes]
    weights = np.array([one.contrast for one in passes])
    separations = np.array([_apart(pair) for pair in pairs])
    separation, deviation = _agreed(separations, weights, [one.band for one in passes])
    resolution = max((ringing(one.envelope) for one in passes), default=math.nan)
    entry = leave = math.nan
    if math.isfinite(separation):
        nearest = int(np.nanargmin(np.abs(separations - separation)))
        pair = pairs[nearest]
        assert pair is not None
        entry, leave = pair
        passes = (passes[nearest], *passes[:nearest], *passes[nearest + 1 :])
    return Knocks(
        passes, found.frequency, found.n_passes, separation, deviation, resolution, entry, leave
    )


def two_peaks(envelope: Array, error: float) -> tuple[float, float] | None:
    """Places of the two highest peaks as shares of a ball pass, entry first; None without two.

    The peak that the other follows by less than half a ball pass is the entry.
    """
    from scipy.ndimage import gaussian_filter1d  # imported late: see `spectrum`

    # knocks far apart before the structure of a single one
    for width in SMOOTHING:
        smooth = gaussian_filter1d(envelope, width * len(envelope), mode="wrap")
        found = _two_peaks(smooth, error)
        if found is not None:
            return found
    return None


def _two_peaks(envelope: Array, error: float) -> tuple[float, float] | None:
    from scipy.signal import find_peaks, peak_prominences

    count = len(envelope)
    turned = np.roll(envelope, -int(envelope.argmin()))
    first = int(turned.argmax())
    places, _ = find_peaks(turned)
    prominence = peak_prominences(turned, places)[0]
    height = turned[places]
    enough = (
        (height >= FAINTEST * turned[first])
        & (prominence >= LEAST_DIP * height)
        & (prominence >= LEAST_CONTRAST * error)
        & (places != first)
    )
    if not enough.any():
        return None
    ranked = np.argsort(height * enough)[::-1]
    if len(ranked) > 1 and enough[ranked[1]] and height[ranked[1]] > THIRD * height[ranked[0]]:
        return None
    second = int(places[ranked[0]])
    shift = int(envelope.argmin())
    entry, leave = sorted((first, second))
    if leave - entry > count // 2:
        entry, leave = leave, entry
    return ((entry + shift) % count) / count, ((leave + shift) % count) / count


def _apart(pair: tuple[float, float] | None) -> float:
    return math.nan if pair is None else (pair[1] - pair[0]) % 1.0


def _agreed(separations: Array, weights: Array, bands: list[Band]) -> tuple[float, float]:
    """The separation on which most of the bands agree, and its deviation; NaN without one."""
    best, share, members = math.nan, 0.0, np.zeros(len(separations), dtype=bool)
    for one in separations[np.isfinite(separations)]:
        near = np.abs(separations - one) <= AGREE * one + 0.1 * AGREE
        reached = float(weights[near].sum())
        if reached > share:
            best, share, members = one, reached, near
    seen = float(weights[np.isfinite(separations)].sum())
    if share == 0.0 or share < AGREEING * seen or share < SHOWING * float(weights.sum()):
        return math.nan, math.nan
    if max(bands[k].low for k in np.flatnonzero(members)) < min(
        bands[k].high for k in np.flatnonzero(members)
    ):
        return math.nan, math.nan  # no two of them without a common frequency
    chosen, by = separations[members], weights[members]
    best = float(np.average(chosen, weights=by))
    spread = math.sqrt(float(np.average((chosen - best) ** 2, weights=by)))
    return best, max(spread, 0.25 / HARMONICS)


def ringing(envelope: Array) -> float:
    """Share of a ball pass around the highest peak in which a fainter one would not be seen.

    The longest way from the peak to where the envelope stays below FAINTEST of it.
    """
    turned = np.roll(envelope, len(envelope) // 2 - int(envelope.argmax()))
    high = np.flatnonzero(turned >= FAINTEST * turned.max())
    middle = len(envelope) // 2
    return float(max(middle - high[0], high[-1] - middle)) / len(envelope)
