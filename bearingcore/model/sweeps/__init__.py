"""Sweeps: grids of scenes on all cores, or on a cluster, to labelled arrays.

``from bearingcore.model.sweeps import sweep``. Needs xarray, dask, distributed and zarr, which come
with ``pip install "bearing-explorer[scale]"``; the rest of the core does not, nor do the outputs
and grids of this package: what needs them is imported when `sweep` is first asked for.
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
