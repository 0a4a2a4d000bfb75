"""The physics of a damaged ball bearing, after Petersen, Howard & Prime (2014). SI units, rad."""

from bearingcore.bearing import Bearing
from bearingcore.defect import EDGES, RACES, Defect
from bearingcore.equilibrium import STIFFNESS_TERMS, Equilibrium, equilibrium
from bearingcore.floor import MeasuredFloor, RoughFloor, read_floor
from bearingcore.maps import Maps, stiffness_maps
from bearingcore.modes import Modes, contact_damping, modes
from bearingcore.motion import Motion, simulate
from bearingcore.orbit import Orbit, orbit
from bearingcore.presets import preset_notes, presets
from bearingcore.scene import CONTACT_LAWS, DOF_NAMES, Load, Scene, Support
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
    "Defect",
    "Equilibrium",
    "Limit",
    "Load",
    "Maps",
    "MeasuredFloor",
    "Modes",
    "Motion",
    "Orbit",
    "RoughFloor",
    "Scene",
    "Spectrum",
    "Support",
    "contact_damping",
    "envelope_spectrum",
    "equilibrium",
    "limits",
    "modes",
    "orbit",
    "preset_notes",
    "presets",
    "read_floor",
    "simulate",
    "spectrum",
    "stiffness_maps",
    "warm",
]
