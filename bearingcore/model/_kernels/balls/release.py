"""Release of contacts whose damper would pull, until they would push again. See `motion`."""

from __future__ import annotations

from bearingcore.model._kernels.balls.contacts import (
    find_contacts,
    planar_contacts,
    planar_push,
    push_contacts,
    ring_state,
)
from bearingcore.model._kernels.balls.structs import INNER
from bearingcore.model._kernels.compiling import called
from bearingcore.model._kernels.contact import tilting
from bearingcore.model._kernels.structs import PLANAR


@called
def change_variable(y, race, j, sign, passage, instant, system, work):
    """Take c δ e/m of a contact out of w of ring and ball in the state y; with sign −1 put it in.

    w is v with these parts of all contacts, see `motion`; v does not change.
    """
    rotor = system.rotor
    contacts = system.contacts
    races = system.races
    active = rotor.active
    n = active.size
    n_balls = contacts.angle.size
    planar = rotor.variables == PLANAR
    cj = passage.c[instant, j]
    sj = passage.s[instant, j]
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


@called
def locate_contacts(y, passage, inner, instant, system, work):
    """Write the contacts at the state y into work, which holds the rings' displacements already."""
    first = 4 * system.rotor.active.size
    if system.rotor.variables == PLANAR:
        planar_contacts(y, first, passage, inner, instant, system, work)
    else:
        find_contacts(y, first, passage, inner, instant, system, work)


@called
def true_forces(k, passage, inner, instant, system, work):
    """Write Σ (Q + c δ̇) e (Eq. 18) of both rings into work.f, for the contacts in work."""
    first = 4 * system.rotor.active.size
    if system.rotor.variables == PLANAR:
        planar_push(k, first, passage, inner, instant, system, work)
    else:
        push_contacts(k, first, passage, inner, instant, system, work, False)


@called
def update_released(y, k, passage, inner, instant, system, work):
    """Release contacts whose damper would pull, and take up those that push again.

    work holds the contacts at y as `ball_rates` left them, and is overwritten. Returns True if any
    contact changed; then the rates have changed too.
    """
    released = work.released
    before = work.before
    changed = False
    any_before = False
    n_balls = released.shape[1]
    # Release: `true_forces` gives a contact that would pull a negative δ.
    true_forces(k, passage, inner, instant, system, work)
    for race in range(2):
        for j in range(n_balls):
            before[race, j] = released[race, j]
            any_before = any_before or released[race, j]
            # earlier releases are taken back here and tested below, as if they pushed
            released[race, j] = not released[race, j] and work.contact[race, j, 0] < 0.0
            if released[race, j]:
                change_variable(y, race, j, 1.0, passage, instant, system, work)
                changed = True
    if not any_before:
        return changed
    # Take up: an earlier release stays while its contact is compressed and would still pull.
    locate_contacts(y, passage, inner, instant, system, work)
    true_forces(k, passage, inner, instant, system, work)
    for race in range(2):
        for j in range(n_balls):
            if not before[race, j]:
                continue
            if work.contact[race, j, 0] < 0.0:
                released[race, j] = True
            elif work.contact[race, j, 0] > 0.0:
                change_variable(y, race, j, -1.0, passage, instant, system, work)
                changed = True
    return changed


@called
def smooth_start(y, passage, inner, system, work):
    """Turn the velocities in y into w; each compressed contact counts as pushing."""
    ring_state(y, system.rotor, work.x)
    locate_contacts(y, passage, inner, 0, system, work)
    for race in range(2):
        for j in range(system.contacts.angle.size):
            if work.contact[race, j, 0] > 0.0:
                change_variable(y, race, j, -1.0, passage, 0, system, work)
