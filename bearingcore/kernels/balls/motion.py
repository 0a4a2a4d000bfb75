"""Motion of balls that have mass: each has its place in the plane through it, and two contacts.

Quantity                                          | Symbol            | Unit
------------------------------------------------- | ----------------- | --------
place of a ball, radial and axial, against that of the unloaded ball on the outer race | b | m
displacement of the inner, outer ring             | q_i, q_o          | m
compression of the contact with the inner, outer race | δ_i, δ_e      | m
unloaded distances of ball and groove centres     | A_i, A_e          | m
damping of the contacts                           | c_i, c_e          | N·s/m
mass, centrifugal load and weight of a ball       | m, F_c, G         | kg, N, N

With g_i and g_e the displacements of the groove centres at a ball (Eqs. 11 and 12, one of them for
each ring) and u the unloaded line of contact

    inner contact: between b and g_i, δ_i = |A_i u + g_i − b − d_i u| − A_i,
    outer contact: between g_e and b, δ_e = |A_e u + b − g_e − d_e u| − A_e,
    m b̈ = Q_i e_i − Q_e e_e + (F_c − G sin φ) (1, 0),

and the rings feel Q_i and Q_e. Drops d into defects of the inner race act on the inner contact,
those into the outer race on the outer one. Both contacts have the guard of `contact`.

What is marched is as in `motion`: variables that do not jump as a contact closes. For a ball that
is w = v − (c_i δ_i e_i − c_e δ_e e_e)/m. Where a damper may not pull, a contact whose damper would
is *released*: it pushes no more, and its part leaves w, so that v does not jump. Releases are
looked for at the end of each step: the force is zero there, and a late look errs by the square of a
step.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.kernels.compiling import borrowing, compiled, inlined
from bearingcore.kernels.contact import compression, contact_load, seen_from_the_cage, tilting
from bearingcore.kernels.motion import accelerations, all_finite
from bearingcore.kernels.path import BLOCK, drops_of_balls, lay_out_balls, new_passage
from bearingcore.kernels.structs import PLANAR, VELOCITIES, Array, Contacts, Passage, Path, Rotor

INNER, OUTER = 0, 1


class Races(NamedTuple):
    """What each ball has beside the numbers of `Contacts`, each array (n,), or (2, n) by race.

    The first row is that of the inner, the second that of the outer contact.

    Attributes
    ----------
    factor : (2, n) [N/m^exponent]
    distance : (2, n) [m]
        A_i and A_e, whose sum is A0.
    damping : (2, n) [N·s/m]
    mass [kg], inverse_mass [1/kg], centrifugal [N], weight [N]
    """

    factor: Array
    distance: Array
    damping: Array
    mass: Array
    inverse_mass: Array
    centrifugal: Array
    weight: Array


class BallSystem(NamedTuple):
    """All that moves where balls have mass; the way over defects of each race."""

    rotor: Rotor
    contacts: Contacts
    races: Races
    inner_path: Path
    outer_path: Path


class BallForces(NamedTuple):
    """Work space of the equations of motion; by race, the inner one first.

    Attributes
    ----------
    x, v : (2, 5) [m], [m/s]
        displacement and velocity of the rings.
    S, f : (2, 5) [N·s], [N]
        Σ c δ e; force of the contacts, on the outer ring and on the balls' outer side.
    contact : (2, n, 4)
        δ [m] (0 for what does not push), er, ez, 1/A [1/m].
    ball : (2, n) [N]
        force on the balls, radial and axial.
    released, before : (2, n)
        contacts that are compressed and yet do not push, now and a step ago.
    """

    x: Array
    v: Array
    S: Array
    f: Array
    contact: Array
    ball: Array
    released: NDArray[np.bool_]
    before: NDArray[np.bool_]


class BallMarch(NamedTuple):
    """Work space of steps: positions of the balls, with the drops into the outer race and into the
    inner one; the equations of motion's; rates of the four stages (4, size); the state tried.
    """

    passage: Passage
    inner: Passage
    forces: BallForces
    k: Array
    trial: Array


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
    """δ [m], direction (er, ez) and 1/A of one contact; (r, z) is what closes it."""
    ca = contacts.line_r[j]
    sa = contacts.line_z[j]
    delta, eu, ew, bend = compression(r * ca + z * sa - drop, z * ca - r * sa, A)
    return delta, eu * ca - ew * sa, eu * sa + ew * ca, bend


@inlined
def row_components(q, row):
    """A row of five as a tuple."""
    return q[row, 0], q[row, 1], q[row, 2], q[row, 3], q[row, 4]


@inlined
def ring_state(y, rotor, x):
    """Displacements of both rings into x (2, 5)."""
    n = rotor.active.size
    for a in range(n):
        x[INNER, rotor.active[a]] = y[a]
        x[OUTER, rotor.active[a]] = y[2 * n + a]


@inlined
def find_contacts(y, first, passage, inner, at, system, work):
    """δ, e and 1/A of all contacts into work.contact, Σ c δ e into work.S; y[first:] are places.

    A released contact counts as open.
    """
    contacts = system.contacts
    races = system.races
    n_balls = contacts.angle.size
    xi = row_components(work.x, INNER)
    xo = row_components(work.x, OUTER)
    S = work.S
    S[:, :] = 0.0
    for j in range(n_balls):
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        br = y[first + j]
        bz = y[first + n_balls + j]
        for race in range(2):
            if race == INNER:
                r, z = ring_at_ball(xi, cj, sj, j, contacts)
                r -= br + contacts.clearance[j]
                z += contacts.offset[j] - bz
                drop = inner.d[at, j]
            else:
                r, z = ring_at_ball(xo, cj, sj, j, contacts)
                r = br - r
                z = bz - z
                drop = passage.d[at, j]
            delta, er, ez, bend = race_touch(r, z, drop, races.distance[race, j], j, contacts)
            if delta <= 0.0 or work.released[race, j]:
                work.contact[race, j, 0] = 0.0
                continue
            work.contact[race, j, 0] = delta
            work.contact[race, j, 1] = er
            work.contact[race, j, 2] = ez
            work.contact[race, j, 3] = bend
            damped = races.damping[race, j] * delta
            et = damped * tilting(er, ez, j, contacts)
            S[race, 0] += damped * er * cj
            S[race, 1] += damped * er * sj
            S[race, 2] += damped * ez
            S[race, 3] += et * sj
            S[race, 4] -= et * cj


@inlined
def push_contacts(k, first, passage, inner, at, system, work, smooth):
    """Forces of all contacts into work.f and, with F_c and G, on the balls into work.ball.

    Q e + c δ̇ e (Eq. 18) with velocities work.v and k[first:], or where `smooth` Q e − c δ ė.
    """
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    w = rotor.cage_speed
    n_balls = contacts.angle.size
    ui = seen_from_the_cage(row_components(work.x, INNER), row_components(work.v, INNER), w)
    uo = seen_from_the_cage(row_components(work.x, OUTER), row_components(work.v, OUTER), w)
    f = work.f
    f[:, :] = 0.0
    for j in range(n_balls):
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        work.ball[0, j] = races.centrifugal[j] - races.weight[j] * sj
        work.ball[1, j] = 0.0
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
                d_rate = inner.d_rate[at, j]
            else:
                r, z = ring_at_ball(uo, cj, sj, j, contacts)
                r = k[first + j] - r
                z = k[first + n_balls + j] - z
                d_rate = passage.d_rate[at, j]
            r -= contacts.line_r[j] * d_rate
            z -= contacts.line_z[j] * d_rate
            _, Q, _ = contact_load(delta, races.factor[race, j], contacts.exponent[j])
            damping = races.damping[race, j]
            turn_r = 0.0
            turn_t = 0.0
            if smooth:
                swivel = damping * delta * (er * z - ez * r) * work.contact[race, j, 3]
                along_r = Q * er + swivel * ez
                along_z = Q * ez - swivel * er
                turn_r = damping * delta * w * er
                turn_t = damping * delta * w * tilting(er, ez, j, contacts)
            else:
                push = Q + damping * (er * r + ez * z)
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
def planar_contacts(y, first, passage, inner, at, system, work):
    """`find_contacts` and the smooth forces in one where contacts stay in the plane: e = ±(c, s).

    ė = ω_c (−s, c) for the rings and none for the balls: no velocity is needed.
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
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        u = y[first + j]
        force = races.centrifugal[j] - races.weight[j] * sj
        closing = i0 * cj + i1 * sj - u - clearance[j] - inner.d[at, j]
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
        closing = u - (o0 * cj + o1 * sj) - passage.d[at, j]
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
def planar_push(k, first, passage, inner, at, system, work):
    """`push_contacts` with velocities where contacts stay in the plane."""
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
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        for race in range(2):
            delta = work.contact[race, j, 0]
            if delta <= 0.0:
                continue
            if race == INNER:
                rate = vi0 * cj + vi1 * sj - k[first + j] - inner.d_rate[at, j]
            else:
                rate = k[first + j] - vo0 * cj - vo1 * sj - passage.d_rate[at, j]
            _, Q, _ = contact_load(delta, races.factor[race, j], contacts.exponent[j])
            push = Q + races.damping[race, j] * rate
            if push <= 0.0 and not rotor.tension:
                work.contact[race, j, 0] = -delta  # would pull
                continue
            f[race, 0] += push * cj
            f[race, 1] += push * sj


@inlined
def ring_velocities(y, k, rotor, work, sign):
    """ẋ of both rings into k from w (sign 1), Σ c δ e being in work.S; into work.v too."""
    active = rotor.active
    n = active.size
    for a in range(n):
        k[a] = y[n + a] - sign * rotor.inverse_inner[a] * work.S[INNER, active[a]]
        k[2 * n + a] = y[3 * n + a] + sign * rotor.inverse_outer[a] * work.S[OUTER, active[a]]
        work.v[INNER, active[a]] = k[a]
        work.v[OUTER, active[a]] = k[2 * n + a]


@inlined
def ring_accelerations(y, k, rotor, a, work):
    """Of inner and outer ring along active direction a (Eq. 18)."""
    n = rotor.active.size
    d = rotor.active[a]
    # each ring feels its own contacts, so that of each pair one is left aside
    inner, _ = accelerations(rotor, a, work.f[INNER, d], 0.0, 0.0)
    _, outer = accelerations(rotor, a, work.f[OUTER, d], y[2 * n + a], k[2 * n + a])
    return inner, outer


@inlined
def ball_rates(y, k, passage, inner, at, system, work):
    """dy/dt into k: rings as in `motion`, then the balls' places and their w.

    Both are radial places of all balls, then axial ones, these only where the motion is not planar.
    """
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    n = rotor.active.size
    n_balls = contacts.angle.size
    first = 4 * n
    planar = rotor.variables == PLANAR
    smooth = rotor.variables != VELOCITIES
    ring_state(y, rotor, work.x)
    if planar:
        planar_contacts(y, first, passage, inner, at, system, work)
        speeds = first + n_balls
        for j in range(n_balls):
            damped = (
                races.damping[INNER, j] * work.contact[INNER, j, 0]
                - races.damping[OUTER, j] * work.contact[OUTER, j, 0]
            )
            k[first + j] = y[speeds + j] + damped * races.inverse_mass[j]
            k[speeds + j] = work.ball[0, j] * races.inverse_mass[j]
        ring_velocities(y, k, rotor, work, 1.0)
    else:
        find_contacts(y, first, passage, inner, at, system, work)
        speeds = first + 2 * n_balls
        for j in range(n_balls):
            for part in range(2):
                damped = 0.0
                if smooth:
                    damped = (
                        races.damping[INNER, j]
                        * work.contact[INNER, j, 0]
                        * work.contact[INNER, j, 1 + part]
                        - races.damping[OUTER, j]
                        * work.contact[OUTER, j, 0]
                        * work.contact[OUTER, j, 1 + part]
                    )
                i = part * n_balls + j
                k[first + i] = y[speeds + i] + damped * races.inverse_mass[j]
        ring_velocities(y, k, rotor, work, 1.0 if smooth else 0.0)
        push_contacts(k, first, passage, inner, at, system, work, smooth)
        for j in range(n_balls):
            for part in range(2):
                k[speeds + part * n_balls + j] = work.ball[part, j] * races.inverse_mass[j]
    for a in range(n):
        k[n + a], k[3 * n + a] = ring_accelerations(y, k, rotor, a, work)


@borrowing
def change_variable(y, race, j, sign, passage, at, system, work):
    """Take what a contact adds to w out of the state y (sign 1), or put it in (−1)."""
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    active = rotor.active
    n = active.size
    n_balls = contacts.angle.size
    planar = rotor.variables == PLANAR
    cj = passage.c[at, j]
    sj = passage.s[at, j]
    er = 1.0 if planar else work.contact[race, j, 1]
    ez = 0.0 if planar else work.contact[race, j, 2]
    damped = sign * races.damping[race, j] * abs(work.contact[race, j, 0])
    et = tilting(er, ez, j, contacts)
    along = (er * cj, er * sj, ez, et * sj, -et * cj)
    side = 1.0 if race == INNER else -1.0
    for a in range(n):
        part = damped * along[active[a]]
        if race == INNER:
            y[n + a] -= rotor.inverse_inner[a] * part
        else:
            y[3 * n + a] += rotor.inverse_outer[a] * part
    speeds = 4 * n + (n_balls if planar else 2 * n_balls)
    y[speeds + j] += side * damped * er * races.inverse_mass[j]
    if not planar:
        y[speeds + n_balls + j] += side * damped * ez * races.inverse_mass[j]


@borrowing
def locate_contacts(y, passage, inner, at, system, work):
    """Contacts at the state y into work, the rings' displacements being there already."""
    first = 4 * system.rotor.active.size
    if system.rotor.variables == PLANAR:
        planar_contacts(y, first, passage, inner, at, system, work)
    else:
        find_contacts(y, first, passage, inner, at, system, work)


@borrowing
def true_forces(k, passage, inner, at, system, work):
    """Σ (Q + c δ̇) e of both rings into work.f, at the positions that `ball_rates` left in work."""
    first = 4 * system.rotor.active.size
    if system.rotor.variables == PLANAR:
        planar_push(k, first, passage, inner, at, system, work)
    else:
        push_contacts(k, first, passage, inner, at, system, work, False)


@borrowing
def update_released(y, k, passage, inner, at, system, work):
    """Release contacts whose damper would pull, and take up those that push again.

    work holds the contacts at y as `ball_rates` left them and is spoilt. Returns whether any
    changed: then the rates have, too.
    """
    released = work.released
    before = work.before
    changed = False
    some = False
    n_balls = released.shape[1]
    true_forces(k, passage, inner, at, system, work)
    for race in range(2):
        for j in range(n_balls):
            before[race, j] = released[race, j]
            some = some or released[race, j]
            if not released[race, j] and work.contact[race, j, 0] < 0.0:
                change_variable(y, race, j, 1.0, passage, at, system, work)
                released[race, j] = True
                changed = True
    if not some:
        return changed
    # those that were released before: are they still compressed, and would they still pull?
    for race in range(2):
        for j in range(n_balls):
            if before[race, j]:
                released[race, j] = False
    locate_contacts(y, passage, inner, at, system, work)
    true_forces(k, passage, inner, at, system, work)
    for race in range(2):
        for j in range(n_balls):
            if not before[race, j]:
                continue
            if work.contact[race, j, 0] < 0.0:
                released[race, j] = True
            elif work.contact[race, j, 0] > 0.0:
                change_variable(y, race, j, -1.0, passage, at, system, work)
                changed = True
    return changed


@inlined
def record_rings(history, sample, y, k, rotor, work):
    """Displacements, velocities and accelerations of one instant into history[sample]."""
    n = rotor.active.size
    for a in range(n):
        inner, outer = ring_accelerations(y, k, rotor, a, work)
        history[sample, 0, a] = y[a]
        history[sample, 1, a] = k[a]
        history[sample, 2, a] = inner
        history[sample, 3, a] = y[2 * n + a]
        history[sample, 4, a] = k[2 * n + a]
        history[sample, 5, a] = outer


@borrowing
def lay_out_inner(start, turn, count, system, inner):
    """Drops into defects of the inner race, with their rates, at `count` cage angles."""
    if system.inner_path.defects.shape[0] == 0:
        return
    for i in range(count):
        rate = inner.d_rate[i]
        drops_of_balls(start + i * turn, system.contacts, system.inner_path, inner.d[i], rate)
        for j in range(rate.size):
            rate[j] *= system.rotor.cage_speed


@compiled
def new_ball_march(size, n_balls, instants):
    """Empty work space of steps."""
    return BallMarch(
        new_passage(instants, n_balls),
        new_passage(instants, n_balls),
        BallForces(
            np.zeros((2, 5)),
            np.zeros((2, 5)),
            np.zeros((2, 5)),
            np.zeros((2, 5)),
            np.zeros((2, n_balls, 4)),
            np.zeros((2, n_balls)),
            np.zeros((2, n_balls), dtype=np.bool_),
            np.zeros((2, n_balls), dtype=np.bool_),
        ),
        np.zeros((4, size)),
        np.zeros(size),
    )


@compiled
def march_balls(y, h, start_angle, stride, system, history, places):
    """Steps of h [s] from y, velocities in it, which is moved to the end; RK4 of order 4.

    Every `stride` steps history (samples, 6, n) takes displacement, velocity and acceleration of
    the inner ring, then of the outer one, and places (samples, k, n_balls) those of the balls:
    radial, and axial unless the motion is planar. Returns the number of steps after which all was
    still finite, which is looked at once in half a BLOCK.
    """
    rotor = system.rotor
    contacts = system.contacts
    n_balls = contacts.angle.size
    size = y.size
    march = new_ball_march(size, n_balls, BLOCK + 1)
    passage = march.passage
    inner = march.inner
    work = march.forces
    k = march.k
    trial = march.trial
    n_steps = stride * (history.shape[0] - 1)
    first = 4 * rotor.active.size
    half_turn = 0.5 * h * rotor.cage_speed
    sixth = h / 6.0
    for step in range(n_steps + 1):
        i = (2 * step) % BLOCK
        if i == 0:
            if not all_finite(y):
                return max(step - BLOCK // 2, 0)
            instants = min(BLOCK, 2 * (n_steps - step)) + 1
            angle = start_angle + 2 * step * half_turn
            lay_out_balls(
                angle, half_turn, instants, rotor.cage_speed, contacts, system.outer_path, passage
            )
            lay_out_inner(angle, half_turn, instants, system, inner)
        if step == 0:
            smooth_start(y, passage, inner, system, work)
        looking = not rotor.tension and rotor.variables != VELOCITIES
        stage = 0
        while stage < 4:
            at = i + (stage + 1) // 2
            part = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
            before = max(stage - 1, 0)
            for r in range(size):
                trial[r] = y[r] + part * k[before, r]
            ball_rates(trial, k[stage], passage, inner, at, system, work)
            stage += 1
            if stage > 1:
                continue
            if looking:
                looking = False
                if update_released(y, k[0], passage, inner, at, system, work):
                    stage = 0  # another variable, another rate
                    continue
            if step % stride == 0:
                true_forces(k[0], passage, inner, at, system, work)
                sample = step // stride
                record_rings(history, sample, y, k[0], rotor, work)
                for b in range(places.shape[1] * n_balls):
                    places[sample, b // n_balls, b % n_balls] = y[first + b]
            if step == n_steps:
                break
        if step == n_steps:
            break
        for r in range(size):
            y[r] += sixth * (k[0, r] + 2.0 * (k[1, r] + k[2, r]) + k[3, r])
    return n_steps if all_finite(y) else max(n_steps - BLOCK // 2, 0)


@borrowing
def smooth_start(y, passage, inner, system, work):
    """Turn the velocities in y into w: everything that is compressed counts as pushing."""
    rotor = system.rotor
    if rotor.variables == VELOCITIES:
        return
    ring_state(y, rotor, work.x)
    locate_contacts(y, passage, inner, 0, system, work)
    for race in range(2):
        for j in range(system.contacts.angle.size):
            if work.contact[race, j, 0] > 0.0:
                change_variable(y, race, j, -1.0, passage, 0, system, work)


@compiled
def ball_motion_rates(times, states, start_angle, system):
    """dy/dt (m, size) at times (m,) [s] and states (m, size) of a system in VELOCITIES."""
    n_balls = system.contacts.angle.size
    march = new_ball_march(states.shape[1], n_balls, 1)
    rates = np.empty(states.shape)
    for i in range(times.size):
        angle = start_angle + system.rotor.cage_speed * times[i]
        lay_out_balls(
            angle,
            0.0,
            1,
            system.rotor.cage_speed,
            system.contacts,
            system.outer_path,
            march.passage,
        )
        lay_out_inner(angle, 0.0, 1, system, march.inner)
        ball_rates(states[i], rates[i], march.passage, march.inner, 0, system, march.forces)
    return rates


@compiled
def race_loads(inner_x, outer_x, places, active, turning, system):
    """Elastic loads (2, m, n_balls) [N] of inner and outer contacts.

    Displacements (m, len(active)) of the rings [m], tilts times r_d, and places (m, k, n_balls) of
    the balls; turning is (start, turn): the cage stands at start + i·turn at row i.
    """
    contacts = system.contacts
    n_balls = contacts.angle.size
    march = new_ball_march(1, n_balls, 1)
    loads = np.zeros((2, places.shape[0], n_balls))
    place = np.zeros(2 * n_balls)
    start, turn = turning
    for i in range(places.shape[0]):
        angle = start + i * turn
        lay_out_balls(angle, 0.0, 1, 1.0, contacts, system.outer_path, march.passage)
        lay_out_inner(angle, 0.0, 1, system, march.inner)
        for a in range(active.size):
            march.forces.x[INNER, active[a]] = inner_x[i, a]
            march.forces.x[OUTER, active[a]] = outer_x[i, a]
        for b in range(places.shape[1] * n_balls):
            place[b] = places[i, b // n_balls, b % n_balls]
        loads_of_races(place, loads, i, system, march)
    return loads


@borrowing
def loads_of_races(place, loads, i, system, march):
    """Loads of one instant of `race_loads`."""
    find_contacts(place, 0, march.passage, march.inner, 0, system, march.forces)
    for race in range(2):
        for j in range(loads.shape[2]):
            delta = march.forces.contact[race, j, 0]
            if delta > 0.0:
                _, loads[race, i, j], _ = contact_load(
                    delta, system.races.factor[race, j], system.contacts.exponent[j]
                )
