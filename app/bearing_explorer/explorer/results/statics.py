"""Static equilibrium, stiffness, natural frequencies and maps, shared by all sessions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import bearingcore as core
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import cached
from bearingcore import RACES, Equilibrium, Maps, Modes, Scene
from bearingcore.model.statics import (
    ANGLES_A_PERIOD,
    BALL_LOAD,
    ROUNDS,
    StaticRanges,
    drops_now,
    static_ranges,
)


@cached
def curves(scene: Scene, first: float, last: float, n: int) -> Equilibrium:
    """Equilibrium at `n` equally spaced cage angles [rad]."""
    compiling.need(compiling.STATICS, scene)
    return core.static_state(scene, np.linspace(first, last, n))


@cached
def modes(scene: Scene, first: float, last: float, n: int) -> Modes:
    """Natural frequencies at `n` equally spaced cage angles [rad]."""
    compiling.need(compiling.STATICS, scene)
    return core.modes(scene, np.linspace(first, last, n))


@cached
def bands(scene: Scene, coarse: bool) -> dict[str, tuple[float, float]]:
    """Least and greatest natural frequency [Hz] of each mode over all positions, by its label."""
    compiling.need(compiling.STATICS, scene)
    return core.frequency_bands(scene, coarse=coarse)


@cached
def ranges(scene: Scene, coarse: bool) -> StaticRanges:
    """Least, greatest and mean of loads and stiffness terms in use, over all positions."""
    compiling.need(compiling.STATICS, scene)
    dofs = scene.active_dofs
    free = [f"k_{a}{b}" for i, a in enumerate(dofs) for b in dofs[i:]]
    names = dict.fromkeys((*free, "k_xx", "k_yy", BALL_LOAD))
    n, rounds = (ANGLES_A_PERIOD // 3 + 1, 1) if coarse else (ANGLES_A_PERIOD, ROUNDS)
    return static_ranges(scene, names, n, rounds=rounds)


@cached
def maps(scene: Scene, reach: float, n_extents: int, first: float, last: float, n: int) -> Maps:
    """Stiffness maps over extents up to `reach` and `n` cage angles [rad]."""
    compiling.need(compiling.STATICS, scene)
    extents = np.linspace(0.0, reach, n_extents)
    return core.stiffness_maps(scene, extents, np.linspace(first, last, n))


@cached
def drops(scene: Scene, cage_angle: float) -> dict[str, NDArray[np.float64]]:
    """Drop [m] of each ball's centre at a cage angle [rad], by race."""
    compiling.need(compiling.STATICS)
    return {race: drops_now(scene, cage_angle, race) for race in RACES}
