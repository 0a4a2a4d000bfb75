"""A scene with its extent and what is known only roughly about it changed."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.diagnosis.size.path_fit import DIRECT, PathModel
from bearingcore.dynamics.damping import contact_damping
from bearingcore.scene.scene import Scene

PATHS = (PathModel(0.6, 1.5e-3, 0.3, 9.0),)
"""Paths that are tried after none. They cost so much as a path explains other extents as well: an
extent that needs none to be explained fairly is the likelier one."""


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


@dataclass(frozen=True)
class PathTolerances:
    """Effects between the motion of the bearing and its measurement, each switchable.

    Attributes
    ----------
    wandering_cage
        the cage's speed wanders: it is followed by the ball passes themselves.
    resonances
        between housing and sensor something rings: a path is fitted with each extent.
    coloured_noise
        noise is louder at some frequencies: harmonics count by the noise that they carry.
    shaft_tones
        clear tones of the shaft are taken out.
    strikes
        balls strike the far edge and make more ring than the rings: what happens there counts less.
    """

    wandering_cage: bool = True
    resonances: bool = True
    coloured_noise: bool = True
    shaft_tones: bool = True
    strikes: bool = True

    @property
    def models(self) -> tuple[PathModel, ...]:
        """Paths that are tried in turn: the sensor on the housing first."""
        found = [DIRECT]
        for path in PATHS:
            one = PathModel(
                path.strength if self.resonances else 0.0,
                path.ringing if self.resonances else 0.0,
                path.strike if self.strikes else 0.0,
                path.cost,
            )
            if not one.direct:
                found.append(one)
        return tuple(found)


STEADY = PathTolerances(False, False, False, False, False)
"""A sensor on the housing itself, of a machine whose cage turns steadily."""


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
