"""Simulated motions and results from them, shared by all sessions.

While the sliders rest, a motion is marched with steps that resolve the highest natural frequency
and every passage of a ball. While one moves, a motion that would take too long is shorter and
coarser.
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
"""Most steps of a motion on the page. A motion that would take more, for a defect that is passed
very fast, is shortened; otherwise one person's drag could fill the memory of the server."""
MOST_STEPS_WITH_MASS = 1_600_000
"""Most steps with mass of the balls, about a second. Only samples are kept, not steps."""
SHORTEST = 0.1
"""Shortest motion [s]: a shorter one shows nothing at the resolution of the spectra."""

COARSE_STEPS = 0.55
"""Share of the usual steps that are taken while a slider moves, if all of them take too long.
Compared with short steps over the same time, spectra of fan-rig, liew-lim, 6205 and 6206 are off by
0.28, 0.12, 0.00 and 0.20 dB; with a share of 0.45 the 6206 was off by 0.8 dB."""

PREVIEW_DURATION, PREVIEW_PASSES, PREVIEW_TRANSIENT_SHARE = 0.05, 2.36, 0.3
"""Shortest motion of balls with mass while a slider moves, in seconds and in ball passes, and its
first share, which is the start-up and is not shown. The shown part is as long as one segment of a
spectrum, 31 ms. A ball's way through the defect can begin anywhere in the first pass of that part,
and ends within six tenths of the next."""

GENERAL_COST = 4.0
"""Cost of a contact over that of a planar bearing, which moves along x and y only."""
MASS_COST = 2.5
"""Cost of a ball with mass over one without: it has two contacts and a motion of its own."""
MOST_IN_FULL = 2.0e5
"""Most contact steps (steps times contacts of a planar bearing) of a motion that is marched in full
while a slider moves: about 3 ms. A frame of a drag has 30 ms, shared with the browser."""
MOST_IN_DRAG = 2.0e6
"""Most contact steps of a motion that is shortened to follow a slider: about 40 ms."""
MOST_COMPARED = 6.0e7
"""Most contact steps of balls with mass once a slider rests, for comparison: a second."""


class SettledMotion(NamedTuple):
    """A motion, and the time [s] from which it counts as settled."""

    motion: Motion
    since: float


class Ending(NamedTuple):
    """Reason for an early end of a motion, or empty.

    `doubt`: uncertain bands in the spectrum of a completed motion, see `Motion.detail`.
    """

    fault: str
    doubt: str


# Cost of a motion


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


def _contact_steps(scene: Scene, how: Marching) -> float:
    """Contact steps in a second of motion; 0 if there is no motion."""
    try:
        rate = how.step_rate or step_rate_of(scene, how.sample_rate) or 0.0
    except ValueError:
        return 0.0  # there is no motion
    cost = scene.bearing.total_balls * (1.0 if is_planar(scene) else GENERAL_COST)
    return rate * cost * (MASS_COST if scene.balls == WITH_MASS else 1.0)


def is_costly(scene: Scene, how: Marching) -> bool:
    """True if a motion takes too long to be marched in full while a slider moves."""
    return how.duration * _contact_steps(scene, how) > MOST_IN_FULL


def quick_duration(scene: Scene, how: Marching, at_rest: float = math.inf) -> float:
    """Duration [s] of a motion: balls with mass need their short steps, so they get less time.

    `at_rest`: most contact steps of a motion that is not coarse.
    """
    most, steps = MOST_IN_DRAG if how.coarse else at_rest, _contact_steps(scene, how)
    if scene.balls == MASSLESS or not steps:
        return how.duration
    shortest = SHORTEST
    if how.coarse and scene.cage_speed > 0.0:
        preview = PREVIEW_PASSES * scene.bearing.ball_spacing / scene.cage_speed
        shortest = min(max(preview, PREVIEW_DURATION), SHORTEST)
    return min(how.duration, max(most / steps, shortest))


def _affordable(scene: Scene, duration: float, rate: float) -> float:
    """`duration` [s], shortened to the most steps that are allowed."""
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


# Motions and results from them


@cached
def motion(scene: Scene, how: Marching) -> SettledMotion:
    """The motion from rest; its second half counts as settled. ValueError if there is none."""
    compiling.need(compiling.MOTION, scene)
    rate = how.step_rate or step_rate_of(scene, how.sample_rate)
    if how.coarse:
        rate = default_step_rate(scene, how.sample_rate, COARSE_STEPS)
    duration = quick_duration(scene, how)
    if rate is not None:
        duration = _affordable(scene, duration, rate)
    # without a step rate `simulate` takes more steps where opening contacts need them
    chosen = rate if how.coarse else how.step_rate
    run = core.simulate(
        scene, duration, how.sample_rate, step_rate=chosen, most_steps=MOST_STEPS_WITH_MASS
    )
    preview = how.coarse and duration < SHORTEST
    return SettledMotion(run, (PREVIEW_TRANSIENT_SHARE if preview else 0.5) * duration)


@cached
def ending(scene: Scene, how: Marching) -> Ending:
    """Reason for an early end of the motion, or the uncertain bands of its spectrum."""
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

    Empty if it did not stay finite.
    """
    run, since = motion(scene, how)
    if not run.completed:
        return {}
    frequency, density = run.spectrum(since=since)
    return {dof: core.Spectrum(frequency, density[:, i]) for i, dof in enumerate(run.dofs)}


@cached
def dynamic_load(scene: Scene, how: Marching) -> float:
    """Greatest load of a ball [N] since the motion settled; NaN if it did not stay finite."""
    run, since = motion(scene, how)
    if not run.completed:
        return math.nan
    loads = run.ball_loads(math.ceil(since * run.sample_rate - 1e-6))
    return float(loads.max(initial=0.0))


def match_bandwidth(light: Scene, how: Marching) -> Marching:
    """Marching of massless balls, so that their spectrum reaches as high as that with mass."""
    if how.coarse:
        return how
    return dataclasses.replace(how, step_rate=fine_step_rate(light, how.sample_rate))


@cached
def ball_mass(scene: Scene, how: Marching) -> BallMass:
    """The motions without and with the balls' mass, compared over the same time."""
    heavy = scene.replace(balls=WITH_MASS)
    alike = dataclasses.replace(how, duration=quick_duration(heavy, how, MOST_COMPARED))
    with_mass = motion(heavy, alike)
    light = scene.replace(balls=MASSLESS)
    massless = motion(light, match_bandwidth(light, alike))
    return compare_motions(massless.motion, with_mass.motion, with_mass.since)
