"""All experiments on a scene and the machine of the measurement, as a value and as a file."""

from __future__ import annotations

import datetime
import json
import math
import os
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import metadata
from pathlib import Path
from typing import cast

import msgspec

from bearingcore.common import ResultTable, shown_as_table, table_of, with_prefix
from bearingcore.common._progress import CancelledError
from bearingcore.model.experiments._integrators import usable_methods
from bearingcore.model.experiments._motions import motion_experiment
from bearingcore.model.experiments._orbits import OrbitAtSpeed, orbits_over_speed
from bearingcore.model.experiments._points import Experiment, Point, Watch
from bearingcore.model.experiments._stability import StabilityChart, stability_chart
from bearingcore.model.experiments._statics import statics_experiment
from bearingcore.model.scene import MASSLESS, Scene

PACKAGES = ("bearing-explorer", "numpy", "scipy", "numba", "scikit-sundae")

STABILITY, ORBITS = "stability", "orbits"
EXPERIMENTS: dict[str, Callable[[Scene, Watch, bool], Experiment]] = {
    "motion": lambda scene, watch, slow: motion_experiment(
        scene, duration=0.1, methods=usable_methods(slow=slow), watch=watch
    ),
    "statics": lambda scene, watch, _: statics_experiment(scene, n_angles=31, watch=watch),
}
"""Experiments by their names on the page and in files: functions of (scene, watch, slow)."""
MEASURED = (*EXPERIMENTS, STABILITY, ORBITS)
"""Names of everything that can be measured."""


@dataclass(frozen=True)
class Machine:
    """Machine on which times were measured.

    Attributes
    ----------
    processor, cores
        name of the processor, and number of cores.
    versions
        versions of Python and the packages, by name.
    date
        day of the measurement in ISO 8601.
    c_loop
        time [s] of a plain C loop in the same minute for 1.4 s of the fan rig's motion in two
        directions, 65536 steps a second; NaN if it did not run.
    """

    processor: str
    cores: int
    versions: Mapping[str, str]
    date: str
    c_loop: float = math.nan

    @property
    def sentence(self) -> str:
        """Sentence for the foot of a chart."""
        versions = ", ".join(f"{name} {version}" for name, version in self.versions.items())
        loop = ""
        if math.isfinite(self.c_loop):
            per = with_prefix(self.c_loop / 14.0, "s")
            loop = f"; a plain C loop took {per} for 0.1 s of the fan rig at 65536 steps/s then"
        return f"{self.processor}, {self.cores} cores, {self.date}; {versions}{loop}."


def this_machine(c_loop: float = math.nan) -> Machine:
    """Return the machine and the versions of this process."""
    versions = {"Python": platform.python_version()}
    for package in PACKAGES:
        try:
            versions[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    today = datetime.datetime.now(datetime.UTC).date().isoformat()
    return Machine(_processor(), os.cpu_count() or 1, versions, today, c_loop)


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


@shown_as_table
@dataclass(frozen=True)
class Measurements:
    """Measurements on one scene.

    Attributes
    ----------
    machine
        the machine on which it was measured.
    experiments
        results by their names in EXPERIMENTS.
    stability
        verdicts over step rates, if measured.
    orbits
        the periodic motion over the shaft speed, if measured.
    refused
        reasons why experiments are impossible with this scene, by name.
    """

    machine: Machine
    experiments: dict[str, Experiment] = field(default_factory=dict)
    stability: StabilityChart | None = None
    orbits: tuple[OrbitAtSpeed, ...] = ()
    refused: dict[str, str] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of points in all."""
        trials = self.stability.trials if self.stability is not None else ()
        points = sum(len(experiment.points) for experiment in self.experiments.values())
        return points + len(trials) + len(self.orbits)

    def table(self) -> ResultTable:
        """A row for each point of the experiments: errors by name; missing ones are NaN.

        Infinite errors, such as that of a zero signal in decibels, are NaN too.
        """

        def known(point: Point, name: str) -> float:
            error = point.errors.get(name, math.nan)
            return error if math.isfinite(error) else math.nan

        points = [(name, p) for name, done in self.experiments.items() for p in done.points]
        units = {e: done.unit(e) for done in self.experiments.values() for e in done.errors}
        return table_of(
            ("experiment", "", [name for name, _ in points]),
            ("reference", "", [p.against for _, p in points]),
            ("method", "", [p.method for _, p in points]),
            ("setting", "", [p.setting for _, p in points]),
            *(
                (f"{name.replace(' ', '_')}_error", unit, [known(p, name) for _, p in points])
                for name, unit in units.items()
            ),
            ("time", "s", [p.seconds for _, p in points]),
            ("evaluations", "", [p.evaluations for _, p in points]),
            ("status", "", [p.status for _, p in points]),
        )


def measurements_from(text: str) -> Measurements:
    """Return the measurements in the text of a file; ValueError if it holds anything else."""
    # JSON as Python writes it: with NaN, which msgspec itself refuses
    return cast(Measurements, msgspec.convert(json.loads(text), Measurements))


def measure(
    scene: Scene,
    names: Sequence[str] = MEASURED,
    *,
    c_loop: float = math.nan,
    slow: bool = True,
    progress: Callable[[float, str], object] = lambda part, words: None,
    cancelled: Callable[[], bool] = lambda: False,
    shown: Callable[[Measurements], object] = lambda results: None,
    words: Callable[[ValueError], str] = str,
) -> Measurements:
    """Measure a scene by experiments, one after the other.

    Balls are taken without mass.

    Parameters
    ----------
    scene
        the scene to measure.
    names
        names of experiments, out of MEASURED.
    c_loop
        time of the plain C loop, for `Machine`.
    slow
        True includes integrators that take longer than all others together.
    progress
        called with the part done, 0 to 1, and the name of the current step.
    cancelled
        called before each point, and within references; if it returns True, the results so far are
        returned.
    shown
        called with the results so far, after each point.
    words
        function that words a refusal, for `Measurements.refused`.
    """
    scene = scene.replace(balls=MASSLESS)
    results = Measurements(this_machine(c_loop))
    for k, name in enumerate(names):
        if cancelled():
            break

        def report(part: float, words: str, begin: int = k) -> None:
            if cancelled():
                raise CancelledError
            progress((begin + part) / len(names), words)

        def show(experiment: Experiment, name: str = name, before: Measurements = results) -> None:
            shown(replace(before, experiments={**before.experiments, name: experiment}))

        watch = Watch(report, show)
        try:
            if name == STABILITY:
                chart = stability_chart(scene, duration=0.1, watch=watch)
                results = replace(results, stability=chart)
            elif name == ORBITS:
                results = replace(results, orbits=orbits_over_speed(scene, watch))
            else:
                measured = EXPERIMENTS[name](scene, watch, slow)
                results = replace(results, experiments={**results.experiments, name: measured})
        except CancelledError:
            break
        except ValueError as refused:
            results = replace(results, refused={**results.refused, name: words(refused)})
        shown(results)
    return results
