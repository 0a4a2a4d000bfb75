"""Compiled code: small structs of numbers and arrays in, arrays out; one module a subject.

Nothing here knows of the rest of bearingcore, and no compiled function takes more than eight
arguments. `compiling` says how functions are compiled and kept on disk.
"""

from bearingcore.kernels.balls.motion import march_balls
from bearingcore.kernels.balls.positions import StaticBalls, ball_positions
from bearingcore.kernels.balls.structs import BallSystem, Races
from bearingcore.kernels.compiling import all_on_disk, kept_on_disk
from bearingcore.kernels.modes import DOUBTFUL, modes_like
from bearingcore.kernels.motion.march import (
    between_steps,
    elastic_loads,
    march,
    motion_rates,
    side_by_side,
    sliding_sums,
    turn_smooth,
)
from bearingcore.kernels.path import (
    EVERY_ROW,
    INNER_EXACT,
    PATH_COLUMNS,
    TABLE,
    ball_path,
    drops_of,
    roll_over,
)
from bearingcore.kernels.statics import (
    BEYOND,
    CONVERGED,
    FREE_DIRECTION,
    NO_PIVOT,
    NOT_CARRIED,
    NOT_CONVERGED,
    NOTHING_TOUCHES,
    OPEN,
    REFUSED,
    RESIDUAL_AIM,
    RESIDUAL_LIMIT,
    TOO_MANY,
    new_answers,
    new_memory,
    static_maps,
    static_states,
)
from bearingcore.kernels.structs import (
    PLANAR,
    SMOOTH,
    VELOCITIES,
    Contacts,
    MapPaths,
    Path,
    Rotor,
    StaticLoad,
    System,
)

__all__ = [
    "BEYOND",
    "CONVERGED",
    "DOUBTFUL",
    "EVERY_ROW",
    "FREE_DIRECTION",
    "INNER_EXACT",
    "NOTHING_TOUCHES",
    "NOT_CARRIED",
    "NOT_CONVERGED",
    "NO_PIVOT",
    "OPEN",
    "PATH_COLUMNS",
    "PLANAR",
    "REFUSED",
    "RESIDUAL_AIM",
    "RESIDUAL_LIMIT",
    "SMOOTH",
    "TABLE",
    "TOO_MANY",
    "VELOCITIES",
    "BallSystem",
    "Contacts",
    "MapPaths",
    "Path",
    "Races",
    "Rotor",
    "StaticBalls",
    "StaticLoad",
    "System",
    "all_on_disk",
    "ball_path",
    "ball_positions",
    "between_steps",
    "drops_of",
    "elastic_loads",
    "kept_on_disk",
    "march",
    "march_balls",
    "modes_like",
    "motion_rates",
    "new_answers",
    "new_memory",
    "roll_over",
    "side_by_side",
    "sliding_sums",
    "static_maps",
    "static_states",
    "turn_smooth",
]
