"""A scene with its extent and what is known only roughly about it changed."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.dynamics.damping import contact_damping
from bearingcore.scene.scene import Scene


@dataclass(frozen=True)
class Tolerances:
    """Uncertainty of a scene: standard deviations of natural logarithms of its numbers.

    0.1 says: right within 10 % in two cases of three. 0 holds a number fast.
    """

    stiffness: float = 0.07
    load_deflection_factor: float = 0.07
    load: float = 0.12
    damping: float = 0.4
    depth: float = 0.2

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):
            value = checks.real_number(
                field.name, getattr(self, field.name), at_least=0.0, at_most=2.0
            )
            object.__setattr__(self, field.name, value)

    @property
    def spread(self) -> NDArray[np.float64]:
        """The standard deviations, in the order of the fields."""
        return np.array(dataclasses.astuple(self))


def variant(scene: Scene, extent: float, edge: str, exponents: NDArray[np.float64]) -> Scene:
    """`scene` with a defect of `extent` [rad] and `edge`, and its numbers times exp(exponents).

    `exponents` are in the order of the fields of `Tolerances`.
    """
    stiffness, factor, load, damping, depth = (math.exp(x) for x in exponents)
    (defect,) = scene.defects
    bearing, support, loads = scene.bearing, scene.support, scene.load
    return dataclasses.replace(
        scene,
        bearing=dataclasses.replace(
            bearing, load_deflection_factor=bearing.load_deflection_factor * factor
        ),
        defect=dataclasses.replace(
            defect,
            extent=extent,
            edge=edge,
            depth=min(defect.depth * depth, bearing.ball_radius),
        ),
        load=dataclasses.replace(
            loads, **{f.name: getattr(loads, f.name) * load for f in dataclasses.fields(loads)}
        ),
        support=dataclasses.replace(
            support,
            **{
                f.name: getattr(support, f.name) * (stiffness if "stiffness" in f.name else damping)
                for f in dataclasses.fields(support)
                if f.name.startswith(("stiffness", "damping"))
                and getattr(support, f.name) is not None
            },
        ),
        contact_damping=contact_damping(scene) * damping,
    )


def system_variant(
    system: kernels.System, row: NDArray[np.float64], exponents: NDArray[np.float64]
) -> kernels.System:
    """System of a `variant` for the kernels, from that of its scene: a tenth of the time.

    `row` describes the defect, see `kernels.PATH_COLUMNS`. A static load goes with the same factor
    as the rotor's force, exp(exponents[2]).
    """
    stiffness, factor, load, damping, _ = (math.exp(x) for x in exponents.tolist())
    rotor, contacts = system.rotor, system.contacts
    return kernels.System(
        rotor._replace(
            force=rotor.force * load,
            stiffness=rotor.stiffness * stiffness,
            damping=rotor.damping * damping,
            contact_damping=rotor.contact_damping * damping,
        ),
        contacts._replace(factor=contacts.factor * factor),
        kernels.Path(row[None], system.path.tables),
    )
