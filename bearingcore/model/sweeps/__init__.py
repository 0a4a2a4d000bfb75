"""Sweeps: labelled arrays of results for grids of scenes, on all cores or on a cluster.

`sweep` needs xarray, dask, distributed and zarr, which ``pip install "bearing-explorer[scale]"``
installs. They are imported when `sweep` is first used; the outputs and grids of this package, and
the rest of the core, do without them.
"""

from typing import TYPE_CHECKING, Any

from bearingcore.model.sweeps._grid import (
    Axis as Axis,
    Grid as Grid,
    StillDirectionError as StillDirectionError,
    program_version as program_version,
)
from bearingcore.model.sweeps._outputs import (
    LIFE as LIFE,
    MASS as MASS,
    MODES as MODES,
    OUTPUTS as OUTPUTS,
    PRESSURE as PRESSURE,
    SECONDS as SECONDS,
    STATICS as STATICS,
    Output as Output,
    Settings as Settings,
    mode_labels as mode_labels,
    mode_symbol as mode_symbol,
)
from bearingcore.model.sweeps._status import (
    STATUSES as STATUSES,
    SweepStatus as SweepStatus,
)

if TYPE_CHECKING:
    from bearingcore.model.sweeps._run import sweep as sweep


def __getattr__(name: str) -> Any:
    if name == "sweep":
        from bearingcore.model.sweeps._run import sweep

        return sweep
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
