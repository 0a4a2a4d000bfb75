"""Work and precision of models: directions, edges, dynamics, steady state.

Here the error is that of what a model leaves out, not of how it is solved: every model is solved
with the program's own defaults, and held against a fuller model solved by two families of methods.
"""

from __future__ import annotations

import math
import time
from dataclasses import replace
from itertools import pairwise

import numpy as np

from bearingcore.common.numbers import level_difference
from bearingcore.dynamics.low_pass import REACH, low_passed
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import simulate
from bearingcore.dynamics.orbit import LOSSES, orbit
from bearingcore.dynamics.problem import Array, motion_problem
from bearingcore.experiments.points import (
    NOT_WATCHED,
    Experiment,
    Point,
    Watch,
    failed,
    least_time,
    measured_in_turn,
)
from bearingcore.experiments.references import MotionReference, motion_reference
from bearingcore.scene.defect import EDGES
from bearingcore.scene.scene import DOF_NAMES, Scene
from bearingcore.signals.spectrum import Spectrum, spectrum
from bearingcore.signals.spectrum_difference import BAND, density_difference, spectrum_difference
from bearingcore.statics.equilibrium import equilibrium

MODEL_ERRORS = {
    "spectrum": "greatest error of the housing's spectrum along x and y [dB], up to 1.25 times the "
    "highest natural frequency, where a direction is within 40 dB of its greatest level",
    "level": "error of the housing's root mean square acceleration along x and y [dB]",
    "displacement": "greatest error of the inner ring's displacement along x and y over its swing",
}
"""Errors of models by name."""

FULL, EXACT, SETTLED = "all five directions", "exact edges", "settled motion"
SETTLING = 0.25
"""Part of a marched motion that counts as transient where an orbit is compared with it."""

_REFERENCES = (0.0, 0.25, 0.5, 0.75)
"""Parts of the work at which the references begin and end."""

DIRECTIONS = {f"{count} DOF": DOF_NAMES[:count] for count in (2, 3, 5)}
EDGED = {f"{edge} edges": edge for edge in EDGES}
"""Models that differ in their directions, and in the edges of their defects."""

AGAINST = {
    **dict.fromkeys((*DIRECTIONS, "quasi-static"), FULL),
    **dict.fromkeys(EDGED, EXACT),
    **dict.fromkeys(("transient", "orbit"), SETTLED),
}
"""Reference of each model."""
MODELS = tuple(AGAINST)


def models_experiment(
    scene: Scene,
    *,
    duration: float = 0.7,
    sample_rate: float = 65536.0,
    watch: Watch = NOT_WATCHED,
) -> Experiment:
    """Errors of simpler models against their cost, on `scene`.

    Directions and quasi-statics are held against the scene in all five directions, edge models
    against exact edges, the orbit and the marched transient against the settled part of the motion
    by two families.

    Parameters
    ----------
    scene
        at hand; its support must be known along all five directions for the models with more of
        them than it has, which are failures otherwise.
    duration
        [s] of motion.
    sample_rate
        [Hz].
    watch
        progress, points as they come, and cancelling.

    Raises
    ------
    ValueError
        for a shaft that stands still or a scene without a static state.
    """
    runner = _Models(scene, duration, sample_rate, watch)
    experiment = Experiment(
        "models",
        f"Models of the motion over {duration:g} s, each solved with the program's defaults",
        MODEL_ERRORS,
        "right-hand sides",
        runner.references,
        (),
        "healthy bearing as a model of a damaged one; models without contact",
    )
    return measured_in_turn(experiment, MODELS, str, runner.point, watch, begin=_REFERENCES[-1])


class _Models:
    """The scene's fuller models by two families, and each model held against one of them."""

    def __init__(self, scene: Scene, duration: float, sample_rate: float, watch: Watch) -> None:
        parts = iter(pairwise(_REFERENCES))
        self._reports = (watch.within(begin, end) for begin, end in parts)
        self.scene, self.duration, self.sample_rate = scene, duration, sample_rate
        self.band = BAND * highest_natural_frequency(scene)
        own = self._reference(scene)
        try:
            every = scene.bearing.kind.directions
            full = own if scene.active_dofs == every else self._reference(_with(scene, every))
        except ValueError as refused:
            full = own
            self._no_full = str(refused)
        else:
            self._no_full = ""
        edges_in_use = {f"{defect.edge} edges" for defect in scene.defects}
        self._in_use = {f"{len(scene.active_dofs)} DOF", "transient", *edges_in_use}
        exact = scene.defects and all(d.edge == "exact" for d in scene.defects)
        edges = own if exact else self._reference(_edged(scene, "exact"))
        self._by_name = {FULL: full, EXACT: edges, SETTLED: own}
        self.references = {name: r.reference for name, r in self._by_name.items()}
        if self._no_full:
            note = f"in the scene's own directions only: {self._no_full}"
            self.references[FULL] = replace(self.references[FULL], note=note)

    def _reference(self, scene: Scene) -> MotionReference:
        problem = motion_problem(scene)
        report = next(self._reports)
        return motion_reference(problem, self.duration, self.sample_rate, self.band, report)

    def point(self, model: str) -> Point:
        """One model, or why it cannot be computed."""
        point = self._point(model)
        return replace(point, against=AGAINST[model], in_use=model in self._in_use)

    def _point(self, model: str) -> Point:
        try:
            if model in DIRECTIONS:
                return self._marched(model, _with(self.scene, DIRECTIONS[model]))
            if model in EDGED:
                return self._marched(model, _edged(self.scene, EDGED[model]))
            if model == "quasi-static":
                return self._quasi_static()
            return self._transient() if model == "transient" else self._orbit()
        except ValueError as refused:
            return failed(model, "", math.nan, str(refused))

    def _marched(self, model: str, scene: Scene) -> Point:
        (found, acceleration), seconds, runs = least_time(
            lambda: (
                motion := simulate(scene, self.duration, self.sample_rate),
                motion.outer_acceleration,
            )
        )
        words = f"{found.step_rate:.0f} steps/s"
        if not found.completed:
            return failed(model, words, found.step_rate, found.reason, seconds)
        errors = self._errors(AGAINST[model], acceleration[:, :2], found.inner_displacement[:, :2])
        return Point(
            model, words, found.step_rate, errors, seconds, runs, found.right_hand_side_calls,
            settings={"step_rate": found.step_rate},
        )  # fmt: skip

    def _errors(self, against: str, acceleration: Array, inner: Array) -> dict[str, float]:
        """Of signals (n, 2) along x and y."""
        history = self._by_name[against].history
        truth = self._sensed(history)
        acceleration, truth = acceleration[: len(truth)], truth[: len(acceleration)]
        place = history[: len(inner), 0, :2]
        swing = float(np.abs(place - place.mean(axis=0)).max())
        return {
            "spectrum": spectrum_difference(acceleration, truth, self.sample_rate, self.band),
            "level": _level_error(acceleration, truth),
            "displacement": float(np.abs(inner - place).max()) / swing,
        }

    def _sensed(self, history: Array) -> Array:
        """The housing's acceleration (n, 2) of a reference, filtered as that of a motion is.

        Shorter than the history, as the filter of the last samples would need what follows.
        """
        n = len(history) - REACH - 2
        return low_passed(history, 3, n, self.sample_rate, self.sample_rate)[:, :2]

    def _quasi_static(self) -> Point:
        """The static state at the cage angle of each instant: the housing rests in its springs."""
        scene = self.scene
        n = round(self.duration * self.sample_rate)
        # static curves repeat every ball spacing where the defect stands still
        angles = scene.cage_speed * np.arange(n) / self.sample_rate
        state, seconds, runs = least_time(lambda: equilibrium(scene, angles))
        if not np.all(state.converged):
            return failed("quasi-static", "", math.nan, "cage angles without one static state")
        support = scene.support
        rest = np.array([scene.load.fx / support.stiffness_x, scene.load.fy / support.stiffness_y])
        inner = state.displacement[:, :2] + rest
        errors = self._errors(FULL, np.zeros_like(inner), inner)
        return Point(
            "quasi-static", f"{n} cage angles", float(n), errors, seconds, runs,
            int(state.evaluations.sum()),
        )  # fmt: skip

    def _settled(self) -> tuple[int, Array]:
        """First sample after the transient, and the housing's acceleration from there on."""
        history = self._by_name[SETTLED].history
        first = round(SETTLING * len(history))
        return first, self._sensed(history)[first:]

    def _transient(self) -> Point:
        """Marching and dropping the first part."""
        first, truth = self._settled()
        start = time.perf_counter()
        found = simulate(self.scene, self.duration, self.sample_rate)
        signal = found.outer_acceleration[first:, :2]
        first_time = time.perf_counter() - start
        if not found.completed:
            return failed("transient", "", math.nan, found.reason, first_time)
        _, seconds, runs = least_time(
            lambda: simulate(self.scene, self.duration, self.sample_rate).outer_acceleration
        )
        n = min(len(signal), len(truth))
        errors = {
            "spectrum": spectrum_difference(signal[:n], truth[:n], self.sample_rate, self.band),
            "level": _level_error(signal[:n], truth[:n]),
        }
        return Point(
            "transient", f"{found.step_rate:.0f} steps/s", found.step_rate, errors, seconds, runs,
            found.right_hand_side_calls, settings={"step_rate": found.step_rate},
        )  # fmt: skip

    def _orbit(self) -> Point:
        """The periodic motion by shooting, where it is proven stable."""
        first, truth = self._settled()
        found, seconds, runs = least_time(lambda: orbit(self.scene))
        words = f"{found.ball_passes} ball pass" + ("es" if found.ball_passes != 1 else "")
        if not found.stable:
            why = found.status + (f": {LOSSES[found.through]}" if found.through else "")
            return failed("orbit", words, math.nan, why, seconds, found.right_hand_side_calls)
        rate = self.sample_rate
        lines = found.spectrum(rate, duration=len(truth) / rate, since=first / rate)
        mine = Spectrum(lines.frequency, lines.density[:, :2])
        true = spectrum(truth, self.sample_rate).up_to(float(lines.frequency[-1]))
        level = level_difference(mine.density.sum(), true.density.sum())
        errors = {"spectrum": density_difference(mine, true, self.band), "level": abs(float(level))}
        return Point(
            "orbit", words, float(found.ball_passes), errors, seconds, runs,
            found.right_hand_side_calls,
        )  # fmt: skip


def _with(scene: Scene, dofs: tuple[str, ...]) -> Scene:
    return scene.replace(dofs=dofs)


def _edged(scene: Scene, edge: str) -> Scene:
    return scene.replace(defect=tuple(replace(defect, edge=edge) for defect in scene.defects))


def _level_error(found: Array, truth: Array) -> float:
    power, right = float(np.mean(found**2)), float(np.mean(truth**2))
    return abs(10.0 * math.log10(power / right)) if power > 0.0 else math.inf
