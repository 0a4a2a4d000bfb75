"""Ways to march a motion, each behind one small interface, so that they can be compared.

A setting is one number: steps a second [Hz] for fixed steps, the tolerance relative to
`MotionProblem.scale` for steps that choose themselves.
"""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bearingcore import kernels
from bearingcore.common.arrays import Array
from bearingcore.common.numbers import thousands
from bearingcore.dynamics.damping import packed_motion
from bearingcore.dynamics.motion import moving_system
from bearingcore.dynamics.problem import MotionProblem
from bearingcore.dynamics.status import MotionStatus


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
        empty, or the reason why the motion is not complete, in the words of the method.
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
    order
        of convergence where all forces are smooth; 0 for steps that choose themselves.
    slow
        True where it takes longer than the others together.
    """

    name: str
    fixed_step: bool
    march: Marcher
    note: str
    order: int = 0
    slow: bool = False


def intervals(rate: float, duration: float) -> int:
    """Number of intervals at `rate` [Hz] that cover `duration` [s], at least one."""
    return max(math.ceil(duration * rate - 1e-9), 1)


def _runge_kutta(*, velocities: bool) -> Marcher:
    """Steps of one length: in variables that do not jump where the law allows it, or velocities."""

    def march(
        problem: MotionProblem, step_rate: float, duration: float, sample_rate: float
    ) -> March:
        system = (
            problem.system
            if velocities
            else moving_system(packed_motion(problem.scene, problem.dofs))
        )
        n_steps = intervals(step_rate, duration)
        history = np.empty((n_steps + 1, 6, len(problem.dofs)))
        y = problem.start.copy()
        kernels.turn_smooth(y, 1.0, 0.0, system)
        done = kernels.march(y, 1.0 / step_rate, 0.0, system, history)
        if done >= n_steps:
            return March(history, step_rate, 4 * n_steps)
        why = f"diverged after {done / step_rate:.2g} s"
        return March(history, step_rate, 4 * n_steps, why)

    return march


def _of_scipy(name: str) -> Marcher:
    """`scipy.integrate.solve_ivp` with the compiled right-hand side."""

    def march(
        problem: MotionProblem, tolerance: float, duration: float, sample_rate: float
    ) -> March:
        from scipy.integrate import solve_ivp  # imported late: slow to import

        n = intervals(sample_rate, duration)
        time = np.arange(n + 1) / sample_rate
        limited = _Limited(problem)
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
            why = str(error) or type(error).__name__
            return March(history, sample_rate, limited.calls, why)
        history = history_of(problem, time[: answer.y.shape[1]], answer.y.T)
        if answer.success and len(history) == n + 1:
            return March(history, sample_rate, limited.calls)
        return March(history, sample_rate, limited.calls, str(answer.message))

    return march


def _of_cvode(name: str) -> Marcher:
    """CVODE of SUNDIALS with the compiled right-hand side, through scikit-sundae."""

    def march(
        problem: MotionProblem, tolerance: float, duration: float, sample_rate: float
    ) -> March:
        n = intervals(sample_rate, duration)
        time = np.arange(n + 1) / sample_rate
        limited, scale = _Limited(problem), problem.scale
        why = ""
        try:
            states = by_cvode(
                lambda t, y: limited.rate(t, y * scale) / scale,
                problem.start / scale,
                time,
                name,
                tolerance,
            )
        except _TooManyCallsError as error:
            states = np.full((1, problem.start.size), math.nan)
            why = str(error)
        history = history_of(problem, time[: len(states)], states * scale)
        if not why and len(history) < n + 1:
            why = f"{MotionStatus.STEP_VANISHED} after {time[len(history) - 1]:.2g} s"
        return March(history, sample_rate, limited.calls, why)

    return march


HAS_CVODE = importlib.util.find_spec("sksundae") is not None
"""Whether scikit-sundae is installed: the extra "cvode"."""


def by_cvode(
    rate: Callable[[float, Array], Array], start: Array, time: Array, method: str, tolerance: float
) -> Array:
    """States at times [s], as far as CVODE came, of y' = rate(t, y) in variables of the size 1.

    `method`: "Adams" or "BDF".
    """
    from sksundae.cvode import CVODE  # imported late: optional

    def fill(t: float, y: Array, rates: Array) -> None:
        rates[:] = rate(t, y)

    solver = CVODE(fill, method=method, rtol=tolerance, atol=tolerance, max_num_steps=MOST_RATES)
    return np.array(solver.solve(time, start).y)


MOST_RATES = 500_000
"""Right-hand sides after which a general-purpose method is given up."""


class _TooManyCallsError(RuntimeError):
    pass


class _Limited:
    """A right-hand side that counts, and gives up after MOST_RATES."""

    def __init__(self, problem: MotionProblem) -> None:
        self._problem, self.calls = problem, 0

    def rate(self, t: float, y: Array) -> Array:
        self.calls += 1
        if self.calls > MOST_RATES:
            raise _TooManyCallsError(f"more than {thousands(MOST_RATES)} right-hand sides")
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
            order=4,
        ),
        Method(
            "RK4 in velocities",
            True,
            _runge_kutta(velocities=True),
            "the same steps with velocities as variables, which jump in rate as a ball touches",
            order=4,
        ),
        Method("scipy RK45", False, _of_scipy("RK45"), "embedded pair of Dormand and Prince"),
        Method("scipy DOP853", False, _of_scipy("DOP853"), "Runge-Kutta of order 8", slow=True),
        Method("scipy LSODA", False, _of_scipy("LSODA"), "Adams or BDF by stiffness"),
        Method(
            "scipy Radau", False, _of_scipy("Radau"), "implicit Runge-Kutta of order 5", slow=True
        ),
        Method("scipy BDF", False, _of_scipy("BDF"), "implicit, of variable order", slow=True),
        Method("CVODE Adams", False, _of_cvode("Adams"), "Adams methods of SUNDIALS"),
        Method("CVODE BDF", False, _of_cvode("BDF"), "backward differences of SUNDIALS"),
    )
}
"""Ways to march by name."""


def usable_methods(*, slow: bool = True) -> tuple[str, ...]:
    """Names of the methods whose packages are installed; without `slow` only quick ones."""
    return tuple(
        name
        for name, method in METHODS.items()
        if (slow or not method.slow) and (HAS_CVODE or not name.startswith("CVODE"))
    )
