"""Stability of the periodic motion over the shaft speed."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearingcore.model.dynamics import orbit
from bearingcore.model.dynamics._orbit import LOSSES
from bearingcore.model.experiments._points import NOT_WATCHED, Watch
from bearingcore.model.scene import MASSLESS, Scene


@dataclass(frozen=True)
class OrbitAtSpeed:
    """The periodic motion at one shaft speed.

    Attributes
    ----------
    shaft_speed
        [rad/s]
    status
        outcome of the search by `dynamics.orbit`, or "refused: " and the reason.
    loss
        name of its loss of stability, one of LOSSES; empty for a stable orbit or none.
    multipliers
        Floquet multipliers (real, imaginary), the largest first.
    """

    shaft_speed: float
    status: str
    loss: str = ""
    multipliers: tuple[tuple[float, float], ...] = ()

    @property
    def size(self) -> float:
        """|μ| of the largest multiplier; NaN without an orbit."""
        return math.hypot(*self.multipliers[0]) if self.multipliers else math.nan


SPEEDS = tuple(2.0 ** (k / 8.0) for k in range(-8, 25))
"""Shaft speeds over that of the scene at which orbits are computed."""

MOST_ORBIT_STEPS = 200_000


def orbits_over_speed(scene: Scene, watch: Watch = NOT_WATCHED) -> tuple[OrbitAtSpeed, ...]:
    """Compute the stability of the periodic motion at half to eight times the scene's shaft speed.

    Balls are massless. The computation ends early if it is cancelled.
    """
    orbits = []
    for factor in watch.in_turn(SPEEDS, str):
        speed = factor * scene.shaft_speed
        try:
            answer = orbit(
                scene.replace(shaft_speed=speed, balls=MASSLESS), most_steps=MOST_ORBIT_STEPS
            )
        except ValueError as refused:
            orbits.append(OrbitAtSpeed(speed, f"refused: {refused}"))
            continue
        pairs = tuple((float(mu.real), float(mu.imag)) for mu in answer.multipliers)
        loss = LOSSES[answer.through] if answer.through else ""
        orbits.append(OrbitAtSpeed(speed, str(answer.status), loss, pairs))
    return tuple(orbits)
