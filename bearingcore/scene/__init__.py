"""Scenes: bearing, defects, load, support. Values only; nothing is solved here."""

from bearingcore.scene.floor import MOST_ROWS
from bearingcore.scene.packing import ball_angles, is_planar
from bearingcore.scene.pits import pit
from bearingcore.scene.presets import preset_labels
from bearingcore.scene.scene import (
    DOF_SYMBOLS,
    FREE_TILT_WORDS,
    LOAD_ALONG,
    MASSLESS,
    TILT_FREE,
    TILT_HELD,
    WITH_MASS,
)

__all__ = [
    "DOF_SYMBOLS",
    "FREE_TILT_WORDS",
    "LOAD_ALONG",
    "MASSLESS",
    "MOST_ROWS",
    "TILT_FREE",
    "TILT_HELD",
    "WITH_MASS",
    "ball_angles",
    "is_planar",
    "pit",
    "preset_labels",
]
