"""Scenes: bearing, defects, load, support. Values only; nothing is solved here."""

from bearingcore.model.scene._defect import EDGES, RACES, Defect
from bearingcore.model.scene._floor import MOST_ROWS, MeasuredFloor, RoughFloor, measured_floor
from bearingcore.model.scene._load import Load
from bearingcore.model.scene._packing import (
    BodyNumbers,
    PackedMotion,
    PackedScene,
    ball_angles,
    is_planar,
)
from bearingcore.model.scene._presets import (
    FAN_RIG_SUPPORT,
    Preset,
    UnknownPresetError,
    preset_labels,
    preset_notes,
    presets,
)
from bearingcore.model.scene._scene import (
    CONTACT_LAWS,
    DOF_NAMES,
    DOF_SYMBOLS,
    FREE_TILT_WORDS,
    LOAD_ALONG,
    MASSLESS,
    TILT_FREE,
    TILT_HELD,
    WITH_MASS,
    Scene,
)
from bearingcore.model.scene._support import Support

__all__ = [
    "CONTACT_LAWS",
    "DOF_NAMES",
    "DOF_SYMBOLS",
    "EDGES",
    "FAN_RIG_SUPPORT",
    "FREE_TILT_WORDS",
    "LOAD_ALONG",
    "MASSLESS",
    "MOST_ROWS",
    "RACES",
    "TILT_FREE",
    "TILT_HELD",
    "WITH_MASS",
    "BodyNumbers",
    "Defect",
    "Load",
    "MeasuredFloor",
    "PackedMotion",
    "PackedScene",
    "Preset",
    "RoughFloor",
    "Scene",
    "Support",
    "UnknownPresetError",
    "ball_angles",
    "is_planar",
    "measured_floor",
    "preset_labels",
    "preset_notes",
    "presets",
]
