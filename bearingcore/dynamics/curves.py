"""Curves over the cage angle as they are drawn, and what their errors are taken over."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.dynamics.modes import two_body_matrix
from bearingcore.scene.scene import DOF_NAMES
from bearingcore.statics.equilibrium import Equilibrium

Array = NDArray[np.float64]

CURVES = ("load", "stiffness", "modes")
"""Curves over the cage angle: ball loads with displacements, the 15 stiffness terms,
undamped natural frequencies."""

_TERMS = np.triu_indices(5)

LEAST_SWING = 0.01
"""Errors are taken over a curve's swing, but not over less than this part of its size."""


def curves_of(state: Equilibrium, curves: str) -> Array:
    """(n, m) the curves to be drawn, in their units; NaN where there is no answer."""
    if curves == "load":
        return np.hstack([state.ball_load, state.displacement])
    if curves == "stiffness":
        return state.stiffness[:, *_TERMS]
    checks.choice("curves", curves, CURVES)
    scene, dofs = state.scene, state.dofs
    index = [DOF_NAMES.index(name) for name in dofs]
    mass = scene.support.inertias(dofs)
    K = two_body_matrix(state.stiffness[:, index][:, :, index], scene.support.stiffness(dofs))
    frequency = np.full((len(K), mass.size), math.nan)
    known = np.isfinite(K).all(axis=(1, 2))
    values = np.linalg.eigvalsh(K[known] / np.sqrt(mass[:, None] * mass))
    frequency[known] = np.sqrt(np.maximum(values, 0.0)) / (2.0 * math.pi)
    return frequency


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
