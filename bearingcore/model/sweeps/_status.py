"""Status of a scene in a sweep."""

from __future__ import annotations

from enum import unique

from bearingcore.errors import Status
from bearingcore.model.dynamics import MotionStatus, OrbitStatus
from bearingcore.model.statics._status import StaticStatus


@unique
class SweepStatus(Status):
    """Outcome of a scene of a sweep: `complete`, or the first reason for an unknown number.

    A static reason holds at one or more cage angles. With a free direction, stiffness is known.
    Unknown numbers are NaN.
    """

    NOT_COMPUTED = "not_computed", "not computed"
    COMPLETE = "complete", "this scene has no such mode"
    NOTHING_TOUCHES = "nothing_touches", "nothing touches: no load presses a ball"
    FREE_DIRECTION = "free_direction", "the ring can move without resistance in some direction"
    LOAD_NOT_CARRIED = (
        "load_not_carried",
        "no contact can carry this load: another bearing, held tilts or more axial load are "
        "missing",
    )
    STATIC_STATE_NOT_CONVERGED = "static_state_not_converged", "no static state was found"
    SCENE_REFUSED = "scene_refused", "such a scene is not possible"
    COMPUTATION_REFUSED = (
        "computation_refused",
        "this cannot be computed here: the shaft must turn; mass, stiffness and damping must be "
        "known along each free direction; life and pressure need the groove radii, and life a "
        "rating (of hybrid and self-aligning bearings that of the catalogue); orbits need massless "
        "balls and the published law",
    )
    NO_STATIC_START = "no_static_start", "there is no static state to start from"
    MOTION_DIVERGED = "motion_diverged", "the motion does not stay finite"
    ORBIT_NOT_CONVERGED = "orbit_not_converged", "no orbit was found"
    NO_COMMON_PERIOD = "no_common_period", "the motion never repeats"
    ARITHMETIC_FAILED = "arithmetic_failed", "the numbers are too extreme"
    TOO_MANY_STEPS = "too_many_steps", "the motion takes too many steps"
    TOO_MANY_CONTACTS = "too_many_contacts", "there are too many contacts to solve"
    BEYOND_GEOMETRY = "beyond_geometry", "no equilibrium that the geometry of the contacts allows"

    @property
    def code(self) -> int:
        """Index in `STATUSES`, as in results; 0, not computed, is the value of empty files."""
        return STATUSES.index(self)


STATUSES = tuple(SweepStatus)
"""All statuses in the order of their codes."""

OF_STATICS = {
    StaticStatus.CONVERGED: SweepStatus.COMPLETE,
    StaticStatus.NOTHING_TOUCHES: SweepStatus.NOTHING_TOUCHES,
    StaticStatus.FREE_DIRECTION: SweepStatus.FREE_DIRECTION,
    StaticStatus.NOT_CARRIED: SweepStatus.LOAD_NOT_CARRIED,
    StaticStatus.NOT_CONVERGED: SweepStatus.STATIC_STATE_NOT_CONVERGED,
    StaticStatus.REFUSED: SweepStatus.SCENE_REFUSED,
    StaticStatus.TOO_MANY_CONTACTS: SweepStatus.TOO_MANY_CONTACTS,
    StaticStatus.BEYOND_GEOMETRY: SweepStatus.BEYOND_GEOMETRY,
}
OF_MOTION = {
    MotionStatus.COMPLETED: SweepStatus.COMPLETE,
    MotionStatus.NO_START: SweepStatus.NO_STATIC_START,
    MotionStatus.TOO_MANY_STEPS: SweepStatus.TOO_MANY_STEPS,
    MotionStatus.DIVERGED: SweepStatus.MOTION_DIVERGED,
    MotionStatus.STEP_VANISHED: SweepStatus.MOTION_DIVERGED,
}
OF_ORBIT = {
    OrbitStatus.STABLE: SweepStatus.COMPLETE,
    OrbitStatus.UNSTABLE: SweepStatus.COMPLETE,
    OrbitStatus.NOT_CONVERGED: SweepStatus.ORBIT_NOT_CONVERGED,
    OrbitStatus.NO_PERIOD: SweepStatus.NO_COMMON_PERIOD,
    OrbitStatus.NO_START: SweepStatus.NO_STATIC_START,
    OrbitStatus.TOO_MANY_STEPS: SweepStatus.TOO_MANY_STEPS,
}
