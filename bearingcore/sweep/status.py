"""Status of a scene in a sweep."""

from __future__ import annotations

from enum import unique

from bearingcore.dynamics.status import MotionStatus, OrbitStatus
from bearingcore.errors import Status
from bearingcore.statics.status import StaticStatus


@unique
class SweepStatus(Status):
    """`complete`, or the first thing that kept a number of the scene from being known.

    Nothing touches, a free direction and what follows: at some cage angle at least; a free
    direction still has a stiffness. What is not known is NaN.
    """

    NOT_COMPUTED = "not_computed"
    COMPLETE = "complete"
    NOTHING_TOUCHES = "nothing_touches"
    FREE_DIRECTION = "free_direction"
    LOAD_NOT_CARRIED = "load_not_carried"
    STATIC_STATE_NOT_CONVERGED = "static_state_not_converged"
    SCENE_REFUSED = "scene_refused"
    COMPUTATION_REFUSED = "computation_refused"
    NO_STATIC_START = "no_static_start"
    MOTION_DIVERGED = "motion_diverged"
    ORBIT_NOT_CONVERGED = "orbit_not_converged"
    NO_COMMON_PERIOD = "no_common_period"
    ARITHMETIC_FAILED = "arithmetic_failed"
    TOO_MANY_STEPS = "too_many_steps"
    TOO_MANY_CONTACTS = "too_many_contacts"
    BEYOND_GEOMETRY = "beyond_geometry"

    @property
    def code(self) -> int:
        """Its place in `STATUSES`, which results hold; 0, not computed, is what empty files say."""
        return STATUSES.index(self)

    @property
    def sentence(self) -> str:
        """Why there is no number, as a clause."""
        return _SENTENCES.get(self, self.value.replace("_", " "))


STATUSES = tuple(SweepStatus)
"""All of them, in the order of their codes."""

_SENTENCES = {
    SweepStatus.COMPLETE: "this scene has no such mode",
    SweepStatus.NOTHING_TOUCHES: "nothing touches: no load presses a ball",
    SweepStatus.FREE_DIRECTION: "the ring can move without resistance in some direction",
    SweepStatus.LOAD_NOT_CARRIED: (
        "no contact can carry this load: another bearing, held tilts or more axial load are missing"
    ),
    SweepStatus.STATIC_STATE_NOT_CONVERGED: "no static state was found",
    SweepStatus.SCENE_REFUSED: "such a scene is not possible",
    SweepStatus.COMPUTATION_REFUSED: (
        "this cannot be computed here: the shaft must turn, mass, stiffness and damping be known "
        "in each direction that moves, for life and pressure the groove radii, for life a rating, "
        "which hybrid and self-aligning bearings have from the catalogue, and balls be massless "
        "for orbits"
    ),
    SweepStatus.NO_STATIC_START: "there is no static state to start from",
    SweepStatus.MOTION_DIVERGED: "the motion does not stay finite",
    SweepStatus.ORBIT_NOT_CONVERGED: "no orbit was found",
    SweepStatus.NO_COMMON_PERIOD: "the motion never repeats",
    SweepStatus.ARITHMETIC_FAILED: "the numbers are too extreme",
    SweepStatus.TOO_MANY_STEPS: "the motion takes too many steps",
    SweepStatus.TOO_MANY_CONTACTS: "there are too many contacts to solve",
    SweepStatus.BEYOND_GEOMETRY: "no equilibrium that the geometry of the contacts allows",
}

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
