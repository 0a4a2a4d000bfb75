"""Speed against accuracy: experiments whose points the charts draw.

Each experiment takes a scene, reports to a `Watch` and can be cancelled; `measure` runs all.
"""

from bearingcore.experiments.integrators import METHODS as METHODS
from bearingcore.experiments.measurements import MEASURED as MEASURED
from bearingcore.experiments.measurements import ORBITS as ORBITS
from bearingcore.experiments.measurements import STABILITY as STABILITY
from bearingcore.experiments.measurements import Measurements as Measurements
from bearingcore.experiments.measurements import measure as measure
from bearingcore.experiments.measurements import measurements_from as measurements_from
from bearingcore.experiments.orbits import OrbitAtSpeed as OrbitAtSpeed
from bearingcore.experiments.points import Experiment as Experiment
from bearingcore.experiments.points import Point as Point
from bearingcore.experiments.points import Reference as Reference
from bearingcore.experiments.references import MOTION_ERRORS as MOTION_ERRORS
from bearingcore.experiments.simpler_models import SPECTRUM as SPECTRUM
from bearingcore.experiments.simpler_models import Alternative as Alternative
from bearingcore.experiments.simpler_models import Alternatives as Alternatives
from bearingcore.experiments.simpler_models import alternatives as alternatives
from bearingcore.experiments.stability import DIVERGED as DIVERGED
from bearingcore.experiments.stability import StabilityChart as StabilityChart
from bearingcore.experiments.statics import HARD_CASES as HARD_CASES
from bearingcore.experiments.statics import STATIC_ERRORS as STATIC_ERRORS
