"""Compiled code: small structs of numbers and arrays in, arrays out; one module a subject.

Nothing here knows of the rest of bearingcore, and no compiled function takes more than eight
arguments. `compiling` says how functions are compiled and kept on disk.
"""

from bearingcore.model._kernels.balls.motion import march_balls as march_balls
from bearingcore.model._kernels.balls.positions import StaticBalls as StaticBalls
from bearingcore.model._kernels.balls.positions import ball_positions as ball_positions
from bearingcore.model._kernels.balls.structs import BallSystem as BallSystem
from bearingcore.model._kernels.balls.structs import Races as Races
from bearingcore.model._kernels.compiling import all_on_disk as all_on_disk
from bearingcore.model._kernels.compiling import kept_on_disk as kept_on_disk
from bearingcore.model._kernels.modes import DOUBTFUL as DOUBTFUL
from bearingcore.model._kernels.modes import modes_like as modes_like
from bearingcore.model._kernels.motion.march import elastic_loads as elastic_loads
from bearingcore.model._kernels.motion.march import interpolate_steps as interpolate_steps
from bearingcore.model._kernels.motion.march import march as march
from bearingcore.model._kernels.motion.march import motion_rates as motion_rates
from bearingcore.model._kernels.motion.march import side_by_side as side_by_side
from bearingcore.model._kernels.motion.march import sliding_sums as sliding_sums
from bearingcore.model._kernels.motion.march import turn_smooth as turn_smooth
from bearingcore.model._kernels.path import EVERY_ROW as EVERY_ROW
from bearingcore.model._kernels.path import INNER_EXACT as INNER_EXACT
from bearingcore.model._kernels.path import PATH_COLUMNS as PATH_COLUMNS
from bearingcore.model._kernels.path import TABLE as TABLE
from bearingcore.model._kernels.path import ball_path as ball_path
from bearingcore.model._kernels.path import drops_of as drops_of
from bearingcore.model._kernels.path import roll_over as roll_over
from bearingcore.model._kernels.statics import BEYOND as BEYOND
from bearingcore.model._kernels.statics import CONVERGED as CONVERGED
from bearingcore.model._kernels.statics import FREE_DIRECTION as FREE_DIRECTION
from bearingcore.model._kernels.statics import NO_PIVOT as NO_PIVOT
from bearingcore.model._kernels.statics import NOT_CARRIED as NOT_CARRIED
from bearingcore.model._kernels.statics import NOT_CONVERGED as NOT_CONVERGED
from bearingcore.model._kernels.statics import NOTHING_TOUCHES as NOTHING_TOUCHES
from bearingcore.model._kernels.statics import OPEN as OPEN
from bearingcore.model._kernels.statics import REFUSED as REFUSED
from bearingcore.model._kernels.statics import RESIDUAL_AIM as RESIDUAL_AIM
from bearingcore.model._kernels.statics import RESIDUAL_LIMIT as RESIDUAL_LIMIT
from bearingcore.model._kernels.statics import TOO_MANY as TOO_MANY
from bearingcore.model._kernels.statics import new_answers as new_answers
from bearingcore.model._kernels.statics import new_memory as new_memory
from bearingcore.model._kernels.statics import static_maps as static_maps
from bearingcore.model._kernels.statics import static_states as static_states
from bearingcore.model._kernels.structs import PLANAR as PLANAR
from bearingcore.model._kernels.structs import SMOOTH as SMOOTH
from bearingcore.model._kernels.structs import VELOCITIES as VELOCITIES
from bearingcore.model._kernels.structs import Contacts as Contacts
from bearingcore.model._kernels.structs import MapPaths as MapPaths
from bearingcore.model._kernels.structs import Path as Path
from bearingcore.model._kernels.structs import Rotor as Rotor
from bearingcore.model._kernels.structs import StaticLoad as StaticLoad
from bearingcore.model._kernels.structs import System as System
