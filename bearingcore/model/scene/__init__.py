"""Scenes: bearing, defects, load, support. Values only; nothing is solved here."""

from bearingcore.model.scene._defect import (
    EDGES as EDGES,
    RACES as RACES,
    Defect as Defect,
)
from bearingcore.model.scene._floor import (
    MOST_ROWS as MOST_ROWS,
    MeasuredFloor as MeasuredFloor,
    RoughFloor as RoughFloor,
    measured_floor as measured_floor,
)
from bearingcore.model.scene._load import Load as Load
from bearingcore.model.scene._packing import (
    PackedMotion as PackedMotion,
    PackedScene as PackedScene,
    ball_angles as ball_angles,
    is_planar as is_planar,
)
from bearingcore.model.scene._presets import (
    FAN_RIG_SUPPORT as FAN_RIG_SUPPORT,
    Preset as Preset,
    UnknownPresetError as UnknownPresetError,
    preset_labels as preset_labels,
    preset_notes as preset_notes,
    presets as presets,
)
from bearingcore.model.scene._scene import (
    CONTACT_LAWS as CONTACT_LAWS,
    DOF_NAMES as DOF_NAMES,
    DOF_SYMBOLS as DOF_SYMBOLS,
    FREE_TILT_WORDS as FREE_TILT_WORDS,
    LOAD_ALONG as LOAD_ALONG,
    MASSLESS as MASSLESS,
    TILT_FREE as TILT_FREE,
    TILT_HELD as TILT_HELD,
    WITH_MASS as WITH_MASS,
    Scene as Scene,
)
from bearingcore.model.scene._support import Support as Support
