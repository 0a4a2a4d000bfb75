"""The physics of a damaged ball bearing, after Petersen, Howard & Prime (2014). SI units, rad."""

from bearingcore.bearings.bearing import Bearing
from bearingcore.bearings.catalogue import (
    CatalogueBearing,
    catalogue,
    read_catalogue,
)
from bearingcore.bearings.designation import Designation, read_designation
from bearingcore.diagnosis.of_files import diagnose
from bearingcore.diagnosis.part.evidence import Diagnosis, PartEvidence
from bearingcore.dynamics.damping import contact_damping
from bearingcore.dynamics.modes import Modes, frequency_bands, modes
from bearingcore.dynamics.motion import Motion, simulate
from bearingcore.dynamics.orbit import Orbit, orbit
from bearingcore.dynamics.record import simulated_record
from bearingcore.dynamics.ross_element import to_ross
from bearingcore.files.by_hand import read_recording
from bearingcore.files.floor import read_floor
from bearingcore.files.table import Table, join_tables, read_table
from bearingcore.scene.defect import EDGES, RACES, Defect
from bearingcore.scene.floor import MeasuredFloor, RoughFloor
from bearingcore.scene.load import Load
from bearingcore.scene.presets import preset_notes, presets
from bearingcore.scene.scene import CONTACT_LAWS, DOF_NAMES, Scene
from bearingcore.scene.support import Support
from bearingcore.signals.indicators import Indicators, indicators
from bearingcore.signals.kurtogram import Kurtogram, kurtogram
from bearingcore.signals.recording import Recording
from bearingcore.signals.spectrum import Spectrum, envelope_spectrum, spectrum
from bearingcore.sizing import (
    Candidate,
    MeasuredExtent,
    Sizing,
    Trend,
    TrendPoint,
    measure_extent,
    size_defect,
    trend,
    trend_point,
)
from bearingcore.statics.ball_positions import BallPositions, ball_positions, static_state
from bearingcore.statics.equilibrium import STIFFNESS_TERMS, Equilibrium, equilibrium
from bearingcore.statics.film import Film, film
from bearingcore.statics.life import Life, dynamic_load_rating, life
from bearingcore.statics.limit import Limit
from bearingcore.statics.maps import Maps, stiffness_maps
from bearingcore.statics.pressure import ContactPressures, contact_pressures
from bearingcore.statics.usual import scene_of
from bearingcore.statics.validity import limits
from bearingcore.warm_up import warm

__all__ = [
    "CONTACT_LAWS",
    "DOF_NAMES",
    "EDGES",
    "RACES",
    "STIFFNESS_TERMS",
    "BallPositions",
    "Bearing",
    "Candidate",
    "CatalogueBearing",
    "ContactPressures",
    "Defect",
    "Designation",
    "Diagnosis",
    "Equilibrium",
    "Film",
    "Indicators",
    "Kurtogram",
    "Life",
    "Limit",
    "Load",
    "Maps",
    "MeasuredExtent",
    "MeasuredFloor",
    "Modes",
    "Motion",
    "Orbit",
    "PartEvidence",
    "Recording",
    "RoughFloor",
    "Scene",
    "Sizing",
    "Spectrum",
    "Support",
    "Table",
    "Trend",
    "TrendPoint",
    "ball_positions",
    "catalogue",
    "contact_damping",
    "contact_pressures",
    "diagnose",
    "dynamic_load_rating",
    "envelope_spectrum",
    "equilibrium",
    "film",
    "frequency_bands",
    "indicators",
    "join_tables",
    "kurtogram",
    "life",
    "limits",
    "measure_extent",
    "modes",
    "orbit",
    "preset_notes",
    "presets",
    "read_catalogue",
    "read_designation",
    "read_floor",
    "read_recording",
    "read_table",
    "scene_of",
    "simulate",
    "simulated_record",
    "size_defect",
    "spectrum",
    "static_state",
    "stiffness_maps",
    "to_ross",
    "trend",
    "trend_point",
    "warm",
]
