"""The bearing at rest: equilibrium, stiffness maps, pressure, film and life of the contacts."""

from bearingcore.statics.ball_positions import EquilibriumWithMass
from bearingcore.statics.equilibrium import (
    ANGLES_A_PERIOD,
    TERM_SYMBOLS,
    TERM_UNITS,
    default_cage_angles,
    has_long_period,
)
from bearingcore.statics.life import GIVEN, LEFT_OUT, OF_A_CATALOGUE, hours_in_words, turns_in_words
from bearingcore.statics.limit import NO_OIL, summary, unknown
from bearingcore.statics.passes import (
    Crossing,
    ball_drop,
    crossings,
    drops_at,
    drops_now,
    passing_rate,
    path_kinks,
)
from bearingcore.statics.positions import ROUNDS
from bearingcore.statics.ranges import BALL_LOAD, StaticRanges, ranges_of, static_ranges
from bearingcore.statics.validity import NO_DRAWING, state_of_limits

__all__ = [
    "ANGLES_A_PERIOD",
    "BALL_LOAD",
    "GIVEN",
    "LEFT_OUT",
    "NO_DRAWING",
    "NO_OIL",
    "OF_A_CATALOGUE",
    "ROUNDS",
    "TERM_SYMBOLS",
    "TERM_UNITS",
    "Crossing",
    "EquilibriumWithMass",
    "StaticRanges",
    "ball_drop",
    "crossings",
    "default_cage_angles",
    "drops_at",
    "drops_now",
    "has_long_period",
    "hours_in_words",
    "passing_rate",
    "path_kinks",
    "ranges_of",
    "state_of_limits",
    "static_ranges",
    "summary",
    "turns_in_words",
    "unknown",
]
