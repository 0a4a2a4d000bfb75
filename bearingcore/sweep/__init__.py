"""Sweeps: grids of scenes on all cores, or on a cluster, to labelled arrays.

``from bearingcore.sweep import sweep``. Needs xarray, dask, distributed and zarr, which come with
``pip install "bearing-explorer[scale]"``; the rest of the core does not, nor do the outputs and
grids of this package: what needs them is imported when `sweep` is first asked for.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bearingcore.sweep.run import sweep
from bearingcore.sweep.grid import Axis, Grid, StillDirectionError, program_version
from bearingcore.sweep.outputs import (
    LIFE,
    MASS,
    MODES,
    OUTPUTS,
    SECONDS,
    STATICS,
    Settings,
    mode_labels,
    mode_symbol,
)
from bearingcore.sweep.status import STATUSES, SweepStatus

__all__ = [
    "LIFE",
    "MASS",
    "MODES",
    "OUTPUTS",
    "SECONDS",
    "STATICS",
    "STATUSES",
    "Axis",
    "Grid",
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
        from bearingcore.sweep.run import sweep

        return sweep
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
