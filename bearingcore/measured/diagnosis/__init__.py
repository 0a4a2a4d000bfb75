"""Diagnosis of the damaged part of a bearing from a measured signal."""

from bearingcore.measured.diagnosis._diagnose_files import (
    FolderDiagnosis as FolderDiagnosis,
    diagnose as diagnose,
)
from bearingcore.measured.diagnosis._extent.knocks import (
    ExtentStatus as ExtentStatus,
    Knocks as Knocks,
    MeanPass as MeanPass,
    Pair as Pair,
    find_knocks as find_knocks,
)
from bearingcore.measured.diagnosis._part.combs import HARMONICS as HARMONICS, LOUDEST as LOUDEST
from bearingcore.measured.diagnosis._part.diagnose import SLIP as SLIP
from bearingcore.measured.diagnosis._part.evidence import (
    CANNOT_TELL as CANNOT_TELL,
    LIKELY as LIKELY,
    NONE_SEEN as NONE_SEEN,
    Diagnosis as Diagnosis,
    EnvelopeLines as EnvelopeLines,
    PartEvidence as PartEvidence,
)
from bearingcore.measured.diagnosis._part.listened_signal import NARROWEST as NARROWEST
from bearingcore.measured.diagnosis._part.over_turns import (
    resample_to_steady_speed as resample_to_steady_speed,
    speed_over_time as speed_over_time,
)
from bearingcore.measured.diagnosis._part.parts import (
    INNER as INNER,
    OUTER as OUTER,
    PARTS as PARTS,
    PartLines as PartLines,
    part_lines as part_lines,
)
from bearingcore.measured.diagnosis._part.say import perhaps_a_ball as perhaps_a_ball
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus as DiagnosisStatus
