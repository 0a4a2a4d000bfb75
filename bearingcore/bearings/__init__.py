"""Bearings: one file for each kind, the catalogue, designations, and data of drawings.

A bearing consists of rows; a row has elements, a place, and a contact with its kinematics. Files of
this package do not import each other in circles.
"""

from bearingcore.bearings._ball import Ball as Ball
from bearingcore.bearings._bearing import Bearing as Bearing
from bearingcore.bearings._catalogue import (
    CatalogueBearing as CatalogueBearing,
    catalogue as catalogue,
    read_catalogue as read_catalogue,
)
from bearingcore.bearings._convert import convert_bearing as convert_bearing, drawn as drawn
from bearingcore.bearings._designation import (
    Designation as Designation,
    designations as designations,
    is_known as is_known,
    read_designation as read_designation,
    series_words as series_words,
)
from bearingcore.bearings._drawing import (
    BALL_MATERIAL as BALL_MATERIAL,
    OPTIONAL_FIELDS as OPTIONAL_FIELDS,
    USUAL_GROOVES as USUAL_GROOVES,
    Derived as Derived,
    center_distance as center_distance,
)
from bearingcore.bearings._frequencies import (
    FREQUENCIES as FREQUENCIES,
    bearing_of_frequencies as bearing_of_frequencies,
)
from bearingcore.bearings._kinds import KINDS as KINDS
from bearingcore.bearings._line_contact import (
    STEEL_MODULUS as STEEL_MODULUS,
    STEEL_POISSON as STEEL_POISSON,
)
from bearingcore.bearings._material import BALL_MATERIALS as BALL_MATERIALS
from bearingcore.bearings._named import (
    BearingLike as BearingLike,
    bearing_of as bearing_of,
    name_of as name_of,
)
from bearingcore.bearings._row import Row as Row
