"""Following a cage whose speed wanders, by the ball passes themselves.

Neighbouring passes are alike. The delay between them therefore shows the speed of the balls at that
time. The sum of the delays aligns all passes roughly; then each pass is aligned with their mean.
The mean becomes sharper with every round, and so does the alignment.

Quantity                                   | Symbol | Name   | Unit
------------------------------------------ | ------ | ------ | ----
Fourier coefficients of pass p             | c_pn   | passes | of the signal
delay of pass p                            | λ_p    | lags   | rad, 2π a pass
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, summit

NEIGHBOURS = 3.0
"""Pairs of passes over which their delay is smoothed (standard deviation of a Gaussian)."""

SMOOTHING = 1.5
"""Passes over which their lag to the mean is smoothed (standard deviation of a Gaussian)."""

ROUNDS = 4
"""Number of rounds of alignment with the mean before the signal is cut into passes again."""

WIDEST = 0.5
"""Largest angle [rad] by which a pass is moved in the first round."""

TRIAL_LAGS = 201

MOST_CUTS = 8
"""Greatest number of times that the signal is cut again after an alignment."""

LEAST_GAIN = 0.01
"""Least rise of the share of power that repeats: noise alone stays below it."""


def follow_lags(
    cut: Callable[[Array], NDArray[np.complex128]], n_passes: int, slip: float
) -> Array | None:
    """Return the lags (passes,) of a cage that wanders; None for a steady cage.

    Parameters
    ----------
    cut
        returns the coefficients (passes, N harmonics, d directions) of passes cut late by lags.
    slip
        largest relative deviation of the ball-pass frequency.
    """
    steady = cut(np.zeros(n_passes))
    # zero lags are the best start for a nearly steady cage, summed delays for any other
    starts = np.zeros(n_passes), _sum_delays(steady, slip)
    share, lags = max((_align(cut, start) for start in starts), key=lambda fit: fit[0])
    return lags if share >= _repeating_share(steady) + LEAST_GAIN else None


def _align(cut: Callable[[Array], NDArray[np.complex128]], lags: Array) -> tuple[float, Array]:
    """Align passes with their mean until the repeating share stops growing; return it and lags."""
    passes = cut(lags)
    share = _repeating_share(passes)
    for _ in range(MOST_CUTS):
        new_lags = lags + _lags_to_mean(passes)
        passes = cut(new_lags)
        new_share = _repeating_share(passes)
        if new_share < share:
            break
        gain, share, lags = new_share - share, new_share, new_lags
        if gain < 0.2 * LEAST_GAIN:
            break
    return share, lags


def smooth_lag(lags: Array) -> Callable[[Array], Array]:
    """Return the lag [rad] as a function of place, counted in passes from the start.

    Beyond the middles of the first and the last pass the lag is a straight line.
    """
    from scipy.interpolate import CubicSpline  # imported late: see `spectrum`

    middles = np.arange(len(lags)) + 0.5
    spline = CubicSpline(middles, lags, bc_type="natural")
    ends = middles[[0, -1]]
    slopes = spline(ends, 1)

    def lag_at(place: Array) -> Array:
        inside = np.clip(place, ends[0], ends[1])
        before, after = np.minimum(place - ends[0], 0.0), np.maximum(place - ends[1], 0.0)
        return np.asarray(spline(inside) + slopes[0] * before + slopes[1] * after)

    return lag_at


def _repeating_share(passes: NDArray[np.complex128]) -> float:
    """Return the share of the power of passes (p, N, d) in their mean; directions are averaged."""
    mean = (np.abs(passes.mean(axis=0)) ** 2).sum(axis=0)
    return float((mean / np.maximum((np.abs(passes) ** 2).mean(axis=0).sum(axis=0), 1e-300)).mean())


def _sum_delays(passes: NDArray[np.complex128], slip: float) -> Array:
    """Return lags (p,) [rad] as sums of the delays between neighbours."""
    power = np.maximum((np.abs(passes) ** 2).mean(axis=0), 1e-300)
    cross = (passes[1:] * passes[:-1].conj() / power).sum(axis=2)
    # a tone that is no harmonic has another phase in each pair, which lowers its coherence
    coherence = np.abs(cross.mean(axis=0)) / passes.shape[2]
    cross = _smooth_rows(cross * coherence, NEIGHBOURS)
    reach = 2.0 * math.pi * (slip + 0.01)
    delay = _best_lag(cross, np.linspace(-reach, reach, TRIAL_LAGS))
    return np.concatenate(([0.0], np.cumsum(delay)))


def _lags_to_mean(passes: NDArray[np.complex128]) -> Array:
    """Return further lags (p,) [rad] of roughly aligned passes against their mean."""
    order = np.arange(1, passes.shape[1] + 1)
    lags = np.zeros(len(passes))
    for number in range(ROUNDS):
        turned = passes * np.exp(1j * lags[:, None] * order)[:, :, None]
        mean = turned.mean(axis=0)
        variance = np.maximum((np.abs(turned) ** 2).mean(axis=0) - np.abs(mean) ** 2, 0.0)
        variance += 1e-3 * (np.abs(mean) ** 2).max(axis=0)
        cross = (turned * mean.conj() / variance).sum(axis=2)
        reach = WIDEST / 2.0**number
        lags += _best_lag(_smooth_rows(cross, SMOOTHING), np.linspace(-reach, reach, TRIAL_LAGS))
        lags -= lags.mean()
    return lags


def _best_lag(cross: NDArray[np.complex128], lag: Array) -> Array:
    """Return the lags (p,) with the greatest correlation, from cross spectra (p, N) on a grid."""
    order = np.arange(1, cross.shape[1] + 1)
    correlation = (cross @ np.exp(1j * np.outer(order, lag))).real
    best = np.clip(correlation.argmax(axis=1), 1, len(lag) - 2)
    row = np.arange(len(cross))
    shift = summit(*(correlation[row, best + k] for k in (-1, 0, 1)))
    return np.asarray(lag[best] + shift * (lag[1] - lag[0]))


def _smooth_rows(values: NDArray[np.complex128], width: float) -> NDArray[np.complex128]:
    """Average rows (p, N) with their neighbours by a Gaussian of `width` rows."""
    row = np.arange(len(values))
    weight = np.exp(-0.5 * ((row[:, None] - row) / width) ** 2)
    return np.asarray((weight / weight.sum(axis=1, keepdims=True)) @ values)
