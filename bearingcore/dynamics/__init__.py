"""Dynamics: natural frequencies, simulated motion, the periodic steady state, speed runs."""

from bearingcore.dynamics.ball_comparison import (
    LOWEST_COMPARED,
    QUIETEST_COMPARED,
    BallComparison,
    compare_motions,
    compared_directions,
)
from bearingcore.dynamics.ball_motion import contact_resonance_band
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import SETTLING
from bearingcore.dynamics.orbit import common_ball_passes
from bearingcore.dynamics.speed_runs import SpeedRun, speed_run
from bearingcore.dynamics.stability_maps import OUTCOMES, StabilityMap, regions, stability_map
from bearingcore.dynamics.status import OrbitStatus
from bearingcore.dynamics.step_rate import default_step_rate, fine_step_rate
from bearingcore.dynamics.strikes import RACES_OF_LOADS, Flight, Strike, ball_strikes, flights

__all__ = [
    "LOWEST_COMPARED",
    "OUTCOMES",
    "QUIETEST_COMPARED",
    "RACES_OF_LOADS",
    "SETTLING",
    "BallComparison",
    "Flight",
    "OrbitStatus",
    "SpeedRun",
    "StabilityMap",
    "Strike",
    "ball_strikes",
    "common_ball_passes",
    "compare_motions",
    "compared_directions",
    "contact_resonance_band",
    "default_step_rate",
    "fine_step_rate",
    "flights",
    "highest_natural_frequency",
    "regions",
    "speed_run",
    "stability_map",
]
