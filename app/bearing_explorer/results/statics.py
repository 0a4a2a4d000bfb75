"""Static equilibrium, stiffness, natural frequencies and maps, shared by all sessions."""

from __future__ import annotations

import numpy as np

import bearingcore as core
from bearing_explorer.results.cache import cached
from bearingcore import Equilibrium, Maps, Modes, Scene


@cached
def curves(scene: Scene, first: float, last: float, n: int) -> Equilibrium:
    """Equilibrium at `n` equally spaced cage angles [rad]."""
    return core.static_state(scene, np.linspace(first, last, n))


@cached
def equilibrium_at(scene: Scene, cage_angle: float) -> Equilibrium:
    """Equilibrium at one cage angle [rad]; arrays of length 1."""
    return core.static_state(scene, np.array([cage_angle]))


@cached
def modes(scene: Scene, first: float, last: float, n: int) -> Modes:
    """Natural frequencies at `n` equally spaced cage angles [rad]."""
    return core.modes(scene, np.linspace(first, last, n))


@cached
def bands(scene: Scene, first: float, last: float, n: int) -> dict[str, tuple[float, float]]:
    """Least and greatest natural frequency [Hz] of each mode, by its label."""
    return core.frequency_bands(scene, np.linspace(first, last, n))


@cached
def maps(scene: Scene, reach: float, n_extents: int, first: float, last: float, n: int) -> Maps:
    """Stiffness maps over extents up to `reach` and `n` cage angles [rad]."""
    extents = np.linspace(0.0, reach, n_extents)
    return core.stiffness_maps(scene, extents, np.linspace(first, last, n))
