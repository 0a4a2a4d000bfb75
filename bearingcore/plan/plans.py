"""What a plan says: what was chosen, the error to expect and what it costs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.numbers import count, decibels, number, percent, scientific, with_prefix
from bearingcore.common.table import ResultTable, table_of
from bearingcore.dynamics.adaptive import simulate_adaptive
from bearingcore.dynamics.motion import Motion, simulate
from bearingcore.dynamics.orbit import Orbit
from bearingcore.plan.cage_angles import CURVES
from bearingcore.scene.scene import DOF_NAMES, Scene
from bearingcore.statics.equilibrium import Equilibrium, equilibrium

Array = NDArray[np.float64]

VIBRATION, SETTLED = "vibration", "settled vibration"

VIEWS = (*CURVES, VIBRATION, SETTLED)
"""What a plan can be for: curves over the cage angle (ball loads, stiffness, natural frequencies),
the housing's motion from rest with its spectrum, and the spectrum it settles to."""

BUDGETS = {"load": 5e-3, "stiffness": 5e-3, "modes": 5e-3, VIBRATION: 0.05, SETTLED: 0.1}
"""Error budgets that nobody sees on a screen: for curves the greatest error over the swing (see
`cage_angles`), for vibration the greatest error of the spectrum [dB]."""

FULL_ANGLES, FULL_RATE = 361, 65536.0
"""What a plan is compared with: all five directions, a degree apart, 65,536 steps a second."""


@dataclass(frozen=True)
class Offer:
    """Fewer directions than a scene needs, with the error that they bring; never taken unasked."""

    dofs: tuple[str, ...]
    error: float
    """measured, in the unit of the budget"""
    seconds: float
    """predicted cost [s]"""


@dataclass(frozen=True)
class Plan:
    """How to compute one view of one scene.

    Attributes
    ----------
    scene
        with its directions as planned.
    view, error_budget
        what for, and how well: see VIEWS and BUDGETS.
    dofs
        directions that move.
    cage_angles : (n,) [rad] or None
        for curves.
    step_rate, tolerance
        for motions: steps a second [Hz] where they are fixed, or the tolerance of steps that
        choose themselves; the other one is NaN.
    duration, drop
        of motions: how long [s], and how much of it at the beginning is transient to be dropped.
    sample_rate
        [Hz] of motions.
    orbit
        the stable orbit that stands for a settled motion, already found; None for a march.
    predicted_error, met
        in the unit of the budget, and whether it is within it.
    evaluations, seconds
        predicted cost: evaluations of all contacts, and time [s] on this machine as measured.
    full_evaluations, full_seconds
        the same of the full model: all five directions where the support is known along them,
        FULL_ANGLES equally spaced angles or FULL_RATE steps a second, marched.
    full_error
        what the full model's equally spaced angles miss, or 65,536 steps a second.
    planning_seconds
        [s] it took to find this plan.
    offers
        fewer directions, with their errors.
    note
        why something was chosen against expectation; empty else.
    """

    scene: Scene
    view: str
    error_budget: float
    dofs: tuple[str, ...]
    cage_angles: Array | None = field(repr=False, compare=False)
    step_rate: float
    tolerance: float
    duration: float
    drop: float
    sample_rate: float
    orbit: Orbit | None = field(repr=False, compare=False)
    predicted_error: float
    met: bool
    evaluations: int
    seconds: float
    full_evaluations: int
    full_seconds: float
    full_error: float
    planning_seconds: float
    offers: tuple[Offer, ...] = ()
    note: str = ""

    def table(self) -> ResultTable:
        """One row: what for, how, what it should miss and cost, and the same of the full model."""
        return plans_table([self])

    @property
    def method(self) -> str:
        """One of "static", "orbit", "fixed steps" and "adaptive steps"."""
        if self.cage_angles is not None:
            return "static"
        if self.orbit is not None:
            return "orbit"
        return "fixed steps" if math.isnan(self.tolerance) else "adaptive steps"

    def run(self) -> Equilibrium | Motion | Orbit:
        """What was planned: static states, a motion, or the orbit."""
        if self.cage_angles is not None:
            return equilibrium(self.scene, self.cage_angles)
        if self.orbit is not None:
            return self.orbit
        if self.method == "adaptive steps":
            return simulate_adaptive(
                self.scene, self.duration, self.sample_rate, tolerance=self.tolerance
            )
        return simulate(self.scene, self.duration, self.sample_rate, step_rate=self.step_rate)

    def sentence(self) -> str:
        """In a line: what was chosen, its cost and error, and the full model's."""
        parts = [f"{len(self.dofs)} DOF"]
        if self.cage_angles is not None:
            parts.append(f"{len(self.cage_angles)} cage angles")
            error = f"error {percent(self.predicted_error, 2)}"
            full = f"{FULL_ANGLES} equally spaced angles {_duration(self.full_seconds)}"
            full += f", error {percent(self.full_error, 2)}"
        else:
            fixed = with_prefix(self.step_rate, "Hz")
            adaptive = f"adaptive steps at {scientific(self.tolerance)}"
            parts.append(adaptive if self.method == "adaptive steps" else fixed)
            if self.orbit is not None:
                parts.append(count(self.orbit.ball_passes, "ball pass", "ball passes"))
            else:
                parts.append(f"{number(self.duration)} s")
            error = _error(self.predicted_error)
            full = f"full model {_duration(self.full_seconds)}"
            if not math.isnan(self.full_error):
                full += f", {_error(self.full_error)}"
        text = f"this scene: {', '.join(parts)}: {_duration(self.seconds)}, {error}; {full}"
        if not self.met:
            text += "; the budget is not met"
        return f"{text}; {self.note}" if self.note else text


def _duration(seconds: float) -> str:
    return f"{number(1e3 * seconds, 2)} ms" if seconds < 1.0 else f"{number(seconds, 2)} s"


def _error(level: float) -> str:
    """An error of a spectrum; where a motion did not stay finite there is none to tell."""
    return f"error {decibels(level)}" if math.isfinite(level) else "error not known"


def fewer_directions(dofs: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Smaller sets of directions that keep x and y."""
    return [DOF_NAMES[:n] for n in (2, 3) if n < len(dofs) and set(DOF_NAMES[:n]) <= set(dofs)]


def plans_table(plans: Sequence[Plan]) -> ResultTable:
    """A row a plan: what for, how, what it should miss and cost, and the same of the full model."""

    def all_of(name: str) -> list[float]:
        return [float(getattr(plan, name)) for plan in plans]

    return table_of(
        ("view", "", [plan.view for plan in plans]),
        ("directions", "", [" ".join(plan.dofs) for plan in plans]),
        ("method", "", [plan.method for plan in plans]),
        ("step_rate", "Hz", all_of("step_rate")),
        ("tolerance", "1", all_of("tolerance")),
        ("predicted_error", "", all_of("predicted_error"), "in the unit of the budget"),
        ("error_budget", "", all_of("error_budget"), "in the unit of the view's budget"),
        ("evaluations", "", all_of("evaluations"), "of all contacts"),
        ("full_error", "", all_of("full_error"), "of the full model, in the unit of the budget"),
        ("full_evaluations", "", all_of("full_evaluations")),
        ("time", "s", all_of("seconds")),
        ("full_time", "s", all_of("full_seconds")),
        ("planning_time", "s", all_of("planning_seconds")),
    )
