"""Dynamics: natural frequencies, simulated motion, the periodic steady state, speed runs."""

from bearingcore.model.dynamics._ball_comparison import (
    LOWEST_COMPARED as LOWEST_COMPARED,
    QUIETEST_COMPARED as QUIETEST_COMPARED,
    BallComparison as BallComparison,
    compare_motions as compare_motions,
    compared_directions as compared_directions,
)
from bearingcore.model.dynamics._ball_motion import (
    RACES_OF_LOADS as RACES_OF_LOADS,
    Flight as Flight,
    Strike as Strike,
    ball_strikes as ball_strikes,
    contact_resonance_band as contact_resonance_band,
    flights as flights,
)
from bearingcore.model.dynamics._damping import contact_damping as contact_damping
from bearingcore.model.dynamics._force import ForceSamples as ForceSamples
from bearingcore.model.dynamics._modes import (
    BandSearch as BandSearch,
    Modes as Modes,
    frequency_bands as frequency_bands,
    highest_natural_frequency as highest_natural_frequency,
    modes as modes,
)
from bearingcore.model.dynamics._motion import (
    SETTLING as SETTLING,
    Motion as Motion,
    simulate as simulate,
)
from bearingcore.model.dynamics._orbit import (
    Orbit as Orbit,
    common_ball_passes as common_ball_passes,
    orbit as orbit,
)
from bearingcore.model.dynamics._record import (
    PathEffects as PathEffects,
    Resonance as Resonance,
    simulated_record as simulated_record,
)
from bearingcore.model.dynamics._ross_element import to_ross as to_ross
from bearingcore.model.dynamics._speed_runs import (
    SpeedRun as SpeedRun,
    speed_run as speed_run,
)
from bearingcore.model.dynamics._status import (
    MotionStatus as MotionStatus,
    OrbitStatus as OrbitStatus,
)
from bearingcore.model.dynamics._step_rate import (
    default_step_rate as default_step_rate,
    fine_step_rate as fine_step_rate,
)
