"""Experiments on speed against accuracy; the charts draw their points.

Each experiment takes a scene, reports to a `Watch` and can be cancelled; `measure` runs all.
"""

from bearingcore.model.experiments._integrators import METHODS
from bearingcore.model.experiments._measurements import (
    MEASURED,
    ORBITS,
    STABILITY,
    Machine,
    Measurements,
    measure,
    measurements_from,
)
from bearingcore.model.experiments._orbits import OrbitAtSpeed
from bearingcore.model.experiments._points import Experiment, Point, Reference
from bearingcore.model.experiments._references import MOTION_ERRORS
from bearingcore.model.experiments._simpler_models import (
    SPECTRUM,
    Alternative,
    Alternatives,
    alternatives,
)
from bearingcore.model.experiments._stability import DIVERGED, StabilityChart
from bearingcore.model.experiments._statics import HARD_CASES, STATIC_ERRORS

__all__ = [
    "DIVERGED",
    "HARD_CASES",
    "MEASURED",
    "METHODS",
    "MOTION_ERRORS",
    "ORBITS",
    "SPECTRUM",
    "STABILITY",
    "STATIC_ERRORS",
    "Alternative",
    "Alternatives",
    "Experiment",
    "Machine",
    "Measurements",
    "OrbitAtSpeed",
    "Point",
    "Reference",
    "StabilityChart",
    "alternatives",
    "measure",
    "measurements_from",
]
