"""What a force does to the two bodies."""

from __future__ import annotations

from bearingcore.kernels.compiling import inlined


@inlined
def accelerations(rotor, a, force, push, xo, vo):
    """Of inner and outer ring along active direction a (Eq. 18), the contacts pushing with `force`.

    push: what the unbalance pushes the inner ring with; xo, vo: displacement and velocity of the
    outer ring.
    """
    inner = (rotor.force[a] + push - force) * rotor.inverse_inner[a]
    outer = (force - rotor.stiffness[a] * xo - rotor.damping[a] * vo) * rotor.inverse_outer[a]
    return inner, outer
