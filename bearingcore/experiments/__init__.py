"""Speed against accuracy: experiments whose points the charts draw.

Each experiment takes a scene, reports its progress and can be cancelled; see `points`.
"""

from bearingcore.experiments.models import models_experiment
from bearingcore.experiments.motions import motion_experiment
from bearingcore.experiments.points import Experiment, Point, Reference
from bearingcore.experiments.stability import StabilityChart, Trial, linear_limits, stability_chart
from bearingcore.experiments.statics import angles_experiment, statics_experiment

__all__ = [
    "Experiment",
    "Point",
    "Reference",
    "StabilityChart",
    "Trial",
    "angles_experiment",
    "linear_limits",
    "models_experiment",
    "motion_experiment",
    "stability_chart",
    "statics_experiment",
]
