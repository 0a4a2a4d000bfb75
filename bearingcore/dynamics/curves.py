"""Stiffness over the cage angle as it is drawn, and what errors of curves are taken over."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearingcore.statics.equilibrium import Equilibrium

Array = NDArray[np.float64]

_TERMS = np.triu_indices(5)

LEAST_SWING = 0.01
"""Errors are taken over a curve's swing, but not over less than this part of its size."""


def stiffness_curves(state: Equilibrium) -> Array:
    """(n, 15) the terms of the stiffness, in their units; NaN where there is no answer."""
    return state.stiffness[:, *_TERMS]


def swings(values: Array) -> Array:
    """(m,) what errors of curves (n, m) are taken over: swings, or LEAST_SWING of the size.

    A term that symmetry makes zero is measured by the size of its neighbours: 1 where nothing is.
    """
    known = values[np.isfinite(values).all(axis=1)]
    if not known.size:
        return np.ones(values.shape[1])
    size = np.abs(known).max(axis=0)
    swing = np.maximum(np.ptp(known, axis=0), LEAST_SWING * size)
    if values.shape[1] == 15:  # stiffness: a term counts over the diagonal ones of its directions
        rows, columns = _TERMS
        diagonal = size[rows == columns]
        swing = np.maximum(swing, 1e-6 * np.sqrt(diagonal[rows] * diagonal[columns]))
    return np.where(swing > 0.0, swing, 1.0)


def curve_errors(angles: Array, values: Array, dense: Array, expected: Array) -> Array:
    """Error of straight lines between cage angles: the greatest of all curves, over its swing.

    Parameters
    ----------
    angles : (n,) [rad], values : (n, m)
        cage angles, rising, and the curves there.
    dense : (k,) [rad], expected : (k, m)
        the same at far more angles.

    Returns
    -------
    (≤ k,)
        at those of the far more angles where all curves have an answer.
    """
    lines = np.stack(
        [np.interp(dense, angles, values[:, i]) for i in range(values.shape[1])], axis=1
    )
    error = np.abs(lines - expected) / swings(expected)
    return np.asarray(error[np.isfinite(error).all(axis=1)].max(axis=1, initial=0.0))
