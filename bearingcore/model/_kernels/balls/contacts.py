"""The two contacts of each ball: their compression and load, in the symbols of `motion`.

`instant` is the index of an instant in a passage. `passage` has the drops into defects of the outer
race, `inner` those of the inner race.
"""

from __future__ import annotations

from bearingcore.model._kernels.balls.structs import INNER, OUTER
from bearingcore.model._kernels.compiling import inlined
from bearingcore.model._kernels.contact import (
    contact_load,
    race_touch,
    ring_at_ball,
    seen_from_the_cage,
    tilting,
)


@inlined
def row_components(q, row):
    """Return a row of five numbers as a tuple."""
    return q[row, 0], q[row, 1], q[row, 2], q[row, 3], q[row, 4]


@inlined
def ring_state(y, rotor, x):
    """Write the displacements of both rings in the state y into x (2, 5)."""
    n = rotor.active.size
    for a in range(n):
        x[INNER, rotor.active[a]] = y[a]
        x[OUTER, rotor.active[a]] = y[2 * n + a]


@inlined
def find_contacts(y, first, passage, inner, instant, system, work):
    """Write δ, e and 1/A of all contacts into work.contact, and Σ c δ e into work.S.

    y[first:] are the positions of the balls. A released contact counts as open.
    """
    contacts = system.contacts
    races = system.races
    n_balls = contacts.angle.size
    xi = row_components(work.x, INNER)
    xo = row_components(work.x, OUTER)
    S = work.S
    S[:, :] = 0.0
    for j in range(n_balls):
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        br = y[first + j]
        bz = y[first + n_balls + j]
        for race in range(2):
            if race == INNER:
                r, z = ring_at_ball(xi, cj, sj, j, contacts)
                r -= br + contacts.clearance[j]
                z += contacts.offset[j] - bz
                drop = inner.d[instant, j]
            else:
                r, z = ring_at_ball(xo, cj, sj, j, contacts)
                r = br - r
                z = bz - z
                drop = passage.d[instant, j]
            # δ_i or δ_e and its direction, see `motion`
            delta, er, ez, inverse_A = race_touch(r, z, drop, races.distance[race, j], j, contacts)
            if delta <= 0.0 or work.released[race, j]:
                work.contact[race, j, 0] = 0.0
                continue
            work.contact[race, j, 0] = delta
            work.contact[race, j, 1] = er
            work.contact[race, j, 2] = ez
            work.contact[race, j, 3] = inverse_A
            damped = races.damping[race, j] * delta
            et = damped * tilting(er, ez, j, contacts)
            S[race, 0] += damped * er * cj
            S[race, 1] += damped * er * sj
            S[race, 2] += damped * ez
            S[race, 3] += et * sj
            S[race, 4] -= et * cj


@inlined
def push_contacts(k, first, passage, inner, instant, system, work, smooth):
    """Write the forces of all contacts to work.f and, with F_c and G, those on balls to work.ball.

    They are Q e + c δ̇ e (Eq. 18) or, if `smooth`, Q e − c δ ė. Velocities are work.v of the rings
    and k[first:] of the balls.
    """
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    n_balls = contacts.angle.size
    xi = row_components(work.x, INNER)
    vi = row_components(work.v, INNER)
    xo = row_components(work.x, OUTER)
    vo = row_components(work.v, OUTER)
    relative_speed = 1.0
    w = rotor.cage_speed
    ui = seen_from_the_cage(xi, vi, w)
    uo = seen_from_the_cage(xo, vo, w)
    f = work.f
    f[:, :] = 0.0
    for j in range(n_balls):
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        work.ball[0, j] = races.centrifugal[j] - races.weight[j] * sj
        work.ball[1, j] = 0.0
        if contacts.relative_speed[j] != relative_speed:  # another row
            relative_speed = contacts.relative_speed[j]
            w = relative_speed * rotor.cage_speed
            ui = seen_from_the_cage(xi, vi, w)
            uo = seen_from_the_cage(xo, vo, w)
        for race in range(2):
            delta = work.contact[race, j, 0]
            if delta <= 0.0:
                continue
            er = work.contact[race, j, 1]
            ez = work.contact[race, j, 2]
            if race == INNER:
                r, z = ring_at_ball(ui, cj, sj, j, contacts)
                r -= k[first + j]
                z -= k[first + n_balls + j]
                d_rate = inner.d_rate[instant, j]
            else:
                r, z = ring_at_ball(uo, cj, sj, j, contacts)
                r = k[first + j] - r
                z = k[first + n_balls + j] - z
                d_rate = passage.d_rate[instant, j]
            r -= contacts.line_r[j] * d_rate
            z -= contacts.line_z[j] * d_rate
            _, Q, _ = contact_load(delta, races.factor[race, j], contacts.exponent[j])
            damping = races.damping[race, j]
            turn_r = 0.0
            turn_t = 0.0
            if smooth:
                # −c δ ė: e swivels in the plane of the ball, and turns with the cage
                swivel = damping * delta * (er * z - ez * r) * work.contact[race, j, 3]
                along_r = Q * er + swivel * ez
                along_z = Q * ez - swivel * er
                turn_r = damping * delta * w * er
                turn_t = damping * delta * w * tilting(er, ez, j, contacts)
            else:
                push = Q + damping * (er * r + ez * z)  # Q + c δ̇
                if push <= 0.0 and not rotor.tension:
                    work.contact[race, j, 0] = -delta  # would pull
                    continue
                along_r = push * er
                along_z = push * ez
            along_t = tilting(along_r, along_z, j, contacts)
            f[race, 0] += along_r * cj + turn_r * sj
            f[race, 1] += along_r * sj - turn_r * cj
            f[race, 2] += along_z
            f[race, 3] += along_t * sj - turn_t * cj
            f[race, 4] -= along_t * cj + turn_t * sj
            sign = 1.0 if race == INNER else -1.0
            work.ball[0, j] += sign * along_r
            work.ball[1, j] += sign * along_z


@inlined
def planar_contacts(y, first, passage, inner, instant, system, work):
    """Do `find_contacts` and the smooth forces in one pass, for contacts that stay in the plane.

    There e = ±(c, s), and ė = ω_c (−s, c) for the rings and 0 for the balls: no velocity is needed.
    """
    contacts = system.contacts
    races = system.races
    clearance = contacts.clearance
    exponent = contacts.exponent
    factor = races.factor
    damping = races.damping
    released = work.released
    i0 = work.x[INNER, 0]
    i1 = work.x[INNER, 1]
    o0 = work.x[OUTER, 0]
    o1 = work.x[OUTER, 1]
    fi0 = 0.0
    fi1 = 0.0
    fo0 = 0.0
    fo1 = 0.0
    Si0 = 0.0
    Si1 = 0.0
    So0 = 0.0
    So1 = 0.0
    for j in range(clearance.size):
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        u = y[first + j]
        force = races.centrifugal[j] - races.weight[j] * sj
        closing = i0 * cj + i1 * sj - u - clearance[j] - inner.d[instant, j]  # δ_i
        if closing > 0.0 and not released[INNER, j]:
            _, Q, _ = contact_load(closing, factor[INNER, j], exponent[j])
            work.contact[INNER, j, 0] = closing
            damped = damping[INNER, j] * closing
            fi0 += Q * cj
            fi1 += Q * sj
            Si0 += damped * cj
            Si1 += damped * sj
            force += Q
        else:
            work.contact[INNER, j, 0] = 0.0
        closing = u - (o0 * cj + o1 * sj) - passage.d[instant, j]  # δ_e
        if closing > 0.0 and not released[OUTER, j]:
            _, Q, _ = contact_load(closing, factor[OUTER, j], exponent[j])
            work.contact[OUTER, j, 0] = closing
            damped = damping[OUTER, j] * closing
            fo0 += Q * cj
            fo1 += Q * sj
            So0 += damped * cj
            So1 += damped * sj
            force -= Q
        else:
            work.contact[OUTER, j, 0] = 0.0
        work.ball[0, j] = force
    w = system.rotor.cage_speed
    work.S[INNER, 0] = Si0
    work.S[INNER, 1] = Si1
    work.S[OUTER, 0] = So0
    work.S[OUTER, 1] = So1
    work.f[INNER, 0] = fi0 + w * Si1
    work.f[INNER, 1] = fi1 - w * Si0
    work.f[OUTER, 0] = fo0 + w * So1
    work.f[OUTER, 1] = fo1 - w * So0


@inlined
def planar_push(k, first, passage, inner, instant, system, work):
    """Do `push_contacts` without `smooth` for contacts that stay in the plane: Q e + c δ̇ e."""
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    w = rotor.cage_speed
    vi0 = work.v[INNER, 0] + w * work.x[INNER, 1]
    vi1 = work.v[INNER, 1] - w * work.x[INNER, 0]
    vo0 = work.v[OUTER, 0] + w * work.x[OUTER, 1]
    vo1 = work.v[OUTER, 1] - w * work.x[OUTER, 0]
    f = work.f
    f[:, :] = 0.0
    for j in range(contacts.angle.size):
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        for race in range(2):
            delta = work.contact[race, j, 0]
            if delta <= 0.0:
                continue
            if race == INNER:
                rate = vi0 * cj + vi1 * sj - k[first + j] - inner.d_rate[instant, j]
            else:
                rate = k[first + j] - vo0 * cj - vo1 * sj - passage.d_rate[instant, j]
            _, Q, _ = contact_load(delta, races.factor[race, j], contacts.exponent[j])
            push = Q + races.damping[race, j] * rate  # Equation (18)
            if push <= 0.0 and not rotor.tension:
                work.contact[race, j, 0] = -delta  # would pull
                continue
            f[race, 0] += push * cj
            f[race, 1] += push * sj
