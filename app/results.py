"""Results: what is known about one scene, computed when first asked for.

Everything that is drawn passes through here. The core's answers are shared by all sessions and
kept by scene, so that thirty people looking at one scene cost as much as one; what waits for an
answer somebody else is computing waits for that one instead of computing it again.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

import bearingcore as core
from app.excerpt import Excerpt, excerpt
from app.profile import Profile, profile
from bearingcore.defect import RACES
from bearingcore.equilibrium import default_cage_angles
from bearingcore.passes import ball_drop

if TYPE_CHECKING:
    from bearingcore import Equilibrium, Modes, Motion, Scene, Spectrum

Answer = TypeVar("Answer")


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

    `n_cage_angles` to a ball spacing; `duration` [s] and `sample_rate` [Hz] of motions.
    """

    n_cage_angles: int = 121
    duration: float = 1.4
    sample_rate: float = 65536.0


def _over_spacing(scene: Scene, n_cage_angles: int) -> Equilibrium:
    return core.equilibrium(scene, default_cage_angles(scene, n_cage_angles))


def _at(scene: Scene, cage_angle: float) -> Equilibrium:
    return core.equilibrium(scene, np.array([cage_angle]))


def _modes(scene: Scene, n_cage_angles: int) -> Modes:
    return core.modes(scene, default_cage_angles(scene, n_cage_angles))


def _motion(scene: Scene, duration: float, sample_rate: float) -> Motion:
    return core.simulate(scene, duration, sample_rate)


def _excerpt(scene: Scene, duration: float, sample_rate: float) -> Excerpt:
    return excerpt(scene, motions(scene, duration, sample_rate))


def _spectra(scene: Scene, duration: float, sample_rate: float) -> dict[str, Spectrum]:
    motion = motions(scene, duration, sample_rate)
    return {
        dof: core.spectrum(motion.outer_acceleration[:, index], sample_rate)
        for index, dof in enumerate(motion.dofs)
    }


equilibria = ComputedOnce(_over_spacing, 512)
single_equilibria = ComputedOnce(_at, 2048)
modes = ComputedOnce(_modes, 256)
motions = ComputedOnce(_motion, 8)  # about 20 MB each
excerpts = ComputedOnce(_excerpt, 64)
spectra = ComputedOnce(_spectra, 64)


class Results:
    """What the views read. Attributes are computed when first asked for, in any thread.

    scene: the Scene shown
    cage_angle: the cage angle shown [rad]
    equilibrium, sound_equilibrium: over one period of the curves, with the defect and without
    now, sound_now: at `cage_angle` alone (arrays of length 1)
    modes, sound_modes: over the same cage angles
    drop: how far each ball has sunk into each race at `cage_angle`
    profile: the race around the defect and a ball's path over it
    motion, sound_motion: simulated motion
    excerpt: the last ball passes of the motion
    spectra, sound_spectra: {dof: Spectrum} of the housing's acceleration
    """

    #: attributes that take long enough to be drawn after the others
    slow = frozenset({"motion", "sound_motion", "excerpt", "spectra", "sound_spectra"})

    def __init__(
        self, scene: Scene, cage_angle: float = 0.0, settings: Settings | None = None
    ) -> None:
        self.scene = scene
        self.cage_angle = cage_angle
        self.settings = settings or Settings()

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """Static answers over one period: a ball spacing, or a shaft turn for an inner race."""
        return equilibria(self.scene, self.settings.n_cage_angles)

    @cached_property
    def sound_equilibrium(self) -> Equilibrium:
        """The same without the defect."""
        return equilibria(self.scene.sound(), self.settings.n_cage_angles)

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
        return modes(self.scene, self.settings.n_cage_angles)

    @cached_property
    def sound_modes(self) -> Modes:
        """The same without the defect."""
        return modes(self.scene.sound(), self.settings.n_cage_angles)

    @cached_property
    def drop(self) -> dict[str, np.ndarray]:
        """Drop [m] of each ball's centre into the outer and the inner race, by race."""
        angle = self.now.ball_angle[0]
        return {race: ball_drop(self.scene, angle, self.cage_angle, race) for race in RACES}

    @cached_property
    def profile(self) -> Profile:
        """The race around the defect and the path of a ball's centre over it."""
        return profile(self.scene, self.cage_angle)

    @cached_property
    def motion(self) -> Motion:
        """Simulated motion of rotor and housing."""
        return motions(self.scene, self.settings.duration, self.settings.sample_rate)

    @cached_property
    def sound_motion(self) -> Motion:
        """The same without the defect."""
        return motions(self.scene.sound(), self.settings.duration, self.settings.sample_rate)

    @cached_property
    def excerpt(self) -> Excerpt:
        """The last ball passes of the motion, with static loads beside the moving ones."""
        return excerpts(self.scene, self.settings.duration, self.settings.sample_rate)

    @cached_property
    def spectra(self) -> dict[str, Spectrum]:
        """Spectrum of the housing's acceleration along each direction, by its name."""
        return spectra(self.scene, self.settings.duration, self.settings.sample_rate)

    @cached_property
    def sound_spectra(self) -> dict[str, Spectrum]:
        """The same without the defect."""
        return spectra(self.scene.sound(), self.settings.duration, self.settings.sample_rate)
