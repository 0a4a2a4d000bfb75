"""Bearings: one file for each kind, the catalogue, designations, and data of drawings.

A bearing consists of rows; a row has elements, a place, and a contact with its kinematics. Files of
this package do not import each other in circles.
"""

from bearingcore.bearings._ball import Ball
from bearingcore.bearings._bearing import Bearing
from bearingcore.bearings._catalogue import (
    CATALOGUE_COLUMNS,
    MOST_BYTES,
    NEEDED_COLUMNS,
    CatalogueBearing,
    catalogue,
    read_catalogue,
)
from bearingcore.bearings._convert import convert_bearing, drawn
from bearingcore.bearings._designation import (
    Designation,
    designations,
    is_known,
    read_designation,
    series_words,
)
from bearingcore.bearings._drawing import (
    BALL_MATERIAL,
    OPTIONAL_FIELDS,
    USUAL_GROOVES,
    Derived,
    center_distance,
)
from bearingcore.bearings._frequencies import FREQUENCIES, bearing_of_frequencies
from bearingcore.bearings._kinds import KINDS
from bearingcore.bearings._line_contact import STEEL_MODULUS, STEEL_POISSON
from bearingcore.bearings._material import BALL_MATERIALS
from bearingcore.bearings._named import BearingLike, bearing_of, name_of
from bearingcore.bearings._row import Row

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
    "Ball",
    "Bearing",
    "BearingLike",
    "CatalogueBearing",
    "Derived",
    "Designation",
    "Row",
    "bearing_of",
    "bearing_of_frequencies",
    "catalogue",
    "center_distance",
    "convert_bearing",
    "designations",
    "drawn",
    "is_known",
    "name_of",
    "read_catalogue",
    "read_designation",
    "series_words",
]
