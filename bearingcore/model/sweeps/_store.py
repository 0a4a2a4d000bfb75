"""The results of a sweep on disk, as Zarr, written region by region.

A finished region has a mark, a checksum of all its numbers. The mark is written after the numbers
in one step (Zarr writes a temporary file and moves it into place). A region that a killed process
left half-written has no mark, or numbers that do not fit it, and is computed again.
"""

from __future__ import annotations

import os
import shutil
import uuid
import warnings
import zlib
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Progress, _checks as checks
from bearingcore.errors import FieldError
from bearingcore.model.sweeps._grid import Grid, program_version
from bearingcore.model.sweeps._outputs import MODE, OUTPUTS, SAMPLE, SEED, Numbers
from bearingcore.model.sweeps._status import STATUSES

PROGRAM = "bearing-explorer"

MARKS = "regions/finished"
"""Array of the marks: 0, or a region's checksum plus one. It is not part of the opened results."""

STATUS = "status"


def attributes(grid: Grid) -> dict[str, Any]:
    """Return the attributes of the results: the scene, the request and the program."""
    return {
        "title": "Sweep over " + ", ".join(grid.dims),
        "program": PROGRAM,
        "program_version": program_version(),
        "scene": grid.scene.to_toml(),
        "request": grid.request,
        "period": f"{grid.settings.cage_angles} cage angles in a period",
    }


def variable_attributes(name: str) -> dict[str, Any]:
    """Return unit and meaning of an output or of the status."""
    if name == STATUS:
        return {
            "long_name": "status of the scene",
            "units": "1",
            "flag_values": list(range(len(STATUSES))),
            "flag_meanings": " ".join(STATUSES),
        }
    return {"long_name": OUTPUTS[name].meaning, "units": OUTPUTS[name].unit}


def coordinate_attributes(grid: Grid) -> dict[str, dict[str, Any]]:
    """Return the units of the axes."""
    units = {axis.name: axis.unit for axis in grid.axes} | {SAMPLE: "s"}
    return {name: {"units": unit} if unit else {} for name, unit in units.items()}


def coordinates(grid: Grid) -> dict[str, NDArray[Any]]:
    """Return the values of the axes and, if outputs need them, of modes, samples and seeds."""
    values = {axis.name: axis.values for axis in grid.axes}
    if any(OUTPUTS[name].per_mode for name in grid.outputs):
        values[MODE] = np.array(grid.labels)
    if any(OUTPUTS[name].per_sample for name in grid.outputs):
        values[SAMPLE] = grid.settings.record_time
        if grid.settings.has_several_seeds:
            values[SEED] = np.array(grid.settings.seed)
    return values


def local_path(store: str | os.PathLike[str]) -> Path:
    """Return the absolute folder of a store; ValueError for an address."""
    name = os.fspath(store) if isinstance(store, os.PathLike) else store
    if "://" in checks.instance("store", name, str, "a folder") or "\0" in name:
        raise checks.refuse("store", name, "a folder that this and all workers see")
    return Path(name).absolute()


def prepare(path: Path, grid: Grid, region_shape: Sequence[int]) -> tuple[int, ...]:
    """Make an empty store, or open one of the same sweep; return the shape of its regions.

    Raises
    ------
    ValueError
        if the folder holds something else, or results of another sweep.
    """
    if not path.exists() or (path.is_dir() and not any(path.iterdir())):
        _create(path, grid, region_shape)
    return _check_store(path, grid)


def _create(path: Path, grid: Grid, region_shape: Sequence[int]) -> None:
    """Create a store without results, in a temporary folder that is renamed in one step."""
    import zarr

    path.parent.mkdir(parents=True, exist_ok=True)
    aside = path.with_name(f".{path.name}.{uuid.uuid4().hex}")
    try:
        root = zarr.open_group(aside, mode="w", zarr_format=3, attributes=attributes(grid))
        units = coordinate_attributes(grid)
        for name, values in coordinates(grid).items():
            words = values.dtype.kind == "U"
            array = root.create_array(
                name,
                shape=values.shape,
                chunks=values.shape,
                dtype="string" if words else values.dtype,
                dimension_names=(name,),
                attributes=units.get(name, {}),
            )
            array[...] = values.astype(object) if words else values
        for name in (*grid.outputs, STATUS):
            output = name != STATUS
            root.create_array(
                name,
                shape=grid.shape_of(name) if output else grid.shape,
                chunks=grid.shape_of(name, region_shape) if output else tuple(region_shape),
                dtype="float64" if output else "int8",
                fill_value=float("nan") if output else 0,
                dimension_names=grid.dims_of(name) if output else grid.dims,
                attributes=variable_attributes(name),
            )
        root.create_array(
            MARKS,
            shape=grid.region_counts(region_shape),
            chunks=(1,) * len(grid.shape),
            dtype="uint64",
            fill_value=0,
        )
        with warnings.catch_warnings():
            # A single file describes all arrays, so that xarray opens the results in one step. Zarr
            # warns that its format does not specify this yet; other readers ignore the file.
            warnings.simplefilter("ignore")
            zarr.consolidate_metadata(aside)
        try:
            aside.rename(path)
        except OSError:
            if not (path.is_dir() and any(path.iterdir())):
                raise  # otherwise another process was first, and its store is checked
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _check_store(path: Path, grid: Grid) -> tuple[int, ...]:
    """Return the shape of the regions of a store; refuse a store of another sweep."""
    import zarr

    try:
        root: Any = zarr.open_group(path, mode="r", zarr_format=3)
        stored = dict(root.attrs)
        if stored.get("program") != PROGRAM or "request" not in stored:
            raise KeyError("request")
    except (OSError, ValueError, KeyError):
        raise _taken(path, "does not hold results of a sweep") from None
    expected = attributes(grid)
    for name, words in (
        ("scene", "another scene"),
        ("request", "a sweep over other fields, for other outputs or with other settings"),
        (
            "program_version",
            f"results of version {stored.get('program_version')} of this program, which is "
            f"{expected['program_version']} now and may compute other numbers: delete it, or go on "
            "with the version that began it",
        ),
    ):
        if stored.get(name) != expected[name]:
            raise _taken(path, f"holds {words}")
    for axis in grid.axes:
        try:
            values = np.asarray(root[axis.name][...])
        except Exception as error:  # half a file may raise anything in its decoder
            words = (
                f"is damaged in {axis.name} ({type(error).__name__}): delete it, or copy it back"
            )
            raise _taken(path, words) from None
        if not np.array_equal(values.astype(axis.values.dtype), axis.values):
            raise _taken(path, f"holds a sweep over other values of {axis.name}")
    return tuple(int(n) for n in root[STATUS].chunks)


def _taken(path: Path, words: str) -> FieldError:
    """Return the refusal of a folder with something else in it."""
    return checks.refuse("store", path.name, f"a new folder, or this sweep's own: {path} {words}")


class Region(NamedTuple):
    """A region of a store: its place, and its part of the grid."""

    path: str
    part: Grid
    place: tuple[slice, ...]
    region_index: tuple[int, ...]
    """index among the regions"""
    layout: tuple[tuple[int, ...], ...]
    """shapes of the whole and of a region, by which opened arrays are cached"""


def region(path: Path, grid: Grid, region_shape: tuple[int, ...], index: tuple[int, ...]) -> Region:
    """Return a region of the store of a grid."""
    place = grid.region(region_shape, index)
    return Region(str(path), grid.part(place), place, index, (grid.shape, region_shape))


def finish(region: Region, progress: Progress | None = None) -> bool:
    """Compute and write a region unless it is finished; return True if it was computed.

    An exception from `progress` ends the work before anything is written.
    """
    arrays = _arrays(region.path, region.part.outputs, region.layout)
    if is_finished(region):
        return False
    status, numbers = region.part.compute(progress)
    for name, values in numbers.items():
        arrays[name][region.place] = values
    arrays[STATUS][region.place] = status
    arrays[MARKS][region.region_index] = _checksum(status, numbers)
    return True


def is_finished(region: Region) -> bool:
    """Return True if a region has its mark, and all its numbers fit it."""
    arrays = _arrays(region.path, region.part.outputs, region.layout)
    try:
        mark = int(arrays[MARKS][region.region_index])
        if mark == 0:
            return False
        status = np.asarray(arrays[STATUS][region.place])
        numbers = {name: np.asarray(arrays[name][region.place]) for name in region.part.outputs}
    except Exception:  # half a file may raise anything in its decoder
        return False
    return _checksum(status, numbers) == mark


def _checksum(status: NDArray[np.int8], numbers: Numbers) -> int:
    """Return a checksum, above 0, of all bytes of a region's results."""
    sum_ = zlib.crc32(np.ascontiguousarray(status).tobytes())
    for name in sorted(numbers):
        sum_ = zlib.crc32(np.ascontiguousarray(numbers[name]).tobytes(), sum_)
    return sum_ + 1


@lru_cache(maxsize=2)
def _arrays(
    path: str, outputs: tuple[str, ...], layout: tuple[tuple[int, ...], ...]
) -> dict[str, Any]:
    """Return the arrays of a store, cached, as opening them takes longer than writing a region."""
    import zarr

    root = zarr.open_group(path, mode="r+", zarr_format=3)
    return {name: root[name] for name in (*outputs, STATUS, MARKS)}
