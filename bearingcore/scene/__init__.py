"""Scenes: bearing, defects, load, support. Values only; nothing is solved here."""

from bearingcore.scene.floor import MOST_ROWS as MOST_ROWS
from bearingcore.scene.packing import ball_angles as ball_angles
from bearingcore.scene.packing import is_planar as is_planar
from bearingcore.scene.presets import preset_labels as preset_labels
from bearingcore.scene.scene import DOF_SYMBOLS as DOF_SYMBOLS
from bearingcore.scene.scene import FREE_TILT_WORDS as FREE_TILT_WORDS
from bearingcore.scene.scene import LOAD_ALONG as LOAD_ALONG
from bearingcore.scene.scene import MASSLESS as MASSLESS
from bearingcore.scene.scene import TILT_FREE as TILT_FREE
from bearingcore.scene.scene import TILT_HELD as TILT_HELD
from bearingcore.scene.scene import WITH_MASS as WITH_MASS
