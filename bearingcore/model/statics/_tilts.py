"""Tilts: the moment on the shaft's other bearing if they are held, their size if they are free."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.common import with_prefix
from bearingcore.model.scene import FREE_TILT_WORDS, _packing as packing
from bearingcore.model.statics._equilibrium import Equilibrium
from bearingcore.model.statics._limit import Limit

HELD_TILTS, FREE_TILTS = "held tilts", "free tilts"

_NOTICED = 1e-6
"""Moment over that of all loads at the pitch circle, above which it is more than rounding."""


def held_tilts(state: Equilibrium) -> Limit | None:
    """Return the greatest moment [N·m] that holds the tilts, in words; None if it is 0.

    M = Σ Q_j (r_d sin α_j − z_k cos α_j)(sin φ_j, −cos φ_j), less the moment of the load.
    """
    bearing, tilts = state.scene.bearing, ("rx", "ry")
    held = [dof for dof in tilts if dof not in state.dofs]
    if not held or not set(tilts) <= set(bearing.kind.needed_directions):
        return None
    contacts, units = packing.contacts(bearing), packing.length_units(state.scene)
    angle = np.nan_to_num(state.contact_angle)
    lever = contacts.reach * np.sin(angle) - contacts.arm * np.cos(angle)
    push = state.ball_load * lever * units[3]
    phi = packing.ball_angles(bearing, state.cage_angles)
    load = state.scene.load
    moments = {
        "rx": (push * np.sin(phi)).sum(axis=1) - load.mx,
        "ry": -(push * np.cos(phi)).sum(axis=1) - load.my,
    }
    size = np.hypot(*(moments[dof] if dof in held else 0.0 * moments[dof] for dof in tilts))
    size = size[np.isfinite(size)]
    all_loads = float(np.nan_to_num(state.ball_load).sum(axis=1).max(initial=0.0))
    if not size.max(initial=0.0) > _NOTICED * all_loads * bearing.groove_center_radius:
        return None
    sentence = (
        f"The shaft is kept from tilting, which takes up to {with_prefix(float(size.max()), 'N·m')}"
        f" of its other bearing; whether that can carry so much is not checked. With free tilts "
        f"the {bearing.kind.elements} would carry other loads."
    )
    return Limit(HELD_TILTS, math.nan, math.nan, "N·m", False, sentence)


def free_tilts(state: Equilibrium) -> Limit | None:
    """Return the tilt of a shaft that only this bearing holds, in words; None if it is 0."""
    tilt = np.hypot(state.displacement[:, 3], state.displacement[:, 4])
    most = float(tilt[np.isfinite(tilt)].max(initial=0.0))
    if not {"rx", "ry"} & set(state.scene.free_dofs(state.dofs)) or most == 0.0:
        return None
    sentence = f"{FREE_TILT_WORDS} Here it tilts by up to {with_prefix(most, 'rad')}."
    return Limit(FREE_TILTS, math.nan, math.nan, "rad", False, sentence)
