"""The bearing at rest: equilibrium, stiffness maps, pressure, film and life of the contacts."""

from bearingcore.model.statics._ball_positions import (
    BallPositions as BallPositions,
    EquilibriumWithMass as EquilibriumWithMass,
    ball_positions as ball_positions,
    static_state as static_state,
)
from bearingcore.model.statics._equilibrium import (
    ANGLES_A_PERIOD as ANGLES_A_PERIOD,
    STIFFNESS_TERMS as STIFFNESS_TERMS,
    TERM_SYMBOLS as TERM_SYMBOLS,
    TERM_UNITS as TERM_UNITS,
    Equilibrium as Equilibrium,
    default_cage_angles as default_cage_angles,
    equilibrium as equilibrium,
    has_long_period as has_long_period,
)
from bearingcore.model.statics._film import (
    Film as Film,
    RaceFilm as RaceFilm,
    film as film,
)
from bearingcore.model.statics._life import (
    ContactLife as ContactLife,
    Life as Life,
    life as life,
)
from bearingcore.model.statics._life_words import (
    LEFT_OUT as LEFT_OUT,
    hours_in_words as hours_in_words,
    turns_in_words as turns_in_words,
)
from bearingcore.model.statics._limit import (
    NO_DRAWING as NO_DRAWING,
    NO_OIL as NO_OIL,
    Limit as Limit,
    summary as summary,
    unknown as unknown,
)
from bearingcore.model.statics._load_rating import (
    GIVEN as GIVEN,
    OF_A_CATALOGUE as OF_A_CATALOGUE,
    dynamic_load_rating as dynamic_load_rating,
)
from bearingcore.model.statics._maps import (
    Maps as Maps,
    stiffness_maps as stiffness_maps,
)
from bearingcore.model.statics._passes import (
    Crossing as Crossing,
    ball_drop as ball_drop,
    crossings as crossings,
    drops_at as drops_at,
    drops_now as drops_now,
    passing_rate as passing_rate,
    path_kinks as path_kinks,
)
from bearingcore.model.statics._positions import ROUNDS as ROUNDS
from bearingcore.model.statics._pressure import (
    ContactPressures as ContactPressures,
    HeaviestBall as HeaviestBall,
    RacePressure as RacePressure,
    contact_pressures as contact_pressures,
)
from bearingcore.model.statics._ranges import (
    BALL_LOAD as BALL_LOAD,
    StaticRanges as StaticRanges,
    ranges_of as ranges_of,
    static_ranges as static_ranges,
)
from bearingcore.model.statics._usual import scene_of as scene_of
from bearingcore.model.statics._validity import (
    limits as limits,
    state_of_limits as state_of_limits,
)
