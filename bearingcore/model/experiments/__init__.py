"""Experiments on speed against accuracy; the charts draw their points.

Each experiment takes a scene, reports to a `Watch` and can be cancelled; `measure` runs all.
"""

from bearingcore.model.experiments._integrators import METHODS as METHODS
from bearingcore.model.experiments._measurements import (
    MEASURED as MEASURED,
    ORBITS as ORBITS,
    STABILITY as STABILITY,
    Machine as Machine,
    Measurements as Measurements,
    measure as measure,
    measurements_from as measurements_from,
)
from bearingcore.model.experiments._orbits import OrbitAtSpeed as OrbitAtSpeed
from bearingcore.model.experiments._points import (
    Experiment as Experiment,
    Point as Point,
    Reference as Reference,
)
from bearingcore.model.experiments._references import MOTION_ERRORS as MOTION_ERRORS
from bearingcore.model.experiments._simpler_models import (
    SPECTRUM as SPECTRUM,
    Alternative as Alternative,
    Alternatives as Alternatives,
    alternatives as alternatives,
)
from bearingcore.model.experiments._stability import (
    DIVERGED as DIVERGED,
    StabilityChart as StabilityChart,
)
from bearingcore.model.experiments._statics import (
    HARD_CASES as HARD_CASES,
    STATIC_ERRORS as STATIC_ERRORS,
)
