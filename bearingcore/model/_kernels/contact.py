"""One contact: places of the centres, compression and load.

The paper's A (Eq. 8) is an unsigned distance, which mistakes a ball sunk beyond the other groove's
centre for a loaded one; here the part of the distance along the unloaded line of contact counts
only while it is positive, which changes nothing else and makes the energy

    V(q) = Σ_j K/(n + 1) δ_j^(n+1) − F·q,   n = 3/2 for balls,

convex.
"""

from __future__ import annotations

import math

from bearingcore.model._kernels.compiling import inlined

# Where the centres of a loaded ball have passed each other nothing holds it across its line; nearer
# than this part of A0 to passing, rounding decides whether they have.
GUARD = 1e-12

POINT_CONTACT = 1.5
"""Exponent of a ball between grooves (Hertz)."""


@inlined
def contact_load(delta, factor, exponent):
    """Energy [N·m], load [N] (Eq. 13) and stiffness [N/m] of a contact compressed by δ ≥ 0."""
    if exponent == POINT_CONTACT:
        root = math.sqrt(delta)  # a power takes ten times as long
        load = factor * delta * root
        return 0.4 * load * delta, load, 1.5 * factor * root
    load = factor * delta**exponent
    energy = load * delta / (exponent + 1.0)
    return energy, load, exponent * load / delta if delta > 0.0 else 0.0


@inlined
def compression_under(load, factor, exponent):
    """Compression [m] of a contact that carries a load [N]."""
    return (load / factor) ** (1.0 / exponent)


@inlined
def compression(m, w, A0):
    """Compression δ [m], its direction (eu, ew) along and across the line of contact, and 1/A.

    m and w are the ball's displacement along and across the unloaded line of contact, so that
    (A0 + m, w) is the vector between the groove centres (Eqs. 8-10). δ ≤ 0 is a gap. In place of
    1/A is 0 where the centres have passed each other: only what is across the line counts
    there, and the contact does not swivel. Nor does one without centres, whose A0 is 0: its
    line is fixed, and m is all that counts.
    """
    p = A0 + m
    if p > 0.0:
        rise = m * (2.0 * A0 + m) + w * w  # A² − A0² without its cancellation
        if rise <= 0.0:
            return 0.0, 1.0, 0.0, 0.0
        if A0 == 0.0:
            return m, 1.0, 0.0, 0.0
        A = math.sqrt(p * p + w * w)
        bend = 1.0 / A
        return rise / (A + A0), p * bend, w * bend, bend if p > GUARD * A0 else 0.0  # Equation (7)
    if A0 == 0.0:
        return 0.0, 1.0, 0.0, 0.0
    return max(abs(w) - A0, 0.0), 0.0, 1.0 if w > 0.0 else -1.0, 0.0


@inlined
def ring_at_ball(x, cj, sj, j, contacts):
    """Radial and axial displacement [m] of a ring's groove centre at contact j (Eqs. 11, 12).

    x is a tuple of five; also velocities, as `seen_from_the_cage` gives them.
    """
    arm = contacts.arm[j]
    r = (x[0] + arm * x[4]) * cj + (x[1] - arm * x[3]) * sj
    z = x[2] + contacts.reach[j] * (x[3] * sj - x[4] * cj)
    return r, z


@inlined
def race_touch(r, z, drop, A, j, contacts):
    """δ [m], direction (er, ez) = (cos α_j, sin α_j) (Eq. 14) and 1/A of a contact.

    (r, z) is the displacement that closes it; the drop is taken along the line of contact.
    """
    ca = contacts.line_r[j]
    sa = contacts.line_z[j]
    along = r * ca + z * sa - drop
    delta, eu, ew, bend = compression(along, z * ca - r * sa, A)
    return delta, eu * ca - ew * sa, eu * sa + ew * ca, bend


@inlined
def touch(x, cj, sj, drop, j, contacts):
    """`race_touch` of contact j at the displacement x, a tuple of five; cj, sj, drop: its ball."""
    r, z = ring_at_ball(x, cj, sj, j, contacts)
    r -= contacts.clearance[j]
    z += contacts.offset[j]
    return race_touch(r, z, drop, contacts.distance[j], j, contacts)


@inlined
def has_left(x, cj, sj, j, contacts):
    """Return True if the inner ring has left the outer one at contact j, at any drop of the ball.

    Across a fixed line of contact it has moved along the races by more than `Contacts.room`; else
    it has moved back by all of the distance of the groove centres, where no groove is any more.
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
    """Moment of a force of one unit along (er, ez), over r_d: it acts as (c, s) times it.

    Along q it is (er c, er s, ez, τ s, −τ c), τ this number.
    """
    return contacts.reach[j] * ez - contacts.arm[j] * er


@inlined
def carried(x, place, j, contacts):
    """Elastic load [N] of contact j at the displacement x, a tuple of five, and its direction."""
    delta, er, ez, _ = touch(x, place.c[j], place.s[j], place.d[j], j, contacts)
    if delta <= 0.0:
        return 0.0, er, ez
    _, load, _ = contact_load(delta, contacts.factor[j], contacts.exponent[j])
    return load, er, ez


@inlined
def seen_from_the_cage(x, v, cage_speed):
    """Velocity of the inner ring against balls at rest: their turning moved to the ring.

    cage_speed is that of the balls' row. x and v (5,) are displacement and velocity against the
    outer ring; a tuple of five.
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
    """Rates [m/s], radial and axial, at which contact j is pushed together.

    u is what `seen_from_the_cage` gives; d_rate is the rate of the ball's drop.
    """
    r, z = ring_at_ball(u, cj, sj, j, contacts)
    return r - contacts.line_r[j] * d_rate, z - contacts.line_z[j] * d_rate


@inlined
def components(q):
    """An array of five as a tuple, which need not be read again after others were written."""
    return q[0], q[1], q[2], q[3], q[4]
