"""The bearing at rest: equilibrium, stiffness maps, pressure, film and life of the contacts."""

from bearingcore.model.statics._ball_positions import (
    BallPositions,
    CentrifugalEffect,
    EquilibriumWithMass,
    ball_positions,
    static_state,
)
from bearingcore.model.statics._equilibrium import (
    ANGLES_A_PERIOD,
    STIFFNESS_TERMS,
    TERM_SYMBOLS,
    TERM_UNITS,
    Equilibrium,
    default_cage_angles,
    equilibrium,
    has_long_period,
)
from bearingcore.model.statics._film import Film, RaceFilm, film
from bearingcore.model.statics._life import ContactLife, Life, life
from bearingcore.model.statics._life_words import LEFT_OUT, hours_in_words, turns_in_words
from bearingcore.model.statics._limit import NO_OIL, Limit, summary, unknown
from bearingcore.model.statics._load_rating import GIVEN, OF_A_CATALOGUE, dynamic_load_rating
from bearingcore.model.statics._maps import Maps, stiffness_maps
from bearingcore.model.statics._passes import (
    Crossing,
    ball_drop,
    crossings,
    drops_at,
    drops_now,
    passing_rate,
    path_kinks,
)
from bearingcore.model.statics._positions import ROUNDS
from bearingcore.model.statics._pressure import (
    ContactPressures,
    HeaviestBall,
    RacePressure,
    contact_pressures,
)
from bearingcore.model.statics._ranges import BALL_LOAD, StaticRanges, ranges_of, static_ranges
from bearingcore.model.statics._usual import scene_of
from bearingcore.model.statics._validity import NO_DRAWING, limits, state_of_limits

__all__ = [
    "ANGLES_A_PERIOD",
    "BALL_LOAD",
    "GIVEN",
    "LEFT_OUT",
    "NO_DRAWING",
    "NO_OIL",
    "OF_A_CATALOGUE",
    "ROUNDS",
    "STIFFNESS_TERMS",
    "TERM_SYMBOLS",
    "TERM_UNITS",
    "BallPositions",
    "CentrifugalEffect",
    "ContactLife",
    "ContactPressures",
    "Crossing",
    "Equilibrium",
    "EquilibriumWithMass",
    "Film",
    "HeaviestBall",
    "Life",
    "Limit",
    "Maps",
    "RaceFilm",
    "RacePressure",
    "StaticRanges",
    "ball_drop",
    "ball_positions",
    "contact_pressures",
    "crossings",
    "default_cage_angles",
    "drops_at",
    "drops_now",
    "dynamic_load_rating",
    "equilibrium",
    "film",
    "has_long_period",
    "hours_in_words",
    "life",
    "limits",
    "passing_rate",
    "path_kinks",
    "ranges_of",
    "scene_of",
    "state_of_limits",
    "static_ranges",
    "static_state",
    "stiffness_maps",
    "summary",
    "turns_in_words",
    "unknown",
]
