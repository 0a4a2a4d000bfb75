"""The physics of a damaged ball bearing, after Petersen, Howard & Prime (2014). SI units, rad."""

from bearingcore.bearing import Bearing
from bearingcore.defect import EDGES, RACES, Defect
from bearingcore.envelope_band import impulsive_band
from bearingcore.equilibrium import STIFFNESS_TERMS, Equilibrium, equilibrium
from bearingcore.floor import MeasuredFloor, RoughFloor, read_floor
from bearingcore.maps import Maps, stiffness_maps
from bearingcore.modes import Modes, contact_damping, modes
from bearingcore.motion import Motion, simulate
from bearingcore.orbit import Orbit, orbit
from bearingcore.presets import preset_notes, presets
from bearingcore.recording import Recording, Table, read_table
from bearingcore.scene import CONTACT_LAWS, DOF_NAMES, Load, Scene, Support
from bearingcore.sizing import Candidate, Sizing, size_defect
from bearingcore.spectrum import Spectrum, envelope_spectrum, spectrum
from bearingcore.validity import Limit, limits
from bearingcore.warm_up import warm

__all__ = [
    "CONTACT_LAWS",
    "DOF_NAMES",
    "EDGES",
    "RACES",
    "STIFFNESS_TERMS",
    "Bearing",
    "Candidate",
    "Defect",
    "Equilibrium",
    "Limit",
    "Load",
    "Maps",
    "MeasuredFloor",
    "Modes",
    "Motion",
    "Orbit",
    "Recording",
    "RoughFloor",
    "Scene",
    "Sizing",
    "Spectrum",
    "Support",
    "Table",
    "contact_damping",
    "envelope_spectrum",
    "equilibrium",
    "impulsive_band",
    "limits",
    "modes",
    "orbit",
    "preset_notes",
    "presets",
    "read_floor",
    "read_table",
    "simulate",
    "size_defect",
    "spectrum",
    "stiffness_maps",
    "warm",
]
