"""From a measured signal to the machine: which part is damaged, and how large the defect is."""

from bearingcore.diagnosis.part.combs import HARMONICS
from bearingcore.diagnosis.part.evidence import CANNOT_TELL, LIKELY, NONE_SEEN, EnvelopeLines
from bearingcore.diagnosis.part.listed import ListedBearing, explaining_bearings
from bearingcore.diagnosis.part.listened_signal import NARROWEST
from bearingcore.diagnosis.part.parts import INNER, OUTER, PARTS
from bearingcore.diagnosis.part.say import perhaps_a_ball
from bearingcore.diagnosis.part.status import DiagnosisStatus
from bearingcore.diagnosis.size.sizing_error import extent_error
from bearingcore.diagnosis.size.variants import Tolerances, variant
from bearingcore.diagnosis.trend import LINES, time_in

__all__ = [
    "CANNOT_TELL",
    "HARMONICS",
    "INNER",
    "LIKELY",
    "LINES",
    "NARROWEST",
    "NONE_SEEN",
    "OUTER",
    "PARTS",
    "DiagnosisStatus",
    "EnvelopeLines",
    "ListedBearing",
    "Tolerances",
    "explaining_bearings",
    "extent_error",
    "perhaps_a_ball",
    "time_in",
    "variant",
]
