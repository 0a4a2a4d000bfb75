"""Time integrators of a motion behind a common interface, for comparison.

A setting is a number: the step rate [Hz] for fixed steps, or for adaptive steps the tolerance
relative to `MotionProblem.scale`.
"""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from bearingcore.common import Array, thousands
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import MotionStatus
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.dynamics._motion import moving_system
from bearingcore.model.dynamics._problem import MotionProblem


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
        number of evaluations of the right-hand side.
    failure
        empty, or the reason why the motion is not complete, in the words of the method.
    """

    history: Array
    step_rate: float
    calls: int
    failure: str = ""


@dataclass(frozen=True)
class Method:
    """A time integrator.

    Attributes
    ----------
    name
        name in charts.
    march
        (problem, setting, duration [s], sample rate [Hz]) -> March.
    tolerances
        settings at which it is measured; empty if the setting is a step rate [Hz].
    order
        order of convergence with smooth forces; 0 for adaptive steps.
    slow
        True if it takes longer than all others together.
    """

    name: str
    march: Callable[[MotionProblem, float, float, float], March]
    tolerances: tuple[float, ...] = ()
    order: int = 0
    slow: bool = False

    @property
    def fixed_step(self) -> bool:
        """True if the setting is a step rate [Hz], False if it is a tolerance."""
        return not self.tolerances


def instants(rate: float, duration: float) -> Array:
    """Return times [s] from 0 at `rate` [Hz] that cover `duration` [s], at least one interval."""
    return np.arange(max(math.ceil(duration * rate - 1e-9), 1) + 1) / rate


class TooManyRatesError(RuntimeError):
    """Error of a method that needs too many evaluations of the right-hand side."""


class Rates:
    """The compiled right-hand side of a problem, in variables scaled to 1, with a count of calls.

    `report` is called with each time [s]. More than `most` calls raise TooManyRatesError.
    """

    def __init__(
        self,
        problem: MotionProblem,
        report: Callable[[float], object] = lambda t: None,
        most: float = math.inf,
    ) -> None:
        self.problem, self.calls = problem, 0
        self._report, self._most = report, most

    @property
    def start(self) -> Array:
        """The scaled state at rest."""
        return self.problem.start / self.problem.scale

    def __call__(self, t: float, y: Array) -> Array:
        self.calls += 1
        if self.calls > self._most:
            raise TooManyRatesError(f"more than {thousands(int(self._most))} right-hand sides")
        self._report(t)
        return self.problem.rate(t, y * self.problem.scale) / self.problem.scale

    def history(self, time: Array, states: Array) -> Array:
        """Return the history (n, 6, directions) of scaled states (≤ n, 4 directions) at times (n,).

        Instants after the last state are NaN.
        """
        problem, n = self.problem, len(self.problem.dofs)
        unscaled = np.full((len(time), 4 * n), math.nan)
        unscaled[: len(states)] = states * problem.scale
        rates = kernels.motion_rates(time, unscaled, 0.0, problem.system)
        history = np.empty((len(time), 6, n))
        for body in range(2):
            columns = slice(2 * body * n, (2 * body + 1) * n)
            following = slice((2 * body + 1) * n, (2 * body + 2) * n)
            history[:, 3 * body] = unscaled[:, columns]
            history[:, 3 * body + 1] = unscaled[:, following]
            history[:, 3 * body + 2] = rates[:, following]
        return history


def _runge_kutta(
    problem: MotionProblem,
    step_rate: float,
    duration: float,
    sample_rate: float,
    *,
    velocities: bool = False,
) -> March:
    """March in fixed steps, in velocities or, if the law allows it, in variables without jumps."""
    system = problem.system
    if not velocities:
        system = moving_system(packed_motion(problem.scene, problem.dofs))
    n_steps = len(instants(step_rate, duration)) - 1
    history = np.empty((n_steps + 1, 6, len(problem.dofs)))
    y = problem.start.copy()
    kernels.turn_smooth(y, 1.0, 0.0, system)
    done = kernels.march(y, 1.0 / step_rate, 0.0, system, history)
    failure = "" if done >= n_steps else f"diverged after {done / step_rate:.2g} s"
    return March(history, step_rate, 4 * n_steps, failure)


MOST_RATES = 500_000
"""Limit on the right-hand sides of a general-purpose method."""

States = Callable[[Rates, Array, float], Array]
"""(rates, times (n,) [s], tolerance) -> scaled states (≤ n, 4 directions), up to a failure."""


def _adaptive(
    problem: MotionProblem, tolerance: float, duration: float, sample_rate: float, *, states: States
) -> March:
    """March by a general-purpose method with adaptive steps."""
    time = instants(sample_rate, duration)
    rates = Rates(problem, most=MOST_RATES)
    history, failure = np.empty((0, rates.start.size)), ""
    try:
        history = states(rates, time, tolerance)
        if len(history) < len(time):
            failure = f"{MotionStatus.STEP_VANISHED} after {time[max(len(history) - 1, 0)]:.2g} s"
    except (TooManyRatesError, ValueError, np.linalg.LinAlgError) as error:
        failure = str(error) or type(error).__name__
    return March(rates.history(time, history), sample_rate, rates.calls, failure)


def _scipy(name: str, *tolerances: float, slow: bool = False) -> Method:
    """Return a method of `scipy.integrate.solve_ivp` by its name."""

    def states(rates: Rates, time: Array, tolerance: float) -> Array:
        from scipy.integrate import solve_ivp  # imported late: slow to import

        relative = max(tolerance, 2.3e-14)
        answer = solve_ivp(  # type: ignore[call-overload]
            rates, (0.0, time[-1]), rates.start, name, time, rtol=relative, atol=tolerance
        )
        return np.asarray(answer.y).T

    return Method(f"scipy {name}", partial(_adaptive, states=states), tolerances, slow=slow)


HAS_CVODE = importlib.util.find_spec("sksundae") is not None
"""True if scikit-sundae is installed, which the extra "cvode" does."""


def cvode_states(rates: Rates, time: Array, tolerance: float, name: str = "Adams") -> Array:
    """Return scaled states at times [s] by CVODE of SUNDIALS, up to a failure; name: or "BDF"."""
    from sksundae.cvode import CVODE  # imported late: optional

    def fill(t: float, y: Array, out: Array) -> None:
        out[:] = rates(t, y)

    solver = CVODE(fill, method=name, rtol=tolerance, atol=tolerance, max_num_steps=MOST_RATES)
    return np.array(solver.solve(time, rates.start).y)


def _cvode(name: str, *tolerances: float) -> Method:
    march = partial(_adaptive, states=partial(cvode_states, name=name))
    return Method(f"CVODE {name}", march, tolerances)


FINE, COARSE = (1e-2, 1e-4, 1e-6, 1e-9, 1e-11), (1e-3, 1e-6)
"""Tolerances at which methods are measured; COARSE is for those that take long at small ones."""

METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        # the program's own method, in variables without jumps if the scene allows them
        Method("RK4", _runge_kutta, order=4),
        # with velocities as variables, whose rates jump when a ball touches
        Method("RK4 in velocities", partial(_runge_kutta, velocities=True), order=4),
        _scipy("RK45", *FINE[:-1]),
        _scipy("DOP853", *FINE, slow=True),
        _scipy("LSODA", *FINE),
        _scipy("Radau", *COARSE, slow=True),
        _scipy("BDF", *COARSE, slow=True),
        _cvode("Adams", *FINE),
        _cvode("BDF", *COARSE, 1e-9),
    )
}
"""Time integrators by name."""


def usable_methods(*, slow: bool = True) -> tuple[str, ...]:
    """Return names of methods whose packages are installed; without `slow` only quick ones."""
    return tuple(
        name
        for name, method in METHODS.items()
        if (slow or not method.slow) and (HAS_CVODE or not name.startswith("CVODE"))
    )
