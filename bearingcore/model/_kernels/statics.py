"""Static equilibrium (Eq. 15): the minimum of V(q), by Newton's method with a line search."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.model._kernels.codes import (
    BEYOND,
    CONVERGED,
    FREE_DIRECTION,
    NOT_CARRIED,
    NOT_CONVERGED,
    NOTHING_TOUCHES,
    OPEN,
)
from bearingcore.model._kernels.compiling import called, compiled, inlined
from bearingcore.model._kernels.contact import (
    carried,
    components,
    compression_under,
    contact_load,
    has_left,
    tilting,
    touch,
)
from bearingcore.model._kernels.path import lay_out_drops, place_balls
from bearingcore.model._kernels.structs import (
    Contacts,
    Descent,
    MapAnswers,
    MapMemory,
    MapPaths,
    MapWork,
    Path,
    Place,
)

# The iteration ends if the residual |∂V/∂q| over the load is below RESIDUAL_AIM. If rounding keeps
# it above, it is accepted below RESIDUAL_LIMIT. A Newton step is taken as it is if the least pivot,
# relative to the greatest stiffness, is above LEAST_PIVOT.
RESIDUAL_AIM, RESIDUAL_LIMIT, LEAST_PIVOT = 1e-12, 1e-9, 1e-12
# Most Newton steps of the plain descent, and of the descent at each softness of contacts. (Numba
# would compile the functions that take them anew for each plain integer.)
MOST_ITERATIONS, MOST_PATIENT_ITERATIONS = np.int64(60), np.int64(600)

# A stiffness below the first part of the greatest one is rounding. If a pivot is below the second,
# pivots taken in the order of the directions decide nothing, see `least_pivot`.
NO_PIVOT, DOUBTFUL_PIVOT = 1e-14, 1e-5

# The rounding of q times the stiffness is a residual that no step can remove: it is large when a
# light load meets stiff balls far from q = 0.
ROUNDING = 4e-16

# A ball that carries less than FAINT residuals may carry nothing. If the greatest stiffness is less
# than FAINT_STIFFNESS of that of one ball under the whole load, it is rounding.
FAINT, FAINT_STIFFNESS = 10.0, 1e-12


@inlined
def energy_gradient_hessian(q, force, place, contacts, g, H):
    """Compute V(q) [N·m], its gradient g (5,) [N] and Hessian H (5, 5) [N/m] (lower triangle).

    Returns V, a scale and the least load [N] of a touching ball. The scale is the sum of the sizes
    of V's terms; the rounding of V is a small part of it.
    """
    energy = 0.0
    faintest = math.inf
    f0 = 0.0
    f1 = 0.0
    f2 = 0.0
    f3 = 0.0
    f4 = 0.0
    rr_cc = 0.0
    rr_cs = 0.0
    rr_ss = 0.0
    rz_c = 0.0
    rz_s = 0.0
    zz = 0.0
    rt_cc = 0.0
    rt_cs = 0.0
    rt_ss = 0.0
    zt_c = 0.0
    zt_s = 0.0
    tt_cc = 0.0
    tt_cs = 0.0
    tt_ss = 0.0
    x = components(q)
    c = place.c
    s = place.s
    d = place.d
    for j in range(c.size):
        cj = c[j]
        sj = s[j]
        delta, er, ez, inverse_A = touch(x, cj, sj, d[j], j, contacts)  # Equations (7)-(14)
        if delta <= 0.0:
            continue
        stored, Q, k1 = contact_load(delta, contacts.factor[j], contacts.exponent[j])
        k2 = Q * inverse_A
        et = tilting(er, ez, j, contacts)
        nt = tilting(-ez, er, j, contacts)  # (−ez, er) is across the contact
        energy += stored
        faintest = min(faintest, Q)
        Qr = Q * er
        Qt = Q * et
        f0 += Qr * cj  # Equation (15)
        f1 += Qr * sj
        f2 += Q * ez
        f3 += Qt * sj
        f4 -= Qt * cj
        rr = k1 * er * er + k2 * ez * ez  # Appendix A: rr for (A.1), rz for (A.3), zz for (A.10)
        rz = (k1 - k2) * er * ez
        rt = k1 * er * et - k2 * ez * nt
        zt = k1 * ez * et + k2 * er * nt
        tt = k1 * et * et + k2 * nt * nt
        cc = cj * cj
        cs = cj * sj
        ss = sj * sj
        rr_cc += rr * cc
        rr_cs += rr * cs
        rr_ss += rr * ss
        rz_c += rz * cj
        rz_s += rz * sj
        zz += k1 * ez * ez + k2 * er * er
        rt_cc += rt * cc
        rt_cs += rt * cs
        rt_ss += rt * ss
        zt_c += zt * cj
        zt_s += zt * sj
        tt_cc += tt * cc
        tt_cs += tt * cs
        tt_ss += tt * ss
    work = 0.0
    for i in range(5):
        work += force[i] * q[i]
    g[0] = f0 - force[0]
    g[1] = f1 - force[1]
    g[2] = f2 - force[2]
    g[3] = f3 - force[3]
    g[4] = f4 - force[4]
    H[0, 0] = rr_cc  # (A.1)
    H[1, 0] = rr_cs  # (A.2)
    H[1, 1] = rr_ss  # (A.6)
    H[2, 0] = rz_c  # (A.3)
    H[2, 1] = rz_s  # (A.7)
    H[2, 2] = zz  # (A.10)
    H[3, 0] = rt_cs  # (A.4)
    H[3, 1] = rt_ss  # (A.8)
    H[3, 2] = zt_s  # (A.11)
    H[3, 3] = tt_ss  # (A.13)
    H[4, 0] = -rt_cc  # (A.5)
    H[4, 1] = -rt_cs  # (A.9)
    H[4, 2] = -zt_c  # (A.12)
    H[4, 3] = -tt_cs  # (A.14)
    H[4, 4] = tt_cc  # (A.15)
    return energy - work, energy + abs(work), faintest


@called
def newton_direction(H, g, active, shift, L, p):
    """Compute p = −(H + shift·1)⁻¹ g over the active directions, by Cholesky's method.

    Returns the least pivot over the greatest diagonal element. If it is not above LEAST_PIVOT, p is
    not computed.
    """
    n = active.size
    greatest = 0.0
    for i in range(n):
        greatest = max(greatest, H[active[i], active[i]] + shift)
    if greatest <= 0.0:
        return 0.0
    least = 1.0
    for i in range(n):  # H = L L', with inverse numbers on the diagonal of L
        for j in range(i + 1):
            x = H[active[i], active[j]]
            if i == j:
                x += shift
            for k in range(j):
                x -= L[i, k] * L[j, k]
            if i == j:
                least = min(least, x / greatest)
                if not least > LEAST_PIVOT:
                    return least
                L[i, i] = 1.0 / math.sqrt(x)
            else:
                L[i, j] = x * L[j, j]
    for i in range(n):  # L y = −g
        x = -g[active[i]]
        for k in range(i):
            x -= L[i, k] * p[active[k]]
        p[active[i]] = x * L[i, i]
    for i in range(n - 1, -1, -1):  # L' p = y
        x = p[active[i]]
        for k in range(i + 1, n):
            x -= L[k, i] * p[active[k]]
        p[active[i]] = x * L[i, i]
    return least


@called
def least_pivot(H, active, A):
    """Return the least pivot of H over the active directions, relative to the greatest pivot.

    Each step takes the greatest pivot that is left. In any other order a pivot that should be zero
    would keep the rounding of earlier ones, divided by the least of them. A (5, 5) is work space.
    """
    n = active.size
    for i in range(n):
        for j in range(n):
            A[i, j] = H[max(active[i], active[j]), min(active[i], active[j])]
    greatest = 0.0
    least = 0.0
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if A[i, i] > A[best, best]:
                best = i
        for i in range(n):
            A[k, i], A[best, i] = A[best, i], A[k, i]
        for i in range(n):
            A[i, k], A[i, best] = A[i, best], A[i, k]
        least = A[k, k]
        if k == 0:
            greatest = least
        if least <= NO_PIVOT * greatest:
            return 0.0
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                A[i, j] -= A[i, k] * A[k, j] / least
    return least / greatest


@inlined
def replace_factors(contacts, factor):
    """Return the same contacts with other load-deflection factors (n,)."""
    return Contacts(
        contacts.angle,
        contacts.relative_speed,
        contacts.arm,
        contacts.reach,
        contacts.line_r,
        contacts.line_z,
        contacts.fixed,
        contacts.distance,
        contacts.clearance,
        contacts.offset,
        contacts.room,
        factor,
        contacts.exponent,
        contacts.rows,
        contacts.most_tilt,
    )


@called
def drop_negligible_contacts(q, noise, place, contacts, load, work, other):
    """Return the least pivot of the Hessian without the balls that carry less than `noise` [N].

    At the edge of a flat stretch of minima, balls that only just touch seem to hold the ring there.
    Gradient and Hessian without them go into work.g[other] and work.H[other].
    """
    factor = work.firm
    x = components(q)
    for j in range(factor.size):
        firm = noise < carried(x, place, j, contacts)
        factor[j] = contacts.factor[j] if firm else 0.0
    held = replace_factors(contacts, factor)
    H = work.H[other]
    energy_gradient_hessian(q, load.force, place, held, work.g[other], H)
    return least_pivot(H, load.active, work.L)


@called
def pressed_load(q, place, contacts):
    """Return the sum of the loads of all contacts [N]."""
    x = components(q)
    total = 0.0
    for j in range(contacts.factor.size):
        total += carried(x, place, j, contacts)
    return total


@inlined
def stiffest_contact(contacts):
    """Return the number of the contact with the greatest load-deflection factor."""
    stiffest = 0
    for j in range(contacts.factor.size):
        if contacts.factor[j] > contacts.factor[stiffest]:
            stiffest = j
    return stiffest


@inlined
def curved_length(contacts, j):
    """Return A0 [m] of contact j if its line can turn, which curves the valley of V; else 0."""
    return 0.0 if contacts.fixed[j] else contacts.distance[j]


@inlined
def load_size(load):
    """Return the size [N] of the load along the free directions."""
    size = 0.0
    for i in load.active:
        size += load.force[i] * load.force[i]
    return math.sqrt(size)


@inlined
def has_descended(V, V1, slope, slope1, step, rounding):
    """Return True if a line search may stop after a `step` that changed V into V1.

    V is convex: while its slope there, slope1, still points down, V has fallen, even if rounding
    hides it. Beyond the minimum along the direction, V must have fallen by a part of what the first
    slope promised (Armijo's rule). If that fall is less than `rounding`, the slope must at least be
    less steep than the first one.
    """
    return (
        slope1 <= 0.0
        or V + 1e-4 * step * slope >= V1
        or (slope1 <= 0.9 * abs(slope) and rounding >= V1 - V)
    )


@inlined
def shorten_step(step, slope, slope1):
    """Return a shorter step after one that went too far along Newton's direction.

    The slope is taken as a straight line from `slope` at 0 to `slope1` at the step; the new step
    ends at its zero (the secant), but is neither almost 0 nor almost as long as the old one. If
    rounding has left no rise of the slope, the secant is useless and a fixed part is taken.
    """
    rise = slope1 - slope
    return step * (min(max(-slope / rise, 0.05), 0.6) if rise > 0.0 else 0.3)


@inlined
def slope_along(g, p, active):
    """Return the slope of V [N·m] along p: g·p over the active directions."""
    slope = 0.0
    for i in active:
        slope += g[i] * p[i]
    return slope


@inlined
def typical_stiffness(load, factor, exponent):
    """Return the stiffness [N/m] of one contact that carries a whole load [N]."""
    _, _, stiffness = contact_load(compression_under(load, factor, exponent), factor, exponent)
    return stiffness


@inlined
def sizes_at(q, g, H, force, active, tight):
    """Return four sizes by which a gradient is judged.

    They are |g|² over the active directions; the square of the reactions g + F along the held
    directions; the greatest displacement, at least `tight`; and the greatest stiffness.
    """
    norm = 0.0
    reactions = 0.0
    reach = tight
    stiffest = 0.0
    for i in range(5):
        reactions += (g[i] + force[i]) ** 2
        reach = max(reach, abs(q[i]))
    for i in active:
        reactions -= (g[i] + force[i]) ** 2
        norm += g[i] * g[i]
        stiffest = max(stiffest, H[i, i])
    return norm, reactions, reach, stiffest


@inlined
def judge_minimum(q, noise, least, now, place, contacts, load, work):
    """Distinguish a minimum that is held in all directions from one with a free direction.

    H is positive definite at the first, and has a zero pivot at the second. `least` is the least
    pivot of work.H[now]. Contacts that carry less than `noise` [N] do not count; 0 counts all of
    them. Returns the status, and the index of work.g and work.H that belongs to it.
    """
    if noise > 0.0:
        # balls that only just touch must not make the minimum look firm
        least = drop_negligible_contacts(q, noise, place, contacts, load, work, 1 - now)
        if not least > NO_PIVOT:
            now = 1 - now
    if least < DOUBTFUL_PIVOT:
        least = least_pivot(work.H[now], load.active, work.L)
    return CONVERGED if least > NO_PIVOT else FREE_DIRECTION, now


@called
def descend(q, place, contacts, load, work, most):
    """Move q downhill to the minimum of V by Newton's method with a line search, in `most` steps.

    V(q) = Σ_j K/(n + 1) δ_j^(n+1) − F·q (see `contact`). The balance of loads (Eq. 15) is
    g = ∂V/∂q = 0, and the stiffness (Appendix A) is H = ∂²V/∂q². Each step goes along p = −H⁻¹ g as
    far as V falls. V is convex, so it has one minimum, or a flat stretch of minima, or none if
    nothing carries the load. A descent therefore cannot end in a false answer, only in no answer.
    The function returns what `minimise_energy` returns.

    work.g and work.H have two places: index `now` belongs to q, and 1 − now to the trial of q.
    """
    F = load.force
    active = load.active
    G = work.g
    H = work.H
    L = work.L
    p = work.p
    trial = work.trial
    hard = stiffest_contact(contacts)
    K = contacts.factor[hard]
    exponent = contacts.exponent[hard]
    # Lengths that cancel in a compression even at q = 0: their rounding is in every residual.
    tight = abs(contacts.offset[hard]) + max(-contacts.clearance[hard], 0.0)
    size = load_size(load)
    squared_load = size * size
    nothing = 0.0  # load [N] that rounding leaves of a preload: below it nothing touches
    k_typical = 0.0
    shift_part = 1e-3
    residual = math.inf
    limit = RESIDUAL_LIMIT
    stuck = False
    preloaded = False
    slope = 0.0
    V = 0.0
    scale = 0.0
    faintest = 0.0
    now = 1
    evaluations = 0
    # The first round only evaluates the energy at q. As part of the loop, the inlined code of the
    # energy occurs once, which halves the time of compilation.
    for iteration in range(-1, most):
        g = G[now]
        if iteration >= 0:
            # Test for the minimum. The residual is what is out of balance, |g|, over the load and
            # the reactions along held directions, or, if only a preload presses the contacts, over
            # the sum of their loads.
            norm, reactions, reach, stiffest = sizes_at(q, g, H[now], F, active, tight)
            total_load = math.sqrt(squared_load + max(reactions, 0.0))
            if preloaded:
                total_load = pressed_load(q, place, contacts)
            if total_load <= nothing:
                return now, NOTHING_TOUCHES, math.nan, iteration, evaluations
            before = residual
            residual = math.sqrt(norm) / total_load
            limit = max(RESIDUAL_LIMIT, ROUNDING * reach * stiffest / total_load)
            least = newton_direction(H[now], g, active, 0.0, L, p)
            # Near the minimum a step squares the residual: one that hardly falls is rounding.
            settled = residual <= limit and residual >= 0.5 * before
            if residual <= RESIDUAL_AIM or settled or stuck:
                noise = FAINT * max(residual, RESIDUAL_AIM) * total_load
                if faintest >= noise:
                    noise = 0.0
                status, now = judge_minimum(q, noise, least, now, place, contacts, load, work)
                return now, status, residual, iteration, evaluations
            if not least > LEAST_PIVOT or stiffest < FAINT_STIFFNESS * k_typical:
                # Too few balls touch, so that H has no inverse. A small spring to ground replaces
                # the missing stiffness. It becomes weaker, so that it does not hold q back at last.
                newton_direction(H[now], g, active, shift_part * max(k_typical, stiffest), L, p)
                shift_part = max(0.1 * shift_part, 1e-10)
            slope = slope_along(g, p, active)
        # Line search along p: after a step `short` V still falls steeply, a step `long` is too far.
        # The first trial is Newton's step, which is right near the minimum.
        step = 1.0
        short = 0.0
        long = math.inf
        accepted = False
        for _ in range(60):
            for i in active:
                trial[i] = q[i] + step * p[i] if iteration >= 0 else q[i]
            V1, scale1, faintest1 = energy_gradient_hessian(
                trial, F, place, contacts, G[1 - now], H[1 - now]
            )
            evaluations += 1
            if iteration < 0:
                accepted = True
                break
            slope1 = slope_along(G[1 - now], p, active)
            if has_descended(V, V1, slope, slope1, step, 1e-14 * max(scale, scale1)):
                if slope1 >= 0.9 * slope or long == math.inf or long < 1.5 * short:
                    accepted = True
                    break
                # V still falls as steeply as at the start: try a step between this one and the one
                # that was too long.
                short = step
                step = math.sqrt(short * long)
            else:
                long = step
                step = shorten_step(step, slope, slope1)
                if step <= short:
                    step = math.sqrt(short * long)
        if not accepted:
            # Rounding hides every fall of V. The state counts as the minimum within the limit.
            if residual > limit:
                return now, NOT_CONVERGED, residual, iteration, evaluations
            stuck = True
            continue
        for i in active:
            q[i] = trial[i]
        V = V1
        scale = scale1
        faintest = faintest1
        now = 1 - now
        if iteration < 0:
            if size == 0.0:
                # Without a load, contacts are pressed by an interference, by rows against each
                # other, or if the ring is held axially and wedged by a large clearance. A single
                # row that is free axially slips out of its clearance instead.
                preloaded = True
                size = pressed_load(q, place, contacts)
                axial = False
                for i in active:
                    axial = axial or i == 2
                slips = axial and contacts.rows.shape[0] == 1 and contacts.clearance[hard] > 0.0
                if size == 0.0 or slips:
                    return now, NOTHING_TOUCHES, math.nan, 0, 1
                lost = ROUNDING * (curved_length(contacts, hard) + abs(contacts.clearance[hard]))
                _, least_load, _ = contact_load(max(lost, 0.0), K, exponent)
                nothing = max(RESIDUAL_AIM * size, least_load)
            k_typical = typical_stiffness(size, K, exponent)
    return now, NOT_CONVERGED, residual, most, evaluations


@inlined
def minimise_energy(q, place, contacts, load, work):
    """Move q to the minimum of V over the active directions.

    Returns (which, status, residual, iterations, evaluations): work.g[which] and work.H[which]
    belong to the final q.

    A light load on stiff balls has its minimum far along a narrow curved valley, up to A0 long and
    as wide as a compression, in which Newton's straight steps are short. If they do not arrive, the
    search begins anew with soft balls, whose valley is wide, and goes on with harder and harder
    ones. The answers for two stiffnesses differ by about the compression of the softer balls.
    """
    now, status, residual, iterations, evaluations = descend(
        q, place, contacts, load, work, MOST_ITERATIONS
    )
    if status != NOT_CONVERGED:
        return now, status, residual, iterations, evaluations
    F = load.force
    active = load.active
    size = load_size(load)
    stiffest = stiffest_contact(contacts)
    K = contacts.factor[stiffest]
    exponent = contacts.exponent[stiffest]
    hard = compression_under(size, K, exponent)
    # `hard` and `soft`: compression of one ball under the whole load, with the real and with the
    # softened factor. A straight valley needs no softening.
    soft = max(curved_length(contacts, stiffest), hard)
    start = work.start
    soft_factor = work.soft
    for i in active:
        # without a load (a wedged ring) nothing says how far to begin
        distance = max(contacts.clearance[stiffest], 0.0) / contacts.line_r[stiffest] + soft
        start[i] = distance * F[i] / size if size > 0.0 else q[i]
    # Each round multiplies the compression `soft` by `ratio`: bolder after a success, more careful
    # after a failure, until the balls are as hard as the real ones.
    ratio = 1.0
    for _ in range(40):
        target = max(soft * ratio, hard)
        softer = 1.0
        if target != hard and size != 0.0:
            _, stiff_load, _ = contact_load(target, K, exponent)
            softer = size / stiff_load
        for i in active:
            q[i] = start[i]
        for j in range(soft_factor.size):
            soft_factor[j] = softer * contacts.factor[j]
        softened = replace_factors(contacts, soft_factor)
        now, status, residual, steps, calls = descend(
            q, place, softened, load, work, MOST_PATIENT_ITERATIONS
        )
        iterations += steps
        evaluations += calls
        if size == 0.0:
            break
        if status != NOT_CONVERGED:
            if softer == 1.0:
                break
            for i in active:
                start[i] = q[i]
            soft = target
            ratio = 0.1 if ratio == 1.0 else max(ratio * ratio, 1e-4)
        elif ratio == 1.0 or ratio > 0.7:
            break
        else:
            ratio = math.sqrt(ratio)
    else:
        status = NOT_CONVERGED
    return now, status, residual, iterations, evaluations


@inlined
def extrapolate(cage_angles, k, q, active, state):
    """Write a guess of the state at cage angle k: the parabola through the last three answers q.

    The state stays as it is if their angles are not near and in order.
    """
    x1 = cage_angles[k] - cage_angles[k - 1]
    x2 = cage_angles[k] - cage_angles[k - 2]
    x3 = cage_angles[k] - cage_angles[k - 3]
    if abs(x1) < abs(x2) < abs(x3) < 8.0 * abs(x1) and x1 * x2 > 0.0 and x2 * x3 > 0.0:
        u1 = x2 * x3 / ((x2 - x1) * (x3 - x1))
        u2 = x1 * x3 / ((x1 - x2) * (x3 - x2))
        u3 = x1 * x2 / ((x1 - x3) * (x2 - x3))
        if abs(u1) + abs(u2) + abs(u3) < 20.0:
            for i in active:
                state[i] = u1 * q[k - 1, i] + u2 * q[k - 2, i] + u3 * q[k - 3, i]


@inlined
def first_guess(contacts, load, state):
    """Write into state (5,) a displacement along the load: clearance and one ball's compression."""
    size = load_size(load)
    stiffest = stiffest_contact(contacts)
    reach = max(contacts.clearance[stiffest], 0.0) / contacts.line_r[stiffest] + compression_under(
        size, contacts.factor[stiffest], contacts.exponent[stiffest]
    )
    for i in load.active:
        state[i] = reach * load.force[i] / max(size, 1e-300)


def new_map_work(angle):
    """Return empty work space of a map; contacts are at angles (n,) [rad] from the first ball."""
    c, s, d, slope, soft, firm = np.zeros((6, angle.size))
    state, guess, p, trial, start = np.zeros((5, 5))
    circle_c, circle_s = np.cos(angle), np.sin(angle)
    g, H, L = np.zeros((2, 5)), np.zeros((2, 5, 5)), np.zeros((5, 5))
    descent = Descent(g, H, L, p, trial, start, soft, firm)
    return MapWork(descent, state, guess, Place(c, s, d), slope, circle_c, circle_s)


def static_maps(cage_angles, contacts, paths, load, rows, memory, answers):
    """Fill in the static states of the rows (first, last) of a map: see `solve_maps`."""
    work = new_map_work(contacts.angle)
    solve_maps(cage_angles, contacts, paths, load, rows, memory, answers, work)


@inlined
def repeat_answer(e, k, answers):
    """Take the answer of row e at cage angle k from the row before."""
    answers.status[e, k] = answers.status[e - 1, k]
    answers.residual[e, k] = answers.residual[e - 1, k]
    answers.loaded[e, k] = answers.loaded[e - 1, k]
    answers.greatest[e, k] = answers.greatest[e - 1, k]
    for term in range(15):
        answers.stiffness[term, e, k] = answers.stiffness[term, e - 1, k]


@inlined
def keep_answer(e, k, now, contacts, work, memory, answers):
    """Write the results at work.state into row e at cage angle k.

    These are the loads (Eq. 13) and the stiffness work.descent.H[now] (Eq. 17). The formulas also
    have balances outside the geometry of a bearing, which get the status BEYOND: the ring is tilted
    beyond small angles or has left the other ring, or a ball is compressed beyond its room.
    """
    place = work.place
    loads = memory.loads
    status = answers.status
    count = 0
    most = 0.0
    settled = status[e, k] == CONVERGED
    x = components(work.state)
    beyond = settled and max(abs(x[3]), abs(x[4])) > contacts.most_tilt
    for j in range(contacts.angle.size):
        delta, _, _, inverse_A = touch(x, place.c[j], place.s[j], place.d[j], j, contacts)
        loads[k, j] = 0.0
        if delta > 0.0:
            _, loads[k, j], _ = contact_load(delta, contacts.factor[j], contacts.exponent[j])
            count += 1
            most = max(most, loads[k, j])
            beyond = beyond or delta > contacts.room[j]
            if settled and inverse_A == 0.0:
                beyond = beyond or has_left(x, place.c[j], place.s[j], j, contacts)
    if beyond and (settled or status[e, k] == FREE_DIRECTION):
        status[e, k] = BEYOND
    gone = status[e, k] >= NOT_CARRIED
    loose = status[e, k] == NOTHING_TOUCHES
    nowhere = gone or loose
    answers.loaded[e, k] = 0 if nowhere else count
    answers.greatest[e, k] = math.nan if gone else 0.0 if loose else most
    term = 0
    for a in range(5):
        for b in range(a, 5):
            answers.stiffness[term, e, k] = math.nan if nowhere else work.descent.H[now, b, a]
            term += 1


@compiled
def solve_maps(cage_angles, contacts, paths, load, rows, memory, answers, work):
    """Solve the static states of rows (first, last) of a map, which differ in their defects only.

    Points that are not OPEN are left alone. Each point is started from the points before it in its
    row. `memory` carries states and drops from row to row (NaN before the first), and at the end
    holds those of the last row.

    If all balls have the same drops as in the row before, the answer is copied from that row. This
    holds for most points: a ball is usually on the race or on the floor, and seldom between them.
    """
    n = cage_angles.size
    n_contacts = contacts.angle.size
    active = load.active
    q = memory.q
    drops = memory.drops
    status = answers.status
    residual = answers.residual
    place = work.place
    d = place.d
    state = work.state
    guess = work.guess
    first, last = rows
    first_guess(contacts, load, guess)
    for e in range(first, last):
        path = Path(paths.defects[e, : paths.counts[e]], paths.tables)
        for k in range(n):
            if status[e, k] != OPEN:
                drops[k, 0] = math.nan
                continue
            lay_out_drops(cage_angles[k], paths.leads[e, k], contacts, path, d, work.slope)
            same = True
            for j in range(n_contacts):
                same = same and drops[k, j] == d[j]
                drops[k, j] = d[j]
            if same:
                repeat_answer(e, k, answers)
                continue
            # Newton's method begins at the last answer, or on a parabola through the last three.
            known = 0
            while known < min(k, 3) and CONVERGED <= status[e, k - 1 - known] < NOT_CARRIED:
                known += 1
            for i in active:
                state[i] = q[k - 1, i] if known > 0 else guess[i]
            if known == 3:
                extrapolate(cage_angles, k, q, active, state)
            circle_c = work.circle_c
            place_balls(cage_angles[k], contacts, circle_c, work.circle_s, place.c, place.s)
            now, status[e, k], residual[e, k], _, memory.evaluations[k] = minimise_energy(
                state, place, contacts, load, work.descent
            )
            for i in range(5):
                q[k, i] = state[i]
            keep_answer(e, k, now, contacts, work, memory, answers)


_TERMS = np.zeros((5, 5), dtype=np.int64)
_TERMS[np.triu_indices(5)] = _TERMS.T[np.triu_indices(5)] = np.arange(15)


def static_states(cage_angles, leads, contacts, path, load):
    """Return the static equilibrium at each cage angle (n,) [rad], as a map of one row.

    leads (n,) [rad]: angle by which turning defects are ahead of their place at the cage angle.

    Returns q (n, 5), contact loads (n, contacts), stiffness (n, 5, 5), loaded contacts, status,
    residual and evaluations (n,). Tilts and moments are scaled as `structs` says; the stiffness is
    NaN where there is no equilibrium.
    """
    n = cage_angles.size
    count = np.array([path.defects.shape[0]])
    memory = new_memory(n, contacts)
    answers = new_answers(1, n)
    paths = MapPaths(path.defects[None], count, path.tables, leads[None])
    static_maps(cage_angles, contacts, paths, load, (0, 1), memory, answers)
    return (
        memory.q,
        memory.loads,
        answers.stiffness[:, 0].take(_TERMS, axis=0).transpose(2, 0, 1),
        answers.loaded[0],
        answers.status[0],
        answers.residual[0],
        memory.evaluations,
    )


def new_memory(n, contacts):
    """Return an empty `MapMemory` of n cage angles."""
    n_contacts = contacts.angle.size
    return MapMemory(
        np.zeros((n, 5)),
        np.full((n, n_contacts), math.nan),
        np.zeros((n, n_contacts)),
        np.zeros(n, dtype=np.int64),
    )


def new_answers(rows, n):
    """Return `MapAnswers` of some rows and n cage angles, with every point OPEN."""
    shape = (rows, n)
    return MapAnswers(
        np.full((15, *shape), math.nan),
        np.zeros(shape, dtype=np.int64),
        np.full(shape, math.nan),
        np.full(shape, OPEN, dtype=np.int8),
        np.full(shape, math.nan),
    )
