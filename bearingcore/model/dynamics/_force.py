"""A force in time on the moving ring, given as samples."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from bearingcore.common import Array, _checks as checks
from bearingcore.model.scene import DOF_NAMES, PackedMotion
from bearingcore.model.scene._packing import direction_numbers, length_units


@dataclass(frozen=True, eq=False)
class ForceSamples:
    """A force on the inner ring with the shaft, beside the load of the scene.

    The force is a straight line between samples. After the last one it falls to zero within one
    interval and stays there, so samples may be fewer than the motion lasts.

    Attributes
    ----------
    samples : (n, len(directions)) [N, N·m]
        force along x, y and z, moments about rx and ry; (n,) for one direction. The first sample is
        at time 0.
    sample_rate
        [Hz]
    directions
        of the columns, names out of `DOF_NAMES`.

    Raises
    ------
    FieldError
        naming the field, its value and what is allowed.
    """

    samples: Array = field(repr=False)
    sample_rate: float
    directions: tuple[str, ...] = ("x", "y")

    def __post_init__(self) -> None:
        checks.keep_number(self, "sample_rate", above=0.0, unit="Hz")
        given = self.directions
        names = (given,) if isinstance(given, str) else tuple(given)
        if not names or len(set(names)) != len(names) or not set(names) <= set(DOF_NAMES):
            allowed = f"different names out of {', '.join(DOF_NAMES)}"
            raise checks.refuse("directions", given, allowed)
        samples = checks.finite("samples", self.samples, "N, N·m", len(names))
        samples.setflags(write=False)
        checks.keep(self, samples=samples, directions=names)


def with_force(packed: PackedMotion, force: ForceSamples) -> PackedMotion:
    """Return the motion with a force in time.

    Raises
    ------
    FieldError
        for a direction in which the scene does not move.
    """
    checks.instance("force", force, ForceSamples)
    for name in force.directions:
        if name not in packed.dofs:
            allowed = f"directions in which the scene moves: {', '.join(packed.dofs)}"
            raise checks.refuse("force", f"along {name}", allowed)
    samples = np.zeros((len(force.samples) + 1, len(DOF_NAMES)))
    units = length_units(packed.scene, force.directions)
    samples[:-1, direction_numbers(force.directions)] = force.samples / units
    a_radian = force.sample_rate / packed.scene.cage_speed
    rotor = packed.rotor._replace(samples=samples, samples_a_radian=a_radian)
    return replace(packed, rotor=rotor)


def peak_force(packed: PackedMotion) -> float:
    """Greatest size [N] of a motion's force in time, moments over r_d."""
    return float(np.linalg.norm(packed.rotor.samples, axis=1).max(initial=0.0))
