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

`fastmath` stays off: NaN is how a missing answer is told.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

compiled = njit(cache=True, nogil=True)

# Columns of the rows that describe defects to `ball_path` (see Defect.path_row):
PATH_COLUMNS = (
    "center",
    "turn_ratio",
    "half_extent",
    "depth",
    "angle_from_edge_to_floor",
    "edge",
    "raceway_radius",
    "ball_radius",
)
PUBLISHED, CHORD, EXACT, INNER_EXACT = 0, 1, 2, 3

# What became of a cage angle; the sentences are in equilibrium.py:
CONVERGED, NOTHING_TOUCHES, FREE_DIRECTION, NOT_CARRIED, NOT_CONVERGED = 0, 1, 2, 3, 4

# A residual |∂V/∂q| below this part of |F| ends the iteration; one that rounding keeps above it is
# still taken below the second. The third is the least pivot, relative to the greatest stiffness,
# that counts as a stiffness and not as a direction without one.
RESIDUAL_AIM, RESIDUAL_LIMIT, LEAST_PIVOT = 1e-12, 1e-9, 1e-12
MOST_ITERATIONS = 200


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
    if edge == PUBLISHED or edge == CHORD:
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
def fall(angle, cage_angle, rows):
    """Drop [m] of a ball at `angle` and its derivative with the cage's turning [m/rad].

    Of several defects of one race the deepest counts; drops into both races add.
    """
    outer = 0.0
    outer_slope = 0.0
    inner = 0.0
    inner_slope = 0.0
    for i in range(rows.shape[0]):
        turn = rows[i, 1]
        x = angle - rows[i, 0] - turn * cage_angle
        x -= 2.0 * math.pi * math.floor(x / (2.0 * math.pi) + 0.5)
        if abs(x) > rows[i, 2]:
            continue
        drop, slope = drop_and_slope(
            x, rows[i, 2], rows[i, 3], rows[i, 4], rows[i, 5], rows[i, 6], rows[i, 7]
        )
        if turn == 0.0:
            if drop > outer:
                outer = drop
                outer_slope = slope
        elif drop > inner:
            inner = drop
            inner_slope = slope * (1.0 - turn)
    return outer + inner, outer_slope + inner_slope


@compiled
def ball_path(ball_angles, cage_angles, rows):
    """Drop [m] at every ball angle, with the cage at the angle of the same index; shapes (n,)."""
    drops = np.empty(ball_angles.size)
    for i in range(ball_angles.size):
        drops[i], _ = fall(ball_angles[i], cage_angles[i], rows)
    return drops


# ------------------------------------------------------------------------------------ contact


@compiled
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


@compiled
def energy_gradient_hessian(q, F, c, s, d, ca, sa, A0, rL, K, g, H):
    """V(q) [N·m], its gradient g (5,) [N] and its Hessian H (5, 5) [N/m]; returns V and a scale.

    The scale is the sum of the sizes of V's terms: rounding of V is a small part of it.
    """
    energy = 0.0
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
        k2 = Q / A if A0 + m > 0.0 else 0.0
        er = eu * ca - ew * sa  # Equation (14): er = cos α_j, ez = sin α_j
        ez = eu * sa + ew * ca
        energy += 0.4 * Q * delta
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
    return energy - work, energy + abs(work)


# ------------------------------------------------------------------------------------ statics


@compiled
def newton_direction(H, g, active, shift, L, p):
    """p = −(H + shift·1)⁻¹ g over the active directions, by Cholesky's method.

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
def minimise_energy(q, F, c, s, d, active, ca, sa, A0, rL, K, G, H, L, p, trial):
    """Move q to the minimum of V over the active directions; Newton's method with a line search.

    G (2, 5) and H (2, 5, 5) are work space. Returns (which, status, residual, iterations,
    evaluations): G[which] and H[which] belong to the final q.
    """
    size = 0.0
    for i in active:
        size += F[i] * F[i]
    size = math.sqrt(size)
    if size == 0.0:
        return 0, NOTHING_TOUCHES, math.nan, 0, 0
    k_typical = 1.5 * (K * K * size) ** (1.0 / 3.0)  # of one ball under all of the load
    shift_part = 1e-3
    now = 0
    V, scale = energy_gradient_hessian(q, F, c, s, d, ca, sa, A0, rL, K, G[0], H[0])
    evaluations = 1
    residual = math.inf
    for iteration in range(MOST_ITERATIONS):
        g = G[now]
        norm = 0.0
        for i in active:
            norm += g[i] * g[i]
        before = residual
        residual = math.sqrt(norm) / size
        least = newton_direction(H[now], g, active, 0.0, L, p)
        settled = residual <= RESIDUAL_LIMIT and residual >= 0.5 * before
        if residual <= RESIDUAL_AIM or settled:
            status = CONVERGED if least > LEAST_PIVOT else FREE_DIRECTION
            return now, status, residual, iteration, evaluations
        if not least > LEAST_PIVOT:
            # too few balls touch: a small spring to ground stands in for the missing stiffness
            stiffest = k_typical
            for i in active:
                stiffest = max(stiffest, H[now, i, i])
            newton_direction(H[now], g, active, shift_part * stiffest, L, p)
            shift_part = max(0.1 * shift_part, 1e-10)
        slope = 0.0
        for i in active:
            slope += g[i] * p[i]
        step = 1.0
        found = False
        for _ in range(60):
            for i in active:
                trial[i] = q[i] + step * p[i]
            V1, scale1 = energy_gradient_hessian(
                trial, F, c, s, d, ca, sa, A0, rL, K, G[1 - now], H[1 - now]
            )
            evaluations += 1
            slope1 = 0.0
            for i in active:
                slope1 += G[1 - now, i] * p[i]
            # V must fall; where its fall drowns in rounding its slope must
            if V1 <= V + 1e-4 * step * slope or (
                abs(slope1) <= 0.9 * abs(slope) and V1 - V <= 1e-14 * max(scale, scale1)
            ):
                found = True
                break
            secant = slope / (slope - slope1) if slope1 > 0.0 else 0.5
            step *= min(max(secant, 0.05), 0.6)
        if not found:
            status = NOT_CONVERGED
            if residual <= RESIDUAL_LIMIT:
                status = CONVERGED if least > LEAST_PIVOT else FREE_DIRECTION
            return now, status, residual, iteration, evaluations
        for i in active:
            q[i] = trial[i]
        V = V1
        scale = scale1
        now = 1 - now
    return now, NOT_CONVERGED, residual, MOST_ITERATIONS, evaluations


@compiled
def static_states(cage_angles, rows, F, active, n_balls, ca, sa, A0, rL, K):
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
    ball_c = np.cos(2.0 * math.pi / n_balls * np.arange(n_balls))
    ball_s = np.sin(2.0 * math.pi / n_balls * np.arange(n_balls))
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
    if size > 0.0:
        # first guess: the clearance and one ball's compression, along the load
        reach = rL / ca + (size / K) ** (2.0 / 3.0)
        for i in active:
            state[i] = reach * F[i] / size
    for k in range(n):
        cage = cage_angles[k]
        cage_c = math.cos(cage)
        cage_s = math.sin(cage)
        for j in range(n_balls):
            c[j] = cage_c * ball_c[j] - cage_s * ball_s[j]
            s[j] = cage_s * ball_c[j] + cage_c * ball_s[j]
        if rows.shape[0] > 0:
            for j in range(n_balls):
                d[j], _ = fall(cage + 2.0 * math.pi / n_balls * j, cage, rows)
        if k >= 3:
            # the parabola through the last three answers
            x1 = cage - cage_angles[k - 1]
            x2 = cage - cage_angles[k - 2]
            x3 = cage - cage_angles[k - 3]
            u1 = x2 * x3 / ((x2 - x1) * (x3 - x1))
            u2 = x1 * x3 / ((x1 - x2) * (x3 - x2))
            u3 = x1 * x2 / ((x1 - x3) * (x2 - x3))
            for i in active:
                state[i] = u1 * q[k - 1, i] + u2 * q[k - 2, i] + u3 * q[k - 3, i]
        now, status[k], residuals[k], iterations[k], evaluations[k] = minimise_energy(
            state, F, c, s, d, active, ca, sa, A0, rL, K, G, H, L, p, trial
        )
        for i in range(5):
            q[k, i] = state[i]
            trial[i] = state[i]
            for l in range(i + 1):
                stiffness[k, i, l] = H[now, i, l]
                stiffness[k, l, i] = H[now, i, l]
        for j in range(n_balls):
            r = state[0] * c[j] + state[1] * s[j] - rL
            z = state[2] + state[3] * s[j] - state[4] * c[j]
            delta, _, _, _ = compression(r * ca + z * sa - d[j], z * ca - r * sa, A0)
            if delta > 0.0:
                loads[k, j] = K * delta * math.sqrt(delta)
                loaded[k] += 1
    return q, loads, stiffness, loaded, status, residuals, iterations, evaluations


@compiled
def contact_angles(cage_angles, rows, q, n_balls, ca, sa, A0, rL):
    """Loaded contact angle α_j (n, n_balls) [rad] (Eq. 14) at states q; NaN where a ball has a gap."""
    angles = np.full((cage_angles.size, n_balls), math.nan)
    for k in range(cage_angles.size):
        for j in range(n_balls):
            phi = cage_angles[k] + 2.0 * math.pi / n_balls * j
            d, _ = fall(phi, cage_angles[k], rows)
            c = math.cos(phi)
            s = math.sin(phi)
            r = q[k, 0] * c + q[k, 1] * s - rL
            z = q[k, 2] + q[k, 3] * s - q[k, 4] * c
            delta, eu, ew, _ = compression(r * ca + z * sa - d, z * ca - r * sa, A0)
            if delta > 0.0:
                angles[k, j] = math.atan2(eu * sa + ew * ca, eu * ca - ew * sa)
    return angles
