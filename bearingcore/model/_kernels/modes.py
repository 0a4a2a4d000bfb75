"""Natural frequencies of two bodies at many cage angles at once (Eqs. 24-25, without damping).

numpy's `eigh` takes one matrix after the other, and for matrices of 10 × 10 what it does around
each costs more than the arithmetic. Here the last axis of every array is the cage angle, so that
each rotation of Jacobi's method is done for many of them by the same instructions. The method
starts from the modes of the mean stiffness, which those of each angle are near, and its answers
are as exact as `eigh`'s: nothing but rotations is done to the matrices.
"""

from __future__ import annotations

import math

import numpy as np

from bearingcore.model._kernels.compiling import called, compiled

# Matrices that are turned together: enough to fill the processor's vectors, few enough that all
# stay in its nearest cache.
TOGETHER = 32
# Off the diagonal nothing is left that is more than this part of the greatest on it: what rounding
# leaves. Jacobi's method then doubles the digits with each sweep; it never needs half as many.
NEGLIGIBLE, MOST_SWEEPS = 1e-15, 30
DOUBTFUL = -1
# Keeps 0/0 away where nothing is to be turned.
TINY = 1e-300


def modes_like(terms, mixing, offset, squared, order, likeness):
    """Squared angular frequencies [rad²/s²] at n cage angles, and which is like which template.

    Quantity                                 | Name     | Shape
    ---------------------------------------- | -------- | -------------------
    K_b, its upper triangle row by row       | terms    | (nd (nd + 1)/2, n)
    template's modes, inner less outer       | mixing   | (m, nd)
    support's stiffness in its modes         | offset   | (m, m)
    (2π f)², in no order                     | squared  | (n, m), filled
    the one that is like each template       | order    | (n, m), filled
    how like each is, where order[k, 0] says | likeness | (n, m, m), filled
    DOUBTFUL: two templates want the same    |          | there

    With modes t = (inner, outer) of unit modal mass, t' [K_b, −K_b; −K_b, K_b + K_o] t is
    (inner − outer)' K_b (inner − outer) + outer' K_o outer. NaN in, NaN out.
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
    """Body of `modes_like`, with work space."""
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
                    # places that are left over repeat the last angle
                    value = terms[term, begin + min(k, live - 1)]
                    B[i, j, k] = value
                    B[j, i, k] = value
                term += 1
        transform_to_modes(B, mixing, offset, half, A)
        for i in range(m):
            for j in range(m):
                for k in range(TOGETHER):
                    V[i, j, k] = 1.0 if i == j else 0.0
        diagonalise(A, V, cosine, sine)
        for i in range(m):
            # Modal assurance criterion: V[j, i]² is how like mode j is to the template's i.
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
    """A = mixing B mixing' + offset, upper triangle (Eq. 25 in the template's modes)."""
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
    """Jacobi's rotations of upper triangles A (m, m, .) and of rows V, until A is diagonal."""
    m = len(A)
    for _ in range(MOST_SWEEPS):
        left = False
        for p in range(m - 1):
            for q in range(p + 1, m):
                turned = False
                for k in range(TOGETHER):
                    scale = max(abs(A[p, p, k]), abs(A[q, q, k]))
                    if abs(A[p, q, k]) > NEGLIGIBLE * scale:
                        turned = True
                if turned:
                    left = True
                    turn(A, V, p, q, cosine, sine)
        if not left:
            break


@called
def turn(A, V, p, q, cosine, sine):
    """The rotation that makes A[p, q] zero; the smaller of the two angles (Rutishauser)."""
    m = len(A)
    for k in range(TOGETHER):
        apart = A[q, q, k] - A[p, p, k]
        twice = 2.0 * A[p, q, k]
        size = abs(apart) + math.sqrt(apart * apart + twice * twice) + TINY
        tangent = twice / math.copysign(size, apart)
        c = 1.0 / math.sqrt(1.0 + tangent * tangent)
        cosine[k] = c
        sine[k] = tangent * c
        A[p, p, k] -= 0.5 * tangent * twice
        A[q, q, k] += 0.5 * tangent * twice
        A[p, q, k] = 0.0
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
