"""Simulated motions and what is made of them, shared by all sessions.

At rest a motion is marched with steps that resolve the highest natural frequency and every passage
of a ball. While a slider moves, a motion that takes too long for that is shorter and coarser.
"""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import bearingcore as core
from bearing_explorer.explorer.results.ball_mass import BallMass, compare_motions
from bearing_explorer.explorer.results.excerpt import Excerpt, excerpt_of
from bearing_explorer.explorer.state.settings import Marching
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import cached
from bearingcore import Motion, Scene, Spectrum
from bearingcore.common import thousands
from bearingcore.model.dynamics import default_step_rate, fine_step_rate, highest_natural_frequency
from bearingcore.model.scene import MASSLESS, WITH_MASS, is_planar

MOST_STEPS = 400_000
"""Steps of a motion on the page: where a defect is passed so fast that it takes more, the motion is
shorter, or one person's drag would fill the memory of the server."""
MOST_STEPS_WITH_MASS = 1_600_000
"""Most steps with mass of the balls, about a second: samples are kept instead of steps."""
SHORTEST = 0.1
"""Shortest motion [s]: a shorter one shows nothing at the resolution of the spectra."""

COARSE_STEPS = 0.55
"""Part of the usual steps that is taken while a slider moves, where all of them take too long.
Against short steps over the same stretch of time, spectra of fan-rig, liew-lim, 6205 and 6206 are
then off by 0.28, 0.12, 0.00 and 0.20 dB; with 0.45 that of the 6206 was by 0.8 dB."""

PREVIEW_DURATION, PREVIEW_PASSES, PREVIEW_TRANSIENT_SHARE = 0.05, 2.36, 0.3
"""Shortest motion of balls with mass while a slider moves, in seconds and in ball passes, and the
share of it that counts as its start and is not shown. The shown part is as long as one stretch of a
spectrum, 31 ms. A ball's way through the defect can begin anywhere in the first pass of that part,
and ends within six tenths of the next."""

GENERAL_COST = 4.0
"""Cost of a contact that is not that of a flat bearing, over the cost of one that is."""
MASS_COST = 2.5
"""Cost of a ball with mass over one without: it has two contacts and a motion of its own."""
MOST_IN_FULL = 2.0e5
"""Contacts, a step each, of a flat bearing that are marched in full while a slider moves: about
3 ms. A frame of a drag has 30 ms, in which the browser has its work too."""
MOST_TOUCHED = 2.0e6
"""Contacts, a step each, of a motion that is shortened to follow a slider: about 40 ms."""
MOST_COMPARED = 6.0e7
"""Contacts, a step each, of balls with mass once a slider rests, for comparison: a second."""


class SettledMotion(NamedTuple):
    """A motion, and since when [s] it counts as settled."""

    motion: Motion
    since: float


class Ending(NamedTuple):
    """Reason for an early end of a motion, or empty.

    `doubt`: how well bands of the spectrum of a completed motion are known, see `Motion.detail`.
    """

    fault: str
    doubt: str


# What a motion costs


@cached
def step_rate_of(scene: Scene, sample_rate: float) -> float | None:
    """Steps a second [Hz] of a scene's motion at a sample rate [Hz]; None where nothing moves.

    ValueError where the support is not known well enough.
    """
    compiling.need(compiling.STATICS)
    highest = highest_natural_frequency(scene)
    if scene.shaft_speed == 0.0 or not math.isfinite(highest):
        return None
    return default_step_rate(scene, sample_rate)


def _contacts(scene: Scene, how: Marching) -> float:
    """Contacts of a flat bearing that a second of motion would step; 0 where there is none."""
    try:
        rate = how.step_rate or step_rate_of(scene, how.sample_rate) or 0.0
    except ValueError:
        return 0.0  # there is no motion
    cost = scene.bearing.total_balls * (1.0 if is_planar(scene) else GENERAL_COST)
    return rate * cost * (MASS_COST if scene.balls == WITH_MASS else 1.0)


def is_costly(scene: Scene, how: Marching) -> bool:
    """True if a motion takes too long to be marched in full while a slider moves."""
    return how.duration * _contacts(scene, how) > MOST_IN_FULL


def quick_duration(scene: Scene, how: Marching, at_rest: float = math.inf) -> float:
    """Duration [s] of a coarse motion: balls with mass cannot take fewer steps, but less time.

    `at_rest`: what may be touched of one that is not coarse.
    """
    most, contacts = MOST_TOUCHED if how.coarse else at_rest, _contacts(scene, how)
    if scene.balls == MASSLESS or not contacts:
        return how.duration
    shortest = SHORTEST
    if how.coarse and scene.cage_speed > 0.0:
        preview = PREVIEW_PASSES * scene.bearing.ball_spacing / scene.cage_speed
        shortest = min(max(preview, PREVIEW_DURATION), SHORTEST)
    return min(how.duration, max(most / contacts, shortest))


def _affordable(scene: Scene, duration: float, rate: float) -> float:
    """`duration` [s], or as much of it as the steps that are allowed make."""
    with_mass = scene.balls == WITH_MASS
    most = MOST_STEPS_WITH_MASS if with_mass else MOST_STEPS
    if duration * rate <= most:
        return duration
    if SHORTEST * rate > most:
        why = "the defect is passed so fast that"
        if with_mass:
            why = "balls vibrate so fast between their races that"
        raise ValueError(
            f"{why} a motion takes {thousands(rate)} steps a second; allowed here: "
            f"{thousands(most / SHORTEST)}"
        )
    return most / rate


# Motions and what is made of them


@cached
def motion(scene: Scene, how: Marching) -> SettledMotion:
    """The motion from rest; its second half counts as settled. ValueError where there is none."""
    compiling.need(compiling.MOTION, scene)
    rate = how.step_rate or step_rate_of(scene, how.sample_rate)
    if how.coarse:
        rate = default_step_rate(scene, how.sample_rate, COARSE_STEPS)
    duration = quick_duration(scene, how)
    if rate is not None:
        duration = _affordable(scene, duration, rate)
    # the default takes more steps where contacts that let go need them
    chosen = rate if how.coarse else how.step_rate
    run = core.simulate(
        scene, duration, how.sample_rate, step_rate=chosen, most_steps=MOST_STEPS_WITH_MASS
    )
    preview = how.coarse and duration < SHORTEST
    return SettledMotion(run, (PREVIEW_TRANSIENT_SHARE if preview else 0.5) * duration)


@cached
def ending(scene: Scene, how: Marching) -> Ending:
    """The end of the motion."""
    run, _ = motion(scene, how)
    return Ending("", run.detail) if run.completed else Ending(run.reason, "")


@cached
def excerpt(scene: Scene, how: Marching) -> Excerpt:
    """Some ball passes of the settled motion."""
    compiling.need(compiling.MOTION, scene)
    return excerpt_of(scene, *motion(scene, how))


@cached
def late_spectra(scene: Scene, how: Marching) -> dict[str, Spectrum]:
    """Spectrum of the housing's acceleration along each direction, once the motion has settled.

    Empty where it did not stay finite.
    """
    run, since = motion(scene, how)
    if not run.completed:
        return {}
    frequency, density = run.spectrum(since=since)
    return {dof: core.Spectrum(frequency, density[:, i]) for i, dof in enumerate(run.dofs)}


@cached
def dynamic_load(scene: Scene, how: Marching) -> float:
    """Greatest load of a ball [N] since the motion settled; NaN where it did not stay finite."""
    run, since = motion(scene, how)
    if not run.completed:
        return math.nan
    loads = run.ball_loads(math.ceil(since * run.sample_rate - 1e-6))
    return float(loads.max(initial=0.0))


def limit_to_known(light: Scene, how: Marching) -> Marching:
    """Limit the march of massless balls to what is known of the march with mass."""
    if how.coarse:
        return how
    return dataclasses.replace(how, step_rate=fine_step_rate(light, how.sample_rate))


@cached
def ball_mass(scene: Scene, how: Marching) -> BallMass:
    """The motions without and with the balls' mass, compared over the same time."""
    heavy = scene.replace(balls=WITH_MASS)
    alike = dataclasses.replace(how, duration=quick_duration(heavy, how, MOST_COMPARED))
    moved = motion(heavy, alike)
    light = scene.replace(balls=MASSLESS)
    massless = motion(light, limit_to_known(light, alike))
    return compare_motions(massless.motion, moved.motion, moved.since)
