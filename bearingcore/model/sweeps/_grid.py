"""Grid: the scenes of a sweep, the requested outputs, and the regions that become its tasks."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Progress, _checks as checks, cached_property
from bearingcore.errors import FieldError
from bearingcore.fields import FIELD_OF, SCENE_FIELDS
from bearingcore.model.scene import DOF_NAMES, MASSLESS, Defect, Scene
from bearingcore.model.statics._life import race_ratings
from bearingcore.model.sweeps._outputs import (
    IN_ROWS,
    LIFE,
    MODE,
    MODES,
    MOVING,
    OUTPUTS,
    PRESSURE,
    RECORD,
    SAMPLE,
    SECONDS,
    SECONDS_IN_A_ROW,
    SEED,
    Numbers,
    Settings,
    chosen_outputs,
    mode_labels,
    of_row,
    of_scene,
)
from bearingcore.model.sweeps._status import SweepStatus

MOST_AXES = 8
MOST_VALUES = 1_000_000
"""Greatest number of values of an axis."""
MOST_SCENES = 10_000_000_000

TASK_SECONDS = 4.0
"""Time [s] that a task should take: long compared with sending and writing it, but short enough
that little is lost if a worker is killed."""
TASKS_AT_LEAST = 16
"""Least number of tasks, so that all workers are busy even with few scenes."""
TRIED = 64
"""Number of scenes that are tried before a sweep begins."""
LONGEST_ROW = 128
"""Greatest number of extents that are solved together."""

WORDS = ("race", "edge", "contact_law", "balls")
"""Fields with words as values that a sweep can vary."""

UNITS = {field.full_name: field.unit for field in SCENE_FIELDS} | dict.fromkeys(WORDS, "")
"""Fields that a sweep can vary, each with its unit; words have none."""

_OF_DEFECTS = {field.name for field in dataclasses.fields(Defect)} | {
    field.name for field in SCENE_FIELDS if field.part == "floor"
}

Slices = tuple[slice, ...]


class StillDirectionError(FieldError):
    """Error for an output along a direction in which no scene of the grid moves."""


@dataclass(frozen=True, eq=False)
class Axis:
    """A field of the scenes with its values, in SI units."""

    name: str
    values: NDArray[Any]

    @property
    def unit(self) -> str:
        """SI unit of the values; empty for words."""
        return UNITS[self.name]


@dataclass(frozen=True, eq=False)
class Grid:
    """All combinations of some values of some fields of a scene, and the requested outputs."""

    scene: Scene
    axes: tuple[Axis, ...]
    outputs: tuple[str, ...]
    settings: Settings
    dofs: tuple[str, ...]
    """directions in which some scene of the grid moves"""

    @classmethod
    def of(
        cls,
        scene: Scene,
        over: Mapping[str, Any],
        outputs: Iterable[str],
        settings: Settings | None = None,
    ) -> Grid:
        """Make a grid from a request, and check it.

        Raises
        ------
        ValueError
            naming the field or output, its value and what is allowed.
        """
        checks.instance("scene", scene, Scene)
        if not isinstance(over, Mapping) or not 1 <= len(over) <= MOST_AXES:
            raise checks.refuse("over", over, f"1 to {MOST_AXES} fields with their values")
        axes = tuple(_axis(name, values) for name, values in over.items())
        grid = cls(
            scene, axes, chosen_outputs(outputs), settings or Settings(), _all_dofs(scene, axes)
        )
        if grid.size > MOST_SCENES:
            raise checks.refuse("number of scenes", grid.size, f"at most {MOST_SCENES:,}")
        grid._check()
        return grid

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def size(self) -> int:
        """Number of scenes."""
        return math.prod(self.shape)

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes."""
        return tuple(axis.name for axis in self.axes)

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of the modes of the band edges."""
        return mode_labels(self.dofs)

    @cached_property
    def needs(self) -> tuple[str, ...]:
        """Computations that the outputs need."""
        return tuple(dict.fromkeys(OUTPUTS[name].needs for name in self.outputs))

    @property
    def in_rows(self) -> bool:
        """True if scenes that differ only in extent are solved together.

        This requires that no defect turns and no ball has a mass.
        """
        several = self.scene.defect if isinstance(self.scene.defect, tuple) else [self.scene.defect]
        standing = all(defect.race == "outer" for defect in several)
        light = self.scene.balls == MASSLESS and "balls" not in self.dims
        return set(self.needs) <= IN_ROWS and "extent" in self.dims and standing and light

    def dims_of(self, output: str) -> tuple[str, ...]:
        """Return the dimensions of an output."""
        if OUTPUTS[output].per_sample:
            seeds = (SEED,) if self.settings.has_several_seeds else ()
            return (*self.dims, *seeds, SAMPLE)
        return (*self.dims, MODE) if OUTPUTS[output].per_mode else self.dims

    def shape_of(self, output: str, shape: Sequence[int] | None = None) -> tuple[int, ...]:
        """Return the shape of an output over the grid, or over a region of this shape."""
        part = tuple(self.shape if shape is None else shape)
        if OUTPUTS[output].per_sample:
            seeds = (len(self.settings.seeds),) if self.settings.has_several_seeds else ()
            return (*part, *seeds, len(self.settings.record_time))
        return (*part, len(self.labels)) if OUTPUTS[output].per_mode else part

    def scene_at(self, index: Sequence[int]) -> Scene:
        """Return the scene at an index; ValueError if it is impossible."""
        pairs = zip(self.axes, index, strict=True)
        return self.scene.replace(**{axis.name: axis.values[i].item() for axis, i in pairs})

    def region_shape(self, scenes: int | None = None) -> tuple[int, ...]:
        """Return the shape of the regions, each of which is a task of about `scenes` scenes.

        None takes about TASK_SECONDS of work for each, and at least TASKS_AT_LEAST regions.
        """
        if scenes is None:
            table = SECONDS_IN_A_ROW if self.in_rows else SECONDS
            seconds = sum(table[need] for need in self.needs)
            if RECORD in self.needs:
                seconds += table[RECORD] * (len(self.settings.seeds) - 1)
            if len(self.dofs) > 2 and set(self.needs) & MOVING:
                seconds *= 10.0
            scenes = min(round(TASK_SECONDS / seconds), self.size // TASKS_AT_LEAST)
        remaining = max(scenes, 1)
        shape = [1] * len(self.shape)
        order = list(reversed(range(len(self.shape))))
        if self.in_rows:
            # extents come first, as a region must contain whole rows of them
            row = self.dims.index("extent")
            shape[row] = _even(self.shape[row], min(remaining, LONGEST_ROW))
            remaining //= shape[row]
            order.remove(row)
        for axis in order:
            shape[axis] = _even(self.shape[axis], max(remaining, 1))
            remaining //= shape[axis]
        return tuple(shape)

    def region_counts(self, shape: Sequence[int]) -> tuple[int, ...]:
        """Return the number of regions of this shape along each axis; the last may be smaller."""
        return tuple(-(-n // part) for n, part in zip(self.shape, shape, strict=True))

    def region(self, shape: Sequence[int], index: Sequence[int]) -> Slices:
        """Return the slices of one region."""
        return tuple(
            slice(i * part, min((i + 1) * part, n))
            for i, part, n in zip(index, shape, self.shape, strict=True)
        )

    def part(self, region: Slices) -> Grid:
        """Return the grid of one region, with all that its computation needs."""
        axes = tuple(
            Axis(axis.name, axis.values[piece])
            for axis, piece in zip(self.axes, region, strict=True)
        )
        return dataclasses.replace(self, axes=axes)

    def compute(self, progress: Progress | None = None) -> tuple[NDArray[np.int8], Numbers]:
        """Compute codes of STATUSES and the outputs of all scenes, in this thread.

        `progress` is called after each row or scene, and during long ones; it ends them by raising.
        """
        status = np.zeros(self.shape, dtype=np.int8)
        numbers = {name: np.full(self.shape_of(name), math.nan) for name in self.outputs}
        scenes = ((index, *self._scene(index, progress)) for index in np.ndindex(*self.shape))
        for index, codes, answers in self._rows(progress) if self.in_rows else scenes:
            if progress is not None:
                progress(0.0, "scenes")
            status[index] = codes
            for name in self.outputs:
                if name in answers:
                    numbers[name][index] = answers[name]
        for values in numbers.values():
            values[np.isnan(values)] = math.nan  # one kind of NaN: equal results, equal bytes
        return status, numbers

    def _scene(self, index: Sequence[int], progress: Progress | None) -> tuple[Any, Numbers]:
        try:
            scene = self.scene_at(index)
        except ValueError:
            return SweepStatus.SCENE_REFUSED.code, {}
        return of_scene(scene, self.needs, self.labels, self.settings, self.outputs, progress)

    def _rows(self, progress: Progress | None) -> Iterator[tuple[Any, Any, Numbers]]:
        row = self.dims.index("extent")
        extents = self.axes[row].values
        # a scene without its defect may have another period, so it does not belong to the row
        together = np.flatnonzero(extents > 0.0)
        others = [1 if axis == row else n for axis, n in enumerate(self.shape)]
        for index in np.ndindex(*others):

            def place(i: Any, index: tuple[int, ...] = index) -> tuple[Any, ...]:
                return (*index[:row], i, *index[row + 1 :])

            alone = set(range(len(extents)))
            if together.size:
                try:
                    scene = self.scene_at(place(together[0]))
                    yield (
                        place(together),
                        *of_row(scene, extents[together], self.needs, self.labels, self.settings),
                    )
                    alone -= set(together.tolist())
                except ValueError:
                    pass  # a scene that is impossible with one extent may exist with another
            for i in alone:
                yield place(i), *self._scene(place(i), progress)

    def _check(self) -> None:
        """Refuse obvious mistakes before hours are spent on them."""
        for name in self.outputs:
            dof = OUTPUTS[name].dof
            if dof and dof not in self.dofs:
                moving = f"directions in which the scenes move: {', '.join(self.dofs)}"
                raise StillDirectionError("name in outputs", name, moving)
        of_defect = [name for name in self.dims if name in _OF_DEFECTS]
        if of_defect:
            largest = {
                axis.name: float(axis.values.max())
                for axis in self.axes
                if axis.name in ("extent", "depth")
            }
            try:
                damaged = bool(self.scene.replace(**largest).defects)
            except ValueError:
                damaged = True  # the scene is impossible, and refused below
            if not damaged:
                raise checks.refuse(
                    "over",
                    of_defect[0],
                    "fields of the scenes, which have no defect here: its extent or depth is zero",
                )
        # if many scenes, spread over the grid, are all impossible, the request is the mistake
        spread = np.random.default_rng(0).integers(self.size, size=TRIED)
        refusal: ValueError | None = None
        for place in {0, self.size - 1, *spread.tolist()}:
            try:
                self._try([int(i) for i in np.unravel_index(place, self.shape)])
            except ValueError as error:
                refusal = refusal or error
            else:
                return
        if refusal is not None:
            raise refusal

    def _try(self, index: Sequence[int]) -> None:
        """Raise ValueError if the scene at an index is impossible or lacks a needed number."""
        scene = self.scene_at(index)
        if set(self.needs) & {MODES, *MOVING}:
            dofs = scene.active_dofs
            scene.support.stiffness(dofs)
            if self.needs != (MODES,):
                scene.support.damping(dofs)
            for body in ("inner", "outer"):
                scene.support.inertia(body, dofs)
        if PRESSURE in self.needs:
            scene.bearing.race_contact("inner")
        if LIFE in self.needs:
            race_ratings(scene.bearing, 1.0)
        if set(self.needs) & MOVING and scene.shaft_speed == 0.0:
            raise checks.refuse("shaft_speed", 0.0, "above 0 for a motion or an orbit", "rad/s")

    @cached_property
    def request(self) -> str:
        """Request as JSON: axes by name, outputs, settings."""
        return json.dumps(
            {
                "over": self.dims,
                "outputs": self.outputs,
                "settings": dataclasses.asdict(self.settings),
            }
        )


@cache
def program_version() -> str:
    """Return the version of this program with a digest of the sources of its core.

    Code changes more often than its version, and results of other sources may be different.
    """
    try:
        version = metadata.version("bearing-explorer")
    except metadata.PackageNotFoundError:
        version = "unknown"
    folder = Path(__file__).resolve().parents[2]
    digest = hashlib.blake2b(digest_size=5)
    for file in sorted(folder.rglob("*")):
        if file.suffix in (".py", ".csv"):
            digest.update(file.relative_to(folder).as_posix().encode() + b"\0" + file.read_bytes())
    return f"{version}+{digest.hexdigest()}"


def _axis(name: object, request: Any) -> Axis:
    """Return a field with its values, of the right kind and all different."""
    if name not in UNITS:
        raise checks.refuse("field in over", name, ", ".join(UNITS))
    assert isinstance(name, str)
    kind = "words" if name in WORDS else "numbers"
    allowed = f"1 to {MOST_VALUES:,} different {kind}"
    several = isinstance(request, Iterable) and not isinstance(request, str)
    values = list(request) if several else [request]
    if not 1 <= len(values) <= MOST_VALUES:
        raise checks.refuse(f"number of values of {name}", len(values), allowed)
    if name in WORDS:
        if not all(isinstance(value, str) for value in values):
            raise checks.refuse(f"values of {name}", request, allowed)
        array = np.array([str(value) for value in values])
    else:
        if any(isinstance(value, bool | np.bool_ | str | bytes) for value in values):
            raise checks.refuse(f"values of {name}", request, allowed)
        array = np.array([checks.real_number(f"value of {name}", value) for value in values])
        if FIELD_OF[name].whole:
            most = 2**31 - 1 if name == "seed" else 500
            least = 0 if name == "seed" else 1
            array = np.array(
                [checks.whole_number(name, value, at_least=least, at_most=most) for value in values]
            )
    if len(np.unique(array)) != len(array):
        raise checks.refuse(f"values of {name}", request, allowed)
    return Axis(name, array)


def _all_dofs(scene: Scene, axes: Iterable[Axis]) -> tuple[str, ...]:
    """Return the directions in which some scene of a grid moves."""
    # a number of these fields that is not zero can make a scene need more directions
    richest = {
        axis.name: max(axis.values.tolist(), key=abs)
        for axis in axes
        if axis.name in ("contact_angle", "second_contact_angle", "row_distance", "fz", "mx", "my")
    }
    try:
        return scene.replace(**richest).active_dofs
    except ValueError:
        return DOF_NAMES


def _even(n: int, most: int) -> int:
    """Return the least size of parts that cut n into as few parts as size `most` does."""
    parts = -(-n // min(most, n))
    return -(-n // parts)
