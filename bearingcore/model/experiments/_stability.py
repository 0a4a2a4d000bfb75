"""Limits of stability: steps that are too long for Runge-Kutta.

The linear limit is the longest step at which a linear oscillation does not grow, for the stiffest
static state of the scene. It follows from the eigenvalues λ of the linearised motion (Eq. 28 with
correct signs) and the amplification of the method.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import ResultTable, shown_as_table, table_of
from bearingcore.model.dynamics import contact_damping, default_step_rate, highest_natural_frequency
from bearingcore.model.dynamics._modes import loaded_directions, two_body_matrix
from bearingcore.model.dynamics._problem import motion_problem
from bearingcore.model.experiments._integrators import METHODS, March
from bearingcore.model.experiments._points import NOT_WATCHED, Watch
from bearingcore.model.scene import DOF_NAMES, Scene
from bearingcore.model.statics._positions import over_all_positions

STABLE, DIVERGED = "stable", "diverged"

GROWN = 100.0
"""Amplitude above which a motion counts as diverged."""

FIXED_STEP = tuple(name for name, method in METHODS.items() if method.fixed_step)


@dataclass(frozen=True)
class Trial:
    """One method at one step rate.

    Attributes
    ----------
    method, step_rate [Hz]
        name of the method, and step rate.
    amplitude
        root mean square of the housing's acceleration over that with the program's own steps;
        infinite if the motion broke off.
    """

    method: str
    step_rate: float
    amplitude: float

    @property
    def verdict(self) -> str:
        """The word "diverged" if the amplitude is GROWN or more, otherwise "stable"."""
        return STABLE if self.amplitude < GROWN else DIVERGED


@shown_as_table
@dataclass(frozen=True)
class StabilityChart:
    """Verdicts over methods and step rates, with the limits of linear theory.

    Attributes
    ----------
    linear_limit
        least step rate [Hz] at which each method should be stable; 0 if all are stable.
    highest_frequency
        highest natural frequency [Hz] of the stiffest static state.
    trials
        trials of each method and step rate.
    completed
        False if the chart was cancelled.
    """

    linear_limit: dict[str, float]
    highest_frequency: float
    trials: tuple[Trial, ...]
    completed: bool = True

    def stability_limit(self, method: str) -> float:
        """Return the least tried step rate [Hz] above which no trial diverged; inf for none."""
        limit = math.inf
        for trial in sorted(self.trials, key=lambda t: -t.step_rate):
            if trial.method == method:
                if trial.verdict == DIVERGED:
                    break
                limit = trial.step_rate
        return limit

    def table(self) -> ResultTable:
        """A row for each trial: method, step rate, amplitude and verdict, with the linear limit."""
        trials = self.trials
        return table_of(
            ("method", "", "method"),
            ("step_rate", "Hz", "step_rate"),
            ("amplitude", "1", "amplitude"),
            ("verdict", "", "verdict"),
            ("linear_limit", "Hz", [self.linear_limit[t.method] for t in trials]),
            of=trials,
        )


def linear_limits(scene: Scene) -> dict[str, float]:
    """Return the least stable step rate [Hz] of each fixed-step method for the stiffest state.

    It is 0 for methods that are stable at any step. Damping, which can help or harm, is included.
    """
    dofs = scene.active_dofs
    index = [DOF_NAMES.index(name) for name in dofs]
    state = over_all_positions(scene, 31)
    mass = scene.support.inertias(dofs)
    damping = contact_damping(scene) * loaded_directions(state)
    values = []
    # only the stiffest of thousands of positions need eigenvalues
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
    # the stiffest state is that with the greatest eigenvalue
    stiffest_of_all = max(values, key=lambda rates: np.abs(rates).max())
    return dict.fromkeys(FIXED_STEP, _least_stable_rate(stiffest_of_all))


def _least_stable_rate(rates: NDArray[np.complex128]) -> float:
    """Return the least step rate [Hz] at which no motion with eigenvalues λ [1/s] grows.

    A Runge-Kutta step h of order 4 multiplies a motion by 1 + z + z²/2 + z³/6 + z⁴/24, z = h λ.
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
    scene: Scene, *, duration: float = 0.25, watch: Watch = NOT_WATCHED
) -> StabilityChart:
    """March `scene` by every fixed-step method at steps from far too long to good.

    Parameters
    ----------
    scene
        scene that moves.
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
    reference = _rms_acceleration(METHODS["RK4"].march(problem, usual, duration, usual))
    limits = linear_limits(scene)
    # steps per period of the highest natural frequency: powers of √2 around the limits 2.2 and π
    rates = highest * 2.0 ** np.arange(0.0, 6.01, 0.5)
    tasks = [(name, rate) for name in FIXED_STEP for rate in rates.tolist()]
    trials = []
    for name, rate in watch.in_turn(tasks, lambda task: f"{task[0]}, {task[1]:.0f} steps/s"):
        with np.errstate(all="ignore"):
            rms = _rms_acceleration(METHODS[name].march(problem, rate, duration, rate))
        trials.append(Trial(name, rate, rms / max(reference, 1e-300)))
    return StabilityChart(limits, highest, tuple(trials), len(trials) == len(tasks))


def _rms_acceleration(march: March) -> float:
    """Return the root mean square of the housing's acceleration; inf if the motion broke off."""
    return math.inf if march.failure else math.sqrt(float(np.mean(march.history[:, 5] ** 2)))
