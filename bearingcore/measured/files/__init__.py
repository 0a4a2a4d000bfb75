"""Signals from files: columns of numbers, their meaning by the file, and open questions."""

from bearingcore.measured.files._by_hand import read_recording as read_recording
from bearingcore.measured.files._channels import (
    OTHER as OTHER,
    PLACES as PLACES,
    SIGNAL as SIGNAL,
    SPEED as SPEED,
    TIME as TIME,
    Column as Column,
)
from bearingcore.measured.files._child import read_file as read_file
from bearingcore.measured.files._contents import FileContents as FileContents
from bearingcore.measured.files._dates import time_in as time_in
from bearingcore.measured.files._facts import Finding as Finding
from bearingcore.measured.files._sampling import Sampling as Sampling, longest_run as longest_run
from bearingcore.measured.files._table import (
    Table as Table,
    files_inside as files_inside,
    join_tables as join_tables,
    path_in as path_in,
    read_table as read_table,
)
from bearingcore.measured.files._text import read_text as read_text
from bearingcore.measured.files._units import (
    ACCELERATIONS as ACCELERATIONS,
    SPEEDS as SPEEDS,
    TIMES as TIMES,
    UNITS as UNITS,
    VOLTAGES as VOLTAGES,
    kind_of as kind_of,
    level_doubt as level_doubt,
    unit_in as unit_in,
)
