"""Sweeps: grids of scenes on all cores, or on a cluster, to labelled arrays.

``from bearingcore.sweep import sweep``. Needs xarray, dask, distributed and zarr, which come with
``pip install "bearing-explorer[scale]"``; the rest of the core does not, nor do the outputs and
grids of this package: what needs them is imported when `sweep` is first asked for.
"""

from typing import TYPE_CHECKING, Any

from bearingcore.sweep.grid import Axis as Axis
from bearingcore.sweep.grid import Grid as Grid
from bearingcore.sweep.grid import StillDirectionError as StillDirectionError
from bearingcore.sweep.grid import program_version as program_version
from bearingcore.sweep.outputs import LIFE as LIFE
from bearingcore.sweep.outputs import MASS as MASS
from bearingcore.sweep.outputs import MODES as MODES
from bearingcore.sweep.outputs import OUTPUTS as OUTPUTS
from bearingcore.sweep.outputs import PRESSURE as PRESSURE
from bearingcore.sweep.outputs import SECONDS as SECONDS
from bearingcore.sweep.outputs import STATICS as STATICS
from bearingcore.sweep.outputs import Settings as Settings
from bearingcore.sweep.outputs import mode_labels as mode_labels
from bearingcore.sweep.outputs import mode_symbol as mode_symbol
from bearingcore.sweep.status import STATUSES as STATUSES
from bearingcore.sweep.status import SweepStatus as SweepStatus

if TYPE_CHECKING:
    from bearingcore.sweep.run import sweep as sweep


def __getattr__(name: str) -> Any:
    if name == "sweep":
        from bearingcore.sweep.run import sweep

        return sweep
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
