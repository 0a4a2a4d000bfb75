"""Maps of one output over the plane of two quantities: outputs, levels of refinement, progress.

A map is refined by halving the distance of its points: each level holds the points of the level
before, which are not computed again. A job that takes too long ends with the level that it has
come to.

What is not known has a reason instead of a number. Holds no Panel and draws nothing.
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
"""Points of each level, where nothing is rounded to whole numbers: 5 × 4, 9 × 7, ... 65 × 49."""

_QUICK = (STATICS, PRESSURE, LIFE, MODES)
"""Computations of which a first level is there while a slider is dragged."""
_CHUNK = 0.1  # [s] between two looks at whether to go on
_SETTINGS = Settings()

NOT_COMPUTED = "not computed"


@dataclass(frozen=True)
class MapOutput:
    """Something that can be mapped.

    `in_sweep` is its name in `bearingcore.model.sweeps.OUTPUTS`, `mode` the mode that it is of.
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
        """Settings that say how finely each point is computed, by their names with units."""
        if self.needs in _QUICK:
            return {"cage_angles_a_period": _SETTINGS.cage_angles}
        return {"motion_s": _SETTINGS.duration, "sample_rate_hz": _SETTINGS.sample_rate}

    @property
    def column(self) -> str:
        """Its name with its unit, for a table."""
        suffix = UNITS[self.unit].suffix
        return "_".join(filter(None, (self.name.replace(":", "_"), suffix)))


def _all_outputs() -> dict[str, MapOutput]:
    made = []
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
            made.append(MapOutput(key, output.group, label, unit, output.needs, name, mode))
    groups = list(dict.fromkeys(output.group for output in made))
    made.sort(key=lambda output: (groups.index(output.group), output.label.casefold()))
    return {output.name: output for output in made}


MAP_OUTPUTS: Mapping[str, MapOutput] = _all_outputs()
"""All that can be mapped, by name, in sorted groups: every output of a sweep."""


@dataclass(frozen=True)
class Question:
    """A map to be computed: `output` over the values of `x` and `y`, all else as in `scene`.

    `x` and `y` hold the values of the finest level. Two questions are equal where the answers are.
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
            # what the map goes over does not count
            object.__setattr__(self, "scene", self.scene.replace(**first))

    @cached_property
    def grid(self) -> Grid:
        """The finest scenes; ValueError where none can be."""
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
        """Stride of the first level: 9 × 7 points where they come at once, or else 5 × 4."""
        return 8 if self.at_once else 16

    def level(self, stride: int) -> tuple[NDArray[np.intp], ...]:
        """Index of the finest points, rows and columns, that belong to a level."""
        sizes = (
            np.arange(0, side.values.size, 1 if side.every(stride) is side else stride)
            for side in (self.y, self.x)
        )
        return np.ix_(*sizes)

    def size_words(self, stride: int) -> str:
        """The points of a level, in words."""
        rows, columns = self.level(stride)
        return f"{columns.size} × {rows.size} points"


@dataclass(frozen=True, eq=False)
class Plane:
    """A map as it was computed on one level.

    Attributes
    ----------
    question
        output, axes and scene.
    stride
        of the level.
    values : (ny, nx)
        in the unit of the output; NaN where there is none.
    reasons : (ny, nx)
        why there is none; empty elsewhere.
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
    """All that is known of a map so far, on the finest grid."""

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
        """Compute what is missing of a level; False where it was cancelled.

        The level `last` is where the work is to end, for the progress.
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
        """Rows and columns of what is missing, in blocks: lines of extents whole, as they are
        solved together, others short enough for a job to be cancelled soon.
        """
        rows, columns = (side.ravel() for side in self.question.level(stride))
        few = max(1, int(_CHUNK / SECONDS[self.question.output.needs]))
        upright = self.question.y.field.name == "extent"
        for fixed in columns if upright else rows:
            line = rows if upright else columns
            reasons = self._reasons[line, fixed] if upright else self._reasons[fixed, line]
            left = line[reasons == NOT_COMPUTED]
            most = left.size if self.question.grid.in_rows else few
            for start in range(0, left.size, max(most, 1)):
                part, fixed_value = left[start : start + most], np.array([fixed])
                yield (part, fixed_value) if upright else (fixed_value, part)

    def _compute_points(self, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> None:
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
        if status is SweepStatus.SCENE_REFUSED:
            (x, x_values), (y, y_values) = self.question.x.in_si, self.question.y.in_si
            try:
                self.question.scene.replace(**{x: x_values[column], y: y_values[row]})
            except ValueError as error:
                return sentence_of(error)
        return status.sentence


@cached
def coarse(question: Question) -> Plane:
    """The first level of a map, for a slider that is dragged. ValueError where none can be."""
    survey = Survey(question)
    survey.compute(question.first_stride)
    return survey.plane(question.first_stride)


def refine(job: Work, question: Question, finest: int, start: Plane | None = None) -> str:
    """One level after another up to the stride `finest`, each shown; returns what to say of it.

    Goes on from `start` where it is given. ValueError, with a sentence, where no scene of the map
    can be.
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
