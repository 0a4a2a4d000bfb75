"""Speed against accuracy: experiments whose points the charts draw.

Each experiment takes a scene, reports to a `Watch` and can be cancelled; `measure` runs all.
"""

from bearingcore.experiments.balls import BALL_ERRORS
from bearingcore.experiments.integrators import METHODS
from bearingcore.experiments.measurements import (
    MEASURED,
    ORBITS,
    STABILITY,
    Measurements,
    measure,
    measurements_from,
)
from bearingcore.experiments.models import EXACT, FULL, MODEL_ERRORS, SETTLED
from bearingcore.experiments.motions import motion_experiment
from bearingcore.experiments.points import Experiment, Point, Reference
from bearingcore.experiments.references import MOTION_ERRORS
from bearingcore.experiments.simpler_models import SPECTRUM, Alternative, Alternatives, alternatives
from bearingcore.experiments.stability import FIXED_STEP, VERDICTS, OrbitAtSpeed, StabilityChart
from bearingcore.experiments.statics import ANGLE_ERRORS, HARD_CASES, STATIC_ERRORS

__all__ = [
    "ANGLE_ERRORS",
    "BALL_ERRORS",
    "EXACT",
    "FIXED_STEP",
    "FULL",
    "HARD_CASES",
    "MEASURED",
    "METHODS",
    "MODEL_ERRORS",
    "MOTION_ERRORS",
    "ORBITS",
    "SETTLED",
    "SPECTRUM",
    "STABILITY",
    "STATIC_ERRORS",
    "VERDICTS",
    "Alternative",
    "Alternatives",
    "Experiment",
    "Measurements",
    "OrbitAtSpeed",
    "Point",
    "Reference",
    "StabilityChart",
    "alternatives",
    "measure",
    "measurements_from",
    "motion_experiment",
]
