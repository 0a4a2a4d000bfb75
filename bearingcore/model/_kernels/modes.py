"""Natural frequencies of two bodies at many cage angles at once (Eqs. 24-25, without damping).

NumPy's `eigh` takes one matrix after the other, and its preparations for a matrix of 10 × 10 cost
more than the arithmetic. Here the last axis of every array is the cage angle, so that the same
instructions rotate many matrices by Jacobi's method. It starts from the modes of a template, the
mean stiffness, which are near those of each angle. Its answers are as exact as those of `eigh`,
because matrices are only rotated.
"""

from __future__ import annotations

import math

import numpy as np

from bearingcore.model._kernels.compiling import called, compiled

# Number of matrices that are rotated together: enough to fill the processor's vector registers, few
# enough to stay in its nearest cache.
TOGETHER = 32
# Off-diagonal numbers below this part of the greater diagonal number are rounding. At the end each
# sweep of Jacobi's method doubles the digits; half of the allowed sweeps have always sufficed.
NEGLIGIBLE, MOST_SWEEPS = 1e-15, 30
DOUBTFUL = -1
# Avoids 0/0 if a rotation has nothing to do.
TINY = 1e-300


def modes_like(terms, mixing, offset, squared, order, likeness):
    """Fill in squared angular frequencies [rad²/s²] at n cage angles, and match them to a template.

    Quantity                                 | Name     | Shape
    ---------------------------------------- | -------- | -------------------
    K_b, its upper triangle row by row       | terms    | (nd (nd + 1)/2, n)
    template's modes, inner less outer       | mixing   | (m, nd)
    support's stiffness in these modes       | offset   | (m, m)
    (2π f)², in no order                     | squared  | (n, m), filled
    number of the mode most like each mode   | order    | (n, m), filled
    of the template                          |          |
    likeness of all pairs, filled only where | likeness | (n, m, m)
    order[k, 0] is DOUBTFUL: two modes of    |          |
    the template would get the same mode     |          |

    With modes t = (inner, outer) of unit modal mass, t' [K_b, −K_b; −K_b, K_b + K_o] t (Eq. 25) is
    (inner − outer)' K_b (inner − outer) + outer' K_o outer. NaN in gives NaN out.
    """
    m, nd = mixing.shape
    work = (
        np.empty((m, m, TOGETHER)),
        np.empty((m, m, TOGETHER)),
        np.empty((nd, nd, TOGETHER)),
        np.empty((nd, TOGETHER)),
        np.empty((3, TOGETHER)),
        np.empty(TOGETHER, dtype=np.int64),
    )
    find_modes(terms, mixing, offset, squared, order, likeness, work)


@compiled
def find_modes(terms, mixing, offset, squared, order, likeness, work):
    """Compiled body of `modes_like`, with work space."""
    m, nd = mixing.shape
    n = terms.shape[1]
    A, V, B, half, numbers, nearest = work
    cosine = numbers[0]
    sine = numbers[1]
    most = numbers[2]
    for begin in range(0, n, TOGETHER):
        live = min(TOGETHER, n - begin)
        term = 0
        for i in range(nd):
            for j in range(i, nd):
                for k in range(TOGETHER):
                    # unused places of the last batch repeat the last angle
                    value = terms[term, begin + min(k, live - 1)]
                    B[i, j, k] = value
                    B[j, i, k] = value
                term += 1
        # B: symmetric K_b of each angle; A: the same with the support, in the template's modes
        transform_to_modes(B, mixing, offset, half, A)
        for i in range(m):
            for j in range(m):
                for k in range(TOGETHER):
                    V[i, j, k] = 1.0 if i == j else 0.0
        diagonalise(A, V, cosine, sine)
        for i in range(m):
            # Modal assurance criterion: V[j, i]² is the likeness of mode j and the template's i.
            for k in range(TOGETHER):
                nearest[k] = 0
                most[k] = V[0, i, k] ** 2
            for j in range(1, m):
                for k in range(TOGETHER):
                    like = V[j, i, k] ** 2
                    nearest[k] = j if like > most[k] else nearest[k]
                    most[k] = max(like, most[k])
            for k in range(live):
                order[begin + k, i] = nearest[k]
        # the diagonal of A now holds the squared frequencies
        for k in range(live):
            doubtful = False
            for i in range(m):
                squared[begin + k, i] = A[i, i, k]
                for j in range(i):
                    if order[begin + k, i] == order[begin + k, j]:
                        doubtful = True
            if doubtful:
                order[begin + k, 0] = DOUBTFUL
                for i in range(m):
                    for j in range(m):
                        likeness[begin + k, i, j] = V[j, i, k] ** 2


@called
def transform_to_modes(B, mixing, offset, half, A):
    """Compute the upper triangle of A = mixing B mixing' + offset (Eq. 25 in template modes)."""
    m, nd = mixing.shape
    for i in range(m):
        for b in range(nd):
            for k in range(TOGETHER):
                half[b, k] = 0.0
            for a in range(nd):
                factor = mixing[i, a]
                for k in range(TOGETHER):
                    half[b, k] += factor * B[a, b, k]
        for j in range(i, m):
            for k in range(TOGETHER):
                A[i, j, k] = offset[i, j]
            for b in range(nd):
                factor = mixing[j, b]
                for k in range(TOGETHER):
                    A[i, j, k] += factor * half[b, k]


@called
def diagonalise(A, V, cosine, sine):
    """Apply Jacobi's rotations to upper triangles A (m, m, .) and to rows V until A is diagonal."""
    m = len(A)
    for _ in range(MOST_SWEEPS):
        rotated = False
        for p in range(m - 1):
            for q in range(p + 1, m):
                needed = False
                for k in range(TOGETHER):
                    scale = max(abs(A[p, p, k]), abs(A[q, q, k]))
                    if abs(A[p, q, k]) > NEGLIGIBLE * scale:
                        needed = True
                if needed:
                    rotated = True
                    turn(A, V, p, q, cosine, sine)
        if not rotated:
            break


@called
def turn(A, V, p, q, cosine, sine):
    """Rotate A and V so that A[p, q] becomes zero, by the smaller of two angles (Rutishauser)."""
    m = len(A)
    # tangent of the angle: t² + t (A_qq − A_pp)/A_pq = 1, the smaller root without cancellation
    for k in range(TOGETHER):
        difference = A[q, q, k] - A[p, p, k]
        twice = 2.0 * A[p, q, k]
        size = abs(difference) + math.sqrt(difference * difference + twice * twice) + TINY
        tangent = twice / math.copysign(size, difference)
        c = 1.0 / math.sqrt(1.0 + tangent * tangent)
        cosine[k] = c
        sine[k] = tangent * c
        A[p, p, k] -= 0.5 * tangent * twice
        A[q, q, k] += 0.5 * tangent * twice
        A[p, q, k] = 0.0
    # rows and columns p and q, of which only the upper triangle is kept; then the modes
    for r in range(p):
        for k in range(TOGETHER):
            x, y = A[r, p, k], A[r, q, k]
            A[r, p, k] = cosine[k] * x - sine[k] * y
            A[r, q, k] = sine[k] * x + cosine[k] * y
    for r in range(p + 1, q):
        for k in range(TOGETHER):
            x, y = A[p, r, k], A[r, q, k]
            A[p, r, k] = cosine[k] * x - sine[k] * y
            A[r, q, k] = sine[k] * x + cosine[k] * y
    for r in range(q + 1, m):
        for k in range(TOGETHER):
            x, y = A[p, r, k], A[q, r, k]
            A[p, r, k] = cosine[k] * x - sine[k] * y
            A[q, r, k] = sine[k] * x + cosine[k] * y
    for r in range(m):
        for k in range(TOGETHER):
            x, y = V[p, r, k], V[q, r, k]
            V[p, r, k] = cosine[k] * x - sine[k] * y
            V[q, r, k] = sine[k] * x + cosine[k] * y
