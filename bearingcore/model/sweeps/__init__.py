"""Sweeps: labelled arrays of results for grids of scenes, on all cores or on a cluster.

`sweep` needs xarray, dask, distributed and zarr, which ``pip install "bearing-explorer[scale]"``
installs. They are imported when `sweep` is first used; the outputs and grids of this package, and
the rest of the core, do without them.
"""

from typing import TYPE_CHECKING, Any

from bearingcore.model.sweeps._grid import Axis, Grid, StillDirectionError, program_version
from bearingcore.model.sweeps._outputs import (
    LIFE,
    MASS,
    MODES,
    OUTPUTS,
    PRESSURE,
    SECONDS,
    STATICS,
    Output,
    Settings,
    mode_labels,
    mode_symbol,
)
from bearingcore.model.sweeps._status import STATUSES, SweepStatus

if TYPE_CHECKING:
    from bearingcore.model.sweeps._run import sweep

__all__ = [
    "LIFE",
    "MASS",
    "MODES",
    "OUTPUTS",
    "PRESSURE",
    "SECONDS",
    "STATICS",
    "STATUSES",
    "Axis",
    "Grid",
    "Output",
    "Settings",
    "StillDirectionError",
    "SweepStatus",
    "mode_labels",
    "mode_symbol",
    "program_version",
    "sweep",
]


def __getattr__(name: str) -> Any:
    if name == "sweep":
        from bearingcore.model.sweeps._run import sweep

        return sweep
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
