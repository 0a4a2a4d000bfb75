"""Results of a work-precision experiment: points of error and cost, including failures."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from bearingcore.common import Progress, scientific
from bearingcore.common._progress import CancelledError

T = TypeVar("T")

ShowExperiment = Callable[["Experiment"], object]
"""Function that is called with the unfinished experiment after each point."""

RIGHT = "right"


@dataclass(frozen=True)
class Point:
    """One method at one setting.

    Attributes
    ----------
    method, setting
        name of the method, and its setting in words.
    value
        the setting as a number: step rate [Hz], tolerance, number of cage angles.
    errors
        differences from the reference, by the names in `Experiment.errors`.
    seconds
        time [s], the least of several runs after a warm-up; for statics the time of one
        equilibrium.
    evaluations
        number of right-hand sides, or of evaluations of all contacts at one displacement: a cost
        that does not depend on the machine. For statics it is a mean over the equilibria.
    status
        "right", or "failed: " and the reason.
    against
        name of the reference of the errors, if an experiment has several.
    in_use
        True for the method and setting that the program uses for the scene by default.
    """

    method: str
    setting: str
    value: float
    errors: Mapping[str, float]
    seconds: float
    evaluations: float
    status: str = RIGHT
    against: str = ""
    in_use: bool = False

    @property
    def failed(self) -> bool:
        """True if the method gave no right answer."""
        return self.status != RIGHT

    @property
    def label(self) -> str:
        """Short form of the setting: "10⁻⁶" for a tolerance, "65.5k" for 65,536 steps."""
        if self.value < 1.0:
            return scientific(self.value).removeprefix("1·")
        if self.value < 1e4:
            return f"{self.value:.0f}"
        return f"{self.value / 1e3:.3g}k" if self.value < 1e6 else f"{self.value / 1e6:.3g}M"


@dataclass(frozen=True)
class Reference:
    """Reference of the errors, and the reason to trust it.

    Attributes
    ----------
    families
        the different families of methods that computed it.
    agreement
        difference of the first two, by the names in `Experiment.errors`.
    trusted
        True if they agree well enough to judge the points. Errors below the agreement have no
        meaning.
    note
        further remark.
    """

    families: tuple[str, ...]
    agreement: Mapping[str, float]
    trusted: bool
    note: str = ""


@dataclass(frozen=True)
class Experiment:
    """Points of several methods on one problem.

    Attributes
    ----------
    name
        kind of the comparison: "motion" or "statics".
    errors
        meaning of each error with its unit, by name; the first is the one to draw.
    evaluations
        measure of cost other than time.
    references
        references by name; "" belongs to points without the name of a reference.
    points
        points in the order of measurement.
    left_out
        methods that are left out, with the reasons.
    completed
        False if the experiment was cancelled.
    """

    name: str
    errors: Mapping[str, str]
    evaluations: str
    references: Mapping[str, Reference]
    points: tuple[Point, ...]
    left_out: str = ""
    completed: bool = True

    @property
    def methods(self) -> tuple[str, ...]:
        """Names of the methods, in the order of measurement."""
        return tuple(dict.fromkeys(point.method for point in self.points))

    def of(self, method: str) -> tuple[Point, ...]:
        """Return the points of one method."""
        return tuple(point for point in self.points if point.method == method)

    def per_reference(self) -> dict[str, Experiment]:
        """Return an experiment for each reference, with the points that are compared with it."""
        return {
            name: replace(
                self,
                references={name: reference},
                points=tuple(point for point in self.points if point.against == name),
            )
            for name, reference in self.references.items()
        }

    def order(self, method: str, error: str) -> float:
        """Return the order of convergence: slope of log error over log evaluations, as a positive.

        Failed points, and errors within five times the agreement of the references, do not count.
        The order is NaN with fewer than three other points.
        """
        known = [
            (point.evaluations, point.errors[error])
            for point in self.of(method)
            if not point.failed
            and 5.0 * self.references[point.against].agreement.get(error, 0.0)
            < point.errors.get(error, math.nan)
            < math.inf
        ]
        if len(known) < 3:
            return math.nan
        evaluations, errors = np.log(np.array(known)).T
        return -float(np.polyfit(evaluations, errors, 1)[0])

    def frontier(self, error: str | None = None, cost: str = "seconds") -> tuple[Point, ...]:
        """Return the points that no other point beats in both error and cost, cheapest first."""
        name = error or next(iter(self.errors))
        right = (point for point in self.points if not point.failed)
        known = [point for point in right if math.isfinite(point.errors.get(name, math.nan))]
        best: list[Point] = []
        for point in sorted(known, key=lambda p: (getattr(p, cost), p.errors[name])):
            if not best or point.errors[name] < best[-1].errors[name]:
                best.append(point)
        return tuple(best)

    def unit(self, error: str) -> str:
        """Return the unit of an error: "dB", or "1" for a ratio."""
        return "dB" if "[dB]" in self.errors[error] else "1"


@dataclass(frozen=True)
class Watch:
    """Functions by which an experiment reports, and can be cancelled.

    Attributes
    ----------
    progress
        called with the part done, 0 to 1, and the name of the current step. If it raises
        CancelledError between points, the experiment ends with the points so far. Within
        references, which all points need, the error is passed on.
    shown
        called with the unfinished experiment after each point.
    """

    progress: Progress = lambda part, words: None
    shown: ShowExperiment = lambda experiment: None

    def within(self, begin: float, end: float) -> Callable[[float], object]:
        """Return the progress of references, which are the work from `begin` to `end`, 0 to 1."""
        return lambda part: self.progress(begin + (end - begin) * part, "references")

    def in_turn(
        self, tasks: Sequence[T], name: Callable[[T], str], begin: float = 0.0
    ) -> Iterator[T]:
        """Yield the tasks one after another until the work is cancelled.

        `begin` is the part of the work that was done before.
        """
        with suppress(CancelledError):
            for i, task in enumerate(tasks):
                self.progress(begin + (1.0 - begin) * i / len(tasks), name(task))
                yield task
            self.progress(1.0, "done")


NOT_WATCHED = Watch()
"""A `Watch` that neither reports nor cancels."""


def measure_in_turn(
    experiment: Experiment,
    tasks: Sequence[T],
    name: Callable[[T], str],
    measure: Callable[[T], Point],
    watch: Watch,
    *,
    begin: float,
) -> Experiment:
    """Return the experiment with a point for each task; it ends early if cancelled.

    It is shown after each point. `begin` is the share of the references in the work.
    """
    for task in watch.in_turn(tasks, name, begin):
        experiment = replace(
            experiment, points=(*experiment.points, measure(task)), completed=False
        )
        watch.shown(experiment)
    return replace(experiment, completed=len(experiment.points) == len(tasks))


def least_time(work: Callable[[], T], *, runs: int = 5, budget: float = 0.5) -> tuple[T, float]:
    """Return the result of `work`, and the least time [s] of several runs after a warm-up.

    Runs end when they have taken `budget` [s]. If the warm-up alone takes longer, it is the only
    run, so work must be compiled before.
    """
    start = time.perf_counter()
    answer = work()
    first = time.perf_counter() - start
    if first > budget:
        return answer, first
    least, spent, done = math.inf, 0.0, 0
    while done < runs and spent < budget:
        start = time.perf_counter()
        answer = work()
        duration = time.perf_counter() - start
        least, spent, done = min(least, duration), spent + duration, done + 1
    return answer, least
