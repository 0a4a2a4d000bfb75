"""Simulated records: a motion with a wandering cage, a path to the sensor, knocks, tones and noise.

A simulated motion has a cage that turns steadily and a sensor on the housing itself. Real records
have neither. Each effect can be switched off, to find out which of them a method tolerates. The
effects are random, not derived: methods learned from such records must be tested on real ones.
"""

from __future__ import annotations

import math
import zlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, Progress, _checks as checks
from bearingcore.model.dynamics._motion import SETTLING, simulate
from bearingcore.model.scene import Scene
from bearingcore.model.statics import crossings, equilibrium
from bearingcore.recordings import Recording
from bearingcore.recordings._recording import DIRECTIONS

SLOWEST_WANDER = 0.3
"""Lowest frequency [Hz] at which the cage speed wanders; the highest is that of the cage."""

WANDERS = 6
"""Number of sines in a wandering speed."""

_BACKGROUND = (math.log(1.0), math.log(10.0))
"""Logarithms of the least and greatest random background [m/s²]."""

TONES = 6
"""Number of harmonics of the shaft; their amplitudes are 1, 1/2, 1/3 … of the first."""


@dataclass(frozen=True)
class Resonance:
    """A resonance of the path from the housing to the sensor."""

    frequency: float
    """[Hz]"""
    damping: float
    """damping ratio"""
    gain: tuple[float, ...]
    """amplitude added at its peak, along each direction, to the 1 of the direct path"""

    def transfer(self, frequency: Array) -> NDArray[np.complex128]:
        """Return the amplitude (n,) at frequencies [Hz] for a gain of 1: 2iζr/(1 − r² + 2iζr)."""
        r = frequency / self.frequency
        return np.asarray(2j * self.damping * r / (1.0 - r**2 + 2j * self.damping * r))


TWO_RESONANCES = (Resonance(950.0, 0.04, (2.0, -1.5)), Resonance(2100.0, 0.03, (-1.0, 2.0)))


def drawn_resonances(rng: np.random.Generator) -> tuple[Resonance, ...]:
    """Draw a low and a high resonance with random gains along x and y."""
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
    """Effects added to a simulated motion; 0, () or None switches one off.

    Attributes
    ----------
    cage_wander
        standard deviation of the cage's speed, as a share of it.
    resonances
        resonances of the path between housing and sensor.
    knock, knock_frequency, knock_damping
        peak of the ringing after a ball strikes the far edge, over the peak of the motion; its
        frequency [Hz] and damping ratio. On inner races the peak is proportional to the load there.
    shaft_tones
        root mean square of the shaft's first harmonic, relative to that of the signal.
    noise
        level [dB] of the power of pink noise below that of the signal; None for no noise.
    background
        root mean square [m/s²] of pink noise of the machine, which does not depend on the bearing.
        A healthy bearing of this model is far quieter than any machine.
    """

    cage_wander: float = 0.004
    resonances: tuple[Resonance, ...] = TWO_RESONANCES
    knock: float = 3.0
    knock_frequency: float = 4700.0
    knock_damping: float = 0.04
    shaft_tones: float = 0.3
    noise: float | None = 20.0
    background: float = 0.0


def simulated_record(
    scene: Scene,
    effects: PathEffects | None = None,
    duration: float = 1.4,
    sample_rate: float = 20_480.0,
    *,
    seed: int | None = None,
    progress: Progress | None = None,
) -> Recording:
    """Simulate the record of a real sensor in a scene, for learning and trials.

    The record contains the motion of the housing, a path with resonances, a wandering cage, tones
    of the shaft and noise. The clock of the steady motion is varied to make the cage wander. This
    varies natural frequencies by the same few thousandths, which is too little to notice.

    Parameters
    ----------
    scene
        the scene, with a defect or healthy.
    effects
        see `PathEffects`; None draws random resonances of the path, and a background between 1 and
        10 m/s².
    duration, sample_rate
        [s], [Hz].
    seed
        seed of the random numbers. None makes a seed from the scene, so that equal scenes give
        equal records.
    progress
        see `simulate`.

    Raises
    ------
    ValueError
        if the motion cannot be computed, with the reason.
    """
    from scipy.interpolate import make_interp_spline  # imported late: see `spectrum`
    from scipy.signal import resample_poly

    checks.instance("scene", scene, Scene)
    duration = checks.real_number("duration", duration, above=0.0, unit="s")
    seed = zlib.crc32(scene.to_toml().encode()) if seed is None else seed
    rng = np.random.default_rng(seed)
    if effects is None:
        resonances, background = drawn_resonances(rng), math.exp(rng.uniform(*_BACKGROUND))
        effects = PathEffects(resonances=resonances, background=background)
    start = SETTLING + float(rng.uniform(0.05, 0.25))
    motion = simulate(scene, start + 1.02 * duration + 0.05, sample_rate, progress=progress)
    if not motion.completed:
        raise checks.refuse("scene", motion.reason, "one whose motion can be computed")
    directions = tuple(name for name in DIRECTIONS if name in motion.dofs)
    columns = [motion.dofs.index(name) for name in directions]
    count = round(duration * sample_rate)
    time = np.arange(count) / sample_rate
    clock = start + wandering_clock(time, effects.cage_wander, scene, rng)
    # the motion at the times of the wandering clock, by a spline through finer samples
    fine = resample_poly(motion.outer_acceleration[:, columns], 4, 1, axis=0)
    spline = make_interp_spline(np.arange(len(fine)) / (4.0 * sample_rate), fine, k=3)
    signal = np.asarray(spline(clock))
    if effects.knock > 0.0 and scene.defects:
        peak = float(np.abs(signal).max())
        signal = signal + effects.knock * peak * _knocks(scene, effects, clock, time, directions)
    if effects.resonances:
        signal = _filter_by_path(signal, sample_rate, effects.resonances)
    if effects.background > 0.0:
        signal = signal + effects.background * pink_noise(count, len(directions), rng)
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
    return Recording(signal, sample_rate, directions, "simulated, along a path", scene.shaft_speed)


def wandering_clock(time: Array, wander: float, scene: Scene, rng: np.random.Generator) -> Array:
    """Return the times (n,) [s] at which a steady cage has the angles of a wandering one at `time`.

    The change of speed is a sum of slow sines, with a standard deviation `wander` over the record.
    """
    fastest = max(scene.cage_speed / (2.0 * math.pi), 1.5 * SLOWEST_WANDER)
    speed = np.zeros(len(time))
    for frequency in rng.uniform(SLOWEST_WANDER, fastest, WANDERS):
        speed += np.cos(2.0 * math.pi * frequency * time + rng.uniform(0.0, 2.0 * math.pi))
    speed -= speed.mean()
    speed *= wander / max(float(speed.std()), 1e-300)
    return np.asarray(time + np.concatenate(([0.0], np.cumsum(speed[:-1]) * (time[1] - time[0]))))


def pink_noise(count: int, columns: int, rng: np.random.Generator) -> Array:
    """Return noise (count, columns) of standard deviation 1 whose power falls as 1/frequency."""
    transform = np.fft.rfft(rng.standard_normal((count, columns)), axis=0)
    number = np.arange(len(transform), dtype=float)
    number[0] = math.inf
    noise = np.fft.irfft(transform / np.sqrt(number)[:, None], count, axis=0)
    return np.asarray(noise / noise.std(axis=0))


def _knocks(
    scene: Scene, effects: PathEffects, clock: Array, time: Array, directions: tuple[str, ...]
) -> Array:
    """Return ringing (n, d) with a peak of about 1 each time that a ball reaches the far edge."""
    cage, ratio = scene.cage_speed, scene.bearing.cage_ratio
    exits = [
        (crossing.cage_angle, scene.defects[crossing.defect])
        for crossing in crossings(scene, float(clock[0]) * cage, float(clock[-1]) * cage)
        if not crossing.enters
    ]
    begins = np.interp([angle / cage for angle, _ in exits], clock, time)
    turns = [angle / ratio if defect.race == "inner" else 0.0 for angle, defect in exits]
    places = np.array([defect.center for _, defect in exits]) + turns
    inner = np.array([defect.race == "inner" for _, defect in exits], dtype=bool)
    strength = np.where(inner, _load_at(scene, places) if inner.any() else 1.0, 1.0)
    # a sensor across the radius of the defect measures a part of the blow too
    along = np.stack([np.cos(places) if name == "x" else np.sin(places) for name in directions], 1)
    measured = np.where(np.abs(along) < 0.3, 0.3, along) * strength[:, None]
    omega = 2.0 * math.pi * effects.knock_frequency
    signal = np.zeros((len(time), len(directions)))
    for begin, amplitude in zip(begins.tolist(), measured, strict=True):
        first = int(np.searchsorted(time, begin))
        last = min(len(time), first + int(12.0 / (effects.knock_damping * omega * time[1])))
        since = time[first:last] - begin
        ring = np.exp(-effects.knock_damping * omega * since) * np.sin(omega * since)
        signal[first:last] += ring[:, None] * amplitude
    return signal


def _load_at(scene: Scene, places: Array) -> Array:
    """Return the load of a ball of the healthy bearing at angles [rad], over the greatest load."""
    state = equilibrium(scene.healthy())
    angle, load = state.ball_angle.ravel(), np.nan_to_num(state.ball_load.ravel())
    order = np.argsort(angle)
    share = load[order] / max(float(load.max()), 1e-300)
    return np.interp(places % (2.0 * math.pi), angle[order], share, period=2.0 * math.pi)


def _filter_by_path(signal: Array, rate: float, resonances: tuple[Resonance, ...]) -> Array:
    """Return the signal (n, d) behind a path; each direction has its gains."""
    from scipy.fft import next_fast_len  # imported late: see `spectrum`

    count = len(signal)
    size = next_fast_len(count + round(0.2 * rate), real=True)
    frequency = np.asarray(np.fft.rfftfreq(size, 1.0 / rate), dtype=float)
    transform = np.fft.rfft(signal, size, axis=0)
    factor = np.ones(transform.shape, dtype=complex)
    for resonance in resonances:
        gains = [resonance.gain[k % len(resonance.gain)] for k in range(signal.shape[1])]
        factor += resonance.transfer(frequency)[:, None] * np.array(gains)
    return np.asarray(np.fft.irfft(transform * factor, size, axis=0)[:count])
