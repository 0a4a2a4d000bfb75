"""Outcomes of a diagnosis of the damaged part."""

from __future__ import annotations

from bearingcore.errors import Status


class DiagnosisStatus(Status):
    """The outcome of a diagnosis of the damaged part."""

    PART_NAMED = "part named"
    NONE_SEEN = "none seen"
    PERHAPS_A_BALL = "race's lines, perhaps by a ball"
    ALIKE = "parts alike"
    UNMODULATED = "lines without modulation"
    MAGNETIC = "like magnetic noise"
    NOT_ALONE = "not alone"
    FAINT = "faint lines"
    OTHER_SOURCE = "other source"
    IRREGULAR = "irregular knocks"
    DROPPED_OUT = "dropped out"
    CLIPPED = "clipped"
    INSENSITIVE = "too short to exclude damage"
    TOO_SHORT = "too short"
    TOO_COARSE = "sampled too slowly"
    TOO_LONG = "too many samples"
    SPEED_OPEN = "shaft speed open"
    BEARING_OPEN = "bearing open"

    @property
    def sentence(self) -> str:
        """The status as a sentence."""
        return _SENTENCES[self]


_SENTENCES = {
    DiagnosisStatus.PART_NAMED: "The lines of one part stand out as those of damage do.",
    DiagnosisStatus.NONE_SEEN: "No lines of a part show; lines of damage would have.",
    DiagnosisStatus.PERHAPS_A_BALL: (
        "The lines of a race are there, but faint: a damaged ball or a healthy bearing "
        "may make them."
    ),
    DiagnosisStatus.ALIKE: "The lines of both races show, neither much stronger.",
    DiagnosisStatus.UNMODULATED: (
        "Impacts repeat at the rate of a part that turns, but are not modulated by its turning."
    ),
    DiagnosisStatus.MAGNETIC: (
        "Lines of a part show at twice the mains frequency, where magnetic noise of a motor has "
        "its own."
    ),
    DiagnosisStatus.NOT_ALONE: "Lines of a part show, but others are as strong.",
    DiagnosisStatus.FAINT: "Lines of a part show, but too faint to be sure.",
    DiagnosisStatus.OTHER_SOURCE: "Something repeats that is no line of this bearing.",
    DiagnosisStatus.IRREGULAR: "There are impacts, but not at the rate of any part.",
    DiagnosisStatus.DROPPED_OUT: "Parts of the signal dropped out, which may hide damage.",
    DiagnosisStatus.CLIPPED: "The signal is clipped, which may hide damage.",
    DiagnosisStatus.INSENSITIVE: "No damage shows, but the signal is too short to exclude it.",
    DiagnosisStatus.TOO_SHORT: "The recording holds too few ball passes.",
    DiagnosisStatus.TOO_COARSE: "The sample rate is too low to show how impacts repeat.",
    DiagnosisStatus.TOO_LONG: "The recording has more samples than are allowed.",
    DiagnosisStatus.SPEED_OPEN: "The answer depends on the shaft speed, which is not known.",
    DiagnosisStatus.BEARING_OPEN: (
        "Which part is damaged depends on the bearing, which is not known."
    ),
}

Reason = tuple[DiagnosisStatus, str]
"""A status, and why in a sentence."""
