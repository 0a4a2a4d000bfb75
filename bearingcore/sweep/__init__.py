"""Sweeps: grids of scenes on all cores, or on a cluster, to labelled arrays.

``from bearingcore.sweep import sweep``. Needs xarray, dask, distributed and zarr, which come with
``pip install "bearing-explorer[scale]"``; the rest of the core does not.
"""

from bearingcore.sweep.outputs import OUTPUTS, STATUSES
from bearingcore.sweep.run import sweep

__all__ = ["OUTPUTS", "STATUSES", "sweep"]
