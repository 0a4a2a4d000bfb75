"""Differences between a scene and the same with other free directions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Equilibrium, Scene, Spectrum
from bearingcore.common.table import ResultTable, table_of

DYNAMIC_RANGE = 40.0
"""[dB] below the loudest line down to which spectra are compared."""


@dataclass(frozen=True)
class DofComparison:
    """A scene with its free directions against the same with others.

    chosen, other
        the two sets of free directions; the same where there is nothing to compare.
    static : {"k_xx": ..., "k_yy": ..., "ball load": ...}
        greatest difference over the greatest value, over all cage angles with both answers; NaN
        where there is none.
    motion : {"x": ..., "y": ...} [dB]
        greatest difference between the spectra of the housing's acceleration where the other one
        is at most `DYNAMIC_RANGE` below its loudest line.
    no_motion
        why `motion` is empty.
    """

    chosen: tuple[str, ...]
    other: tuple[str, ...]
    static: dict[str, float]
    motion: dict[str, float]
    no_motion: str = ""

    def table(self) -> ResultTable:
        """The directions compared, and a row a quantity: its greatest difference."""
        names = [*self.static, *(f"spectrum along {dof}" for dof in self.motion)]
        values = [f"{value:.3g}" for value in (*self.static.values(), *self.motion.values())]
        units = ["1"] * len(self.static) + ["dB"] * len(self.motion)
        return table_of(
            ("quantity", "", ["free directions", "compared with", *names]),
            ("greatest_difference", "", [" ".join(self.chosen), " ".join(self.other), *values]),
            ("unit", "", ["", "", *units]),
        )


def other_dofs(scene: Scene) -> tuple[str, ...]:
    """The free directions that those of `scene` are compared with.

    What the scene needs, where others are forced on it; else all five, which shows that leaving
    some out changes nothing. Where the kind of bearing has fewer directions there is nothing to
    compare with.
    """
    if scene.bearing.kind.left_out:
        return scene.needed_dofs
    return scene.needed_dofs if scene.active_dofs != scene.needed_dofs else DOF_NAMES


def static_differences(chosen: Equilibrium, other: Equilibrium) -> dict[str, float]:
    """Greatest relative differences of k_xx, k_yy and the loads of the balls."""
    both = chosen.converged & other.converged
    pairs = {term: (chosen.term(term), other.term(term)) for term in ("k_xx", "k_yy")}
    pairs["ball load"] = (chosen.ball_load, other.ball_load)
    return {name: _relative(a[both], b[both]) for name, (a, b) in pairs.items()}


def _relative(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    if not b.size:
        return math.nan
    top = float(np.abs(b).max())
    return float(np.abs(a - b).max()) / top if top > 0.0 else math.nan


def spectrum_differences(
    chosen: dict[str, Spectrum], other: dict[str, Spectrum]
) -> dict[str, float]:
    """Greatest difference [dB] along x and y, down to `DYNAMIC_RANGE` below the highest line."""
    return {
        dof: _level_difference(chosen[dof].density, other[dof].density)
        for dof in ("x", "y")
        if dof in chosen and dof in other
    }


def _level_difference(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    a, b = a[: len(b)], b[: len(a)]  # as far as both are known
    if not (np.isfinite(a).all() and np.isfinite(b).all() and b.max() > 0.0):
        return math.nan
    strong = b > b.max() * 10.0 ** (-DYNAMIC_RANGE / 10.0)
    least = b.max() * 1e-20  # for a motion that vanishes
    return float(np.abs(10.0 * np.log10(np.maximum(a[strong], least) / b[strong])).max())
