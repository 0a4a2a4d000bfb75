"""The core's answers, kept by scene and shared by all sessions.

Thirty people who look at one scene cost as much as one; what waits for an answer that somebody else
is computing waits for that one instead of computing it again.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import bearingcore as core
from bearing_explorer.results import compiling
from bearing_explorer.results.ball_mass import BallMass, ball_mass
from bearing_explorer.results.endurance import Asked, film_of
from bearing_explorer.results.excerpt import Excerpt, excerpt
from bearing_explorer.results.motion_cost import (
    DROP_OF_GLANCE,
    MOST_COMPARED,
    MOST_STEPS_WITH_MASS,
    SHORTEST,
    affordable,
    quick_duration,
    step_rates,
)
from bearing_explorer.results.planning import plan_for
from bearing_explorer.results.single_flight import SingleFlightCache
from bearing_explorer.state.settings import Marching, MotionPlanning
from bearingcore.dynamics.adaptive import simulate_adaptive
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import default_step_rate
from bearingcore.dynamics.repeated import repeated
from bearingcore.plan import SETTLED
from bearingcore.plan.balls import compare_balls
from bearingcore.scene.scene import MASSLESS, WITH_MASS
from bearingcore.statics.validity import looked_at

if TYPE_CHECKING:
    from bearingcore import Equilibrium, Limit, Maps, Modes, Motion, Orbit, Scene, Spectrum
    from bearingcore.plan import Plan

FEW_PERIODS = 30
"""Periods that are integrated at most to find an orbit while a slider moves; most take 5 to 12."""

COARSE_STEPS = 0.55
"""Part of the usual steps that is taken while a slider moves, where all of them take too long.
Against short steps over the same stretch of time, spectra of fan-rig, liew-lim, 6205 and 6206 are
then off by 0.28, 0.12, 0.00 and 0.20 dB; with 0.45 that of the 6206 was by 0.8 dB. Where
samples fall makes up to 0.8 dB of the 6205's, 35 dB below its loudest line: acceleration jumps as
balls touch, which 65,536 samples a second fold back (four times as many: 0.001 dB)."""


def _over_period(scene: Scene, first: float, last: float, n_cage_angles: int) -> Equilibrium:
    return core.static_state(scene, np.linspace(first, last, n_cage_angles))


def _over_nodes(scene: Scene, nodes: bytes) -> Equilibrium:
    return core.static_state(scene, np.frombuffer(nodes))


def _at(scene: Scene, cage_angle: float) -> Equilibrium:
    return core.static_state(scene, np.array([cage_angle]))


def _modes(scene: Scene, first: float, last: float, n_cage_angles: int) -> Modes:
    return core.modes(scene, np.linspace(first, last, n_cage_angles))


def _modes_over_nodes(scene: Scene, nodes: bytes) -> Modes:
    return core.modes(scene, np.frombuffer(nodes))


def _bands(
    scene: Scene, first: float, last: float, n_cage_angles: int
) -> dict[str, tuple[float, float]]:
    return core.frequency_bands(scene, np.linspace(first, last, n_cage_angles))


def _maps(scene: Scene, reach: float, m: int, first: float, last: float, n: int) -> Maps:
    return core.stiffness_maps(scene, np.linspace(0.0, reach, m), np.linspace(first, last, n))


class Moved(NamedTuple):
    """A motion, and since when [s] it counts as settled."""

    motion: Motion
    since: float


How = Marching | MotionPlanning
"""How a motion comes about: marched from rest, or as a plan has it."""


def _motion(scene: Scene, how: How) -> Moved:
    if scene.balls == WITH_MASS and not compiling.ready():
        raise compiling.StillCompiling  # here it would hold up every page
    return _marched(scene, how) if isinstance(how, Marching) else _planned(scene, how)


def _marched(scene: Scene, how: Marching) -> Moved:
    by_hand = how.step_rate
    rate = step_rates(scene, how.sample_rate) if by_hand is None else by_hand
    if by_hand is None and how.coarse:
        rate = _coarse_step_rate(scene, how.sample_rate)
    duration = quick_duration(scene, how)
    if rate is not None:
        duration = affordable(scene, duration, rate, by_hand is not None)
    motion = core.simulate(
        scene, duration, how.sample_rate, step_rate=rate, most_steps=MOST_STEPS_WITH_MASS
    )
    glance = how.coarse and duration < SHORTEST
    return Moved(motion, (DROP_OF_GLANCE if glance else 0.5) * duration)


def _coarse_step_rate(scene: Scene, sample_rate: float) -> float:
    return default_step_rate(scene, sample_rate, COARSE_STEPS * highest_natural_frequency(scene))


def find_orbit(scene: Scene, how: Marching, give_up: Callable[[], bool] | None = None) -> Orbit:
    """The orbit, looked for with steps as those of the motion; `give_up` may end the search."""
    rate = _coarse_step_rate(scene, how.sample_rate) if how.coarse else None
    return core.orbit(scene, step_rate=rate, give_up=give_up)


def _quick_orbit(scene: Scene, how: Marching) -> Orbit:
    """What a search of FEW_PERIODS finds."""
    periods = itertools.count(1)
    return find_orbit(scene, how, lambda: next(periods) >= FEW_PERIODS)


def _planned(scene: Scene, how: MotionPlanning) -> Moved:
    """The motion that a plan chose, settled for as long as the second half of a marched one.

    What is looked at begins a whole number of ball passes before or after where it begins in the
    motion that was marched while the hand moved: lines of a spectrum beat with each other, and
    seen at another beat the drawing would change though the motion is the same.
    """
    plan = motion_plans(scene, SETTLED, how)
    scene = scene.replace(balls=plan.scene.balls)  # which may have been the plan's to choose
    record = 0.5 * how.duration
    drop = 0.0 if plan.orbit is not None else plan.drop
    a_pass = scene.bearing.ball_spacing / scene.cage_speed
    if a_pass <= record:
        since = record + math.ceil((drop - record) / a_pass - 1e-9) * a_pass
    else:
        since = max(drop, record)
    rate = how.sample_rate if math.isnan(plan.step_rate) else plan.step_rate
    duration = affordable(scene, since + record, rate, how.step_rate is not None)
    since = min(since, 0.5 * duration) if duration < since + record else since
    if plan.orbit is not None:
        return Moved(repeated(plan.orbit, duration, how.sample_rate), since)
    if plan.method == "adaptive steps":
        motion = simulate_adaptive(scene, duration, how.sample_rate, tolerance=plan.tolerance)
        return Moved(motion, since)
    motion = core.simulate(
        scene, duration, how.sample_rate, step_rate=rate, most_steps=MOST_STEPS_WITH_MASS
    )
    return Moved(motion, since)


def _excerpt(scene: Scene, how: How) -> Excerpt:
    return excerpt(scene, *motions(scene, how))


def _spectra(scene: Scene, how: How) -> dict[str, Spectrum]:
    return _spectra_of(motions(scene, how).motion, 0)


def _late_spectra(scene: Scene, how: How) -> dict[str, Spectrum]:
    motion, since = motions(scene, how)
    first = math.ceil(since * motion.sample_rate - 1e-6)
    return _spectra_of(motion, first) if np.isfinite(motion.outer_acceleration).all() else {}


def _spectra_of(motion: Motion, first: int) -> dict[str, Spectrum]:
    frequency, density = core.spectrum(motion.outer_acceleration[first:], motion.sample_rate)
    return {dof: core.Spectrum(frequency, density[:, i]) for i, dof in enumerate(motion.dofs)}


def _ball_mass(scene: Scene, how: Marching) -> BallMass:
    heavy = scene.replace(balls=WITH_MASS)
    # both over the same time, or their spectra would differ by that
    alike = dataclasses.replace(how, duration=quick_duration(heavy, how, MOST_COMPARED))
    moved = motions(heavy, alike)
    massless = motions(scene.replace(balls=MASSLESS), alike)
    return ball_mass(massless.motion, moved.motion, moved.since)


def _dynamic_load(scene: Scene, how: How) -> float:
    """Greatest load of a ball [N] since the motion settled; NaN where it did not stay finite."""
    motion, since = motions(scene, how)
    if not motion.completed:
        return math.nan
    loads = motion.ball_loads(math.ceil(since * motion.sample_rate - 1e-6))
    return float(loads.max(initial=0.0))


def _limits(
    scene: Scene, step_rate: float | None, dynamic_load: float | None, asked: Asked
) -> tuple[Limit, ...]:
    state = core.equilibrium(scene, looked_at(scene))
    oil = None
    if asked.viscosity is not None and scene.bearing.knows_contacts:
        oil = film_of(scene, asked, state)
    return core.limits(scene, state, dynamic_load=dynamic_load, step_rate=step_rate, film=oil)


def _plan(scene: Scene, view: str, how: float | MotionPlanning) -> Plan:
    return plan_for(scene, view, how)


equilibria = SingleFlightCache(_over_period, 512)
planned_equilibria = SingleFlightCache(_over_nodes, 128)
single_equilibria = SingleFlightCache(_at, 2048)
modes = SingleFlightCache(_modes, 256)
planned_modes = SingleFlightCache(_modes_over_nodes, 64)
bands = SingleFlightCache(_bands, 256)
maps = SingleFlightCache(_maps, 16)  # about 2 MB each
motions = SingleFlightCache(_motion, 8)  # about 20 MB each
dynamic_loads = SingleFlightCache(_dynamic_load, 512)
limits_of = SingleFlightCache(_limits, 512)
excerpts = SingleFlightCache(_excerpt, 64)
spectra = SingleFlightCache(_spectra, 64)
late_spectra = SingleFlightCache(_late_spectra, 64)
ball_masses = SingleFlightCache(_ball_mass, 32)
ball_comparisons = SingleFlightCache(compare_balls, 128)
orbits = SingleFlightCache(find_orbit, 256)
quick_orbits = SingleFlightCache(_quick_orbit, 256)
plans = SingleFlightCache(_plan, 256)
motion_plans = SingleFlightCache(_plan, 24)  # with their orbits, some MB where those are long
