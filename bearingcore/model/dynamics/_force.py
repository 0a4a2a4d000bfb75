"""A force on the inner ring that varies in time, as samples."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from bearingcore.common import Array, _checks as checks
from bearingcore.model.scene import DOF_NAMES, PackedMotion
from bearingcore.model.scene._packing import direction_numbers, length_units
from bearingcore.model.scene._scene import check_dofs

MOST = 1e12
"""Greatest force [N] or moment [N·m]; sums of squares of greater ones may overflow."""


@dataclass(frozen=True, eq=False)
class ForceSamples:
    """A force on the inner ring with the shaft, in addition to the load of the scene.

    The force is a straight line between samples. After the last one it falls to zero within one
    interval and stays there, so samples may end before the motion.

    Attributes
    ----------
    samples : (n, len(dofs)) [N, N·m]
        force along x, y and z, moments about rx and ry, the first sample at time 0; (n,) for one
        direction.
    sample_rate
        [Hz]
    dofs
        directions of the columns, names out of `DOF_NAMES`.

    Raises
    ------
    FieldError
        naming the field, its value and what is allowed.
    """

    samples: Array = field(repr=False)
    sample_rate: float
    dofs: tuple[str, ...] = ("x", "y")

    def __post_init__(self) -> None:
        checks.keep_number(self, "sample_rate", above=0.0, unit="Hz")
        check_dofs(self.dofs)
        dofs = (self.dofs,) if isinstance(self.dofs, str) else tuple(self.dofs)
        samples = checks.finite("samples", self.samples, "N, N·m", len(dofs))
        if (peak := float(np.abs(samples).max())) > MOST:
            raise checks.refuse("samples", f"up to {peak:.3g}", f"at most {MOST:g} N or N·m")
        samples.setflags(write=False)
        checks.keep(self, samples=samples, dofs=dofs)


def with_force(packed: PackedMotion, force: ForceSamples) -> PackedMotion:
    """Return the motion with a force added; FieldError if the scene does not move along it."""
    checks.instance("force", force, ForceSamples)
    if not set(force.dofs) <= set(packed.dofs):
        allowed = f"directions in which the scene moves: {', '.join(packed.dofs)}"
        raise checks.refuse("force", f"along {', '.join(force.dofs)}", allowed)
    samples = np.zeros((len(force.samples) + 1, len(DOF_NAMES)))
    units = length_units(packed.scene, force.dofs)
    samples[:-1, direction_numbers(force.dofs)] = force.samples / units
    per_radian = force.sample_rate / packed.scene.cage_speed
    rotor = packed.rotor._replace(samples=samples, samples_a_radian=per_radian)
    return replace(packed, rotor=rotor)


def peak_force(packed: PackedMotion) -> float:
    """Return the greatest size [N] of a motion's added force, with moments divided by r_d."""
    return float(np.linalg.norm(packed.rotor.samples, axis=1).max(initial=0.0))
