"""Results: what is known about one scene, computed when first asked for.

Everything that is drawn passes through here. The core's answers are shared by all sessions and
kept by scene, so that thirty people looking at one scene cost as much as one; what waits for an
answer somebody else is computing waits for that one instead of computing it again.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
import time
from collections.abc import Callable, Hashable
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bearingcore as core
from bearing_explorer.compute import compiling
from bearing_explorer.compute.ball_mass import BallMass, ball_mass
from bearing_explorer.compute.chain import Chain, chain
from bearing_explorer.compute.dof_comparison import (
    DofComparison,
    other_dofs,
    spectrum_differences,
    static_differences,
)
from bearing_explorer.compute.endurance import Asked, Endurance, endurance, film_of
from bearing_explorer.compute.excerpt import Excerpt, excerpt
from bearing_explorer.compute.executors import BESIDE
from bearing_explorer.compute.load_curve import Curve, load_curve
from bearing_explorer.compute.planning import plan_for
from bearing_explorer.compute.profile import Profile, profile
from bearing_explorer.compute.single_flight import SingleFlightCache
from bearing_explorer.state.quantities import defects_of
from bearing_explorer.state.reference import WITHOUT_DEFECT, Reference
from bearing_explorer.state.settings import Marching, MotionPlanning, Settings
from bearingcore.common.numbers import thousands
from bearingcore.dynamics.adaptive import simulate_adaptive
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.dynamics.motion import default_step_rate
from bearingcore.dynamics.orbit import NOT_CONVERGED, common_ball_passes
from bearingcore.dynamics.repeated import repeated
from bearingcore.model.defect import RACES
from bearingcore.model.packing import is_planar
from bearingcore.model.scene import MASSLESS, WITH_MASS
from bearingcore.plan import CURVES, SETTLED
from bearingcore.plan.balls import BallComparison, compare_balls
from bearingcore.statics.ball_positions import EquilibriumWithMass
from bearingcore.statics.equilibrium import default_cage_angles
from bearingcore.statics.passes import drops_now
from bearingcore.statics.validity import looked_at

if TYPE_CHECKING:
    from bearingcore import Equilibrium, Limit, Maps, Modes, Motion, Orbit, Scene, Spectrum
    from bearingcore.plan import Plan
Answer = TypeVar("Answer")

MAP_REACHES = tuple(math.radians(reach) for reach in (90.0, 120.0, 180.0, 360.0))
"""How far maps go in extent [rad]: the first that holds the extent shown. 90° as in the paper."""


LONGEST_ORBIT = 60
"""Ball passes of the longest orbit that is looked for while sliders move."""
HASTY_PERIODS = 30
"""Periods that are integrated at most to find it meanwhile; most orbits take 5 to 12."""


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


def _maps(scene: Scene, reach: float, m: int, first: float, last: float, n: int) -> Maps:
    return core.stiffness_maps(scene, np.linspace(0.0, reach, m), np.linspace(first, last, n))


MOST_STEPS = 400_000
"""Steps of a motion on the page: where a defect is passed so fast that it takes more, the motion is
shorter, or somebody's drag would fill the memory of everybody's server."""
MOST_STEPS_WITH_MASS = 1_600_000
"""The same of balls with mass, of which samples are kept and not steps: about a second."""
COARSE_STEPS = 0.45
"""Part of the usual steps that is taken while a slider moves, where all of them take too long."""
SHORTEST = 0.1
"""[s] Shorter motions say nothing at the resolution of the spectra."""


GLANCE, PASSES_OF_GLANCE, DROP_OF_GLANCE = 0.05, 2.36, 0.3
"""[s] The shortest motion of balls with mass while a slider moves, and in ball passes, and the part
of it that counts as its start and is not shown. What is shown is as long as one stretch of a
spectrum takes, 31 ms, and a ball's way through the defect can begin anywhere in its first pass and
ends within six tenths of the next."""


class Moved(NamedTuple):
    """A motion, and since when [s] it counts as settled."""

    motion: Motion
    since: float


How = Marching | MotionPlanning
"""How a motion comes about: marched from rest, or as a plan has it."""


STILL_COMPILING = (
    "balls with mass are still being compiled, once, which takes half a minute: then they are drawn"
)


def _motion(scene: Scene, how: How) -> Moved:
    if scene.balls == WITH_MASS and not compiling.ready():
        raise ValueError(STILL_COMPILING)  # here it would hold up every page
    return _marched(scene, how) if isinstance(how, Marching) else _planned(scene, how)


def _marched(scene: Scene, how: Marching) -> Moved:
    by_hand = how.step_rate
    rate = step_rates(scene, how.sample_rate) if by_hand is None else by_hand
    if by_hand is None and how.coarse:
        rate = _coarse_step_rate(scene, how.sample_rate)
    duration = quick_duration(scene, how)
    if rate is not None:
        duration = _affordable(scene, duration, rate, by_hand is not None)
    motion = core.simulate(
        scene, duration, how.sample_rate, step_rate=rate, most_steps=MOST_STEPS_WITH_MASS
    )
    glance = how.coarse and duration < SHORTEST
    return Moved(motion, (DROP_OF_GLANCE if glance else 0.5) * duration)


def _coarse_step_rate(scene: Scene, sample_rate: float) -> float:
    return default_step_rate(scene, sample_rate, COARSE_STEPS * highest_natural_frequency(scene))


def _orbit(scene: Scene, how: Marching, give_up: Callable[[], bool] | None = None) -> Orbit:
    rate = _coarse_step_rate(scene, how.sample_rate) if how.coarse else None
    return core.orbit(scene, step_rate=rate, give_up=give_up)


def _hasty_orbit(scene: Scene, how: Marching) -> Orbit:
    """What a search of HASTY_PERIODS finds."""
    periods = itertools.count(1)
    return _orbit(scene, how, lambda: next(periods) >= HASTY_PERIODS)


def _affordable(scene: Scene, duration: float, rate: float, by_hand: bool) -> float:
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
    duration = _affordable(scene, since + record, rate, how.step_rate is not None)
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


def is_dear(scene: Scene, sample_rate: float, duration: float) -> bool:
    """Whether a motion takes too long to be marched in full while a slider moves."""
    try:
        rate = step_rates(scene, sample_rate) or 0.0
    except ValueError:
        return False  # there is no motion
    return duration * rate * _step_cost(scene) > MOST_TOUCHED


def _step_cost(scene: Scene) -> float:
    """What a step costs in steps of a contact of a flat bearing whose balls have no mass."""
    cost = scene.bearing.total_balls * (1.0 if is_planar(scene) else GENERAL_COST)
    return cost * (MASS_COST if scene.balls == WITH_MASS else 1.0)


GENERAL_COST = 4.0
"""What a contact costs where it is not that of a flat bearing, over what it costs there."""
MASS_COST = 2.5
"""What a ball costs that has mass, and so two contacts and a motion of its own."""
MOST_TOUCHED = 2.0e6
"""Contacts, a step each, of a flat bearing that are marched while a slider moves: about 40 ms."""


MOST_COMPARED = 6.0e7
"""The same of balls with mass when the hand rests, to be compared with massless ones: a second."""


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


def _excerpt(scene: Scene, how: How) -> Excerpt:
    return excerpt(scene, *motions(scene, how))


def _step_rate(scene: Scene, sample_rate: float) -> float | None:
    highest = highest_natural_frequency(scene)
    if scene.shaft_speed == 0.0 or not math.isfinite(highest):
        return None
    return default_step_rate(scene, sample_rate, highest)


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
maps = SingleFlightCache(_maps, 16)  # about 2 MB each
motions = SingleFlightCache(_motion, 8)  # about 20 MB each
step_rates = SingleFlightCache(_step_rate, 512)
dynamic_loads = SingleFlightCache(_dynamic_load, 512)
limits_of = SingleFlightCache(_limits, 512)
excerpts = SingleFlightCache(_excerpt, 64)
spectra = SingleFlightCache(_spectra, 64)
late_spectra = SingleFlightCache(_late_spectra, 64)
ball_masses = SingleFlightCache(_ball_mass, 32)
ball_comparisons = SingleFlightCache(compare_balls, 128)
orbits = SingleFlightCache(_orbit, 256)
hasty_orbits = SingleFlightCache(_hasty_orbit, 256)
plans = SingleFlightCache(_plan, 256)
motion_plans = SingleFlightCache(_plan, 24)  # with their orbits, some MB where those are long


def _load_curves(found: Equilibrium) -> list[Curve]:
    return [load_curve(found, row) for row in range(len(found.scene.bearing.all_rows))]


class Results:
    """What the views read. Attributes are computed when first asked for, in any thread.

    scene: the Scene shown
    cage_angle: the cage angle shown [rad]
    focus: which of the scene's defects is looked at
    equilibrium, healthy_equilibrium: over the stretch of the curves, with the defect and without
    now, healthy_now: at `cage_angle` alone (arrays of length 1)
    modes, healthy_modes: over the same cage angles
    band_modes: the modes where only their bands count; at fewer cage angles while a hand moves
    extent: of the defect looked at [rad]
    healthy_all_around: like healthy_equilibrium, over all that a pinned scene does
    maps: over its extent and the same cage angles
    drop: how far each ball has sunk into each race at `cage_angle`
    profile: the race around the defect and a ball's path over it
    plan: what the scene's curves or motion are drawn by, where they are drawn by a plan
    motion, healthy_motion: simulated motion
    settled_since: [s] of the motion, when its start is forgotten
    excerpt: some ball passes of the settled motion
    spectra: {dof: Spectrum} of the housing's acceleration from rest on
    late_spectra, healthy_late_spectra: the same of the settled motion
    ball_mass: the motions without and with the balls' mass, compared
    ball_comparison: up to which frequency massless balls will do; None until it was looked for
    ball_passes: after how many of them the scene is as before; None where it never is
    orbit: the motion that repeats itself; None where it takes too many ball passes to look for
    orbit_spectra: {dof: Spectrum} of the housing's acceleration on it; empty without an orbit
    plans: {view: Plan} of what is to be planned; without those that cannot be
    contact_damping: of a loaded contact [N·s/m], given or from the stiffness
    endurance: life, contact pressure and film, with the oil and steel of `asked`
    limits: what the model leaves out, each with its number and its limit
    dof_comparison: what other free directions would change
    chain: what the scene gives from the loads of the balls to the vibration, a few numbers a link
    chain_before: the same of the scene before the last change, or of what is drawn in grey
    """

    #: attributes that take long enough to be drawn after the others
    slow = frozenset(
        {
            "motion",
            "healthy_motion",
            "ball_mass",
            "excerpt",
            "spectra",
            "late_spectra",
            "healthy_late_spectra",
            "orbit",
            "orbit_spectra",
            "dof_comparison",
            "chain",
            "chain_before",
        }
    )

    #: attributes that are made of a simulated motion
    moving_ones = frozenset(
        {
            "motion",
            "ball_mass",
            "excerpt",
            "spectra",
            "late_spectra",
            "orbit",
            "dof_comparison",
            "chain",
        }
    )

    def __init__(
        self,
        scene: Scene,
        cage_angle: float = 0.0,
        settings: Settings | None = None,
        focus: int = 0,
        *,
        moving: bool = False,
        planned: tuple[str, ...] = (),
        pinned: Reference | None = None,
        before: Scene | None = None,
        asked: Asked | None = None,
    ) -> None:
        """`moving`: a hand moves, be quick. `planned`: views that have plans, see `plans`.

        `pinned`: what the attributes that begin with ``healthy_`` are of, instead of the scene
        without its defect. `before`: the scene before the last change, where there was one.
        `asked`: what somebody says of steel, oil and surfaces.
        """
        self.scene = scene
        self.cage_angle = cage_angle
        self.settings = settings or Settings()
        self.focus = focus
        self.moving = moving
        self.planned = planned
        self.pinned = pinned
        self.before = before
        self.asked = asked or Asked()
        #: times [s] that processors have worked on it, in any thread: waiting is no cost
        self.costs: list[float] = []

    @property
    def beside(self) -> Scene:
        """What is drawn in grey beside the scene: a pinned one, or itself without its defect."""
        return self.scene.healthy() if self.pinned is None else self.pinned.scene

    @property
    def beside_words(self) -> str:
        """What it is called before its numbers; nothing where it is the scene itself."""
        if self.pinned is not None:
            return self.pinned.words
        return "without the defect" if self.scene.defects else ""

    @property
    def grey_words(self) -> str:
        """What it is called in a caption."""
        return WITHOUT_DEFECT if self.pinned is None else f"the pinned scene “{self.pinned.name}”"

    @property
    def beside_name(self) -> str:
        """What it is called in the names of columns."""
        return "healthy" if self.pinned is None else "pinned"

    @property
    def over_shaft(self) -> bool:
        """Whether curves are drawn over a turn of the shaft: a defect turns with it."""
        return any(defect.race == "inner" for defect in self.scene.defects)

    @cached_property
    def stretch(self) -> tuple[float, float, int]:
        """First and last cage angle [rad] that curves are drawn over, and how many there are.

        A ball spacing, after which all is as before. With a defect of the inner race nothing
        repeats so soon: then the turn of the shaft that the cage angle shown lies in.
        """
        by_hand = self.settings.cage_angles
        angles = default_cage_angles(self.scene, by_hand or self.settings.n_cage_angles)
        length = float(angles[-1])
        turn = math.floor(self.cage_angle / length + 1e-9) if self.over_shaft else 0
        return turn * length, (turn + 1) * length, angles.size

    def along(self, cage_angle: ArrayLike) -> NDArray[np.float64]:
        """Cage angles [rad] as curves show them [degrees], within the stretch.

        Those of the cage, or where the curves are over a turn of the shaft, those of the shaft.
        """
        first, last, _ = self.stretch
        angle = np.asarray(cage_angle, dtype=float)
        inside = first + np.where(angle == last, last - first, (angle - first) % (last - first))
        if self.over_shaft:
            return 360.0 * (inside - first) / (last - first)
        return np.degrees(inside)

    @cached_property
    def plans(self) -> dict[str, Plan]:
        """Plans of the views in `planned`, made when first asked for."""
        return {view: self.plan_of(view) for view in self.planned}

    def plan_of(self, view: str) -> Plan:
        """The plan for a view; what is drawn beside it is planned too. ValueError without one."""
        how = self.settings.planning(view)
        if view not in CURVES:
            return motion_plans(self.scene, view, how)
        if self.scene.defects:
            plans(self.scene.healthy(), view, how)
        return plans(self.scene, view, how)

    @cached_property
    def plan(self) -> Plan | None:
        """The plan that is drawn by; None where there is none, or a hand has overruled it.

        Planned cage angles are those of a first turn: in later ones, balls meet a defect of the
        inner race elsewhere.
        """
        if len(self.planned) != 1:
            return None
        (view,) = self.planned
        over_angles = view in CURVES
        if over_angles and (self.settings.cage_angles is not None or self.stretch[0] != 0.0):
            return None
        return self.plans[view]

    def _nodes(self, healthy: bool) -> bytes | None:
        """Cage angles that a plan has chosen, those of the healthy bearing by a plan of its own."""
        if self.plan is None or self.plan.cage_angles is None:
            return None
        plan = self.plan
        if healthy and self.scene.defects:
            view = plan.view
            plan = plans(self.scene.healthy(), view, self.settings.planning(view))
        angles = plan.cage_angles
        assert angles is not None
        # without a defect of the inner race curves are shorter
        last = self.stretch[1]
        if abs(float(angles[-1]) - last) > 1e-9 * last:
            return None
        return angles.tobytes()

    def _static(self, scene: Scene, healthy: bool = False) -> Equilibrium:
        nodes = self._nodes(healthy)
        if nodes is None:
            return equilibria(scene, *self.stretch)
        return planned_equilibria(scene, nodes)

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """Static answers over the stretch."""
        return self._static(self.scene)

    @cached_property
    def healthy_equilibrium(self) -> Equilibrium:
        """The same without the defect."""
        if self.pinned is not None:
            return equilibria(self.pinned.scene, *self.stretch)
        return self._static(self.scene.healthy(), healthy=True)

    @cached_property
    def healthy_all_around(self) -> Equilibrium:
        """The same over whatever stretch holds all that happens in a pinned scene."""
        if self.pinned is None:
            return self.healthy_equilibrium
        own = Results(self.pinned.scene, self.cage_angle, self.settings)
        return equilibria(self.pinned.scene, *own.stretch)

    @cached_property
    def load_curves(self) -> list[Curve]:
        """Load [N] of a ball over its angle [rad], a curve a row."""
        return _load_curves(self.equilibrium)

    @cached_property
    def inner_load_curves(self) -> list[Curve]:
        """The same at the inner race, where balls with mass carry less; none of massless ones."""
        found = self.equilibrium
        if not isinstance(found, EquilibriumWithMass) or found.positions.centrifugal_load == 0.0:
            return []
        rows = range(len(found.scene.bearing.all_rows))
        return [load_curve(found, row, found.inner_load) for row in rows]

    @property
    def load_curve(self) -> Curve:
        """That of the first row."""
        return self.load_curves[0]

    @property
    def healthy_load_curve(self) -> Curve:
        """The same without the defect."""
        return self.healthy_load_curves[0]

    @cached_property
    def healthy_load_curves(self) -> list[Curve]:
        """The same without the defect."""
        return _load_curves(self.healthy_all_around)

    @cached_property
    def now(self) -> Equilibrium:
        """Static answer at the cage angle shown; arrays of length 1."""
        return single_equilibria(self.scene, self.cage_angle)

    @property
    def massless_now(self) -> Equilibrium:
        """The same as maps have it: without the mass of the balls."""
        return single_equilibria(self.scene.replace(balls=MASSLESS), self.cage_angle)

    @cached_property
    def healthy_now(self) -> Equilibrium:
        """The same without the defect."""
        return single_equilibria(self.beside, self.cage_angle)

    @cached_property
    def modes(self) -> Modes:
        """Natural frequencies over the same cage angles."""
        return self._modes(self.scene)

    @cached_property
    def band_modes(self) -> Modes:
        """`modes` for their bands alone: while a hand moves, at every third cage angle.

        When it rests, at thrice as many where no plan says which: a band is then what a plan
        finds, within its error, and says the same on every tab.
        """
        first, last, n = self.stretch
        if self.moving:
            return modes(self.scene, first, last, n // 3 + 1)
        if self.settings.cage_angles is not None or self._nodes(healthy=False) is not None:
            return self.modes
        return modes(self.scene, first, last, 3 * n - 2)

    @cached_property
    def healthy_modes(self) -> Modes:
        """The same without the defect."""
        if self.pinned is not None:
            return self._of_pinned(modes, self.pinned.scene, *self.stretch)
        return self._modes(self.scene.healthy(), healthy=True)

    def _modes(self, scene: Scene, healthy: bool = False) -> Modes:
        nodes = self._nodes(healthy)
        if nodes is None:
            return modes(scene, *self.stretch)
        return planned_modes(scene, nodes)

    @property
    def extent(self) -> float:
        """Extent [rad] of the defect that is looked at."""
        return defects_of(self.scene)[self.focus].extent

    @cached_property
    def maps(self) -> Maps:
        """Stiffness and loaded balls over extents of the defect looked at, and cage angles.

        The same maps for every extent that they hold: moving along them computes nothing.
        """
        first, last, _ = self.stretch
        others = list(defects_of(self.scene))
        looked_at = dataclasses.replace(others.pop(self.focus), extent=0.0)
        scene = self.scene.replace(defect=(looked_at, *others) if others else looked_at)
        reach = next(reach for reach in MAP_REACHES if self.extent <= reach * 1.000001)
        # a turn of the shaft holds about five ball spacings: twice the angles, or too much to send
        n = self.settings.n_cage_angles
        columns = 2 * n - 1 if self.over_shaft else n
        return maps(scene, reach, self.settings.n_extents, first, last, columns)

    @cached_property
    def drop(self) -> dict[str, np.ndarray]:
        """Drop [m] of each ball's centre into the outer and the inner race, by race."""
        return {race: drops_now(self.scene, self.cage_angle, race) for race in RACES}

    @cached_property
    def profile(self) -> Profile:
        """The race around the defect and the path of a ball's centre over it."""
        return profile(self.scene, self.cage_angle, self.focus)

    @cached_property
    def coarse(self) -> bool:
        """Whether the motion is marched coarsely, as a slider moves and it takes long."""
        return self._is_coarse(self.scene)

    @cached_property
    def coarse_comparison(self) -> bool:
        """The same of `dof_comparison`, whose motions are marched alike."""
        return self.coarse or self._is_coarse(self.scene.replace(dofs=other_dofs(self.scene)))

    def begin(self, needed: frozenset[str]) -> None:
        """Begin what of these attributes can be computed beside the others, in another thread."""
        if {"late_spectra", "healthy_late_spectra"} <= needed:
            asked = self.beside, self._marching
            if not late_spectra.knows(*asked):  # whoever asks for it waits for this one
                BESIDE.submit(lambda: self._costing(late_spectra, *asked))

    def _costing(self, compute: Callable[..., Answer], *key: Hashable) -> Answer:
        """Compute something in another thread than that of the picture, at its cost."""
        before = time.thread_time()
        try:
            return compute(*key)
        finally:
            self.costs.append(time.thread_time() - before)

    def is_coarse(self, shown: frozenset[str]) -> bool:
        """Whether what is shown of attributes is made of motions that are marched coarsely."""
        if "dof_comparison" in shown and self.coarse_comparison:
            return True
        if "ball_mass" in shown and self._ball_marching.coarse:
            return True
        return bool(shown & self.moving_ones) and self.coarse

    def coarse_words(self, shown: frozenset[str]) -> str:
        """How what is shown is coarse, where it is."""
        scene = self.scene if "ball_mass" not in shown else self.scene.replace(balls=WITH_MASS)
        if scene.balls == MASSLESS:
            return "coarse while it moves: half the motion in half the steps"
        seconds = quick_duration(scene, self.settings.coarse_marching)
        return f"coarse while it moves: {seconds:.2g} s of motion"

    def _is_coarse(self, scene: Scene) -> bool:
        settings = self.settings
        return (
            self.moving
            and settings.step_rate is None
            and is_dear(scene, settings.sample_rate, settings.duration)
        )

    @cached_property
    def _marching(self) -> Marching:
        return self.settings.coarse_marching if self.coarse else self.settings.marching

    @cached_property
    def _how(self) -> How:
        """How the scene's motion comes about."""
        if self.plan is None or self.plan.cage_angles is not None:
            return self._marching
        how = self.settings.planning(self.plan.view)
        assert isinstance(how, MotionPlanning)
        return how

    @cached_property
    def motion(self) -> Motion:
        """Simulated motion of rotor and housing."""
        return motions(self.scene, self._how).motion

    @property
    def settled_since(self) -> float:
        """When [s] of the motion its start is forgotten."""
        return motions(self.scene, self._how).since

    @cached_property
    def healthy_motion(self) -> Motion:
        """The same without the defect, always marched."""
        return self._of_pinned(motions, self.beside, self._marching).motion

    @cached_property
    def excerpt(self) -> Excerpt:
        """Some ball passes of the settled motion, with static loads beside the moving ones."""
        return excerpts(self.scene, self._how)

    @cached_property
    def spectra(self) -> dict[str, Spectrum]:
        """Spectrum of the housing's acceleration along each direction, by its name."""
        return spectra(self.scene, self._marching)

    @cached_property
    def late_spectra(self) -> dict[str, Spectrum]:
        """The same of the settled motion; empty where it did not stay finite."""
        return late_spectra(self.scene, self._how)

    @property
    def healthy_settled_since(self) -> float:
        """When [s] of that motion its start is forgotten."""
        return motions(self.beside, self._marching).since

    @cached_property
    def healthy_late_spectra(self) -> dict[str, Spectrum]:
        """The same without the defect, always marched."""
        return self._of_pinned(late_spectra, self.beside, self._marching)

    def _of_pinned(self, compute: Callable[..., Answer], *key: Hashable) -> Answer:
        """Compute something of what is drawn in grey; refused, it says that it is not the scene."""
        try:
            return compute(*key)
        except ValueError as error:
            if self.pinned is None:
                raise
            words = f"the {self.pinned.words} cannot be shown beside it: {error}"
            raise ValueError(words) from None

    @property
    def _ball_marching(self) -> Marching:
        heavy = self.scene.replace(balls=WITH_MASS)
        coarse = self._is_coarse(heavy)
        return self.settings.coarse_marching if coarse else self.settings.marching

    @cached_property
    def ball_mass(self) -> BallMass:
        """The motions without and with the balls' mass, marched alike; whatever the scene has."""
        return ball_masses(self.scene.replace(balls=MASSLESS), self._ball_marching)

    @property
    def ball_comparison(self) -> BallComparison | None:
        """Up to which frequency massless balls will do, where `compare_balls` has found it."""
        key = self._compared_balls
        return ball_comparisons(*key) if ball_comparisons.knows(*key) else None

    @property
    def _compared_balls(self) -> tuple[Scene, float]:
        how = self.settings.planning(SETTLED)
        assert isinstance(how, MotionPlanning)
        return self.scene.replace(balls=MASSLESS), how.budget

    def compare_balls(self) -> BallComparison:
        """Find `ball_comparison`; ValueError where there is no motion to compare."""
        return ball_comparisons(*self._compared_balls)

    @property
    def ball_passes(self) -> int | None:
        """After how many ball passes all is as before; None where it never is."""
        return common_ball_passes(self.scene)

    @cached_property
    def orbit(self) -> Orbit | None:
        """The motion that repeats itself; None where it takes too many ball passes to look for.

        The search is short while a hand moves.
        """
        found = self._hasty_orbit
        if found is None or self.moving or found.status != NOT_CONVERGED:
            return found
        return orbits(*self._orbital)

    @cached_property
    def _hasty_orbit(self) -> Orbit | None:
        if (self.ball_passes or 0) > LONGEST_ORBIT:
            return None
        return hasty_orbits(*self._orbital)

    @property
    def _orbital(self) -> tuple[Scene, Marching]:
        """What an orbit is looked for with: balls without mass, whatever the scene has."""
        return self.scene.replace(balls=MASSLESS), self._marching

    def seek_orbit(self, give_up: Callable[[], bool]) -> None:
        """Look for the orbit so that it is known afterwards, unless `give_up` says so before."""
        key = self._orbital
        found = self._hasty_orbit
        if found is None or found.status != NOT_CONVERGED or orbits.knows(*key):
            return
        longer = _orbit(*key, give_up)
        if not give_up():
            orbits.keep(longer, *key)

    @cached_property
    def orbit_spectra(self) -> dict[str, Spectrum]:
        """Spectrum of a record as long as the second half of the motion; empty without an orbit."""
        if self.orbit is None or not self.orbit.multipliers.size:
            return {}
        duration = 0.5 * self.settings.duration
        frequency, density = self.orbit.spectrum(self.settings.sample_rate, duration=duration)
        return {
            dof: core.Spectrum(frequency, density[:, i]) for i, dof in enumerate(self.orbit.dofs)
        }

    @cached_property
    def contact_damping(self) -> float:
        """Viscous damping of a loaded contact [N·s/m], given or from the stiffness."""
        return core.contact_damping(self.scene)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """What the model leaves out of the scene, with what is known of it in motion.

        The same whatever is on screen: looked at over cage angles of its own, and with the motion
        that any view has had simulated.
        """
        step_rate = self.settings.step_rate
        if step_rate is None:
            try:
                step_rate = step_rates(self.scene, self.settings.sample_rate)
            except ValueError:
                step_rate = None  # no motion, no steps
        return limits_of(self.scene, step_rate, self._dynamic_load, self.asked)

    @property
    def endurance(self) -> Endurance:
        """Life, pressure and film of the scene, with the oil and steel that were asked for."""
        return endurance(self.scene, self.asked)

    @property
    def _dynamic_load(self) -> float | None:
        """Greatest ball load [N] of the settled motion, where one has been simulated."""
        planning = self.settings.planning(SETTLED)
        assert isinstance(planning, MotionPlanning)
        for how in (planning, self.settings.marching):
            key = self.scene, how
            if dynamic_loads.knows(*key) or (not self.moving and motions.knows(*key)):
                load = dynamic_loads(*key)
                return load if math.isfinite(load) else None
        return None

    @cached_property
    def chain(self) -> Chain:
        """What the scene gives from the loads of the balls to the vibration."""
        return chain(self)

    @cached_property
    def chain_before(self) -> Chain:
        """The same of the scene before the last change; before the first, of what is in grey."""
        scene = self.beside if self.before is None else self.before
        if scene == self.scene:
            return self.chain
        return Results(scene, self.cage_angle, self.settings, moving=self.moving).chain

    @cached_property
    def dof_comparison(self) -> DofComparison:
        """The scene with its free directions against those it needs, or against all five."""
        chosen, other = self.scene.active_dofs, other_dofs(self.scene)
        if chosen == other:
            return DofComparison(chosen, other, {}, {})
        against = Results(self.scene.replace(dofs=other), self.cage_angle, self.settings)
        static = static_differences(self.equilibrium, against.equilibrium)
        settings = self.settings
        how = settings.coarse_marching if self.coarse_comparison else settings.marching
        try:
            moving = spectrum_differences(spectra(self.scene, how), spectra(against.scene, how))
        except ValueError as error:
            return DofComparison(chosen, other, static, {}, str(error))
        return DofComparison(chosen, other, static, moving)
