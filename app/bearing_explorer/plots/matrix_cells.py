"""Where the 15 terms of the symmetric 5×5 stiffness matrix stand in a drawing, and their names."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.plots.ranges import StickyRange
from bearingcore import DOF_NAMES
from bearingcore.statics.equilibrium import TERM_SYMBOLS

UNITS = ("N/m", "N/rad", "N·m/rad")
"""Units of stiffness with no, one and two rotations."""
NEGLIGIBLE = 1e-6
"""Of the geometric mean of the two diagonal terms: rounding, not coupling."""

PLACES = [(i, j) for i in range(5) for j in range(i, 5)]
"""Row and column of each term."""
SYMBOLS = list(TERM_SYMBOLS.values())
"""Symbols of the terms; all but the first letter is a subscript."""


@dataclass(frozen=True)
class Cell:
    """A frame in the drawing, in matrix columns and rows."""

    left: float
    right: float
    bottom: float
    top: float

    def x(self, share: np.ndarray) -> np.ndarray:
        """Places along the frame for shares of 0 to 1."""
        return self.left + (self.right - self.left) * share

    def y(self, value: np.ndarray, limits: tuple[float, float]) -> np.ndarray:
        """Heights of values on an axis with these limits."""
        low, high = limits
        return self.bottom + (self.top - self.bottom) * (value - low) / (high - low)


def term_sizes(term: Callable[[str], NDArray[np.float64]]) -> list[float]:
    """For each term the size that counts as one: geometric mean of its two diagonal terms.

    `term` gives the numbers that are shown of a term, by its name.
    """
    tops = []
    for dof in DOF_NAMES:
        values = np.abs(term(f"k_{dof}{dof}"))
        tops.append(float(np.max(values, where=np.isfinite(values), initial=0.0)))
    return [math.sqrt(tops[i] * tops[j]) or 1.0 for i, j in PLACES]


def cleaned(values: np.ndarray, scale: float) -> np.ndarray:
    """Rounding noise of a term that vanishes by symmetry, drawn as the zero that it is."""
    return np.where(np.abs(values) < NEGLIGIBLE * scale, 0.0, values)


def trace_limits(sticky: StickyRange, scale: float, *traces: np.ndarray) -> tuple[float, float]:
    """Least and greatest value that a cell shows of a term whose size is `scale`; NaN for none."""
    finite = np.concatenate(traces)
    finite = finite[np.isfinite(finite)]
    if not finite.size:
        return math.nan, math.nan
    if not finite.any():
        return -1.0, 1.0
    middle = 0.5 * (finite.min() + finite.max())
    return sticky.fit(*traces, np.array([middle - 0.005 * scale, middle + 0.005 * scale]))
