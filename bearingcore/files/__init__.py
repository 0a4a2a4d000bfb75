"""Signals out of files: columns of numbers, their meaning by the file, open questions."""

from bearingcore.files.contents import FileContents
from bearingcore.files.facts import Finding
from bearingcore.files.sampling import longest_run
from bearingcore.files.units import (
    ACCELERATIONS,
    STANDARD_GRAVITY,
    UNITS,
    VOLTAGES,
    kind_of,
    level_doubt,
)

__all__ = [
    "ACCELERATIONS",
    "STANDARD_GRAVITY",
    "UNITS",
    "VOLTAGES",
    "FileContents",
    "Finding",
    "kind_of",
    "level_doubt",
    "longest_run",
]
