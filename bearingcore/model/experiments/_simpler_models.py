"""Other models of a scene than the one it has: what each would change, and what it would cost."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from bearingcore.common import Array, ResultTable, shown_as_table, table_of, with_prefix
from bearingcore.model.dynamics import (
    Motion,
    compare_motions,
    highest_natural_frequency,
    orbit,
    simulate,
)
from bearingcore.model.scene import CONTACT_LAWS, DOF_NAMES, EDGES, MASSLESS, WITH_MASS, Scene
from bearingcore.model.statics import Equilibrium, default_cage_angles, static_state
from bearingcore.recordings._spectrum_difference import (
    BAND,
    density_difference,
    spectrum_difference,
)

SPECTRUM, CURVES, DISPLACEMENT = "spectrum", "stiffness", "displacement"
"""Quantities of errors: the housing's settled acceleration [dB], stiffness over the cage angle, or
the inner ring's displacement as it moves (both over their swing)."""

DURATION = 0.25
"""Length [s] of the motion that is compared; the second half counts, as on the page."""

MOST_CALLS = 300_000
"""Right-hand sides of one motion, and of the search for an orbit: what would take more is left
out, so that all rows together take about a second."""

REPEATS, LONG = 3, 0.1
"""Motions that are timed, of which the least counts, as a first one may wait for the processor;
one that takes longer [s] is not repeated."""

N_ANGLES = 361
"""Cage angles over a period of the drawn curves."""


_TERMS = np.triu_indices(5)

LEAST_SWING = 0.01
"""Errors are taken over a curve's swing, but not over less than this part of its size."""


@dataclass(frozen=True)
class Alternative:
    """A model other than that of the scene.

    Attributes
    ----------
    name
        difference from the scene, such as "directions x y".
    quantity
        SPECTRUM, CURVES or DISPLACEMENT: what the error is of.
    error
        difference from the scene's own model: the greatest of spectra [dB] and of displacements,
        and that below which stiffness is at 99 % of the cage angles (over the swing); NaN where it
        was not computed.
    seconds, own_seconds
        [s] of computing it, and the same of the scene's own model.
    note
        further remark, or the reason why there is no error.
    """

    name: str
    quantity: str
    error: float
    seconds: float
    own_seconds: float
    note: str = ""

    @property
    def saved(self) -> float:
        """Time [s] that it saves; negative where it costs more."""
        return self.own_seconds - self.seconds


@shown_as_table
@dataclass(frozen=True)
class Alternatives:
    """Effect of other models, a row each.

    Attributes
    ----------
    scene
        whose model is compared.
    rows
        the other models.
    right_hand_side_calls
        evaluations of all contacts in all motions, which say what it cost on any machine.
    """

    scene: Scene
    rows: tuple[Alternative, ...]
    right_hand_side_calls: int

    def table(self) -> ResultTable:
        """A row for each model: error in the spectrum or the curves, and the time of both."""
        spectral = [row.quantity == SPECTRUM for row in self.rows]
        errors = [row.error for row in self.rows]
        decibels = [error if of else math.nan for error, of in zip(errors, spectral, strict=True)]
        shares = [math.nan if of else error for error, of in zip(errors, spectral, strict=True)]
        return table_of(
            ("model", "", "name"),
            ("error_of", "", "quantity"),
            ("spectrum_error", "dB", decibels, "greatest, where the spectrum counts"),
            ("swing_error", "1", shares, "over the swing"),
            ("time", "s", "seconds", "of computing it"),
            ("own_time", "s", "own_seconds", "of the scene's own model"),
            ("note", "", "note"),
            of=self.rows,
        )


def alternatives(scene: Scene, cancelled: Callable[[], bool] | None = None) -> Alternatives:
    """Measure what other models of a scene would change, and what they cost.

    Fewer directions, other edges, massless balls or balls with mass, no inertia (quasi-static), the
    periodic orbit instead of a march, other steps, and more or fewer cage angles. Nothing is
    predicted: each is computed and compared with what the page draws. Motions last DURATION.

    Parameters
    ----------
    scene
        the scene; the other models are compared with its own.
    cancelled
        called before each row; if it returns True, the rows so far are returned.
    """
    measure = _Measure(scene)
    rows: list[Alternative] = []
    for row in measure.rows():
        rows.append(row)
        if cancelled is not None and cancelled():
            break
    return Alternatives(scene, tuple(rows), measure.calls)


class _Measure:
    """The scene's own curves and motion, and each alternative held against them."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.calls = 0
        self.state, self.static_seconds = self._static(scene, N_ANGLES)
        self.own: Motion  # the scene's, once it was marched
        self.own_seconds = self.band = math.nan

    def rows(self) -> Iterator[Alternative]:
        """One after the other."""
        for dofs in fewer_directions(self.scene):
            state, seconds = self._static(self.scene.replace(dofs=dofs), N_ANGLES)
            yield self._curves(f"directions {' '.join(dofs)}", state, self.state, seconds)
        yield from (self._cage_angles(n) for n in (121, 1441))
        try:
            self.own, self.own_seconds = self._march(self.scene)
        except ValueError as error:
            yield Alternative("motion", SPECTRUM, math.nan, math.nan, math.nan, f"none: {error}")
            return
        self.band = BAND * highest_natural_frequency(self.scene)
        for dofs in fewer_directions(self.scene):
            yield self._other_march(f"directions {' '.join(dofs)}", self.scene.replace(dofs=dofs))
        yield from self._edges()
        for factor, words in ((0.5, "half as many steps"), (2.0, "twice as many steps")):
            yield self._other_march(words, self.scene, factor * self.own.step_rate)
        yield self._balls()
        if self.scene.balls == MASSLESS and self.scene.contact_law == CONTACT_LAWS[0]:
            yield self._orbit()
        yield self._quasi_static()

    # Curves

    def _static(self, scene: Scene, n: int) -> tuple[Equilibrium, float]:
        began = time.thread_time()
        state = static_state(scene, default_cage_angles(scene, n))
        return state, time.thread_time() - began

    def _curves(
        self, name: str, state: Equilibrium, expected: Equilibrium, seconds: float, note: str = ""
    ) -> Alternative:
        """Error over the swing that 99 % of the cage angles keep below."""
        error = curve_errors(
            state.cage_angles,
            stiffness_curves(state),
            expected.cage_angles,
            stiffness_curves(expected),
        )
        greatest = float(np.quantile(error, 0.99)) if error.size else math.nan
        return Alternative(name, CURVES, greatest, seconds, self.static_seconds, note)

    def _cage_angles(self, n: int) -> Alternative:
        other, seconds = self._static(self.scene, n)
        coarse, fine = sorted((self.state, other), key=lambda state: state.cage_angles.size)
        note = f"drawn: {self.state.cage_angles.size}"
        return self._curves(f"{other.cage_angles.size} cage angles", coarse, fine, seconds, note)

    # Motions

    def _march(self, scene: Scene, step_rate: float | None = None) -> tuple[Motion, float]:
        seconds = math.inf
        for _ in range(REPEATS):
            began = time.thread_time()
            motion = simulate(scene, DURATION, step_rate=step_rate, most_steps=MOST_CALLS // 4)
            if not motion.completed:
                raise ValueError(motion.status)
            _ = motion.outer_acceleration
            seconds = min(seconds, time.thread_time() - began)
            if seconds > LONG:
                break
        self.calls += motion.right_hand_side_calls
        return motion, seconds

    def _spectrum(self, name: str, error: float, seconds: float, note: str = "") -> Alternative:
        return Alternative(name, SPECTRUM, error, seconds, self.own_seconds, note)

    def _refused(self, name: str, why: object) -> Alternative:
        return self._spectrum(name, math.nan, math.nan, f"not computed: {why}")

    def _difference(self, other: Motion) -> float:
        """Difference [dB] of settled spectra, in the directions that both have."""
        late = [
            motion.outer_acceleration[
                len(motion.time) // 2 :,
                [motion.dofs.index(dof) for dof in self.own.dofs if dof in other.dofs],
            ]
            for motion in (other, self.own)
        ]
        return spectrum_difference(late[0], late[1], self.own.sample_rate, self.band)

    def _other_march(self, name: str, scene: Scene, step_rate: float | None = None) -> Alternative:
        try:
            motion, seconds = self._march(scene, step_rate)
        except ValueError as refused:
            return self._refused(name, refused)
        drawn = with_prefix(self.own.step_rate, "Hz")
        note = f"{with_prefix(motion.step_rate, 'Hz')}, drawn: {drawn}"
        return self._spectrum(name, self._difference(motion), seconds, note)

    def _edges(self) -> Iterator[Alternative]:
        """The other models of the edges of all defects."""
        defects = self.scene.defects
        for edge in EDGES if defects else ():
            if any(defect.edge != edge for defect in defects):
                scene = self.scene.replace(defect=tuple(replace(d, edge=edge) for d in defects))
                yield self._other_march(f"{edge} edges", scene)

    def _balls(self) -> Alternative:
        heavy = self.scene.balls == WITH_MASS
        name = "massless balls" if heavy else "balls with mass"
        try:
            run, seconds = self._march(self.scene.replace(balls=MASSLESS if heavy else WITH_MASS))
        except ValueError as refused:
            return self._refused(name, refused)
        comparison = compare_motions(*((run, self.own) if heavy else (self.own, run)))
        added = np.abs(comparison.added[comparison.edges[1:] <= self.band])
        error = float(added.max()) if added.size else math.nan
        return self._spectrum(name, error, seconds, comparison.sentence)

    def _orbit(self) -> Alternative:
        name, motion = "periodic orbit", self.own
        began = time.thread_time()
        answer = orbit(self.scene, step_rate=motion.step_rate, most_steps=MOST_CALLS // 4)
        seconds = time.thread_time() - began
        self.calls += answer.right_hand_side_calls
        if not answer.stable:
            why = "unstable" if answer.multipliers.size else answer.status
            return replace(self._refused(name, why), seconds=seconds)
        half = len(motion.time) // 2
        since, rate = float(motion.time[half]), motion.sample_rate
        settled = motion.spectrum(since=since)
        lines = answer.spectrum(rate, duration=(len(motion.time) - half) / rate, since=since)
        return self._spectrum(name, density_difference(lines, settled, self.band), seconds)

    def _quasi_static(self) -> Alternative:
        """The inner ring at rest at every instant, against the ring that moves."""
        motion = self.own
        half = len(motion.time) // 2
        angles = self.scene.cage_speed * motion.time[half:]
        began = time.thread_time()
        state = self.state
        last = float(state.cage_angles[-1])
        along = [DOF_NAMES.index(dof) for dof in motion.dofs]
        rest = np.stack(
            [np.interp(angles % last, state.cage_angles, state.displacement[:, i]) for i in along],
            axis=1,
        )
        seconds = self.static_seconds + time.thread_time() - began
        moving = motion.inner_displacement[half:] - motion.outer_displacement[half:]
        swing = swings(moving)
        apart = np.abs((rest - rest.mean(axis=0)) - (moving - moving.mean(axis=0))) / swing
        error = float(apart.max()) if np.isfinite(apart).all() else math.nan
        note = "no vibration at all: the rings are at rest at every cage angle"
        return Alternative("quasi-static", DISPLACEMENT, error, seconds, self.own_seconds, note)


def fewer_directions(scene: Scene) -> list[tuple[str, ...]]:
    """Smaller sets of directions than a scene's that keep x and y."""
    dofs = scene.active_dofs
    if scene.bearing.kind.left_out:
        return []  # it carries nothing along the others
    return [DOF_NAMES[:n] for n in (2, 3) if n < len(dofs) and set(DOF_NAMES[:n]) <= set(dofs)]


def stiffness_curves(state: Equilibrium) -> Array:
    """(n, 15) the terms of the stiffness, in their units; NaN where there is no answer."""
    return state.stiffness[:, *_TERMS]


def swings(values: Array) -> Array:
    """(m,) what errors of curves (n, m) are taken over: swings, or LEAST_SWING of the size.

    A term that symmetry makes zero is measured by the size of its neighbours: 1 where nothing is.
    """
    known = values[np.isfinite(values).all(axis=1)]
    if not known.size:
        return np.ones(values.shape[1])
    size = np.abs(known).max(axis=0)
    swing = np.maximum(np.ptp(known, axis=0), LEAST_SWING * size)
    if values.shape[1] == 15:  # stiffness: a term counts over the diagonal ones of its directions
        rows, columns = _TERMS
        diagonal = size[rows == columns]
        swing = np.maximum(swing, 1e-6 * np.sqrt(diagonal[rows] * diagonal[columns]))
    return np.where(swing > 0.0, swing, 1.0)


def curve_errors(angles: Array, values: Array, dense: Array, expected: Array) -> Array:
    """Error of straight lines between cage angles: the greatest of all curves, over its swing.

    Parameters
    ----------
    angles : (n,) [rad], values : (n, m)
        cage angles, rising, and the curves there.
    dense : (k,) [rad], expected : (k, m)
        the same at far more angles.

    Returns
    -------
    (≤ k,)
        at those of the far more angles where all curves have an answer.
    """
    lines = np.stack(
        [np.interp(dense, angles, values[:, i]) for i in range(values.shape[1])], axis=1
    )
    error = np.abs(lines - expected) / swings(expected)
    return np.asarray(error[np.isfinite(error).all(axis=1)].max(axis=1, initial=0.0))
