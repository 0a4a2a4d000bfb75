"""Averages over ball passes: the mean signal while one ball follows another.

Balls roll over an outer-race defect N_b f_c times a second. The part of a signal that repeats with
the balls adds up over the passes; everything else, mostly noise, averages out.

Quantity                                         | Symbol  | Name      | Unit
------------------------------------------------ | ------- | --------- | -------------
true ball-pass frequency, with slip              | f       | frequency | Hz
mean Fourier coefficients of a pass, at n f      | D_n     | harmonics | of the signal
mean of their squared sizes, pass by pass        | ⟨|·|²⟩  | power     | its square
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, _checks as checks
from bearingcore.measured.signals._order_tracking import follow_lags, smooth_lag
from bearingcore.measured.signals._resampling import oversample

FEWEST_PASSES = 6
"""Fewest passes of an average whose scatter can be estimated."""

CUT = 0.3
"""Share of the lowest frequency below which a signal is filtered out."""

MOST_PASSES = 400
"""Greatest number of averaged passes: cages do not keep their speed for longer."""

SAMPLES_A_CYCLE = 6.0
"""Samples in a cycle of the highest frequency, before a signal is cut into passes."""


@dataclass(frozen=True)
class BallPasses:
    """Fourier coefficients of a signal at the harmonics 1 … N of its ball-pass frequency.

    Attributes
    ----------
    frequency
        f [Hz], ball passes a second.
    n_passes
        number of averaged passes.
    harmonics : (N, d)
        mean coefficient of each harmonic and direction; twice its size is the amplitude.
    power : (N, d)
        mean squared size of the coefficients of single passes.
    begins : (passes + 1,) [s] or None
        times at which the passes begin and the last one ends, if a wandering cage was followed;
        None for a steady cage.
    """

    frequency: float
    n_passes: int
    harmonics: NDArray[np.complex128]
    power: Array
    begins: Array | None = None

    @property
    def scatter(self) -> Array:
        """Variance (N, d) of `harmonics`, from the differences between passes."""
        variance = self.power - np.abs(self.harmonics) ** 2
        return np.asarray(np.maximum(variance, 0.0) / max(self.n_passes - 1, 1))

    def waveform(self, n: int) -> Array:
        """Return the mean pass as n samples (n, d)."""
        full = np.zeros((n // 2 + 1, self.harmonics.shape[1]), dtype=complex)
        count = min(len(self.harmonics), n // 2)
        full[1 : count + 1] = self.harmonics[:count]
        return np.asarray(np.fft.irfft(full, n, axis=0) * n)

    @property
    def harmonic_frequency(self) -> Array:
        """Frequencies (N,) [Hz] of the harmonics."""
        return np.asarray(self.frequency * np.arange(1, len(self.harmonics) + 1), dtype=float)


def coefficients(passes: Array, count: int) -> NDArray[np.complex128]:
    """Return coefficients (passes, count, d) at harmonics 1 … count of signals (passes, n, d)."""
    return np.fft.rfft(passes, axis=1)[:, 1 : count + 1] / passes.shape[1]


def least_passes(nominal: float, lowest: float) -> int:
    """Return the fewest ball passes for `average_passes`, including those that its filter spoils.

    Parameters
    ----------
    nominal, lowest
        [Hz] as in `average_passes`.
    """
    return FEWEST_PASSES + 2 * _margin(nominal, lowest) + 1


def _margin(nominal: float, lowest: float) -> int:
    """Return the number of ball passes at either end of a signal in which the filter rings."""
    return math.ceil(1.5 * nominal / (CUT * lowest))


def average_passes(
    signal: Array,
    sample_rate: float,
    nominal: float,
    slip: float,
    lowest: float,
    highest: float,
    widest: float,
    *,
    follow: bool = False,
    turns: float = 0.0,
) -> BallPasses:
    """Find the ball-pass frequency near `nominal` and average the signal over its passes.

    Parameters
    ----------
    signal : (n, d)
    sample_rate, nominal
        [Hz]
    lowest, highest, widest
        [Hz]: the frequency is searched by its harmonics from `lowest` to `highest`; harmonics up
        to `widest` are kept; frequencies well below `lowest` are filtered out.
    slip
        largest relative deviation of the frequency from the nominal one.
    follow
        True if a cage that wanders is followed, see `_order_tracking`.
    turns
        turns of the damage through the load zone in a ball pass, without slip; 0 where it does not
        move. Passes of damage that turns are weighted by the loudness that its angle gives them.

    Raises
    ------
    ValueError
        for a signal that is too short for FEWEST_PASSES ball passes.
    """
    from scipy.interpolate import make_interp_spline  # imported late: see `spectrum`
    from scipy.signal import butter, sosfiltfilt

    cut, margin = CUT * lowest, _margin(nominal, lowest)
    least = least_passes(nominal, lowest) / (nominal * (1.0 - slip))
    if len(signal) / sample_rate < least:
        raise checks.refuse(
            "signal",
            f"of {len(signal) / sample_rate:.3g} s",
            f"at least {least:.3g} s, {least_passes(nominal, lowest)} ball passes",
        )
    if sample_rate < 2.5 * widest * (1.0 - 1e-9):  # rounding may make 2.5 · 0.4 more than 1
        raise checks.refuse("sample_rate", sample_rate, f"at least {2.5 * widest:.0f} Hz")
    kept = min(len(signal), math.ceil((MOST_PASSES + 2 * margin + 1) * sample_rate / nominal))
    signal = signal[:kept] - signal[:kept].mean(axis=0)
    sections = butter(4, cut, "highpass", fs=sample_rate, output="sos")
    signal = sosfiltfilt(sections, signal, axis=0)
    frequency = _ball_pass_frequency(signal, sample_rate, nominal, slip, lowest, highest)
    # a spline follows the signal only with enough samples in a cycle
    factor = max(math.ceil(SAMPLES_A_CYCLE * widest / sample_rate), 1)
    signal, sample_rate = oversample(signal, factor), factor * sample_rate
    # the filter rings at both ends of the signal: the passes there are left out
    n_passes = math.floor((len(signal) - 1) / sample_rate * frequency) - 2 * margin
    n = math.ceil(max(sample_rate, 4.0 * widest) / frequency)
    curve = make_interp_spline(np.arange(len(signal)) / sample_rate, signal, k=5)
    count = math.floor(widest / frequency)
    place = np.arange(n_passes * n) / n

    def cut_passes(lags: Array | None) -> NDArray[np.complex128]:
        late = 0.0 if lags is None else smooth_lag(lags)(place) / (2.0 * math.pi)
        time = np.clip((margin + place + late) / frequency, 0.0, (len(signal) - 1) / sample_rate)
        return coefficients(curve(time).reshape(n_passes, n, signal.shape[1]), count)

    lags = follow_lags(cut_passes, n_passes, slip) if follow else None
    passes, begins = cut_passes(lags), None
    if lags is not None:
        ends = np.arange(n_passes + 1.0)
        begins = (margin + ends + smooth_lag(lags)(ends) / (2.0 * math.pi)) / frequency
        frequency = n_passes / float(begins[-1] - begins[0])
    mean, power = passes.mean(axis=0), (np.abs(passes) ** 2).mean(axis=0)
    if turns:
        mean, power = _weighted_mean(passes, load_zone_weights(passes, turns, slip))
    return BallPasses(frequency, n_passes, mean, power, begins)


def load_zone_weights(passes: NDArray[np.complex128], turns: float, slip: float) -> Array:
    """Return the loudness (n,) of ball passes whose damage turns through the load zone; mean 1.

    The share of the mean pass in each pass, with coefficients weighted by their scatter, is fitted
    by a constant and two harmonics of the turn. Any other difference between passes is chance.

    Parameters
    ----------
    passes : (n, N, d)
        coefficients of each.
    turns, slip
        turns of the damage in a ball pass, and their largest relative deviation.
    """
    mean = passes.mean(axis=0)
    scatter = (np.abs(passes - mean) ** 2).mean(axis=0) + 1e-300
    shares = np.real(np.tensordot(passes, np.conj(mean) / scatter, 2))
    best, least = np.ones(len(passes)), np.inf
    # between trials the angle at the last pass changes by a sixteenth of a turn
    count = max(1, math.ceil(16.0 * turns * slip * len(passes)))
    for trial in turns * (1.0 + slip * np.linspace(-1.0, 1.0, 2 * count + 1)):
        angle = 2.0 * math.pi * trial * np.arange(len(passes))
        waves = np.stack(
            [np.ones_like(angle), *(f(k * angle) for k in (1.0, 2.0) for f in (np.cos, np.sin))], 1
        )
        fit = waves @ np.linalg.lstsq(waves, shares)[0]
        residual = float(((shares - fit) ** 2).sum())
        if residual < least:
            best, least = np.maximum(fit, 0.0), residual
    return np.asarray(best / best.mean())


def _weighted_mean(
    passes: NDArray[np.complex128], weights: Array
) -> tuple[NDArray[np.complex128], Array]:
    """Return the pass m that fits passes x as w m with least squares, and the `power` of n equal
    passes that would have the same scatter.
    """
    squares = float((weights**2).sum())
    mean = np.tensordot(weights, passes, 1) / squares
    deviation = np.abs(passes - weights[:, None, None] * mean) ** 2
    variance = np.tensordot(weights**2, deviation, 1) / squares**2
    return mean, np.abs(mean) ** 2 + len(passes) * variance


def _ball_pass_frequency(
    signal: Array, sample_rate: float, nominal: float, slip: float, lowest: float, highest: float
) -> float:
    """Return the frequency [Hz] near the nominal one whose harmonics have the highest lines."""
    from scipy.fft import next_fast_len

    n = len(signal)
    size = next_fast_len(4 * n)
    transform = np.fft.rfft(signal * np.hanning(n)[:, None], size, axis=0)
    # lines count by height, because by power the strongest resonance would decide alone
    height = np.abs(transform).sum(axis=1)
    step = sample_rate / size
    order = np.arange(
        max(1, math.ceil(lowest / nominal)), math.floor(highest / (nominal * (1.0 + slip))) + 1
    )

    def comb(frequencies: Array) -> Array:
        return height[np.rint(frequencies[:, None] * (order / step)).astype(int)].sum(axis=1)

    # trials a tenth of a line's width apart at the highest harmonic, then finer around the best
    spacing = 0.2 * sample_rate / n / order[-1]
    trials = nominal + spacing * np.arange(
        -math.ceil(slip * nominal / spacing), math.ceil(slip * nominal / spacing) + 1
    )
    fine = trials[comb(trials).argmax()] + spacing * np.linspace(-1.0, 1.0, 41)
    heights = comb(fine)
    top = heights >= heights.max() - 1e-3 * abs(heights.max())
    return float(fine[top].mean())
