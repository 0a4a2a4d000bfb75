"""Reasons for a missing equilibrium: loads that no contact can carry, and what a scene lacks.

Quantity                                                        | Symbol | Name     | Unit
--------------------------------------------------------------- | ------ | -------- | ----
load, moments over r_d                                          | F      | load     | N
direction in which the ring moves, tilts times r_d              | w      |          |
gradients of a ball's motion along its unloaded line of contact | e_j    | pressing |
and across it                                                   | t_j    |          |
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, number, with_prefix
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import Scene, _packing as packing
from bearingcore.model.statics._passes import drops_at
from bearingcore.model.statics._status import StaticStatus

_Z, _TILTS = 2, (3, 4)
_TILTS_HELD = "the shaft's other bearing, or tilts that are held"

ROUNDING = 1e-13
"""A gradient below this is that of a ball which is across the direction to a digit."""


def explanation(
    status: int, scene: Scene, cage_angle: float, dofs: tuple[str, ...], state: Array | None = None
) -> str:
    """A clause that goes on after the sentence of the status of one cage angle; often empty.

    Parameters
    ----------
    status
        a `StaticStatus`.
    scene, cage_angle, dofs
        solved scene, its cage angle [rad], and the free directions.
    state : (5,) [m]
        as of `Equilibrium.state`; None where it was not kept.
    """
    if status == StaticStatus.BEYOND_GEOMETRY:
        return "" if state is None else f": {_bound_exceeded(scene, cage_angle, state)}"
    if status == StaticStatus.NOT_CARRIED:
        lacks = _lacks(scene, cage_angle, dofs)
        return f"; missing is {lacks}" if lacks else ""
    lone = len(scene.bearing.all_rows) == 1 and packing.contacts(scene.bearing).fixed.all()
    if status == StaticStatus.FREE_DIRECTION and lone and {"rx", "ry"} & set(dofs):
        return (
            ", as the lines of contact of one row of tapered rollers meet in a point of the shaft; "
            f"missing is {_TILTS_HELD}"
        )
    return ""


def moved(
    scene: Scene, cage_angles: Array, state: Array, leads: Array | None = None
) -> tuple[Array, Array]:
    """Displacements (n, N_b) [m] along and across the unloaded lines of contact (Eqs. 9-12).

    `state` (n, 5) [m] and `leads` (n,) [rad] are those of `Equilibrium`; clearance and drop into
    defects are taken off.
    """
    contacts = packing.contacts(scene.bearing)
    angle = contacts.angles_at(cage_angles)
    c, s = np.cos(angle), np.sin(angle)
    x, y, z, rx, ry = state.T[..., None]
    r = (x + contacts.arm * ry) * c + (y - contacts.arm * rx) * s - contacts.clearance
    a = z + contacts.reach * (rx * s - ry * c) + contacts.offset
    along = r * contacts.line_r + a * contacts.line_z - drops_at(scene, cage_angles, leads=leads)
    return along, a * contacts.line_r - r * contacts.line_z


def _lacks(scene: Scene, cage_angle: float, dofs: tuple[str, ...]) -> str:
    """Tilts that are held, thrust, or both, with which the contacts would carry the load."""
    packed = packing.pack(scene, dofs)
    force, active = packed.load
    facing = float(np.sign(packed.contacts.line_z.sum()))
    pressed = force.copy()
    pressed[_Z] = facing * 1e3 * np.abs(force).max()
    level = np.setdiff1d(active, _TILTS)

    def carries(free: NDArray[np.int64], load: Array) -> bool:
        return not is_unbounded(packed.contacts, cage_angle, free, load[free])

    if level.size < active.size and carries(level, force):
        return _TILTS_HELD
    if facing == 0.0 or _Z not in active:
        return ""
    thrust = _thrust(scene, cage_angle, facing * force[_Z])
    if carries(active, pressed):
        return f"the shaft's other bearing, or {thrust}"
    if level.size < active.size and carries(level, pressed):
        return f"{_TILTS_HELD}, and {thrust}"
    return ""


def _thrust(scene: Scene, cage_angle: float, thrust: float) -> str:
    """Clause on the thrust that rows lack beside the radial load and a thrust [N] one way.

    A row holds F_r with F_r tan α where one element is on the load's line; where it is between two
    both carry, and the fewer there are the more: cos(β/2 − γ)/cos(β/2) times as much, β the
    spacing, γ the angle from the one before the line.
    """
    if thrust < 0.0:
        words = f"thrust the other way: {with_prefix(-thrust, 'N')} press the inner ring out"
    else:
        words = f"more axial load: with {with_prefix(thrust, 'N')} the inner ring leaves the outer"
    bearing, load = scene.bearing, scene.load
    radial = math.hypot(load.fx, load.fy)
    if radial == 0.0 or len(bearing.all_rows) > 1:
        return words
    half, first = 0.5 * bearing.ball_spacing, packing.ball_angles(bearing, np.array([cage_angle]))
    past = (math.atan2(load.fy, load.fx) - float(first[0, 0])) % bearing.ball_spacing
    least = radial * math.tan(bearing.contact_angle) * math.cos(half - past) / math.cos(half)
    return f"{words}, and over {with_prefix(least, 'N')} must hold it against the radial load"


def _bound_exceeded(scene: Scene, cage_angle: float, state: Array) -> str:
    """The first bound of the contacts' geometry that a state (5,) [m] is beyond."""
    contacts = packing.contacts(scene.bearing)
    element = scene.bearing.kind.element
    tilt = float(np.abs(state[3:]).max()) / scene.bearing.groove_center_radius
    if tilt > packing.SMALL_TILT:
        most, tilted = (number(math.degrees(angle)) for angle in (packing.SMALL_TILT, tilt))
        return f"the ring would tilt by {tilted}°, and tilts are small here, up to {most}°"
    along, across = (part[0] for part in moved(scene, np.array([cage_angle]), state[None]))
    apart = np.hypot(np.maximum(contacts.distance + along, 0.0), across)
    pressed = np.where(contacts.fixed, along, apart - contacts.distance)
    deepest = int(np.argmax(pressed - contacts.room))
    if pressed[deepest] > contacts.room[deepest]:
        by, most = (with_prefix(float(of[deepest]), "m") for of in (pressed, contacts.room))
        return f"a {element} would be compressed by {by}, and {most} is more than any can be"
    left = np.where(contacts.fixed & (pressed > 0.0), np.abs(across), 0.0)
    if (left > contacts.room).any():
        return (
            f"the inner race would move {with_prefix(float(left.max()), 'm')} along the outer one, "
            f"off a {element} that is {with_prefix(2.0 * float(contacts.room.max()), 'm')} long"
        )
    return (
        "the inner ring would move out of the outer one, past the "
        f"{with_prefix(float(contacts.distance.min()), 'm')} between the groove centres"
    )


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
    ca, sa = contacts.line_r, contacts.line_z
    across = contacts.gradients(phi, -sa, ca)[~contacts.fixed][:, active]
    across[np.abs(across) < ROUNDING] = 0.0
    _, sizes, vectors = np.linalg.svd(across)
    held = np.count_nonzero(sizes > 1e-10)
    still = vectors[held:]
    if not len(still):
        return nothing
    pressing = still @ contacts.gradients(phi, ca, sa)[:, active].T
    # what is left free is known to a digit times how unevenly the rest is held
    unevenness = sizes[0] / sizes[held - 1] if held else 1.0
    pressing[np.abs(pressing) < max(ROUNDING, 10.0 * np.finfo(float).eps * unevenness)] = 0.0
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
    return descent_direction(contacts, cage_angle, active, load)[1] > kernels.RESIDUAL_LIMIT
