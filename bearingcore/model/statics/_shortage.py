"""Reasons for a missing equilibrium: loads that no contact can carry, and remedies.

Quantity                                                        | Symbol | Name     | Unit
--------------------------------------------------------------- | ------ | -------- | ----
load, moments divided by r_d                                    | F      | load     | N
direction in which the ring moves, tilts times r_d              | w      |          |
gradients of a ball's motion along its unloaded line of contact | e_j    | pressing |
gradients of a ball's motion across this line                   | t_j    | across   |
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
_TILTS_HELD = "its other bearing, or tilts that are held"

ROUNDING = 1e-13
"""Size below which a gradient is rounding: the ball is exactly across the direction."""


def explanation(
    status: int, scene: Scene, cage_angle: float, dofs: tuple[str, ...], state: Array | None = None
) -> str:
    """Return a clause that continues the sentence of the status of one cage angle; often empty.

    Parameters
    ----------
    status
        a `StaticStatus`.
    scene, cage_angle, dofs
        solved scene, its cage angle [rad], and the free directions.
    state : (5,) [m]
        as in `Equilibrium.state`; None if it was not kept.
    """
    if status == StaticStatus.BEYOND_GEOMETRY:
        return "" if state is None else f": {_bound_exceeded(scene, cage_angle, state)}"
    if status == StaticStatus.NOT_CARRIED:
        remedy = _remedy(scene, cage_angle, dofs)
        return f"; the shaft needs {remedy}" if remedy else ""
    lone = len(scene.bearing.all_rows) == 1 and packing.contacts(scene.bearing).fixed.all()
    if status == StaticStatus.FREE_DIRECTION and lone and {"rx", "ry"} & set(dofs):
        return (
            ", as the lines of contact of one row of tapered rollers meet in a point of the shaft; "
            f"the shaft needs {_TILTS_HELD}"
        )
    return ""


def contact_motion(
    scene: Scene, cage_angles: Array, state: Array, leads: Array | None = None
) -> tuple[Array, Array]:
    """Return displacements (n, N_b) [m] along and across unloaded lines of contact (Eqs. 9-12).

    Clearance and drop into defects are subtracted. `state` (n, 5) [m] and `leads` (n,) [rad] are
    those of `Equilibrium`.
    """
    contacts = packing.contacts(scene.bearing)
    angle = contacts.angles_at(cage_angles)
    c, s = np.cos(angle), np.sin(angle)
    x, y, z, rx, ry = state.T[..., None]
    r = (x + contacts.arm * ry) * c + (y - contacts.arm * rx) * s - contacts.clearance
    a = z + contacts.reach * (rx * s - ry * c) + contacts.offset
    along = r * contacts.line_r + a * contacts.line_z - drops_at(scene, cage_angles, leads=leads)
    return along, a * contacts.line_r - r * contacts.line_z


def _remedy(scene: Scene, cage_angle: float, dofs: tuple[str, ...]) -> str:
    """Return words on held tilts, a thrust, or both, if contacts would then carry the load."""
    packed = packing.pack(scene, dofs)
    force, active = packed.load
    facing = float(np.sign(packed.contacts.line_z.sum()))
    pressed = force.copy()
    pressed[_Z] = facing * 1e3 * np.abs(force).max()
    untilted = np.setdiff1d(active, _TILTS)

    def carries(free: NDArray[np.int64], load: Array) -> bool:
        return not is_unbounded(packed.contacts, cage_angle, free, load[free])

    if untilted.size < active.size and carries(untilted, force):
        return _TILTS_HELD
    if facing == 0.0 or _Z not in active:
        return ""
    thrust = _thrust(scene, cage_angle, facing * force[_Z])
    if carries(active, pressed):
        return f"its other bearing, or {thrust}"
    if untilted.size < active.size and carries(untilted, pressed):
        return f"{_TILTS_HELD}, and {thrust}"
    return ""


def _thrust(scene: Scene, cage_angle: float, thrust: float) -> str:
    """Return a clause on the thrust that rows need, if they already have `thrust` [N].

    With one element on the line of the radial load F_r, a row needs the thrust F_r tan α. If the
    line is between two elements, it needs cos(β/2 − γ)/cos(β/2) times as much, where β is their
    spacing and γ the angle of the line beyond the first of them.
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
    """Return words on the first bound of the contacts' geometry that a state (5,) [m] exceeds."""
    contacts = packing.contacts(scene.bearing)
    element = scene.bearing.kind.element
    tilt = float(np.abs(state[3:]).max()) / scene.bearing.groove_center_radius
    if tilt > packing.SMALL_TILT:
        most, tilted = (number(math.degrees(angle)) for angle in (packing.SMALL_TILT, tilt))
        return f"the ring would tilt by {tilted}°, but the model holds for tilts up to {most}°"
    along, across = (part[0] for part in contact_motion(scene, np.array([cage_angle]), state[None]))
    distance = np.hypot(np.maximum(contacts.distance + along, 0.0), across)
    pressed = np.where(contacts.fixed, along, distance - contacts.distance)
    deepest = int(np.argmax(pressed - contacts.room))
    if pressed[deepest] > contacts.room[deepest]:
        size, most = (with_prefix(float(a[deepest]), "m") for a in (pressed, contacts.room))
        return f"a {element} would be compressed by {size}, and none can be by more than {most}"
    outside = np.where(contacts.fixed & (pressed > 0.0), np.abs(across), 0.0)
    if (outside > contacts.room).any():
        return (
            f"the inner race would move {with_prefix(float(outside.max()), 'm')} along the outer "
            f"one, off a {element} of {with_prefix(2.0 * float(contacts.room.max()), 'm')} length"
        )
    return (
        "the inner ring would move out of the outer one, past the "
        f"{with_prefix(float(contacts.distance.min()), 'm')} between the groove centres"
    )


def descent_direction(
    contacts: kernels.Contacts, cage_angle: float, active: NDArray[np.int64], load: Array
) -> tuple[Array, float]:
    """Return a direction (len(active),) in which the load does work and no ball is ever pressed.

    Also returns its share of the load, which is 0 if contacts can carry all of the load.

    A ball stays free for ever only if it moves straight back along its unloaded line of contact. So
    these directions are the cone e_j·w ≤ 0, t_j·w = 0 over all balls. The line of contact of
    rollers is fixed: they may also move across it, and only e_j·w ≤ 0 holds. The direction nearest
    to the load is the part that contacts cannot carry, F − Σ a_j e_j − Σ b_j t_j with a_j ≥ 0.
    """
    from scipy.optimize import nnls  # imported late: slow to import

    nothing = np.zeros(len(active)), 0.0
    if not load.any():
        return nothing
    phi = contacts.angles_at(np.array([cage_angle]))[0]
    ca, sa = contacts.line_r, contacts.line_z
    across = contacts.gradients(phi, -sa, ca)[~contacts.fixed][:, active]
    across[np.abs(across) < ROUNDING] = 0.0
    # directions with t_j·w = 0: the null space of all t_j
    _, sizes, vectors = np.linalg.svd(across)
    held = np.count_nonzero(sizes > 1e-10)
    free = vectors[held:]
    if not len(free):
        return nothing
    pressing = free @ contacts.gradients(phi, ca, sa)[:, active].T
    # their rounding grows with the unevenness of the stiffness in the held directions
    unevenness = sizes[0] / sizes[held - 1] if held else 1.0
    pressing[np.abs(pressing) < max(ROUNDING, 10.0 * np.finfo(float).eps * unevenness)] = 0.0
    along = free @ load / np.linalg.norm(load)
    carried, _ = nnls(pressing, along, maxiter=100 * pressing.shape[1])
    rest = along - pressing @ carried
    return rest @ free, float(np.linalg.norm(rest))


def is_unbounded(
    contacts: kernels.Contacts, cage_angle: float, active: NDArray[np.int64], load: Array
) -> bool:
    """Return True if the load does work in a motion that never presses a ball.

    The energy then falls without end. `load` belongs to the active directions.
    """
    return descent_direction(contacts, cage_angle, active, load)[1] > kernels.RESIDUAL_LIMIT
