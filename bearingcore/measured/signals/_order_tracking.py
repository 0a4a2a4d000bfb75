"""Following a cage whose speed wanders, by the ball passes themselves.

One pass is much like the next, whatever it looks like. So the delay between neighbours shows how
fast balls pass just then; added up it aligns all passes roughly, and each is then laid over their
mean. The mean sharpens with every round, and with it what it is compared with.

Quantity                                   | Symbol | Name  | Unit
------------------------------------------ | ------ | ----- | ----
Fourier coefficients of pass p             | c_pn   | each  | of the signal
by how much pass p is late                 | λ_p    | lags  | rad, 2π a pass
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, summit

NEIGHBOURS = 3.0
"""Pairs of passes over which their delay is smoothed (standard deviation of a Gaussian)."""

TOGETHER = 1.5
"""Passes that are laid over the mean together (standard deviation)."""

ROUNDS = 4
"""Number of rounds: passes are laid over their mean, then they are cut anew."""

WIDEST = 0.5
"""Largest angle [rad] by which a pass is moved in a round."""

GRID = 201

MOST_CUTS = 8
"""Times that passes are cut anew after they were laid over their mean."""

LEAST_GAIN = 0.01
"""Least rise of the share of power that repeats: noise alone stays below it."""


def followed(
    cut: Callable[[Array], NDArray[np.complex128]], n_passes: int, slip: float
) -> Array | None:
    """Lags (passes,) of the passes of a cage that wanders; None where it does not.

    Parameters
    ----------
    cut
        gives the coefficients (passes, N, d) of passes that are late by some lags (passes,).
    slip
        fraction by which the ball-pass frequency may be off.
    """
    steady = cut(np.zeros(n_passes))
    # a cage that hardly wanders is nearest to a steady one, another to its neighbours' delays
    starts = np.zeros(n_passes), _added_up(steady, slip)
    share, lags = max((_settled(cut, start) for start in starts), key=lambda fit: fit[0])
    return lags if share >= _repeating(steady) + LEAST_GAIN else None


def _settled(cut: Callable[[Array], NDArray[np.complex128]], lags: Array) -> tuple[float, Array]:
    """Lags (passes,) laid over their mean until no more repeats, and the share that repeats."""
    each = cut(lags)
    share = _repeating(each)
    for _ in range(MOST_CUTS):
        closer = lags + _laid_over_the_mean(each)
        each = cut(closer)
        reached = _repeating(each)
        if reached < share:
            break
        gained, share, lags = reached - share, reached, closer
        if gained < 0.2 * LEAST_GAIN:
            break
    return share, lags


def smooth_lag(lags: Array) -> Callable[[Array], Array]:
    """Lag [rad] at any place, counted in passes from the first one's begin, from those of passes.

    Straight on beyond the middles of the first and the last pass.
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


def _repeating(each: NDArray[np.complex128]) -> float:
    """Share of the power of passes (p, N, d) that their mean has; directions count alike."""
    mean = (np.abs(each.mean(axis=0)) ** 2).sum(axis=0)
    return float((mean / np.maximum((np.abs(each) ** 2).mean(axis=0).sum(axis=0), 1e-300)).mean())


def _added_up(each: NDArray[np.complex128], slip: float) -> Array:
    """Lags (p,) [rad] from the delays between neighbours."""
    power = np.maximum((np.abs(each) ** 2).mean(axis=0), 1e-300)
    cross = (each[1:] * each[:-1].conj() / power).sum(axis=2)
    # tones that are no harmonics have a different turn in each pair: what does not repeat fades
    coherence = np.abs(cross.mean(axis=0)) / each.shape[2]
    cross = _smoothed(cross * coherence, NEIGHBOURS)
    reach = 2.0 * math.pi * (slip + 0.01)
    delay = _greatest(cross, np.linspace(-reach, reach, GRID))
    return np.concatenate(([0.0], np.cumsum(delay)))


def _laid_over_the_mean(each: NDArray[np.complex128]) -> Array:
    """Further lags (p,) [rad] by which passes, aligned roughly, fit their mean."""
    order = np.arange(1, each.shape[1] + 1)
    lags = np.zeros(len(each))
    for number in range(ROUNDS):
        turned = each * np.exp(1j * lags[:, None] * order)[:, :, None]
        mean = turned.mean(axis=0)
        around = np.maximum((np.abs(turned) ** 2).mean(axis=0) - np.abs(mean) ** 2, 0.0)
        around += 1e-3 * (np.abs(mean) ** 2).max(axis=0)
        cross = (turned * mean.conj() / around).sum(axis=2)
        reach = WIDEST / 2.0**number
        lags = lags + _greatest(_smoothed(cross, TOGETHER), np.linspace(-reach, reach, GRID))
        lags -= lags.mean()
    return lags


def _greatest(cross: NDArray[np.complex128], lag: Array) -> Array:
    """The lag of a grid at which cross spectra (p, N) agree most, refined by a parabola."""
    order = np.arange(1, cross.shape[1] + 1)
    likeness = (cross @ np.exp(1j * np.outer(order, lag))).real
    best = np.clip(likeness.argmax(axis=1), 1, len(lag) - 2)
    row = np.arange(len(cross))
    shift = summit(*(likeness[row, best + k] for k in (-1, 0, 1)))
    return np.asarray(lag[best] + shift * (lag[1] - lag[0]))


def _smoothed(values: NDArray[np.complex128], width: float) -> NDArray[np.complex128]:
    """Rows (p, N) averaged with their neighbours by a Gaussian of `width` rows."""
    row = np.arange(len(values))
    weight = np.exp(-0.5 * ((row[:, None] - row) / width) ** 2)
    return np.asarray((weight / weight.sum(axis=1, keepdims=True)) @ values)
