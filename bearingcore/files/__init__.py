"""Signals out of files: columns of numbers, their meaning by the file, open questions."""

from bearingcore.files.channels import OTHER as OTHER
from bearingcore.files.channels import PLACES as PLACES
from bearingcore.files.channels import SIGNAL as SIGNAL
from bearingcore.files.channels import SPEED as SPEED
from bearingcore.files.channels import TIME as TIME
from bearingcore.files.channels import Column as Column
from bearingcore.files.contents import FileContents as FileContents
from bearingcore.files.dates import time_in as time_in
from bearingcore.files.facts import Finding as Finding
from bearingcore.files.sampling import longest_run as longest_run
from bearingcore.files.table import files_inside as files_inside
from bearingcore.files.table import path_in as path_in
from bearingcore.files.units import ACCELERATIONS as ACCELERATIONS
from bearingcore.files.units import SPEEDS as SPEEDS
from bearingcore.files.units import TIMES as TIMES
from bearingcore.files.units import UNITS as UNITS
from bearingcore.files.units import VOLTAGES as VOLTAGES
from bearingcore.files.units import kind_of as kind_of
from bearingcore.files.units import level_doubt as level_doubt
from bearingcore.files.units import unit_in as unit_in
