"""Motion by steps that choose themselves, for contacts whose force jumps as they touch.

A fixed step that meets a jump errs by as much as the step is long, whatever its order. Dormand and
Prince's embedded pair notices, and goes over the jump in short steps. That is for contacts
without tension.
"""

from __future__ import annotations

import numpy as np

from bearingcore import checks
from bearingcore.motion import Motion
from bearingcore.precision.integrators import METHODS
from bearingcore.precision.problem import motion_problem
from bearingcore.scene import Scene


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
    march = METHODS["Dormand-Prince"].march(problem, tolerance, n / sample_rate, sample_rate)
    return Motion(
        scene=scene,
        dofs=problem.dofs,
        sample_rate=sample_rate,
        step_rate=march.step_rate,
        completed=not march.failure,
        status=march.failure or "completed",
        right_hand_side_calls=march.calls,
        time=np.arange(n) / sample_rate,
        ball_load=None,
        history=march.history,
    )
