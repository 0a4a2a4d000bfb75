"""Experiments on speed and accuracy as the page runs them: small enough to be waited for."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bearing_explorer.results import compiling
from bearing_explorer.results.jobs import Work
from bearingcore import Scene
from bearingcore.experiments import (
    Experiment,
    StabilityChart,
    angles_experiment,
    models_experiment,
    motion_experiment,
    stability_chart,
    statics_experiment,
)
from bearingcore.experiments.balls import balls_experiment
from bearingcore.experiments.integrators import METHODS

STIFF = ("scipy DOP853", "scipy Radau", "scipy BDF")
"""Methods that the page leaves out, as they would take most of its time."""


@dataclass(frozen=True)
class Trial:
    """An experiment on offer: its label in the form, its function, and how small it is here."""

    label: str
    experiment: Callable[..., Experiment | StabilityChart]
    size: Mapping[str, Any]

    def run(self, scene: Scene, job: Work) -> Experiment | StabilityChart:
        """The experiment on a scene."""
        if self.experiment is balls_experiment and not compiling.ready():
            raise compiling.StillCompiling
        return self.experiment(scene, **self.size, progress=job.progress, cancelled=job.cancelled)


_QUICK = [name for name in METHODS if name not in STIFF]
TRIALS = {
    "motion": Trial("Motion: methods", motion_experiment, {"duration": 0.1, "methods": _QUICK}),
    "stability": Trial("Motion: stability", stability_chart, {"duration": 0.1}),
    "balls": Trial(
        "Motion: balls with mass", balls_experiment, {"duration": 0.25, "steps": (2, 3, 4, 8)}
    ),
    "models": Trial("Models", models_experiment, {"duration": 0.2}),
    "statics": Trial("Statics: solvers", statics_experiment, {"n_angles": 31}),
    "angles": Trial("Cage angles", angles_experiment, {}),
}
"""The experiments by name."""


@dataclass(frozen=True)
class Found:
    """Result of an experiment, and its scene."""

    scene: Scene
    result: Experiment | StabilityChart


def compute(job: Work, scene: Scene, name: str) -> str:
    """Run an experiment and show it. Runs in a job's thread."""
    started = time.perf_counter()
    result = TRIALS[name].run(scene, job)
    n = len(result.points if isinstance(result, Experiment) else result.trials)
    if not n:
        return "Nothing was measured yet."
    job.show(Found(scene, result))
    return f"{n} points after {time.perf_counter() - started:.1f} s."
