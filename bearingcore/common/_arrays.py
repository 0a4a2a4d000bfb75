"""Arrays of numbers: their type, and runs in them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Floats; docstrings say of which shape."""


def runs(which: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First index of each run that is true, and the one after its last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], which, [False]]).astype(np.int8)))
    return edges[::2], edges[1::2]


def weighted_quantile(values: Array, weights: Array, share: float) -> float:
    """Number below which a share of the weight of numbers (n,) lies, interpolated; NaN of none."""
    if not values.size:
        return np.nan
    order = np.argsort(values)
    reached = np.cumsum(weights[order]) - 0.5 * weights[order]
    return float(np.interp(share * weights.sum(), reached, values[order]))


def summit(left: Array, middle: Array, right: Array) -> Array:
    """Place of the top of a parabola through three neighbours, from the middle one: -1 to 1."""
    bend = left - 2.0 * middle + right
    shift = np.where(bend < 0.0, 0.5 * (left - right) / np.where(bend < 0.0, bend, 1.0), 0.0)
    return np.clip(shift, -1.0, 1.0)


def least_and_greatest(values: Array, axis: int) -> tuple[Array, Array]:
    """The ends of what is known of numbers along an axis; NaN of nothing."""
    known = np.isfinite(values)
    least = values.min(axis=axis, initial=np.inf, where=known)
    greatest = values.max(axis=axis, initial=-np.inf, where=known)
    none = ~known.any(axis=axis)
    return np.where(none, np.nan, least), np.where(none, np.nan, greatest)
