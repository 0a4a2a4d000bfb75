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

import numpy as np
from numpy.typing import NDArray

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.common.numbers import level_difference
from bearingcore.dynamics.ball_motion import ball_start, ball_system, place_parts
from bearingcore.dynamics.damping import packed_motion
from bearingcore.dynamics.low_pass import low_passed, rows_needed
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import simulate
from bearingcore.dynamics.step_rate import default_step_rate
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
from bearingcore.signals.spectrum_difference import third_octave_edges
from bearingcore.statics.equilibrium import equilibrium_of

Array = NDArray[np.float64]

BANDS = {"0.3-2.1 kHz": (300.0, 2100.0), "2.1-5 kHz": (2100.0, 5e3), "5-10 kHz": (5e3, 1e4)}

BALL_ERRORS = {
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

BALLS_LEFT_OUT = (
    "general-purpose methods, which hold to tolerances between strikes and take five times as long "
    "(tests compare with them); implicit and exponential steps of the balls alone, which lose an "
    "order whenever a contact opens or closes"
)


@dataclass(frozen=True)
class BallMarch:
    """Accelerations of the housing (samples, directions), their cost, and why it failed, if so."""

    acceleration: Array
    calls: int
    failure: str


Report = Callable[[float], object]

BallMarcher = Callable[[Scene, int, float, float, Report], BallMarch]
"""(scene, steps a sample, duration [s], sample rate [Hz], report of the part done) -> BallMarch"""

MOST_KEPT = 8
"""Steps of a sample, at most, from which it is filtered."""

PIECE = 2**19
"""Steps after which the march in velocities reports, so that it can be cancelled."""


def _unreported(part: float) -> None:
    pass


def _by_own_steps(
    scene: Scene, stride: int, duration: float, sample_rate: float, report: Report = _unreported
) -> BallMarch:
    """In one piece: its variables are none that it could begin from again."""
    dofs = scene.active_dofs
    kept = _kept(stride)
    history, place, y = _empty(scene, duration, kept * sample_rate, kept, place_parts(scene, dofs))
    every = stride // kept
    done = kernels.march_balls(
        y,
        1.0 / (stride * sample_rate),
        0.0,
        every,
        ball_system(packed_motion(scene)),
        history,
        place,
    )
    failure = _failure(done, every * (len(history) - 1))
    return BallMarch(_sampled(history, duration, sample_rate, kept), 4 * done, failure)


def _kept(stride: int) -> int:
    """Of the steps of a sample those from which it is filtered."""
    return max(k for k in range(1, MOST_KEPT + 1) if stride % k == 0)


def _sampled(history: Array, duration: float, sample_rate: float, kept: int) -> Array:
    """The housing's accelerations, filtered: what is above half the rate may not fold back."""
    n = round(duration * sample_rate)
    return low_passed(history, 3, n, sample_rate, kept * sample_rate)


def _in_velocities(
    scene: Scene, stride: int, duration: float, sample_rate: float, report: Report = _unreported
) -> BallMarch:
    system = ball_system(packed_motion(scene), velocities=True)
    kept = _kept(stride)
    rate, every = kept * sample_rate, stride // kept
    history, place, y = _empty(scene, duration, rate, 1, 2)
    last, piece, done = len(history) - 1, max(PIECE // every, 1), 0
    for first in range(0, last, piece):
        report(first / last)
        rows = slice(first, min(first + piece, last) + 1)
        angle = scene.cage_speed * first / rate
        made = kernels.march_balls(
            y, 1.0 / (stride * sample_rate), angle, every, system, history[rows], place[rows]
        )
        done += made
        if made < every * (rows.stop - 1 - first):
            break
    failure = _failure(done, every * last)
    return BallMarch(_sampled(history, duration, sample_rate, kept), 4 * done, failure)


def _empty(
    scene: Scene, duration: float, rate: float, kept: int, parts: int
) -> tuple[Array, Array, Array]:
    """History of the rings and places of the balls, still empty, and the state to begin from."""
    n = rows_needed(round(duration * rate / kept), rate / kept, rate)
    history = np.full((n, 6, len(scene.active_dofs)), math.nan)
    return history, np.empty((-(-n // kept), parts, scene.bearing.n_balls)), _start(scene, parts)


def _start(scene: Scene, parts: int) -> Array:
    packed = packed_motion(scene)
    start = ball_start(packed, equilibrium_of(packed, [0.0]), parts)
    if start is None:
        raise checks.refuse("scene", "without a static state", "one that a motion can start from")
    return start


def _failure(done: int, steps: int) -> str:
    return "" if done >= steps else f"diverged after {done} of {steps} steps"


BALL_METHODS: dict[str, BallMarcher] = {
    "RK4": _by_own_steps,
    "RK4 in velocities": _in_velocities,
}
"""By name: the program's own, and the same steps in variables that jump as a contact closes."""


NO_MASS = "massless balls"
"""The model without the mass of balls, by the program's own steps."""


def third_octaves(acceleration: Array, sample_rate: float) -> dict[str, Array]:
    """Power in third octaves of the housing's filtered acceleration (samples, 2), by band."""
    found = spectrum(acceleration, sample_rate)
    return {
        name: found.powers(third_octave_edges(low, high)) for name, (low, high) in BANDS.items()
    }


def apart(one: dict[str, Array], other: dict[str, Array]) -> dict[str, float]:
    """Greatest difference [dB] in each band; NaN where nothing moves."""
    away = {name: np.abs(level_difference(one[name], other[name])) for name in BANDS}
    return {
        name: float(np.nanmax(off)) if np.any(off >= 0.0) else math.nan
        for name, off in away.items()
    }


def balls_experiment(
    scene: Scene,
    *,
    duration: float = 1.4,
    sample_rate: float = 65536.0,
    steps: tuple[int, ...] | None = None,
    watch: Watch = NOT_WATCHED,
) -> Experiment:
    """Error against cost of ways to march balls with mass, and of leaving the mass out.

    The vibration that is compared is that along x and y, whatever directions the scene has.

    Parameters
    ----------
    scene
        its balls are taken to have mass.
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
        for elements of which no model with mass is known, a shaft that stands still, a scene
        without a static state, or one that moves along neither x nor y.
    """
    if unknown := scene.bearing.kind.mass_unknown:
        raise ValueError(f"there is no model with the mass of {unknown}")
    checks.real_number("shaft_speed", scene.shaft_speed, above=0.0, unit="rad/s")
    scene = scene.replace(balls=WITH_MASS)
    usual = default_step_rate(scene, sample_rate, highest_natural_frequency(scene))
    own = max(round(usual / sample_rate), 1)
    steps = steps or tuple(sorted({max(round(own * part), 1) for part in AROUND}))
    least = max(FINEST, 4 * own)
    began = time.perf_counter()
    sensed = [k for k, dof in enumerate(scene.active_dofs) if dof in ("x", "y")]
    if not sensed:
        raise checks.refuse("dofs", " ".join(scene.active_dofs), "x or y among them")

    def levels(method: str, begin: float, end: float, at: Scene = scene) -> dict[str, Array]:
        finest = least if method == "RK4" else FINER * least
        report = watch.within(_SHARE_OF_REFERENCE * begin, _SHARE_OF_REFERENCE * end)
        report(0.0)
        march = BALL_METHODS[method](at, finest, duration, sample_rate, report)
        return third_octaves(march.acceleration[:, sensed], sample_rate)

    truth = levels("RK4", 0.0, 0.1)
    heavier = scene.replace(density=1.0001 * scene.bearing.density)
    spread = apart(levels("RK4", 0.1, 0.2, heavier), truth)
    agreement = apart(levels("RK4 in velocities", 0.2, 1.0), truth)
    spreads = ", ".join(f"{name} {value:.2f} dB" for name, value in spread.items())
    reference = Reference(
        ("RK4", "RK4 in velocities"),
        agreement,
        all(agreement[name] <= max(2.0 * spread[name], REACH[name]) for name in BANDS),
        time.perf_counter() - began,
        f"Spread with balls heavier by a part in ten thousand: {spreads}",
    )

    def measure(task: tuple[str, int]) -> Point:
        name, stride = task
        if name == NO_MASS:
            return _massless(scene, duration, sample_rate, truth, sensed)
        rate = stride * sample_rate
        march, seconds, runs = least_time(
            lambda: BALL_METHODS[name](scene, stride, duration, sample_rate, _unreported)
        )
        words = f"{rate:.0f} steps/s"
        if march.failure:
            return failed(name, words, rate, march.failure, seconds, march.calls)
        errors = apart(third_octaves(march.acceleration[:, sensed], sample_rate), truth)
        in_use = name == "RK4" and rate == usual
        return Point(name, words, rate, errors, seconds, runs, march.calls, in_use=in_use)

    tasks = [(NO_MASS, 1), *((name, stride) for name in BALL_METHODS for stride in steps)]
    experiment = Experiment(
        "balls",
        f"Methods for balls with mass over {duration:g} s, and balls without",
        BALL_ERRORS,
        "evaluations of all contacts",
        {"": reference},
        (),
        BALLS_LEFT_OUT,
    )
    return measured_in_turn(experiment, tasks, str, measure, watch, begin=_SHARE_OF_REFERENCE)


def _massless(
    scene: Scene, duration: float, sample_rate: float, truth: dict[str, Array], sensed: list[int]
) -> Point:
    """The motion without the mass of balls against the one with it."""
    found, seconds, runs = least_time(
        lambda: simulate(scene.replace(balls=MASSLESS), duration, sample_rate)
    )
    words = f"{found.step_rate:.0f} steps/s"
    if not found.completed:
        return failed(NO_MASS, words, found.step_rate, found.reason, seconds)
    signal = found.outer_acceleration[: round(duration * sample_rate), sensed]
    errors = apart(third_octaves(signal, sample_rate), truth)
    calls = found.right_hand_side_calls
    return Point(NO_MASS, words, found.step_rate, errors, seconds, runs, calls)
