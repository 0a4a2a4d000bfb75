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

import numpy as np

from bearingcore.kernels.balls.contacts import (
    find_contacts,
    planar_contacts,
    push_contacts,
    ring_state,
)
from bearingcore.kernels.balls.release import smooth_start, true_forces, update_released
from bearingcore.kernels.balls.structs import INNER, OUTER, BallForces, BallMarch
from bearingcore.kernels.compiling import compiled, inlined, njit_no_refcount
from bearingcore.kernels.contact import contact_load
from bearingcore.kernels.motion.march import advance, all_finite, stage_part
from bearingcore.kernels.motion.rings import record, ring_accelerations
from bearingcore.kernels.path import (
    BLOCK,
    drops_of_balls,
    lay_out_balls,
    lay_out_unbalance,
    new_passage,
)
from bearingcore.kernels.structs import PLANAR, VELOCITIES


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
        k[n + a], k[3 * n + a] = ring_accelerations(
            y, k, rotor, a, work.f[INNER], work.f[OUTER], passage.push[at]
        )


@njit_no_refcount
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
            lay_out_unbalance(angle, half_turn, instants, rotor, passage)
            lay_out_inner(angle, half_turn, instants, system, inner)
        if step == 0:
            smooth_start(y, passage, inner, system, work)
        looking = not rotor.tension and rotor.variables != VELOCITIES
        stage = 0
        while stage < 4:
            at = i + (stage + 1) // 2
            part = stage_part(stage, h)
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
                record(
                    history, sample, y, k[0], rotor, work.f[INNER], work.f[OUTER], passage.push[at]
                )
                for b in range(places.shape[1] * n_balls):
                    places[sample, b // n_balls, b % n_balls] = y[first + b]
            if step == n_steps:
                break
        if step == n_steps:
            break
        for r in range(size):
            y[r] += advance(h, k[0, r], k[1, r], k[2, r], k[3, r])
    return n_steps if all_finite(y) else max(n_steps - BLOCK // 2, 0)


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
        lay_out_unbalance(angle, 0.0, 1, system.rotor, march.passage)
        lay_out_inner(angle, 0.0, 1, system, march.inner)
        ball_rates(states[i], rates[i], march.passage, march.inner, 0, system, march.forces)
    return rates


@compiled
def race_loads(inner_x, outer_x, places, active, turning, system):
    """Elastic loads (2, m, n_balls) [N] of inner and outer contacts.

    Displacements (m, len(active)) of the rings [m], tilts times r_d, and places (m, k, n_balls) of
    the balls; turning is (start, turn): the cage is at start + i·turn at row i.
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


@njit_no_refcount
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
