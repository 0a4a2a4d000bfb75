"""Bearings: a file a kind, presets and the catalogue by designation, what a drawing says.

A bearing is rows; a row is elements, a place, and a contact that says its own kinematics. No file
here imports one that imports it.
"""

from bearingcore.bearings.ball import USUAL_GROOVES, drawn
from bearingcore.bearings.catalogue import CATALOGUE_COLUMNS, MOST_BYTES, NEEDED_COLUMNS
from bearingcore.bearings.designation import designations, is_known, series_words
from bearingcore.bearings.drawing import BALL_MATERIAL, OPTIONAL_FIELDS, center_distance, faults
from bearingcore.bearings.frequencies import FREQUENCIES, bearing_of_frequencies
from bearingcore.bearings.kinds import KINDS
from bearingcore.bearings.line_contact import STEEL_MODULUS, STEEL_POISSON
from bearingcore.bearings.material import BALL_MATERIALS
from bearingcore.bearings.nearest import nearest_known
from bearingcore.bearings.rows import Row

__all__ = [
    "BALL_MATERIAL",
    "BALL_MATERIALS",
    "CATALOGUE_COLUMNS",
    "FREQUENCIES",
    "KINDS",
    "MOST_BYTES",
    "NEEDED_COLUMNS",
    "OPTIONAL_FIELDS",
    "STEEL_MODULUS",
    "STEEL_POISSON",
    "USUAL_GROOVES",
    "Row",
    "bearing_of_frequencies",
    "center_distance",
    "designations",
    "drawn",
    "faults",
    "is_known",
    "nearest_known",
    "series_words",
]
