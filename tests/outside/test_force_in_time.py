"""A shock and a swept sine on the shaft, against SciPy's DOP853 on equations of other modules."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bearingcore import ForceSamples, simulate
from tests.outside import march, test_heavy_balls as heavy
from tests.outside.test_charts import problem
from tests.outside.witness import witness

RATE, DURATION = 65_536.0, 0.03
TIME = np.arange(2000) / 40_000.0
SHOCK = np.where(TIME < 5e-3, -300.0 * np.sin(math.pi * TIME / 5e-3), 0.0)
SWEEP = 40.0 * np.sin(2.0 * math.pi * (50.0 + 15_000.0 * TIME) * TIME)
"""[N] from 50 Hz to 950 Hz at the end of the motion."""


@witness(
    "function: simulate", "balls: *",
    by="SciPy's DOP853 on the equations of `march.py` and of `test_heavy_balls.py`",
    compared="housing's velocity, the fan rig under a half-sine shock of three times its load and "
    "a swept sine, root mean square of what differs", within=1e-3,
)  # fmt: skip
@pytest.mark.parametrize("balls", ["massless", "with mass"])
def test_a_shock_and_a_sweep(balls: str) -> None:
    scene = heavy.RIG.replace(balls=balls)
    force = ForceSamples(np.column_stack([SWEEP, SHOCK]), 40_000.0)
    steps = 2.0 * RATE if balls == "massless" else None
    motion = simulate(scene, DURATION, RATE, force=force, step_rate=steps)
    first, still = simulate(scene, 1e-3), simulate(scene, DURATION, RATE)
    one = replace(problem("fan-rig"), c=heavy.DAMPING)
    packed = one.packed()

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        pushed = np.array([np.interp(t, TIME, SWEEP), np.interp(t, TIME, SHOCK)])
        if balls == "massless":
            out = march.rates(t, y, *packed)
            out[4:6] += 1e6 * pushed / one.mass
        else:
            out = heavy.heavy_rates(t, y, -math.inf)
            out[y.size // 2 : y.size // 2 + 2] += 1e6 * pushed / heavy.MASS
        return out

    start = one.start()
    if first.ball_place is not None:
        rest = [first.inner_displacement[0], first.outer_displacement[0], first.ball_place[0, 0]]
        start = np.concatenate([1e6 * np.concatenate(rest), np.zeros(4 + heavy.N_BALLS)])
    made = solve_ivp(
        rates, (0.0, motion.time[-1]), start, "DOP853", motion.time,
        rtol=1e-8, atol=1e-7, max_step=1e-4,
    )  # fmt: skip
    assert made.success
    column = 6 if balls == "massless" else start.size // 2 + 2
    own = 1e-6 * made.y[column : column + 2].T
    off = np.sqrt(np.mean((motion.outer_velocity - own) ** 2, axis=0) / np.mean(own**2, axis=0))
    assert off.max() < (1e-4 if balls == "massless" else 1e-3)
    assert np.ptp(motion.outer_velocity) > 3.0 * np.ptp(still.outer_velocity)
