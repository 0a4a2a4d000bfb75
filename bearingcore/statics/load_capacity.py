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
    from scipy.optimize import nnls  # imported late: slow to import

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
    along = still @ load / np.linalg.norm(load)
    taken, _ = nnls(pressing, along, maxiter=100 * pressing.shape[1])
    left = along - pressing @ taken
    return left @ still, float(np.linalg.norm(left))


def is_unbounded(
    contacts: kernels.Contacts, cage_angle: float, active: NDArray[np.int64], load: Array
) -> bool:
    """True where some motion does work on the load and never presses a ball.

    The energy then falls without end. `load` belongs to the active directions.
    """
    return descent_direction(contacts, cage_angle, active, load)[1] > RESIDUAL_LIMIT
