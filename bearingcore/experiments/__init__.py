"""Speed against accuracy: experiments whose points the charts draw.

Each experiment takes a scene, tells its progress and can be cancelled; see `points`.
"""

from bearingcore.experiments.models import models_experiment
from bearingcore.experiments.motions import motion_experiment
from bearingcore.experiments.orders import Order, measured_orders, order_table
from bearingcore.experiments.points import Experiment, Point, Reference
from bearingcore.experiments.stability import (
    EnergyDrift,
    StabilityChart,
    Trial,
    energy_drifts,
    linear_limits,
    stability_chart,
)
from bearingcore.experiments.statics import angles_experiment, statics_experiment

__all__ = [
    "EnergyDrift",
    "Experiment",
    "Order",
    "Point",
    "Reference",
    "StabilityChart",
    "Trial",
    "angles_experiment",
    "energy_drifts",
    "linear_limits",
    "measured_orders",
    "models_experiment",
    "motion_experiment",
    "order_table",
    "stability_chart",
    "statics_experiment",
]
