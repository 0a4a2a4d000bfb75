"""Results: what is known about one scene, computed when first asked for.

Everything that is drawn passes through here. The core's answers are shared by all sessions and
kept by scene, so that thirty people looking at one scene cost as much as one; what waits for an
answer somebody else is computing waits for that one instead of computing it again.
"""

from __future__ import annotations

import dataclasses
import math
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bearingcore as core
from app.dof_comparison import (
    DofComparison,
    other_dofs,
    spectrum_differences,
    static_differences,
)
from app.excerpt import Excerpt, excerpt
from app.profile import Profile, profile
from app.quantities import defects_of
from bearingcore.defect import RACES
from bearingcore.equilibrium import default_cage_angles
from bearingcore.modes import highest_natural_frequency
from bearingcore.motion import default_step_rate
from bearingcore.orbit import common_ball_passes
from bearingcore.passes import ball_drop

if TYPE_CHECKING:
    from bearingcore import Equilibrium, Limit, Maps, Modes, Motion, Orbit, Scene, Spectrum

Answer = TypeVar("Answer")


MAP_REACHES = tuple(math.radians(reach) for reach in (90.0, 120.0, 180.0, 360.0))
"""How far maps go in extent [rad]: the first that holds the extent shown. 90° as in the paper."""


LONGEST_ORBIT = 60
"""Ball passes of the longest orbit that is looked for while sliders move."""


class ComputedOnce(Generic[Answer]):
    """A bounded cache for threads: each key is computed once, the least used leaves first."""

    def __init__(self, compute: Callable[..., Answer], size: int) -> None:
        self._compute = compute
        self._size = size
        self._lock = threading.Lock()
        self._known: OrderedDict[Hashable, Future[Answer]] = OrderedDict()

    def __call__(self, *key: Hashable) -> Answer:
        with self._lock:
            future = self._known.get(key)
            mine = future is None
            if future is None:
                future = self._known[key] = Future()
                while len(self._known) > self._size:
                    self._known.popitem(last=False)
            else:
                self._known.move_to_end(key)
        if mine:
            try:
                future.set_result(self._compute(*key))
            except BaseException as error:
                with self._lock:
                    self._known.pop(key, None)
                future.set_exception(error)
        return future.result()


@dataclass(frozen=True)
class Settings:
    """How finely a session wants its results.

    `n_cage_angles` to a ball spacing and across maps, `n_extents` of maps; `duration` [s] and
    `sample_rate` [Hz] of motions, and `step_rate` [Hz] where somebody set the steps by hand.
    """

    n_cage_angles: int = 121
    n_extents: int = 91
    duration: float = 1.4
    sample_rate: float = 65536.0
    step_rate: float | None = None

    @property
    def marching(self) -> tuple[float, float, float | None]:
        """What of this a motion depends on."""
        return self.duration, self.sample_rate, self.step_rate


def _over_period(scene: Scene, first: float, last: float, n_cage_angles: int) -> Equilibrium:
    return core.equilibrium(scene, np.linspace(first, last, n_cage_angles))


def _at(scene: Scene, cage_angle: float) -> Equilibrium:
    return core.equilibrium(scene, np.array([cage_angle]))


def _modes(scene: Scene, first: float, last: float, n_cage_angles: int) -> Modes:
    return core.modes(scene, np.linspace(first, last, n_cage_angles))


def _maps(scene: Scene, reach: float, m: int, first: float, last: float, n: int) -> Maps:
    return core.stiffness_maps(scene, np.linspace(0.0, reach, m), np.linspace(first, last, n))


MOST_STEPS = 400_000
"""Steps of a motion on the page: where a defect is passed so fast that it takes more, the motion is
shorter, or somebody's drag would fill the memory of everybody's server."""
SHORTEST = 0.1
"""[s] Shorter motions say nothing at the resolution of the spectra."""


def _motion(scene: Scene, duration: float, sample_rate: float, by_hand: float | None) -> Motion:
    rate = step_rates(scene, sample_rate) if by_hand is None else by_hand
    if rate is not None and duration * rate > MOST_STEPS:
        if SHORTEST * rate > MOST_STEPS:
            why = "the defect is passed so fast that" if by_hand is None else "set by hand,"
            raise ValueError(
                f"{why} a motion takes {rate:.2g} steps a second; "
                f"allowed here: {MOST_STEPS / SHORTEST:.2g}"
            )
        duration = MOST_STEPS / rate
    return core.simulate(scene, duration, sample_rate, step_rate=rate)


def _excerpt(scene: Scene, *marching: float | None) -> Excerpt:
    return excerpt(scene, motions(scene, *marching))


def _step_rate(scene: Scene, sample_rate: float) -> float | None:
    highest = highest_natural_frequency(scene)
    if scene.shaft_speed == 0.0 or not math.isfinite(highest):
        return None
    return default_step_rate(scene, sample_rate, highest)


def _spectra(
    scene: Scene, duration: float, sample_rate: float, step_rate: float | None
) -> dict[str, Spectrum]:
    motion = motions(scene, duration, sample_rate, step_rate)
    return {
        dof: core.spectrum(motion.outer_acceleration[:, index], sample_rate)
        for index, dof in enumerate(motion.dofs)
    }


def _late_spectra(
    scene: Scene, duration: float, sample_rate: float, step_rate: float | None
) -> dict[str, Spectrum]:
    motion = motions(scene, duration, sample_rate, step_rate)
    late = motion.outer_acceleration[motion.time.size // 2 :]
    if not np.isfinite(late).all():
        return {}
    frequency, density = core.spectrum(late, sample_rate)
    return {dof: core.Spectrum(frequency, density[:, i]) for i, dof in enumerate(motion.dofs)}


equilibria = ComputedOnce(_over_period, 512)
single_equilibria = ComputedOnce(_at, 2048)
modes = ComputedOnce(_modes, 256)
maps = ComputedOnce(_maps, 16)  # about 2 MB each
motions = ComputedOnce(_motion, 8)  # about 20 MB each
step_rates = ComputedOnce(_step_rate, 512)
excerpts = ComputedOnce(_excerpt, 64)
spectra = ComputedOnce(_spectra, 64)
late_spectra = ComputedOnce(_late_spectra, 64)
orbits = ComputedOnce(core.orbit, 256)


class Results:
    """What the views read. Attributes are computed when first asked for, in any thread.

    scene: the Scene shown
    cage_angle: the cage angle shown [rad]
    focus: which of the scene's defects is looked at
    equilibrium, sound_equilibrium: over the stretch of the curves, with the defect and without
    now, sound_now: at `cage_angle` alone (arrays of length 1)
    modes, sound_modes: over the same cage angles
    extent: of the defect looked at [rad]
    maps: over its extent and the same cage angles
    drop: how far each ball has sunk into each race at `cage_angle`
    profile: the race around the defect and a ball's path over it
    motion, sound_motion: simulated motion
    excerpt: the last ball passes of the motion
    spectra, sound_spectra: {dof: Spectrum} of the housing's acceleration
    late_spectra: the same of the second half of the motion, when the start is forgotten
    ball_passes: after how many of them the scene is as before; None where it never is
    orbit: the motion that repeats itself; None where it takes too many ball passes to look for
    orbit_spectra: {dof: Spectrum} of the housing's acceleration on it; empty without an orbit
    contact_damping: of a loaded contact [N·s/m], given or from the stiffness
    limits: what the model leaves out, each with its number and its limit
    dof_comparison: what other free directions would change
    """

    #: attributes that take long enough to be drawn after the others
    slow = frozenset(
        {
            "motion",
            "sound_motion",
            "excerpt",
            "spectra",
            "sound_spectra",
            "late_spectra",
            "orbit",
            "orbit_spectra",
            "dof_comparison",
        }
    )

    def __init__(
        self,
        scene: Scene,
        cage_angle: float = 0.0,
        settings: Settings | None = None,
        focus: int = 0,
    ) -> None:
        self.scene = scene
        self.cage_angle = cage_angle
        self.settings = settings or Settings()
        self.focus = focus

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
        angles = default_cage_angles(self.scene, self.settings.n_cage_angles)
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
    def equilibrium(self) -> Equilibrium:
        """Static answers over the stretch."""
        return equilibria(self.scene, *self.stretch)

    @cached_property
    def sound_equilibrium(self) -> Equilibrium:
        """The same without the defect."""
        return equilibria(self.scene.sound(), *self.stretch)

    @cached_property
    def now(self) -> Equilibrium:
        """Static answer at the cage angle shown; arrays of length 1."""
        return single_equilibria(self.scene, self.cage_angle)

    @cached_property
    def sound_now(self) -> Equilibrium:
        """The same without the defect."""
        return single_equilibria(self.scene.sound(), self.cage_angle)

    @cached_property
    def modes(self) -> Modes:
        """Natural frequencies over the same cage angles."""
        return modes(self.scene, *self.stretch)

    @cached_property
    def sound_modes(self) -> Modes:
        """The same without the defect."""
        return modes(self.scene.sound(), *self.stretch)

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
        angle = self.now.ball_angle[0]
        return {race: ball_drop(self.scene, angle, self.cage_angle, race) for race in RACES}

    @cached_property
    def profile(self) -> Profile:
        """The race around the defect and the path of a ball's centre over it."""
        return profile(self.scene, self.cage_angle, self.focus)

    @cached_property
    def motion(self) -> Motion:
        """Simulated motion of rotor and housing."""
        return motions(self.scene, *self.settings.marching)

    @cached_property
    def sound_motion(self) -> Motion:
        """The same without the defect."""
        return motions(self.scene.sound(), *self.settings.marching)

    @cached_property
    def excerpt(self) -> Excerpt:
        """The last ball passes of the motion, with static loads beside the moving ones."""
        return excerpts(self.scene, *self.settings.marching)

    @cached_property
    def spectra(self) -> dict[str, Spectrum]:
        """Spectrum of the housing's acceleration along each direction, by its name."""
        return spectra(self.scene, *self.settings.marching)

    @cached_property
    def late_spectra(self) -> dict[str, Spectrum]:
        """The same of the second half of the motion; empty where it did not stay finite."""
        return late_spectra(self.scene, *self.settings.marching)

    @property
    def ball_passes(self) -> int | None:
        """After how many ball passes all is as before; None where it never is."""
        return common_ball_passes(self.scene)

    @cached_property
    def orbit(self) -> Orbit | None:
        """The motion that repeats itself; None where it takes too many ball passes to look for."""
        return None if (self.ball_passes or 0) > LONGEST_ORBIT else orbits(self.scene)

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
    def sound_spectra(self) -> dict[str, Spectrum]:
        """The same without the defect."""
        return spectra(self.scene.sound(), *self.settings.marching)

    @cached_property
    def contact_damping(self) -> float:
        """Viscous damping of a loaded contact [N·s/m], given or from the stiffness."""
        return core.contact_damping(self.scene)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """What the model leaves out of the scene, also of a simulated motion where it moves."""
        step_rate = self.settings.step_rate
        if step_rate is None:
            try:
                step_rate = step_rates(self.scene, self.settings.sample_rate)
            except ValueError:
                step_rate = None  # no motion, no steps
        return core.limits(self.scene, self.equilibrium, step_rate=step_rate)

    @cached_property
    def dof_comparison(self) -> DofComparison:
        """The scene with its free directions against those it needs, or against all five."""
        chosen, other = self.scene.active_dofs, other_dofs(self.scene)
        if chosen == other:
            return DofComparison(chosen, other, {}, {})
        against = Results(self.scene.replace(dofs=other), self.cage_angle, self.settings)
        static = static_differences(self.equilibrium, against.equilibrium)
        try:
            moving = spectrum_differences(self.spectra, against.spectra)
        except ValueError as error:
            return DofComparison(chosen, other, static, {}, str(error))
        return DofComparison(chosen, other, static, moving)
