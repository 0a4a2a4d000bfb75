"""The sums over contacts of a motion in x and y at zero contact angle: see `motion`."""

from __future__ import annotations

from bearingcore.kernels.compiling import inlined
from bearingcore.kernels.contact import contact_load


@inlined
def planar_push(passage, at, rotor, contacts, work):
    """Σ δ e into work.S and p = Σ (Q e − c δ ė) into work.f at work.x, two components each."""
    x0 = work.x[0]
    x1 = work.x[1]
    clearance = contacts.clearance
    factor = contacts.factor
    exponent = contacts.exponent
    f0 = 0.0
    f1 = 0.0
    S0 = 0.0
    S1 = 0.0
    for j in range(clearance.size):
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        delta = x0 * cj + x1 * sj - clearance[j] - passage.d[at, j]  # Equation (19)
        if delta > 0.0:
            _, Q, _ = contact_load(delta, factor[j], exponent[j])
            f0 += Q * cj
            f1 += Q * sj
            S0 += delta * cj
            S1 += delta * sj
    turning = rotor.contact_damping * rotor.cage_speed
    work.S[0] = S0
    work.S[1] = S1
    work.f[0] = f0 + turning * S1
    work.f[1] = f1 - turning * S0


@inlined
def planar_forces(passage, at, rotor, contacts, work):
    """Σ (Q + c δ̇) e into work.f at work.x and work.v (Eq. 18)."""
    x0 = work.x[0]
    x1 = work.x[1]
    u0 = work.v[0] + rotor.cage_speed * x1  # the turning of the balls, moved over to the rings
    u1 = work.v[1] - rotor.cage_speed * x0
    clearance = contacts.clearance
    factor = contacts.factor
    exponent = contacts.exponent
    damping = rotor.contact_damping
    f0 = 0.0
    f1 = 0.0
    for j in range(clearance.size):
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        delta = x0 * cj + x1 * sj - clearance[j] - passage.d[at, j]
        if delta > 0.0:
            _, Q, _ = contact_load(delta, factor[j], exponent[j])
            push = Q + damping * (u0 * cj + u1 * sj - passage.d_rate[at, j])
            f0 += push * cj
            f1 += push * sj
    work.f[0] = f0
    work.f[1] = f1


@inlined
def planar_slopes(passage, at, rotor, contacts, work, slopes):
    """How Σ δ e and p change with x, into slopes.Sx and slopes.Px."""
    x0 = work.x[0]
    x1 = work.x[1]
    clearance = contacts.clearance
    factor = contacts.factor
    exponent = contacts.exponent
    G00 = 0.0
    G01 = 0.0
    G11 = 0.0
    N00 = 0.0
    N01 = 0.0
    N11 = 0.0
    for j in range(clearance.size):
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        delta = x0 * cj + x1 * sj - clearance[j] - passage.d[at, j]
        if delta > 0.0:
            _, _, k1 = contact_load(delta, factor[j], exponent[j])
            G00 += k1 * cj * cj
            G01 += k1 * cj * sj
            G11 += k1 * sj * sj
            N00 += cj * cj
            N01 += cj * sj
            N11 += sj * sj
    turning = rotor.contact_damping * rotor.cage_speed
    Sx = slopes.Sx
    Px = slopes.Px
    Sx[0, 0], Sx[0, 1], Sx[1, 0], Sx[1, 1] = N00, N01, N01, N11
    Px[0, 0] = G00 + turning * N01
    Px[0, 1] = G01 + turning * N11
    Px[1, 0] = G01 - turning * N00
    Px[1, 1] = G11 - turning * N01
