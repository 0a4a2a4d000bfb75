"""Motion by steps that choose themselves, for contacts whose force jumps as they touch.

A fixed step that meets a jump errs by as much as the step is long, whatever its order. Dormand and
Prince's embedded pair notices, and goes over the jump in short steps. That is for contacts
without tension.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.dynamics.motion import Motion
from bearingcore.dynamics.problem import Array, MotionProblem, motion_problem
from bearingcore.dynamics.status import MotionStatus
from bearingcore.scene.scene import Scene

MOST_CALLS = 200_000_000

KINK_SLIVER = 1e-13
"""Half the length [s] of the step across a kink: 1e-13 s times any jump is nothing."""


@dataclass(frozen=True)
class March:
    """What a way to march returned.

    Attributes
    ----------
    history : (steps + 1, 6, n) [m, m/s, m/s²]
        displacement, velocity, acceleration of the inner, then of the outer ring.
    step_rate
        [Hz] of the history.
    calls
        right-hand sides evaluated.
    failure
        empty, or why it is no motion to its end.
    """

    history: Array
    step_rate: float
    calls: int
    failure: str = ""


def whole_steps(step_rate: float, duration: float) -> int:
    """Steps that cover `duration` [s] at `step_rate` [Hz], at least one."""
    return max(math.ceil(duration * step_rate - 1e-9), 1)


def how_it_ended(done: int, n_steps: int, step_rate: float) -> str:
    """Why a march of fixed steps ended early; empty where it did not."""
    return "" if done >= n_steps else f"diverged after {done / step_rate:.2g} s"


def march_adaptively(
    problem: MotionProblem,
    tolerance: float,
    duration: float,
    sample_rate: float,
    *,
    stop_at_kinks: bool = False,
) -> March:
    """Dormand and Prince's pair over `duration` [s], its states at `sample_rate` [Hz].

    `tolerance` is relative to the problem's scale. With `stop_at_kinks` a step ends wherever a
    ball meets an edge or floor.
    """
    n = whole_steps(sample_rate, duration)
    history = np.full((n + 1, 6, len(problem.dofs)), math.nan)
    stops = np.zeros(0)
    if stop_at_kinks:
        # a sliver of a step across each: smooth steps begin and end on the right side of it
        kinks = problem.kinks(duration)
        stops = np.sort(np.concatenate([kinks - KINK_SLIVER, kinks + KINK_SLIVER]))
    adaptive = kernels.Adaptive(1.0 / sample_rate, tolerance, problem.scale, stops, MOST_CALLS)
    filled, _, _, calls = kernels.march_adaptive(
        problem.start.copy(), adaptive, 0.0, problem.system, history
    )
    failure = "" if filled > n else f"the step shrank to nothing at {filled / sample_rate:.2g} s"
    return March(history, sample_rate, calls, failure)


def simulate_adaptive(
    scene: Scene,
    duration: float = 1.4,
    sample_rate: float = 65536.0,
    *,
    tolerance: float = 1e-7,
) -> Motion:
    """Motion of `scene` from its static state at cage angle 0, as `simulate` gives it.

    Parameters
    ----------
    scene
        its active directions move; support and inertia must be known along them.
    duration, sample_rate
        [s], [Hz] of what is returned.
    tolerance
        error of a step over what counts: displacements over one ball's compression under the
        load, velocities over that times the highest natural angular frequency.

    Raises
    ------
    ValueError
        for a shaft that stands still, a scene without a static state, or a support that lacks a
        number.
    """
    tolerance = checks.number("tolerance", tolerance, at_least=1e-14, at_most=1.0)
    duration = checks.number("duration", duration, above=0.0, unit="s")
    sample_rate = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    if scene.shaft_speed == 0.0:
        raise checks.refuse("shaft_speed", 0.0, "above 0 rad/s for a simulated motion")
    problem = motion_problem(scene)
    n = max(round(duration * sample_rate), 1)
    march = march_adaptively(problem, tolerance, n / sample_rate, sample_rate)
    return Motion(
        scene=scene,
        dofs=problem.dofs,
        sample_rate=sample_rate,
        step_rate=march.step_rate,
        status=MotionStatus.STEP_VANISHED if march.failure else MotionStatus.COMPLETED,
        right_hand_side_calls=march.calls,
        time=np.arange(n) / sample_rate,
        ball_load=None,
        history=march.history,
        detail=march.failure and f": {march.failure}",
    )
