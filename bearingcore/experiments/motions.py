"""Work and precision of ways to march a motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from bearingcore import kernels
from bearingcore.common import checks
from bearingcore.common.numbers import scientific
from bearingcore.common.progress import Cancelled, Progress, in_turn
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import default_step_rate, hermite_weights
from bearingcore.dynamics.problem import motion_problem
from bearingcore.experiments.integrators import METHODS, Method
from bearingcore.experiments.points import Experiment, Point, failed, least_time
from bearingcore.experiments.references import MOTION_ERRORS, MotionReference, motion_reference
from bearingcore.scene.scene import Scene

BAND = 1.25
"""Spectra count up to this times the highest natural frequency."""

TOLERANCES = {
    "scipy RK45": (1e-3, 1e-6, 1e-9),
    "scipy DOP853": (1e-3, 1e-6, 1e-9),
    "scipy LSODA": (1e-3, 1e-6, 1e-9),
    "scipy Radau": (1e-3, 1e-6),
    "scipy BDF": (1e-3, 1e-6),
}

LEFT_OUT = (
    "Radau and BDF below a tolerance of 1e-6, where they take minutes; general-purpose methods "
    "with the right-hand side in NumPy, five times slower with the same errors; exponential and "
    "multirate methods, as no part of the motion is slow while another is fast"
)


def settings_of(method: Method, step_rate: float) -> tuple[float, ...]:
    """The settings at which a method is measured, around `step_rate` [Hz] for fixed steps."""
    if method.fixed_step:
        return tuple(step_rate * 2.0**k for k in range(-2, 4))
    return TOLERANCES[method.name]


def measured(method: Method, setting: float, reference: MotionReference) -> Point:
    """One method at one setting against a reference."""
    problem, duration, rate = reference.problem, reference.duration, reference.sample_rate
    march, seconds, runs = least_time(lambda: method.march(problem, setting, duration, rate))
    words = f"{setting:.0f} steps/s" if method.fixed_step else f"tolerance {scientific(setting)}"
    if march.failure:
        return failed(method.name, words, setting, march.failure, seconds, march.calls)
    history = at_rate(march.history, march.step_rate, rate, len(reference.history))
    errors = reference.errors(history)
    settings = {"step_rate": setting} if method.name == "RK4" else {}
    return Point(method.name, words, setting, errors, seconds, runs, march.calls, settings=settings)


def at_rate(history: np.ndarray, step_rate: float, sample_rate: float, n: int) -> np.ndarray:
    """A history at n instants of another rate; between steps by quintic interpolation.

    Of two rates one must be a whole multiple of the other, as in `simulate`.
    """
    if step_rate >= sample_rate:
        return history[:: round(step_rate / sample_rate)][:n]
    ratio = round(sample_rate / step_rate)
    out = np.empty((n, *history.shape[1:]))
    for derivative in range(3):
        weights = hermite_weights(np.arange(ratio) / ratio, derivative, 1.0 / step_rate)
        for body in (0, 3):
            kernels.between_steps(history, body, weights, 0, out[:, body + derivative])
    return out


def motion_experiment(
    scene: Scene,
    *,
    duration: float = 0.35,
    sample_rate: float = 65536.0,
    methods: Sequence[str] | None = None,
    progress: Progress | None = None,
    cancelled: Cancelled | None = None,
) -> Experiment:
    """Error against cost of ways to march the motion of `scene` from rest.

    Parameters
    ----------
    scene
        what moves; the active directions are the scene's.
    duration
        [s] of motion.
    sample_rate
        [Hz] of the instants at which motions are compared.
    methods
        names out of `integrators.METHODS`; None takes all.
    progress, cancelled
        see `points`.

    Raises
    ------
    ValueError
        for unknown methods, a shaft that stands still, or a scene without a static state.
    """
    duration = checks.number("duration", duration, above=0.0, unit="s")
    sample_rate = checks.number("sample_rate", sample_rate, above=0.0, unit="Hz")
    if scene.shaft_speed == 0.0:
        raise checks.refuse("shaft_speed", 0.0, "above 0 rad/s for a motion")
    names = tuple(METHODS) if methods is None else tuple(methods)
    for name in names:
        checks.choice("method", name, tuple(METHODS))
    problem = motion_problem(scene)
    highest = highest_natural_frequency(scene)
    if progress is not None:
        progress(0.0, "reference by two families")
    for name in names:
        if not name.startswith("scipy"):  # so that nothing is compiled while time is taken
            METHODS[name].march(
                problem, settings_of(METHODS[name], sample_rate)[0], 1e-3, sample_rate
            )
    reference = motion_reference(problem, duration, sample_rate, BAND * highest)
    usual = default_step_rate(scene, sample_rate, highest)
    tasks = [(METHODS[name], s) for name in names for s in settings_of(METHODS[name], usual)]
    points = [
        measured(method, setting, reference)
        for method, setting in in_turn(
            tasks,
            lambda task: f"{task[0].name}, {scientific(task[1])}",
            progress,
            cancelled,
            begin=0.1,
        )
    ]
    return Experiment(
        "motion",
        f"Motion over {duration:g} s in {', '.join(problem.dofs)} at {sample_rate:.0f} samples/s",
        MOTION_ERRORS,
        "right-hand sides",
        {"": reference.reference},
        tuple(points),
        LEFT_OUT,
        completed=len(points) == len(tasks),
    )
