"""Signals out of files: columns of numbers, their meaning by the file, open questions."""

from bearingcore.files.channels import OTHER, SIGNAL, SPEED, TIME, Column
from bearingcore.files.contents import FileContents
from bearingcore.files.facts import Finding
from bearingcore.files.sampling import longest_run
from bearingcore.files.table import files_inside, path_in
from bearingcore.files.units import (
    ACCELERATIONS,
    SPEEDS,
    STANDARD_GRAVITY,
    TIMES,
    UNITS,
    VOLTAGES,
    kind_of,
    level_doubt,
    unit_in,
)

__all__ = [
    "ACCELERATIONS",
    "OTHER",
    "SIGNAL",
    "SPEED",
    "SPEEDS",
    "STANDARD_GRAVITY",
    "TIME",
    "TIMES",
    "UNITS",
    "VOLTAGES",
    "Column",
    "FileContents",
    "Finding",
    "files_inside",
    "kind_of",
    "level_doubt",
    "longest_run",
    "path_in",
    "unit_in",
]
