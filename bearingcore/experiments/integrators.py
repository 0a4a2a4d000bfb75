"""Ways to march a motion, each behind one small interface, so that they can be compared.

A setting is one number: steps a second [Hz] for fixed steps, the tolerance relative to
`MotionProblem.scale` for steps that choose themselves.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bearingcore import kernels
from bearingcore.dynamics.motion import moving_system
from bearingcore.dynamics.problem import Array, MotionProblem


@dataclass(frozen=True)
class March:
    """Result of a time integration.

    Attributes
    ----------
    history : (steps + 1, 6, n) [m, m/s, m/s²]
        displacement, velocity, acceleration of the inner, then of the outer ring.
    step_rate
        [Hz] of the history.
    calls
        right-hand sides evaluated.
    failure
        empty, or the reason why the motion is not complete.
    """

    history: Array
    step_rate: float
    calls: int
    failure: str = ""


Marcher = Callable[[MotionProblem, float, float, float], March]
"""(problem, setting, duration [s], sample rate [Hz]) -> March"""


@dataclass(frozen=True)
class Method:
    """A way to march.

    Attributes
    ----------
    name
        as charts show it.
    fixed_step
        True where the setting is a step rate [Hz], False where it is a tolerance.
    march
        does it.
    note
        what it is, in a sentence.
    """

    name: str
    fixed_step: bool
    march: Marcher
    note: str


def intervals(rate: float, duration: float) -> int:
    """Number of intervals at `rate` [Hz] that cover `duration` [s], at least one."""
    return max(math.ceil(duration * rate - 1e-9), 1)


def _runge_kutta(*, velocities: bool) -> Marcher:
    """Steps of one length: in variables that do not jump where the law allows it, or velocities."""

    def march(
        problem: MotionProblem, step_rate: float, duration: float, sample_rate: float
    ) -> March:
        system = problem.system if velocities else moving_system(problem.scene, problem.dofs)
        n_steps = intervals(step_rate, duration)
        history = np.empty((n_steps + 1, 6, len(problem.dofs)))
        y = problem.start.copy()
        kernels.turn_smooth(y, 1.0, 0.0, system)
        done = kernels.march(y, 1.0 / step_rate, 0.0, system, history)
        failure = "" if done >= n_steps else f"diverged after {done / step_rate:.2g} s"
        return March(history, step_rate, 4 * n_steps, failure)

    return march


def _of_scipy(name: str) -> Marcher:
    """`scipy.integrate.solve_ivp` with the compiled right-hand side."""

    def march(
        problem: MotionProblem, tolerance: float, duration: float, sample_rate: float
    ) -> March:
        from scipy.integrate import solve_ivp  # imported late: slow to import

        n = intervals(sample_rate, duration)
        time = np.arange(n + 1) / sample_rate
        limited = _Limited(problem, MOST_SCIPY_CALLS)
        try:
            answer = solve_ivp(  # type: ignore[call-overload]
                limited.rate,
                (0.0, time[-1]),
                problem.start,
                method=name,
                t_eval=time,
                rtol=max(tolerance, 2.3e-14),
                atol=tolerance * problem.scale,
            )
        except (_TooManyCallsError, ValueError, np.linalg.LinAlgError) as error:
            history = np.full((n + 1, 6, len(problem.dofs)), math.nan)
            return March(history, sample_rate, limited.calls, str(error) or type(error).__name__)
        history = history_of(problem, time[: answer.y.shape[1]], answer.y.T)
        failure = "" if answer.success and len(history) == n + 1 else str(answer.message)
        return March(history, sample_rate, limited.calls, failure)

    return march


MOST_SCIPY_CALLS = 5_000_000


class _TooManyCallsError(RuntimeError):
    pass


class _Limited:
    """A right-hand side that counts, and gives up after `most` calls."""

    def __init__(self, problem: MotionProblem, most: int) -> None:
        self._problem, self._most, self.calls = problem, most, 0

    def rate(self, t: float, y: Array) -> Array:
        self.calls += 1
        if self.calls > self._most:
            raise _TooManyCallsError(f"more than {self._most:,} right-hand sides")
        return self._problem.rate(t, y)


def history_of(problem: MotionProblem, time: Array, states: Array) -> Array:
    """History (n, 6, directions) of states (n, 4 directions) at times (n,) [s]."""
    n = len(problem.dofs)
    rates = kernels.motion_rates(time, np.ascontiguousarray(states), 0.0, problem.system)
    history = np.empty((len(time), 6, n))
    for body in range(2):
        columns = slice(2 * body * n, (2 * body + 1) * n)
        following = slice((2 * body + 1) * n, (2 * body + 2) * n)
        history[:, 3 * body] = states[:, columns]
        history[:, 3 * body + 1] = states[:, following]
        history[:, 3 * body + 2] = rates[:, following]
    return history


METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        Method(
            "RK4",
            True,
            _runge_kutta(velocities=False),
            "Runge-Kutta of order 4 as the program uses it: in variables that do not jump where "
            "the scene allows them",
        ),
        Method(
            "RK4 in velocities",
            True,
            _runge_kutta(velocities=True),
            "the same steps with velocities as variables, which jump in rate as a ball touches",
        ),
        Method("scipy RK45", False, _of_scipy("RK45"), "embedded pair of Dormand and Prince"),
        Method("scipy DOP853", False, _of_scipy("DOP853"), "Runge-Kutta of order 8"),
        Method("scipy LSODA", False, _of_scipy("LSODA"), "Adams or BDF by stiffness"),
        Method("scipy Radau", False, _of_scipy("Radau"), "implicit Runge-Kutta of order 5"),
        Method("scipy BDF", False, _of_scipy("BDF"), "implicit, of variable order"),
    )
}
"""Ways to march by name."""
