"""Accelerations of both rings, and the record of their motion."""

from __future__ import annotations

from bearingcore.model._kernels.compiling import inlined


@inlined
def accelerations(rotor, a, inner_force, outer_force, push, xo, vo):
    """Return the accelerations of inner and outer ring along active direction a (Eq. 18).

    inner_force, outer_force: force [N] of the contacts of each ring, as it acts on the outer ring;
    both are the same force for massless balls. push: force on the inner ring from unbalance and
    samples; xo, vo: displacement and velocity of the outer ring.
    """
    inner = (rotor.force[a] + push - inner_force) * rotor.inverse_inner[a]
    outer = (outer_force - rotor.stiffness[a] * xo - rotor.damping[a] * vo) * rotor.inverse_outer[a]
    return inner, outer


@inlined
def ring_accelerations(y, k, rotor, a, inner_force, outer_force, push):
    """Return `accelerations` at a state y with rate k; forces and push (5,) have all directions."""
    n = rotor.active.size
    d = rotor.active[a]
    return accelerations(
        rotor, a, inner_force[d], outer_force[d], push[d], y[2 * n + a], k[2 * n + a]
    )


@inlined
def record(history, sample, y, k, rotor, inner_force, outer_force, push):
    """Write displacements, velocities and accelerations of one instant into history[sample]."""
    n = rotor.active.size
    for a in range(n):
        inner, outer = ring_accelerations(y, k, rotor, a, inner_force, outer_force, push)
        history[sample, 0, a] = y[a]
        history[sample, 1, a] = k[a]
        history[sample, 2, a] = inner
        history[sample, 3, a] = y[2 * n + a]
        history[sample, 4, a] = k[2 * n + a]
        history[sample, 5, a] = outer
