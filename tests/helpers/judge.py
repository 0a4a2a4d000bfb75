"""A judge of static answers, by the independent contact law."""

import itertools
import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from bearingcore import DOF_NAMES, Equilibrium
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene._packing import contacts
from bearingcore.model.statics._shortage import descent_direction
from tests.helpers.contact_law import Array, Balls, Long, centers_apart

RESIDUAL = 1e-9
"""What every answer has to meet, relative to the load."""

ABOUT_TO_PASS = 1e-9
"""Part of A0. A loaded ball whose groove centres have passed each other is held across its line
only, and the stiffness jumps there; nearer to passing than this, either is right."""

NO_STIFFNESS = 1e-13
"""Part of the greatest stiffness that the rounding of forty balls in double precision may hide."""

FAINT, TOO_FAINT = 1e-8, 1e-13
"""Parts of the load. Where only balls that carry less hold a direction, it may be called free,
and below the second it must: what a residual cannot see holds nothing."""


def rounding_of_residual(balls: Balls, q: Array) -> float:
    """Residual [N] that rounding of q and of the balls' places to double precision can make.

    A digit lost of q changes a compression by ε|q|, and the load by the contact's stiffness times
    that; a digit lost of a ball's angle counts where a loaded ball stands on a defect's edge.
    """
    steepest = np.sum(balls.contact_stiffness(balls.ball_load(q)))
    return float(4.0 * np.finfo(float).eps * reach_of(balls, q) * steepest)


def reach_of(balls: Balls, q: Array) -> float:
    """The greatest of the lengths [m] whose last digits a compression inherits."""
    bearing = balls.scene.bearing
    length = bearing.groove_center_distance or bearing.ball_diameter
    size = float(np.abs(q).max()) + length + abs(bearing.radial_clearance)
    deepest = max((defect.depth for defect in balls.scene.defects), default=0.0)
    on_edge = (balls.drop > 0.0) & (balls.drop < deepest) & (balls.ball_load(q) > 0.0)
    if np.any(on_edge):
        size += 10.0 * bearing.outer_raceway_radius
    return size


REACHES = (1e-3, 1e-5, 1e-7)
"""How far to go along a free direction, in parts of the greatest compression or of A0: the nearer
ones where other balls or centres about to pass are met before."""


def flat_directions(
    balls: Balls, q: Array, active: list[int], faint: float, passed: float
) -> NDArray[np.float64]:
    """Orthonormal directions (k, 5) out of `active` along which no loaded ball feels anything.

    Balls count that carry more than the part `faint` of the load.
    """
    loaded = balls.ball_load(q) > faint * balls.whole_load(q, active)
    held_across = loaded & (balls.vector(q)[2] > passed)
    along, across = balls.directions(q)
    rows = np.vstack([along[loaded], across[held_across]])[:, active].astype(float)
    _, sizes, vectors = np.linalg.svd(np.vstack([rows, np.zeros((len(active), len(active)))]))
    still = vectors[sizes[: len(active)] <= 1e-9 * max(sizes[0], 1e-300)]
    flat = np.zeros((len(still), 5))
    flat[:, active] = still
    return flat


def way_to_move(
    balls: Balls, q: Array, flat: NDArray[np.float64], dof: int, reach: float
) -> NDArray[np.float64]:
    """The combination (5,) of flat directions that moves `dof` most at no cost.

    It must not bring centres back that are about to pass, nor press a ball that just touches.
    Zero where every combination would.
    """
    load, depth = balls.ball_load(q), balls.compression(q)
    passing = balls.vector(q)[2]
    nearly = -3.0 * reach / centers_apart(balls.scene.bearing)
    about = (load > 0.0) & (passing > nearly) & (passing <= ABOUT_TO_PASS)
    touching = (depth > -3.0 * reach) & (load <= FAINT * np.max(load))
    along = np.vstack([balls.along_across[0][about], balls.directions(q)[0][touching]])
    along = along.astype(float)
    best = np.zeros(5)
    for sign in (-1.0, 1.0):
        answer = linprog(
            -sign * flat[:, dof],
            A_ub=along @ flat.T if len(along) else None,
            b_ub=np.zeros(len(along)) if len(along) else None,
            bounds=(-1.0, 1.0),
        )
        way = answer.x @ flat
        if abs(way[dof]) > abs(best[dof]):
            best = way
    return best


def verdict(answer: Equilibrium, i: int) -> str:
    """Return the fault of the answer at cage angle i; an empty string where there is none."""
    balls = Balls(answer.scene, float(answer.cage_angles[i]))
    active = [DOF_NAMES.index(name) for name in answer.dofs]
    judge = {
        kernels.CONVERGED: _judge_converged,
        kernels.NOTHING_TOUCHES: _judge_nothing_touches,
        kernels.FREE_DIRECTION: _judge_free,
        kernels.NOT_CARRIED: _judge_not_carried,
        kernels.BEYOND: _judge_beyond,
    }.get(int(answer.status[i]))
    if judge is None:
        return answer.reason(i)
    return judge(answer, i, balls, active)


def _judge_equilibrium(
    answer: Equilibrium, i: int, balls: Balls, q: Array, active: list[int]
) -> str:
    """Balance of forces, ball loads and stiffness at q, which is an answer or one of many."""
    size = balls.whole_load(q, active)
    spoilt = rounding_of_residual(balls, q)
    rounding = spoilt / size
    if not answer.residual[i] <= max(RESIDUAL, rounding):
        return f"residual said to be {answer.residual[i]:.2e}"
    residual = balls.unbalanced(q, active) / size
    if not residual <= RESIDUAL + rounding:
        return f"residual is {residual:.2e}, rounding makes {rounding:.1e} of it"
    loads = balls.ball_load(q).astype(float)
    off = np.abs(answer.ball_load[i] - loads).max() / size
    if not off <= RESIDUAL + rounding:
        return f"ball loads off by {off:.2e} of the load"
    if answer.loaded_balls[i] != np.count_nonzero(answer.ball_load[i] > 0.0):
        return "number of loaded balls is not that of ball loads above zero"
    units = balls.units.astype(float)
    K = answer.stiffness[i] / (units[:, None] * units)
    if not np.all(np.isfinite(K)) or not np.array_equal(answer.stiffness[i], answer.stiffness[i].T):
        return "stiffness not symmetric"
    values = np.linalg.eigvalsh(K)
    if not values[0] >= -1e-13 * values[-1]:
        return f"stiffness has an eigenvalue of {values[0] / values[-1]:.1e} of the greatest"
    faint = FAINT * size if answer.status[i] != kernels.CONVERGED else 0.0
    least = balls.stiffness(q, ABOUT_TO_PASS, faint).astype(float)
    most = balls.stiffness(q, -ABOUT_TO_PASS).astype(float)
    # what rounding leaves of a load it leaves of a stiffness, more where a ball only just touches
    spoilt += 1e-12 * size
    touched = loads > 0.0
    close = np.abs(balls.compression(q)) <= 8.0 * np.finfo(float).eps * reach_of(balls, q)
    push = balls.contact_stiffness(loads)[touched]
    least_push = balls.contact_stiffness(np.full(loads.shape, spoilt))
    grace = np.minimum(push * spoilt / loads[touched], least_push[touched])
    nearly = np.sum(least_push[close])
    allowed = 1e-11 * values[-1] + 4.0 * float(np.sum(grace) + nearly)
    for below, above in ((least, K), (K, most)):
        off = -np.linalg.eigvalsh(above - below)[0]
        if not off <= allowed:
            return f"stiffness off by {off / values[-1]:.1e}"
    return ""


def _judge_converged(answer: Equilibrium, i: int, balls: Balls, active: list[int]) -> str:
    """A balanced state, held in every active direction, hence the only one."""
    q = answer.displacement[i] * balls.units
    held = [k for k in range(5) if k not in active]
    if np.any(q[held] != 0.0) or not np.all(np.isfinite(q)):
        return "displacement moves where it is held, or is not a number"
    wrong = _judge_equilibrium(answer, i, balls, q, active)
    if not wrong and (excess := beyond_geometry(balls, q)) > 1.0 + 1e-6:
        return f"called converged, though {excess:.3g} of what the geometry allows"
    if not wrong and len(flat_directions(balls, q, active, TOO_FAINT, -ABOUT_TO_PASS)):
        return "called converged, though a direction is free"
    return wrong


def beyond_geometry(balls: Balls, q: Array) -> float:
    """Share that a state has of the most that the contacts' geometry allows; above 1 is beyond it.

    A tilt of 0.2 rad, half a ball or roller of compression, and as much of a way back of the inner
    groove from a loaded ball as there is between the groove centres, whatever the ball has sunk by.
    """
    bearing = balls.scene.bearing
    pressed = balls.compression(q)
    room = np.concatenate([np.full(int(row["n"]), 0.5 * row["D"]) for row in balls.rows])
    back = 1.0 - (balls.vector(q)[2] + balls.drop / balls.distance)
    parts = [np.max(np.abs(q[3:])) / bearing.groove_center_radius / 0.2, np.max(pressed / room)]
    parts.append(np.max(back[balls.ball_load(q) > 0.0], initial=0.0))
    return float(max(parts))


def _judge_beyond(answer: Equilibrium, i: int, balls: Balls, active: list[int]) -> str:
    """A balance of the formulas, kept as a state alone, that the contacts' geometry excludes."""
    q = answer.state[i].astype(Long)
    parts = (answer.displacement[i], answer.stiffness[i], answer.ball_load[i])
    if any(np.any(np.isfinite(part)) for part in parts) or answer.loaded_balls[i] != 0:
        return "a state that is not has a number"
    size = balls.whole_load(q, active)
    left = balls.unbalanced(q, active) / size
    if not left <= RESIDUAL + rounding_of_residual(balls, q) / size:
        return f"called a balance of the formulas, with a residual of {left:.2e}"
    part = beyond_geometry(balls, q)
    return "" if part > 1.0 - 1e-6 else f"called beyond the geometry at {part:.3g} of it"


def _judge_nothing_touches(answer: Equilibrium, i: int, balls: Balls, active: list[int]) -> str:
    """No load along the active directions, and a place where no ball is pressed."""
    if np.any(balls.load[active] != 0.0):
        return "nothing touches, though a load acts"
    middle = np.zeros(5)
    wedged = np.max(balls.ball_load(middle))
    if 2 in active:
        # a clearance beyond A0 presses a ring in its middle, unless it moves along its axis
        bearing = balls.scene.bearing
        middle[2] = -bearing.radial_clearance * math.tan(bearing.contact_angle)
    pressed = min(np.max(balls.ball_load(q)) for q in (middle, answer.state[i]))
    if pressed > 1e-9 * wedged + 1e-12:
        return f"nothing touches, though a ball is pressed by {pressed:.1e} N"
    if not np.all(np.isnan(answer.displacement[i])) or not np.all(np.isnan(answer.stiffness[i])):
        return "an undetermined place has a number"
    if np.any(answer.ball_load[i] != 0.0) or answer.loaded_balls[i] != 0:
        return "nothing touches, yet a ball carries load"
    return ""


def _judge_free(answer: Equilibrium, i: int, balls: Balls, active: list[int]) -> str:
    """A balanced state, and the directions named are those that can move at no cost."""
    q = answer.state[i].astype(Long)
    wrong = _judge_equilibrium(answer, i, balls, q, active)
    if wrong:
        return wrong
    flat = flat_directions(balls, q, active, FAINT, ABOUT_TO_PASS)
    if not len(flat):
        # held by so little that a double cannot tell it from nothing
        K = balls.stiffness(q).astype(float)[np.ix_(active, active)]
        values, vectors = np.linalg.eigh(K)
        flat = np.zeros((np.count_nonzero(values < NO_STIFFNESS * values[-1]), 5))
        flat[:, active] = vectors.T[: len(flat)]
    if not len(flat):
        return "called free, though every direction is held"
    named = np.isnan(answer.displacement[i])
    most = np.abs(flat).max(axis=0) > 1e-6
    surely = flat_directions(balls, q, active, TOO_FAINT, -ABOUT_TO_PASS)
    least = np.abs(surely).max(axis=0, initial=0.0) > 1e-6
    if not named.any() or np.any(named & ~most) or np.any(least & ~named):
        return f"free are {np.flatnonzero(most)}, named are {np.flatnonzero(named)}"
    size = min(float(balls.compression(q).max()), centers_apart(balls.scene.bearing))
    for dof in np.flatnonzero(named):
        if not any(
            _costs_nothing(balls, q, active, flat, int(dof), part * size) for part in REACHES
        ):
            return f"energy rises along direction {dof}, called free"
    return ""


def _costs_nothing(
    balls: Balls, q: Array, active: list[int], flat: NDArray[np.float64], dof: int, reach: float
) -> bool:
    """Return True if the energy [N·m] stays the same at `reach` [m] along some free direction."""
    # the load's own share is the residual that is allowed
    stiffest = float(np.trace(balls.stiffness(q)))
    allowed = 1e-9 * stiffest * reach**2 + 1e-8 * balls.whole_load(q, active) * reach
    allowed += 16.0 * balls.rounding(q)
    level = balls.energy(q)

    def rise(way: Array) -> float:
        return abs(float(balls.energy(q + reach * way.astype(Long)) - level))

    straight = flat[np.argmax(np.abs(flat[:, dof]))]
    if min(rise(straight), rise(-straight)) <= allowed:
        return True
    way = way_to_move(balls, q, flat, dof, reach)
    if abs(way[dof]) < 1e-7:
        # balls that just touch on all sides press with the power 1.5, so without stiffness
        way = straight
        pressed = np.maximum(balls.compression(q + reach * way), 0.0).astype(float)
        faint = balls.ball_load(q) <= FAINT * balls.whole_load(q, active)
        stored = balls.factor * pressed ** (balls.exponent + 1)
        allowed += float(np.sum(stored[faint]))
    return rise(way) <= allowed


def _judge_not_carried(answer: Equilibrium, i: int, balls: Balls, active: list[int]) -> str:
    """There is a direction in which the energy falls without end."""
    if np.any(np.isfinite(answer.displacement[i])) or np.any(np.isfinite(answer.stiffness[i])):
        return "a state that is not has a number"
    w, share = descent_direction(
        contacts(balls.scene.bearing),
        balls.cage_angle,
        np.array(active),
        balls.load[active].astype(float),
    )
    if share < 0.5 * RESIDUAL:
        return f"called not carried, though contacts can carry all but {share:.1e} of the load"
    # that way out is where to look, and what is looked for is the fall of the energy
    way = np.zeros(5, dtype=Long)
    way[active] = w / np.linalg.norm(w)
    along, across = balls.along_across
    pressed = max(float((along @ way).max()), float(np.abs(across @ way).max()))
    if pressed > 1e-7 + 1e-15 / share:
        return f"the way out presses a ball by {pressed:.1e} of it"
    fall = share * float(np.linalg.norm(balls.load[active].astype(float)))
    if abs(float(balls.load @ way) - fall) > 1e-3 * fall + 1e-14 * float(np.abs(balls.load).max()):
        return "the load does not work along the way out as it should"
    bearing = balls.scene.bearing
    length = bearing.groove_center_distance or bearing.ball_diameter
    # far enough out that every ball which moves back has lost touch
    far = 1e3 * float(length + balls.drop.max() + abs(bearing.radial_clearance))
    levels = [float(balls.energy(far * k * way)) for k in (1, 2, 4, 8)]
    if not all(b - a < -0.4 * fall * far for a, b in itertools.pairwise(levels)):
        return f"energy does not fall without end: {levels}"
    return ""
