"""Outcomes of a diagnosis of the damaged part."""

from __future__ import annotations

from bearingcore.errors import Status


class DiagnosisStatus(Status):
    """The outcome of a diagnosis of the damaged part."""

    PART_NAMED = "part named", "The lines of one part stand out as those of damage do."
    NONE_SEEN = "none seen", "No lines of a part show; lines of damage would have."
    PERHAPS_A_BALL = (
        "race's lines, perhaps by a ball",
        "The lines of a race are there, but faint: a damaged ball or a healthy bearing may make "
        "them.",
    )
    ALIKE = "parts alike", "The lines of both races show, neither much stronger."
    UNMODULATED = (
        "lines without modulation",
        "Impacts repeat at the rate of a part that turns, but are not modulated by its turning.",
    )
    OTHER_SHAFT = (
        "of another shaft",
        "The lines of a part, or those of the shaft, show that another speed made them.",
    )
    MAGNETIC = (
        "like magnetic noise",
        "Lines of a part show at twice the mains frequency, where magnetic noise of a motor has "
        "its own.",
    )
    NOT_ALONE = "not alone", "Lines of a part show, but others are as strong."
    FAINT = "faint lines", "Lines of a part show, but too faint to be sure."
    OTHER_SOURCE = "other source", "Something repeats that is no line of this bearing."
    IRREGULAR = "irregular knocks", "There are impacts, but not at the rate of any part."
    DROPPED_OUT = "dropped out", "Parts of the signal dropped out, which may hide damage."
    CLIPPED = "clipped", "The signal is clipped, which may hide damage."
    INSENSITIVE = (
        "too short to exclude damage",
        "No damage shows, but the signal is too short to exclude it.",
    )
    ROUNDED = (
        "nothing but rounding",
        "Between its tones the signal holds no vibration, only the rounding of its numbers.",
    )
    TOO_SHORT = "too short", "The recording holds too few ball passes."
    TOO_COARSE = "sampled too slowly", "The sample rate is too low to show how impacts repeat."
    SPEED_CHANGES = (
        "speed changes",
        "The speed changes during the record, and was not measured beside the signal.",
    )
    SPEED_OPEN = "shaft speed open", "The answer depends on the shaft speed, which is not known."
    BEARING_OPEN = (
        "bearing open",
        "Which part is damaged depends on the bearing, which is not known.",
    )


Reason = tuple[DiagnosisStatus, str]
"""A status, and why in a sentence."""
