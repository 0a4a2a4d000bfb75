"""Experiments on speed and accuracy as the page runs them: small enough to be waited for."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from bearing_explorer.results import compiling
from bearing_explorer.results.jobs import Work
from bearing_explorer.state.sentences import sentence_of
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
    """An experiment on offer: `label` for the form, `run` with a scene and a job."""

    label: str
    run: Callable[[Scene, Work], Experiment | StabilityChart]


TRIALS = {
    "motion": Trial(
        "Motion: methods",
        lambda scene, job: motion_experiment(
            scene,
            duration=0.1,
            methods=[name for name in METHODS if name not in STIFF],
            progress=job.progress,
            cancelled=job.cancelled,
        ),
    ),
    "stability": Trial(
        "Motion: stability",
        lambda scene, job: stability_chart(
            scene, duration=0.1, progress=job.progress, cancelled=job.cancelled
        ),
    ),
    "balls": Trial("Motion: balls with mass", lambda scene, job: _balls(scene, job)),
    "models": Trial(
        "Models",
        lambda scene, job: models_experiment(
            scene, duration=0.2, progress=job.progress, cancelled=job.cancelled
        ),
    ),
    "statics": Trial(
        "Statics: solvers",
        lambda scene, job: statics_experiment(
            scene, n_angles=31, progress=job.progress, cancelled=job.cancelled
        ),
    ),
    "angles": Trial(
        "Cage angles",
        lambda scene, job: angles_experiment(scene, progress=job.progress, cancelled=job.cancelled),
    ),
}
"""The experiments by name."""


@dataclass(frozen=True)
class Found:
    """Result of an experiment, and its scene."""

    scene: Scene
    result: Experiment | StabilityChart


def _balls(scene: Scene, job: Work) -> Experiment:
    if not compiling.ready():
        raise compiling.StillCompiling
    return balls_experiment(
        scene,
        duration=0.25,
        steps=(2, 3, 4, 8),
        progress=job.progress,
        cancelled=job.cancelled,
    )


def compute(job: Work, scene: Scene, name: str) -> str:
    """Run an experiment and show it. Runs in a job's thread."""
    started = time.perf_counter()
    try:
        result = TRIALS[name].run(scene, job)
    except ValueError as error:
        raise ValueError(sentence_of(error)) from error
    n = len(result.points if isinstance(result, Experiment) else result.trials)
    if not n:
        return "Nothing was measured yet."
    job.show(Found(scene, result))
    return f"{n} points after {time.perf_counter() - started:.1f} s."
