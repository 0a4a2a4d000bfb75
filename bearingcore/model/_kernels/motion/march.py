"""Motion of both rings (Eqs. 18-23): the equations of motion, and steps of order 4.

The force of the published damper, c δ̇ e, jumps when a ball touches, and a step across the jump has
an error in proportion to its length. But c δ̇ e = d/dt(c δ e) − c δ ė while δ > 0. So with

    S = Σ δ_j e_j,    w_i = v_i + (c/m_i) S,    w_o = v_o − (c/m_o) S

the equations of motion (Eq. 18) have no jump left:

    ẋ_i = w_i − (c/m_i) S,    m_i ẇ_i = F − p,    p = Σ (Q_j e_j − c δ_j ė_j)

and likewise, with opposite signs and with the support, for the outer ring. The law is the same, and
only the marched variable has changed. The error of a motion is 10 to 100 times smaller than with
velocities at the same steps. A law without tension has no such S: there w = v, and p is the
force itself.

The direction e of a contact turns with the ball and swivels as the contact angle changes. If α0, z
and tilts are zero, it is e = (c, s) for all motions of the rings, δ = δx c + δy s − r_L − d
(Eq. 19) and ė = ω_c (−s, c), and neither δ̇ nor the slope of d is needed. `planar` has the faster
sums over contacts for this case; the steps are the same.

`instant` is the index of an instant in a passage.
"""

from __future__ import annotations

import numpy as np

from bearingcore.model._kernels.compiling import called, compiled, inlined
from bearingcore.model._kernels.contact import (
    approach,
    carried,
    components,
    contact_load,
    seen_from_the_cage,
    tilting,
    touch,
)
from bearingcore.model._kernels.in_parts import march_in_parts
from bearingcore.model._kernels.motion.planar import planar_equations_of_motion, planar_forces
from bearingcore.model._kernels.motion.rings import record, ring_accelerations
from bearingcore.model._kernels.motion.tangent import march_tangent, new_slopes
from bearingcore.model._kernels.path import BLOCK, lay_out_balls, lay_out_forces, new_passage
from bearingcore.model._kernels.runge_kutta import stepper, try_state
from bearingcore.model._kernels.structs import (
    PLANAR,
    SMOOTH,
    VELOCITIES,
    Forces,
    Place,
    Recorded,
    Steps,
)


@inlined
def find_touching(passage, instant, contacts, work):
    """List the contacts that are compressed at work.x, and write Σ δ e into work.S."""
    x = components(work.x)
    touching = work.touching
    contact = work.contact
    S0 = 0.0
    S1 = 0.0
    S2 = 0.0
    S3 = 0.0
    S4 = 0.0
    count = 0
    for j in range(contacts.angle.size):
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        delta, er, ez, inverse_A = touch(
            x, cj, sj, passage.d[instant, j], j, contacts
        )  # Equations (7)-(14)
        if delta <= 0.0:
            continue
        touching[count] = j
        contact[count, 0] = delta
        contact[count, 1] = er
        contact[count, 2] = ez
        contact[count, 3] = inverse_A
        count += 1
        et = delta * tilting(er, ez, j, contacts)
        er *= delta
        ez *= delta
        S0 += er * cj
        S1 += er * sj
        S2 += ez
        S3 += et * sj
        S4 -= et * cj
    S = work.S  # written at the end, as sums in registers are faster
    S[0], S[1], S[2], S[3], S[4] = S0, S1, S2, S3, S4
    work.touched[0] = count


@inlined
def push_of_contacts(passage, instant, rotor, contacts, work, smooth):
    """Write the force of all contacts on the outer ring [N], moments divided by r_d, into work.f.

    Every loaded ball pushes with K δ^n + c δ̇ (Eq. 18) along its contact. δ̇ is the full time
    derivative, due to velocities of the rings, turning of the ball and slope of the path. If
    `smooth`, the force is p = Σ (Q e − c δ ė) instead. Here e turns with the ball and with the
    contact angle, whose rate is (t·ṗ)/A; t is across the contact, ṗ the rate of (r, z).
    """
    damping = rotor.contact_damping
    tension = rotor.tension
    relative_speed = 1.0
    w = rotor.cage_speed
    u = seen_from_the_cage(work.x, work.v, w)
    contact = work.contact
    f0 = 0.0
    f1 = 0.0
    f2 = 0.0
    f3 = 0.0
    f4 = 0.0
    for i in range(work.touched[0]):
        j = work.touching[i]
        delta = contact[i, 0]
        er = contact[i, 1]
        ez = contact[i, 2]
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        if contacts.relative_speed[j] != relative_speed:  # another row
            relative_speed = contacts.relative_speed[j]
            w = relative_speed * rotor.cage_speed
            u = seen_from_the_cage(work.x, work.v, w)
        r_rate, z_rate = approach(u, cj, sj, passage.d_rate[instant, j], j, contacts)
        _, Q, _ = contact_load(delta, contacts.factor[j], contacts.exponent[j])
        if smooth:
            # Q e, and −c δ ė in two parts: the swivel acts along −t, the turning around the shaft
            damped = damping * delta
            swivel = damped * (er * z_rate - ez * r_rate) * contact[i, 3]
            turn_r = damped * w * er
            turn_t = damped * w * tilting(er, ez, j, contacts)
            along_r = Q * er + swivel * ez
            along_z = Q * ez - swivel * er
            along_t = tilting(along_r, along_z, j, contacts)
            f0 += along_r * cj + turn_r * sj
            f1 += along_r * sj - turn_r * cj
            f2 += along_z
            f3 += along_t * sj - turn_t * cj
            f4 -= along_t * cj + turn_t * sj
        else:
            push = Q + damping * (er * r_rate + ez * z_rate)  # Equation (18)
            if push <= 0.0 and not tension:
                continue
            push_t = push * tilting(er, ez, j, contacts)
            f0 += push * er * cj
            f1 += push * er * sj
            f2 += push * ez
            f3 += push_t * sj
            f4 -= push_t * cj
    f = work.f
    f[0], f[1], f[2], f[3], f[4] = f0, f1, f2, f3, f4


@inlined
def equations_of_motion(y, k, passage, instant, rotor, contacts, work):
    """Write dy/dt into k (4 n,); y is x and w of the inner, then of the outer ring (Eq. 18).

    Each of these has n directions. `work` keeps the contacts at y.
    """
    active = rotor.active
    n = active.size
    damping = rotor.contact_damping
    x = work.x
    v = work.v
    f = work.f
    S = work.S
    smooth = rotor.variables != VELOCITIES
    for a in range(n):
        x[active[a]] = y[a] - y[2 * n + a]
    find_touching(passage, instant, contacts, work)
    for a in range(n):
        jump = damping * S[active[a]] if smooth else 0.0
        k[a] = y[n + a] - rotor.inverse_inner[a] * jump
        k[2 * n + a] = y[3 * n + a] + rotor.inverse_outer[a] * jump
        v[active[a]] = k[a] - k[2 * n + a]
    push_of_contacts(passage, instant, rotor, contacts, work, smooth)
    for a in range(n):
        k[n + a], k[3 * n + a] = ring_accelerations(y, k, rotor, a, f, f, passage.push[instant])


@called
def lay_out(angle, turn, count, system, work):
    """Write balls and outer forces at `count` cage angles angle + i·turn [rad] into work."""
    rotor = system.rotor
    passage = work.passage
    lay_out_balls(angle, turn, count, rotor.cage_speed, system.contacts, system.path, passage)
    lay_out_forces(angle, turn, count, rotor, passage)


@inlined
def rates(y, part, before, k, instant, system, work):
    """Write the rate of y + part·before into k: motion (4 n,) first, its tangent behind it."""
    rotor = system.rotor
    contacts = system.contacts
    passage = work.passage
    with_tangent = y.size > 4 * rotor.active.size
    if with_tangent or rotor.variables != PLANAR:
        try_state(y, part, before, work.trial)
    if rotor.variables == PLANAR:
        planar_equations_of_motion(y, part, before, k, passage, instant, rotor, contacts)
    else:
        equations_of_motion(work.trial, k, passage, instant, rotor, contacts, work.forces)
    if with_tangent:
        march_tangent(k, instant, system, work)


@inlined
def changed(y, instant, system, work):
    """Return False: with massless balls a state is never changed between steps."""
    return False


@inlined
def keep(sample, y, instant, system, out, work):
    """Record the state y with the forces as published."""
    rotor = system.rotor
    forces = work.forces
    if rotor.variables == PLANAR:
        planar_forces(y, work.k[0], work.passage, instant, rotor, system.contacts, forces.f)
    elif rotor.variables == SMOOTH:
        push_of_contacts(work.passage, instant, rotor, system.contacts, forces, False)
    push = work.passage.push[instant]
    record(out.history, sample, y, work.k[0], rotor, forces.f, forces.f, push)


runge_kutta = stepper(lay_out, rates, changed, keep)


def new_steps(size, instants, system):
    """Return empty work space for steps of a state of `size` numbers."""
    angle = system.contacts.angle
    x, v, f, S = np.zeros((4, 5))
    touching, touched = np.empty(angle.size, dtype=np.int64), np.zeros(1, dtype=np.int64)
    return Steps(
        new_passage(instants, angle),
        Forces(x, v, f, S, touching, np.empty((angle.size, 4)), touched),
        new_slopes(4 * system.rotor.active.size, size),
        np.zeros((4, size)),
        np.zeros(size),
    )


def march(y, h, start_angle, system, history, watch=None):
    """March in steps of h [s] from y, which is moved to the end; the cage begins at start_angle.

    Behind the 4 n numbers of a state, y may hold the tangent (4 n, columns), row by row: the
    derivative of the end by the beginning. The tangent needs smooth variables. In them nothing
    jumps when balls touch, so its steps are the exact derivative of the steps of the motion.

    history (steps + 1, 6, n) takes displacement, velocity and acceleration of the inner ring, then
    of the outer ring, at every step. Returns the number of steps after which all was still finite;
    this is tested once in half a BLOCK. `watch`: see `march_in_parts`.
    """
    n_steps = history.shape[0] - 1
    work = new_steps(y.size, min(2 * n_steps, BLOCK) + 1, system)
    states, angles, histories = y[None], np.array([start_angle]), history[None]
    return march_in_parts(
        n_steps,
        y.size * system.contacts.angle.size,
        lambda span: march_each(states, h, angles, system, histories, work, span),
        watch,
    )


@compiled
def march_each(states, h, start_angles, system, histories, work, span):
    """Do `march` for each row of states and its start angle; return the result of the last one.

    span: see `runge_kutta`.
    """
    done = 0
    for i in range(start_angles.size):
        out = Recorded(histories[i], histories[i, :0], 1)
        done = runge_kutta(states[i], h, start_angles[i], 1, system, out, work, span)
    return done


def turn_smooth(y, sign, angle, system):
    """Turn velocities in the state y (4 n,) into w (sign 1), or back (sign −1), in place.

    A rotor that marches velocities keeps them. A state with w = 0 has exactly the velocities that
    have to be subtracted, v − w; one record of that state gives them.
    """
    if system.rotor.variables == VELOCITIES:
        return
    n = system.rotor.active.size
    at_zero_w = y.reshape(4, n) * np.array([[1.0], [0.0], [1.0], [0.0]])
    history = np.empty((1, 6, n))
    march(at_zero_w.ravel(), 0.0, angle, system, history)
    y[n : 2 * n] -= sign * history[0, 1]
    y[3 * n :] -= sign * history[0, 4]


def motion_rates(times, states, start_angle, system):
    """Return dy/dt (m, 4 n) at times (m,) [s] and states (m, 4 n) of a system in VELOCITIES."""
    angles = start_angle + system.rotor.cage_speed * times
    histories = np.empty((times.size, 1, 6, system.rotor.active.size))
    work = new_steps(states.shape[1], 1, system)
    march_each(states.copy(), 0.0, angles, system, histories, work, (0, 1))
    return histories[:, 0, [1, 2, 4, 5]].reshape(states.shape)


def elastic_loads(x, active, start_angle, turn, contacts, path):
    """Return K δ^n (m, contacts) [N] (Eq. 13) at displacements x (m, len(active)) [m].

    Tilts in x are times r_d. In row k of x the cage is at start_angle + k·turn.
    """
    loads = np.zeros((x.shape[0], contacts.angle.size))
    work = np.ascontiguousarray(x), np.zeros(5), new_passage(BLOCK, contacts.angle)
    fill_loads(active, start_angle, turn, contacts, path, loads, work)
    return loads


@compiled
def fill_loads(active, start_angle, turn, contacts, path, loads, work):
    """Compiled body of `elastic_loads`; work is x, five zeros for a displacement, and a passage."""
    x, q, passage = work
    for first in range(0, x.shape[0], BLOCK):
        instants = min(BLOCK, x.shape[0] - first)
        lay_out_balls(start_angle + first * turn, turn, instants, 1.0, contacts, path, passage)
        for i in range(instants):
            for a in range(active.size):
                q[active[a]] = x[first + i, a]
            place = Place(passage.c[i], passage.s[i], passage.d[i])
            for j in range(loads.shape[1]):
                loads[first + i, j] = carried(components(q), place, j, contacts)


@compiled
def interpolate_steps(history, body, weights, first, out):
    """Fill out (n_out, n) with samples of one body from `first` on, interpolated between steps.

    Each step has `ratio` samples. weights (ratio, 6) multiply x, v and acceleration at a step and
    at the next one, and choose the quantity; body is 0 for the inner and 3 for the outer ring.
    """
    ratio = weights.shape[0]
    last = history.shape[0] - 2
    for row in range(out.shape[0]):
        k = first + row
        step = min(k // ratio, last)
        w = k - step * ratio
        if w == ratio:  # the last sample, one whole step after the last but one
            step += 1
            w = 0
        following = min(step + 1, last + 1)
        for a in range(out.shape[1]):
            # the difference of displacements comes first, as each of them is many times larger
            out[row, a] = (
                (weights[w, 0] + weights[w, 3]) * history[step, body, a]
                + weights[w, 3] * (history[following, body, a] - history[step, body, a])
                + weights[w, 1] * history[step, body + 1, a]
                + weights[w, 4] * history[following, body + 1, a]
                + weights[w, 2] * history[step, body + 2, a]
                + weights[w, 5] * history[following, body + 2, a]
            )


@compiled
def lay_side_by_side(history, body, before, rows):
    """Copy displacement since the first row, v and a of a body into rows (n, 3 stride, m), all 0.

    Row i of the history goes into column (before + i)//stride of row (before + i) mod stride of
    each quantity. Instants that are `stride` rows apart in time then lie side by side.
    """
    stride = rows.shape[1] // 3
    n = min(history.shape[0], rows.shape[2] * stride - before)
    for i in range(n):
        column = (before + i) // stride
        part = (before + i) % stride
        for a in range(rows.shape[0]):
            rows[a, part, column] = history[i, body, a] - history[0, body, a]
            rows[a, stride + part, column] = history[i, body + 1, a]
            rows[a, 2 * stride + part, column] = history[i, body + 2, a]


@compiled
def sliding_sums(rows, weights, out):
    """Add Σ weights[c, t]·rows[c, k + t] to each out[k] (n,); rows (c, at least n + t)."""
    piece = 1024  # so many numbers stay in the cache while all weights pass over them
    taps = weights.shape[1]
    for first in range(0, out.size, piece):
        part = out[first : first + piece]
        for c in range(rows.shape[0]):
            row = rows[c, first:]
            t = 0
            while t + 4 <= taps:
                w0 = weights[c, t]
                w1 = weights[c, t + 1]
                w2 = weights[c, t + 2]
                w3 = weights[c, t + 3]
                near = row[t:]
                for k in range(part.size):
                    part[k] += w0 * near[k] + w1 * near[k + 1] + w2 * near[k + 2] + w3 * near[k + 3]
                t += 4
            while t < taps:
                w0 = weights[c, t]
                near = row[t:]
                for k in range(part.size):
                    part[k] += w0 * near[k]
                t += 1
