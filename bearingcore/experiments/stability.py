"""Where steps are too long for Runge-Kutta.

The linear limit is the longest step at which a linear oscillation does not grow, for the stiffest
static state of the scene: the eigenvalues λ of the linearised motion (Eq. 28, signs mended) go
through the method's own amplification.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.progress import in_turn
from bearingcore.common.table import ResultTable, shown_as_table, table_of
from bearingcore.dynamics.modes import (
    contact_damping,
    highest_natural_frequency,
    loaded_directions,
    two_body_matrix,
)
from bearingcore.dynamics.problem import motion_problem
from bearingcore.dynamics.step_rate import default_step_rate
from bearingcore.experiments.integrators import METHODS
from bearingcore.experiments.motions import at_rate
from bearingcore.experiments.points import NOT_WATCHED, RIGHT, Reference, Watch
from bearingcore.experiments.references import MotionReference, motion_reference
from bearingcore.scene.scene import DOF_NAMES, Scene
from bearingcore.signals.spectrum_difference import BAND
from bearingcore.statics.positions import over_all_positions

LOST, WRONG, DIVERGED = "amplitude lost", "wrong", "diverged"
VERDICTS = (RIGHT, LOST, WRONG, DIVERGED)
"""`right`: the spectrum is within RIGHT_DB. `amplitude lost`: the motion is smaller than it should
be by more than a tenth. `wrong`: neither, out of tune or too large. `diverged`: it has grown beyond
any bound."""

_SHARE_OF_REFERENCE = 0.7

RIGHT_DB, LOST_PART, GROWN = 1.0, 0.9, 100.0

FIXED_STEP = tuple(name for name, method in METHODS.items() if method.fixed_step)


@dataclass(frozen=True)
class Trial:
    """One method at one step.

    Attributes
    ----------
    method, step_rate [Hz]
        name of the method, and steps a second.
    verdict
        one of VERDICTS.
    spectrum_error
        [dB], as in `references`; infinite for a motion that diverged.
    amplitude
        root mean square of the housing's acceleration over that of the reference.
    """

    method: str
    step_rate: float
    verdict: str
    spectrum_error: float
    amplitude: float


@shown_as_table
@dataclass(frozen=True)
class StabilityChart:
    """Verdicts over methods and steps, with what linear theory predicts.

    Attributes
    ----------
    linear_limit
        least step rate [Hz] at which each method should be stable, 0 where any will do.
    highest_frequency
        [Hz] of the stiffest static state.
    trials
        what was found.
    reference
        what amplitudes and spectra were compared with.
    completed
        False where it was cancelled.
    """

    linear_limit: dict[str, float]
    highest_frequency: float
    trials: tuple[Trial, ...]
    reference: Reference
    completed: bool = True

    def stability_limit(self, method: str) -> float:
        """Least step rate tried [Hz] from which on the method never diverged; inf for none."""
        limit = math.inf
        for trial in sorted(self.trials, key=lambda t: -t.step_rate):
            if trial.method == method:
                if trial.verdict == DIVERGED:
                    break
                limit = trial.step_rate
        return limit

    def table(self) -> ResultTable:
        """A row a trial: method, steps a second, verdict and errors, with the linear limit."""
        trials = self.trials
        return table_of(
            ("method", "", "method"),
            ("step_rate", "Hz", "step_rate"),
            ("verdict", "", "verdict"),
            ("spectrum_error", "dB", "spectrum_error"),
            ("amplitude_ratio", "1", "amplitude"),
            ("linear_limit", "Hz", [self.linear_limit[t.method] for t in trials]),
            of=trials,
        )


def linear_limits(scene: Scene) -> dict[str, float]:
    """Least stable step rate [Hz] of each fixed-step method at the scene's stiffest static state.

    0 for methods that are stable at any step. Damping counts: it can help or harm.
    """
    dofs = scene.active_dofs
    index = [DOF_NAMES.index(name) for name in dofs]
    state = over_all_positions(scene, 31)
    mass = scene.support.inertias(dofs)
    damping = contact_damping(scene) * loaded_directions(state)
    values = []
    # the softer ones of thousands of positions need no eigenvalues
    size = (state.stiffness[:, index, index] / mass[: len(dofs)]).sum(axis=1)
    stiffest = np.argsort(-np.where(state.converged, size, -math.inf))[:31]
    for k in stiffest[state.converged[stiffest]]:
        K = two_body_matrix(state.stiffness[k][np.ix_(index, index)], scene.support.stiffness(dofs))
        C = two_body_matrix(damping[k][np.ix_(index, index)], scene.support.damping(dofs))
        motion = np.block(
            [[np.zeros_like(K), np.eye(len(K))], [-K / mass[:, None], -C / mass[:, None]]]
        )
        values.append(np.linalg.eigvals(motion))
    if not values:
        return dict.fromkeys(FIXED_STEP, math.nan)
    # the stiffest is the one whose fastest eigenvalue is greatest
    stiffest_of_all = max(values, key=lambda rates: np.abs(rates).max())
    return dict.fromkeys(FIXED_STEP, _least_stable_rate(stiffest_of_all))


def _least_stable_rate(rates: NDArray[np.complex128]) -> float:
    """Least step rate [Hz] at which no motion of eigenvalues λ [1/s] grows.

    A Runge-Kutta step h of order 4 takes a motion by 1 + z + z²/2 + z³/6 + z⁴/24, z = h λ.
    """
    from scipy.optimize import brentq  # imported late: slow to import

    def growth(h: float) -> float:
        factor = np.polyval([1 / 24, 1 / 6, 1 / 2, 1.0, 1.0], h * rates)
        return float(np.abs(factor).max()) - (1.0 + 1e-9)

    steps = np.geomspace(0.02, 200.0, 200) / np.abs(rates).max()
    first = next((i for i, h in enumerate(steps) if growth(h) > 0.0), None)
    if not first:
        return math.inf if first == 0 else 0.0
    low, high = steps[first - 1 : first + 1]
    return 1.0 / float(brentq(growth, low, high, xtol=1e-15 * low))


def stability_chart(
    scene: Scene,
    *,
    duration: float = 0.25,
    watch: Watch = NOT_WATCHED,
) -> StabilityChart:
    """March `scene` by every fixed-step method at steps from far too long to good.

    Parameters
    ----------
    scene
        what moves.
    duration
        [s] of motion.
    watch
        progress and cancelling.

    Raises
    ------
    ValueError
        for a shaft that stands still or a scene without a static state.
    """
    problem = motion_problem(scene)
    highest = highest_natural_frequency(scene)
    usual = default_step_rate(scene, 65536.0)
    sample_rate = max(65536.0, usual)
    report = watch.within(0.0, _SHARE_OF_REFERENCE)
    reference = motion_reference(problem, duration, sample_rate, BAND * highest, report)
    limits = linear_limits(scene)
    # steps a period of the highest natural frequency; powers of √2 about the limits of 2.2 and π
    rates = highest * 2.0 ** np.arange(0.0, 6.01, 0.5)
    # nearest step rates that fit the samples, so that errors can be taken
    fitting = sorted(
        {
            sample_rate / round(sample_rate / rate)
            if rate <= sample_rate
            else sample_rate * round(rate / sample_rate)
            for rate in rates.tolist()
        }
    )
    tasks = [(name, rate) for name in FIXED_STEP for rate in fitting]
    trials = [
        _trial(reference, name, rate)
        for name, rate in in_turn(
            tasks,
            lambda task: f"{task[0]}, {task[1]:.0f} steps/s",
            watch.progress,
            watch.cancelled,
            begin=_SHARE_OF_REFERENCE,
        )
    ]
    return StabilityChart(
        limits, highest, tuple(trials), reference.reference, len(trials) == len(tasks)
    )


def _trial(reference: MotionReference, name: str, step_rate: float) -> Trial:
    sample_rate = reference.sample_rate
    with np.errstate(all="ignore"):
        march = METHODS[name].march(reference.problem, step_rate, reference.duration, sample_rate)
        signal = march.history[:, 5]
        good = reference.history[:, 5]
        amplitude = math.sqrt(float(np.mean(signal**2)) / float(np.mean(good**2)))
        if march.failure or not amplitude < GROWN:
            return Trial(name, step_rate, DIVERGED, math.inf, math.inf)
        history = at_rate(march.history, step_rate, sample_rate, len(reference.history))
        errors = reference.errors(history)
        amplitude = math.sqrt(float(np.mean(history[:, 5] ** 2)) / float(np.mean(good**2)))
    decibel = errors["spectrum"]
    verdict = LOST if amplitude < LOST_PART else WRONG
    if decibel <= RIGHT_DB:
        verdict = RIGHT
    return Trial(name, step_rate, verdict, decibel, amplitude)
