"""Signals from files: columns of numbers, their meaning by the file, and open questions."""

from bearingcore.measured.files._by_hand import read_recording
from bearingcore.measured.files._channels import OTHER, PLACES, SIGNAL, SPEED, TIME, Column
from bearingcore.measured.files._child import read_file
from bearingcore.measured.files._contents import FileContents
from bearingcore.measured.files._dates import time_in
from bearingcore.measured.files._facts import Finding
from bearingcore.measured.files._sampling import Sampling, longest_run
from bearingcore.measured.files._table import Table, files_inside, join_tables, path_in, read_table
from bearingcore.measured.files._units import (
    ACCELERATIONS,
    SPEEDS,
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
    "PLACES",
    "SIGNAL",
    "SPEED",
    "SPEEDS",
    "TIME",
    "TIMES",
    "UNITS",
    "VOLTAGES",
    "Column",
    "FileContents",
    "Finding",
    "Sampling",
    "Table",
    "files_inside",
    "join_tables",
    "kind_of",
    "level_doubt",
    "longest_run",
    "path_in",
    "read_file",
    "read_recording",
    "read_table",
    "time_in",
    "unit_in",
]
