"""Statuses of a simulated motion and of the search for an orbit."""

from __future__ import annotations

from enum import unique

from bearingcore.errors import Status


@unique
class MotionStatus(Status):
    """Outcome of a simulated motion."""

    COMPLETED = "completed", "the simulated motion is complete"
    TOO_MANY_STEPS = "too many steps", "the simulated motion takes too many steps"
    NO_START = "no static state to start from", "there is no static state to start from"
    DIVERGED = "diverged", "the simulated motion diverged"
    STEP_VANISHED = "no step is small enough", "no step of the simulation is small enough"


@unique
class OrbitStatus(Status):
    """Outcome of the search for a periodic motion."""

    STABLE = "stable orbit"
    UNSTABLE = "unstable orbit"
    NOT_CONVERGED = "not converged"
    NO_PERIOD = "no common period"
    NO_START = "no static state to start from"
    TOO_MANY_STEPS = "too many steps"
