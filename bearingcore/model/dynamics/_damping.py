"""Damping of loaded contacts, and a moving scene as numbers."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.common import _checks as checks
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model.scene import WITH_MASS, PackedMotion, PackedScene, Scene
from bearingcore.model.scene._packing import pack, rotor
from bearingcore.model.statics._equilibrium import equilibrium_of, remove_defects

DAMPING_OVER_STIFFNESS = 1e-5
"""β [s] of the healthy bearing, for scenes without a contact damping; the paper takes 0.25e-5 to
2.5e-5 s."""


# The key of the cache holds all inputs of the static state of a scene without its defects.
@lru_cache_by_bytes(
    2_000_000,
    lambda *_: 0,
    lambda packed: (packed.scene.bearing, packed.scene.load, packed.dofs),
)
def _mean_stiffness_per_ball(packed: PackedScene) -> float:
    """Return mean(k_xx + k_yy)/mean(loaded balls) [N/m] without defects, over a period."""
    angles = np.arange(120) * (packed.scene.bearing.period / 120)
    healthy = remove_defects(packed)
    state = equilibrium_of(healthy, angles)
    good = state.converged & (state.loaded_balls > 0)
    if not good.any():
        return math.nan
    radial = state.term("k_xx")[good] + state.term("k_yy")[good]
    return float(radial.mean() / state.loaded_balls[good].mean())


def contact_damping(scene: Scene) -> float:
    """Return the viscous damping c [N·s/m] of a loaded contact.

    It is `Scene.contact_damping`, or without that β·mean(k_xx + k_yy)/mean(n) with β = 1e-5 s. The
    paper does not print c; it takes a damping of the healthy bearing that is 0.25e-5 to 2.5e-5 s
    times its stiffness (Eq. 27). c is 0 if the healthy bearing has no static state.
    """
    checks.instance("scene", scene, Scene)
    return damping_of(pack(scene)) if scene.contact_damping is None else scene.contact_damping


def damping_of(packed: PackedScene) -> float:
    """Return the `contact_damping` of a packed scene."""
    if packed.scene.contact_damping is not None:
        return packed.scene.contact_damping
    stiffness = _mean_stiffness_per_ball(packed)
    return DAMPING_OVER_STIFFNESS * stiffness if math.isfinite(stiffness) else 0.0


def packed_motion(scene: Scene, dofs: tuple[str, ...] | None = None) -> PackedMotion:
    """Return a scene that moves along `dofs` as numbers; None takes its active directions.

    Raises
    ------
    ValueError
        if the support lacks a number.
    """
    packed = pack(scene, dofs, balls=scene.balls == WITH_MASS)
    c, balls = damping_of(packed), packed.balls
    if balls is not None:
        balls = balls._replace(races=balls.races._replace(damping=c * balls.races.damping))
    return PackedMotion(**vars(packed) | {"balls": balls}, rotor=rotor(scene, packed.dofs, c))
