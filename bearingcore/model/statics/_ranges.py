"""Least, greatest and mean values of static answers over all positions of balls and shaft."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from bearingcore.common import Array
from bearingcore.common._arrays import least_and_greatest
from bearingcore.model.scene import Scene
from bearingcore.model.statics._ball_positions import static_state
from bearingcore.model.statics._equilibrium import ANGLES_A_PERIOD, STIFFNESS_TERMS, Equilibrium
from bearingcore.model.statics._positions import ROUNDS, extremes, over_all_positions, positions

BALL_LOAD = "ball_load"
"""Name of the load [N] of the most heavily loaded ball, in addition to `STIFFNESS_TERMS`."""


@dataclass(frozen=True)
class StaticRanges:
    """Static answers at all positions of a scene, see `bearingcore.model.statics._positions`.

    Attributes
    ----------
    state
        states at n pairs of cage and shaft angle, with their share of the time.
    least, greatest
        extremes of stiffness terms and of `BALL_LOAD`, by name, also between the pairs. Pairs
        without an answer do not count; NaN if no pair has one.
    """

    state: Equilibrium
    least: Mapping[str, float]
    greatest: Mapping[str, float]

    def mean(self, values: Array) -> float:
        """Return the mean over time of numbers (n,); unknown ones (NaN) do not count."""
        known = np.isfinite(values)
        share = self.state.shares[known].sum()
        return float(values[known] @ self.state.shares[known] / share) if share > 0.0 else math.nan


def static_ranges(
    scene: Scene,
    names: Iterable[str] = (*STIFFNESS_TERMS, BALL_LOAD),
    n: int = ANGLES_A_PERIOD,
    *,
    rounds: int = ROUNDS,
) -> StaticRanges:
    """Solve a scene at all its positions, and return the extremes of the named numbers.

    Parameters
    ----------
    scene
        scene to solve.
    names
        names from `STIFFNESS_TERMS`, or `BALL_LOAD`.
    n, rounds
        fineness, as in `positions` and `extremes`.
    """
    grid = positions(scene, n)
    state = over_all_positions(scene, n, static_state)
    names = list(names)

    def evaluate(cage_angles: Array, shaft_angles: Array) -> Array:
        return _numbers(static_state(scene, cage_angles, shaft_angles=shaft_angles), names)

    ends = extremes(grid, _numbers(state, names), evaluate, rounds=rounds)
    least, greatest = (dict(zip(names, end.tolist(), strict=True)) for end in ends[:2])
    return StaticRanges(state, least, greatest)


def ranges_of(state: Equilibrium) -> StaticRanges:
    """Return the ranges of states at equally spaced angles over a period, both ends included."""
    names = [*STIFFNESS_TERMS, BALL_LOAD]
    ends = least_and_greatest(_numbers(state, names), 1)
    least, greatest = (dict(zip(names, end.tolist(), strict=True)) for end in ends)
    return StaticRanges(state, least, greatest)


def _numbers(state: Equilibrium, names: list[str]) -> Array:
    """Return the named numbers (q, n) of a state."""
    rows = [
        state.ball_load.max(axis=1) if name == BALL_LOAD else state.term(name) for name in names
    ]
    return np.stack(rows) if rows else np.zeros((0, state.cage_angles.size))
