"""Motion of balls with mass: each has a position in the plane through it, and two contacts.

Quantity                                          | Symbol            | Unit
------------------------------------------------- | ----------------- | --------
position of a ball, radial and axial, from that of the unloaded ball on the outer race | b | m
displacement of the inner, outer ring             | q_i, q_o          | m
compression of the contact with the inner, outer race | δ_i, δ_e      | m
unloaded distances of ball and groove centres     | A_i, A_e          | m
damping of the contacts                           | c_i, c_e          | N·s/m
mass, centrifugal load and weight of a ball       | m, F_c, G         | kg, N, N

With g_i and g_e the displacements of the groove centres of both rings at a ball (Eqs. 11 and 12)
and u the unloaded line of contact

    inner contact: between b and g_i, δ_i = |A_i u + g_i − b − d_i u| − A_i,
    outer contact: between g_e and b, δ_e = |A_e u + b − g_e − d_e u| − A_e,
    m b̈ = Q_i e_i − Q_e e_e + (F_c − G sin φ) (1, 0),

and the rings carry Q_i and Q_e. Drops d into defects of the inner race act on the inner contact,
those into defects of the outer race on the outer one. Both contacts have the guard of `contact`.

As in `motion.march`, the marched variables do not jump when a contact closes. For a ball this is
w = v − (c_i δ_i e_i − c_e δ_e e_e)/m. If dampers may not pull, a contact whose damper would pull is
*released*: it no longer pushes, and its part leaves w, so that v does not jump. Each step begins
with a search for releases. The force is zero at a release, so a late search errs only by the square
of a step.
"""

from __future__ import annotations

import numpy as np

from bearingcore.model._kernels.balls.contacts import (
    find_contacts,
    planar_contacts,
    push_contacts,
    ring_state,
)
from bearingcore.model._kernels.balls.release import smooth_start, true_forces, update_released
from bearingcore.model._kernels.balls.structs import INNER, OUTER, BallForces, BallSteps
from bearingcore.model._kernels.compiling import called, compiled, inlined
from bearingcore.model._kernels.in_parts import march_in_parts
from bearingcore.model._kernels.motion.rings import record, ring_accelerations
from bearingcore.model._kernels.path import (
    BLOCK,
    lay_out_balls,
    lay_out_drops_and_rates,
    lay_out_forces,
    new_passage,
)
from bearingcore.model._kernels.runge_kutta import stepper, try_state
from bearingcore.model._kernels.structs import PLANAR, Recorded


@inlined
def ring_velocities(y, k, rotor, work):
    """Write ẋ of both rings, from their w in y and Σ c δ e in work.S, into k and work.v."""
    active = rotor.active
    n = active.size
    for a in range(n):
        k[a] = y[n + a] - rotor.inverse_inner[a] * work.S[INNER, active[a]]
        k[2 * n + a] = y[3 * n + a] + rotor.inverse_outer[a] * work.S[OUTER, active[a]]
        work.v[INNER, active[a]] = k[a]
        work.v[OUTER, active[a]] = k[2 * n + a]


@inlined
def ball_rates(y, k, passage, inner, instant, system, work):
    """Write dy/dt into k: both rings as in `motion.march`, then positions of the balls and their w.

    Either lists radial parts of all balls, then axial parts. A planar motion has no axial parts.
    """
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    n = rotor.active.size
    n_balls = contacts.angle.size
    first = 4 * n
    ring_state(y, rotor, work.x)
    # first ẋ = w + Σ c δ e/m of balls and rings, then ẇ, whose swivelling forces need ẋ
    if rotor.variables == PLANAR:
        planar_contacts(y, first, passage, inner, instant, system, work)
        speeds = first + n_balls
        for j in range(n_balls):
            damped = (
                races.damping[INNER, j] * work.contact[INNER, j, 0]
                - races.damping[OUTER, j] * work.contact[OUTER, j, 0]
            )
            k[first + j] = y[speeds + j] + damped * races.inverse_mass[j]
            k[speeds + j] = work.ball[0, j] * races.inverse_mass[j]
        ring_velocities(y, k, rotor, work)
    else:
        find_contacts(y, first, passage, inner, instant, system, work)
        speeds = first + 2 * n_balls
        for j in range(n_balls):
            for part in range(2):
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
        ring_velocities(y, k, rotor, work)
        push_contacts(k, first, passage, inner, instant, system, work, True)
        for j in range(n_balls):
            for part in range(2):
                k[speeds + part * n_balls + j] = work.ball[part, j] * races.inverse_mass[j]
    for a in range(n):
        k[n + a], k[3 * n + a] = ring_accelerations(
            y, k, rotor, a, work.f[INNER], work.f[OUTER], passage.push[instant]
        )


@called
def lay_out(angle, turn, count, system, work):
    """Write balls, drops into both races and outer forces at `count` cage angles [rad] to work."""
    speed = system.rotor.cage_speed
    contacts = system.contacts
    lay_out_balls(angle, turn, count, speed, contacts, system.outer_path, work.passage)
    lay_out_forces(angle, turn, count, system.rotor, work.passage)
    if system.inner_path.defects.shape[0] > 0:
        lay_out_drops_and_rates(angle, turn, count, speed, contacts, system.inner_path, work.inner)


@inlined
def rates(y, part, before, k, instant, system, work):
    """Write the rate of the state y + part·before into k."""
    try_state(y, part, before, work.trial)
    ball_rates(work.trial, k, work.passage, work.inner, instant, system, work.forces)


@inlined
def changed(y, instant, system, work):
    """Release contacts and take them up again as a step begins; return True if that changed y."""
    if system.rotor.tension:
        return False
    return update_released(y, work.k[0], work.passage, work.inner, instant, system, work.forces)


@inlined
def keep(sample, y, instant, system, out, work):
    """Record the state y, with the forces as published, and the positions of the balls."""
    forces = work.forces
    places = out.places
    rotor = system.rotor
    k = work.k[0]
    true_forces(k, work.passage, work.inner, instant, system, forces)
    push = work.passage.push[instant]
    record(out.history, sample, y, k, rotor, forces.f[INNER], forces.f[OUTER], push)
    if sample % out.every != 0:
        return
    first = 4 * rotor.active.size
    n_balls = places.shape[2]
    for b in range(places.shape[1] * n_balls):
        places[sample // out.every, b // n_balls, b % n_balls] = y[first + b]


runge_kutta = stepper(lay_out, rates, changed, keep)


def new_ball_steps(size, instants, angle):
    """Return empty work space for steps of a state of `size` numbers; see `new_passage`."""
    n_balls = angle.size
    return BallSteps(
        new_passage(instants, angle),
        new_passage(instants, angle),
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


def march_balls(y, h, start_angle, stride, system, history, places, watch=None):
    """March in steps of h [s] from y, which holds velocities; y is moved to the end.

    Every `stride` steps a sample is taken. history (samples, 6, n) takes displacement, velocity and
    acceleration of the inner ring, then of the outer ring. places (samples, k, n_balls) takes the
    positions of the balls: radial, and axial unless the motion is planar. If places has fewer rows,
    they are spread evenly over the samples. Returns the number of steps after which all was still
    finite; this is tested once in half a BLOCK. `watch`: see `march_in_parts`.
    """
    work = new_ball_steps(y.size, BLOCK + 1, system.contacts.angle)
    out = Recorded(history, places, -(-len(history) // max(len(places), 1)))
    return march_in_parts(
        stride * (len(history) - 1),
        y.size * system.contacts.angle.size,
        lambda span: march_with_balls(y, h, start_angle, stride, system, out, work, span),
        watch,
    )


@compiled
def march_with_balls(y, h, start_angle, stride, system, out, work, span):
    """Compiled body of `march_balls`; span: see `runge_kutta`."""
    if span[0] == 0:
        lay_out(start_angle, 0.0, 1, system, work)
        smooth_start(y, work.passage, work.inner, system, work.forces)
    return runge_kutta(y, h, start_angle, stride, system, out, work, span)
