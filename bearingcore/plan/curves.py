"""Plans of curves over the cage angle: load distribution, stiffness, natural frequencies."""

from __future__ import annotations

import math
import time

import numpy as np
from numpy.typing import NDArray

from bearingcore.plan.cage_angles import curves_of, place, swings
from bearingcore.plan.plans import (
    FULL_ANGLES,
    Offer,
    Plan,
    fewer_directions,
)
from bearingcore.scene.scene import Scene
from bearingcore.statics.equilibrium import Equilibrium, equilibrium

Array = NDArray[np.float64]


def plan_curves(scene: Scene, view: str, budget: float, began: float) -> Plan:
    nodes = place(scene, view, budget)
    planned = time.perf_counter()
    state = equilibrium(scene, nodes.angles)
    seconds = time.perf_counter() - planned
    full = scene.replace(dofs=scene.bearing.kind.directions)
    equal = np.linspace(nodes.angles[0], nodes.angles[-1], FULL_ANGLES)
    start = time.perf_counter()
    everything = equilibrium(full, equal)
    full_seconds = time.perf_counter() - start
    return Plan(
        scene=scene,
        view=view,
        error_budget=budget,
        dofs=scene.active_dofs,
        cage_angles=nodes.angles,
        step_rate=math.nan,
        tolerance=math.nan,
        duration=math.nan,
        drop=0.0,
        sample_rate=math.nan,
        orbit=None,
        predicted_error=nodes.predicted_error,
        met=nodes.met,
        evaluations=int(state.evaluations.sum()),
        seconds=seconds,
        full_evaluations=int(everything.evaluations.sum()),
        full_seconds=full_seconds,
        full_error=_equal_error(scene, view, state, equal),
        planning_seconds=planned - began,
        offers=_static_offers(scene, view, seconds),
    )


def _equal_error(scene: Scene, view: str, state: Equilibrium, equal: Array) -> float:
    """What lines between equally spaced angles miss of the curves at the placed ones."""
    values = curves_of(state, view)
    coarse = curves_of(equilibrium(scene, equal), view)
    lines = np.stack(
        [np.interp(state.cage_angles, equal, coarse[:, i]) for i in range(values.shape[1])], axis=1
    )
    error = np.abs(lines - values) / swings(values)
    return float(error[np.isfinite(error)].max(initial=0.0))


def _static_offers(scene: Scene, view: str, seconds: float) -> tuple[Offer, ...]:
    angles = np.linspace(0.0, scene.bearing.period, 13)
    truth = equilibrium(scene, angles)
    offers = []
    for fewer in fewer_directions(scene.active_dofs):
        state = equilibrium(scene, angles, fewer)
        both = truth.converged & state.converged
        if view == "modes" or not both.any():
            continue  # a mode less is not an error of a mode
        values = curves_of(truth, view)[both]
        error = np.abs(curves_of(state, view)[both] - values) / swings(values)
        offers.append(Offer(fewer, float(error.max()), seconds))
    return tuple(offers)
