"""Speed against accuracy: experiments whose points the charts draw.

Each experiment takes a scene, reports to a `Watch` and can be cancelled; `measure` runs all.
"""

from bearingcore.experiments.measurements import (
    Machine,
    Measurements,
    measure,
    measurements_from,
)
from bearingcore.experiments.models import models_experiment
from bearingcore.experiments.motions import motion_experiment
from bearingcore.experiments.points import Experiment, Point, Reference, Watch
from bearingcore.experiments.stability import (
    OrbitAtSpeed,
    StabilityChart,
    Trial,
    linear_limits,
    orbits_over_speed,
    stability_chart,
)
from bearingcore.experiments.statics import angles_experiment, statics_experiment

__all__ = [
    "Experiment",
    "Machine",
    "Measurements",
    "OrbitAtSpeed",
    "Point",
    "Reference",
    "StabilityChart",
    "Trial",
    "Watch",
    "angles_experiment",
    "linear_limits",
    "measure",
    "measurements_from",
    "models_experiment",
    "motion_experiment",
    "orbits_over_speed",
    "stability_chart",
    "statics_experiment",
]
