"""The tangent of a motion: its derivative by the beginning, marched as columns beside it."""

from __future__ import annotations

import numpy as np

from bearingcore.model._kernels.compiling import called, inlined
from bearingcore.model._kernels.contact import approach, contact_load, seen_from_the_cage, tilting
from bearingcore.model._kernels.motion.planar import planar_slopes
from bearingcore.model._kernels.structs import PLANAR, Slopes


def new_slopes(size, whole):
    """Return empty work space for the tangent; states have `size` numbers, with it `whole`."""
    columns = whole // size - 1
    return Slopes(
        np.zeros((5, 5)),
        np.zeros((5, 5)),
        np.zeros((5, 5)),
        np.zeros(5),
        np.zeros(5),
        np.zeros(5),
        np.zeros(5),
        np.zeros((size // 2, columns)),
    )


@called
def march_tangent(k, instant, system, work):
    """Write the rate of the tangent into k, behind the rate of the state work.trial.

    k and work.trial hold the tangent (4 n, columns) behind the 4 n numbers of the state. Variables
    are smooth, because velocities jump when a ball touches, and so would their tangent.
    """
    rotor = system.rotor
    slopes = work.slopes
    size = 4 * rotor.active.size
    shape = (size, k.size // size - 1)
    tried = work.trial[size:].reshape(shape)
    if rotor.variables == PLANAR:
        planar_slopes(work.trial, work.passage, instant, rotor, system.contacts, slopes)
    else:
        swivelling_slopes(work.passage, instant, rotor, system.contacts, work.forces, slopes)
    tangent_rates(tried, k[size:].reshape(shape), rotor, slopes)


@called
def swivelling_slopes(passage, instant, rotor, contacts, work, slopes):
    """Write the derivatives by x and v of Σ δ e and the force into slopes.Sx, Px and Pv.

    Contacts swivel: de = t (t·dx)/A, dt = −e (t·dx)/A and dδ = dA = e·dx, with e along a contact
    and t across it, both as components along q. The rate of the contact angle is σ = (t·ṗ)/A, and
    e_turn and t_turn are the derivatives of e and t by the cage angle.
    """
    damping = rotor.contact_damping
    Sx = slopes.Sx
    Px = slopes.Px
    Pv = slopes.Pv
    e = slopes.e
    t = slopes.t
    e_turn = slopes.e_turn
    t_turn = slopes.t_turn
    for a in range(5):
        for b in range(5):
            Sx[a, b] = 0.0
            Px[a, b] = 0.0
            Pv[a, b] = 0.0
    relative_speed = 1.0
    w = rotor.cage_speed
    u = seen_from_the_cage(work.x, work.v, w)
    for i in range(work.touched[0]):
        j = work.touching[i]
        delta = work.contact[i, 0]
        er = work.contact[i, 1]
        ez = work.contact[i, 2]
        inverse_A = work.contact[i, 3]
        cj = passage.c[instant, j]
        sj = passage.s[instant, j]
        if contacts.relative_speed[j] != relative_speed:  # another row
            relative_speed = contacts.relative_speed[j]
            w = relative_speed * rotor.cage_speed
            u = seen_from_the_cage(work.x, work.v, w)
        r_rate, z_rate = approach(u, cj, sj, passage.d_rate[instant, j], j, contacts)
        directions_in_q(er, ez, cj, sj, tilting(er, ez, j, contacts), e, e_turn)
        directions_in_q(-ez, er, cj, sj, tilting(-ez, er, j, contacts), t, t_turn)
        _, Q, k1 = contact_load(delta, contacts.factor[j], contacts.exponent[j])
        sigma = inverse_A * (er * z_rate - ez * r_rate)
        along = er * r_rate + ez * z_rate
        k2 = Q * inverse_A
        damped = damping * delta * inverse_A
        for b in range(5):
            # derivative of the swivelling force c δ σ, which acts along −t
            swivel = damping * sigma * (1.0 - delta * inverse_A) * e[b] + damped * (
                w * t_turn[b] - along * inverse_A * t[b]
            )
            for a in range(5):
                # d(δ e)/dx, dp/dx and dp/dv, by the derivatives above
                Sx[a, b] += e[a] * e[b] + delta * inverse_A * t[a] * t[b]
                Px[a, b] += (
                    k1 * e[a] * e[b]
                    + (k2 * t[a] + damped * sigma * e[a]) * t[b]
                    - t[a] * swivel
                    - w * (damping * e_turn[a] * e[b] + damped * t_turn[a] * t[b])
                )
                Pv[a, b] -= damped * t[a] * t[b]


@inlined
def directions_in_q(er, ez, cj, sj, et, e, e_turn):
    """Write the components along q of (er, ez) to e, their derivatives by cage angle to e_turn."""
    e[0] = er * cj
    e[1] = er * sj
    e[2] = ez
    e[3] = et * sj
    e[4] = -et * cj
    e_turn[0] = -er * sj
    e_turn[1] = er * cj
    e_turn[2] = 0.0
    e_turn[3] = et * cj
    e_turn[4] = et * sj


@called
def tangent_rates(Y, kY, rotor, slopes):
    """Write the rate of the tangent Y (4 n, columns) into kY: derivatives of Eq. 18."""
    active = rotor.active
    n = active.size
    columns = Y.shape[1]
    damping = rotor.contact_damping
    rows = slopes.rows
    # of ẋ = w ∓ (c/m) S: first the rows of c dS, then of dẋ
    for a in range(n):
        for column in range(columns):
            rows[a, column] = 0.0
        for b in range(n):
            stiff = damping * slopes.Sx[active[a], active[b]]
            for column in range(columns):
                rows[a, column] += stiff * (Y[b, column] - Y[2 * n + b, column])
    for a in range(n):
        for column in range(columns):
            kY[a, column] = Y[n + a, column] - rotor.inverse_inner[a] * rows[a, column]
            kY[2 * n + a, column] = Y[3 * n + a, column] + rotor.inverse_outer[a] * rows[a, column]
            rows[n + a, column] = 0.0
    # of ẇ: first the rows of the force dp, which depends on x and ẋ, then of dẇ
    for a in range(n):
        for b in range(n):
            kx = slopes.Px[active[a], active[b]]
            kv = slopes.Pv[active[a], active[b]]
            for column in range(columns):
                rows[n + a, column] += kx * (Y[b, column] - Y[2 * n + b, column]) + kv * (
                    kY[b, column] - kY[2 * n + b, column]
                )
    for a in range(n):
        for column in range(columns):
            force = rows[n + a, column]
            kY[n + a, column] = -force * rotor.inverse_inner[a]
            kY[3 * n + a, column] = rotor.inverse_outer[a] * (
                force
                - rotor.stiffness[a] * Y[2 * n + a, column]
                - rotor.damping[a] * kY[2 * n + a, column]
            )
