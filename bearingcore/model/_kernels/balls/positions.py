"""Static ball positions under centrifugal load: the minimum of a convex energy, as in `statics`.

A ball's position b is free in the plane through the ball. With F_j its radial load (centrifugal
load less weight),

    V(q, b) = Σ_j [ E_i(δ_i,j) + E_e(δ_e,j) − F_j b_r,j ] − F·q,   E(δ) = K/(n + 1) δ^(n+1),

is convex in q and all b together: lengths of affine vectors are convex, and the functions of them
are increasing and convex or linear. The least energy over all b,

    V(q) = Σ_j W_j(q) − F·q,

is convex too. Each ball adds the gradient Q_i e_i of its inner contact and the Hessian
(M_i⁻¹ + M_e⁻¹)⁻¹; the stiffness of a contact is M = k₁ e e' + (Q/A) t t'. Newton's method with a
line search finds each minimum: one problem in q, and inside it a 2×2 problem for each ball.
Without F_j both contacts are on one line, and this is the energy of `statics`.

Symbols are those of `motion`; the outer ring stands still.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.model._kernels.balls.structs import INNER, OUTER, Races
from bearingcore.model._kernels.codes import (
    CONVERGED,
    FREE_DIRECTION,
    NOT_CARRIED,
    NOT_CONVERGED,
    NOTHING_TOUCHES,
)
from bearingcore.model._kernels.compiling import called, compiled, inlined
from bearingcore.model._kernels.contact import (
    components,
    compression_under,
    contact_load,
    race_touch,
    ring_at_ball,
    tilting,
)
from bearingcore.model._kernels.path import lay_out_drops, place_balls
from bearingcore.model._kernels.statics import (
    NO_PIVOT,
    RESIDUAL_AIM,
    RESIDUAL_LIMIT,
    ROUNDING,
    has_descended,
    least_pivot,
    load_size,
    new_map_work,
    newton_direction,
    shorten_step,
    sizes_at,
    slope_along,
    typical_stiffness,
)
from bearingcore.model._kernels.structs import Array, Contacts, Integers, Path

MOST_BALL_STEPS, MOST_RING_STEPS = 200, 200
BALL_AIM, BALL_LIMIT = 1e-15, 1e-10
"""Unbalanced load of a ball over its loads: the aim, and the limit that is still accepted."""


class StaticBalls(NamedTuple):
    """A bearing whose balls are free to move, with the path over the defects of each race."""

    contacts: Contacts
    races: Races
    inner_path: Path
    outer_path: Path


class BallPlaces(NamedTuple):
    """Positions and loads of the balls, each array (n,), or (2, n) by race.

    Attributes
    ----------
    c, s
        cosine and sine of the angles of the balls.
    drop : (2, n) [m]
    place : (2, n) [m]
        radial and axial position.
    known : (n,)
        1 where `place` is a good first guess.
    load : (2, n) [N], er : (2, n), ez : (2, n)
        load and direction of the inner and the outer contact.
    """

    c: Array
    s: Array
    drop: Array
    place: Array
    known: Array
    load: Array
    er: Array
    ez: Array


@inlined
def contact_terms(r, z, drop, race, j, balls):
    """Return energy, load, e and stiffness (rr, rz, zz) of one contact, which (r, z) closes."""
    races = balls.races
    delta, er, ez, inverse_A = race_touch(r, z, drop, races.distance[race, j], j, balls.contacts)
    if delta <= 0.0:
        return 0.0, 0.0, er, ez, 0.0, 0.0, 0.0
    energy, Q, k1 = contact_load(delta, races.factor[race, j], balls.contacts.exponent[j])
    k2 = Q * inverse_A
    return (
        energy,
        Q,
        er,
        ez,
        k1 * er * er + k2 * ez * ez,
        (k1 - k2) * er * ez,
        k1 * ez * ez + k2 * er * er,
    )


@inlined
def first_place(r, z, force, j, balls, places):
    """Return a first guess of ball j's position (radial, axial), and True if it touches there.

    (r, z) is the displacement of the inner groove's centre, less the clearance.
    """
    contacts = balls.contacts
    races = balls.races
    ca = contacts.line_r[j]
    sa = contacts.line_z[j]
    exponent = contacts.exponent[j]
    Ai = races.distance[INNER, j]
    Ae = races.distance[OUTER, j]
    di = places.drop[INNER, j]
    de = places.drop[OUTER, j]
    delta, er, ez, _ = race_touch(r, z, di + de, Ai + Ae, j, contacts)
    if delta > 0.0:
        # Both contacts are on one line, and share the compression in proportion to their softness.
        soft_i = races.factor[INNER, j] ** (-1.0 / exponent)
        soft_e = races.factor[OUTER, j] ** (-1.0 / exponent)
        reach = Ae + delta * soft_e / (soft_i + soft_e)
        return reach * er - (Ae - de) * ca, reach * ez - (Ae - de) * sa, True
    # The ball is in the gap: it lies on the race against which its own load presses it.
    if force >= 0.0:
        reach = Ae + compression_under(force, races.factor[OUTER, j], exponent)
        return reach - (Ae - de) * ca, -(Ae - de) * sa, force > 0.0
    reach = Ai + compression_under(-force, races.factor[INNER, j], exponent)
    return r + (Ai - di) * ca - reach, z + (Ai - di) * sa, True


@inlined
def series_stiffness(i_rr, i_rz, i_zz, e_rr, e_rz, e_zz, i_r, i_z):
    """Return the stiffness (M_i⁻¹ + M_e⁻¹)⁻¹ [N/m] of both contacts of a ball in series.

    It is computed as M_e (M_i + M_e)⁻¹ M_i, which subtracts no nearly equal numbers and leaves a
    direction without stiffness at 0. (i_r, i_z) is the line of the inner contact.
    """
    h_rr = i_rr + e_rr
    h_rz = i_rz + e_rz
    h_zz = i_zz + e_zz
    det = h_rr * h_zz - h_rz * h_rz
    trace = h_rr + h_zz
    if det < 1e-300 + 1e-15 * trace * trace:
        # M_i + M_e is singular across the line of contact. A spring of any stiffness there leaves
        # the answer along the line as it is.
        h_rr += trace * i_z * i_z
        h_rz -= trace * i_r * i_z
        h_zz += trace * i_r * i_r
        det = h_rr * h_zz - h_rz * h_rz
    v_rr = (h_zz * i_rr - h_rz * i_rz) / det
    v_rz = (h_zz * i_rz - h_rz * i_zz) / det
    v_zr = (h_rr * i_rz - h_rz * i_rr) / det
    v_zz = (h_rr * i_zz - h_rz * i_rz) / det
    w_rr = e_rr * v_rr + e_rz * v_zr
    w_rz = e_rr * v_rz + e_rz * v_zz
    w_zz = e_rz * v_rz + e_zz * v_zz
    return w_rr, w_rz, w_zz


@called
def settle_ball(r, z, j, balls, places):
    """Move ball j to its position of least energy, at a displacement (r, z) of the inner groove.

    The energy of ball position b = (br, bz), W(b) = E_i(δ_i) + E_e(δ_e) − F b_r, is convex.
    Newton's method needs its gradient g = ∂W/∂b = Q_e e_e − Q_i e_i − (F, 0), which is 0 where the
    loads of the ball balance, and its Hessian H = M_i + M_e, the stiffness of both contacts. A move
    of b closes the outer contact and opens the inner one, hence the signs.

    Returns W [N·m], True if the ball settled, and the stiffness (rr, rz, zz) [N/m] that the ball
    gives to the inner ring. Position, loads and directions go into `places`.
    """
    races = balls.races
    factor = races.factor[OUTER, j]
    exponent = balls.contacts.exponent[j]
    force = races.centrifugal[j] - races.weight[j] * places.s[j]
    if places.known[j] > 0.0:
        br = places.place[0, j]
        bz = places.place[1, j]
    else:
        br, bz, touches = first_place(r, z, force, j, balls, places)
        if not touches:
            places.place[0, j] = br
            places.place[1, j] = bz
            places.load[INNER, j] = 0.0
            places.load[OUTER, j] = 0.0
            return 0.0, True, 0.0, 0.0, 0.0
    # `contact_terms` of both contacts at (br, bz), the best position so far
    inner = outer = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)
    W = 0.0
    scale = 0.0
    slope = 0.0
    pr = 0.0
    pz = 0.0
    shift = 1e-6
    settled = False
    step = 0.0
    before = math.inf
    residual = math.inf
    x = br
    y = bz
    tries = 0
    for _ in range(MOST_BALL_STEPS):
        # Evaluate at the trial position (x, y); in the first round this is the first guess itself.
        inner1 = contact_terms(r - x, z - y, places.drop[INNER, j], INNER, j, balls)
        outer1 = contact_terms(x, y, places.drop[OUTER, j], OUTER, j, balls)
        Ei, Qi, i_r, i_z, i_rr, i_rz, i_zz = inner1
        Ee, Qe, e_r, e_z, e_rr, e_rz, e_zz = outer1
        W1 = Ei + Ee - force * x
        gr = Qe * e_r - Qi * i_r - force
        gz = Qe * e_z - Qi * i_z
        slope1 = gr * pr + gz * pz
        rounding = 1e-14 * (scale + abs(W1))
        if not (step == 0.0 or has_descended(W, W1, slope, slope1, step, rounding)):
            tries += 1
            if tries > 60:
                break
            step = shorten_step(step, slope, slope1)
            x = br + step * pr
            y = bz + step * pz
            continue
        # The energy has fallen: take the step, and test the balance of loads there.
        br = x
        bz = y
        W = W1
        inner = inner1
        outer = outer1
        scale = Ei + Ee + abs(force * x)
        size = Qi + Qe + abs(force)
        norm = math.sqrt(gr * gr + gz * gz)
        if norm == 0.0:
            settled = True
            break
        residual = norm / size
        h_rr = i_rr + e_rr
        h_rz = i_rz + e_rz
        h_zz = i_zz + e_zz
        lost = ROUNDING * (abs(r) + abs(z) + abs(br) + abs(bz)) * max(h_rr, h_zz) / size
        # Lost digits of the positions leave a residual: one of that size that no longer halves is
        # rounding.
        if residual <= BALL_AIM or (residual <= max(BALL_LIMIT, lost) and residual >= 0.5 * before):
            settled = True
            break
        before = residual
        # Newton's step p = −H⁻¹ g: two equations.
        det = h_rr * h_zz - h_rz * h_rz
        trace = h_rr + h_zz
        if not det > 1e-13 * trace * trace:
            # One contact alone has no stiffness across its line. A small spring stands in for it,
            # and is made weaker at each use.
            spring = shift * max(typical_stiffness(size, factor, exponent), trace)
            shift = max(0.1 * shift, 1e-12)
            h_rr += spring
            h_zz += spring
            det = h_rr * h_zz - h_rz * h_rz
        pr = -(h_zz * gr - h_rz * gz) / det
        pz = -(h_rr * gz - h_rz * gr) / det
        slope = gr * pr + gz * pz
        step = 1.0
        tries = 0
        x = br + pr
        y = bz + pz
    settled = settled or residual <= BALL_LIMIT
    _, Qi, i_r, i_z, i_rr, i_rz, i_zz = inner
    _, Qe, e_r, e_z, e_rr, e_rz, e_zz = outer
    places.place[0, j] = br
    places.place[1, j] = bz
    places.known[j] = 1.0 if settled and Qi + Qe > 0.0 else 0.0
    places.load[INNER, j] = Qi
    places.load[OUTER, j] = Qe
    places.er[INNER, j] = i_r
    places.ez[INNER, j] = i_z
    places.er[OUTER, j] = e_r
    places.ez[OUTER, j] = e_z
    if Qi == 0.0 or Qe == 0.0:
        return W, settled, 0.0, 0.0, 0.0
    w_rr, w_rz, w_zz = series_stiffness(i_rr, i_rz, i_zz, e_rr, e_rz, e_zz, i_r, i_z)
    return W, settled, w_rr, w_rz, w_zz


@called
def ring_energy(q, force, balls, places, g, H):
    """Compute V(q) [N·m] with all balls at their minima, its gradient g (5,) and Hessian H (5, 5).

    Returns V, the sum of the sizes of its terms, and True if all balls settled.
    """
    contacts = balls.contacts
    x = components(q)
    energy = 0.0
    size = 0.0
    settled = True
    for a in range(5):
        g[a] = -force[a]
        size += abs(force[a] * q[a])
        energy -= force[a] * q[a]
        for b in range(5):
            H[a, b] = 0.0
    for j in range(contacts.angle.size):
        cj = places.c[j]
        sj = places.s[j]
        r, z = ring_at_ball(x, cj, sj, j, contacts)
        r -= contacts.clearance[j]
        z += contacts.offset[j]
        W, done, rr, rz, zz = settle_ball(r, z, j, balls, places)
        settled = settled and done
        energy += W
        size += abs(W)
        Q = places.load[INNER, j]
        if Q == 0.0:
            continue  # the ball does not press the inner race
        er = places.er[INNER, j]
        ez = places.ez[INNER, j]
        et = tilting(er, ez, j, contacts)
        g[0] += Q * er * cj  # Equation (15)
        g[1] += Q * er * sj
        g[2] += Q * ez
        g[3] += Q * et * sj
        g[4] -= Q * et * cj
        # R and Z are the derivatives by q of r and z, the groove centre's place (Eqs. 11 and 12).
        arm = contacts.arm[j]
        reach = contacts.reach[j]
        R = (cj, sj, 0.0, -arm * sj, arm * cj)
        Z = (0.0, 0.0, 1.0, reach * sj, -reach * cj)
        for a in range(5):
            for b in range(a + 1):
                H[a, b] += rr * R[a] * R[b] + rz * (R[a] * Z[b] + Z[a] * R[b]) + zz * Z[a] * Z[b]
    return energy, size, settled


@called
def settle_ring(q, load, balls, places, work):
    """Move q to the minimum of V(q) = Σ_j W_j(q) − F·q. Returns (which, status, residual, steps).

    This is Newton's method as in `descend`, but each evaluation settles all balls first. Balls are
    left where they settled at the final q, to which work.g[which] and work.H[which] belong.
    """
    F = load.force
    active = load.active
    squared_load = load_size(load) ** 2
    now = 0
    V, scale, settled = ring_energy(q, F, balls, places, work.g[0], work.H[0])
    residual = math.inf
    shift = 1e-6
    for iteration in range(MOST_RING_STEPS):
        g = work.g[now]
        H = work.H[now]
        norm, reactions, reach, stiffest = sizes_at(q, g, H, F, active, 0.0)
        # The residual is what is out of balance, |g|, over the whole load. The reactions along held
        # directions are part of the load.
        total_load = math.sqrt(max(squared_load + reactions, 0.0))
        if norm == 0.0 and total_load == 0.0:
            return now, NOTHING_TOUCHES, math.nan, iteration
        # In a preloaded bearing balls press the ring from both sides, harder than any load shows.
        for j in range(places.c.size):
            total_load = max(total_load, places.load[INNER, j])
        before = residual
        residual = math.sqrt(norm) / total_load
        limit = max(RESIDUAL_LIMIT, ROUNDING * reach * stiffest / total_load)
        stays = residual <= limit and residual >= 0.5 * before
        if settled and (residual <= RESIDUAL_AIM or stays):
            least = least_pivot(H, active, work.L)
            return now, CONVERGED if least > NO_PIVOT else FREE_DIRECTION, residual, iteration
        if not newton_direction(H, g, active, 0.0, work.L, work.p) > 1e-12:
            # Too few balls touch: a small spring to ground replaces the missing stiffness.
            newton_direction(H, g, active, shift * max(stiffest, 1.0), work.L, work.p)
            shift = max(0.1 * shift, 1e-12)
        slope = slope_along(g, work.p, active)
        # line search: shorten Newton's step until V falls
        step = 1.0
        accepted = False
        for _ in range(50):
            for a in range(5):
                work.trial[a] = q[a]
            for a in active:
                work.trial[a] = q[a] + step * work.p[a]
            V1, scale1, settled = ring_energy(
                work.trial, F, balls, places, work.g[1 - now], work.H[1 - now]
            )
            slope1 = slope_along(work.g[1 - now], work.p, active)
            if has_descended(V, V1, slope, slope1, step, 1e-13 * max(scale, scale1)):
                accepted = True
                break
            step = shorten_step(step, slope, slope1)
        if not accepted:
            _, _, settled = ring_energy(q, F, balls, places, work.g[now], work.H[now])
            status = CONVERGED if settled and residual <= limit else NOT_CONVERGED
            return now, status, residual, iteration
        for a in active:
            q[a] = work.trial[a]
        V = V1
        scale = scale1
        now = 1 - now
    return now, NOT_CONVERGED, residual, MOST_RING_STEPS


def ball_positions(cage_angles, leads, start, balls, load):
    """Return the static equilibrium with free balls at each cage angle, as `PositionAnswers`.

    The search begins at displacements `start` (n, 5) of the ring. leads (n,) [rad]: angle by which
    turning defects are ahead of their place at the cage angle.
    """
    n = cage_angles.size
    n_balls = balls.contacts.angle.size
    answers = PositionAnswers(
        start.copy(),
        np.zeros((2, n, n_balls)),
        np.full((2, n, n_balls), math.nan),
        np.zeros((n, 2, n_balls)),
        np.zeros((n, 5, 5)),
        np.zeros(n, dtype=np.int8),
        np.empty(n),
        np.zeros(n, dtype=np.int64),
    )
    c, s, known = np.zeros((3, n_balls))
    drop, place, load_of_race, er, ez = np.zeros((5, 2, n_balls))
    places = BallPlaces(c, s, drop, place, known, load_of_race, er, ez)
    work = new_map_work(balls.contacts.angle), places
    find_positions(cage_angles, leads, start, balls, load, answers, work)
    return answers


class PositionAnswers(NamedTuple):
    """Output of `ball_positions` at n cage angles; tilts and moments are scaled as in `structs`.

    q (n, 5) [m]; loads (2, n, balls) [N] and contact angles (2, n, balls) [rad], of the inner race
    first; where (n, 2, balls) [m], the positions; stiffness (n, 5, 5) [N/m]; the others (n,).
    """

    q: Array
    loads: Array
    angles: Array
    where: Array
    stiffness: Array
    status: NDArray[np.int8]
    residual: Array
    iterations: Integers


@compiled
def find_positions(cage_angles, leads, start, balls, load, answers, work):
    """Compiled body of `ball_positions`, with work space."""
    turning, places = work
    descent = turning.descent
    q = answers.q
    status = answers.status
    n_balls = places.c.size
    for k in range(cage_angles.size):
        cage = cage_angles[k]
        circle_c = turning.circle_c
        place_balls(cage, balls.contacts, circle_c, turning.circle_s, places.c, places.s)
        for race in range(2):
            path = balls.inner_path if race == INNER else balls.outer_path
            drop = places.drop[race]
            lay_out_drops(cage, leads[k], balls.contacts, path, drop, turning.slope)
        if k > 0 and status[k - 1] == CONVERGED:
            # Start with the shift of the ring, and the positions of the balls, at the last angle.
            for a in range(5):
                q[k, a] += q[k - 1, a] - start[k - 1, a]
        else:
            for j in range(n_balls):
                places.known[j] = 0.0
        now, status[k], answers.residual[k], answers.iterations[k] = settle_ring(
            q[k], load, balls, places, descent
        )
        for a in range(5):
            for b in range(a + 1):
                answers.stiffness[k, a, b] = descent.H[now, a, b]
                answers.stiffness[k, b, a] = descent.H[now, a, b]
        for j in range(n_balls):
            for race in range(2):
                answers.where[k, race, j] = places.place[race, j]
                answers.loads[race, k, j] = places.load[race, j]
                if status[k] < NOT_CARRIED and places.load[race, j] > 0.0:
                    angle = math.atan2(places.ez[race, j], places.er[race, j])
                    answers.angles[race, k, j] = angle
