"""Bearings: a file a kind, presets and the catalogue by designation, what a drawing says.

A bearing is rows; a row is elements, a place, and a contact that says its own kinematics. No file
here imports one that imports it.
"""

from bearingcore.bearings.ball import USUAL_GROOVES as USUAL_GROOVES
from bearingcore.bearings.ball import drawn as drawn
from bearingcore.bearings.catalogue import CATALOGUE_COLUMNS as CATALOGUE_COLUMNS
from bearingcore.bearings.catalogue import MOST_BYTES as MOST_BYTES
from bearingcore.bearings.catalogue import NEEDED_COLUMNS as NEEDED_COLUMNS
from bearingcore.bearings.designation import designations as designations
from bearingcore.bearings.designation import is_known as is_known
from bearingcore.bearings.designation import series_words as series_words
from bearingcore.bearings.drawing import BALL_MATERIAL as BALL_MATERIAL
from bearingcore.bearings.drawing import OPTIONAL_FIELDS as OPTIONAL_FIELDS
from bearingcore.bearings.drawing import center_distance as center_distance
from bearingcore.bearings.frequencies import FREQUENCIES as FREQUENCIES
from bearingcore.bearings.frequencies import bearing_of_frequencies as bearing_of_frequencies
from bearingcore.bearings.kinds import KINDS as KINDS
from bearingcore.bearings.line_contact import STEEL_MODULUS as STEEL_MODULUS
from bearingcore.bearings.line_contact import STEEL_POISSON as STEEL_POISSON
from bearingcore.bearings.material import BALL_MATERIALS as BALL_MATERIALS
from bearingcore.bearings.named import name_of as name_of
from bearingcore.bearings.rows import Row as Row
