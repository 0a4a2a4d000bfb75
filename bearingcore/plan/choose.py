"""The cheapest settings that keep a scene's picture inside an error budget.

Model no more than a scene needs: only directions that can move, cage angles at events and where a
curve bends, the longest step that will do, and instead of a transient the periodic orbit where it
is proven stable. A plan says what was chosen, the error to expect and what it costs.
"""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.dynamics.adaptive import simulate_adaptive
from bearingcore.dynamics.modes import contact_damping, highest_natural_frequency, modes
from bearingcore.dynamics.motion import Motion, default_step_rate, is_flat, simulate
from bearingcore.dynamics.orbit import NO_PERIOD, Orbit, common_ball_passes, orbit
from bearingcore.model.scene import DOF_NAMES, Scene, check_dofs
from bearingcore.signals.spectrum import spectrum
from bearingcore.statics.cage_angles import CURVES, curves_of, place, swings
from bearingcore.statics.equilibrium import Equilibrium, equilibrium

Array = NDArray[np.float64]

VIBRATION, SETTLED = "vibration", "settled vibration"
VIEWS = (*CURVES, VIBRATION, SETTLED)
"""What a plan can be for: curves over the cage angle (ball loads, stiffness, natural frequencies),
the housing's motion from rest with its spectrum, and the spectrum it settles to."""

BUDGETS = {"load": 5e-3, "stiffness": 5e-3, "modes": 5e-3, VIBRATION: 0.05, SETTLED: 0.1}
"""Error budgets that nobody sees on a screen: for curves the greatest error over the swing (see
`cage_angles`), for vibration the greatest error of the spectrum [dB]."""

FULL_ANGLES, FULL_RATE = 361, 65536.0
"""What a plan is compared with: all five directions, a degree apart, 65,536 steps a second."""

PILOT = 0.25
"""[s] of motion that are marched to see what a step costs in accuracy."""

SAFETY = 3.0
"""Predicted errors of motions: the pilot's times this, as it is shorter than what it speaks for."""

BAND = 1.25
"""Spectra count up to this times the highest natural frequency."""

COUNTS = 1e-4
"""Frequencies at which a direction is below this part of its greatest density do not count."""


@dataclass(frozen=True)
class Offer:
    """Fewer directions than a scene needs, with the error that they bring; never taken unasked."""

    dofs: tuple[str, ...]
    error: float
    """measured, in the unit of the budget"""
    seconds: float
    """predicted cost [s]"""


@dataclass(frozen=True)
class Plan:
    """How to compute one view of one scene.

    Attributes
    ----------
    scene
        with its directions as planned.
    view, error_budget
        what for, and how well: see VIEWS and BUDGETS.
    dofs
        directions that move.
    cage_angles : (n,) [rad] or None
        for curves.
    step_rate, tolerance
        for motions: steps a second [Hz] where they are fixed, or the tolerance of steps that
        choose themselves; the other one is NaN.
    duration, drop
        of motions: how long [s], and how much of it at the beginning is transient to be dropped.
    sample_rate
        [Hz] of motions.
    orbit
        the stable orbit that stands for a settled motion, already found; None for a march.
    predicted_error, met
        in the unit of the budget, and whether it is within it.
    evaluations, seconds
        predicted cost: evaluations of all contacts, and time [s] on this machine as measured.
    full_evaluations, full_seconds
        the same of the full model: all five directions where the support is known along them,
        FULL_ANGLES equally spaced angles or FULL_RATE steps a second, marched.
    full_error
        what the full model's equally spaced angles miss, or 65,536 steps a second.
    planning_seconds
        [s] it took to find this plan.
    offers
        fewer directions, with their errors.
    note
        why something was chosen against expectation; empty else.
    """

    scene: Scene
    view: str
    error_budget: float
    dofs: tuple[str, ...]
    cage_angles: Array | None = field(repr=False, compare=False)
    step_rate: float
    tolerance: float
    duration: float
    drop: float
    sample_rate: float
    orbit: Orbit | None = field(repr=False, compare=False)
    predicted_error: float
    met: bool
    evaluations: int
    seconds: float
    full_evaluations: int
    full_seconds: float
    full_error: float
    planning_seconds: float
    offers: tuple[Offer, ...] = ()
    note: str = ""

    @property
    def method(self) -> str:
        """One of "static", "orbit", "fixed steps" and "adaptive steps"."""
        if self.cage_angles is not None:
            return "static"
        if self.orbit is not None:
            return "orbit"
        return "fixed steps" if math.isnan(self.tolerance) else "adaptive steps"

    def run(self) -> Equilibrium | Motion | Orbit:
        """What was planned: static states, a motion, or the orbit."""
        if self.cage_angles is not None:
            return equilibrium(self.scene, self.cage_angles)
        if self.orbit is not None:
            return self.orbit
        if self.method == "adaptive steps":
            return simulate_adaptive(
                self.scene, self.duration, self.sample_rate, tolerance=self.tolerance
            )
        return simulate(self.scene, self.duration, self.sample_rate, step_rate=self.step_rate)

    def sentence(self) -> str:
        """In a line: what was chosen, its cost and error, and the full model's."""
        parts = [f"{len(self.dofs)} DOF"]
        if self.cage_angles is not None:
            parts.append(f"{len(self.cage_angles)} cage angles")
            error = f"error {_short(100.0 * self.predicted_error)} %"
            full = f"{FULL_ANGLES} equally spaced angles {_duration(self.full_seconds)}"
            full += f", error {_short(100.0 * self.full_error)} %"
        else:
            fixed = f"{self.step_rate / 1e3:.3g} kHz"
            adaptive = f"adaptive steps at {self.tolerance:.0e}"
            parts.append(adaptive if self.method == "adaptive steps" else fixed)
            if self.orbit is not None:
                passes = self.orbit.ball_passes
                parts.append(f"{passes} ball pass{'es' if passes > 1 else ''}")
            else:
                parts.append(f"{self.duration:.3g} s")
            error = f"error {_short(self.predicted_error)} dB"
            full = f"full model {_duration(self.full_seconds)}, error {_short(self.full_error)} dB"
        text = f"this scene: {', '.join(parts)}: {_duration(self.seconds)}, {error}; {full}"
        if not self.met:
            text += "; the budget is not met"
        return f"{text}; {self.note}" if self.note else text


def _duration(seconds: float) -> str:
    return f"{_short(1e3 * seconds)} ms" if seconds < 1.0 else f"{_short(seconds)} s"


def _short(value: float) -> str:
    """Two digits, and never a power of ten for what has more before the point: 120, 3.4, 0.0051."""
    return f"{value:.0f}" if value >= 99.5 else f"{value:.2g}"


def plan(
    scene: Scene,
    view: str,
    error_budget: float | None = None,
    *,
    duration: float = 1.4,
    sample_rate: float = 65536.0,
    dofs: Iterable[str] | None = None,
    step_rate: float | None = None,
    march: bool = False,
) -> Plan:
    """The cheapest way to compute a view of a scene within an error budget.

    Parameters
    ----------
    scene, view
        what to show of what: see VIEWS.
    error_budget
        None takes that of BUDGETS.
    duration, sample_rate
        [s], [Hz] of motions.
    dofs, step_rate, march
        overrule the plan: directions, steps a second [Hz], a march where an orbit would do. The
        predicted error is then that of what was asked for.

    Raises
    ------
    ValueError
        for unknown views, a budget that is not positive, or what `simulate` refuses.
    """
    checks.choice("view", view, VIEWS)
    budget = checks.number(
        "error_budget", BUDGETS[view] if error_budget is None else error_budget, above=0.0
    )
    began = time.perf_counter()
    if dofs is not None:
        scene = scene.replace(dofs=check_dofs(dofs))
    if view in CURVES:
        return _curves(scene, view, budget, began)
    return _motion(scene, view, budget, began, duration, sample_rate, step_rate, march)


# --- curves over the cage angle -------------------------------------------------------------------


def _curves(scene: Scene, view: str, budget: float, began: float) -> Plan:
    nodes = place(scene, view, budget)
    planned = time.perf_counter()
    state = equilibrium(scene, nodes.angles)
    seconds = time.perf_counter() - planned
    full = scene.replace(dofs=DOF_NAMES)
    equal = np.linspace(nodes.angles[0], nodes.angles[-1], FULL_ANGLES)
    start = time.perf_counter()
    everything = equilibrium(full, equal)
    full_seconds = time.perf_counter() - start
    return Plan(
        scene=scene,
        view=view,
        error_budget=budget,
        dofs=scene.active_dofs,
        cage_angles=nodes.angles,
        step_rate=math.nan,
        tolerance=math.nan,
        duration=math.nan,
        drop=0.0,
        sample_rate=math.nan,
        orbit=None,
        predicted_error=nodes.predicted_error,
        met=nodes.met,
        evaluations=int(state.evaluations.sum()),
        seconds=seconds,
        full_evaluations=int(everything.evaluations.sum()),
        full_seconds=full_seconds,
        full_error=_equal_error(scene, view, state, equal),
        planning_seconds=planned - began,
        offers=_static_offers(scene, view, seconds),
    )


def _equal_error(scene: Scene, view: str, state: Equilibrium, equal: Array) -> float:
    """What lines between equally spaced angles miss of the curves at the placed ones."""
    values = curves_of(state, view)
    coarse = curves_of(equilibrium(scene, equal), view)
    lines = np.stack(
        [np.interp(state.cage_angles, equal, coarse[:, i]) for i in range(values.shape[1])], axis=1
    )
    error = np.abs(lines - values) / swings(values)
    return float(error[np.isfinite(error)].max(initial=0.0))


def _static_offers(scene: Scene, view: str, seconds: float) -> tuple[Offer, ...]:
    angles = np.linspace(0.0, scene.bearing.ball_spacing, 13)
    truth = equilibrium(scene, angles)
    offers = []
    for fewer in _fewer(scene.active_dofs):
        state = equilibrium(scene, angles, fewer)
        both = truth.converged & state.converged
        if view == "modes" or not both.any():
            continue  # a mode less is not an error of a mode
        values = curves_of(truth, view)[both]
        error = np.abs(curves_of(state, view)[both] - values) / swings(values)
        offers.append(Offer(fewer, float(error.max()), seconds))
    return tuple(offers)


def _fewer(dofs: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Smaller sets of directions that keep x and y."""
    return [DOF_NAMES[:n] for n in (2, 3) if n < len(dofs) and set(DOF_NAMES[:n]) <= set(dofs)]


# --- motions -------------------------------------------------------------------------------------


class _Way(NamedTuple):
    """A way to march.

    Steps a second [Hz] for fixed ones, a tolerance for those that choose themselves, the other
    NaN; its predicted error [dB]; and for each second of motion (of an orbit: in all) calls, time,
    and the `work`: as many calls with fixed steps as take that long. Ways are chosen by their work,
    which does not hang on how busy the machine is.
    """

    step_rate: float
    tolerance: float
    error: float
    calls: float
    cost: float
    work: float

    @property
    def told_by(self) -> tuple[str, float]:
        """What `_told` calls it: its kind and setting."""
        if math.isnan(self.step_rate):
            return "adaptive", self.tolerance
        return "fixed", self.step_rate


def _motion(
    scene: Scene,
    view: str,
    budget: float,
    began: float,
    duration: float,
    sample_rate: float,
    step_rate: float | None,
    march: bool,
) -> Plan:
    pilot = _Pilot(scene, budget, sample_rate)
    fixed = way = pilot.fixed(step_rate)
    # where the force jumps, fixed steps have order 1; where it does not, nothing beats them
    if step_rate is None and _jumps(scene):
        way = _better(fixed, pilot.adaptive(), budget)
    found, note, drop, arrival = None, "", 0.0, math.nan
    if view == SETTLED:
        drop = settling_time(scene)
        if not march:
            # where no march that was tried is good enough an orbit may take its time
            limit = way.work * (drop + duration) if way.error <= budget else ORBIT_PATIENCE
            found, orbital, note = _stable_orbit(scene, pilot, step_rate, limit)
            arrival = math.nan if found is None else _arrival(found, way, sample_rate)
            if found is not None and math.isnan(arrival):
                found, note = None, f"{NO_STABLE_ORBIT} that the motion from rest comes to"
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
        * _seconds_a_call("fixed", scene.bearing.n_balls, 5, scene.contact_law),
        full_error=full.error,
        planning_seconds=planned - began,
        offers=_motion_offers(scene, pilot, seconds),
        note=note,
    )


def _jumps(scene: Scene) -> bool:
    """True where the force of a contact jumps and no change of variables takes the jump away."""
    return scene.contact_law != "published" and contact_damping(scene) > 0.0


def _better(one: _Way, other: _Way, budget: float) -> _Way:
    """The cheaper of two within the budget, else the more exact."""
    if one.error <= budget and other.error <= budget:
        return min(one, other, key=lambda way: way.work)
    return min(one, other, key=lambda way: way.error)


NO_STABLE_ORBIT = "marched, as there is no stable orbit"


def _arrival(orbit: Orbit, way: _Way, sample_rate: float) -> float:
    """Time [s] after which the motion from rest is that of a stable orbit; NaN where it never is.

    Close to the orbit disturbances die in `dying_time`, but the way there may be longer, and a
    machine may have several steady motions: which one it goes to hangs on where it begins.
    """
    kind, setting = way.told_by
    dying = dying_time(orbit)
    for times in APPROACHES:
        since = times * max(dying, LEAST_APPROACH)
        with np.errstate(all="ignore"):
            told = _told(kind, orbit.scene, since + orbit.period, sample_rate, setting)
            marched = told.outer_acceleration
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


def _as_long_as_asked(scene: Scene, pilot: _Pilot, way: _Way, drop: float, duration: float) -> _Way:
    """A way with its error over all of what is shown, not over the pilot.

    Where nothing settles to an orbit, errors may grow for as long as the motion goes on.
    """
    kind, coarse = way.told_by
    fine = 1e-2 * coarse if kind == "adaptive" else 2.0 * coarse
    first = round(drop * pilot.sample_rate)
    with np.errstate(all="ignore"):
        found, truth = (
            _told(kind, scene, drop + duration, pilot.sample_rate, setting).outer_acceleration
            for setting in (coarse, fine)
        )
    apart = spectra_apart(found[first:], truth[first:], pilot.sample_rate, pilot.band)
    return way._replace(error=max(way.error, SAFETY * apart))


def _stable_orbit(
    scene: Scene, pilot: _Pilot, asked: float | None, limit: float
) -> tuple[Orbit | None, _Way | None, str]:
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
            give_up=lambda: next(periods) * of_a_period > limit,
        )
        return found, tangent * found.right_hand_side_calls, time.thread_time() - began

    found, work, seconds = searched(None, rate)
    for _ in range(1 if asked else ORBIT_DOUBLINGS):
        if work > limit:
            return None, None, "marched, as an orbit takes longer"
        if not found.stable:
            through = f", through {found.through}" if found.through else ""
            return None, None, f"{NO_STABLE_ORBIT}: {found.status}{through}"
        finer, more, longer = searched(found, 2.0 * rate)
        apart = math.inf
        if finer.stable:
            coarse, fine = found.outer_acceleration(time_), finer.outer_acceleration(time_)
            # half the steps leave half the error where the force jumps, else a sixteenth at best
            safety = 2.0 * ORBIT_SAFETY if _jumps(scene) else ORBIT_SAFETY
            apart = safety * spectra_apart(coarse, fine, pilot.sample_rate, pilot.band)
        if apart <= pilot.budget or asked:
            way = _Way(rate, math.nan, apart, found.right_hand_side_calls, seconds, work)
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


def step_rates(sample_rate: float) -> list[float]:
    """Step rates [Hz] that fit a sample rate, rising."""
    return [sample_rate / k for k in (16, 12, 8, 6, 4, 3, 2)] + [
        sample_rate * k for k in (1, 2, 3, 4, 6, 8)
    ]


class _Pilot:
    """A short motion, marched in several ways to see what each is off by and costs."""

    def __init__(self, scene: Scene, budget: float, sample_rate: float) -> None:
        self.scene, self.budget, self.sample_rate = scene, budget, sample_rate
        self.highest = highest_natural_frequency(scene)
        self.band = BAND * self.highest
        self._known: dict[tuple[str, float], tuple[Array, int]] = {}

    def signal(self, kind: str, setting: float) -> tuple[Array, int]:
        """The housing's acceleration, NaN for a motion that diverged, and right-hand sides.

        `kind` is "fixed" (setting: steps a second [Hz]) or "adaptive" (tolerance).
        """
        if (kind, setting) not in self._known:
            with np.errstate(all="ignore"):
                told = _told(kind, self.scene, PILOT, self.sample_rate, setting)
                self._known[kind, setting] = told.outer_acceleration, told.right_hand_side_calls
        return self._known[kind, setting]

    def a_call(self, kind: str) -> float:
        """Time [s] of a right-hand side, with its share of everything else."""
        scene = self.scene
        n_dofs = len(scene.active_dofs)
        if n_dofs == 2 and not is_flat(scene):
            n_dofs = 3  # the kernel for any directions
        return _seconds_a_call(kind, scene.bearing.n_balls, n_dofs, scene.contact_law)

    @property
    def adaptive_work(self) -> float:
        """Calls with fixed steps that take as long as one where steps choose themselves."""
        return 6.0 if is_flat(self.scene) else 2.0

    def _way(self, kind: str, setting: float, finer: float) -> _Way:
        found, calls = self.signal(kind, setting)
        truth = self.signal(kind, finer)[0]
        # its second half as well: of one stretch alone two steps can agree by chance
        error = SAFETY * max(
            spectra_apart(found[since:], truth[since:], self.sample_rate, self.band)
            for since in (0, len(found) // 2)
        )
        rate, tolerance = (math.nan, setting) if kind == "adaptive" else (setting, math.nan)
        work = calls if kind == "fixed" else calls * self.adaptive_work
        return _Way(
            rate, tolerance, error, calls / PILOT, calls / PILOT * self.a_call(kind), work / PILOT
        )

    def _at(self, rate: float) -> _Way:
        """What a rate is off by shows beside twice the rate.

        There an error that falls with order 2 or more leaves a quarter at most; one of order 1 a
        half, which SAFETY allows for.
        """
        ratio = round(self.sample_rate / rate)
        fits = 2.0 * rate if ratio <= 1 or ratio % 2 == 0 else ratio * rate
        return self._way("fixed", rate, fits)

    def fixed(self, asked: float | None) -> _Way:
        """The longest fixed step within the budget, or the best of those tried."""
        if asked is not None:
            return self._at(asked)
        usual = default_step_rate(self.scene, self.sample_rate, self.highest)
        least = 2.5 * self.highest if math.isfinite(self.highest) else usual
        rates = [rate for rate in step_rates(self.sample_rate) if rate >= least] or [usual]
        # begin where the program would without a plan, go down while it holds or up until it does
        at = min(range(len(rates)), key=lambda i: abs(math.log(rates[i] / usual)))
        # an error that falls with order 1 would need steps without end
        top = min(at + 2, len(rates)) if _jumps(self.scene) else len(rates)
        found = self._at(rates[at])
        while found.error > self.budget and at + 1 < top:
            # errors fall with order 4 at best: nothing nearer can be enough
            least = rates[at] * self._over(found) ** 0.25
            at = next((i for i in range(at + 1, top) if rates[i] >= least), top - 1)
            found = self._at(rates[at])
        while found.error <= self.budget and at > 0:
            coarser = self._at(rates[at - 1])
            if coarser.error > self.budget:
                break
            at, found = at - 1, coarser
        return found

    def adaptive(self) -> _Way:
        """The loosest tolerance within the budget; a hundredth of it stands for the truth."""
        found = self._way("adaptive", TOLERANCES[0], 1e-2 * TOLERANCES[0])
        for tolerance in TOLERANCES[1:]:
            if found.error <= self.budget:
                break
            # errors fall as fast as the tolerance at best
            if (
                tolerance * self._over(found) <= 1.001 * found.tolerance
                or tolerance == TOLERANCES[-1]
            ):
                found = self._way("adaptive", tolerance, 1e-2 * tolerance)
        return found

    def _over(self, way: _Way) -> float:
        """How many times the budget a way errs by; 1 where that is not known."""
        return way.error / self.budget if math.isfinite(way.error) else 1.0


TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
"""What may be chosen where steps choose themselves."""


def spectra_apart(found: Array, expected: Array, sample_rate: float, band: float) -> float:
    """Greatest difference of spectra [dB] up to `band` [Hz], where they count.

    Infinite where a signal is not finite.
    """
    if not (np.all(np.isfinite(found)) and np.all(np.isfinite(expected))):
        return math.inf
    frequency, density = spectrum(expected, sample_rate)
    level = density.max(axis=0)
    counts = (density > COUNTS * level) & (level > 1e-12 * level.max())
    counts &= ((frequency > 2.5 * frequency[1]) & (frequency <= band))[:, None]
    if not counts.any():
        return 0.0
    with np.errstate(divide="ignore"):
        other = spectrum(found, sample_rate).density
        return float(np.abs(10.0 * np.log10(other[counts] / density[counts])).max())


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


def _motion_offers(scene: Scene, pilot: _Pilot, seconds: float) -> tuple[Offer, ...]:
    """What the pilot motion is off by in fewer directions, at the program's own steps."""
    fewer = _fewer(scene.active_dofs)
    if not fewer:
        return ()
    offers = []
    rate = default_step_rate(scene, pilot.sample_rate, pilot.highest)
    truth, _ = pilot.signal("fixed", rate)
    for dofs in fewer:
        smaller = _Pilot(scene.replace(dofs=dofs), pilot.budget, pilot.sample_rate)
        found, _ = smaller.signal("fixed", rate)
        if np.all(np.isfinite(found)):
            error = spectra_apart(found[:, :2], truth[:, :2], pilot.sample_rate, pilot.band)
            offers.append(
                Offer(dofs, error, seconds * smaller.a_call("fixed") / pilot.a_call("fixed"))
            )
    return tuple(offers)


@lru_cache(maxsize=256)
def _seconds_a_call(kind: str, n_balls: int, n_dofs: int, law: str) -> float:
    """Time [s] of one right-hand side on this machine, measured once on a scene of that size.

    `kind` is one of those of `_Pilot.signal`.
    """
    from bearingcore.model.presets import presets

    widest = 0.9 * 45e-3 * math.sin(math.pi / n_balls) if n_balls > 1 else 8e-3
    example = presets["fan-rig"].replace(
        n_balls=n_balls, ball_diameter=min(8e-3, widest), dofs=DOF_NAMES[:n_dofs],
        contact_damping=100.0, contact_law=law,
    )  # fmt: skip
    least = math.inf
    for _ in range(4):
        start = time.perf_counter()
        told = _told(kind, example, 0.03, FULL_RATE, FULL_RATE if kind != "adaptive" else 1e-6)
        _ = told.outer_acceleration
        taken = time.perf_counter() - start
        least = min(least, taken / max(told.right_hand_side_calls, 1))
    return least


def _told(kind: str, scene: Scene, duration: float, sample_rate: float, setting: float) -> Motion:
    """A motion by one of the ways that a pilot tries."""
    if kind == "fixed":
        return simulate(scene, duration, sample_rate, step_rate=setting)
    return simulate_adaptive(scene, duration, sample_rate, tolerance=setting)
