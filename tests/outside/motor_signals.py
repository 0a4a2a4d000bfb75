"""Signals of a motor on a 6205, made by closed forms alone: nothing here is of the program.

A defect on a race rings a structure at each passage; beneath lie noise, the lines of the shaft and
what the mains make: tones at its multiples (hum), or noise that swells with the magnetic pull,
which is greatest twice a period of the mains.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

N_BALLS, RATIO = 9, 7.94 / 39.04
"""Balls of a 6205, and their diameter over that of their pitch circle (catalogue: 39.04 mm)."""

OUTER_ORDER = 0.5 * N_BALLS * (1.0 - RATIO)
INNER_ORDER = 0.5 * N_BALLS * (1.0 + RATIO)
TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Motor:
    """A motor, its bearing's damage and what its mains add.

    Attributes
    ----------
    rpm
        true speed.
    part
        "outer race", "inner race" or "" for a sound bearing.
    height
        of the ringing over the noise, as a ratio of root mean squares.
    slip
        of the cage, as a fraction.
    jitter
        of the passages, as a share of their distance.
    shaft_lines
        amplitudes of the shaft's first lines over the noise.
    hum
        frequency [Hz] and amplitude over the noise of tones.
    swell
        frequency [Hz] at which the noise swells, and by how much; `sharpness` makes it narrow.
    """

    rpm: float
    part: str = ""
    height: float = 1.0
    slip: float = 0.0
    jitter: float = 0.005
    shaft_lines: Sequence[float] = (0.5,)
    hum: Sequence[tuple[float, float]] = field(default=())
    swell: tuple[float, float] = (100.0, 0.0)
    sharpness: float = 4.0
    rate: float = 12_000.0
    duration: float = 4.0

    def signal(self, seed: int) -> NDArray[np.float64]:
        """Acceleration (n,), noise of deviation 1; hum adds to it and changes nothing else."""
        rng = np.random.default_rng([2960, seed])
        turns, count = self.rpm / 60.0, int(self.rate * self.duration)
        time = np.arange(count) / self.rate
        noise = rng.standard_normal(count)
        middle, depth = self.swell
        pull = np.cos(0.5 * TURN * middle * time + rng.uniform(0.0, TURN)) ** 2
        signal = noise * (1.0 - depth + depth * pull**self.sharpness)
        for order, height in enumerate(self.shaft_lines, start=1):
            signal += height * np.cos(TURN * order * turns * time + rng.uniform(0.0, TURN))
        ringing = self._ringing(time, turns, rng)
        if self.part:
            signal += self.height * ringing / ringing.std()
        for frequency, height in self.hum:
            signal += height * np.cos(TURN * frequency * time + rng.uniform(0.0, TURN))
        return signal

    def _ringing(
        self, time: NDArray[np.float64], turns: float, rng: np.random.Generator
    ) -> NDArray[np.float64]:
        """What the passages make ring, at two resonances."""
        order = OUTER_ORDER if self.part == "outer race" else INNER_ORDER
        step = 1.0 / (order * turns * (1.0 + self.slip))
        count = int(self.duration / step)
        at = (np.arange(count) + rng.uniform() + self.jitter * rng.standard_normal(count)) * step
        blow = 1.0 + 0.2 * rng.standard_normal(count)
        if self.part == "inner race":  # Stribeck's load zone, through which the shaft carries it
            blow *= np.maximum(0.0, np.cos(TURN * turns * at + rng.uniform(0.0, TURN))) ** 1.5
        # each rings from its own instant, between the samples: whole ones would fold lines back
        first = np.ceil(at * self.rate).astype(int)
        index = first[:, None] + np.arange(int(0.01 * self.rate))
        short = index / self.rate - at[:, None]
        ring = sum(
            np.exp(-decay * short) * np.sin(TURN * frequency * short)
            for frequency, decay in ((3200.0, 700.0), (1900.0, 500.0))
        )
        kept = (index >= 0) & (index < len(time))
        return np.bincount(index[kept], (blow[:, None] * ring)[kept], len(time))
