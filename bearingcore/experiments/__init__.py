"""Speed against accuracy: experiments whose points the charts draw.

Each experiment takes a scene; `measure` runs all.
"""

from bearingcore.experiments.integrators import METHODS as METHODS
from bearingcore.experiments.measurements import Measurements as Measurements
from bearingcore.experiments.measurements import measure as measure
from bearingcore.experiments.measurements import measurements_from as measurements_from
from bearingcore.experiments.points import Experiment as Experiment
from bearingcore.experiments.points import Point as Point
from bearingcore.experiments.points import Reference as Reference
from bearingcore.experiments.references import MOTION_ERRORS as MOTION_ERRORS
from bearingcore.experiments.simpler_models import SPECTRUM as SPECTRUM
from bearingcore.experiments.simpler_models import Alternative as Alternative
from bearingcore.experiments.simpler_models import Alternatives as Alternatives
from bearingcore.experiments.simpler_models import alternatives as alternatives
from bearingcore.experiments.statics import HARD_CASES as HARD_CASES
from bearingcore.experiments.statics import STATIC_ERRORS as STATIC_ERRORS
