"""A short motion, marched in several ways to see what each is off by and costs."""

from __future__ import annotations

import math
import time
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.dynamics.adaptive import simulate_adaptive
from bearingcore.dynamics.modes import contact_damping, highest_natural_frequency
from bearingcore.dynamics.motion import Motion, default_step_rate, simulate
from bearingcore.plan.plans import (
    FULL_RATE,
)
from bearingcore.scene.packing import is_planar
from bearingcore.scene.scene import DOF_NAMES, Scene
from bearingcore.signals.spectrum import spectrum

Array = NDArray[np.float64]

PILOT = 0.25
"""[s] of motion that are marched to see what a step costs in accuracy."""

SAFETY = 3.0
"""Predicted errors of motions: the pilot's times this, as it is shorter than what it speaks for."""

BAND = 1.25
"""Spectra count up to this times the highest natural frequency."""

COUNTS = 1e-4
"""Frequencies at which a direction is below this part of its greatest density do not count."""

TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
"""What may be chosen where steps choose themselves."""


class Way(NamedTuple):
    """A way to march.

    Steps a second [Hz] for fixed ones, a tolerance for those that choose themselves, the other
    NaN; its predicted error [dB]; and for each second of motion (of an orbit: in all) calls, time,
    and the `work`: as many calls with fixed steps as take that long. Ways are chosen by their work,
    which does not depend on how busy the machine is.
    """

    step_rate: float
    tolerance: float
    error: float
    calls: float
    cost: float
    work: float

    @property
    def simulated_as(self) -> tuple[str, float]:
        """What `simulate_as` calls it: its kind and setting."""
        if math.isnan(self.step_rate):
            return "adaptive", self.tolerance
        return "fixed", self.step_rate


def step_rates(sample_rate: float) -> list[float]:
    """Step rates [Hz] that fit a sample rate, rising."""
    return [sample_rate / k for k in (16, 12, 8, 6, 4, 3, 2)] + [
        sample_rate * k for k in (1, 2, 3, 4, 6, 8)
    ]


class Pilot:
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
                motion = simulate_as(kind, self.scene, PILOT, self.sample_rate, setting)
                self._known[kind, setting] = motion.outer_acceleration, motion.right_hand_side_calls
        return self._known[kind, setting]

    def a_call(self, kind: str) -> float:
        """Time [s] of a right-hand side, with its share of everything else."""
        scene = self.scene
        n_dofs = len(scene.active_dofs)
        if n_dofs == 2 and not is_planar(scene):
            n_dofs = 3  # the kernel for any directions
        return seconds_a_call(kind, scene.bearing.n_balls, n_dofs, scene.contact_law)

    @property
    def adaptive_work(self) -> float:
        """Calls with fixed steps that take as long as one where steps choose themselves."""
        return 6.0 if is_planar(self.scene) else 2.0

    def _way(self, kind: str, setting: float, finer: float) -> Way:
        found, calls = self.signal(kind, setting)
        truth = self.signal(kind, finer)[0]
        # its second half as well: of one stretch alone two steps can agree by chance
        error = SAFETY * max(
            spectra_apart(found[since:], truth[since:], self.sample_rate, self.band)
            for since in (0, len(found) // 2)
        )
        rate, tolerance = (math.nan, setting) if kind == "adaptive" else (setting, math.nan)
        work = calls if kind == "fixed" else calls * self.adaptive_work
        return Way(
            rate, tolerance, error, calls / PILOT, calls / PILOT * self.a_call(kind), work / PILOT
        )

    def _at(self, rate: float) -> Way:
        """What a rate is off by shows beside twice the rate.

        There an error that falls with order 2 or more leaves a quarter at most; one of order 1 a
        half, which SAFETY allows for.
        """
        ratio = round(self.sample_rate / rate)
        fits = 2.0 * rate if ratio <= 1 or ratio % 2 == 0 else ratio * rate
        return self._way("fixed", rate, fits)

    def fixed(self, asked: float | None) -> Way:
        """The longest fixed step within the budget, or the best of those tried."""
        if asked is not None:
            return self._at(asked)
        usual = default_step_rate(self.scene, self.sample_rate, self.highest)
        least = 2.5 * self.highest if math.isfinite(self.highest) else usual
        rates = [rate for rate in step_rates(self.sample_rate) if rate >= least] or [usual]
        # begin where the program would without a plan, go down while it holds or up until it does
        at = min(range(len(rates)), key=lambda i: abs(math.log(rates[i] / usual)))
        # an error that falls with order 1 would need steps without end
        top = min(at + 2, len(rates)) if force_jumps(self.scene) else len(rates)
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

    def adaptive(self) -> Way:
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

    def _over(self, way: Way) -> float:
        """How many times the budget a way errs by; 1 where that is not known."""
        return way.error / self.budget if math.isfinite(way.error) else 1.0


def force_jumps(scene: Scene) -> bool:
    """True where the force of a contact jumps and no change of variables takes the jump away."""
    return scene.contact_law != "published" and contact_damping(scene) > 0.0


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


@lru_cache(maxsize=256)
def seconds_a_call(kind: str, n_balls: int, n_dofs: int, law: str) -> float:
    """Time [s] of one right-hand side on this machine, measured once on a scene of that size.

    `kind` is one of those of `Pilot.signal`.
    """
    from bearingcore.scene.presets import presets

    widest = 0.9 * 45e-3 * math.sin(math.pi / n_balls) if n_balls > 1 else 8e-3
    example = presets["fan-rig"].replace(
        n_balls=n_balls, ball_diameter=min(8e-3, widest), dofs=DOF_NAMES[:n_dofs],
        contact_damping=100.0, contact_law=law,
    )  # fmt: skip
    least = math.inf
    for _ in range(4):
        start = time.perf_counter()
        motion = simulate_as(
            kind, example, 0.03, FULL_RATE, FULL_RATE if kind != "adaptive" else 1e-6
        )
        _ = motion.outer_acceleration
        taken = time.perf_counter() - start
        least = min(least, taken / max(motion.right_hand_side_calls, 1))
    return least


def simulate_as(
    kind: str, scene: Scene, duration: float, sample_rate: float, setting: float
) -> Motion:
    """A motion by one of the ways that a pilot tries."""
    if kind == "fixed":
        return simulate(scene, duration, sample_rate, step_rate=setting)
    return simulate_adaptive(scene, duration, sample_rate, tolerance=setting)
