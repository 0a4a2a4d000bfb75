"""From a measured signal to the machine: which part is damaged."""

from bearingcore.diagnosis.part.combs import HARMONICS as HARMONICS
from bearingcore.diagnosis.part.diagnose import SLIP as SLIP
from bearingcore.diagnosis.part.evidence import CANNOT_TELL as CANNOT_TELL
from bearingcore.diagnosis.part.evidence import LIKELY as LIKELY
from bearingcore.diagnosis.part.evidence import NONE_SEEN as NONE_SEEN
from bearingcore.diagnosis.part.evidence import EnvelopeLines as EnvelopeLines
from bearingcore.diagnosis.part.listed import ListedBearing as ListedBearing
from bearingcore.diagnosis.part.listed import explaining_bearings as explaining_bearings
from bearingcore.diagnosis.part.listened_signal import NARROWEST as NARROWEST
from bearingcore.diagnosis.part.parts import INNER as INNER
from bearingcore.diagnosis.part.parts import OUTER as OUTER
from bearingcore.diagnosis.part.parts import PARTS as PARTS
from bearingcore.diagnosis.part.say import perhaps_a_ball as perhaps_a_ball
from bearingcore.diagnosis.part.status import DiagnosisStatus as DiagnosisStatus
