"""Diagnosis of the damaged part of a bearing from a measured signal."""

from bearingcore.measured.diagnosis._extent.knocks import Knocks, MeanPass, Pair, Seen, find_knocks
from bearingcore.measured.diagnosis._of_files import FolderDiagnosis, diagnose
from bearingcore.measured.diagnosis._part.combs import HARMONICS
from bearingcore.measured.diagnosis._part.diagnose import MOST_SAMPLES, SLIP
from bearingcore.measured.diagnosis._part.evidence import (
    CANNOT_TELL,
    LIKELY,
    NONE_SEEN,
    Diagnosis,
    EnvelopeLines,
    PartEvidence,
)
from bearingcore.measured.diagnosis._part.listed import ListedBearing, explaining_bearings
from bearingcore.measured.diagnosis._part.listened_signal import NARROWEST
from bearingcore.measured.diagnosis._part.parts import INNER, OUTER, PARTS, PartLines, part_lines
from bearingcore.measured.diagnosis._part.say import perhaps_a_ball
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus

__all__ = [
    "CANNOT_TELL",
    "HARMONICS",
    "INNER",
    "LIKELY",
    "MOST_SAMPLES",
    "NARROWEST",
    "NONE_SEEN",
    "OUTER",
    "PARTS",
    "SLIP",
    "Diagnosis",
    "DiagnosisStatus",
    "EnvelopeLines",
    "FolderDiagnosis",
    "Knocks",
    "ListedBearing",
    "MeanPass",
    "Pair",
    "PartEvidence",
    "PartLines",
    "Seen",
    "diagnose",
    "explaining_bearings",
    "find_knocks",
    "part_lines",
    "perhaps_a_ball",
]
