"""Other models of a scene than its own: their effect on the results, and their cost."""

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
the inner ring's displacement in motion (both over their swing)."""

DURATION = 0.25
"""Length [s] of the compared motion; the second half counts, as on the page."""

MOST_CALLS = 300_000
"""Limit on the right-hand sides of a motion, and of the search for an orbit. Models that need more
are left out, so that all rows together take about a second."""

REPEATS, LONG = 3, 0.1
"""Number of timed motions, of which the shortest time counts, as the first may wait for the
processor; a motion that takes longer than LONG [s] is not repeated."""

N_ANGLES = 361
"""Number of cage angles over a period of the drawn curves."""

_TERMS = np.triu_indices(5)

LEAST_SWING = 0.01
"""Errors are divided by the swing of a curve, or by this part of its size if that is more."""


@dataclass(frozen=True)
class Alternative:
    """A model other than that of the scene.

    Attributes
    ----------
    name
        difference from the scene, such as "directions x y".
    quantity
        quantity of the error: SPECTRUM, CURVES or DISPLACEMENT.
    error
        difference from the scene's own model: the greatest of spectra [dB] and of displacements
        (over the swing); for stiffness (over the swing) the difference that 99 % of the cage angles
        do not exceed; NaN if it was not computed.
    seconds, own_seconds
        time [s] of this model, and of the scene's own model.
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
        """Time [s] that this model saves; negative if it costs more."""
        return self.own_seconds - self.seconds


@shown_as_table
@dataclass(frozen=True)
class Alternatives:
    """Effect of other models, a row each.

    Attributes
    ----------
    scene
        scene whose model is compared.
    rows
        the other models.
    right_hand_side_calls
        evaluations of all contacts in all motions: the cost, independent of the machine.
    """

    scene: Scene
    rows: tuple[Alternative, ...]
    right_hand_side_calls: int

    def table(self) -> ResultTable:
        """A row for each model: error in the spectrum or the curves, and the time of both."""
        spectral = [row.quantity == SPECTRUM for row in self.rows]
        errors = [row.error for row in self.rows]
        pairs = list(zip(errors, spectral, strict=True))
        decibels = [error if is_spectral else math.nan for error, is_spectral in pairs]
        shares = [math.nan if is_spectral else error for error, is_spectral in pairs]
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
    """Measure the effect and the cost of other models of a scene.

    They have fewer directions, other edges, massless balls or balls with mass, no inertia
    (quasi-static), the periodic orbit instead of a march, other steps, or other numbers of cage
    angles. Each is computed and compared with the scene's own model. Motions last DURATION.

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
    """The scene's own curves and motion, and the comparison of alternatives with them."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.calls = 0
        self.state, self.static_seconds = self._static(scene, N_ANGLES)
        self.own: Motion  # motion of the scene's own model, once it was marched
        self.own_seconds = self.band = math.nan

    def rows(self) -> Iterator[Alternative]:
        """Yield the alternatives, each after its computation."""
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

    def _static(self, scene: Scene, n: int) -> tuple[Equilibrium, float]:
        start = time.thread_time()
        state = static_state(scene, default_cage_angles(scene, n))
        return state, time.thread_time() - start

    def _curves(
        self, name: str, state: Equilibrium, expected: Equilibrium, seconds: float, note: str = ""
    ) -> Alternative:
        """Return an alternative with the error that 99 % of the cage angles do not exceed."""
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

    def _march(self, scene: Scene, step_rate: float | None = None) -> tuple[Motion, float]:
        seconds = math.inf
        for _ in range(REPEATS):
            start = time.thread_time()
            motion = simulate(scene, DURATION, step_rate=step_rate, most_steps=MOST_CALLS // 4)
            if not motion.completed:
                raise ValueError(motion.status)
            _ = motion.outer_acceleration
            seconds = min(seconds, time.thread_time() - start)
            if seconds > LONG:
                break
        self.calls += motion.right_hand_side_calls
        return motion, seconds

    def _spectrum(self, name: str, error: float, seconds: float, note: str = "") -> Alternative:
        return Alternative(name, SPECTRUM, error, seconds, self.own_seconds, note)

    def _refused(self, name: str, why: object) -> Alternative:
        return self._spectrum(name, math.nan, math.nan, f"not computed: {why}")

    def _difference(self, other: Motion) -> float:
        """Return the difference [dB] of settled spectra in common directions."""
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
        """Yield the other edge models, each for all defects."""
        defects = self.scene.defects
        for edge in EDGES if defects else ():
            if any(defect.edge != edge for defect in defects):
                scene = self.scene.replace(defect=tuple(replace(d, edge=edge) for d in defects))
                yield self._other_march(f"{edge} edges", scene)

    def _balls(self) -> Alternative:
        heavy = self.scene.balls == WITH_MASS
        name = "massless balls" if heavy else "balls with mass"
        try:
            other, seconds = self._march(self.scene.replace(balls=MASSLESS if heavy else WITH_MASS))
        except ValueError as refused:
            return self._refused(name, refused)
        comparison = compare_motions(*((other, self.own) if heavy else (self.own, other)))
        added = np.abs(comparison.added[comparison.edges[1:] <= self.band])
        error = float(added.max()) if added.size else math.nan
        return self._spectrum(name, error, seconds, comparison.sentence)

    def _orbit(self) -> Alternative:
        name, motion = "periodic orbit", self.own
        start = time.thread_time()
        answer = orbit(self.scene, step_rate=motion.step_rate, most_steps=MOST_CALLS // 4)
        seconds = time.thread_time() - start
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
        """Compare an inner ring in static equilibrium at every instant with the moving ring."""
        motion = self.own
        half = len(motion.time) // 2
        angles = self.scene.cage_speed * motion.time[half:]
        start = time.thread_time()
        state = self.state
        last = float(state.cage_angles[-1])
        along = [DOF_NAMES.index(dof) for dof in motion.dofs]
        rest = np.stack(
            [np.interp(angles % last, state.cage_angles, state.displacement[:, i]) for i in along],
            axis=1,
        )
        seconds = self.static_seconds + time.thread_time() - start
        moving = motion.inner_displacement[half:] - motion.outer_displacement[half:]
        swing = swings(moving)
        apart = np.abs((rest - rest.mean(axis=0)) - (moving - moving.mean(axis=0))) / swing
        error = float(apart.max()) if np.isfinite(apart).all() else math.nan
        note = "no vibration at all: the rings are at rest at every cage angle"
        return Alternative("quasi-static", DISPLACEMENT, error, seconds, self.own_seconds, note)


def fewer_directions(scene: Scene) -> list[tuple[str, ...]]:
    """Return smaller sets of directions than a scene's that include x and y."""
    dofs = scene.active_dofs
    if scene.bearing.kind.left_out:
        return []  # the bearing carries no load along other directions
    return [DOF_NAMES[:n] for n in (2, 3) if n < len(dofs) and set(DOF_NAMES[:n]) <= set(dofs)]


def stiffness_curves(state: Equilibrium) -> Array:
    """Return the terms (n, 15) of the stiffness in their units; NaN without an answer."""
    return state.stiffness[:, *_TERMS]


def swings(values: Array) -> Array:
    """Return the divisors (m,) for errors of curves (n, m): swings, at least LEAST_SWING of size.

    For a stiffness term that symmetry makes zero, the size of the diagonal terms of its directions
    counts. The divisor is 1 if all are zero.
    """
    known = values[np.isfinite(values).all(axis=1)]
    if not known.size:
        return np.ones(values.shape[1])
    size = np.abs(known).max(axis=0)
    swing = np.maximum(np.ptp(known, axis=0), LEAST_SWING * size)
    if values.shape[1] == 15:  # stiffness terms
        rows, columns = _TERMS
        diagonal = size[rows == columns]
        swing = np.maximum(swing, 1e-6 * np.sqrt(diagonal[rows] * diagonal[columns]))
    return np.where(swing > 0.0, swing, 1.0)


def curve_errors(angles: Array, values: Array, dense: Array, expected: Array) -> Array:
    """Return the greatest error over swing of all curves, as straight lines between cage angles.

    Parameters
    ----------
    angles : (n,) [rad], values : (n, m)
        rising cage angles, and the curves at these angles.
    dense : (k,) [rad], expected : (k, m)
        far more cage angles, and the curves at these angles.

    Returns
    -------
    (≤ k,)
        errors at the dense angles at which all curves have an answer.
    """
    lines = np.stack(
        [np.interp(dense, angles, values[:, i]) for i in range(values.shape[1])], axis=1
    )
    error = np.abs(lines - expected) / swings(expected)
    return np.asarray(error[np.isfinite(error).all(axis=1)].max(axis=1, initial=0.0))
