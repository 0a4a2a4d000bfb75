"""What a scene of a sweep costs, and how that scales: ``python -m tests.benchmarks.sweep_scaling``.

Sweeps on a local cluster of worker processes, written to Zarr as any sweep is. Wall time is told
beside the processor time of the workers, which other programs on the machine disturb less. Last
comes an estimate for 1000 cores: not measured, but put together from what was.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from distributed import Client, LocalCluster

from bearingcore import Scene, presets
from bearingcore.sweep import STATUSES, sweep
from bearingcore.sweep import store as stores
from bearingcore.sweep.grid import Grid
from bearingcore.sweep.run import _finished
from tests.benchmarks.machine import pace

STATICS = ("k_*", "loaded_balls_*", "ball_load_greatest", "converged_share")
MOTION = ("acceleration_*_x", "acceleration_*_y")
RIG, ANGULAR = presets["fan-rig"], presets["liew-lim"]
HERE = "localhost:0"

CORES = 1000
FILES = 2000
"""Files a second that a shared folder is trusted to take: what a modest NFS server does."""
START = 20.0
"""[s] to start workers and load kernels on all."""


class Kind(NamedTuple):
    """One kind of scene: how it is told, from what, over what, asking for what."""

    words: str
    scene: Scene
    fields: tuple[str, ...]
    outputs: tuple[str, ...]


ROWS = Kind("static, 2 directions, extent varies", RIG, ("extent", "depth", "fx", "fy"), STATICS)
SINGLE = Kind("static, 2 directions, one by one", RIG, ("depth", "fx", "fy"), STATICS)
FIVE = Kind("static, 5 directions, extent varies", ANGULAR, ("extent", "fx", "fy"), STATICS)
BANDS = Kind("bands, 5 directions, extent varies", ANGULAR, ("extent", "fx", "fy"), ("band_*",))
BANDS_ALONE = Kind("bands, 5 directions, one by one", ANGULAR, ("fx", "fy"), ("band_*",))
MOVING = Kind("simulated 1.4 s, 2 directions", RIG, ("extent", "fy", "shaft_speed"), MOTION)

RANGES = {
    "extent": (0.01, 1.5),
    "depth": (1e-5, 1e-4),
    "fx": (-50.0, 50.0),
    "fy": (-300.0, -50.0),
    "shaft_speed": (20.0, 120.0),
}


def grid_over(kind: Kind, scenes: int) -> dict[str, np.ndarray[Any, Any]]:
    """Axes of at least as many scenes as asked for, with much the same number of values each."""
    over = {}
    left, fields = scenes, list(kind.fields)
    while fields:
        name = fields.pop()
        size = max(math.ceil(left ** (1.0 / (len(fields) + 1)) - 1e-9), 1)
        over[name] = np.linspace(*RANGES[name], size)
        left = max(math.ceil(left / size), 1)
    return {name: over[name] for name in kind.fields}


@contextmanager
def workers(count: int) -> Iterator[Client]:
    """A cluster of worker processes with their kernels loaded."""
    with (
        LocalCluster(
            n_workers=count,
            threads_per_worker=1,
            processes=True,
            dashboard_address=HERE,
            worker_dashboard_address=HERE,
        ) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        client.wait_for_workers(count, timeout=120)
        client.run(_warm)
        yield client


def _warm() -> None:
    for kind in (ROWS, SINGLE, FIVE, BANDS, BANDS_ALONE, MOVING):
        Grid.of(kind.scene, grid_over(kind, 2), kind.outputs).compute()


def _processor_time() -> float:
    return time.process_time()


class Cost(NamedTuple):
    """Of a scene [s]: wall time times workers, and processor time."""

    wall: float
    processor: float


def run(client: Client, kind: Kind, scenes: int, count: int) -> Cost:
    """Time one sweep and print its row."""
    over = grid_over(kind, scenes)
    grid = Grid.of(kind.scene, over, kind.outputs)
    machine = pace()
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "sweep.zarr"
        before = sum(client.run(_processor_time).values())
        began = time.perf_counter()
        found = sweep(kind.scene, over, kind.outputs, client, store)
        wall = time.perf_counter() - began
        processor = sum(client.run(_processor_time).values()) - before
        status = found["status"].values
        files = sum(len(names) for _, _, names in os.walk(store))
        size = sum(file.stat().st_size for file in store.rglob("*") if file.is_file())
    regions = math.prod(grid.region_counts(grid.region_shape()))
    complete = np.mean(status == STATUSES.index("complete"))
    cost = Cost(wall * count / grid.size, processor / grid.size)
    print(
        f"{kind.words:36}{grid.size:>10,}{count:>8}{wall:>9.1f}"
        f"{1e3 * cost.wall:>11.3f}{1e3 * cost.processor:>11.3f}"
        f"{cost.processor / machine.motion:>8.3f} C"
        f"{regions:>7}{files:>8}{size / 1e6:>8.1f}{100.0 * complete:>9.1f}",
        flush=True,
    )
    return cost


def _nothing(task: int) -> int:
    return task


def writing_a_region() -> float:
    """Wall time [s] to write a region with all static outputs."""
    grid = Grid.of(RIG, grid_over(ROWS, 20_000), STATICS)
    spent = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "files.zarr"
        shape = stores.prepare(path, grid, grid.region_shape(200))
        for index in list(np.ndindex(*grid.region_counts(shape)))[:12]:
            region = stores.region(path, grid, shape, index)
            began = time.perf_counter()
            region.part.compute()
            computed = time.perf_counter() - began
            stores.finish(region)
            spent.append(time.perf_counter() - began - 2.0 * computed)
    return float(np.median(spent))


def tasks_a_second(client: Client, tasks: int) -> float:
    """How many tasks without work scheduler and client carry, here with the workers beside them."""
    list(_finished(client, _nothing, range(50)))
    began = time.perf_counter()
    for _ in _finished(client, _nothing, range(tasks)):
        pass
    return tasks / (time.perf_counter() - began)


def estimate(kind: Kind, cost: float, scenes: int, rate: float) -> None:
    """In sentences, what 1000 cores like these would do with so many scenes."""
    grid = Grid.of(kind.scene, grid_over(kind, scenes), kind.outputs)
    in_task = math.prod(grid.region_shape())
    asked = CORES / (in_task * cost)
    files = (len(grid.outputs) + 2) * asked
    print(
        f"  {kind.words}: a task of {in_task:,} scenes takes {in_task * cost:.2f} s, so they would"
        f"\n    end {asked:,.0f} tasks and write {files:,.0f} files a second."
    )
    longer = max(1, math.ceil(asked / (0.5 * rate)), math.ceil(files / FILES))
    if longer > 1:
        print(
            f"    That is more than to count on (half of the tasks that are handed out here, and"
            f"\n    {FILES:,} files): take --scenes-per-task {longer * in_task:,}."
        )
    compute = grid.size * cost / CORES
    tail = 0.5 * longer * in_task * cost
    whole = compute + START + tail
    print(
        f"    {grid.size:,} scenes: {compute:,.0f} s of computing, {START:.0f} s for workers to "
        f"start, {tail:.0f} s until the\n    last is done: {whole:,.0f} s, of which "
        f"{100.0 * compute / whole:.0f} % is computing."
    )


def main() -> int:
    """Run what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--static", type=int, default=1_000_000, help="scenes (1,000,000)")
    parser.add_argument("--simulated", type=int, default=10_000, help="scenes (10,000)")
    parser.add_argument(
        "--scaling",
        type=float,
        default=0.1,
        help="part of them in the table of 1 and 2 workers (0.1)",
    )
    parser.add_argument("--tasks", type=int, default=2000, help="tasks without work (2000)")
    chosen = parser.parse_args()
    print(f"{os.cpu_count()} cores as this begins; {pace()}")
    print(
        f"{'':36}{'scenes':>10}{'workers':>8}{'wall s':>9}{'ms·w/scene':>11}{'cpu ms':>11}{'':>10}"
        f"{'tasks':>7}{'files':>8}{'MB':>8}{'known %':>9}"
    )
    costs: dict[tuple[Kind, int], Cost] = {}
    rate = 0.0
    part_static = max(round(chosen.static * chosen.scaling), 100)
    part_simulated = max(round(chosen.simulated * chosen.scaling), 16)
    for count in (1, 2):
        with workers(count) as client:
            for kind, scenes in (
                (ROWS, part_static),
                (FIVE, part_static // 2),
                (SINGLE, part_static // 4),
                (BANDS, part_static // 5),
                (BANDS_ALONE, part_static // 10),
                (MOVING, part_simulated),
            ):
                costs[kind, count] = run(client, kind, scenes, count)
            if count == 2:
                whole = {
                    ROWS: run(client, ROWS, chosen.static, count),
                    MOVING: run(client, MOVING, chosen.simulated, count),
                }
                rate = tasks_a_second(client, chosen.tasks)
    print("\nFrom 1 to 2 workers: so many times as fast, and what the processor says it could be")
    for kind in (ROWS, FIVE, SINGLE, BANDS, BANDS_ALONE, MOVING):
        one, two = costs[kind, 1], costs[kind, 2]
        print(
            f"  {kind.words:36}{2.0 * one.wall / two.wall:6.2f}"
            f"{2.0 * one.processor / two.processor:6.2f}"
        )
    print(
        f"\n{rate:,.0f} tasks without work a second; {1e3 * writing_a_region():.0f} ms to write "
        f"the {len(Grid.of(RIG, grid_over(ROWS, 9), STATICS).outputs)} static outputs of a region"
    )
    print(f"{os.cpu_count()} cores as this ends; {pace()}")
    print(
        f"\nEstimate for {CORES} cores, from the processor time; not measured. It takes them to be "
        f"as fast as these,\nnone of them shared, the scheduler on one of its own, and a folder "
        f"that takes {FILES:,} new files a second:"
    )
    estimate(ROWS, whole[ROWS].processor, 1_000_000_000, rate)
    estimate(MOVING, whole[MOVING].processor, 10_000_000, rate)
    return 0


if __name__ == "__main__":
    sys.exit(main())
