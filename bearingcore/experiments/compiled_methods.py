"""Compiled methods that exist only to be compared with those of `bearingcore.kernels`."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.kernels.compiling import compiled
from bearingcore.kernels.motion.march import (
    all_finite,
    equations_of_motion,
    new_forces,
    rates_at,
    record,
)
from bearingcore.kernels.path import BLOCK, lay_out_balls, new_passage
from bearingcore.kernels.statics import (
    CONVERGED,
    energy_gradient_hessian,
    newton_direction,
    static_states,
)
from bearingcore.kernels.structs import Place


@compiled
def march_verlet(y, h, start_angle, system, history):
    """Velocity-Verlet steps (leapfrog) of order 2 from y (4 n,), which is moved to the end.

    One right-hand side a step; forces that depend on velocity take it as half a step's acceleration
    extrapolates it. The rotor marches velocities. History and what is returned: as `march`.
    """
    rotor, contacts, path = system
    n_steps = history.shape[0] - 1
    n = rotor.active.size
    n_contacts = contacts.angle.size
    passage = new_passage(BLOCK + 1, n_contacts)
    work = new_forces(n_contacts)
    k = np.zeros(4 * n)
    half = np.zeros((2, n))
    w = rotor.cage_speed
    for step in range(n_steps + 1):
        i = step % BLOCK
        if i == 0:
            if not all_finite(y):
                return max(step - BLOCK, 0)
            count = min(BLOCK, n_steps - step) + 1
            angle = start_angle + step * h * w
            lay_out_balls(angle, h * w, count, w, contacts, path, passage)
        if step > 0:
            for b in range(2):
                for a in range(n):
                    r = 2 * b * n + a
                    half[b, a] = y[n + r] + 0.5 * h * k[n + r]
                    y[r] += h * half[b, a]
                    y[n + r] = half[b, a] + 0.5 * h * k[n + r]  # extrapolated
        equations_of_motion(y, k, passage, i, rotor, contacts, work)
        if step > 0:
            for b in range(2):
                for a in range(n):
                    r = 2 * b * n + a
                    y[n + r] = half[b, a] + 0.5 * h * k[n + r]
                    k[r] = y[n + r]
        record(history, step, y, k, rotor, work.f)
    return n_steps if all_finite(y) else max(n_steps - BLOCK, 0)


@compiled
def march_generalised_alpha(y, h, alphas, start_angle, system, history):
    """Implicit steps of order 2 by the generalised-α method of Chung and Hulbert (1993).

    alphas (am, af): inertia is taken `am` and forces `af` of a step before its end; am = af = 0 is
    the trapezoidal rule. The equations of a step are solved by Newton's method with the stiffness
    of the contacts and the damping of the support. Accelerations recorded are those of the equation
    of motion at the end of a step, not the method's own. The rotor marches velocities. Returns
    (steps that stayed finite, right-hand-side calls, steps whose equations were not solved to 1e-10
    of their size).
    """
    am, af = alphas
    rotor = system.rotor
    contacts = system.contacts
    active = rotor.active
    n_steps = history.shape[0] - 1
    n = active.size
    m = 2 * n
    n_contacts = contacts.angle.size
    passage = new_passage(1, n_contacts)
    work = new_forces(n_contacts)
    no_load = np.zeros(5)
    g = np.zeros(5)
    H = np.zeros((5, 5))
    S = np.zeros((m, m))
    L = np.zeros((m, m))
    residual = np.zeros(m)
    change = np.zeros(m)
    everything = np.arange(m)
    k = np.zeros(4 * n)
    middle = np.zeros(4 * n)
    own = np.zeros(m)  # the method's accelerations, inner then outer
    now = np.zeros(m)
    trial = np.zeros(4 * n)
    w = rotor.cage_speed
    gamma = 0.5 - am + af
    beta = 0.25 * (1.0 - am + af) ** 2
    calls = 0
    unsolved = 0
    for step in range(n_steps + 1):
        if step > 0:
            angle = start_angle + w * h * (step - af)
            for i in range(m):
                now[i] = own[i]
            solved = False
            for _ in range(12):
                for b in range(2):
                    for a in range(n):
                        i = b * n + a
                        r = 2 * b * n + a
                        trial[r] = (
                            y[r] + h * y[n + r] + h * h * ((0.5 - beta) * own[i] + beta * now[i])
                        )
                        trial[n + r] = y[n + r] + h * ((1.0 - gamma) * own[i] + gamma * now[i])
                for r in range(4 * n):
                    middle[r] = (1.0 - af) * trial[r] + af * y[r]
                rates_at(angle, middle, k, system, passage, work)
                calls += 1
                worst = 0.0
                size = 1e-300
                for b in range(2):
                    for a in range(n):
                        i = b * n + a
                        inverse = rotor.inverse_outer[a] if b else rotor.inverse_inner[a]
                        wanted = (1.0 - am) * now[i] + am * own[i]
                        residual[i] = (wanted - k[2 * b * n + n + a]) / inverse
                        worst = max(worst, abs(residual[i]))
                        size = max(size, abs(work.f[active[a]]) + abs(rotor.force[a]))
                if not math.isfinite(worst):
                    return max(step - 1, 0), calls, unsolved
                if worst <= 1e-10 * size:
                    solved = True
                    break
                place = Place(passage.c[0], passage.s[0], passage.d[0])
                energy_gradient_hessian(work.x, no_load, place, contacts, g, H)
                spring = (1.0 - af) * beta * h * h
                damper = (1.0 - af) * gamma * h
                for a in range(n):
                    for b in range(a + 1):
                        i, j = max(active[a], active[b]), min(active[a], active[b])
                        stiff = spring * H[i, j]
                        S[a, b] = stiff
                        S[n + a, n + b] = stiff
                        S[n + a, b] = -stiff
                        S[n + b, a] = -stiff
                    S[a, a] += (1.0 - am) / rotor.inverse_inner[a]
                    S[n + a, n + a] += (
                        (1.0 - am) / rotor.inverse_outer[a]
                        + spring * rotor.stiffness[a]
                        + damper * rotor.damping[a]
                    )
                newton_direction(S, residual, everything, 0.0, L, change)
                for i in range(m):
                    now[i] += change[i]
            if not solved:
                unsolved += 1
            for i in range(m):
                own[i] = now[i]
            for r in range(4 * n):
                y[r] = trial[r]
        rates_at(start_angle + w * h * step, y, k, system, passage, work)
        calls += 1
        if step == 0:
            for a in range(n):
                own[a] = k[n + a]
                own[n + a] = k[3 * n + a]
        record(history, step, y, k, rotor, work.f)
    return n_steps, calls, unsolved


@compiled
def static_states_cold(cage_angles, contacts, path, load):
    """States (n, 5) of `static_states` with each angle started afresh.

    With energy evaluations, and whether all met.
    """
    evaluations = 0
    met = True
    q = np.zeros((cage_angles.size, 5))
    for k in range(cage_angles.size):
        one = static_states(cage_angles[k : k + 1], contacts, path, load)
        q[k] = one[0][0]
        evaluations += one[7][0]
        met = met and one[4][0] == CONVERGED
    return q, evaluations, met
