"""Entry and exit of a ball in the mean ball pass of envelopes.

A linear prediction removes the ringing. The envelope of each frequency band of the rest is cut into
ball passes, which are aligned against slip and averaged. A ball that enters a spall gives a peak,
and so does a ball that leaves it. Ringing after a single knock also has a second peak where two
resonances beat, but that differs from band to band. So two peaks count only if bands without a
common frequency agree on their separation.

Quantity                                            | Name        | Unit
--------------------------------------------------- | ----------- | --------------
mean envelope over a ball pass                      | envelope    | of its mean
angle of the race between the two peaks             | separation  | rad
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bearingcore.common import Array
from bearingcore.errors import Status
from bearingcore.measured.diagnosis._part.listened_signal import MOST_DROPPED
from bearingcore.measured.signals import BallPasses, average_passes
from bearingcore.measured.signals._dropouts import signal_faults
from bearingcore.measured.signals._filter_bank import Band, split, squared_envelopes
from bearingcore.recordings import Recording

HARMONICS = 100
"""Harmonics of the ball-pass frequency in a mean pass, which resolve a hundredth of a pass."""

NARROWEST = 20.0
"""Least width of a band, in ball-pass frequencies: narrower bands ring for longer."""

LOWEST = 3.0
"""Lower end of the bands, in ball-pass frequencies: below are shaft, cage and rigid bodies."""

PARTS = (1, 2, 3, 4, 6)
"""Numbers of equal bands into which the range is split: in narrower ones knocks are not compact."""

LOW_PARTS = (12, 24)
"""Numbers of bands of which only the lowest two are used: a release is soft, and fades upwards."""

PREDICTED_FROM = 50
"""Samples from which the next one is predicted: two for each of 25 resonances. Ringing can be
predicted and knocks cannot, so compact knocks remain, see `remove_ringing`. With more samples
one knock would predict the next."""

MOST_PASSES_HEARD = 440.0
"""Greatest number of ball passes of a recording that are used; the average takes no more."""

PLACES = 2048
"""Number of places in a mean ball pass."""

LEAST_CONTRAST = 8.0
"""Least height of a visible peak, in standard errors of the mean pass."""

FAINTEST = 0.1
"""Least height of the second peak over the first: prediction and filter leave smaller ripples."""

LEAST_SEEN = 4.0
"""Least height, in standard errors, of a peak at `FAINTEST` for its absence to count."""

THIRD = 0.6
"""Greatest ratio of a third peak's height to the second's; higher ones are a train: ringing."""

LEAST_DIP = 0.25
"""Least fall of the envelope between two separate peaks, relative to the lower one."""

SIDE_LOBES, LEAST_NEAR = 3.0, 0.3
"""A filter responds to a knock with ripples of a fifth of its height. They last a few times the
inverse of its band width [s]: the first number. A second peak within that time must have at least
the second number of the first one's height."""

SMOOTHING = (0.015, 0.007, 0.001)
"""Shares of a ball pass over which a mean pass is smoothed before its peaks are searched."""

AGREE = (0.06, 0.002)
"""Greatest shift of a peak between bands: a share of the separation, plus one of a ball pass. A
release is gradual: its peak moves a little with frequency. No peak is sharper than a mean pass."""

AGREEING, SHOWING = 0.6, 0.4
"""Least share of the second peaks, by their heights, that agree, and of the bands that show them.
Bands above the highest of these do not count."""

ONLY_ONE = 0.3
"""Greatest share of the bands with a second peak if there is only one knock."""

ALIKE, UNLIKE = 0.3, 0.22
"""A ball is released softly and strikes hard: entry and exit differ in their spectra. Two knocks
are a blow and its echo, from a ball that bounces, if the ratio of their heights hardly changes over
the bands (four fifths of its natural logarithms lie within the first number) and they are not
equally high (the logarithm of their ratio is above the second)."""

RARE = 5.0
"""Least ratio of the longer way between both peaks to the shorter at which the shorter is the
spall: one that nearly reaches the next ball is rare. Below, either way may be from entry to exit.
Spectra do not decide it: real structures ring higher as a ball leaves. In the model without mass
the entry is mostly the sharper peak, and with mass it may be either."""

MOST_FADING = 0.75
"""Power of frequency with which the later peak fades against the earlier. Above it the two are not
entry and exit, but a blow with a duller echo or rebound."""

STEADY, LEAST_LEFT, MOST_CUTS = 0.05, 0.3, 4
"""Greatest relative deviation of a ball pass from the mean: a cage has inertia. Where passes seem
to jump by more, some were aligned with the wrong knock, and one knock looks like two. Then the
longer part beside the jump is averaged alone, if it has at least the second number as its share of
the signal; the third is the greatest number of such cuts."""


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
        over one ball pass, less its 10 % quantile; in units of the mean over the whole signal.
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
class Pair:
    """Two peaks of a mean pass.

    Attributes
    ----------
    first, second
        their places as shares of a ball pass; the second follows within half a pass.
    ratio
        height of the second over that of the first.
    third
        height of a third peak over that of the lower one of both; 0 without a third peak.
    """

    first: float
    second: float
    ratio: float
    third: float = 0.0

    @property
    def apart(self) -> float:
        """Separation of the first knock and the second, as a share of a ball pass."""
        return (self.second - self.first) % 1.0

    @property
    def height(self) -> float:
        """Height of the lower peak over the higher one."""
        return min(self.ratio, 1.0 / self.ratio)


class ExtentStatus(Status):
    """The outcome of a measurement of the extent."""

    MEASURED = "measured", "Entry and exit are separate in the mean ball pass."
    EITHER = "either way round", "Entry and exit are separate, but it is not clear which is which."
    SHORTER = "shorter", "Entry and exit are too close together to be separated."
    ONE_KNOCK = (
        "one knock",
        "There is one impact a ball pass: from a pit, or a longer spall with a faint entry.",
    )
    UNCLEAR = (
        "unclear",
        "Frequency bands do not agree on two impacts a ball pass: ringing hides them, or the "
        "balls meet the damage differently.",
    )
    BOUNCES = (
        "bounces",
        "Two impacts a ball pass differ in height, and the later is no sharper than the "
        "earlier: a ball that bounces or an echo, not entry and exit.",
    )
    NO_RACE = "no race", "No damaged race is named, so there is no extent to measure."
    NOT_VISIBLE = "not visible", "Nothing repeats clearly with the ball passes of this race."
    TOO_SHORT = "too short", "The recording holds too few ball passes for a mean."
    TOO_COARSE = "too coarse", "The sample rate is too low to locate impacts on the race."


@dataclass(frozen=True)
class Knocks:
    """Knocks in the mean passes.

    Attributes
    ----------
    passes
        mean passes of the compared bands; the first shows the knocks best.
    frequency
        ball passes a second [Hz].
    n_passes
        number of averaged passes.
    status
        the result of all bands together.
    separation, deviation
        from entry to exit as a share of a ball pass, the shorter way round, and its standard
        deviation; NaN where there are no two knocks.
    entry, exit
        places of the two peaks in the first of `passes`, as shares of a ball pass, the shorter way
        round; NaN without two peaks.
    hidden
        share of a ball pass within which a second knock may hide in the ringing of the first; NaN
        where it may be anywhere, or where there are two.
    """

    passes: tuple[MeanPass, ...]
    frequency: float
    n_passes: int
    status: ExtentStatus
    separation: float = math.nan
    deviation: float = math.nan
    entry: float = math.nan
    exit: float = math.nan
    hidden: float = math.nan


def find_knocks(recording: Recording, nominal: float, slip: float, turns: float = 0.0) -> Knocks:
    """Compute the mean ball passes of a recording and find the knocks in them.

    Parameters
    ----------
    nominal, slip
        ball passes a second [Hz] over the damaged race, and their largest relative deviation.
    turns
        turns of the damage through the load zone in a ball pass: 0 on a race that stands still.

    Raises
    ------
    ValueError
        for a recording with too few ball passes.
    """
    names, envelopes, rate = _envelopes(recording, nominal)
    if not names:
        return Knocks((), nominal, 0, ExtentStatus.NOT_VISIBLE)
    widest = min(0.9 * HARMONICS * nominal, 0.38 * rate)
    highest = min(20.0 * nominal, widest)
    part = envelopes
    for _ in range(MOST_CUTS):
        ball_passes = average_passes(
            part, rate, nominal, slip, nominal, highest, widest, follow=True, turns=turns
        )
        passes = _mean_passes(ball_passes, names)
        jump = _jump(ball_passes)
        if jump is None:
            return compare_bands(passes, ball_passes.frequency, ball_passes.n_passes)
        place = round(jump * rate)
        part = part[:place] if place > len(part) // 2 else part[place:]
        if len(part) < LEAST_LEFT * len(envelopes):
            break
    return Knocks(tuple(passes), ball_passes.frequency, ball_passes.n_passes, ExtentStatus.UNCLEAR)


def _jump(passes: BallPasses) -> float | None:
    """Return the time [s] of the greatest jump between passes; None if they are steady."""
    if passes.begins is None:
        return None
    excess = np.abs(np.diff(passes.begins) * passes.frequency - 1.0)
    worst = int(excess.argmax())
    return float(passes.begins[worst]) if excess[worst] > STEADY else None


def _envelopes(recording: Recording, nominal: float) -> tuple[list[tuple[Band, str]], Array, float]:
    """Return bands with directions, envelopes (n, bands) of mean 1, and their sample rate [Hz]."""
    sample_rate = recording.sample_rate
    rate = min(3.0 * HARMONICS * nominal, sample_rate)
    kept = min(
        recording.acceleration.shape[0], math.ceil(MOST_PASSES_HEARD * sample_rate / nominal)
    )
    time = np.arange(int(kept / sample_rate * rate)) / rate
    bands = [
        Band(max(band.low, LOWEST * nominal), band.high)
        for band in split(sample_rate, NARROWEST * nominal, (*PARTS, *LOW_PARTS))
        if band.high > 2.0 * LOWEST * nominal
        and (
            band.high - band.low > 0.45 * sample_rate / PARTS[-1]
            or band.low < 1.01 * (band.high - band.low)  # the first or second of LOW_PARTS
        )
    ]
    names, columns = [], []
    for direction, samples in zip(
        recording.directions, recording.acceleration[:kept].T, strict=True
    ):
        faults = signal_faults(samples)
        if faults.lost_share > MOST_DROPPED:
            continue
        dropped = faults.dropped
        residual = remove_ringing(np.where(dropped, 0.0, samples), PREDICTED_FROM)
        for envelope in squared_envelopes(
            residual, sample_rate, bands, HARMONICS * nominal, dropped, loudest=math.inf
        ):
            values = np.sqrt(np.maximum(envelope.values, 0.0))
            values = np.interp(time, np.arange(len(values)) / envelope.rate, values)
            columns.append(values / values.mean())
            names.append((envelope.band, direction))
    return names, np.array(columns).T, rate


def remove_ringing(samples: Array, order: int) -> Array:
    """Return the error of a linear prediction of a signal (n,) from the `order` samples before.

    The prediction with the least squared error (Yule and Walker) follows tones and ringing. Its
    error is what excites them, with a flat spectrum.
    """
    from scipy.fft import irfft, next_fast_len, rfft
    from scipy.linalg import solve_toeplitz
    from scipy.signal import lfilter

    samples = samples - samples.mean()
    size = next_fast_len(len(samples) + order + 1, real=True)
    correlation = irfft(np.abs(rfft(samples, size)) ** 2, size)[: order + 1]
    if not correlation[0] > 0.0:
        return samples
    correlation[0] *= 1.0 + 1e-6  # keeps the equations regular
    weights = solve_toeplitz(correlation[:-1], correlation[1:])
    return np.asarray(lfilter(np.concatenate(([1.0], -weights)), [1.0], samples))


def _mean_passes(passes: BallPasses, names: list[tuple[Band, str]]) -> list[MeanPass]:
    envelopes = passes.waveform(PLACES)
    errors = np.sqrt(2.0 * passes.scatter.sum(axis=0))
    return [
        MeanPass(band, direction, envelope - np.quantile(envelope, 0.1), float(error))
        for (band, direction), envelope, error in zip(names, envelopes.T, errors, strict=True)
    ]


def compare_bands(passes: Sequence[MeanPass], frequency: float, n_passes: int) -> Knocks:
    """Return the knocks on which the mean passes of several bands agree.

    Parameters
    ----------
    passes
        of any bands and directions.
    frequency
        ball passes a second [Hz].
    n_passes
        number of averaged passes.
    """
    passes = tuple(sorted(passes, key=lambda mean_pass: -mean_pass.contrast))
    if not passes or passes[0].contrast < LEAST_CONTRAST:
        return Knocks(passes, frequency, n_passes, ExtentStatus.NOT_VISIBLE)
    pairs = [(m, pair) for m in passes if (pair := two_peaks(m, frequency)) is not None]
    agreeing = _agreeing(pairs)
    if not agreeing:
        several = len(pairs) > ONLY_ONE * len(passes)
        status = ExtentStatus.UNCLEAR if several else ExtentStatus.ONE_KNOCK
        return Knocks(passes, frequency, n_passes, status, hidden=_hidden(passes))
    height = np.array([pair.height for _, pair in agreeing])
    ratios = np.log([pair.ratio for _, pair in agreeing])
    # most bands must agree, up to the highest that does: above it a soft release may not show
    highest = max(mean_pass.band.low for mean_pass, _ in agreeing)
    counted = sum(mean_pass.band.low <= highest for mean_pass in passes)
    heights = sum(pair.height for mean_pass, pair in pairs if mean_pass.band.low <= highest)
    if len(agreeing) < SHOWING * counted or height.sum() < AGREEING * heights:
        return Knocks(passes, frequency, n_passes, ExtentStatus.UNCLEAR, hidden=_hidden(passes))
    if np.ptp(np.quantile(ratios, (0.1, 0.9))) < ALIKE and abs(np.median(ratios)) > UNLIKE:
        return Knocks(passes, frequency, n_passes, ExtentStatus.BOUNCES)
    # the mean separation in the agreeing bands, weighted by heights
    apart = np.array([pair.apart for _, pair in agreeing])
    separation = float(np.average(apart, weights=height))
    spread = math.sqrt(float(np.average((apart - separation) ** 2, weights=height)))
    trend = _trend([mean_pass.band for mean_pass, _ in agreeing], ratios, height)
    rare = 1.0 - separation > RARE * separation
    # a later peak that fades with frequency is an echo, not an exit
    if rare and (trend < -MOST_FADING or (trend < 0.0 and _fades(passes, highest, ratios))):
        return Knocks(passes, frequency, n_passes, ExtentStatus.BOUNCES)
    best, pair = max(agreeing, key=lambda agreeing_pair: agreeing_pair[1].height)
    return Knocks(
        (best, *(mean_pass for mean_pass in passes if mean_pass is not best)),
        frequency,
        n_passes,
        ExtentStatus.MEASURED if rare else ExtentStatus.EITHER,
        separation,
        max(spread, 0.25 / HARMONICS),
        pair.first,
        pair.second,
    )


def _hidden(passes: Sequence[MeanPass]) -> float:
    """Return the share of a ball pass around the highest peak in which a second may hide.

    Beyond it every band has fallen below `FAINTEST` of the peak, so that a second knock would show.
    A release shows best in the lowest bands: NaN if these do not stand out of the noise.
    """
    from scipy.ndimage import gaussian_filter1d

    clear = [mean_pass for mean_pass in passes if _is_clear(mean_pass)]
    if not clear or min(m.band.low for m in clear) > min(m.band.low for m in passes):
        return math.nan
    farthest = 0.0
    for mean_pass in clear:
        smooth = gaussian_filter1d(mean_pass.envelope, SMOOTHING[1] * PLACES, mode="wrap")
        above = np.flatnonzero(smooth > FAINTEST * smooth.max()) - int(smooth.argmax())
        distance = np.abs((above + PLACES // 2) % PLACES - PLACES // 2)
        farthest = max(farthest, float(distance.max()) / PLACES)
    return farthest


def _fades(passes: Sequence[MeanPass], highest: float, ratios: Array) -> bool:
    """Return True if the later peak is fainter, and missing in a clear band above `highest` [Hz].

    An exit is the sharper of the two. Echoes and rebounds fade with frequency.
    """
    above = any(mean_pass.band.low > highest and _is_clear(mean_pass) for mean_pass in passes)
    return above and float(np.median(ratios)) < 0.0


def _is_clear(mean_pass: MeanPass) -> bool:
    """Return True if even the faintest second peak would stand out of a band's noise."""
    return FAINTEST * mean_pass.contrast > LEAST_SEEN


def _trend(bands: list[Band], ratios: Array, weights: Array) -> float:
    """Return the weighted slope of logarithms of ratios over the logarithm of frequency."""
    octave = np.log([0.5 * (band.low + band.high) for band in bands])
    octave -= np.average(octave, weights=weights)
    return float((weights * octave * ratios).sum() / max((weights * octave**2).sum(), 1e-12))


def two_peaks(mean_pass: MeanPass, frequency: float) -> Pair | None:
    """Return the two highest peaks of a mean pass; None if there are fewer.

    Parameters
    ----------
    mean_pass
    frequency
        ball passes a second [Hz].
    """
    from scipy.ndimage import gaussian_filter1d  # imported late: see `spectrum`

    lobes = SIDE_LOBES * frequency / (mean_pass.band.high - mean_pass.band.low)
    # smooth less and less: separate knocks show before the structure of a single one
    train = None
    for width in SMOOTHING:
        smooth = gaussian_filter1d(mean_pass.envelope, width * PLACES, mode="wrap")
        pair = _two_peaks(smooth, mean_pass.error, lobes)
        if pair is not None and pair.third <= THIRD:
            return pair
        train = train or pair
    return train


def _two_peaks(envelope: Array, error: float, lobes: float) -> Pair | None:
    """Return the two highest peaks of a smooth envelope; `lobes` is the reach of ripples."""
    from scipy.signal import find_peaks, peak_prominences

    shift = int(envelope.argmin())
    turned = np.roll(envelope, -shift)
    highest = int(turned.argmax())
    places, _ = find_peaks(turned)
    prominence = peak_prominences(turned, places)[0]
    height = turned[places]
    distance = np.abs(places - highest) / PLACES
    near = np.minimum(distance, 1.0 - distance) < lobes
    enough = (
        (height >= np.where(near, LEAST_NEAR, FAINTEST) * turned[highest])
        & (prominence >= LEAST_DIP * height)
        & (prominence >= LEAST_CONTRAST * error)
        & (places != highest)
    )
    if not enough.any():
        return None
    ranked = np.argsort(height * enough)[::-1]
    third = 0.0
    if len(ranked) > 1 and enough[ranked[1]]:
        third = float(height[ranked[1]] / height[ranked[0]])
    first, second = sorted((highest, int(places[ranked[0]])))
    if second - first > PLACES // 2:
        first, second = second, first
    ratio = float(turned[second] / turned[first])
    return Pair((first + shift) % PLACES / PLACES, (second + shift) % PLACES / PLACES, ratio, third)


def _distance(pair: Pair, other: Pair) -> float:
    """Return the greatest distance of a peak from the other pair's, as a share of a ball pass."""
    return max(
        abs((place - other_place + 0.5) % 1.0 - 0.5)
        for place, other_place in ((pair.first, other.first), (pair.second, other.second))
    )


def _agreeing(pairs: list[tuple[MeanPass, Pair]]) -> list[tuple[MeanPass, Pair]]:
    """Return the largest group, by height, of mean passes with two peaks at the same places.

    Empty if all their bands have a frequency in common, because one resonance may beat.
    """
    best: list[tuple[MeanPass, Pair]] = []
    only_two = [(m, pair) for m, pair in pairs if pair.third <= THIRD]
    for _, other in only_two:
        reach = AGREE[0] * other.apart + AGREE[1]
        near = [(m, pair) for m, pair in only_two if _distance(pair, other) <= reach]
        if sum(pair.height for _, pair in near) > sum(pair.height for _, pair in best):
            best = near
    bands = [m.band for m, _ in best]
    if not bands or max(band.low for band in bands) < min(band.high for band in bands):
        return []
    return best
