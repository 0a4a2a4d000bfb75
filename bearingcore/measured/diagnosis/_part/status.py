"""Outcomes of a diagnosis of the damaged part."""

from __future__ import annotations

from bearingcore.errors import Status


class DiagnosisStatus(Status):
    """The outcome of a diagnosis of the damaged part; `Diagnosis.detail` explains it."""

    PART_NAMED = "part named"
    NONE_SEEN = "none seen"
    PERHAPS_A_BALL = "race's lines, perhaps by a ball"
    ALIKE = "parts alike"
    UNMODULATED = "lines without modulation"
    OTHER_SHAFT = "of another shaft"
    MAGNETIC = "like magnetic noise"
    NOT_ALONE = "not alone"
    FAINT = "faint lines"
    OTHER_SOURCE = "other source"
    IRREGULAR = "irregular knocks"
    DROPPED_OUT = "dropped out"
    CLIPPED = "clipped"
    INSENSITIVE = "too short to exclude damage"
    ROUNDED = "nothing but rounding"
    TOO_SHORT = "too short"
    TOO_COARSE = "sampled too slowly"
    SPEED_CHANGES = "speed changes"
    SPEED_OPEN = "shaft speed open"
    BEARING_OPEN = "bearing open"


Reason = tuple[DiagnosisStatus, str]
"""A status, and its reason in a sentence."""
