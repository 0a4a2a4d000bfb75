"""Whether contacts can carry a load at all, whatever the displacement.

Quantity                                                        | Symbol | Name     | Unit
--------------------------------------------------------------- | ------ | -------- | ----
load, moments over r_d                                          | F      | load     | N
direction in which the ring moves, tilts times r_d              | w      |          |
gradients of a ball's motion along its unloaded line of contact | e_j    | pressing |
and across it                                                   | t_j    |          |
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.kernels import RESIDUAL_LIMIT

Array = NDArray[np.float64]

EPSILON = float(np.finfo(float).eps)

ROUNDING = 1e-13
"""A gradient below this is that of a ball which is across the direction to a digit."""

LEAST_GAIN, ALIKE = 1e-14, 1e-11
"""The part of a load of size 1 that another ball must be able to take for it to be tried, and how
much two rays must differ to be two."""


def descent_direction(
    contacts: kernels.Contacts, cage_angle: float, active: NDArray[np.int64], load: Array
) -> tuple[Array, float]:
    """Direction (len(active),) in which a load works and no ball is ever pressed, and its share.

    A ball stays free for ever just when it moves straight back along its unloaded line of contact,
    so these directions are the cone e_j·w ≤ 0, t_j·w = 0 over all balls; rollers, whose line of
    contact is fixed, may move across it as well, so that e_j·w ≤ 0 is all of it. The nearest of
    them to the load is what contacts leave of it, F − Σ a_j e_j − Σ b_j t_j with a_j ≥ 0; its share
    of the load is 0 where contacts can carry all of it.
    """
    nothing = np.zeros(len(active)), 0.0
    if not load.any():
        return nothing
    phi = contacts.angles_at(np.array([cage_angle]))[0]
    c, s, zero, one = np.cos(phi), np.sin(phi), np.zeros_like(phi), np.ones_like(phi)
    arm, reach = contacts.arm, contacts.reach
    radial = np.stack([c, s, zero, -arm * s, arm * c], axis=1)[:, active]
    axial = np.stack([zero, zero, one, reach * s, -reach * c], axis=1)[:, active]
    ca, sa = contacts.line_r[:, None], contacts.line_z[:, None]
    across = (axial * ca - radial * sa)[~contacts.fixed]
    across[np.abs(across) < ROUNDING] = 0.0
    _, sizes, vectors = np.linalg.svd(across)
    held = np.count_nonzero(sizes > 1e-10)
    still = vectors[held:]
    if not len(still):
        return nothing
    pressing = still @ (radial * ca + axial * sa).T
    # what is left free is known to a digit times how unevenly the rest is held
    unevenness = sizes[0] / sizes[held - 1] if held else 1.0
    pressing[np.abs(pressing) < max(ROUNDING, 10.0 * EPSILON * unevenness)] = 0.0
    left = beyond_cone(pressing, still @ load / np.linalg.norm(load))
    return left @ still, float(np.linalg.norm(left))


def is_unbounded(
    contacts: kernels.Contacts, cage_angle: float, active: NDArray[np.int64], load: Array
) -> bool:
    """True where some motion does work on the load and never presses a ball.

    The energy then falls without end. `load` belongs to the active directions.
    """
    return descent_direction(contacts, cage_angle, active, load)[1] > RESIDUAL_LIMIT


def beyond_cone(rays: Array, point: Array) -> Array:
    """Rest of `point` (m,) after its nearest in the cone of `rays` (m, k) is taken off.

    Lawson and Hanson's active sets, with a tolerance, as rays of balls opposite each other are.
    """
    inside: list[int] = []
    amounts = np.zeros(rays.shape[1])
    for _ in range(3 * rays.shape[1]):
        gain = (point - rays @ amounts) @ rays
        gain[inside] = -np.inf
        if gain.max() <= LEAST_GAIN:
            break
        inside.append(int(gain.argmax()))
        while inside:
            wanted = np.linalg.lstsq(rays[:, inside], point, rcond=ALIKE)[0]
            if np.all(wanted > 0.0):
                amounts[inside] = wanted
                break
            # go towards what is wanted until the first ball lets go
            now = amounts[inside]
            blocking = wanted <= 0.0
            step = float(np.min(now[blocking] / (now[blocking] - wanted[blocking])))
            moved = now + min(step, 1.0) * (wanted - now)
            amounts[:] = 0.0
            kept = moved > ROUNDING
            amounts[np.array(inside)[kept]] = moved[kept]
            inside = [ball for ball, keep in zip(inside, kept, strict=True) if keep]
    left = point - rays @ amounts
    if inside:  # once more: what is left is small against the point and has lost digits
        taken = rays[:, inside]
        left = left - taken @ np.linalg.lstsq(taken, left, rcond=ALIKE)[0]
    return left
