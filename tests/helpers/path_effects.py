"""Effects between a motion and its measurement: wandering cages, paths, knocks, tones, noise.

A simulated motion has a cage that turns steadily and a sensor that feels the housing itself. Real
ones have neither. Each effect can be switched off by itself, to find which of them a method bears.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len
from scipy.interpolate import make_interp_spline
from scipy.signal import resample_poly

from bearingcore.dynamics.motion import simulate
from bearingcore.scene.scene import Scene
from bearingcore.signals.recording import DIRECTIONS, Recording
from bearingcore.statics.passes import crossings
from tests.helpers.simulated import SETTLING

SLOWEST_WANDER = 0.3
"""[Hz] The cage's speed wanders no slower than this, and no faster than the cage turns."""

WANDERS = 6
"""Sines of which a wandering speed consists."""

TONES = 6
"""Harmonics of the shaft, each fainter than the one before: the first, half, a third of it …"""


@dataclass(frozen=True)
class Resonance:
    """A resonance of the path from the housing to the sensor."""

    frequency: float
    """[Hz]"""
    damping: float
    """ratio to the critical one"""
    gain: tuple[float, ...]
    """what it adds at its peak, along each direction, to the 1 of the direct path"""

    def transfer(self, frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
        """What it adds (n,) at frequencies [Hz], for a gain of 1: 2iζr/(1 − r² + 2iζr)."""
        r = frequency / self.frequency
        return np.asarray(2j * self.damping * r / (1.0 - r**2 + 2j * self.damping * r))


TWO_RESONANCES = (Resonance(950.0, 0.04, (2.0, -1.5)), Resonance(2100.0, 0.03, (-1.0, 2.0)))


def drawn_resonances(rng: np.random.Generator) -> tuple[Resonance, ...]:
    """A low and a high resonance, each felt along x and y with gains of their own."""
    return tuple(
        Resonance(
            math.exp(rng.uniform(math.log(low), math.log(high))),
            rng.uniform(0.02, 0.06),
            tuple((rng.uniform(0.5, 3.0, 2) * rng.choice([-1.0, 1.0], 2)).tolist()),
        )
        for low, high in ((500.0, 1400.0), (1400.0, 3500.0))
    )


@dataclass(frozen=True)
class PathEffects:
    """What is added to a simulated motion, each switched off by its 0, () or None.

    Attributes
    ----------
    cage_wander
        standard deviation of the cage's speed, as a share of it.
    resonances
        between housing and sensor.
    knock, knock_frequency, knock_damping
        peak of what a ball makes ring as it strikes the far edge, over the peak of the motion;
        its frequency [Hz] and damping ratio.
    shaft_tones
        root mean square of the shaft's first harmonic, over that of the signal.
    noise
        [dB] by which the power of pink noise lies below the signal's; None for none.
    """

    cage_wander: float = 0.004
    resonances: tuple[Resonance, ...] = TWO_RESONANCES
    knock: float = 3.0
    knock_frequency: float = 4700.0
    knock_damping: float = 0.04
    shaft_tones: float = 0.3
    noise: float | None = 20.0

    def without(self, *names: str) -> PathEffects:
        """The same with some effects switched off, by the names of their fields."""
        off: dict[str, Any] = {"cage_wander": 0.0, "resonances": (), "knock": 0.0}
        off |= {"shaft_tones": 0.0, "noise": None}
        return dataclasses.replace(self, **{name: off[name] for name in names})


def recorded_through(
    scene: Scene,
    effects: PathEffects,
    duration: float = 1.4,
    sample_rate: float = 20_480.0,
    *,
    seed: int = 0,
) -> Recording:
    """What a sensor records of a scene, beyond the motion of its housing.

    A cage that wanders is the steady motion on a clock that wanders: passes and events move in
    time as they do, modes by the same few thousandths, which nothing shows.
    """
    rng = np.random.default_rng(seed)
    start = SETTLING + float(rng.uniform(0.05, 0.25))
    motion = simulate(scene, start + 1.02 * duration + 0.05, sample_rate)
    assert motion.completed, motion.reason
    directions = tuple(name for name in DIRECTIONS if name in motion.dofs)
    columns = [motion.dofs.index(name) for name in directions]
    count = round(duration * sample_rate)
    time = np.arange(count) / sample_rate
    clock = start + wandering_clock(time, effects.cage_wander, scene, rng)
    signal = _at(motion.outer_acceleration[:, columns], sample_rate, clock)
    if effects.knock > 0.0:
        peak = float(np.abs(signal).max())
        ring = _knocks(scene, effects, clock, time)
        toward = np.array([math.cos(scene.defects[0].center), math.sin(scene.defects[0].center)])
        along = [toward["xy".index(name)] for name in directions]
        # a blow along the defect's radius is felt a little across it too
        felt = np.where(np.abs(along) < 0.3, 0.3, along)
        signal = signal + effects.knock * peak * ring[:, None] * felt
    if effects.resonances:
        signal = _through(signal, sample_rate, effects.resonances)
    level = math.sqrt(float(np.mean(signal**2)))
    if effects.shaft_tones > 0.0:
        turn = scene.shaft_speed * time
        for order in range(1, TONES + 1):
            phase = rng.uniform(0.0, 2.0 * math.pi, len(directions))
            size = math.sqrt(2.0) * effects.shaft_tones * level / order
            signal = signal + size * np.cos(order * turn[:, None] + phase)
    if effects.noise is not None:
        noise = pink_noise(count, len(directions), rng)
        signal = signal + level * 10.0 ** (-effects.noise / 20.0) * noise
    return Recording(signal, sample_rate, directions, "simulated, along a path")


def wandering_clock(
    time: NDArray[np.float64], wander: float, scene: Scene, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Times [s] (n,) of a steady cage at which one whose speed wanders stands as at `time`.

    The speed is a sum of slow sines of a standard deviation `wander` over the record.
    """
    fastest = max(scene.cage_speed / (2.0 * math.pi), 1.5 * SLOWEST_WANDER)
    speed = np.zeros(len(time))
    for frequency in rng.uniform(SLOWEST_WANDER, fastest, WANDERS):
        speed += np.cos(2.0 * math.pi * frequency * time + rng.uniform(0.0, 2.0 * math.pi))
    speed -= speed.mean()
    speed *= wander / max(float(speed.std()), 1e-300)
    return np.asarray(time + np.concatenate(([0.0], np.cumsum(speed[:-1]) * (time[1] - time[0]))))


def pink_noise(count: int, columns: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Noise (count, columns) of deviation 1 whose power falls with frequency."""
    transform = np.fft.rfft(rng.standard_normal((count, columns)), axis=0)
    number = np.arange(len(transform), dtype=float)
    number[0] = math.inf
    noise = np.fft.irfft(transform / np.sqrt(number)[:, None], count, axis=0)
    return np.asarray(noise / noise.std(axis=0))


def _at(
    signal: NDArray[np.float64], rate: float, clock: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The signal (n, d) at other times [s] than those of its samples."""
    fine = resample_poly(signal, 4, 1, axis=0)
    return np.asarray(make_interp_spline(np.arange(len(fine)) / (4.0 * rate), fine, k=3)(clock))


def _knocks(
    scene: Scene, effects: PathEffects, clock: NDArray[np.float64], time: NDArray[np.float64]
) -> NDArray[np.float64]:
    """What rings (n,), with a peak of about 1, each time that a ball reaches the far edge."""
    cage = scene.cage_speed
    exits = [
        crossing.cage_angle / cage
        for crossing in crossings(scene, float(clock[0]) * cage, float(clock[-1]) * cage)
        if not crossing.enters
    ]
    begins = np.interp(exits, clock, time)
    omega = 2.0 * math.pi * effects.knock_frequency
    signal = np.zeros(len(time))
    for begin in begins.tolist():
        first = int(np.searchsorted(time, begin))
        last = min(len(time), first + int(12.0 / (effects.knock_damping * omega * time[1])))
        since = time[first:last] - begin
        signal[first:last] += np.exp(-effects.knock_damping * omega * since) * np.sin(omega * since)
    return signal


def _through(
    signal: NDArray[np.float64], rate: float, resonances: tuple[Resonance, ...]
) -> NDArray[np.float64]:
    """The signal (n, d) behind a path, each direction by its own gains."""
    count = len(signal)
    size = next_fast_len(count + round(0.2 * rate), real=True)
    frequency = np.asarray(np.fft.rfftfreq(size, 1.0 / rate), dtype=float)
    transform = np.fft.rfft(signal, size, axis=0)
    factor = np.ones(transform.shape, dtype=complex)
    for resonance in resonances:
        gains = [resonance.gain[k % len(resonance.gain)] for k in range(signal.shape[1])]
        factor += resonance.transfer(frequency)[:, None] * np.array(gains)
    return np.asarray(np.fft.irfft(transform * factor, size, axis=0)[:count])
