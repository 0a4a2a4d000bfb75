"""Sweeps: all scenes of a grid, computed on Dask, as an xarray.Dataset."""

from __future__ import annotations

import asyncio
import dataclasses
import errno
import importlib
import logging
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from itertools import count, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bearingcore.common import Progress, _checks as checks
from bearingcore.common._progress import CancelledError
from bearingcore.model.scene import Scene
from bearingcore.model.sweeps import _store as stores
from bearingcore.model.sweeps._grid import Grid, program_version
from bearingcore.model.sweeps._outputs import Settings

if TYPE_CHECKING:
    import xarray
    from distributed import Client, LocalCluster

MOST_BYTES = 2_000_000_000
"""Greatest size of results in memory; larger ones need a store."""

AHEAD = 4
"""Number of submitted tasks per thread of the cluster: enough that no thread waits, and few enough
for the scheduler, even if there are millions in all."""

LOOK_AGAIN = 5.0
"""Time [s] between two requests for the size of the cluster."""

_NOT_WRITABLE = {
    *(errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOENT, errno.ENOTDIR, errno.EEXIST),
    *(errno.ENAMETOOLONG, errno.ELOOP),
}
FULL = "the disk is full. What is finished is kept: the same sweep resumes once there is room"

LOST = "the scheduler or the connection to it is lost; what is finished is kept in the store"


def needs_extra() -> None:
    """Raise ImportError with the remedy if a package that sweeps need is missing."""
    try:
        for name in ("xarray", "dask", "distributed", "zarr"):
            importlib.import_module(name)
    except ImportError as error:
        raise ImportError(
            f"sweeps need xarray, dask, distributed and zarr ({error}): "
            'pip install "bearing-explorer[scale]"'
        ) from error


def sweep(
    scene: Scene,
    over: Mapping[str, Any],
    outputs: Iterable[str],
    client: Client | str | None = None,
    store: str | os.PathLike[str] | None = None,
    *,
    settings: Settings | None = None,
    workers: int | None = None,
    processes: bool = False,
    scenes_per_task: int | None = None,
    progress: Progress | None = None,
    **resolution: Any,
) -> xarray.Dataset:
    """Compute outputs for all combinations of values of some fields of `scene`.

    Parameters
    ----------
    scene
        the scene; fields that are not in `over` keep its values.
    over
        fields of `Scene.replace`, each with its values in SI units; they become the dimensions of
        the result, in this order.
    outputs
        names out of `bearingcore.model.sweeps.OUTPUTS`; `*` and `?` stand for any letters.
    client
        a `distributed.Client`, or the address of a scheduler. None computes on this machine.
    store
        folder for the results, to which the workers write Zarr regions: all workers must see it. If
        it already holds a part of the same sweep, only the rest is computed. None keeps results
        in memory.
    settings
        the resolution, and the random effects of records; see `Settings`.
    resolution
        single fields of `Settings` by name, such as ``duration=0.5``, instead of those of
        `settings`.
    workers, processes
        on this machine: the number of workers (None: one per core), and True for processes instead
        of threads. Processes share nothing and are faster, but take a second or two to start; a
        script must start them under ``if __name__ == "__main__":``.
    scenes_per_task
        None takes about four seconds of work. A resumed store keeps its number.
    progress
        called about ten times a second with the part done, 0 to 1, and a sentence; an exception
        from it, as Ctrl-C, stops the sweep at once.

    Returns
    -------
    xarray.Dataset
        a variable for each output with its unit in `attrs`, and `status` with codes of
        `bearingcore.model.sweeps.STATUSES`; NaN where there is no answer. Its `attrs` hold the
        scene as TOML, the request and the version of the program. From a store it is lazy.

    Raises
    ------
    ImportError
        if xarray, dask, distributed or zarr are missing.
    ValueError
        for impossible arguments, and if `store` holds anything but this sweep.
    ConnectionError
        if the scheduler cannot be reached or is lost. Finished parts are in the store.
    """
    needs_extra()
    for name in resolution.keys() - {field.name for field in dataclasses.fields(Settings)}:
        allowed = ", ".join(field.name for field in dataclasses.fields(Settings))
        raise checks.refuse("argument of sweep", name, f"also {allowed}, of Settings")
    settings = dataclasses.replace(settings or Settings(), **resolution)
    grid = Grid.of(scene, over, outputs, settings)
    if scenes_per_task is not None:
        scenes_per_task = checks.whole_number(
            "scenes_per_task", scenes_per_task, at_least=1, at_most=10_000_000
        )
    if workers is not None:
        workers = checks.whole_number("workers", workers, at_least=1, at_most=1000)
    region_shape = grid.region_shape(scenes_per_task)
    cluster = _cluster(client, workers, processes)
    if store is None:
        return _sweep_in_memory(grid, region_shape, cluster, progress)
    path = stores.local_path(store)
    try:
        return _sweep_to_store(path, grid, region_shape, cluster, progress)
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            raise OSError(error.errno, FULL, str(path)) from None
        if error.errno not in _NOT_WRITABLE:
            raise
        allowed = f"a folder that can be written ({error.strerror})"
        raise checks.refuse("store", str(path), allowed) from None


Cluster = AbstractContextManager["Client"]


def _sweep_to_store(
    path: Path,
    grid: Grid,
    region_shape: tuple[int, ...],
    cluster: Cluster,
    progress: Progress | None,
) -> xarray.Dataset:
    import xarray

    region_shape = stores.prepare(path, grid, region_shape)
    regions = (
        stores.region(path, grid, region_shape, index)
        for index in np.ndindex(*grid.region_counts(region_shape))
    )
    done = _Progress(grid.size, progress)
    with cluster as client:
        seen = False
        for region, computed in _finished(client, stores.finish, regions, done.report):
            if not (seen or stores.is_finished(region)):
                raise checks.refuse(
                    "store",
                    str(path),
                    "a folder that all workers share: one wrote to it and nothing is there",
                )
            seen = True
            done.add(region.part.size, kept=not computed)
    return xarray.open_zarr(path)


def _sweep_in_memory(
    grid: Grid, region_shape: tuple[int, ...], cluster: Cluster, progress: Progress | None
) -> xarray.Dataset:
    import xarray

    per_scene = 1 + 8 * sum(np.prod(grid.shape_of(name, (1,))) for name in grid.outputs)
    if grid.size * per_scene > MOST_BYTES:
        raise checks.refuse(
            "size of the results",
            f"{grid.size * per_scene / 1e9:.1f} GB",
            f"at most {MOST_BYTES / 1e9:g} GB in memory; give a store for more",
        )
    status = np.zeros(grid.shape, dtype=np.int8)
    numbers = {name: np.full(grid.shape_of(name), np.nan) for name in grid.outputs}
    places = (
        grid.region(region_shape, index) for index in np.ndindex(*grid.region_counts(region_shape))
    )
    parts = ((place, grid.part(place)) for place in places)
    done = _Progress(grid.size, progress)
    with cluster as client:
        for (place, part), (codes, part_numbers) in _finished(client, _compute, parts, done.report):
            status[place] = codes
            for name, values in part_numbers.items():
                numbers[name][place] = values
            done.add(part.size)
    units = stores.coordinate_attributes(grid)
    variables = {
        name: (grid.dims_of(name), values, stores.variable_attributes(name))
        for name, values in numbers.items()
    }
    name = stores.STATUS
    return xarray.Dataset(
        {**variables, name: (grid.dims, status, stores.variable_attributes(name))},
        coords={
            name: (name, values, units.get(name, {}))
            for name, values in stores.coordinates(grid).items()
        },
        attrs=stores.attributes(grid),
    )


def _compute(task: tuple[Any, Grid], progress: Progress) -> Any:
    return task[1].compute(progress)


class _Progress:
    """Counts finished scenes and reports them."""

    def __init__(self, size: int, progress: Progress | None) -> None:
        self._size = size
        self._progress = progress
        self._done = self._kept = 0

    def add(self, scenes: int, kept: bool = False) -> None:
        self._done += scenes
        self._kept += scenes if kept else 0
        self.report()

    def report(self) -> None:
        if self._progress is not None:
            words = f"{self._done:,} of {self._size:,} scenes"
            if self._kept:
                words += f", {self._kept:,} of them from before"
            self._progress(self._done / self._size, words)


@contextmanager
def _cluster(client: Client | str | None, workers: int | None, processes: bool) -> Iterator[Client]:
    """Yield the client; a cluster or client that is started here is also stopped here."""
    from distributed import Client, LocalCluster

    if client is not None and not isinstance(client, str):
        yield client
        return
    if isinstance(client, str):
        try:
            connected = Client(client, set_as_default=False)
        except (OSError, ValueError) as error:
            raise ConnectionError(f"no scheduler answers at {client}: {error}") from None
        with connected:
            yield connected
        return
    cores = workers or os.cpu_count() or 1
    shape = (
        {"n_workers": cores, "threads_per_worker": 1}
        if processes
        # no limit for threads, as they share the memory of their host with its other work
        else {"n_workers": 1, "threads_per_worker": cores, "memory_limit": 0}
    )
    here = "localhost:0"  # Dask's pages are for this machine alone, on any free port
    with ExitStack() as open_:
        try:
            cluster = open_.enter_context(
                LocalCluster(
                    processes=processes,
                    dashboard_address=here,
                    worker_dashboard_address=here,
                    # an error of a task is raised here too, and should not be logged as well
                    silence_logs=logging.CRITICAL,
                    **shape,
                )
            )
        except RuntimeError as error:
            raise RuntimeError(
                f"a worker ended while it was starting ({cores} of them were to start): is there "
                "enough memory, and may this program start others? Any message of the "
                f"worker is above. ({error})"
            ) from error
        try:
            yield open_.enter_context(Client(cluster, set_as_default=False))
        except BaseException:
            if processes:
                cluster.sync(_end_processes, cluster)
            raise


async def _end_processes(cluster: LocalCluster) -> None:
    """End the workers' processes at once; Dask would wait four seconds for running tasks."""
    closing = (nanny.close(timeout=0.1) for nanny in cluster.workers.values())
    await asyncio.gather(*closing, return_exceptions=True)


def _finished(
    client: Client,
    work: Callable[[Any, Progress], Any],
    tasks: Iterable[Any],
    report: Callable[[], object],
) -> Iterator[tuple[Any, Any]]:
    """Yield each task with the result of `work` on the cluster, as tasks end.

    `report` is called again and again while the next result is awaited.
    """
    from distributed import KilledWorker, as_completed
    from distributed.client import FutureCancelledError

    waiting = iter(tasks)
    running: dict[Any, Any] = {}
    done = as_completed([], loop=client.loop)
    version = program_version()
    threads, looked = 0, -LOOK_AGAIN
    try:
        while True:
            try:
                if time.monotonic() - looked > LOOK_AGAIN:
                    threads = max(sum(client.nthreads().values()), 1)
                    looked = time.monotonic()
                # keep AHEAD tasks per thread submitted
                for task in islice(waiting, max(AHEAD * threads - len(running), 0)):
                    future = client.submit(_on_worker, version, work, task, pure=False)
                    running[future] = task
                    done.add(future)
            except OSError as error:
                raise ConnectionError(LOST) from error
            if not running:
                return
            # wait for the next result, and report meanwhile
            for waited in count():
                if done.has_ready():
                    break
                time.sleep(0.01)
                if waited % 10 == 9:
                    report()
            future = next(done)
            try:
                result = future.result()
            except FutureCancelledError as error:
                raise ConnectionError(LOST) from error
            except OSError as error:
                if future.status == "error":  # an error of the task, such as a full disk
                    raise
                raise ConnectionError(LOST) from error
            except KilledWorker as error:
                raise RuntimeError(
                    "workers died again and again at the same task; is there enough memory? "
                    f"What is finished is kept in the store. ({error})"
                ) from error
            yield running.pop(future), result
    finally:
        if running and client.status == "running":
            client.cancel(list(running), force=True)


def _on_worker(version: str, work: Callable[[Any, Progress], Any], task: Any) -> Any:
    """Do the work on a worker of the same program version, until the task is cancelled."""
    from distributed import get_worker

    here = program_version()
    if here != version:
        raise checks.refuse("version of a worker", here, f"{version}, which started the sweep")
    worker = get_worker()
    key = worker.get_current_task()

    def still_wanted(*_: object) -> None:
        """Raise CancelledError if the task was cancelled, as Dask itself would let it run on."""
        state = worker.state.tasks.get(key)
        if state is None or state.state == "cancelled":
            raise CancelledError("the sweep was stopped")

    return work(task, still_wanted)
