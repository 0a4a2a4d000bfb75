"""``bearing-sweep``: a file's sweep into a folder, with its progress; begun again, it goes on."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from bearingcore.common.scene_file import LARGEST_TEXT
from bearingcore.sweep.file import grid_from_toml
from bearingcore.sweep.grid import Grid
from bearingcore.sweep.run import needs_extra, run
from bearingcore.sweep.status import STATUSES

ASK_ABOVE = 10_000_000
"""More scenes than this are computed only with --yes."""


def options(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        prog="bearing-sweep",
        description="Compute every scene of a grid. A sweep that was stopped resumes when the "
        "command is given again.",
    )
    parser.add_argument("file", type=Path, help="TOML: a scene and a table [sweep]")
    parser.add_argument(
        "--out", type=Path, required=True, metavar="FOLDER", help="for the results, as Zarr"
    )
    parser.add_argument(
        "--scheduler", metavar="ADDRESS", help="of a Dask cluster, such as tcp://host:8786"
    )
    parser.add_argument(
        "--workers", type=int, help="processes on this machine (one a core); not with --scheduler"
    )
    parser.add_argument("--scenes-per-task", type=int, help="(about four seconds of work)")
    parser.add_argument(
        "--yes", action="store_true", help=f"go on even with more than {ASK_ABOVE:,} scenes"
    )
    chosen = parser.parse_args(arguments)
    if chosen.scheduler and chosen.workers is not None:
        parser.error("--workers counts processes on this machine; a --scheduler has its own")
    return chosen


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code."""
    chosen = options(arguments)
    try:
        return _run(chosen)
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        print(f"bearing-sweep: {where}{error.strerror or error}", file=sys.stderr)
        return 1
    except (ImportError, RuntimeError, ValueError) as error:
        print(f"bearing-sweep: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nStopped. The same command resumes the sweep.", file=sys.stderr)
        return 130


def _run(chosen: argparse.Namespace) -> int:
    needs_extra()
    import dask.array
    from tqdm import tqdm

    grid = grid_from_toml(_text(chosen.file))
    print(_in_words(grid))
    if grid.size > ASK_ABOVE and not chosen.yes:
        print(f"More than {ASK_ABOVE:,} scenes: add --yes if that is meant.", file=sys.stderr)
        return 2
    with tqdm(total=grid.size, unit="scene", unit_scale=True) as bar:

        def progress(part: float, words: str) -> None:
            bar.update(round(part * grid.size) - bar.n)

        results = run(
            grid,
            client=chosen.scheduler,
            store=chosen.out,
            workers=chosen.workers,
            processes=True,
            scenes_per_task=chosen.scenes_per_task,
            progress=progress,
            say=bar.write,
        )
    edges = np.arange(len(STATUSES) + 1) - 0.5
    counts, _ = dask.array.histogram(results["status"].data, bins=edges)
    for code, count in enumerate(counts.compute()):
        if count:
            print(f"{int(count):12,} {STATUSES[code].replace('_', ' ')}")
    print(f'Results: xarray.open_zarr("{chosen.out}")')
    return 0


def _text(path: Path) -> str:
    try:
        with path.open(encoding="utf-8") as file:
            return file.read(LARGEST_TEXT + 1)
    except UnicodeDecodeError:
        raise ValueError(f"{path} is not a text in UTF-8") from None


def _in_words(grid: Grid) -> str:
    axes = " × ".join(f"{len(axis.values):,} {axis.name}" for axis in grid.axes)
    numbers = sum(math.prod(grid.shape_of(name, ())) for name in grid.outputs)
    size = grid.size * (8 * numbers + 1)
    return (
        f"{grid.size:,} scenes ({axes}), {numbers} numbers of each: "
        f"at most {size / 1e6:,.2f} MB before compression"
    )


if __name__ == "__main__":
    sys.exit(main())
