"""What a motion costs, and how much of it is marched while a slider moves or at all."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bearing_explorer.results.single_flight import SingleFlightCache
from bearing_explorer.state.settings import Marching
from bearingcore.common.numbers import thousands
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import default_step_rate
from bearingcore.scene.packing import is_planar
from bearingcore.scene.scene import MASSLESS, WITH_MASS

if TYPE_CHECKING:
    from bearingcore import Scene

MOST_STEPS = 400_000
"""Steps of a motion on the page: where a defect is passed so fast that it takes more, the motion is
shorter, or somebody's drag would fill the memory of everybody's server."""
MOST_STEPS_WITH_MASS = 1_600_000
"""The same of balls with mass, of which samples are kept and not steps: about a second."""
SHORTEST = 0.1
"""[s] Shorter motions say nothing at the resolution of the spectra."""

GLANCE, PASSES_OF_GLANCE, DROP_OF_GLANCE = 0.05, 2.36, 0.3
"""[s] The shortest motion of balls with mass while a slider moves, and in ball passes, and the part
of it that counts as its start and is not shown. What is shown is as long as one stretch of a
spectrum takes, 31 ms, and a ball's way through the defect can begin anywhere in its first pass and
ends within six tenths of the next."""

GENERAL_COST = 4.0
"""What a contact costs where it is not that of a flat bearing, over what it costs there."""
MASS_COST = 2.5
"""What a ball costs that has mass, and so two contacts and a motion of its own."""
MOST_IN_FULL = 2.0e5
"""Contacts, a step each, of a flat bearing that are marched in full while a slider moves: about
3 ms. A frame of a drag has 30 ms, in which the browser has its work too."""
MOST_TOUCHED = 2.0e6
"""The same of what is shortened until it can follow a slider: about 40 ms."""
MOST_COMPARED = 6.0e7
"""The same of balls with mass when the hand rests, to be compared with massless ones: a second."""


def _step_rate(scene: Scene, sample_rate: float) -> float | None:
    highest = highest_natural_frequency(scene)
    if scene.shaft_speed == 0.0 or not math.isfinite(highest):
        return None
    return default_step_rate(scene, sample_rate, highest)


step_rates = SingleFlightCache(_step_rate, 512)
"""Steps a second [Hz] of a scene's motion at a sample rate [Hz]; None where nothing moves."""


def affordable(scene: Scene, duration: float, rate: float, by_hand: bool) -> float:
    """`duration` [s], or as much of it as the steps that are allowed make."""
    with_mass = scene.balls == WITH_MASS
    most = MOST_STEPS_WITH_MASS if with_mass else MOST_STEPS
    if duration * rate <= most:
        return duration
    if SHORTEST * rate > most:
        why = "the defect is passed so fast that"
        if with_mass:
            why = "balls swing so fast between their races that"
        raise ValueError(
            f"{'set by hand,' if by_hand else why} a motion takes {thousands(rate)} steps a "
            f"second; allowed here: {thousands(most / SHORTEST)}"
        )
    return most / rate


def is_costly(scene: Scene, sample_rate: float, duration: float) -> bool:
    """Whether a motion takes too long to be marched in full while a slider moves."""
    try:
        rate = step_rates(scene, sample_rate) or 0.0
    except ValueError:
        return False  # there is no motion
    return duration * rate * _step_cost(scene) > MOST_IN_FULL


def _step_cost(scene: Scene) -> float:
    """What a step costs in steps of a contact of a flat bearing whose balls have no mass."""
    cost = scene.bearing.total_balls * (1.0 if is_planar(scene) else GENERAL_COST)
    return cost * (MASS_COST if scene.balls == WITH_MASS else 1.0)


def quick_duration(scene: Scene, how: Marching, at_rest: float = math.inf) -> float:
    """Duration [s] of a coarse motion: balls with mass cannot take fewer steps, but less time.

    `at_rest`: what may be touched of one that is not coarse.
    """
    most = MOST_TOUCHED if how.coarse else at_rest
    if scene.balls == MASSLESS or math.isinf(most):
        return how.duration
    try:
        rate = how.step_rate or step_rates(scene, how.sample_rate) or 0.0
    except ValueError:
        return how.duration  # there is no motion
    if rate == 0.0:
        return how.duration
    shortest = SHORTEST
    if how.coarse and scene.cage_speed > 0.0:
        glance = PASSES_OF_GLANCE * scene.bearing.ball_spacing / scene.cage_speed
        shortest = min(max(glance, GLANCE), SHORTEST)
    return min(how.duration, max(most / (rate * _step_cost(scene)), shortest))
