"""A periodic orbit repeated for as long as one likes, as a motion like any other."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.common import checks
from bearingcore.dynamics.motion import Motion
from bearingcore.dynamics.orbit import Orbit


def repeated(found: Orbit, duration: float, sample_rate: float = 65536.0) -> Motion:
    """The orbit's period, one after the other, from cage angle 0 on.

    Parameters
    ----------
    found
        an orbit with a history, stable or not.
    duration
        [s] of the motion.
    sample_rate
        [Hz] wished for. A period holds a whole number of steps, and samples must fit them: the
        motion gets the rate next to this one that does.

    Raises
    ------
    ValueError
        for an orbit that was not found, or numbers that are not positive.
    """
    duration = checks.number("duration", duration, above=0.0, unit="s")
    wished = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    if not found.multipliers.size:
        raise checks.refuse("orbit", found.status, "an orbit that was found")
    history = found.history[:-1]
    step_rate = len(history) / found.period
    if (factor := round(wished / step_rate)) > 1:
        # accelerations jump as balls touch: between steps they are asked for, not interpolated
        history, step_rate = found.finer_history(factor), factor * step_rate
    rate = step_rate / max(round(step_rate / wished), 1)
    n = max(round(duration * rate), 1)
    n_steps = max(math.ceil((n - 1) * step_rate / rate - 1e-9), 1)
    return Motion(
        scene=found.scene,
        dofs=found.dofs,
        sample_rate=rate,
        step_rate=step_rate,
        completed=True,
        status="completed",
        right_hand_side_calls=found.right_hand_side_calls,
        time=np.arange(n) / rate,
        ball_load=None,
        history=history[np.arange(n_steps + 1) % len(history)],
    )
