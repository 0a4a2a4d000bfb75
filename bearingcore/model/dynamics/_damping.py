"""Damping of loaded contacts, and a moving scene as numbers with it."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from bearingcore.common import _checks as checks
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model.scene import PackedMotion, PackedScene, Scene
from bearingcore.model.scene._packing import pack, pack_motion
from bearingcore.model.statics._equilibrium import equilibrium_of, remove_defects

DAMPING_OVER_STIFFNESS = 1e-5
"""β [s] of the healthy bearing where a scene does not say its contact damping; the paper takes
0.25e-5 to 2.5e-5 s."""


# by all that the static state of a scene without its defects depends on
@lru_cache_by_bytes(
    2_000_000,
    lambda *_: 0,
    lambda packed: (packed.scene.bearing, packed.scene.load, packed.dofs),
)
def _mean_stiffness_a_ball(packed: PackedScene) -> float:
    """mean(k_xx + k_yy) / mean(loaded balls) [N/m] without defects, over a period of the curves."""
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

    This is the scene's own, or else β·mean(k_xx + k_yy)/mean(n).

    The paper does not print c; it takes a damping of the healthy bearing that is 0.25e-5 to
    2.5e-5 s times its stiffness (Eq. 27). β = 1e-5 s. 0 where the healthy bearing has no static
    state to take it from.
    """
    checks.instance("scene", scene, Scene)
    return damping_of(pack(scene)) if scene.contact_damping is None else scene.contact_damping


def damping_of(packed: PackedScene) -> float:
    """`contact_damping` of a scene that is packed."""
    if packed.scene.contact_damping is not None:
        return packed.scene.contact_damping
    stiffness = _mean_stiffness_a_ball(packed)
    return DAMPING_OVER_STIFFNESS * stiffness if math.isfinite(stiffness) else 0.0


def packed_motion(scene: Scene, dofs: tuple[str, ...] | None = None) -> PackedMotion:
    """A scene that moves along `dofs`, as numbers, contacts damped; None: its active directions.

    Raises
    ------
    ValueError
        for a support that lacks a number.
    """
    return damped(pack_motion(scene, scene.active_dofs if dofs is None else dofs))


def damped(packed: PackedMotion) -> PackedMotion:
    """Add the contact damping of its scene to a motion."""
    c, balls = damping_of(packed), packed.balls
    if balls is not None:
        balls = balls._replace(races=balls.races._replace(damping=c * balls.races.damping))
    rotor = packed.rotor._replace(contact_damping=c)
    return dataclasses.replace(packed, rotor=rotor, balls=balls)
