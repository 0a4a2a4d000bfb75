"""Steps for the balls' own directions alone, to be compared with `kernels.march_balls`.

The rings take leapfrog steps, between which each ball takes one or more steps of its own, the rings
moving evenly meanwhile. Contacts stay in the plane. Both kinds of steps are of order 2 while no
contact opens or closes, and of order 1 with damping that switches as it does:

- implicit: the midpoint rule, stable however stiff and damped a contact is;
- exponential: the ball swings between the springs and dampers that its contacts are at the step's
  beginning, with the rings in the middle of their step, which is solved exactly (the exponential
  Rosenbrock-Euler method, Hochbruck and Ostermann, Acta Numerica 19 (2010) 209-286). The rings feel
  the mean of these linear forces, so that momentum is kept.
"""

from __future__ import annotations

import math

import numpy as np

from bearingcore.kernels.balls.motion import lay_out_inner, new_ball_march
from bearingcore.kernels.balls.structs import INNER, OUTER
from bearingcore.kernels.compiling import borrowing, compiled, inlined
from bearingcore.kernels.contact import contact_load
from bearingcore.kernels.motion.march import all_finite
from bearingcore.kernels.path import BLOCK, lay_out_balls

MOST_NEWTON_STEPS = 30


@inlined
def push(delta, rate, race, j, system):
    """Load Q + c δ̇ [N] of a contact, stiffness [N/m] and damping [N·s/m]; 0 where it is open."""
    if delta <= 0.0:
        return 0.0, 0.0, 0.0
    races = system.races
    _, Q, k = contact_load(delta, races.factor[race, j], system.contacts.exponent[j])
    c = races.damping[race, j]
    load = Q + c * rate
    if load <= 0.0 and not system.rotor.tension:
        return 0.0, 0.0, 0.0
    return load, k, c


@inlined
def radial_state(x, v, cj, sj, w):
    """Place [m] and its rate [m/s] of a ring along the ray of a ball."""
    return x[0] * cj + x[1] * sj, (v[0] + w * x[1]) * cj + (v[1] - w * x[0]) * sj


@borrowing
def swing(force, k, c, mass, speed, h):
    """Way [m] and speed [m/s] after a time h of m ẅ = F − k w − c (ẇ − v), F at its beginning.

    It sets out from w = 0 with the speed v; m, k and c are mass, stiffness and damping.
    """
    a = 0.5 * c / mass
    square = k / mass  # of the frequency without damping
    if square * h * h < 1e-8:
        if a * h < 1e-6:
            return h * (speed + 0.5 * h * force / mass), speed + h * force / mass
        end = force / c + speed
        left = math.exp(-2.0 * a * h)
        return end * h + (speed - end) * (1.0 - left) / (2.0 * a), end + (speed - end) * left
    rest = (force + c * speed) / k
    split = a * a - square
    if abs(split) * h * h < 1e-12:
        cosine, sine = 1.0, h
    elif split < 0.0:
        omega = math.sqrt(-split)
        cosine, sine = math.cos(omega * h), math.sin(omega * h) / omega
    else:
        rate = math.sqrt(split)
        cosine, sine = math.cosh(rate * h), math.sinh(rate * h) / rate
    left = math.exp(-a * h)
    way = rest * (1.0 - left * (cosine + a * sine)) + speed * left * sine
    return way, left * (cosine * speed + sine * (square * rest - a * speed))


@inlined
def forces_of_balls(rings, balls, at, passage, inner, system, part, exponential):
    """Σ Q e of both races, (fi0, fi1, fo0, fo1), rings at (X, V), each (2, 2), balls at (u, v).

    part [s] > 0: each ball takes a step of twice that, `exponential` or of the implicit midpoint
    rule; 0: where it is. Returns the sums and the number of evaluations.
    """
    X, V = rings
    u, v = balls
    contacts = system.contacts
    races = system.races
    w = system.rotor.cage_speed
    fi0 = fi1 = fo0 = fo1 = 0.0
    calls = 0
    for j in range(u.size):
        cj = passage.c[at, j]
        sj = passage.s[at, j]
        xi, ri = radial_state(X[INNER], V[INNER], cj, sj, w)
        xo, ro = radial_state(X[OUTER], V[OUTER], cj, sj, w)
        xi -= contacts.clearance[j] + inner.d[at, j]
        ri -= inner.d_rate[at, j]
        xo += passage.d[at, j]
        ro += passage.d_rate[at, j]
        load = races.centrifugal[j] - races.weight[j] * sj
        speed = v[j]
        if exponential and part > 0.0:
            Qi, ki, ci = push(xi - u[j], ri - speed, INNER, j, system)
            Qe, ke, ce = push(u[j] - xo, speed - ro, OUTER, j, system)
            calls += 1
            h = 2.0 * part
            force = Qi - Qe + load
            way, after = swing(force, ki + ke, ci + ce, races.mass[j], speed, h)
            faster = way / h - speed
            mean = 0.5 * way
            if (ki + ke) * h * h > 1e-6 * races.mass[j]:
                # of the way over the step, from what it takes to change the speed by so much
                change = races.mass[j] * (after - speed) / h
                mean = (force - (ci + ce) * faster - change) / (ki + ke)
            u[j] += way
            v[j] = after
            Qi -= ki * mean + ci * faster
            Qe += ke * mean + ce * faster
        for _ in range(0 if exponential and part > 0.0 else MOST_NEWTON_STEPS):
            place = u[j] + part * speed
            Qi, ki, ci = push(xi - place, ri - speed, INNER, j, system)
            Qe, ke, ce = push(place - xo, speed - ro, OUTER, j, system)
            calls += 1
            if part == 0.0:
                break
            left = races.mass[j] * (speed - v[j]) - part * (Qi - Qe + load)
            step = left / (races.mass[j] + part * (ci + ce + part * (ki + ke)))
            speed -= step
            if abs(step) <= 1e-10:
                break
        if part > 0.0 and not exponential:
            u[j] += 2.0 * part * speed
            v[j] = 2.0 * speed - v[j]
        fi0 += Qi * cj
        fi1 += Qi * sj
        fo0 += Qe * cj
        fo1 += Qe * sj
    return fi0, fi1, fo0, fo1, calls


@compiled
def march_split_balls(y, h, substeps, stride, exponential, system, history):
    """Steps of h [s] of the rings from y, as `kernels.march_balls` has it, `substeps` of the balls.

    The balls' steps are `exponential`, or implicit.

    history (samples, 6, 2) is filled every `stride` steps. Returns (steps that stayed finite,
    evaluations of all contacts).
    """
    rotor = system.rotor
    n_balls = system.contacts.angle.size
    X = np.zeros((2, 2))
    V = np.zeros((2, 2))
    Xm = np.zeros((2, 2))
    Vm = np.zeros((2, 2))
    A = np.zeros((2, 2))
    for a in range(2):
        X[INNER, a], V[INNER, a], X[OUTER, a], V[OUTER, a] = y[a], y[2 + a], y[4 + a], y[6 + a]
    u = y[8 : 8 + n_balls].copy()
    v = y[8 + n_balls : 8 + 2 * n_balls].copy()
    work = new_ball_march(1, n_balls, 2 * BLOCK + 1)
    passage = work.passage
    inner = work.inner
    small = h / substeps
    half_turn = 0.5 * small * rotor.cage_speed
    n_steps = stride * (history.shape[0] - 1)
    calls = 0
    laid = BLOCK  # sub-steps of the block at hand that were taken
    taken = 0
    for step in range(n_steps + 1):
        if laid + substeps > BLOCK:
            if not (all_finite(u) and all_finite(v)):
                return max(step - BLOCK, 0), calls // n_balls
            angle = 2 * taken * half_turn
            lay_out_balls(
                angle,
                half_turn,
                2 * BLOCK + 1,
                rotor.cage_speed,
                system.contacts,
                system.outer_path,
                passage,
            )
            lay_out_inner(angle, half_turn, 2 * BLOCK + 1, system, inner)
            laid = 0
        if step % stride == 0:
            fi0, fi1, fo0, fo1, more = forces_of_balls(
                (X, V), (u, v), 2 * laid, passage, inner, system, 0.0, exponential
            )
            f = ((fi0, fi1), (fo0, fo1))
            row = history[step // stride]
            for a in range(2):
                row[0, a] = X[INNER, a]
                row[1, a] = V[INNER, a]
                row[2, a] = (rotor.force[a] - f[0][a]) * rotor.inverse_inner[a]
                row[3, a] = X[OUTER, a]
                row[4, a] = V[OUTER, a]
                support = rotor.stiffness[a] * X[OUTER, a] + rotor.damping[a] * V[OUTER, a]
                row[5, a] = (f[1][a] - support) * rotor.inverse_outer[a]
            if step == n_steps:
                break
        sums = np.zeros(4)
        for sub in range(substeps):
            away = (sub + 0.5) * small
            for body in range(2):
                for a in range(2):
                    # by the acceleration of the step before, which errs by a power of h more
                    Xm[body, a] = X[body, a] + away * (V[body, a] + 0.5 * away * A[body, a])
                    Vm[body, a] = V[body, a] + away * A[body, a]
            fi0, fi1, fo0, fo1, more = forces_of_balls(
                (Xm, Vm), (u, v), 2 * laid + 1, passage, inner, system, 0.5 * small, exponential
            )
            calls += more
            laid += 1
            taken += 1
            sums += np.array([fi0, fi1, fo0, fo1]) / substeps
        for a in range(2):
            middle = X[OUTER, a] + 0.5 * h * V[OUTER, a]
            speed = V[OUTER, a] + 0.5 * h * A[OUTER, a]
            support = rotor.stiffness[a] * middle + rotor.damping[a] * speed
            A[INNER, a] = (rotor.force[a] - sums[a]) * rotor.inverse_inner[a]
            A[OUTER, a] = (sums[2 + a] - support) * rotor.inverse_outer[a]
            for body in range(2):
                X[body, a] += h * (V[body, a] + 0.5 * h * A[body, a])
                V[body, a] += h * A[body, a]
    finite = all_finite(u) and all_finite(v) and math.isfinite(X[0, 0] + X[1, 0])
    return n_steps if finite else max(n_steps - BLOCK, 0), calls // n_balls
