"""Dynamics: natural frequencies, simulated motion, the periodic steady state, speed runs."""

from bearingcore.dynamics.ball_comparison import LOWEST_COMPARED as LOWEST_COMPARED
from bearingcore.dynamics.ball_comparison import QUIETEST_COMPARED as QUIETEST_COMPARED
from bearingcore.dynamics.ball_comparison import BallComparison as BallComparison
from bearingcore.dynamics.ball_comparison import compare_motions as compare_motions
from bearingcore.dynamics.ball_comparison import compared_directions as compared_directions
from bearingcore.dynamics.ball_motion import RACES_OF_LOADS as RACES_OF_LOADS
from bearingcore.dynamics.ball_motion import Flight as Flight
from bearingcore.dynamics.ball_motion import Strike as Strike
from bearingcore.dynamics.ball_motion import ball_strikes as ball_strikes
from bearingcore.dynamics.ball_motion import contact_resonance_band as contact_resonance_band
from bearingcore.dynamics.ball_motion import flights as flights
from bearingcore.dynamics.modes import highest_natural_frequency as highest_natural_frequency
from bearingcore.dynamics.motion import SETTLING as SETTLING
from bearingcore.dynamics.orbit import common_ball_passes as common_ball_passes
from bearingcore.dynamics.speed_runs import SpeedRun as SpeedRun
from bearingcore.dynamics.speed_runs import speed_run as speed_run
from bearingcore.dynamics.status import OrbitStatus as OrbitStatus
from bearingcore.dynamics.step_rate import default_step_rate as default_step_rate
from bearingcore.dynamics.step_rate import fine_step_rate as fine_step_rate
