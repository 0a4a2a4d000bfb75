"""The names that the rest of the model takes of compiled code."""

from .balls.motion import march_balls as march_balls
from .balls.positions import StaticBalls as StaticBalls, ball_positions as ball_positions
from .balls.structs import BallSystem as BallSystem, Races as Races
from .codes import (
    BEYOND as BEYOND,
    CONVERGED as CONVERGED,
    EVERY_ROW as EVERY_ROW,
    FREE_DIRECTION as FREE_DIRECTION,
    INNER_EXACT as INNER_EXACT,
    NOT_CARRIED as NOT_CARRIED,
    NOT_CONVERGED as NOT_CONVERGED,
    NOTHING_TOUCHES as NOTHING_TOUCHES,
    OPEN as OPEN,
    PATH_COLUMNS as PATH_COLUMNS,
    REFUSED as REFUSED,
    TABLE as TABLE,
    TOO_MANY as TOO_MANY,
)
from .compiling import all_on_disk as all_on_disk, kept_on_disk as kept_on_disk
from .in_parts import Watch as Watch, parts as parts
from .modes import DOUBTFUL as DOUBTFUL, modes_like as modes_like
from .motion.march import (
    elastic_loads as elastic_loads,
    interpolate_steps as interpolate_steps,
    lay_side_by_side as lay_side_by_side,
    march as march,
    motion_rates as motion_rates,
    sliding_sums as sliding_sums,
    turn_smooth as turn_smooth,
)
from .path import ball_path as ball_path, drops_of as drops_of, roll_over as roll_over
from .statics import (
    NO_PIVOT as NO_PIVOT,
    RESIDUAL_AIM as RESIDUAL_AIM,
    RESIDUAL_LIMIT as RESIDUAL_LIMIT,
    new_answers as new_answers,
    new_memory as new_memory,
    static_maps as static_maps,
    static_states as static_states,
)
from .structs import (
    PLANAR as PLANAR,
    SMOOTH as SMOOTH,
    VELOCITIES as VELOCITIES,
    Contacts as Contacts,
    MapPaths as MapPaths,
    Path as Path,
    Rotor as Rotor,
    StaticLoad as StaticLoad,
    System as System,
)
