"""Signals of bearings, healthy and damaged, made without the project's model.

Knocks at jittered times make resonances ring and pass through the load zone; beneath lie coloured
noise, the shaft's lines, a gear mesh with sidebands, mains tones and tones on and beside the
bearing's own lines. Frequencies are written out here once more: a method is never its own
reference.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve

from bearingcore import Bearing

PARTS = ("outer race", "inner race", "ball")

Rng = np.random.Generator


@dataclass(frozen=True)
class Machine:
    """A bearing, its speed and how it is measured."""

    n_balls: int
    ratio: float
    """Ball over pitch diameter, times the cosine of the contact angle."""
    turns: float
    """Turns of the shaft a second [Hz]."""
    rate: float
    duration: float

    @property
    def bearing(self) -> Bearing:
        """The bearing as the project describes it."""
        ball = 40e-3 * self.ratio
        return Bearing.from_drawing(
            self.n_balls, ball, 40e-3, 0.52 * ball, 0.53 * ball, contact_angle=0.0
        )

    @property
    def shaft_speed(self) -> float:
        """[rad/s]"""
        return 2.0 * math.pi * self.turns

    @property
    def cage(self) -> float:
        """Turns of the cage a second [Hz]."""
        return 0.5 * self.turns * (1.0 - self.ratio)

    @property
    def lines(self) -> dict[str, float]:
        """First line of each part [Hz]."""
        return {
            "outer race": 0.5 * self.n_balls * self.turns * (1.0 - self.ratio),
            "inner race": 0.5 * self.n_balls * self.turns * (1.0 + self.ratio),
            "ball": self.turns * (1.0 - self.ratio**2) / self.ratio,
        }


def knock_times(
    frequency: float, duration: float, rng: Rng, wander: float, jitter: float
) -> NDArray[np.float64]:
    """Times [s] of knocks whose rate wanders slowly and whose steps jitter, both as shares."""
    count = int(duration * frequency * 1.1) + 4
    slow = np.cumsum(rng.standard_normal(count))
    slow = np.convolve(slow, np.ones(31) / 31.0, "same")
    slow = slow - slow.mean()
    slow *= wander / max(float(slow.std()), 1e-12)
    steps = (1.0 + slow) / frequency
    times = np.cumsum(steps) + jitter / frequency * rng.standard_normal(count)
    times += rng.uniform(0.0, 1.0 / frequency)
    return times[(times > 0.0) & (times < duration)]


def resonances(rate: float, rng: Rng) -> NDArray[np.float64]:
    """Ringing of one knock: up to three modes of structure and path."""
    time = np.arange(int(0.02 * rate)) / rate
    ring = np.zeros(len(time))
    for _ in range(int(rng.integers(1, 4))):
        frequency = math.exp(rng.uniform(math.log(800.0), math.log(0.42 * rate)))
        damping = rng.uniform(0.01, 0.06) * 2.0 * math.pi * frequency
        ring += (
            rng.uniform(0.3, 1.0)
            * np.exp(-damping * time)
            * np.sin(2.0 * math.pi * frequency * time + rng.uniform(0.0, 6.28))
        )
    return ring


def load_zone(angle: NDArray[np.float64], half_width: float) -> NDArray[np.float64]:
    """Load at an angle [rad] from the middle of the load zone, as Stribeck has it."""
    away = np.angle(np.exp(1j * angle))
    return np.maximum(0.0, 1.0 - (1.0 - np.cos(away)) / (1.0 - math.cos(half_width))) ** 1.1


def knocks(machine: Machine, part: str, rng: Rng) -> NDArray[np.float64]:
    """The signal of a damaged part alone."""
    slip = rng.uniform(-0.01, 0.01)
    wander, jitter = rng.uniform(0.0, 0.003), rng.uniform(0.0, 0.015)
    half_width = rng.uniform(1.0, 1.9)
    frequency = machine.lines[part] * (1.0 + slip)
    times = knock_times(frequency, machine.duration, rng, wander, jitter)
    strength = 1.0 + rng.uniform(0.0, 0.4) * rng.standard_normal(len(times))
    start = rng.uniform(0.0, 6.28)
    if part == "inner race":
        strength = strength * load_zone(2.0 * math.pi * machine.turns * times + start, half_width)
    elif part == "ball":  # strikes on outer and inner race in turn, not equally hard
        cage = machine.cage * (1.0 + slip)
        strength = strength * load_zone(2.0 * math.pi * cage * times + start, half_width)
        strength[1::2] *= rng.uniform(0.5, 1.0)
    else:  # the load swings a little with the shaft's unbalance
        strength = strength * (
            1.0 + rng.uniform(0.0, 0.3) * np.cos(2.0 * math.pi * machine.turns * times + start)
        )
    count = int(machine.duration * machine.rate)
    train = np.zeros(count + 1)
    place = times * machine.rate
    index = np.minimum(place.astype(int), count - 1)
    share = place - index
    np.add.at(train, index, strength * (1.0 - share))
    np.add.at(train, index + 1, strength * share)
    return fftconvolve(train, resonances(machine.rate, rng))[:count]


def coloured_noise(count: int, rate: float, rng: Rng) -> NDArray[np.float64]:
    """Noise whose power falls with frequency by any slope, with humps, deviation 1."""
    frequency = np.fft.rfftfreq(count, 1.0 / rate)
    frequency[0] = frequency[1]
    shape = frequency ** (-0.5 * rng.uniform(0.0, 2.0))
    for _ in range(int(rng.integers(0, 4))):
        middle = rng.uniform(300.0, 0.45 * rate)
        width = rng.uniform(0.02, 0.1) * middle
        shape *= 1.0 + rng.uniform(1.0, 10.0) / (1.0 + ((frequency - middle) / width) ** 2)
    noise = np.fft.irfft(np.fft.rfft(rng.standard_normal(count)) * shape, count)
    return noise / noise.std()


def tone(
    time: NDArray[np.float64], frequency: float, rng: Rng, strength: float
) -> NDArray[np.float64]:
    """A steady tone of a root mean square."""
    phase = 2.0 * math.pi * frequency * time + rng.uniform(0.0, 6.28)
    return strength * math.sqrt(2.0) * np.cos(phase)


def background(machine: Machine, rng: Rng) -> NDArray[np.float64]:
    """Vibration of a healthy machine: noise of deviation about 1, and tones."""
    count = int(machine.duration * machine.rate)
    time = np.arange(count) / machine.rate
    signal = coloured_noise(count, machine.rate, rng)
    if rng.random() < 0.3:  # a fan's or pump's noise swells as its blades pass
        blades = int(rng.integers(1, 8))
        swell = rng.uniform(0.1, 0.6)
        signal *= 1.0 + swell * np.cos(2.0 * math.pi * blades * machine.turns * time)
    for order in range(1, int(rng.integers(2, 8))):
        signal += tone(time, order * machine.turns, rng, rng.exponential(0.4))
    if rng.random() < 0.5:  # a gear's mesh, swelling once a turn
        teeth = int(rng.integers(13, 60))
        for multiple in (1, 2, 3):
            middle = multiple * teeth * machine.turns
            if middle > 0.4 * machine.rate:
                break
            strength = rng.exponential(0.5) / multiple
            signal += tone(time, middle, rng, strength)
            for side in (-2, -1, 1, 2):
                signal += tone(time, middle + side * machine.turns, rng, 0.3 * strength)
    mains = float(rng.choice([50.0, 60.0]))
    for multiple in (1, 2, 6):
        signal += tone(time, multiple * mains, rng, rng.exponential(0.2))
    for line in machine.lines.values():  # tones that happen to lie on or beside the lines
        for multiple in (1, 2, 3):
            if rng.random() < 0.3:
                near = multiple * line * (1.0 + rng.choice([0.0, rng.uniform(-0.03, 0.03)]))
                signal += tone(time, near, rng, rng.exponential(0.3))
    if rng.random() < 0.2:  # blows that do not repeat
        blows = np.zeros(count)
        blows[rng.integers(0, count, int(rng.integers(2, 40)))] = rng.uniform(3.0, 20.0)
        signal += fftconvolve(blows, resonances(machine.rate, rng))[:count]
    return signal
