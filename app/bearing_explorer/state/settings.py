"""How finely a session wants its results, and what of that is the program's own choice."""

from __future__ import annotations

from dataclasses import dataclass

from bearingcore.plan import BUDGETS, CURVES, SETTLED

STEADY = ("auto", "orbit", "march")
"""What the settled vibration is taken from: the program's choice, the periodic orbit, a march."""

COARSE = 0.5
"""Part of the duration that is marched while a slider moves, where all of it takes too long."""


@dataclass(frozen=True)
class Marching:
    """A motion marched from rest.

    `duration` [s], `sample_rate` [Hz], `step_rate` [Hz] where somebody set the steps by hand;
    `coarse` takes half as many steps, for while a slider moves.
    """

    duration: float
    sample_rate: float
    step_rate: float | None
    coarse: bool = False


@dataclass(frozen=True)
class MotionPlanning:
    """What a plan for a settled motion depends on, beside the scene.

    `budget` [dB], `duration` [s] of the motion that the plan replaces, of which the second half
    counts, `sample_rate` and `step_rate` [Hz], and `steady` out of STEADY. Balls have mass where
    the budget asks for it below `up_to` [Hz], or with None where the scene says so.
    """

    budget: float
    duration: float
    sample_rate: float
    step_rate: float | None
    steady: str
    up_to: float | None = None


@dataclass(frozen=True)
class Settings:
    """How finely a session wants its results.

    `n_cage_angles` to a ball spacing and across maps, `n_extents` of maps; `duration` [s] and
    `sample_rate` [Hz] of motions. What follows overrules the program where it is not None or
    "auto": `cage_angles` to a ball spacing, `step_rate` [Hz] of motions, `steady` out of STEADY,
    error budgets of curves (over their swing) and of spectra [dB], and the frequency [Hz] below
    which the second decides whether balls have mass, where else the scene does.
    """

    n_cage_angles: int = 121
    n_extents: int = 91
    duration: float = 1.4
    sample_rate: float = 65536.0
    cage_angles: int | None = None
    step_rate: float | None = None
    steady: str = "auto"
    curve_budget: float | None = None
    vibration_budget: float | None = None
    balls_up_to: float | None = None

    @property
    def marching(self) -> Marching:
        """How motions are marched."""
        return Marching(self.duration, self.sample_rate, self.step_rate)

    @property
    def coarse_marching(self) -> Marching:
        """How motions are marched while a slider moves, where the usual takes too long."""
        return Marching(COARSE * self.duration, self.sample_rate, self.step_rate, coarse=True)

    def planning(self, view: str) -> float | MotionPlanning:
        """What a plan for a view depends on: its budget, and for motions all that they do."""
        if view in CURVES:
            return self.curve_budget or BUDGETS[view]
        return MotionPlanning(
            self.vibration_budget or BUDGETS[SETTLED],
            self.duration,
            self.sample_rate,
            self.step_rate,
            self.steady,
            self.balls_up_to,
        )
