"""Maps of one output over the plane of two quantities: outputs, levels of refinement, progress.

A map is refined by halving the distance of its points. Each level contains the points of the level
before, which are not computed again. A job that takes too long ends with the level that it has
reached.

A point without a number has a reason. This module uses no Panel and draws nothing.
"""

from __future__ import annotations

import contextlib
import dataclasses
import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.explorer.state.value_range import Sweep
from bearing_explorer.kit.compute.cache import cached
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.sentences import sentence_of
from bearingcore import DOF_NAMES, Scene
from bearingcore.common import cached_property, number
from bearingcore.model.sweeps import (
    LIFE,
    MASS,
    MODES,
    OUTPUTS,
    PRESSURE,
    SECONDS,
    STATICS,
    STATUSES,
    Axis,
    Grid,
    Settings,
    StillDirectionError,
    SweepStatus,
    mode_labels,
    mode_symbol,
)
from bearingcore.units import UNITS

Array = NDArray[np.float64]

FINEST = (65, 49)
"""Points to the right and upwards of the finest map."""
STRIDES = (16, 8, 4, 2, 1)
"""Strides of the levels: a level takes every sixteenth, eighth, ... of the finest points."""
SIZES = {stride: tuple((n - 1) // stride + 1 for n in FINEST) for stride in STRIDES}
"""Points of each level, unless values are whole numbers: 5 × 4, 9 × 7, ... 65 × 49."""

_QUICK = (STATICS, PRESSURE, LIFE, MODES)
"""Computations quick enough for a first level while a slider is dragged."""
_CHUNK = 0.1  # [s] between two checks whether the job was cancelled
_SETTINGS = Settings()

NOT_COMPUTED = "not computed"


@dataclass(frozen=True)
class MapOutput:
    """An output that can be mapped.

    `in_sweep` is its name in `bearingcore.model.sweeps.OUTPUTS`, `mode` the label of its mode.
    """

    name: str
    group: str
    label: str
    unit: str
    needs: str
    in_sweep: str
    mode: str = ""

    @property
    def fineness(self) -> dict[str, float]:
        """Settings of the computation of each point, by names with units."""
        if self.needs in _QUICK:
            return {"cage_angles_a_period": _SETTINGS.cage_angles}
        return {"motion_s": _SETTINGS.duration, "sample_rate_hz": _SETTINGS.sample_rate}

    @property
    def column(self) -> str:
        """Its name with its unit, for a table."""
        suffix = UNITS[self.unit].suffix
        return "_".join(filter(None, (self.name.replace(":", "_"), suffix)))


def _all_outputs() -> dict[str, MapOutput]:
    map_outputs = []
    for name, output in OUTPUTS.items():
        if output.per_sample:
            continue
        unit = "" if output.unit == "1" else output.unit
        for mode in mode_labels(DOF_NAMES) if output.per_mode else ("",):
            label = output.label.format(mode_symbol(mode)) if mode else output.label
            key = f"{name}:{mode}" if mode else name
            if output.needs == MASS:
                low, high = 1e-3 * _SETTINGS.band_low, 1e-3 * _SETTINGS.band_high
                label = f"{label}, {number(low, 4)} to {number(high, 4)} kHz"
            map_outputs.append(MapOutput(key, output.group, label, unit, output.needs, name, mode))
    groups = list(dict.fromkeys(output.group for output in map_outputs))
    map_outputs.sort(key=lambda output: (groups.index(output.group), output.label.casefold()))
    return {output.name: output for output in map_outputs}


MAP_OUTPUTS: Mapping[str, MapOutput] = _all_outputs()
"""Every output that can be mapped, by name, sorted in groups: those of a sweep."""


@dataclass(frozen=True)
class Question:
    """A map to be computed: `output` over the values of `x` and `y`, all else as in `scene`.

    `x` and `y` hold the values of the finest level. Questions with the same answer are equal.
    """

    scene: Scene
    x: Sweep = field(compare=False)
    y: Sweep = field(compare=False)
    output: MapOutput
    places: tuple[object, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        ends = tuple(
            (s.field.key, float(s.values[0]), float(s.values[-1]), s.values.size)
            for s in (self.x, self.y)
        )
        object.__setattr__(self, "places", ends)
        first = {name: float(values[0]) for name, values in (self.x.in_si, self.y.in_si)}
        with contextlib.suppress(ValueError):
            # the map replaces these two fields: questions that differ only in them are equal
            object.__setattr__(self, "scene", self.scene.replace(**first))

    @cached_property
    def grid(self) -> Grid:
        """The scenes of the finest level; ValueError, with a sentence, if they are impossible."""
        sides, name = dict([self.x.in_si, self.y.in_si]), self.output.in_sweep
        try:
            return Grid.of(self.scene, sides, [name], _SETTINGS)
        except StillDirectionError as error:
            dof = OUTPUTS[name].dof
            way = "tilt about" if dof.startswith("r") else "move along"
            raise ValueError(f"The housing does not {way} {dof[-1]} in these scenes.") from error

    @property
    def at_once(self) -> bool:
        """True if the first level is quick enough to follow a slider."""
        return self.output.needs in _QUICK

    @property
    def first_stride(self) -> int:
        """Stride of the first level: 9 × 7 points if it is quick enough for a drag, else 5 × 4."""
        return 8 if self.at_once else 16

    def level(self, stride: int) -> tuple[NDArray[np.intp], ...]:
        """Index of the finest points, rows and columns, that belong to a level."""
        indices = (
            np.arange(0, side.values.size, 1 if side.every(stride) is side else stride)
            for side in (self.y, self.x)
        )
        return np.ix_(*indices)

    def size_words(self, stride: int) -> str:
        """The points of a level, in words."""
        rows, columns = self.level(stride)
        return f"{columns.size} × {rows.size} points"


@dataclass(frozen=True, eq=False)
class Plane:
    """A map on one level.

    Attributes
    ----------
    question
        output, axes and scene.
    stride
        of the level.
    values : (ny, nx)
        in the unit of the output; NaN where there is none.
    reasons : (ny, nx)
        why there is no number; else empty.
    """

    question: Question
    stride: int
    values: Array
    reasons: NDArray[np.object_]

    @property
    def x(self) -> Sweep:
        """Values of the quantity to the right, (nx,)."""
        return self.question.x.every(self.stride)

    @property
    def y(self) -> Sweep:
        """Values of the quantity upwards, (ny,)."""
        return self.question.y.every(self.stride)

    @property
    def missing(self) -> int:
        """Points without a number."""
        return int(np.isnan(self.values).sum())


class Survey:
    """The known numbers of a map and the reasons for missing ones, on the finest grid."""

    def __init__(self, question: Question, start: Plane | None = None) -> None:
        self.question = question
        shape = (question.y.values.size, question.x.values.size)
        self._values = np.full(shape, math.nan)
        self._reasons = np.full(shape, NOT_COMPUTED, dtype=object)
        if start is not None:
            level = question.level(start.stride)
            self._values[level], self._reasons[level] = start.values, start.reasons

    def known(self, stride: int) -> NDArray[np.bool_]:
        """Points of a level that are known already, (ny, nx)."""
        known: NDArray[np.bool_] = self._reasons[self.question.level(stride)] != NOT_COMPUTED
        return known

    def compute(self, stride: int, job: Work | None = None, last: int | None = None) -> bool:
        """Compute the missing points of a level; return False if the job was cancelled.

        The job ends with the level `last`, by which its progress is counted.
        """
        last = stride if last is None else last
        for rows, columns in self._chunks(stride):
            if job is not None and job.cancelled():
                return False
            self._compute_points(rows, columns)
            if job is not None:
                job.progress(float(self.known(last).mean()))
        return True

    def plane(self, stride: int) -> Plane:
        """The map on a level."""
        level = self.question.level(stride)
        return Plane(self.question, stride, self._values[level], self._reasons[level])

    def _chunks(self, stride: int) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
        """Rows and columns of the missing points, in blocks that are computed together."""
        rows, columns = (side.ravel() for side in self.question.level(stride))
        few = max(1, int(_CHUNK / SECONDS[self.question.output.needs]))
        # a line along extents is solved as a whole; other blocks are so short that a job can be
        # cancelled soon
        upright = self.question.y.field.name == "extent"
        for fixed in columns if upright else rows:
            line = rows if upright else columns
            reasons = self._reasons[line, fixed] if upright else self._reasons[fixed, line]
            left = line[reasons == NOT_COMPUTED]
            most = left.size if self.question.grid.in_rows else few
            for start in range(0, left.size, max(most, 1)):
                part, fixed_index = left[start : start + most], np.array([fixed])
                yield (part, fixed_index) if upright else (fixed_index, part)

    def _compute_points(self, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> None:
        """Compute a block of points: the numbers, or the reasons for missing ones."""
        output = self.question.output
        grid = self.question.grid
        x, y = grid.axes
        axes = (Axis(x.name, x.values[columns]), Axis(y.name, y.values[rows]))
        status, numbers = dataclasses.replace(grid, axes=axes).compute()
        values = numbers[output.in_sweep]
        if output.mode in grid.labels:
            values = values[..., grid.labels.index(output.mode)]
        elif output.mode:
            values = np.full(status.shape, math.nan)
        for (b, j), (a, i) in itertools.product(enumerate(rows), enumerate(columns)):
            value = float(values[a, b])
            why = "" if math.isfinite(value) else self._why(STATUSES[status[a, b]], j, i)
            self._values[j, i] = value if not why else math.nan
            self._reasons[j, i] = why

    def _why(self, status: SweepStatus, row: int, column: int) -> str:
        """Reason for a missing number; of a refused scene the sentence of its refusal."""
        if status is SweepStatus.SCENE_REFUSED:
            (x, x_values), (y, y_values) = self.question.x.in_si, self.question.y.in_si
            try:
                self.question.scene.replace(**{x: x_values[column], y: y_values[row]})
            except ValueError as error:
                return sentence_of(error)
        return status.sentence


@cached
def coarse(question: Question) -> Plane:
    """The first level of a map, for a drag. ValueError, with a sentence, if it is impossible."""
    survey = Survey(question)
    survey.compute(question.first_stride)
    return survey.plane(question.first_stride)


def refine(job: Work, question: Question, finest: int, start: Plane | None = None) -> str:
    """Compute and show one level after another up to the stride `finest`; return a sentence.

    The work continues from `start` if there is one. ValueError, with a sentence, if the map is
    impossible.
    """
    survey = Survey(question, start)
    first = question.first_stride
    shown = start
    for stride in STRIDES:
        if not finest <= stride <= first or survey.known(stride).all():
            continue
        if not survey.compute(stride, job, finest):
            break
        shown = survey.plane(stride)
        job.show(shown)
    if shown is not None:
        return f"{question.size_words(shown.stride)}."
    return f"{survey.known(first).sum()} of {question.size_words(first)}."
