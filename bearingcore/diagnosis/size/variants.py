"""A scene with its extent and what is known only roughly about it changed: another machine."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from bearingcore.dynamics.damping import contact_damping
from bearingcore.scene.scene import Scene

SPREAD = np.array([0.07, 0.07, 0.12, 0.4, 0.2])
"""Standard deviations (5,) of natural logarithms of what is said of a machine: stiffness of its
support, load-deflection factor, load, damping, and depth of its defect."""


def variant(scene: Scene, extent: float, edge: str, exponents: NDArray[np.float64]) -> Scene:
    """`scene` with a defect of `extent` [rad] and `edge`, and its numbers times exp(exponents).

    `exponents` are in the order of `SPREAD`.
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
