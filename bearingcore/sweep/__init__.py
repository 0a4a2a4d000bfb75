"""Sweeps: grids of scenes on all cores, or on a cluster, to labelled arrays.

``from bearingcore.sweep import sweep``. Needs xarray, dask, distributed and zarr, which come with
``pip install "bearing-explorer[scale]"``; the rest of the core does not, nor do the outputs and
grids of this package: what needs them is imported when `sweep` is first asked for.
"""

from typing import TYPE_CHECKING, Any

from bearingcore.sweep.outputs import OUTPUTS
from bearingcore.sweep.status import STATUSES, SweepStatus

if TYPE_CHECKING:
    from bearingcore.sweep.run import sweep

__all__ = ["OUTPUTS", "STATUSES", "SweepStatus", "sweep"]


def __getattr__(name: str) -> Any:
    if name == "sweep":
        from bearingcore.sweep.run import sweep

        return sweep
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
