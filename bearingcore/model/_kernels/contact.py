"""One contact: compression, direction and load.

The paper's A (Eq. 8) is an unsigned distance, so a ball that has sunk beyond the centre of the
other groove looks loaded. Here the part of the distance along the unloaded line of contact counts
only while it is positive. This changes nothing else, and makes the energy

    V(q) = Σ_j K/(n + 1) δ_j^(n+1) − F·q,   n = 3/2 for balls,

convex.
"""

from __future__ import annotations

import math

from bearingcore.model._kernels.compiling import inlined

# When the groove centres of a loaded ball have passed each other, nothing holds it across its line.
# Nearer to passing than this part of A0, rounding decides whether they have.
GUARD = 1e-12

POINT_CONTACT = 1.5
"""Exponent of a ball between grooves (Hertz)."""


@inlined
def contact_load(delta, factor, exponent):
    """Return energy [N·m], load [N] (Eq. 13) and stiffness [N/m] of a contact at δ ≥ 0."""
    if exponent == POINT_CONTACT:
        root = math.sqrt(delta)  # ten times as fast as a power
        load = factor * delta * root
        return 0.4 * load * delta, load, 1.5 * factor * root
    load = factor * delta**exponent
    energy = load * delta / (exponent + 1.0)
    return energy, load, exponent * load / delta if delta > 0.0 else 0.0


@inlined
def compression_under(load, factor, exponent):
    """Return the compression [m] of a contact that carries a load [N]: Eq. 13 solved for δ."""
    return (load / factor) ** (1.0 / exponent)


@inlined
def compression(m, w, A0):
    """Return the compression δ [m], its direction (eu, ew) and 1/A [1/m]; δ ≤ 0 is a gap.

    m and w are the ball's displacement along and across the unloaded line of contact, so that
    (A0 + m, w) is the vector between the groove centres (Eqs. 8-10); eu and ew are along and across
    that line too. If the centres have passed each other, only w counts: the contact does not
    swivel, and 0 stands for 1/A. A contact without centres (A0 = 0) has a fixed line: only m
    counts, and it does not swivel either.
    """
    p = A0 + m
    if p > 0.0:
        rise = m * (2.0 * A0 + m) + w * w  # A² − A0² without its cancellation
        if rise <= 0.0:
            return 0.0, 1.0, 0.0, 0.0
        if A0 == 0.0:
            return m, 1.0, 0.0, 0.0
        A = math.sqrt(p * p + w * w)  # Equation (7): δ = A − A0
        inverse_A = 1.0 / A
        return rise / (A + A0), p * inverse_A, w * inverse_A, inverse_A if p > GUARD * A0 else 0.0
    if A0 == 0.0:
        return 0.0, 1.0, 0.0, 0.0
    return max(abs(w) - A0, 0.0), 0.0, 1.0 if w > 0.0 else -1.0, 0.0


@inlined
def ring_at_ball(x, cj, sj, j, contacts):
    """Return radial and axial displacement [m] of a groove centre at contact j (Eqs. 11, 12).

    x is a tuple of five displacements, or of five velocities from `seen_from_the_cage`.
    """
    arm = contacts.arm[j]
    r = (x[0] + arm * x[4]) * cj + (x[1] - arm * x[3]) * sj
    z = x[2] + contacts.reach[j] * (x[3] * sj - x[4] * cj)
    return r, z


@inlined
def race_touch(r, z, drop, A, j, contacts):
    """Return δ [m], direction (er, ez) = (cos α_j, sin α_j) (Eq. 14) and 1/A of a contact.

    (r, z) is the displacement that closes it; the drop opens it along the line of contact.
    """
    ca = contacts.line_r[j]
    sa = contacts.line_z[j]
    along = r * ca + z * sa - drop
    delta, eu, ew, inverse_A = compression(along, z * ca - r * sa, A)
    return delta, eu * ca - ew * sa, eu * sa + ew * ca, inverse_A


@inlined
def touch(x, cj, sj, drop, j, contacts):
    """Return `race_touch` of contact j at the displacement x, a tuple of five.

    cj, sj and drop are cosine, sine and drop of its ball.
    """
    r, z = ring_at_ball(x, cj, sj, j, contacts)
    r -= contacts.clearance[j]
    z += contacts.offset[j]
    return race_touch(r, z, drop, contacts.distance[j], j, contacts)


@inlined
def has_left(x, cj, sj, j, contacts):
    """Return True if the inner ring has left the outer ring at contact j, at any drop of the ball.

    With a fixed line of contact it has then moved along the races by more than `Contacts.room`;
    otherwise it has moved back by the whole distance of the groove centres, and no groove is left.
    """
    r, z = ring_at_ball(x, cj, sj, j, contacts)
    r -= contacts.clearance[j]
    z += contacts.offset[j]
    ca = contacts.line_r[j]
    sa = contacts.line_z[j]
    if contacts.fixed[j]:
        return abs(z * ca - r * sa) > contacts.room[j]
    return r * ca + z * sa <= -contacts.distance[j]


@inlined
def tilting(er, ez, j, contacts):
    """Return τ: the moment over r_d of a unit force along (er, ez) at contact j.

    The components of that force along q are (er c, er s, ez, τ s, −τ c).
    """
    return contacts.reach[j] * ez - contacts.arm[j] * er


@inlined
def carried(x, place, j, contacts):
    """Return the elastic load [N] (Eq. 13) of contact j at the displacement x, a tuple of five."""
    delta, _, _, _ = touch(x, place.c[j], place.s[j], place.d[j], j, contacts)
    if delta <= 0.0:
        return 0.0
    _, load, _ = contact_load(delta, contacts.factor[j], contacts.exponent[j])
    return load


@inlined
def seen_from_the_cage(x, v, cage_speed):
    """Return the velocity of a ring relative to axes that turn with the cage, as a tuple of five.

    cage_speed belongs to the row of the balls. x and v (5,) are displacement and velocity of the
    ring in axes that do not turn.
    """
    return (
        v[0] + cage_speed * x[1],
        v[1] - cage_speed * x[0],
        v[2],
        v[3] + cage_speed * x[4],
        v[4] - cage_speed * x[3],
    )


@inlined
def approach(u, cj, sj, d_rate, j, contacts):
    """Return the radial and axial rates [m/s] at which contact j is pushed together.

    u is a velocity from `seen_from_the_cage`; d_rate is the rate of the ball's drop.
    """
    r, z = ring_at_ball(u, cj, sj, j, contacts)
    return r - contacts.line_r[j] * d_rate, z - contacts.line_z[j] * d_rate


@inlined
def components(q):
    """Return an array of five as a tuple, which compiled code need not read again and again."""
    return q[0], q[1], q[2], q[3], q[4]
