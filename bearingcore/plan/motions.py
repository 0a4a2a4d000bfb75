"""Plans of motions: the longest step that will do, or the periodic orbit where it is proven."""

from __future__ import annotations

import itertools
import math
import time
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.numbers import number, thousands
from bearingcore.dynamics.ball_motion import ball_step_rate
from bearingcore.dynamics.modes import highest_natural_frequency, modes
from bearingcore.dynamics.motion import MOST_STEPS, TOO_MANY_STEPS, default_step_rate
from bearingcore.dynamics.orbit import NO_PERIOD, Orbit, common_ball_passes, orbit
from bearingcore.plan.balls import plan_with_mass
from bearingcore.plan.pilot import (
    PILOT,
    SAFETY,
    Pilot,
    Way,
    force_jumps,
    seconds_a_call,
    simulate_as,
    spectra_apart,
)
from bearingcore.plan.plans import (
    FULL_RATE,
    SETTLED,
    Offer,
    Plan,
    fewer_directions,
)
from bearingcore.scene import packing
from bearingcore.scene.scene import WITH_MASS, Scene

Array = NDArray[np.float64]


class Asked(NamedTuple):
    """What a motion is planned for; see `plan`."""

    scene: Scene
    view: str
    budget: float
    duration: float
    sample_rate: float
    step_rate: float | None
    march: bool
    most_steps: int


def plan_motion(asked: Asked, began: float) -> Plan:
    scene, view, budget, duration, sample_rate, step_rate, march, most_steps = asked
    packing.body_numbers(scene, scene.active_dofs)  # refuses a support that lacks a number
    highest = highest_natural_frequency(scene)
    rate = step_rate or default_step_rate(scene, sample_rate, highest)
    if scene.balls == WITH_MASS and step_rate is None:
        rate = max(rate, ball_step_rate(scene, sample_rate))
    # what `simulate` refuses it refuses itself
    if sample_rate >= 2.0 * highest and PILOT * rate > most_steps:
        return _not_begun(asked, rate, began)
    if scene.balls == WITH_MASS:
        return plan_with_mass(scene, view, budget, began, duration, sample_rate, step_rate)
    pilot = Pilot(scene, budget, sample_rate)
    fixed = way = pilot.fixed(step_rate)
    # where the force jumps, fixed steps have order 1; where it does not, nothing beats them
    if step_rate is None and force_jumps(scene):
        way = _better(fixed, pilot.adaptive(), budget)
    found, note, drop, arrival = None, "", 0.0, math.nan
    if view == SETTLED:
        drop = settling_time(scene)
        if not march:
            # where no march that was tried is good enough an orbit may take its time
            limit = way.work * (drop + duration) if way.error <= budget else ORBIT_PATIENCE
            found, orbital, note = _stable_orbit(scene, pilot, step_rate, limit, most_steps)
            arrival = (
                math.nan if found is None else arrival_time(found, way, sample_rate, most_steps)
            )
            if found is not None and math.isnan(arrival):
                found, note = (
                    None,
                    f"{NO_STABLE_ORBIT} that the motion from rest is seen to come to",
                )
            if found is None and note.startswith(NO_STABLE_ORBIT):
                way = _as_long_as_asked(scene, pilot, way, drop, duration)
    length = drop + duration
    seconds, calls = way.cost * length, way.calls * length
    if found is not None and orbital is not None:
        way, seconds, calls = orbital, orbital.cost, orbital.calls
        drop = arrival
        length = drop + duration
    planned = time.perf_counter()
    full_calls = 4.0 * FULL_RATE * length
    full = pilot.fixed(FULL_RATE) if 2.5 * pilot.highest <= FULL_RATE else fixed
    return Plan(
        scene=scene,
        view=view,
        error_budget=budget,
        dofs=scene.active_dofs,
        cage_angles=None,
        step_rate=way.step_rate,
        tolerance=way.tolerance,
        duration=length,
        drop=drop,
        sample_rate=sample_rate,
        orbit=found,
        predicted_error=way.error,
        met=way.error <= budget,
        evaluations=round(calls),
        seconds=seconds,
        full_evaluations=round(full_calls),
        full_seconds=full_calls
        * seconds_a_call("fixed", scene.bearing.n_balls, 5, scene.contact_law),
        full_error=full.error,
        planning_seconds=planned - began,
        offers=_motion_offers(scene, pilot, seconds),
        note=note,
    )


def _not_begun(asked: Asked, rate: float, began: float) -> Plan:
    """What a plan says that would have taken too many steps to make."""
    scene, n_dofs = asked.scene, len(asked.scene.active_dofs)
    a_call = seconds_a_call("fixed", scene.bearing.n_balls, n_dofs, scene.contact_law)
    calls = 4.0 * rate * asked.duration
    return Plan(
        scene=scene,
        view=asked.view,
        error_budget=asked.budget,
        dofs=scene.active_dofs,
        cage_angles=None,
        step_rate=rate,
        tolerance=math.nan,
        duration=asked.duration,
        drop=0.0,
        sample_rate=asked.sample_rate,
        orbit=None,
        predicted_error=math.inf,
        met=False,
        evaluations=round(calls),
        seconds=calls * a_call,
        full_evaluations=round(calls),
        full_seconds=calls * a_call,
        full_error=math.inf,
        planning_seconds=time.perf_counter() - began,
        note=(
            f"{TOO_MANY_STEPS} to plan it: {thousands(PILOT * rate)} for {number(PILOT)} s of "
            f"motion, allowed are most_steps = {thousands(asked.most_steps)}"
        ),
    )


def _better(one: Way, other: Way, budget: float) -> Way:
    """The cheaper of two within the budget, else the more exact."""
    if one.error <= budget and other.error <= budget:
        return min(one, other, key=lambda way: way.work)
    return min(one, other, key=lambda way: way.error)


NO_STABLE_ORBIT = "marched, as there is no stable orbit"


def arrival_time(orbit: Orbit, way: Way, sample_rate: float, most_steps: int = MOST_STEPS) -> float:
    """Time [s] after which the motion from rest is that of a stable orbit; NaN where it never is.

    NaN also where it takes more than `most_steps` to see.

    Close to the orbit disturbances die in `dying_time`, but the way there may be longer, and a
    machine may have several steady motions: which one it goes to depends on where it begins.
    """
    kind, setting = way.simulated_as
    dying = dying_time(orbit)
    for times in APPROACHES:
        since = times * max(dying, LEAST_APPROACH)
        if (since + orbit.period) * max(sample_rate, np.nan_to_num(way.step_rate)) > most_steps:
            break
        with np.errstate(all="ignore"):
            motion = simulate_as(kind, orbit.scene, since + orbit.period, sample_rate, setting)
            marched = motion.outer_acceleration
            first = round(since * sample_rate)
            steady = orbit.outer_acceleration(np.arange(first, len(marched)) / sample_rate)
            away = np.sqrt(np.mean((marched[first:] - steady) ** 2, axis=0))
        size = np.sqrt(np.mean(steady**2, axis=0))
        counts = size > 1e-6 * size.max()
        if np.all(away[counts] <= ARRIVED * size[counts]):
            part = float(np.max(away[counts] / size[counts], initial=DEAD))
            return since + dying * math.log(part / DEAD) / math.log(1.0 / DEAD)
    return math.nan


DEAD = 1e-3
"""Part of a disturbance that is left when it counts as having died."""

LEAST_APPROACH = 0.05
"""[s] that the motion from rest is given at least to come to an orbit."""

APPROACHES = (1, 2, 4, 8)
"""How many times as long as disturbances take to die the motion is given to come near."""

ARRIVED = 0.1
"""Part of the orbit's acceleration by which a motion that is near to it may differ."""


def _as_long_as_asked(scene: Scene, pilot: Pilot, way: Way, drop: float, duration: float) -> Way:
    """A way with its error over all of what is shown, not over the pilot.

    Where nothing settles to an orbit, errors may grow for as long as the motion goes on.
    """
    kind, coarse = way.simulated_as
    fine = 1e-2 * coarse if kind == "adaptive" else 2.0 * coarse
    first = round(drop * pilot.sample_rate)
    with np.errstate(all="ignore"):
        found, truth = (
            simulate_as(kind, scene, drop + duration, pilot.sample_rate, setting).outer_acceleration
            for setting in (coarse, fine)
        )
    apart = spectra_apart(found[first:], truth[first:], pilot.sample_rate, pilot.band)
    return way._replace(error=max(way.error, SAFETY * apart))


def _stable_orbit(
    scene: Scene, pilot: Pilot, asked: float | None, limit: float, most_steps: int
) -> tuple[Orbit | None, Way | None, str]:
    """The orbit where it is proven stable and within the budget, its way, or why there is none.

    Its spectrum is held against that of the same orbit in half the steps. None either where a march
    takes no more work than `limit`. The search ends there, so that no scene costs more to plan than
    that.
    """
    passes = common_ball_passes(scene)
    if passes is None:
        return None, None, f"{NO_STABLE_ORBIT}: {NO_PERIOD}"
    period = passes * scene.bearing.ball_spacing / scene.cage_speed
    tangent = TANGENT_WORK[len(scene.active_dofs)]
    rate = asked or default_step_rate(scene, pilot.sample_rate, pilot.highest)
    time_ = np.arange(round(PILOT * pilot.sample_rate)) / pilot.sample_rate

    def searched(start: Orbit | None, step_rate: float) -> tuple[Orbit, float, float]:
        """The orbit, the work and the time [s] it took; given up when it is more than the limit."""
        began = time.thread_time()
        of_a_period = tangent * 4.0 * math.ceil(period * step_rate)
        periods = itertools.count(1)
        found = orbit(
            scene,
            start=start,
            step_rate=step_rate,
            most_steps=most_steps,
            give_up=lambda: next(periods) * of_a_period > limit,
        )
        return found, tangent * found.right_hand_side_calls, time.thread_time() - began

    found, work, seconds = searched(None, rate)
    for _ in range(1 if asked else ORBIT_DOUBLINGS):
        if work > limit:
            return None, None, "marched, as an orbit takes longer"
        if found.status == TOO_MANY_STEPS:
            return None, None, "marched, as an orbit takes too many steps"
        if not found.stable:
            through = f", through {found.through}" if found.through else ""
            return None, None, f"{NO_STABLE_ORBIT}: {found.status}{through}"
        finer, more, longer = searched(found, 2.0 * rate)
        apart = math.inf
        if finer.stable:
            coarse, fine = found.outer_acceleration(time_), finer.outer_acceleration(time_)
            # half the steps leave half the error where the force jumps, else a sixteenth at best
            safety = 2.0 * ORBIT_SAFETY if force_jumps(scene) else ORBIT_SAFETY
            apart = safety * spectra_apart(coarse, fine, pilot.sample_rate, pilot.band)
        if apart <= pilot.budget or asked:
            way = Way(rate, math.nan, apart, found.right_hand_side_calls, seconds, work)
            return found, way, ""
        found, rate, work, seconds = finer, 2.0 * rate, work + more, seconds + longer
    return None, None, "marched, as the steps of an orbit would have to be very short"


TANGENT_WORK = {1: 4.0, 2: 5.0, 3: 5.0, 4: 6.0, 5: 7.0}
"""Calls of a march that take as long as one with the tangent beside it, by directions."""

ORBIT_SAFETY = 2.0
"""The same for orbits: what is compared is all there is."""

ORBIT_PATIENCE = 4e6
"""Work that is spent on an orbit where marching is no alternative: about a second."""

ORBIT_DOUBLINGS = 3
"""How often the steps of an orbit are halved before it is given up for a march."""


def dying_time(found: Orbit) -> float:
    """Time [s] in which a disturbance of a stable orbit dies down to a thousandth."""
    largest = min(max(found.largest_multiplier, 1e-6), 1.0 - 1e-6)
    return found.period * math.ceil(math.log(DEAD) / math.log(largest))


def settling_time(scene: Scene) -> float:
    """Time [s] in which the slowest mode at the static states dies down to a thousandth.

    A quarter of a second where nothing damps or no state is known, and never more than two.
    """
    found = modes(scene)
    rate = 2.0 * math.pi * found.frequency * found.damping_ratio
    known = rate[np.isfinite(rate)]
    if not known.size or known.min() <= 0.0:
        return 0.25
    return min(max(math.log(1.0 / DEAD) / float(known.min()), 0.05), 2.0)


def _motion_offers(scene: Scene, pilot: Pilot, seconds: float) -> tuple[Offer, ...]:
    """What the pilot motion is off by in fewer directions, at the program's own steps."""
    fewer = fewer_directions(scene.active_dofs)
    if not fewer:
        return ()
    offers = []
    rate = default_step_rate(scene, pilot.sample_rate, pilot.highest)
    truth, _ = pilot.signal("fixed", rate)
    for dofs in fewer:
        smaller = Pilot(scene.replace(dofs=dofs), pilot.budget, pilot.sample_rate)
        found, _ = smaller.signal("fixed", rate)
        if np.all(np.isfinite(found)):
            error = spectra_apart(found[:, :2], truth[:, :2], pilot.sample_rate, pilot.band)
            offers.append(
                Offer(dofs, error, seconds * smaller.a_call("fixed") / pilot.a_call("fixed"))
            )
    return tuple(offers)
