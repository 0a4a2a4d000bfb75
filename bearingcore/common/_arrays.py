"""Arrays of numbers: their type, and helpers for runs, quantiles and peaks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Array of floats; docstrings give its shape."""


def runs(which: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first index of each run of True, and the index after its last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], which, [False]]).astype(np.int8)))
    return edges[::2], edges[1::2]


def weighted_quantile(values: Array, weights: Array, share: float) -> float:
    """Return the weighted quantile of numbers (n,), interpolated; NaN without numbers."""
    if not values.size:
        return np.nan
    order = np.argsort(values)
    middles = np.cumsum(weights[order]) - 0.5 * weights[order]  # of each number's share
    return float(np.interp(share * weights.sum(), middles, values[order]))


def summit(left: Array, middle: Array, right: Array) -> Array:
    """Return the offset, -1 to 1, of a parabola's top from the middle of three neighbours."""
    bend = left - 2.0 * middle + right
    shift = np.where(bend < 0.0, 0.5 * (left - right) / np.where(bend < 0.0, bend, 1.0), 0.0)
    return np.clip(shift, -1.0, 1.0)


def least_and_greatest(values: Array, axis: int) -> tuple[Array, Array]:
    """Return the least and greatest finite numbers along an axis; NaN where there are none."""
    known = np.isfinite(values)
    least = values.min(axis=axis, initial=np.inf, where=known)
    greatest = values.max(axis=axis, initial=-np.inf, where=known)
    none = ~known.any(axis=axis)
    return np.where(none, np.nan, least), np.where(none, np.nan, greatest)
