"""All compiled code, on floats and arrays. It lives in one module because the compiler's file cache
does not notice when a function it has inlined from another file changes.

Quantity                                          | Symbol            | Unit
------------------------------------------------- | ----------------- | --------
displacement of the inner ring, tilts times r_d   | q = (x, y, z, r_d θx, r_d θy) | m
loads on the inner ring, moments over r_d         | F                 | N
cosine and sine of a ball's angle φ_j             | c, s              |
cosine and sine of the unloaded contact angle α0  | ca, sa            |
drop of the ball's centre                         | d                 | m
parts of the ball's displacement along and across the unloaded line of contact | m, w | m
direction of the contact, radial and axial        | er, ez            |
compression, load and stiffness of a contact      | δ, Q, k1 = ∂Q/∂δ  | m, N, N/m
load over loaded distance, Q/A                    | k2                | N/m

Tilts are carried as r_d θ and moments as M/r_d, so that all five components of q are lengths, all
of F are forces, and one number measures a residual.

Equation numbers are those of Petersen, Howard & Prime (2014). Their A (Eq. 8) is an unsigned
distance, which mistakes a ball sunk beyond the other groove's centre for a loaded one; here the
part of the distance along the unloaded line of contact counts only while it is positive, which
changes nothing else and makes the energy

    V(q) = Σ_j (K/2.5) δ_j^2.5 − F·q

convex. Static equilibrium (Eq. 15) is its minimum, found by Newton's method with a line search.

Fast mathematics that drops NaN or reorders sums stays off: NaN is how a missing answer is told.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

# "contract" alone of all that fastmath means: a·b + c in one instruction, rounded once, which makes
# statics a quarter faster. NaN, signs and the order of sums are as written.
compiled = njit(cache=True, nogil=True, fastmath={"contract"})
# A call with many arrays costs more than a small kernel's work: such functions become part of their
# callers, which made marching 2.4 times as fast. LLVM does it: numba's own inlining types and
# translates the body again at each call. Every caller is a little slower to compile for it, and a
# kernel is compiled together with all that it calls, so large functions are called at one place.
inlined = njit(cache=True, nogil=True, fastmath={"contract"}, forceinline=True)

# Columns of the rows that describe defects to `ball_path` (see defect.path_tables):
PATH_COLUMNS = (
    "center",
    "turn_ratio",
    "half_extent",
    "depth",
    "angle_from_edge_to_floor",
    "edge",
    "raceway_radius",
    "ball_radius",
    "table_start",
    "table_size",
)
PUBLISHED, CHORD, EXACT, INNER_EXACT, TABLE = 0, 1, 2, 3, 4

# What became of a cage angle; the sentences are in equilibrium.py:
CONVERGED, NOTHING_TOUCHES, FREE_DIRECTION, NOT_CARRIED, NOT_CONVERGED = 0, 1, 2, 3, 4

# A residual |∂V/∂q| below this part of the load ends the iteration; one that rounding keeps above
# it is still taken below the second. The third is the least pivot, relative to the greatest
# stiffness, with which a Newton step is taken as it is.
RESIDUAL_AIM, RESIDUAL_LIMIT, LEAST_PIVOT = 1e-12, 1e-9, 1e-12
# So many Newton steps before another way is taken, and at each softness of that way. (Plain
# integers would be types of their own, and what takes them compiled for each.)
MOST_ITERATIONS, MOST_PATIENT_ITERATIONS = np.int64(60), np.int64(600)

# A stiffness below this part of the greatest is none: rounding leaves more than it. Where a pivot
# is below the second, taking them in the order of the directions does not tell.
NO_PIVOT, DOUBTFUL_PIVOT = 1e-14, 1e-5

# Digits that q loses times the stiffness are a residual too: where a light load meets stiff balls
# far from q = 0, none smaller can be had.
ROUNDING = 4e-16

# A ball that carries less than this many residuals may as well carry nothing; where even the
# greatest stiffness is below this part of that of one ball under all of the load, rounding made it.
FAINT, FAINT_STIFFNESS = 10.0, 1e-12

# Where the centres of a loaded ball have passed each other nothing holds it along its line; nearer
# than this part of A0 to passing, rounding decides whether they have.
GUARD = 1e-12


# ---------------------------------------------------------------------------- path of the ball


@compiled
def drop_and_slope(x, half_extent, depth, s_floor, edge, R, r_b):
    """Drop of a ball's centre [m] at the angle x [rad] from the defect's middle, and its slope.

    Written so that no two nearly equal numbers are subtracted: 1 − cos s = sin²s/(1 + cos s).
    """
    s = half_extent - abs(x)  # angle from the nearer edge inwards
    if s < 0.0:
        return 0.0, 0.0
    if s >= s_floor:
        return depth, 0.0
    if edge in (PUBLISHED, CHORD):
        factor = 0.25 if edge == PUBLISHED else 1.0
        u = factor * R * R * s * s
        root = math.sqrt(max(r_b * r_b - u, 0.0))
        drop = u / (r_b + root)  # Equation (6): r_b − sqrt(r_b² − factor R² s²)
        steep = factor * R * R * s / root if root > 0.0 else 0.0
    else:
        sn = math.sin(s)
        cs = math.cos(s)
        root = math.sqrt(max(r_b * r_b - R * R * sn * sn, 0.0))
        sagitta = R * sn * sn / (1.0 + cs)
        sink = R * R * sn * sn / (r_b + root)
        lever = R * R * sn * cs / root if root > 0.0 else 0.0
        if edge == EXACT:  # R cos s − sqrt(r_b² − R² sin² s) − (R − r_b)
            drop = sink - sagitta
            steep = lever - R * sn
        else:  # (R + r_b) − (R cos s + sqrt(r_b² − R² sin² s))
            drop = sink + sagitta
            steep = lever + R * sn
    if drop >= depth:
        return depth, 0.0
    return drop, -steep if x > 0.0 else steep


@compiled
def fall(angle, cage_angle, rows, tables):
    """Drop [m] of a ball at `angle` and its derivative with the cage's turning [m/rad].

    Defects of one race do not overlap here (those that do share a table); drops into both races
    add.
    """
    total = 0.0
    total_slope = 0.0
    for i in range(rows.shape[0]):
        turn = rows[i, 1]
        half = rows[i, 2]
        x = angle - rows[i, 0] - turn * cage_angle
        x -= 2.0 * math.pi * math.floor(x / (2.0 * math.pi) + 0.5)
        if abs(x) > half:
            continue
        if rows[i, 5] == TABLE:
            start = int(rows[i, 8])
            cells = int(rows[i, 9]) - 1
            at = (x + half) / (2.0 * half) * cells
            k = min(int(at), cells - 1)
            rise = tables[start + k + 1] - tables[start + k]
            drop = tables[start + k] + (at - k) * rise
            slope = rise * cells / (2.0 * half)
        else:
            drop, slope = drop_and_slope(
                x, half, rows[i, 3], rows[i, 4], rows[i, 5], rows[i, 6], rows[i, 7]
            )
        total += drop
        total_slope += slope * (1.0 - turn)
    return total, total_slope


@compiled
def ball_circle(n_balls):
    """Cosine and sine (n_balls,) of the angle from the first ball to each."""
    c = np.empty(n_balls)
    s = np.empty(n_balls)
    for j in range(n_balls):
        angle = 2.0 * math.pi / n_balls * j
        c[j] = math.cos(angle)
        s[j] = math.sin(angle)
    return c, s


@compiled
def lay_out_drops(cage, rows, tables, d):
    """Drop [m] of every ball into d (n_balls,): only balls at a defect are asked for it."""
    n_balls = d.size
    spacing = 2.0 * math.pi / n_balls
    for j in range(n_balls):
        d[j] = 0.0
    for k in range(rows.shape[0]):
        begin = (rows[k, 0] + rows[k, 1] * cage - rows[k, 2] - cage) / spacing
        ball = math.ceil(begin - 1e-9)
        end = min(begin + 2.0 * rows[k, 2] / spacing + 1e-9, ball + n_balls - 0.5)
        while ball <= end:
            d[int(ball) % n_balls], _ = fall(cage + spacing * ball, cage, rows, tables)
            ball += 1.0


@compiled
def ball_path(ball_angles, cage_angles, rows, tables):
    """Drop [m] at every ball angle, with the cage at the angle of the same index; shapes (n,)."""
    drops = np.empty(ball_angles.size)
    for i in range(ball_angles.size):
        drops[i], _ = fall(ball_angles[i], cage_angles[i], rows, tables)
    return drops


@compiled
def roll_over(surface, circle):
    """Depth (n,) to which a ball sinks over a surface: min over j of surface[j] + circle[|i − j|].

    circle holds how far the ball hangs below a point that it touches so many nodes away: it rises
    and is convex, and so the point touched moves on as the ball does. Halving the nodes again and
    again finds it for all of them in n log n steps.
    """
    n = surface.size
    reach = circle.size - 1
    path = np.empty(n)
    waiting = np.empty((128, 4), dtype=np.int64)  # nodes from, to; touched points from, to
    waiting[0] = (0, n - 1, 0, n - 1)
    size = 1
    while size > 0:
        size -= 1
        first, last, low, high = waiting[size]
        i = (first + last) // 2
        least = math.inf
        touched = low
        for j in range(max(low, i - reach), min(high, i + reach) + 1):
            depth = surface[j] + circle[abs(i - j)]
            if depth < least:
                least = depth
                touched = j
        path[i] = least
        if first < i:
            waiting[size] = (first, i - 1, low, touched)
            size += 1
        if i < last:
            waiting[size] = (i + 1, last, touched, high)
            size += 1
    return path


# ------------------------------------------------------------------------------------ contact


@inlined
def compression(m, w, A0):
    """Compression δ, its direction (eu, ew) along and across the line of contact, and A.

    m and w are the ball's displacement along and across the unloaded line of contact, so that
    (A0 + m, w) is the vector between the groove centres (Eqs. 8-10). δ ≤ 0 is a gap.
    """
    p = A0 + m
    if p > 0.0:
        rise = m * (2.0 * A0 + m) + w * w  # A² − A0² without its cancellation
        if rise <= 0.0:
            return 0.0, 1.0, 0.0, A0
        A = math.sqrt(p * p + w * w)
        return rise / (A + A0), p / A, w / A, A  # Equation (7)
    A = abs(w)  # the centres have passed each other: only what lies across the line counts
    return max(A - A0, 0.0), 0.0, 1.0 if w > 0.0 else -1.0, A


@inlined
def energy_gradient_hessian(q, F, c, s, d, ca, sa, A0, rL, K, g, H):
    """V(q) [N·m], its gradient g (5,) [N] and its Hessian H (5, 5) [N/m]; returns V and a scale.

    The scale is the sum of the sizes of V's terms: rounding of V is a small part of it. Third comes
    the least load [N] that a touching ball carries.
    """
    energy = 0.0
    faintest = math.inf
    f0 = 0.0
    f1 = 0.0
    f2 = 0.0
    f3 = 0.0
    f4 = 0.0
    a_cc = 0.0
    a_cs = 0.0
    a_ss = 0.0
    b_c = 0.0
    b_s = 0.0
    b_cc = 0.0
    b_cs = 0.0
    b_ss = 0.0
    g_1 = 0.0
    g_c = 0.0
    g_s = 0.0
    g_cc = 0.0
    g_cs = 0.0
    g_ss = 0.0
    q0, q1, q2, q3, q4 = q[0], q[1], q[2], q[3], q[4]
    for j in range(c.size):
        cj = c[j]
        sj = s[j]
        r = q0 * cj + q1 * sj - rL  # Equation (11), d taken along the line of contact below
        z = q2 + q3 * sj - q4 * cj  # Equation (12)
        m = r * ca + z * sa - d[j]
        w = z * ca - r * sa
        delta, eu, ew, A = compression(m, w, A0)
        if delta <= 0.0:
            continue
        root = math.sqrt(delta)
        Q = K * delta * root  # Equation (13)
        k1 = 1.5 * K * root
        k2 = Q / A if A0 + m > GUARD * A0 else 0.0
        er = eu * ca - ew * sa  # Equation (14): er = cos α_j, ez = sin α_j
        ez = eu * sa + ew * ca
        energy += 0.4 * Q * delta
        if Q < faintest:  # noqa: SIM300
            faintest = Q
        Qr = Q * er
        Qz = Q * ez
        f0 += Qr * cj  # Equation (15)
        f1 += Qr * sj
        f2 += Qz
        f3 += Qz * sj
        f4 -= Qz * cj
        a = k1 * er * er + k2 * ez * ez  # Appendix A: a for (A.1), b for (A.3), g for (A.10)
        b = (k1 - k2) * er * ez
        h = k1 * ez * ez + k2 * er * er
        cc = cj * cj
        cs = cj * sj
        ss = sj * sj
        a_cc += a * cc
        a_cs += a * cs
        a_ss += a * ss
        b_c += b * cj
        b_s += b * sj
        b_cc += b * cc
        b_cs += b * cs
        b_ss += b * ss
        g_1 += h
        g_c += h * cj
        g_s += h * sj
        g_cc += h * cc
        g_cs += h * cs
        g_ss += h * ss
    work = 0.0
    for i in range(5):
        work += F[i] * q[i]
    g[0] = f0 - F[0]
    g[1] = f1 - F[1]
    g[2] = f2 - F[2]
    g[3] = f3 - F[3]
    g[4] = f4 - F[4]
    H[0, 0] = a_cc  # (A.1)
    H[1, 0] = a_cs  # (A.2)
    H[1, 1] = a_ss  # (A.6)
    H[2, 0] = b_c  # (A.3)
    H[2, 1] = b_s  # (A.7)
    H[2, 2] = g_1  # (A.10)
    H[3, 0] = b_cs  # (A.4)
    H[3, 1] = b_ss  # (A.8)
    H[3, 2] = g_s  # (A.11)
    H[3, 3] = g_ss  # (A.13)
    H[4, 0] = -b_cc  # (A.5)
    H[4, 1] = -b_cs  # (A.9)
    H[4, 2] = -g_c  # (A.12)
    H[4, 3] = -g_cs  # (A.14)
    H[4, 4] = g_cc  # (A.15)
    return energy - work, energy + abs(work), faintest


# ------------------------------------------------------------------------------------ statics


@compiled
def newton_direction(H, g, active, shift, L, p):
    """P = −(H + shift·1)⁻¹ g over the active directions, by Cholesky's method.

    Returns the least pivot over the greatest diagonal element; where that is not above
    LEAST_PIVOT the direction is not computed.
    """
    n = active.size
    greatest = 0.0
    for i in range(n):
        greatest = max(greatest, H[active[i], active[i]] + shift)
    if greatest <= 0.0:
        return 0.0
    least = 1.0
    for i in range(n):
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
    for i in range(n):
        x = -g[active[i]]
        for k in range(i):
            x -= L[i, k] * p[active[k]]
        p[active[i]] = x * L[i, i]
    for i in range(n - 1, -1, -1):
        x = p[active[i]]
        for k in range(i + 1, n):
            x -= L[k, i] * p[active[k]]
        p[active[i]] = x * L[i, i]
    return least


@compiled
def least_pivot(H, active):
    """Least pivot of H over the active directions, relative to the greatest, the greatest first.

    In any other order a pivot that should be zero keeps the rounding of those before it, divided by
    the least of them.
    """
    n = active.size
    A = np.empty((n, n))
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


@compiled
def without_faint(q, F, noise, c, s, d, active, ca, sa, A0, rL, K, g, H):
    """Whether the balls that carry more than `noise` [N] hold the ring on their own.

    The minimum may be an edge of a flat stretch, on which balls that only just touch look as if
    they held the ring there. Returns the least pivot without them, whose gradient and Hessian are
    put into g and H.
    """
    firm = 0
    c2 = np.empty(c.size)
    s2 = np.empty(c.size)
    d2 = np.empty(c.size)
    for j in range(c.size):
        r = q[0] * c[j] + q[1] * s[j] - rL
        z = q[2] + q[3] * s[j] - q[4] * c[j]
        delta, _, _, _ = compression(r * ca + z * sa - d[j], z * ca - r * sa, A0)
        if K * delta * math.sqrt(max(delta, 0.0)) > noise:
            c2[firm] = c[j]
            s2[firm] = s[j]
            d2[firm] = d[j]
            firm += 1
    energy_gradient_hessian(
        q, F, c2[:firm], s2[:firm], d2[:firm], ca, sa, A0, rL, K, g, H
    )
    return least_pivot(H, active)


@compiled
def descend(q, F, c, s, d, active, ca, sa, A0, rL, K, G, H, L, p, trial, most):
    """Move q downhill to the minimum of V by Newton's method with a line search, in `most` steps.

    Other arguments and what is returned are those of `minimise_energy`.
    """
    carried = 0.0
    axial = False
    for i in active:
        carried += F[i] * F[i]
        axial = axial or i == 2
    size = math.sqrt(carried)
    nothing = 0.0
    k_typical = 0.0
    shift_part = 1e-3
    residual = math.inf
    limit = RESIDUAL_LIMIT
    stuck = False
    slope = 0.0
    V = 0.0
    scale = 0.0
    faintest = 0.0
    now = 1
    evaluations = 0
    # The first time round only evaluates the energy where q stands: written so, its code stands
    # here once, which halves the time to compile it.
    for iteration in range(-1, most):
        g = G[now]
        if iteration >= 0:
            norm = 0.0
            taken = 0.0  # by what holds the directions that are not active
            reach = 0.0
            for i in range(5):
                taken += (g[i] + F[i]) ** 2
                reach = max(reach, abs(q[i]))
            stiffest = 0.0
            for i in active:
                taken -= (g[i] + F[i]) ** 2
                norm += g[i] * g[i]
                stiffest = max(stiffest, H[now, i, i])
            whole = math.sqrt(carried + max(taken, 0.0))
            if whole <= nothing:
                return now, NOTHING_TOUCHES, math.nan, iteration, evaluations
            before = residual
            residual = math.sqrt(norm) / whole
            limit = max(RESIDUAL_LIMIT, ROUNDING * reach * stiffest / whole)
            least = newton_direction(H[now], g, active, 0.0, L, p)
            settled = residual <= limit and residual >= 0.5 * before
            if residual <= RESIDUAL_AIM or settled or stuck:
                noise = FAINT * max(residual, RESIDUAL_AIM) * whole
                if faintest < noise:
                    least = without_faint(
                        q, F, noise, c, s, d, active, ca, sa, A0, rL, K, G[1 - now], H[1 - now]
                    )
                    if not least > NO_PIVOT:
                        now = 1 - now
                if least < DOUBTFUL_PIVOT:
                    least = least_pivot(H[now], active)
                status = CONVERGED if least > NO_PIVOT else FREE_DIRECTION
                return now, status, residual, iteration, evaluations
            if not least > LEAST_PIVOT or stiffest < FAINT_STIFFNESS * k_typical:
                # too few balls touch: a small spring to ground stands in for the missing stiffness
                newton_direction(H[now], g, active, shift_part * max(k_typical, stiffest), L, p)
                shift_part = max(0.1 * shift_part, 1e-10)
            slope = 0.0
            for i in active:
                slope += g[i] * p[i]
        step = 1.0
        short = 0.0
        long = math.inf
        found = False
        for _ in range(60):
            for i in active:
                trial[i] = q[i] + step * p[i] if iteration >= 0 else q[i]
            V1, scale1, faintest1 = energy_gradient_hessian(
                trial, F, c, s, d, ca, sa, A0, rL, K, G[1 - now], H[1 - now]
            )
            evaluations += 1
            if iteration < 0:
                found = True
                break
            slope1 = 0.0
            for i in active:
                slope1 += G[1 - now, i] * p[i]
            # V is convex: while it slopes down it has fallen, whatever rounding says. Beyond, it
            # must have fallen; where its fall drowns in rounding its slope must.
            if (
                slope1 <= 0.0
                or V + 1e-4 * step * slope >= V1
                or (slope1 <= 0.9 * abs(slope) and 1e-14 * max(scale, scale1) >= V1 - V)
            ):
                if slope1 >= 0.9 * slope or long == math.inf or long < 1.5 * short:
                    found = True
                    break
                # V still falls as steeply as at the start: between here and the step that was
                # too long there is a better one
                short = step
                step = math.sqrt(short * long)
            else:
                long = step
                secant = slope / (slope - slope1) if slope1 > 0.0 else 0.5
                step *= min(max(secant, 0.05), 0.6)
                if step <= short:
                    step = math.sqrt(short * long)
        if not found:
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
                # only a clearance so large that the ring, held axially, is wedged presses balls
                for i in range(5):
                    size += (G[now, i] + F[i]) ** 2
                size = math.sqrt(size)
                if size == 0.0 or axial:
                    return now, NOTHING_TOUCHES, math.nan, 0, 1
                nothing = max(RESIDUAL_AIM * size, K * (ROUNDING * (A0 + rL)) ** 1.5)
            k_typical = 1.5 * (K * K * size) ** (1.0 / 3.0)  # of one ball under all of the load
    return now, NOT_CONVERGED, residual, most, evaluations


@compiled
def minimise_energy(q, F, c, s, d, active, ca, sa, A0, rL, K, G, H, L, p, trial):
    """Move q to the minimum of V over the active directions.

    G (2, 5) and H (2, 5, 5) are work space. Returns (which, status, residual, iterations,
    evaluations): G[which] and H[which] belong to the final q.

    A light load on stiff balls has its minimum far along a narrow curved valley, up to A0 long and
    as wide as a compression; Newton's straight steps in it are short. Where they do not come to
    their end it is reached with soft balls first, whose valley is wide, and from there with harder
    ones: how far their answers lie apart is about what the softer balls are compressed.
    """
    now, status, residual, iterations, evaluations = descend(
        q, F, c, s, d, active, ca, sa, A0, rL, K, G, H, L, p, trial, MOST_ITERATIONS
    )
    if status != NOT_CONVERGED:
        return now, status, residual, iterations, evaluations
    size = 0.0
    for i in active:
        size += F[i] * F[i]
    size = math.sqrt(size)
    soft = A0  # compression of one ball under all of the load, for the softness now
    hard = (size / K) ** (2.0 / 3.0)
    start = np.zeros(5)
    for i in active:
        # of a wedged ring without a load nothing tells how soft to begin
        start[i] = (rL / ca + soft) * F[i] / size if size > 0.0 else q[i]
    ratio = 1.0
    for _ in range(40):
        target = max(soft * ratio, hard)
        Ks = K if target == hard or size == 0.0 else size / (target * math.sqrt(target))
        for i in active:
            q[i] = start[i]
        now, status, residual, more, calls = descend(
            q, F, c, s, d, active, ca, sa, A0, rL, Ks, G, H, L, p, trial,
            MOST_PATIENT_ITERATIONS,
        )
        iterations += more
        evaluations += calls
        if size == 0.0:
            break
        if status != NOT_CONVERGED:
            if Ks == K:
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
def foresee(cage_angles, k, q, active, state):
    """Guess the state at cage angle k: the parabola through the last three answers q.

    Where they do not stand near and in order, the state stays as it is.
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


@compiled
def static_states(cage_angles, rows, tables, F, active, n_balls, ca, sa, A0, rL, K):
    """Static equilibrium at each cage angle, each started from those before it.

    Returns q (n, 5), ball loads (n, n_balls), stiffness (n, 5, 5), loaded balls, status, residual,
    iterations and evaluations (n,), tilts and moments scaled as at the head of this module.
    """
    n = cage_angles.size
    q = np.zeros((n, 5))
    loads = np.zeros((n, n_balls))
    stiffness = np.empty((n, 5, 5))
    loaded = np.zeros(n, dtype=np.int64)
    status = np.empty(n, dtype=np.int8)
    residuals = np.empty(n)
    iterations = np.empty(n, dtype=np.int64)
    evaluations = np.empty(n, dtype=np.int64)
    c = np.empty(n_balls)
    s = np.empty(n_balls)
    d = np.zeros(n_balls)
    ball_c, ball_s = ball_circle(n_balls)
    G = np.zeros((2, 5))
    H = np.zeros((2, 5, 5))
    L = np.zeros((5, 5))
    p = np.zeros(5)
    trial = np.zeros(5)
    size = 0.0
    for i in active:
        size += F[i] * F[i]
    size = math.sqrt(size)
    state = np.zeros(5)
    # first guess: the clearance and one ball's compression, along the load
    reach = rL / ca + (size / K) ** (2.0 / 3.0)
    size = max(size, 1e-300)
    for i in active:
        state[i] = reach * F[i] / size
    for k in range(n):
        cage = cage_angles[k]
        cage_c = math.cos(cage)
        cage_s = math.sin(cage)
        for j in range(n_balls):
            c[j] = cage_c * ball_c[j] - cage_s * ball_s[j]
            s[j] = cage_s * ball_c[j] + cage_c * ball_s[j]
        lay_out_drops(cage, rows, tables, d)
        if k > 0 and status[k - 1] >= NOT_CARRIED:
            for i in active:
                state[i] = reach * F[i] / size
        elif k >= 3 and max(status[k - 2], status[k - 3]) < NOT_CARRIED:
            foresee(cage_angles, k, q, active, state)
        now, status[k], residuals[k], iterations[k], evaluations[k] = minimise_energy(
            state, F, c, s, d, active, ca, sa, A0, rL, K, G, H, L, p, trial
        )
        for i in range(5):
            q[k, i] = state[i]
            trial[i] = state[i]
            for j in range(i + 1):
                stiffness[k, i, j] = H[now, i, j]
                stiffness[k, j, i] = H[now, i, j]
        for j in range(n_balls):
            r = state[0] * c[j] + state[1] * s[j] - rL
            z = state[2] + state[3] * s[j] - state[4] * c[j]
            delta, _, _, _ = compression(r * ca + z * sa - d[j], z * ca - r * sa, A0)
            if delta > 0.0:
                loads[k, j] = K * delta * math.sqrt(delta)
                loaded[k] += 1
    return q, loads, stiffness, loaded, status, residuals, iterations, evaluations


OPEN, REFUSED = -1, 5
"""What a map says of a point beside the statuses above: not solved yet; no such defects."""


@compiled
def static_maps(
    cage_angles, rows, row_counts, tables, F, active, n_balls, ca, sa, A0, rL, K, units,
    first, last, q, drops, stiffness, loaded, greatest, status, residuals,
):
    """Static states of rows first to last of a map: the defects differ, cage angles do not.

    rows (m, r, columns) of which row_counts (m,) stand, units (5,) what F and q were divided by.
    Into stiffness (15, m, n) in units with r_d back, loaded (m, n), greatest (m, n) the greatest
    ball load [N], status and residuals (m, n). Points that are not OPEN are left alone. q (n, 5)
    and drops (n, n_balls) carry states and drops over from row to row, NaN before the first.
    Returns how many points were solved, and how often the energy was evaluated.

    Where all balls have sunk as deep as in the row before, the answer is that of the row before:
    most of a map of square defects is, as a ball is on the race or on the floor and seldom between.
    """
    n = cage_angles.size
    c = np.empty((n, n_balls))
    s = np.empty((n, n_balls))
    d = np.empty(n_balls)
    for k in range(n):
        for j in range(n_balls):
            phi = cage_angles[k] + 2.0 * math.pi / n_balls * j
            c[k, j] = math.cos(phi)
            s[k, j] = math.sin(phi)
    G = np.zeros((2, 5))
    H = np.zeros((2, 5, 5))
    L = np.zeros((5, 5))
    p = np.zeros(5)
    trial = np.zeros(5)
    state = np.zeros(5)
    size = 0.0
    for i in active:
        size += F[i] * F[i]
    size = math.sqrt(size)
    reach = rL / ca + (size / K) ** (2.0 / 3.0)
    size = max(size, 1e-300)
    solved = 0
    evaluations = 0
    for e in range(first, last):
        defects = rows[e, : row_counts[e]]
        for k in range(n):
            if status[e, k] != OPEN:
                drops[k, 0] = math.nan
                continue
            lay_out_drops(cage_angles[k], defects, tables, d)
            same = True
            for j in range(n_balls):
                same = same and drops[k, j] == d[j]
                drops[k, j] = d[j]
            if same:
                status[e, k] = status[e - 1, k]
                residuals[e, k] = residuals[e - 1, k]
                loaded[e, k] = loaded[e - 1, k]
                greatest[e, k] = greatest[e - 1, k]
                for term in range(15):
                    stiffness[term, e, k] = stiffness[term, e - 1, k]
                continue
            known = 0  # answers in a row just before this one
            while known < min(k, 3) and CONVERGED <= status[e, k - 1 - known] < NOT_CARRIED:
                known += 1
            for i in active:
                state[i] = q[k - 1, i] if known > 0 else reach * F[i] / size
            if known == 3:
                foresee(cage_angles, k, q, active, state)
            now, status[e, k], residuals[e, k], _, calls = minimise_energy(
                state, F, c[k], s[k], d, active, ca, sa, A0, rL, K, G, H, L, p, trial
            )
            solved += 1
            evaluations += calls
            for i in range(5):
                q[k, i] = state[i]
            gone = status[e, k] >= NOT_CARRIED
            count = 0
            most = 0.0
            for j in range(n_balls):
                r = state[0] * c[k, j] + state[1] * s[k, j] - rL
                z = state[2] + state[3] * s[k, j] - state[4] * c[k, j]
                delta, _, _, _ = compression(r * ca + z * sa - d[j], z * ca - r * sa, A0)
                if delta > 0.0:
                    count += 1
                    most = max(most, delta)
            loose = status[e, k] == NOTHING_TOUCHES
            nowhere = gone or loose
            loaded[e, k] = 0 if nowhere else count
            greatest[e, k] = math.nan if gone else 0.0 if loose else K * most * math.sqrt(most)
            term = 0
            for a in range(5):
                for b in range(a, 5):
                    value = H[now, b, a] * units[a] * units[b]
                    stiffness[term, e, k] = math.nan if nowhere else value
                    term += 1
    return solved, evaluations


@compiled
def contact_angles(cage_angles, rows, tables, q, n_balls, ca, sa, A0, rL):
    """Loaded contact angle α_j (n, n_balls) [rad] (Eq. 14) at states q; NaN at gaps."""
    angles = np.empty((cage_angles.size, n_balls))
    for k in range(cage_angles.size):
        for j in range(n_balls):
            phi = cage_angles[k] + 2.0 * math.pi / n_balls * j
            d, _ = fall(phi, cage_angles[k], rows, tables)
            c = math.cos(phi)
            s = math.sin(phi)
            r = q[k, 0] * c + q[k, 1] * s - rL
            z = q[k, 2] + q[k, 3] * s - q[k, 4] * c
            delta, eu, ew, _ = compression(r * ca + z * sa - d, z * ca - r * sa, A0)
            angles[k, j] = math.nan
            if delta > 0.0:
                angles[k, j] = math.atan2(eu * sa + ew * ca, eu * ca - ew * sa)
    return angles


# ------------------------------------------------------------------------------------- motion

GEOMETRY_BLOCK = 256
"""Half steps whose ball angles are laid out at once: small enough to stay in the cache."""


@compiled
def lay_out_balls(start, turn, n, cage_speed, rows, tables, ball_c, ball_s, c, s, d, d_rate):
    """Cosine, sine, drop [m] and rate of drop [m/s] of each ball at n cage angles start + i·turn.

    Arrays (n or more, n_balls). The cage is turned by recurrence and each ball stands at a fixed
    angle to it: a rotation instead of a sine and a cosine. Only balls at a defect are asked for
    their drop.
    """
    n_balls = ball_c.size
    turn_c = math.cos(turn)
    turn_s = math.sin(turn)
    cage_c = math.cos(start)
    cage_s = math.sin(start)
    for i in range(n):
        for j in range(n_balls):
            c[i, j] = cage_c * ball_c[j] - cage_s * ball_s[j]
            s[i, j] = cage_s * ball_c[j] + cage_c * ball_s[j]
        cage_c, cage_s = cage_c * turn_c - cage_s * turn_s, cage_s * turn_c + cage_c * turn_s
    if rows.shape[0] == 0:
        return
    for i in range(n):
        for j in range(n_balls):
            d[i, j] = 0.0
            d_rate[i, j] = 0.0
    spacing = 2.0 * math.pi / n_balls
    for k in range(rows.shape[0]):
        for i in range(n):
            cage = start + i * turn
            # from the first ball after the defect's beginning to the last one before its end
            begin = (rows[k, 0] + rows[k, 1] * cage - rows[k, 2] - cage) / spacing
            ball = math.ceil(begin)
            end = min(begin + 2.0 * rows[k, 2] / spacing, ball + n_balls - 0.5)
            while ball <= end:
                j = int(ball) % n_balls
                d[i, j], slope = fall(cage + spacing * ball, cage, rows, tables)
                d_rate[i, j] = slope * cage_speed
                ball += 1.0


@inlined
def contact_force(
    x, v, c, s, d, d_rate, at, cage_speed, ca, sa, A0, rL, K, damping, pull
):
    """Force of all contacts on the outer ring [N], moments over r_d, at relative motion x, v (5,).

    Every loaded ball pushes with K δ^1.5 + c δ̇ (Eq. 18) along its contact, δ̇ the full time
    derivative: velocities of the rings, turning of the ball, slope of the path. `pull` says
    whether the damper may draw a ball back.
    """
    f0 = 0.0
    f1 = 0.0
    f2 = 0.0
    f3 = 0.0
    f4 = 0.0
    for j in range(c.shape[1]):
        cj = c[at, j]
        sj = s[at, j]
        r = x[0] * cj + x[1] * sj - rL
        z = x[2] + x[3] * sj - x[4] * cj
        delta, eu, ew, _ = compression(r * ca + z * sa - d[at, j], z * ca - r * sa, A0)
        if delta <= 0.0:
            continue
        er = eu * ca - ew * sa
        ez = eu * sa + ew * ca
        r_rate = v[0] * cj + v[1] * sj + cage_speed * (x[1] * cj - x[0] * sj)
        z_rate = v[2] + v[3] * sj - v[4] * cj + cage_speed * (x[3] * cj + x[4] * sj)
        rate = er * r_rate + ez * z_rate - eu * d_rate[at, j]
        push = K * delta * math.sqrt(delta) + damping * rate
        if push > 0.0 or pull:
            f0 += push * er * cj
            f1 += push * er * sj
            f2 += push * ez
            f3 += push * ez * sj
            f4 -= push * ez * cj
    return f0, f1, f2, f3, f4


# Where α0, z and tilts are zero, δ = δx c + δy s − r_L − d (Eq. 19) and the direction of a contact
# is e = (c, s) whatever the rings do. The published damper's force c δ̇ jumps as a ball touches, and
# a step across the jump errs by as much as the step is long. But c δ̇ e = d/dt(c δ e) − c δ ė while
# δ > 0, so with
#
#     S = Σ δ_j e_j,    w_i = v_i + (c/m_i) S,    w_o = v_o − (c/m_o) S
#
# the equations of motion (Eq. 18) have no jump left, and need neither δ̇ nor the slope of d:
#
#     ẋ_i = w_i − (c/m_i) S,    m_i ẇ_i = F − Σ K δ^1.5 e + c Σ δ ė,    ė = ω_c (−s, c)
#
# and likewise, with opposite signs and its support, for the outer ring. It is the same law: only
# the variable that is marched has changed.


@inlined
def flat_sums(x0, x1, c, s, d, at, rL, K):
    """Σ K δ^1.5 e [N] and S = Σ δ e [m] over the loaded balls, at relative displacement x."""
    f0 = 0.0
    f1 = 0.0
    S0 = 0.0
    S1 = 0.0
    for j in range(c.shape[1]):
        cj = c[at, j]
        sj = s[at, j]
        delta = x0 * cj + x1 * sj - rL - d[at, j]
        if delta > 0.0:
            Q = K * delta * math.sqrt(delta)  # Equation (13)
            f0 += Q * cj
            f1 += Q * sj
            S0 += delta * cj
            S1 += delta * sj
    return f0, f1, S0, S1


@inlined
def flat_rates(
    xi0, xi1, wi0, wi1, xo0, xo1, wo0, wo1, c, s, d, at, cage_speed,
    F, inverse_mi, inverse_mo, ko, co, rL, K, damping,
):
    """ẋ_i, ẇ_i, ẋ_o, ẇ_o of the smooth variables above, two components each."""
    f0, f1, S0, S1 = flat_sums(xi0 - xo0, xi1 - xo1, c, s, d, at, rL, K)
    push0 = f0 + damping * cage_speed * S1
    push1 = f1 - damping * cage_speed * S0
    vo0 = wo0 + damping * inverse_mo[0] * S0
    vo1 = wo1 + damping * inverse_mo[1] * S1
    return (
        wi0 - damping * inverse_mi[0] * S0,
        wi1 - damping * inverse_mi[1] * S1,
        (F[0] - push0) * inverse_mi[0],
        (F[1] - push1) * inverse_mi[1],
        vo0,
        vo1,
        (push0 - ko[0] * xo0 - co[0] * vo0) * inverse_mo[0],
        (push1 - ko[1] * xo1 - co[1] * vo1) * inverse_mo[1],
    )


@inlined
def flat_record(
    history, step, xi0, xi1, vi0, vi1, xo0, xo1, vo0, vo1, c, s, d, d_rate, at, cage_speed,
    F, inverse_mi, inverse_mo, ko, co, rL, K, damping,
):
    """Displacements, velocities and accelerations (Eq. 18) of one instant into history[step]."""
    x0 = xi0 - xo0
    x1 = xi1 - xo1
    u0 = vi0 - vo0 + cage_speed * x1  # the turning of the balls, moved over to the rings
    u1 = vi1 - vo1 - cage_speed * x0
    f0 = 0.0
    f1 = 0.0
    for j in range(c.shape[1]):
        cj = c[at, j]
        sj = s[at, j]
        delta = x0 * cj + x1 * sj - rL - d[at, j]
        if delta > 0.0:
            rate = u0 * cj + u1 * sj - d_rate[at, j]
            push = K * delta * math.sqrt(delta) + damping * rate
            f0 += push * cj
            f1 += push * sj
    history[step, 0, 0] = xi0
    history[step, 0, 1] = xi1
    history[step, 1, 0] = vi0
    history[step, 1, 1] = vi1
    history[step, 2, 0] = (F[0] - f0) * inverse_mi[0]
    history[step, 2, 1] = (F[1] - f1) * inverse_mi[1]
    history[step, 3, 0] = xo0
    history[step, 3, 1] = xo1
    history[step, 4, 0] = vo0
    history[step, 4, 1] = vo1
    history[step, 5, 0] = (f0 - ko[0] * xo0 - co[0] * vo0) * inverse_mo[0]
    history[step, 5, 1] = (f1 - ko[1] * xo1 - co[1] * vo1) * inverse_mo[1]


@compiled
def march_flat(
    y, n_steps, h, start_angle, cage_speed, rows, tables, F, mi, mo, ko, co,
    n_balls, rL, K, damping, history,
):
    """`march` for x and y at α0 = 0 and the published law, in smooth variables and in scalars.

    y (8,): x, w of the inner, x, w of the outer ring, moved to the end; history (n_steps + 1, 6, 2)
    holds velocities v, not w. Returns the number of steps after which all was still finite.
    """
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    dr = np.zeros(shape)
    im = 1.0 / mi
    om = 1.0 / mo
    g = damping
    turn = cage_speed
    half_turn = 0.5 * h * turn
    e = 0.5 * h
    sixth = h / 6.0
    xi0, xi1, wi0, wi1, xo0, xo1, wo0, wo1 = y[0], y[1], y[2], y[3], y[4], y[5], y[6], y[7]
    for step in range(n_steps + 1):
        i = (2 * step) % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, 2 * (n_steps - step)) + 1
            angle = start_angle + 2 * step * half_turn
            lay_out_balls(angle, half_turn, count, turn, rows, tables, ball_c, ball_s, c, s, d, dr)
            if not math.isfinite(xi0 + xi1 + wi0 + wi1 + xo0 + xo1 + wo0 + wo1):
                return max(step - GEOMETRY_BLOCK // 2, 0)
        # rates p of displacements and r of w; the stage is in the name
        pi0_1, pi1_1, ri0_1, ri1_1, po0_1, po1_1, ro0_1, ro1_1 = flat_rates(
            xi0, xi1, wi0, wi1, xo0, xo1, wo0, wo1,
            c, s, d, i, turn, F, im, om, ko, co, rL, K, g,
        )
        flat_record(
            history, step, xi0, xi1, pi0_1, pi1_1, xo0, xo1, po0_1, po1_1,
            c, s, d, dr, i, turn, F, im, om, ko, co, rL, K, g,
        )
        if step == n_steps:
            break
        pi0_2, pi1_2, ri0_2, ri1_2, po0_2, po1_2, ro0_2, ro1_2 = flat_rates(
            xi0 + e * pi0_1, xi1 + e * pi1_1, wi0 + e * ri0_1, wi1 + e * ri1_1,
            xo0 + e * po0_1, xo1 + e * po1_1, wo0 + e * ro0_1, wo1 + e * ro1_1,
            c, s, d, i + 1, turn, F, im, om, ko, co, rL, K, g,
        )
        pi0_3, pi1_3, ri0_3, ri1_3, po0_3, po1_3, ro0_3, ro1_3 = flat_rates(
            xi0 + e * pi0_2, xi1 + e * pi1_2, wi0 + e * ri0_2, wi1 + e * ri1_2,
            xo0 + e * po0_2, xo1 + e * po1_2, wo0 + e * ro0_2, wo1 + e * ro1_2,
            c, s, d, i + 1, turn, F, im, om, ko, co, rL, K, g,
        )
        pi0_4, pi1_4, ri0_4, ri1_4, po0_4, po1_4, ro0_4, ro1_4 = flat_rates(
            xi0 + h * pi0_3, xi1 + h * pi1_3, wi0 + h * ri0_3, wi1 + h * ri1_3,
            xo0 + h * po0_3, xo1 + h * po1_3, wo0 + h * ro0_3, wo1 + h * ro1_3,
            c, s, d, i + 2, turn, F, im, om, ko, co, rL, K, g,
        )
        xi0 += sixth * (pi0_1 + 2.0 * (pi0_2 + pi0_3) + pi0_4)
        xi1 += sixth * (pi1_1 + 2.0 * (pi1_2 + pi1_3) + pi1_4)
        wi0 += sixth * (ri0_1 + 2.0 * (ri0_2 + ri0_3) + ri0_4)
        wi1 += sixth * (ri1_1 + 2.0 * (ri1_2 + ri1_3) + ri1_4)
        xo0 += sixth * (po0_1 + 2.0 * (po0_2 + po0_3) + po0_4)
        xo1 += sixth * (po1_1 + 2.0 * (po1_2 + po1_3) + po1_4)
        wo0 += sixth * (ro0_1 + 2.0 * (ro0_2 + ro0_3) + ro0_4)
        wo1 += sixth * (ro1_1 + 2.0 * (ro1_2 + ro1_3) + ro1_4)
    y[0], y[1], y[2], y[3], y[4], y[5], y[6], y[7] = xi0, xi1, wi0, wi1, xo0, xo1, wo0, wo1
    if not math.isfinite(xi0 + xi1 + wi0 + wi1 + xo0 + xo1 + wo0 + wo1):
        return max(n_steps - GEOMETRY_BLOCK // 2, 0)
    return n_steps


@inlined
def rate_of_change(
    y, k, n, c, s, d, d_rate, at, cage_speed, F, active, inverse_mi, inverse_mo, ko, co,
    ca, sa, A0, rL, K, damping, pull, x, v, f,
):
    """dy/dt into k (4 n,); y is x, v of the inner, x, v of the outer ring, n directions each."""
    for a in range(n):
        x[active[a]] = y[a] - y[2 * n + a]
        v[active[a]] = y[n + a] - y[3 * n + a]
    f[0], f[1], f[2], f[3], f[4] = contact_force(
        x, v, c, s, d, d_rate, at, cage_speed, ca, sa, A0, rL, K, damping, pull
    )
    for a in range(n):
        force = f[active[a]]
        k[a] = y[n + a]
        k[n + a] = (F[a] - force) * inverse_mi[a]
        k[2 * n + a] = y[3 * n + a]
        k[3 * n + a] = (force - ko[a] * y[2 * n + a] - co[a] * y[3 * n + a]) * inverse_mo[a]


@compiled
def march(
    y, n_steps, h, start_angle, cage_speed, rows, tables, F, active, mi, mo, ko, co,
    n_balls, ca, sa, A0, rL, K, damping, pull, history,
):
    """Classical Runge-Kutta steps of order 4 from y (4 n,), which is moved to the end.

    F, mi, mo, ko, co (n,) belong to the active directions. history (n_steps + 1, 6, n) takes
    displacement, velocity and acceleration of the inner ring, then of the outer ring, at every
    step. Returns the number of steps after which all was still finite.
    """
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    d_rate = np.zeros(shape)
    k1 = np.zeros(4 * n)
    k2 = np.zeros(4 * n)
    k3 = np.zeros(4 * n)
    k4 = np.zeros(4 * n)
    trial = np.zeros(4 * n)
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    inverse_mi = 1.0 / mi
    inverse_mo = 1.0 / mo
    half_turn = 0.5 * h * cage_speed
    for step in range(n_steps + 1):
        i = (2 * step) % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, 2 * (n_steps - step)) + 1
            angle = start_angle + 2 * step * half_turn
            lay_out_balls(
                angle, half_turn, count, cage_speed, rows, tables, ball_c, ball_s, c, s, d, d_rate
            )
            for r in range(4 * n):
                if not math.isfinite(y[r]):
                    return max(step - GEOMETRY_BLOCK // 2, 0)
        rate_of_change(
            y, k1, n, c, s, d, d_rate, i, cage_speed, F, active, inverse_mi, inverse_mo,
            ko, co, ca, sa, A0, rL, K, damping, pull, x, v, f,
        )
        for a in range(n):
            history[step, 0, a] = y[a]
            history[step, 1, a] = y[n + a]
            history[step, 2, a] = k1[n + a]
            history[step, 3, a] = y[2 * n + a]
            history[step, 4, a] = y[3 * n + a]
            history[step, 5, a] = k1[3 * n + a]
        if step == n_steps:
            break
        for r in range(4 * n):
            trial[r] = y[r] + 0.5 * h * k1[r]
        rate_of_change(
            trial, k2, n, c, s, d, d_rate, i + 1, cage_speed, F, active, inverse_mi, inverse_mo,
            ko, co, ca, sa, A0, rL, K, damping, pull, x, v, f,
        )
        for r in range(4 * n):
            trial[r] = y[r] + 0.5 * h * k2[r]
        rate_of_change(
            trial, k3, n, c, s, d, d_rate, i + 1, cage_speed, F, active, inverse_mi, inverse_mo,
            ko, co, ca, sa, A0, rL, K, damping, pull, x, v, f,
        )
        for r in range(4 * n):
            trial[r] = y[r] + h * k3[r]
        rate_of_change(
            trial, k4, n, c, s, d, d_rate, i + 2, cage_speed, F, active, inverse_mi, inverse_mo,
            ko, co, ca, sa, A0, rL, K, damping, pull, x, v, f,
        )
        for r in range(4 * n):
            y[r] += h / 6.0 * (k1[r] + 2.0 * (k2[r] + k3[r]) + k4[r])
    for r in range(4 * n):
        if not math.isfinite(y[r]):
            return max(n_steps - GEOMETRY_BLOCK // 2, 0)
    return n_steps


@compiled
def between_steps(history, body, weights, first, out):
    """Fill out (n_out, n) with a quantity of one body, samples from `first` on, between steps.

    weights (ratio, 6) multiply x, v, acceleration at a step and at the next one; body is 0 for the
    inner and 3 for the outer ring. Sample k lies (k mod ratio)/ratio of a step after step k//ratio.
    """
    ratio = weights.shape[0]
    last = history.shape[0] - 2
    for row in range(out.shape[0]):
        k = first + row
        step = min(k // ratio, last)
        w = k - step * ratio
        if w == ratio:  # the very end, one whole step after the last but one
            step += 1
            w = 0
        following = min(step + 1, last + 1)
        for a in range(out.shape[1]):
            # the difference of displacements first: on its own each is many times larger
            out[row, a] = (
                (weights[w, 0] + weights[w, 3]) * history[step, body, a]
                + weights[w, 3] * (history[following, body, a] - history[step, body, a])
                + weights[w, 1] * history[step, body + 1, a]
                + weights[w, 4] * history[following, body + 1, a]
                + weights[w, 2] * history[step, body + 2, a]
                + weights[w, 5] * history[following, body + 2, a]
            )


@compiled
def elastic_ball_loads(x, active, start_angle, turn, rows, tables, n_balls, ca, sa, A0, rL, K):
    """K δ^1.5 (n, n_balls) [N] (Eq. 13) at displacements x (n, len(active)) [m], tilts times r_d.

    The cage stands at start_angle + k·turn at row k.
    """
    n = x.shape[0]
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    d_rate = np.zeros(shape)
    loads = np.zeros((n, n_balls))
    q = np.zeros(5)
    for k in range(n):
        i = k % GEOMETRY_BLOCK
        if i == 0:
            lay_out_balls(
                start_angle + k * turn, turn, min(GEOMETRY_BLOCK, n - k), 1.0, rows, tables,
                ball_c, ball_s, c, s, d, d_rate,
            )
        for a in range(active.size):
            q[active[a]] = x[k, a]
        for j in range(n_balls):
            r = q[0] * c[i, j] + q[1] * s[i, j] - rL
            z = q[2] + q[3] * s[i, j] - q[4] * c[i, j]
            delta, _, _, _ = compression(r * ca + z * sa - d[i, j], z * ca - r * sa, A0)
            if delta > 0.0:
                loads[k, j] = K * delta * math.sqrt(delta)
    return loads


# ------------------------------------------------------------------------------- motion, tangent


@compiled
def contact_tangent(
    x, v, c, s, d, d_rate, at, cage_speed, ca, sa, A0, rL, K, damping, f, Kx, Kv, loaded
):
    """`contact_force` without tension into f (5,), its derivatives into Kx and Kv (5, 5).

    Kx = ∂f/∂x, Kv = ∂f/∂v; loaded (n_balls,) tells which balls push. With p the ball's displacement
    (radial, axial), e the direction of the contact and t across it,
    ∂(push e)/∂p = k1 e e' + (push/A) t t' + (c/A) (t·ṗ) e t', and ṗ depends on x and v itself.
    """
    f[:] = 0.0
    Kx[:] = 0.0
    Kv[:] = 0.0
    R = np.zeros(5)
    Z = np.zeros(5)
    R_turn = np.zeros(5)
    Z_turn = np.zeros(5)
    Z[2] = 1.0
    for j in range(c.shape[1]):
        loaded[j] = False
        cj = c[at, j]
        sj = s[at, j]
        r = x[0] * cj + x[1] * sj - rL
        z = x[2] + x[3] * sj - x[4] * cj
        delta, eu, ew, A = compression(r * ca + z * sa - d[at, j], z * ca - r * sa, A0)
        if delta <= 0.0:
            continue
        er = eu * ca - ew * sa
        ez = eu * sa + ew * ca
        r_rate = v[0] * cj + v[1] * sj + cage_speed * (x[1] * cj - x[0] * sj) - ca * d_rate[at, j]
        z_rate = (
            v[2] + v[3] * sj - v[4] * cj + cage_speed * (x[3] * cj + x[4] * sj) - sa * d_rate[at, j]
        )
        rate = er * r_rate + ez * z_rate
        root = math.sqrt(delta)
        push = K * delta * root + damping * rate
        if push <= 0.0:
            continue
        loaded[j] = True
        k1 = 1.5 * K * root
        bend = 1.0 / A if A0 + r * ca + z * sa - d[at, j] > 0.0 else 0.0
        across = damping * (er * z_rate - ez * r_rate) * bend  # c (t·ṗ)/A, t = (−ez, er)
        k2 = push * bend
        g_rr = k1 * er * er + k2 * ez * ez - across * er * ez
        g_rz = (k1 - k2) * er * ez + across * er * er
        g_zr = (k1 - k2) * er * ez - across * ez * ez
        g_zz = k1 * ez * ez + k2 * er * er + across * er * ez
        R[0] = cj
        R[1] = sj
        Z[3] = sj
        Z[4] = -cj
        R_turn[0] = -sj
        R_turn[1] = cj
        Z_turn[3] = cj
        Z_turn[4] = sj
        for a in range(5):
            e_a = er * R[a] + ez * Z[a]
            f[a] += push * e_a
            for b in range(5):
                e_b = er * R[b] + ez * Z[b]
                turn_b = er * R_turn[b] + ez * Z_turn[b]
                Kx[a, b] += (
                    R[a] * (g_rr * R[b] + g_rz * Z[b])
                    + Z[a] * (g_zr * R[b] + g_zz * Z[b])
                    + damping * cage_speed * e_a * turn_b
                )
                Kv[a, b] += damping * e_a * e_b


@compiled
def touch_and_leave(
    Y, x, c, s, d, at, was, now, active, inverse_mi, inverse_mo, ca, sa, A0, rL, damping
):
    """Apply to the tangent Y what balls that touched during a step do to it; True if any did.

    The damper's force jumps by c δ̇ at δ = 0. A neighbouring motion touches a little earlier or
    later; what that does to velocities is c (e·Δx) e over the mass, the rate δ̇ cancelling
    (the saltation matrix). Without tension balls leave without a jump.
    """
    n = active.size
    e = np.zeros(5)
    changed = False
    for j in range(c.shape[1]):
        if was[j] or not now[j]:
            continue
        changed = True
        cj = c[at, j]
        sj = s[at, j]
        r = x[0] * cj + x[1] * sj - rL
        z = x[2] + x[3] * sj - x[4] * cj
        m = r * ca + z * sa - d[at, j]
        w = z * ca - r * sa
        A = math.sqrt((A0 + m) * (A0 + m) + w * w)
        eu = (A0 + m) / A
        ew = w / A
        er = eu * ca - ew * sa
        ez = eu * sa + ew * ca
        e[0] = er * cj
        e[1] = er * sj
        e[2] = ez
        e[3] = ez * sj
        e[4] = -ez * cj
        for column in range(Y.shape[1]):
            nearer = 0.0
            for a in range(n):
                nearer += e[active[a]] * (Y[a, column] - Y[2 * n + a, column])
            for a in range(n):
                Y[n + a, column] -= damping * inverse_mi[a] * e[active[a]] * nearer
                Y[3 * n + a, column] += damping * inverse_mo[a] * e[active[a]] * nearer
    return changed


@compiled
def rates_with_tangent(
    y, Y, k, kY, c, s, d, d_rate, at, cage_speed, F, active, inverse_mi, inverse_mo, ko, co,
    ca, sa, A0, rL, K, damping, x, v, f, Kx, Kv, loaded,
):
    """`rate_of_change` without tension into k (4 n,), that of the tangent Y (4 n, 4 n) into kY."""
    n = active.size
    for a in range(n):
        x[active[a]] = y[a] - y[2 * n + a]
        v[active[a]] = y[n + a] - y[3 * n + a]
    contact_tangent(
        x, v, c, s, d, d_rate, at, cage_speed, ca, sa, A0, rL, K, damping, f, Kx, Kv, loaded
    )
    for a in range(n):
        force = f[active[a]]
        k[a] = y[n + a]
        k[n + a] = (F[a] - force) * inverse_mi[a]
        k[2 * n + a] = y[3 * n + a]
        k[3 * n + a] = (force - ko[a] * y[2 * n + a] - co[a] * y[3 * n + a]) * inverse_mo[a]
        for column in range(4 * n):
            kY[n + a, column] = 0.0
    for a in range(n):
        for b in range(n):
            kx = Kx[active[a], active[b]]
            kv = Kv[active[a], active[b]]
            for column in range(4 * n):
                kY[n + a, column] += kx * (Y[b, column] - Y[2 * n + b, column]) + kv * (
                    Y[n + b, column] - Y[3 * n + b, column]
                )
    for a in range(n):
        for column in range(4 * n):
            force = kY[n + a, column]
            kY[a, column] = Y[n + a, column]
            kY[n + a, column] = -force * inverse_mi[a]
            kY[2 * n + a, column] = Y[3 * n + a, column]
            kY[3 * n + a, column] = inverse_mo[a] * (
                force - ko[a] * Y[2 * n + a, column] - co[a] * Y[3 * n + a, column]
            )


@compiled
def march_with_tangent(
    y, Y, n_steps, h, start_angle, cage_speed, rows, tables, F, active, mi, mo, ko, co,
    n_balls, ca, sa, A0, rL, K, damping, history,
):
    """`march` without tension, and beside it the tangent Y (4 n, 4 n).

    That is how the end changes with the beginning.
    """
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    d_rate = np.zeros(shape)
    k = np.zeros((4, 4 * n))
    kY = np.zeros((4, 4 * n, 4 * n))
    trial = np.zeros(4 * n)
    trial_Y = np.zeros((4 * n, 4 * n))
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    Kx = np.zeros((5, 5))
    Kv = np.zeros((5, 5))
    was = np.zeros(n_balls, dtype=np.bool_)
    now = np.zeros(n_balls, dtype=np.bool_)
    loaded = np.zeros(n_balls, dtype=np.bool_)
    inverse_mi = 1.0 / mi
    inverse_mo = 1.0 / mo
    half_turn = 0.5 * h * cage_speed
    ahead = np.array([0.0, 0.5 * h, 0.5 * h, h])
    half_steps_on = np.array([0, 1, 1, 2])
    weight = np.array([1.0, 2.0, 2.0, 1.0]) * (h / 6.0)
    for step in range(n_steps + 1):
        i = (2 * step) % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, 2 * (n_steps - step)) + 1
            lay_out_balls(
                start_angle + 2 * step * half_turn, half_turn, count, cage_speed, rows, tables,
                ball_c, ball_s, c, s, d, d_rate,
            )
        for stage in range(4):
            for r in range(4 * n):
                trial[r] = y[r]
                if stage > 0:
                    trial[r] += ahead[stage] * k[stage - 1, r]
                for column in range(4 * n):
                    trial_Y[r, column] = Y[r, column]
                    if stage > 0:
                        trial_Y[r, column] += ahead[stage] * kY[stage - 1, r, column]
            rates_with_tangent(
                trial, trial_Y, k[stage], kY[stage], c, s, d, d_rate, i + half_steps_on[stage],
                cage_speed, F, active, inverse_mi, inverse_mo, ko, co,
                ca, sa, A0, rL, K, damping, x, v, f, Kx, Kv, loaded,
            )
            if stage == 0:
                was[:] = now
                now[:] = loaded
                # x and v are those of this instant, the end of the step before
                if step > 0 and touch_and_leave(
                    Y, x, c, s, d, i, was, now, active, inverse_mi, inverse_mo,
                    ca, sa, A0, rL, damping,
                ):
                    rates_with_tangent(
                        y, Y, k[0], kY[0], c, s, d, d_rate, i, cage_speed, F, active,
                        inverse_mi, inverse_mo, ko, co, ca, sa, A0, rL, K, damping,
                        x, v, f, Kx, Kv, loaded,
                    )
                for a in range(n):
                    history[step, 0, a] = y[a]
                    history[step, 1, a] = y[n + a]
                    history[step, 2, a] = k[0, n + a]
                    history[step, 3, a] = y[2 * n + a]
                    history[step, 4, a] = y[3 * n + a]
                    history[step, 5, a] = k[0, 3 * n + a]
                if step == n_steps:
                    return n_steps
        for r in range(4 * n):
            for stage in range(4):
                y[r] += weight[stage] * k[stage, r]
                for column in range(4 * n):
                    Y[r, column] += weight[stage] * kY[stage, r, column]
        for r in range(4 * n):
            if not math.isfinite(y[r]):
                return step
    return n_steps


@compiled
def flat_sums_with_tangent(x0, x1, c, s, d, at, rL, K):
    """`flat_sums`, then G = Σ 1.5 K √δ e e' and N = Σ e e' over the loaded balls: xx, xy, yy."""
    f0 = 0.0
    f1 = 0.0
    S0 = 0.0
    S1 = 0.0
    G00 = 0.0
    G01 = 0.0
    G11 = 0.0
    N00 = 0.0
    N01 = 0.0
    N11 = 0.0
    for j in range(c.shape[1]):
        cj = c[at, j]
        sj = s[at, j]
        delta = x0 * cj + x1 * sj - rL - d[at, j]
        if delta > 0.0:
            k = K * math.sqrt(delta)
            Q = k * delta
            k *= 1.5
            f0 += Q * cj
            f1 += Q * sj
            S0 += delta * cj
            S1 += delta * sj
            G00 += k * cj * cj
            G01 += k * cj * sj
            G11 += k * sj * sj
            N00 += cj * cj
            N01 += cj * sj
            N11 += sj * sj
    return f0, f1, S0, S1, G00, G01, G11, N00, N01, N11


@compiled
def flat_rates_with_tangent(
    y, Y, k, kY, stage, c, s, d, at, cage_speed, F, im, om, ko, co, rL, K, damping
):
    """`flat_rates` of y (8,) into k[stage] and the rate of the tangent Y (8, 8) into kY[stage]."""
    f0, f1, S0, S1, G00, G01, G11, N00, N01, N11 = flat_sums_with_tangent(
        y[0] - y[4], y[1] - y[5], c, s, d, at, rL, K
    )
    turning = damping * cage_speed
    push0 = f0 + turning * S1
    push1 = f1 - turning * S0
    k[stage, 0] = y[2] - damping * im[0] * S0
    k[stage, 1] = y[3] - damping * im[1] * S1
    k[stage, 2] = (F[0] - push0) * im[0]
    k[stage, 3] = (F[1] - push1) * im[1]
    k[stage, 4] = y[6] + damping * om[0] * S0
    k[stage, 5] = y[7] + damping * om[1] * S1
    k[stage, 6] = (push0 - ko[0] * y[4] - co[0] * k[stage, 4]) * om[0]
    k[stage, 7] = (push1 - ko[1] * y[5] - co[1] * k[stage, 5]) * om[1]
    B00 = G00 + turning * N01  # ∂push/∂x
    B01 = G01 + turning * N11
    B10 = G01 - turning * N00
    B11 = G11 - turning * N01
    for column in range(8):
        x0 = Y[0, column] - Y[4, column]
        x1 = Y[1, column] - Y[5, column]
        S0 = damping * (N00 * x0 + N01 * x1)
        S1 = damping * (N01 * x0 + N11 * x1)
        push0 = B00 * x0 + B01 * x1
        push1 = B10 * x0 + B11 * x1
        vo0 = Y[6, column] + om[0] * S0
        vo1 = Y[7, column] + om[1] * S1
        kY[stage, 0, column] = Y[2, column] - im[0] * S0
        kY[stage, 1, column] = Y[3, column] - im[1] * S1
        kY[stage, 2, column] = -push0 * im[0]
        kY[stage, 3, column] = -push1 * im[1]
        kY[stage, 4, column] = vo0
        kY[stage, 5, column] = vo1
        kY[stage, 6, column] = (push0 - ko[0] * Y[4, column] - co[0] * vo0) * om[0]
        kY[stage, 7, column] = (push1 - ko[1] * Y[5, column] - co[1] * vo1) * om[1]


@compiled
def march_flat_with_tangent(
    y, Y, n_steps, h, start_angle, cage_speed, rows, tables, F, mi, mo, ko, co,
    n_balls, rL, K, damping, history,
):
    """`march_flat`, and beside it the tangent Y (8, 8): how the end changes with the beginning.

    In smooth variables nothing jumps as balls touch, so the tangent needs no corrections there.
    """
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    dr = np.zeros(shape)
    k = np.empty((4, 8))
    kY = np.empty((4, 8, 8))
    z = np.empty(8)
    Z = np.empty((8, 8))
    im = 1.0 / mi
    om = 1.0 / mo
    half_turn = 0.5 * h * cage_speed
    sixth = h / 6.0
    for step in range(n_steps + 1):
        i = (2 * step) % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, 2 * (n_steps - step)) + 1
            lay_out_balls(
                start_angle + 2 * step * half_turn, half_turn, count, cage_speed, rows, tables,
                ball_c, ball_s, c, s, d, dr,
            )
        flat_rates_with_tangent(
            y, Y, k, kY, 0, c, s, d, i, cage_speed, F, im, om, ko, co, rL, K, damping
        )
        flat_record(
            history, step, y[0], y[1], k[0, 0], k[0, 1], y[4], y[5], k[0, 4], k[0, 5],
            c, s, d, dr, i, cage_speed, F, im, om, ko, co, rL, K, damping,
        )
        if step == n_steps:
            break
        for stage in range(1, 4):
            ahead = h if stage == 3 else 0.5 * h
            for r in range(8):
                z[r] = y[r] + ahead * k[stage - 1, r]
                for column in range(8):
                    Z[r, column] = Y[r, column] + ahead * kY[stage - 1, r, column]
            flat_rates_with_tangent(
                z, Z, k, kY, stage, c, s, d, i + (2 if stage == 3 else 1), cage_speed,
                F, im, om, ko, co, rL, K, damping,
            )
        for r in range(8):
            y[r] += sixth * (k[0, r] + 2.0 * (k[1, r] + k[2, r]) + k[3, r])
            for column in range(8):
                Y[r, column] += sixth * (
                    kY[0, r, column]
                    + 2.0 * (kY[1, r, column] + kY[2, r, column])
                    + kY[3, r, column]
                )
    return n_steps


# ------------------------------------ the published law without jumps, in any directions
#
# What stands above `flat_sums` holds wherever contacts point: c δ̇ e = d/dt(c δ e) − c δ ė. Where
# contacts swivel, ė takes velocities, which follow from w and displacements. Against `march` the
# error of a motion at the same steps is smaller by a factor of 10 to 100.
#
# Numbers of a scene travel packed here and in the section after the next:
# numbers = (cage_speed, cos α0, sin α0, A0, r_L, K, contact damping, pull), and
# bodies (5, n) = load, inverse inner and outer mass, stiffness and damping of the support.


@inlined
def find_loaded(x, c, s, d, at, ca, sa, A0, rL, balls, contacts):
    """Σ δ e over the loaded balls [m] and how many they are, e the direction of a contact in q.

    Their numbers go into balls (n_balls,); δ, er, ez and 1/A, 0 where the centres have passed each
    other and a contact does not swivel, into contacts (n_balls, 4).
    """
    S0 = 0.0
    S1 = 0.0
    S2 = 0.0
    S3 = 0.0
    S4 = 0.0
    count = 0
    for j in range(c.shape[1]):
        cj = c[at, j]
        sj = s[at, j]
        r = x[0] * cj + x[1] * sj - rL
        z = x[2] + x[3] * sj - x[4] * cj
        m = r * ca + z * sa - d[at, j]
        delta, eu, ew, A = compression(m, z * ca - r * sa, A0)
        if delta <= 0.0:
            continue
        er = eu * ca - ew * sa
        ez = eu * sa + ew * ca
        balls[count] = j
        contacts[count, 0] = delta
        contacts[count, 1] = er
        contacts[count, 2] = ez
        contacts[count, 3] = 1.0 / A if A0 + m > 0.0 else 0.0
        count += 1
        er *= delta
        ez *= delta
        S0 += er * cj
        S1 += er * sj
        S2 += ez
        S3 += ez * sj
        S4 -= ez * cj
    return S0, S1, S2, S3, S4, count


@inlined
def smooth_force(
    x, v, c, s, d_rate, at, cage_speed, ca, sa, K, damping, balls, contacts, count, smooth
):
    """Σ (Q e − c δ ė) [N]: the published law's force on the outer ring less d/dt of c Σ δ e.

    e turns with the ball and with the contact angle, whose rate is (t·ṗ)/A, t across the contact
    and ṗ the ball's rate of displacement. Where not `smooth`: Σ (Q + c δ̇) e, the force itself.
    """
    u0 = v[0] + cage_speed * x[1]  # the turning of the balls, moved over to the rings
    u1 = v[1] - cage_speed * x[0]
    u2 = v[2]
    u3 = v[3] + cage_speed * x[4]
    u4 = v[4] - cage_speed * x[3]
    f0 = 0.0
    f1 = 0.0
    f2 = 0.0
    f3 = 0.0
    f4 = 0.0
    for i in range(count):
        j = balls[i]
        delta = contacts[i, 0]
        er = contacts[i, 1]
        ez = contacts[i, 2]
        cj = c[at, j]
        sj = s[at, j]
        r_rate = u0 * cj + u1 * sj - ca * d_rate[at, j]
        z_rate = u2 + u3 * sj - u4 * cj - sa * d_rate[at, j]
        Q = K * delta * math.sqrt(delta)
        if smooth:
            damped = damping * delta
            swivel = damped * (er * z_rate - ez * r_rate) * contacts[i, 3]
            along_r = Q * er + swivel * ez
            along_z = Q * ez - swivel * er
            turn_r = damped * cage_speed * er
            turn_z = damped * cage_speed * ez
            f0 += along_r * cj + turn_r * sj
            f1 += along_r * sj - turn_r * cj
            f2 += along_z
            f3 += along_z * sj - turn_z * cj
            f4 -= along_z * cj + turn_z * sj
        else:
            push = Q + damping * (er * r_rate + ez * z_rate)
            f0 += push * er * cj
            f1 += push * er * sj
            f2 += push * ez
            f3 += push * ez * sj
            f4 -= push * ez * cj
    return f0, f1, f2, f3, f4


@compiled
def turn_smooth(y, sign, angle, n_balls, numbers, bodies, active, rows, tables):
    """Turn velocities in the state y (4 n,) into w (sign 1), or back (sign −1), in place."""
    n = active.size
    _, ca, sa, A0, rL, _, damping, _ = numbers
    ball_c, ball_s = ball_circle(n_balls)
    c = np.empty((1, n_balls))
    s = np.empty((1, n_balls))
    d = np.zeros((1, n_balls))
    d_rate = np.zeros((1, n_balls))
    lay_out_balls(angle, 0.0, 1, 1.0, rows, tables, ball_c, ball_s, c, s, d, d_rate)
    x = np.zeros(5)
    S = np.zeros(5)
    balls = np.empty(n_balls, dtype=np.int64)
    contacts = np.empty((n_balls, 4))
    for a in range(n):
        x[active[a]] = y[a] - y[2 * n + a]
    S[0], S[1], S[2], S[3], S[4], _ = find_loaded(
        x, c, s, d, 0, ca, sa, A0, rL, balls, contacts
    )
    for a in range(n):
        y[n + a] += sign * damping * bodies[1, a] * S[active[a]]
        y[3 * n + a] -= sign * damping * bodies[2, a] * S[active[a]]


@inlined
def smooth_rates(
    y, k, c, s, d, d_rate, at, numbers, bodies, active, x, v, f, balls, contacts
):
    """dy/dt of the smooth variables into k (4 n,); returns how many balls are loaded.

    x, v, f (5,), balls and contacts are work space; x and v are left as the relative displacement
    and velocity of the rings, balls and contacts as `find_loaded` has them.
    """
    n = active.size
    w, ca, sa, A0, rL, K, damping, _ = numbers
    for a in range(n):
        x[active[a]] = y[a] - y[2 * n + a]
    f[0], f[1], f[2], f[3], f[4], loaded = find_loaded(
        x, c, s, d, at, ca, sa, A0, rL, balls, contacts
    )
    for a in range(n):
        k[a] = y[n + a] - damping * bodies[1, a] * f[active[a]]
        k[2 * n + a] = y[3 * n + a] + damping * bodies[2, a] * f[active[a]]
        v[active[a]] = k[a] - k[2 * n + a]
    f[0], f[1], f[2], f[3], f[4] = smooth_force(
        x, v, c, s, d_rate, at, w, ca, sa, K, damping, balls, contacts, loaded, True
    )
    for a in range(n):
        force = f[active[a]]
        k[n + a] = (bodies[0, a] - force) * bodies[1, a]
        k[3 * n + a] = (
            force - bodies[3, a] * y[2 * n + a] - bodies[4, a] * k[2 * n + a]
        ) * bodies[2, a]
    return loaded


@inlined
def smooth_record(
    history, step, y, k, c, s, d_rate, at, numbers, bodies, active, x, v, f, balls, contacts, loaded
):
    """Displacements, velocities and accelerations (Eq. 18) after `smooth_rates` has been there."""
    n = active.size
    w, ca, sa, _, _, K, damping, _ = numbers
    f[0], f[1], f[2], f[3], f[4] = smooth_force(
        x, v, c, s, d_rate, at, w, ca, sa, K, damping, balls, contacts, loaded, False
    )
    for a in range(n):
        force = f[active[a]]
        xo = y[2 * n + a]
        vo = k[2 * n + a]
        history[step, 0, a] = y[a]
        history[step, 1, a] = k[a]
        history[step, 2, a] = (bodies[0, a] - force) * bodies[1, a]
        history[step, 3, a] = xo
        history[step, 4, a] = vo
        history[step, 5, a] = (force - bodies[3, a] * xo - bodies[4, a] * vo) * bodies[2, a]


@compiled
def march_smooth(
    y, n_steps, h, start_angle, n_balls, numbers, bodies, active, rows, tables, history
):
    """`march` under the published law in variables that do not jump, in any directions.

    As in `march_flat`, w_i = v_i + (c/m_i) Σ δ e and w_o = v_o − (c/m_o) Σ δ e are marched instead
    of velocities: y (4 n,) holds them (see `turn_smooth`) and is moved to the end. history holds
    velocities; it and what is returned are as in `march`.
    """
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    d_rate = np.zeros(shape)
    k = np.zeros((4, 4 * n))
    trial = np.zeros(4 * n)
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    balls = np.empty(n_balls, dtype=np.int64)
    contacts = np.empty((n_balls, 4))
    w = numbers[0]
    half_turn = 0.5 * h * w
    for step in range(n_steps + 1):
        i = (2 * step) % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, 2 * (n_steps - step)) + 1
            angle = start_angle + 2 * step * half_turn
            lay_out_balls(angle, half_turn, count, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
            for r in range(4 * n):
                if not math.isfinite(y[r]):
                    return max(step - GEOMETRY_BLOCK // 2, 0)
        for stage in range(4):
            at = i + (stage + 1) // 2
            part = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
            for r in range(4 * n):
                trial[r] = y[r] + (part * k[stage - 1, r] if stage > 0 else 0.0)
            loaded = smooth_rates(
                trial, k[stage], c, s, d, d_rate, at, numbers, bodies, active, x, v, f,
                balls, contacts,
            )
            if stage == 0:
                smooth_record(
                    history, step, y, k[0], c, s, d_rate, at, numbers, bodies, active, x, v, f,
                    balls, contacts, loaded,
                )
                if step == n_steps:
                    break
        if step == n_steps:
            break
        for r in range(4 * n):
            y[r] += h / 6.0 * (k[0, r] + 2.0 * (k[1, r] + k[2, r]) + k[3, r])
    for r in range(4 * n):
        if not math.isfinite(y[r]):
            return max(n_steps - GEOMETRY_BLOCK // 2, 0)
    return n_steps


@compiled
def smooth_tangent(
    x, v, c, s, d_rate, at, numbers, balls, contacts, loaded, e, t, e_turn, t_turn, Sx, Px, Pv
):
    """How Σ δ e and the force of `smooth_force` change with x and v: Sx, Px and Pv (5, 5).

    With e along a contact and t across it, in q, and e_turn and t_turn their derivatives with the
    cage's turning: de = t (t·dx)/A, dt = −e (t·dx)/A, dδ = dA = e·dx, and σ = (t·ṗ)/A.
    e, t, e_turn, t_turn (5,) are work space.
    """
    w, ca, sa, _, _, K, damping, _ = numbers
    for a in range(5):
        for b in range(5):
            Sx[a, b] = 0.0
            Px[a, b] = 0.0
            Pv[a, b] = 0.0
    e_turn[2] = 0.0
    t_turn[2] = 0.0
    for i in range(loaded):
        j = balls[i]
        delta = contacts[i, 0]
        er = contacts[i, 1]
        ez = contacts[i, 2]
        bend = contacts[i, 3]
        cj = c[at, j]
        sj = s[at, j]
        r_rate = v[0] * cj + v[1] * sj + w * (x[1] * cj - x[0] * sj) - ca * d_rate[at, j]
        z_rate = v[2] + v[3] * sj - v[4] * cj + w * (x[3] * cj + x[4] * sj) - sa * d_rate[at, j]
        e[0] = er * cj
        e[1] = er * sj
        e[2] = ez
        e[3] = ez * sj
        e[4] = -ez * cj
        t[0] = -ez * cj
        t[1] = -ez * sj
        t[2] = er
        t[3] = er * sj
        t[4] = -er * cj
        e_turn[0] = -er * sj
        e_turn[1] = er * cj
        e_turn[3] = ez * cj
        e_turn[4] = ez * sj
        t_turn[0] = ez * sj
        t_turn[1] = -ez * cj
        t_turn[3] = er * cj
        t_turn[4] = er * sj
        root = math.sqrt(delta)
        k1 = 1.5 * K * root
        k2 = K * delta * root * bend
        sigma = bend * (er * z_rate - ez * r_rate)
        along = er * r_rate + ez * z_rate
        damped = damping * delta * bend
        for b in range(5):
            # of swivel = c δ σ, which pushes along −t
            swivel = (
                damping * sigma * (1.0 - delta * bend) * e[b]
                + damped * (w * t_turn[b] - along * bend * t[b])
            )
            for a in range(5):
                Sx[a, b] += e[a] * e[b] + delta * bend * t[a] * t[b]
                Px[a, b] += (
                    k1 * e[a] * e[b] + (k2 * t[a] + damped * sigma * e[a]) * t[b] - t[a] * swivel
                    - w * (damping * e_turn[a] * e[b] + damped * t_turn[a] * t[b])
                )
                Pv[a, b] -= damped * t[a] * t[b]


@compiled
def smooth_tangent_rates(Y, kY, k_rows, bodies, active, damping, Sx, Px, Pv):
    """Rate of the tangent Y (4 n, 4 n) into kY; k_rows (2 n, 4 n) is work space."""
    n = active.size
    size = 4 * n
    for a in range(n):
        for column in range(size):
            k_rows[a, column] = 0.0
    for a in range(n):
        for b in range(n):
            stiff = damping * Sx[active[a], active[b]]
            for column in range(size):
                k_rows[a, column] += stiff * (Y[b, column] - Y[2 * n + b, column])
    for a in range(n):
        for column in range(size):
            kY[a, column] = Y[n + a, column] - bodies[1, a] * k_rows[a, column]
            kY[2 * n + a, column] = Y[3 * n + a, column] + bodies[2, a] * k_rows[a, column]
            k_rows[n + a, column] = 0.0
    for a in range(n):
        for b in range(n):
            kx = Px[active[a], active[b]]
            kv = Pv[active[a], active[b]]
            for column in range(size):
                k_rows[n + a, column] += kx * (Y[b, column] - Y[2 * n + b, column]) + kv * (
                    kY[b, column] - kY[2 * n + b, column]
                )
    for a in range(n):
        for column in range(size):
            force = k_rows[n + a, column]
            kY[n + a, column] = -force * bodies[1, a]
            kY[3 * n + a, column] = bodies[2, a] * (
                force - bodies[3, a] * Y[2 * n + a, column] - bodies[4, a] * kY[2 * n + a, column]
            )


@compiled
def march_smooth_with_tangent(
    y, Y, n_steps, h, start_angle, n_balls, numbers, bodies, active, rows, tables, history
):
    """`march_smooth`, and beside it the tangent Y (4 n, 4 n).

    That is how the end changes with the beginning. In smooth variables nothing jumps as balls
    touch: the steps of the tangent are the derivative of those of the motion, without corrections.
    """
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    d_rate = np.zeros(shape)
    k = np.zeros((4, 4 * n))
    kY = np.zeros((4, 4 * n, 4 * n))
    trial = np.zeros(4 * n)
    trial_Y = np.zeros((4 * n, 4 * n))
    k_rows = np.zeros((2 * n, 4 * n))
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    directions = np.zeros((4, 5))
    Sx = np.zeros((5, 5))
    Px = np.zeros((5, 5))
    Pv = np.zeros((5, 5))
    balls = np.empty(n_balls, dtype=np.int64)
    contacts = np.empty((n_balls, 4))
    w = numbers[0]
    half_turn = 0.5 * h * w
    for step in range(n_steps + 1):
        i = (2 * step) % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, 2 * (n_steps - step)) + 1
            angle = start_angle + 2 * step * half_turn
            lay_out_balls(angle, half_turn, count, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
            for r in range(4 * n):
                if not math.isfinite(y[r]):
                    return max(step - GEOMETRY_BLOCK // 2, 0)
        for stage in range(4):
            at = i + (stage + 1) // 2
            part = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
            before = max(stage - 1, 0)
            for r in range(4 * n):
                trial[r] = y[r] + part * k[before, r]
                for column in range(4 * n):
                    trial_Y[r, column] = Y[r, column] + part * kY[before, r, column]
            loaded = smooth_rates(
                trial, k[stage], c, s, d, d_rate, at, numbers, bodies, active, x, v, f,
                balls, contacts,
            )
            if stage == 0:
                smooth_record(
                    history, step, y, k[0], c, s, d_rate, at, numbers, bodies, active, x, v, f,
                    balls, contacts, loaded,
                )
                if step == n_steps:
                    return n_steps
            smooth_tangent(
                x, v, c, s, d_rate, at, numbers, balls, contacts, loaded,
                directions[0], directions[1], directions[2], directions[3], Sx, Px, Pv,
            )
            smooth_tangent_rates(trial_Y, kY[stage], k_rows, bodies, active, numbers[6], Sx, Px, Pv)
        for r in range(4 * n):
            y[r] += h / 6.0 * (k[0, r] + 2.0 * (k[1, r] + k[2, r]) + k[3, r])
            for column in range(4 * n):
                Y[r, column] += h / 6.0 * (
                    kY[0, r, column]
                    + 2.0 * (kY[1, r, column] + kY[2, r, column])
                    + kY[3, r, column]
                )
    return n_steps


# -------------------------------------------------- other ways to march, to compare with the above
#
# These are measured beside the marches above (experiments); of them only the adaptive one
# is also used, for contacts without tension. Numbers of a scene travel packed as above.


@compiled
def motion_rate(t, y, start_angle, n_balls, numbers, bodies, active, rows, tables):
    """dy/dt (4 n,) at the time t [s] and state y: what general-purpose integrators ask for."""
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    c = np.empty((1, n_balls))
    s = np.empty((1, n_balls))
    d = np.zeros((1, n_balls))
    d_rate = np.zeros((1, n_balls))
    w = numbers[0]
    lay_out_balls(start_angle + w * t, 0.0, 1, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
    k = np.empty(4 * n)
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    rate_of_change(
        y, k, n, c, s, d, d_rate, 0, w, bodies[0], active, bodies[1], bodies[2], bodies[3],
        bodies[4], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6],
        numbers[7] > 0.0, x, v, f,
    )
    return k


@inlined
def record(history, row, y, k, n):
    """Displacement, velocity and acceleration of both bodies into one row of a history."""
    for a in range(n):
        history[row, 0, a] = y[a]
        history[row, 1, a] = y[n + a]
        history[row, 2, a] = k[n + a]
        history[row, 3, a] = y[2 * n + a]
        history[row, 4, a] = y[3 * n + a]
        history[row, 5, a] = k[3 * n + a]


@compiled
def interpolate_step(history, row, part, h, y0, k0, y1, k1, n):
    """A row of a history, `part` of the step h after y0: quintic in x, v, a of both ends."""
    u = part
    for body in range(2):
        for a in range(n):
            i = 2 * body * n + a
            x0 = y0[i]
            v0 = h * y0[n + i]
            a0 = 0.5 * h * h * k0[n + i]
            rise = y1[i] - x0 - v0 - a0
            speed = h * y1[n + i] - v0 - 2.0 * a0
            bend = 0.5 * h * h * k1[n + i] - a0
            c3 = 10.0 * rise - 4.0 * speed + bend
            c4 = -15.0 * rise + 7.0 * speed - 2.0 * bend
            c5 = 6.0 * rise - 3.0 * speed + bend
            history[row, 3 * body, a] = x0 + u * (v0 + u * (a0 + u * (c3 + u * (c4 + u * c5))))
            history[row, 3 * body + 1, a] = (
                v0 + u * (2.0 * a0 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))
            ) / h
            history[row, 3 * body + 2, a] = (
                2.0 * a0 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))
            ) / (h * h)


# Dormand & Prince 5(4): stages, their times, and the difference of the two orders.
PAIR_STAGES = np.array([
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
])
PAIR_TIMES = np.array([0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0])
PAIR_ERROR = np.array([
    -71.0 / 57600.0, 0.0, 71.0 / 16695.0, -71.0 / 1920.0, 17253.0 / 339200.0, -22.0 / 525.0,
    1.0 / 40.0,
])


@compiled
def march_adaptive(
    y, sample_step, tolerance, scale, stops, most_calls, start_angle, n_balls, numbers, bodies,
    active, rows, tables, history,
):
    """Dormand and Prince's embedded pair of orders 5 and 4 from y (4 n,), which is moved.

    The root mean square of error/scale (4 n,) of each step stays below `tolerance`; a step ends at
    each of the rising times `stops` [s]. history (samples, 6, n) is filled every `sample_step` [s]
    between steps. Returns (samples filled, steps, refused steps, right-hand-side calls).
    """
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    c = np.empty((1, n_balls))
    s = np.empty((1, n_balls))
    d = np.zeros((1, n_balls))
    d_rate = np.zeros((1, n_balls))
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    k = np.zeros((7, 4 * n))
    trial = np.zeros(4 * n)
    w = numbers[0]
    n_samples = history.shape[0]
    end = (n_samples - 1) * sample_step
    t = 0.0
    h = 1e-3 * sample_step  # short enough; steps grow by up to five times
    norm_before = 1.0
    first = 0  # the first stage to compute: the last one of a step is the first of the next
    refused_last = False
    stop = 0
    sample = 0
    steps = 0
    refused = 0
    calls = 0
    while True:
        while stop < stops.size and stops[stop] <= t:
            stop += 1
        target = min(stops[stop], end) if stop < stops.size else end
        last = h >= 0.999999 * (target - t)
        taken = target - t if last else h
        for stage in range(first, 7):
            for r in range(4 * n):
                total = 0.0
                for i in range(stage):
                    total += PAIR_STAGES[stage, i] * k[i, r]
                trial[r] = y[r] + taken * total
            angle = start_angle + w * (t + PAIR_TIMES[stage] * taken)
            lay_out_balls(angle, 0.0, 1, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
            rate_of_change(
                trial, k[stage], n, c, s, d, d_rate, 0, w, bodies[0], active, bodies[1],
                bodies[2], bodies[3], bodies[4], numbers[1], numbers[2], numbers[3], numbers[4],
                numbers[5], numbers[6], numbers[7] > 0.0, x, v, f,
            )
            calls += 1
        first = 1
        total = 0.0
        for r in range(4 * n):
            e = 0.0
            for i in range(7):
                e += PAIR_ERROR[i] * k[i, r]
            total += (taken * e / scale[r]) ** 2
        norm = math.sqrt(total / (4 * n)) / tolerance
        if not math.isfinite(norm) or calls > most_calls or t + 0.1 * taken == t:
            return sample, steps, refused, calls
        if norm > 1.0:
            refused += 1
            refused_last = True
            h = taken * max(0.1, 0.9 * norm ** -0.2)
            continue
        steps += 1
        ends = last and target == end
        while sample < n_samples and (ends or sample * sample_step <= t + taken):
            part = min((sample * sample_step - t) / taken, 1.0)
            interpolate_step(history, sample, part, taken, y, k[0], trial, k[6], n)
            sample += 1
        t = target if last else t + taken
        for r in range(4 * n):
            y[r] = trial[r]
            k[0, r] = k[6, r]
        if sample >= n_samples:
            return sample, steps, refused, calls
        norm = max(norm, 1e-4)
        grown = taken * min(5.0, max(0.2, 0.9 * norm ** -0.14 * norm_before ** 0.08))
        h = max(h, grown) if last else min(grown, taken) if refused_last else grown
        refused_last = False
        norm_before = norm


@compiled
def march_verlet(
    y, n_steps, h, start_angle, n_balls, numbers, bodies, active, rows, tables, history
):
    """Velocity-Verlet steps (leapfrog) of order 2 from y (4 n,), which is moved to the end.

    One right-hand side a step; forces that hang on velocity take it as half a step's acceleration
    foretells. history and what is returned: as `march`.
    """
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    shape = (GEOMETRY_BLOCK + 1, n_balls)
    c = np.empty(shape)
    s = np.empty(shape)
    d = np.zeros(shape)
    d_rate = np.zeros(shape)
    k = np.zeros(4 * n)
    half = np.zeros((2, n))
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    w = numbers[0]
    for step in range(n_steps + 1):
        i = step % GEOMETRY_BLOCK
        if i == 0:
            count = min(GEOMETRY_BLOCK, n_steps - step) + 1
            angle = start_angle + step * h * w
            lay_out_balls(angle, h * w, count, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
            for r in range(4 * n):
                if not math.isfinite(y[r]):
                    return max(step - GEOMETRY_BLOCK, 0)
        if step > 0:
            for b in range(2):
                for a in range(n):
                    r = 2 * b * n + a
                    half[b, a] = y[n + r] + 0.5 * h * k[n + r]
                    y[r] += h * half[b, a]
                    y[n + r] = half[b, a] + 0.5 * h * k[n + r]  # foretold
        rate_of_change(
            y, k, n, c, s, d, d_rate, i, w, bodies[0], active, bodies[1], bodies[2], bodies[3],
            bodies[4], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6],
            numbers[7] > 0.0, x, v, f,
        )
        if step > 0:
            for b in range(2):
                for a in range(n):
                    r = 2 * b * n + a
                    y[n + r] = half[b, a] + 0.5 * h * k[n + r]
        record(history, step, y, k, n)
    for r in range(4 * n):
        if not math.isfinite(y[r]):
            return max(n_steps - GEOMETRY_BLOCK, 0)
    return n_steps


@compiled
def march_generalised_alpha(
    y, n_steps, h, am, af, start_angle, n_balls, numbers, bodies, active, rows, tables, history
):
    """Implicit steps of order 2 by the generalised-α method of Chung and Hulbert (1993).

    Inertia is taken `am` and forces `af` of a step before its end: am = af = 0 is the trapezoidal
    rule. The equations of a step are solved by Newton's method with the stiffness of the contacts
    and the damping of the support. Accelerations recorded are those of the equation of motion at
    the end of a step, not the method's own. Returns (steps that stayed finite, right-hand-side
    calls, steps whose equations were not solved to 1e-10 of their size).
    """
    n = active.size
    m = 2 * n
    ball_c, ball_s = ball_circle(n_balls)
    c = np.empty((1, n_balls))
    s = np.empty((1, n_balls))
    d = np.zeros((1, n_balls))
    d_rate = np.zeros((1, n_balls))
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    no_load = np.zeros(5)
    g = np.zeros(5)
    H = np.zeros((5, 5))
    S = np.zeros((m, m))
    L = np.zeros((m, m))
    residual = np.zeros(m)
    change = np.zeros(m)
    everything = np.arange(m)
    k = np.zeros(4 * n)
    middle = np.zeros(4 * n)
    own = np.zeros(m)  # the method's accelerations, inner then outer
    now = np.zeros(m)
    trial = np.zeros(4 * n)
    w, ca, sa, A0, rL, K, damping, pull = numbers
    gamma = 0.5 - am + af
    beta = 0.25 * (1.0 - am + af) ** 2
    calls = 0
    unsolved = 0
    for step in range(n_steps + 1):
        if step > 0:
            angle = start_angle + w * h * (step - af)
            lay_out_balls(angle, 0.0, 1, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
            for i in range(m):
                now[i] = own[i]
            solved = False
            for _ in range(12):
                for b in range(2):
                    for a in range(n):
                        i = b * n + a
                        r = 2 * b * n + a
                        trial[r] = (
                            y[r] + h * y[n + r]
                            + h * h * ((0.5 - beta) * own[i] + beta * now[i])
                        )
                        trial[n + r] = y[n + r] + h * ((1.0 - gamma) * own[i] + gamma * now[i])
                for r in range(4 * n):
                    middle[r] = (1.0 - af) * trial[r] + af * y[r]
                rate_of_change(
                    middle, k, n, c, s, d, d_rate, 0, w, bodies[0], active, bodies[1], bodies[2],
                    bodies[3], bodies[4], ca, sa, A0, rL, K, damping, pull > 0.0, x, v, f,
                )
                calls += 1
                worst = 0.0
                size = 1e-300
                for b in range(2):
                    for a in range(n):
                        i = b * n + a
                        wanted = (1.0 - am) * now[i] + am * own[i]
                        have = k[2 * b * n + n + a]
                        residual[i] = (wanted - have) / bodies[1 + b, a]
                        worst = max(worst, abs(residual[i]))
                        size = max(size, abs(f[active[a]]) + abs(bodies[0, a]))
                if not math.isfinite(worst):
                    return max(step - 1, 0), calls, unsolved
                if worst <= 1e-10 * size:
                    solved = True
                    break
                energy_gradient_hessian(
                    x, no_load, c[0], s[0], d[0], ca, sa, A0, rL, K, g, H
                )
                spring = (1.0 - af) * beta * h * h
                damper = (1.0 - af) * gamma * h
                for a in range(n):
                    for b in range(a + 1):
                        i, j = max(active[a], active[b]), min(active[a], active[b])
                        stiff = spring * H[i, j]
                        S[a, b] = stiff
                        S[n + a, n + b] = stiff
                        S[n + a, b] = -stiff
                        S[n + b, a] = -stiff
                    S[a, a] += (1.0 - am) / bodies[1, a]
                    S[n + a, n + a] += (
                        (1.0 - am) / bodies[2, a] + spring * bodies[3, a] + damper * bodies[4, a]
                    )
                newton_direction(S, residual, everything, 0.0, L, change)
                for i in range(m):
                    now[i] += change[i]
            if not solved:
                unsolved += 1
            for i in range(m):
                own[i] = now[i]
            for r in range(4 * n):
                y[r] = trial[r]
        k[:] = motion_rate(
            h * step, y, start_angle, n_balls, numbers, bodies, active, rows, tables
        )
        calls += 1
        if step == 0:
            for a in range(n):
                own[a] = k[n + a]
                own[n + a] = k[3 * n + a]
        record(history, step, y, k, n)
    return n_steps, calls, unsolved


@compiled
def static_states_cold(cage_angles, rows, tables, F, active, n_balls, ca, sa, A0, rL, K):
    """Energy evaluations of `static_states` with each angle started afresh, and whether all met."""
    evaluations = 0
    met = True
    q = np.zeros((cage_angles.size, 5))
    for k in range(cage_angles.size):
        one = static_states(
            cage_angles[k : k + 1], rows, tables, F, active, n_balls, ca, sa, A0, rL, K
        )
        q[k] = one[0][0]
        evaluations += one[7][0]
        met = met and one[4][0] == CONVERGED
    return q, evaluations, met


@compiled
def motion_rates(times, states, start_angle, n_balls, numbers, bodies, active, rows, tables):
    """`motion_rate` at each of the times (m,) and states (m, 4 n)."""
    n = active.size
    ball_c, ball_s = ball_circle(n_balls)
    c = np.empty((1, n_balls))
    s = np.empty((1, n_balls))
    d = np.zeros((1, n_balls))
    d_rate = np.zeros((1, n_balls))
    w = numbers[0]
    x = np.zeros(5)
    v = np.zeros(5)
    f = np.zeros(5)
    rates = np.empty((times.size, 4 * n))
    for i in range(times.size):
        angle = start_angle + w * times[i]
        lay_out_balls(angle, 0.0, 1, w, rows, tables, ball_c, ball_s, c, s, d, d_rate)
        rate_of_change(
            states[i], rates[i], n, c, s, d, d_rate, 0, w, bodies[0], active, bodies[1],
            bodies[2], bodies[3], bodies[4], numbers[1], numbers[2], numbers[3], numbers[4],
            numbers[5], numbers[6], numbers[7] > 0.0, x, v, f,
        )
    return rates
