"""Dynamics: natural frequencies, simulated motion, the periodic steady state, speed runs."""

from bearingcore.model.dynamics._ball_comparison import (
    LOWEST_COMPARED,
    QUIETEST_COMPARED,
    BallComparison,
    compare_motions,
    compared_directions,
)
from bearingcore.model.dynamics._ball_motion import (
    RACES_OF_LOADS,
    Flight,
    Strike,
    ball_strikes,
    contact_resonance_band,
    flights,
)
from bearingcore.model.dynamics._damping import contact_damping
from bearingcore.model.dynamics._modes import (
    BandSearch,
    Modes,
    frequency_bands,
    highest_natural_frequency,
    modes,
)
from bearingcore.model.dynamics._motion import SETTLING, Motion, simulate
from bearingcore.model.dynamics._orbit import Orbit, common_ball_passes, orbit
from bearingcore.model.dynamics._record import PathEffects, Resonance, simulated_record
from bearingcore.model.dynamics._ross_element import to_ross
from bearingcore.model.dynamics._speed_runs import SpeedRun, speed_run
from bearingcore.model.dynamics._status import MotionStatus, OrbitStatus
from bearingcore.model.dynamics._step_rate import default_step_rate, fine_step_rate

__all__ = [
    "LOWEST_COMPARED",
    "QUIETEST_COMPARED",
    "RACES_OF_LOADS",
    "SETTLING",
    "BallComparison",
    "BandSearch",
    "Flight",
    "Modes",
    "Motion",
    "MotionStatus",
    "Orbit",
    "OrbitStatus",
    "PathEffects",
    "Resonance",
    "SpeedRun",
    "Strike",
    "ball_strikes",
    "common_ball_passes",
    "compare_motions",
    "compared_directions",
    "contact_damping",
    "contact_resonance_band",
    "default_step_rate",
    "fine_step_rate",
    "flights",
    "frequency_bands",
    "highest_natural_frequency",
    "modes",
    "orbit",
    "simulate",
    "simulated_record",
    "speed_run",
    "to_ross",
]
