"""Work and precision of the time integrators of a motion."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from bearingcore.common import _checks as checks, scientific
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import default_step_rate, highest_natural_frequency
from bearingcore.model.dynamics._low_pass import hermite_weights
from bearingcore.model.dynamics._problem import motion_problem
from bearingcore.model.experiments._integrators import HAS_CVODE, METHODS, Method, usable_methods
from bearingcore.model.experiments._points import (
    NOT_WATCHED,
    Experiment,
    Point,
    Watch,
    least_time,
    measure_in_turn,
)
from bearingcore.model.experiments._references import (
    MOTION_ERRORS,
    MotionReference,
    motion_reference,
)
from bearingcore.model.scene import Scene
from bearingcore.recordings._spectrum_difference import BAND

SAMPLE_RATE = 65536.0
"""Rate [Hz] of the instants at which motions are compared."""

SHARE_OF_REFERENCE = 0.3
"""Usual share of the reference in the work."""

MOTIONS_LEFT_OUT = (
    "Radau and BDF below a tolerance of 1e-6, where they take minutes; general-purpose methods "
    "with the right-hand side in NumPy, five times slower with the same errors; exponential and "
    "multirate methods, as no part of the motion is slow while another is fast"
)


def settings_of(method: Method, step_rate: float) -> tuple[float, ...]:
    """Return the settings for a method: its tolerances, or step rates around `step_rate` [Hz]."""
    if method.fixed_step:
        return tuple(step_rate * 2.0**k for k in range(-2, 4))
    return method.tolerances


def measured(
    method: Method, setting: float, reference: MotionReference, usual: float = math.nan
) -> Point:
    """Measure a method at a setting; `usual` is the step rate [Hz] that the program would use."""
    problem, duration, rate = reference.problem, reference.duration, reference.sample_rate
    march, seconds = least_time(lambda: method.march(problem, setting, duration, rate))
    words = f"{setting:.0f} steps/s" if method.fixed_step else f"tolerance {scientific(setting)}"
    if march.failure:
        status = f"failed: {march.failure}"
        return Point(method.name, words, setting, {}, seconds, march.calls, status)
    history = resample(march.history, march.step_rate, rate, len(reference.history))
    errors = reference.errors(history)
    used = method.name == "RK4" and setting == usual
    return Point(method.name, words, setting, errors, seconds, march.calls, in_use=used)


def resample(history: np.ndarray, step_rate: float, sample_rate: float, n: int) -> np.ndarray:
    """Return a history at n instants of another rate, by quintic interpolation between steps.

    One rate must be a whole multiple of the other, as in `simulate`.
    """
    if step_rate >= sample_rate:
        return history[:: round(step_rate / sample_rate)][:n]
    ratio = round(sample_rate / step_rate)
    out = np.empty((n, *history.shape[1:]))
    for derivative in range(3):
        weights = hermite_weights(np.arange(ratio) / ratio, derivative, 1.0 / step_rate)
        for body in (0, 3):
            kernels.interpolate_steps(history, body, weights, 0, out[:, body + derivative])
    return out


def motion_experiment(
    scene: Scene,
    *,
    duration: float = 0.35,
    methods: Sequence[str] | None = None,
    watch: Watch = NOT_WATCHED,
) -> Experiment:
    """Measure error and cost of time integrators for the motion of `scene` from rest.

    Parameters
    ----------
    scene
        scene that moves, along its active directions.
    duration
        [s] of motion.
    methods
        names out of `integrators.METHODS`; None takes all that are installed.
    watch
        progress, intermediate results, and cancelling.

    Raises
    ------
    ValueError
        for unknown methods, a shaft that stands still, or a scene without a static state.
    """
    duration = checks.real_number("duration", duration, above=0.0, unit="s")
    names = usable_methods() if methods is None else tuple(methods)
    for name in names:
        checks.choice("method", name, tuple(METHODS))
    problem = motion_problem(scene)
    highest = highest_natural_frequency(scene)
    report = watch.within(0.0, SHARE_OF_REFERENCE)
    report(0.0)
    for name in names:
        if METHODS[name].fixed_step:  # compile now, not while time is measured
            first = settings_of(METHODS[name], SAMPLE_RATE)[0]
            METHODS[name].march(problem, first, 1e-3, SAMPLE_RATE)
    reference = motion_reference(problem, duration, SAMPLE_RATE, BAND * highest, report)
    usual = default_step_rate(scene, SAMPLE_RATE)
    tasks = [(METHODS[name], s) for name in names for s in settings_of(METHODS[name], usual)]
    experiment = Experiment(
        "motion",
        MOTION_ERRORS,
        "right-hand sides",
        {"": reference.reference},
        (),
        MOTIONS_LEFT_OUT
        if HAS_CVODE
        else f"{MOTIONS_LEFT_OUT}; CVODE, as scikit-sundae is not installed",
    )
    return measure_in_turn(
        experiment,
        tasks,
        lambda task: f"{task[0].name}, {scientific(task[1])}",
        lambda task: measured(*task, reference, usual),
        watch,
        begin=SHARE_OF_REFERENCE,
    )
