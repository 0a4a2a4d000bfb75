"""Work and precision of ways to march balls that have mass.

Balls in free flight make single lines of a spectrum sensitive to anything: errors are those of
third octaves, means over many lines and ball passes. Their own spread, between two motions whose
balls weigh one part in ten thousand more or less, is given with the reference.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.dynamics.ball_motion import ball_start, ball_system, place_parts
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import default_step_rate, simulate
from bearingcore.experiments.points import (
    NOT_WATCHED,
    Experiment,
    Point,
    Reference,
    Watch,
    failed,
    least_time,
    measured_in_turn,
)
from bearingcore.scene.scene import MASSLESS, WITH_MASS, Scene
from bearingcore.signals.spectrum import spectrum

Array = NDArray[np.float64]

BANDS = {"0.3-2.1 kHz": (300.0, 2100.0), "2.1-5 kHz": (2100.0, 5e3), "5-10 kHz": (5e3, 1e4)}

ERRORS = {
    name: f"greatest error of a third octave of the housing's spectrum in {name}, x and y [dB]"
    for name in BANDS
}

REACH = {"0.3-2.1 kHz": 0.1, "2.1-5 kHz": 0.5, "5-10 kHz": 0.5}
"""[dB] within which the two families must agree, and a method is good enough."""

_SHARE_OF_REFERENCE = 0.5

FINEST = 32
"""Steps a sample of the reference, at least."""
AROUND = (2 / 3, 1.0, 4 / 3, 8 / 3)
"""Steps at which methods are measured, over the program's own."""
FINER = 8
"""As many times more for the second family, whose order is lower."""

LEFT_OUT = (
    "general-purpose methods, which hold to tolerances between strikes and take five times as long "
    "(tests compare with them); implicit and exponential steps of the balls alone, which lose an "
    "order whenever a contact opens or closes"
)


@dataclass(frozen=True)
class BallMarch:
    """A motion of the rings, (samples, 6, 2), what it cost, and why it failed, if it did."""

    history: Array
    calls: int
    failure: str


Marcher = Callable[[Scene, int, float, float], BallMarch]
"""(scene, steps a sample, duration [s], sample rate [Hz]) -> BallMarch"""


def _explicit(*, velocities: bool) -> Marcher:
    def march(scene: Scene, stride: int, duration: float, sample_rate: float) -> BallMarch:
        dofs = scene.active_dofs
        parts = 2 if velocities else place_parts(scene, dofs)
        n = round(duration * sample_rate)
        history = np.full((n, 6, len(dofs)), math.nan)
        place = np.empty((n, parts, scene.bearing.n_balls))
        y = _start(scene, parts)
        system = ball_system(scene, dofs, velocities=velocities)
        h = 1.0 / (stride * sample_rate)
        done = kernels.march_balls(y, h, 0.0, stride, system, history, place)
        return BallMarch(history, 4 * done, _failure(done, stride * (n - 1)))

    return march


def _start(scene: Scene, parts: int) -> Array:
    start = ball_start(scene, scene.active_dofs, parts)
    if start is None:
        raise checks.refuse("scene", "without a static state", "one that a motion can start from")
    return start


def _failure(done: int, steps: int) -> str:
    return "" if done >= steps else f"diverged after {done} of {steps} steps"


BALL_METHODS: dict[str, Marcher] = {
    "RK4": _explicit(velocities=False),
    "RK4 in velocities": _explicit(velocities=True),
}
"""By name: the program's own, and the same steps in variables that jump as a contact closes."""


NO_MASS = "massless balls"
"""The model without the mass of balls, by the program's own steps."""


def third_octaves(acceleration: Array, sample_rate: float) -> dict[str, Array]:
    """Power in third octaves [dB] of the housing's acceleration (samples, 2), by band."""
    frequency, density = spectrum(acceleration, sample_rate)
    levels = {}
    for name, (low, high) in BANDS.items():
        edges = np.geomspace(low, high, max(round(3.0 * math.log2(high / low)), 1) + 1)
        inside = [
            density[(frequency >= a) & (frequency < b)].sum(axis=0) for a, b in pairwise(edges)
        ]
        levels[name] = 10.0 * np.log10(np.array(inside))
    return levels


def apart(one: dict[str, Array], other: dict[str, Array]) -> dict[str, float]:
    """Greatest difference [dB] in each band."""
    return {name: float(np.abs(one[name] - other[name]).max()) for name in BANDS}


def balls_experiment(
    scene: Scene,
    *,
    duration: float = 1.4,
    sample_rate: float = 65536.0,
    steps: tuple[int, ...] | None = None,
    watch: Watch = NOT_WATCHED,
) -> Experiment:
    """Error against cost of ways to march balls with mass, and of leaving the mass out.

    Contacts stay in the plane.

    Parameters
    ----------
    scene
        of two directions, x and y, and contact angle 0; its balls are taken to have mass.
    duration, sample_rate
        [s], [Hz]
    steps
        a sample: the settings at which each method is measured; None takes some about the
        program's own.
    watch
        progress, points as they come, and cancelling.

    Raises
    ------
    ValueError
        for a scene that leaves the plane.
    """
    scene = scene.replace(balls=WITH_MASS)
    if scene.active_dofs != ("x", "y") or place_parts(scene, scene.active_dofs) != 1:
        raise checks.refuse("dofs", " ".join(scene.active_dofs), "x y, at contact angle 0")
    usual = default_step_rate(scene, sample_rate, highest_natural_frequency(scene))
    own = max(round(usual / sample_rate), 1)
    steps = steps or tuple(sorted({max(round(own * part), 1) for part in AROUND}))
    least = max(FINEST, 4 * own)
    began = time.perf_counter()
    report = watch.within(0.0, _SHARE_OF_REFERENCE)

    def levels(method: str, at: Scene = scene) -> dict[str, Array]:
        finest = least if method == "RK4" else FINER * least
        march = BALL_METHODS[method](at, finest, duration, sample_rate)
        return third_octaves(march.history[:, 5], sample_rate)

    report(0.0)
    truth = levels("RK4")
    report(0.33)
    heavier = scene.replace(density=1.0001 * scene.bearing.density)
    spread = apart(levels("RK4", heavier), truth)
    report(0.67)
    agreement = apart(levels("RK4 in velocities"), truth)
    spreads = ", ".join(f"{name} {value:.2f} dB" for name, value in spread.items())
    reference = Reference(
        ("RK4", "RK4 in velocities"),
        agreement,
        all(agreement[name] <= max(2.0 * spread[name], REACH[name]) for name in BANDS),
        time.perf_counter() - began,
        f"spread with balls heavier by a part in ten thousand: {spreads}",
    )

    def measure(task: tuple[str, int]) -> Point:
        name, stride = task
        if name == NO_MASS:
            return _massless(scene, duration, sample_rate, truth)
        rate = stride * sample_rate
        march, seconds, runs = least_time(
            lambda: BALL_METHODS[name](scene, stride, duration, sample_rate)
        )
        words = f"{rate:.0f} steps/s"
        if march.failure:
            return failed(name, words, rate, march.failure, seconds, march.calls)
        errors = apart(third_octaves(march.history[:, 5], sample_rate), truth)
        in_use = name == "RK4" and rate == usual
        return Point(name, words, rate, errors, seconds, runs, march.calls, in_use=in_use)

    tasks = [(NO_MASS, 1), *((name, stride) for name in BALL_METHODS for stride in steps)]
    experiment = Experiment(
        "balls",
        f"Ways to march balls with mass over {duration:g} s, and balls without",
        ERRORS,
        "evaluations of all contacts",
        {"": reference},
        (),
        LEFT_OUT,
    )
    return measured_in_turn(experiment, tasks, str, measure, watch, begin=_SHARE_OF_REFERENCE)


def _massless(scene: Scene, duration: float, sample_rate: float, truth: dict[str, Array]) -> Point:
    """The motion without the mass of balls against the one with it."""
    found, seconds, runs = least_time(
        lambda: simulate(scene.replace(balls=MASSLESS), duration, sample_rate)
    )
    words = f"{found.step_rate:.0f} steps/s"
    if not found.completed:
        return failed(NO_MASS, words, found.step_rate, found.reason, seconds)
    signal = found.outer_acceleration[: round(duration * sample_rate)]
    errors = apart(third_octaves(signal, sample_rate), truth)
    calls = found.right_hand_side_calls
    return Point(NO_MASS, words, found.step_rate, errors, seconds, runs, calls)
