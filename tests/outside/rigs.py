"""Vibration of two rigs with a spall, by a program that shares no line and no number with ours.

The motion is that of `march.py`; the rigs' numbers are those printed in the paper and with the
bearing data of Case Western Reserve University; what a sensor adds is drawn by seed.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.signal import resample_poly

from tests.outside.elements import Array, Defect, Rows, point_contact
from tests.outside.march import Problem, by_runge_kutta

STEPS = 65_536
"""A second, of the integrator."""

RATE = STEPS * 2 / 5
"""[Hz] of the records."""

SETTLING = 0.3
"""[s] of motion that are left out."""


class Rig(NamedTuple):
    """Bearing and spall of a machine whose two bodies of 2 kg are those of Table 1."""

    balls: int
    ball: float
    pitch: float
    K: float
    clearance: float
    depth: float


def _6205() -> Rig:
    D, Dp = 7.94e-3, 39.04e-3
    inner = point_contact(D, -1.0 / (0.52 * D), 2.0 / (Dp - D))[0]
    outer = point_contact(D, -1.0 / (0.53 * D), -2.0 / (Dp + D))[0]
    K = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
    return Rig(9, D, Dp, K, 5e-6, 0.279e-3)


RIGS = {"fan-rig": Rig(14, 8e-3, 45e-3, 5453e6, 3e-6, 50e-6), "6205": _6205()}


@dataclass(frozen=True)
class Machine:
    """A rig in motion: extent [rad], speed [rad/s], load [N] down, and what differs in it."""

    extent: float
    speed: float
    load: float
    rig: str = "fan-rig"
    inner: bool = False
    edge: str = "published"
    depth: float = 0.0
    """[m]; 0: that of the rig"""
    support: float = 1.0
    """times the stiffness of Table 1"""
    contact_damping: float = 1.0
    """times 1e-5 s"""
    spalls: int = 1
    """that touch, in the extent"""

    @property
    def cage(self) -> float:
        """[rad/s]"""
        one = RIGS[self.rig]
        return 0.5 * self.speed * (1.0 - one.ball / one.pitch)

    def problem(self) -> Problem:
        """The machine for `march.py`."""
        one = RIGS[self.rig]
        race = 0.5 * (one.pitch - one.ball if self.inner else one.pitch + one.ball)
        hurt = Defect(self.extent, self.depth or one.depth, race, self.edge, inner=self.inner)
        rows = Rows(
            one.balls, one.ball, 0.0, 0.5 * one.pitch, math.inf, one.clearance, (one.K, 1.5)
        )
        force = np.array([0.0, -self.load, 0.0, 0.0, 0.0])
        turn = np.linspace(0.0, 2.0 * math.pi / one.balls, 40, endpoint=False)
        _, loads, k = rows.states(force, turn, [0, 1])
        loaded = (loads > 0.0).sum(axis=1).mean()
        c = 1e-5 * self.contact_damping * (k[:, 0, 0] + k[:, 1, 1]).mean() / loaded
        both = np.ones(2)
        return Problem(
            replace(rows, defect=hurt), force, (0, 1), 2.0 * both, 212.2e6 * self.support * both,
            1648.2 * both, self.cage, c, shaft=self.speed, spalls=self.spalls,
        )  # fmt: skip

    def vibration(self, duration: float) -> Array:
        """Acceleration (n, 2) [m/s²] of the housing at `RATE`, settled."""
        problem = self.problem()
        steps = round((duration + SETTLING) * STEPS)
        signal = by_runge_kutta(problem.start(), 1.0 / STEPS, steps, 1, *problem.packed())
        return resample_poly(signal[round(SETTLING * STEPS) :], 2, 5, axis=0)

    def leaving(self, duration: float) -> Array:
        """Times [s] at which balls leave the spall, from the start of `vibration`."""
        turns = (self.cage - self.speed if self.inner else self.cage) / (2.0 * math.pi)
        edge = 0.75 + math.copysign(0.5 * self.extent, turns) / (2.0 * math.pi)
        balls = np.arange(RIGS[self.rig].balls) / RIGS[self.rig].balls
        rounds = np.arange(-2, math.ceil(abs(turns) * (duration + SETTLING)) + 3)
        times = (edge - balls[:, None] + np.sign(turns) * rounds) / turns - SETTLING
        return np.sort(times[(times > 0.0) & (times < duration)])


def record(machine: Machine, duration: float, seed: int, disturbed: tuple[str, ...] = ()) -> Array:
    """A record (n, 2) at `RATE`: noise and tones 20 dB below, and the other disturbances named.

    `wander`: the cage's speed by 0.4 %; `path`: two resonances felt differently along x and y;
    `knocks`: ringing at 4.7 kHz, three times the peak, as a ball leaves.
    """
    rng = np.random.default_rng(seed)
    signal = machine.vibration(duration + 0.05)
    time = np.arange(len(signal)) / RATE
    if "knocks" in disturbed:
        peak = 3.0 * np.abs(signal).max(axis=0)
        for begin in machine.leaving(duration):
            late = time - begin
            near = (late >= 0.0) & (late < 0.01)
            ring = np.exp(-0.04 * 2.0 * math.pi * 4700.0 * late[near])
            ring *= np.sin(2.0 * math.pi * 4700.0 * late[near])
            signal[near] += ring[:, None] * peak * rng.normal(1.0, 0.1)
    if "wander" in disturbed:
        turns = machine.cage / (2.0 * math.pi)
        waves = rng.uniform(0.3, turns, 6)
        swing = sum(np.sin(2.0 * math.pi * (f * time + rng.uniform())) for f in waves)
        clock = np.cumsum(1.0 + 0.004 * swing / math.sqrt(3.0)) / RATE
        fine = resample_poly(signal, 4, 1, axis=0)
        at = np.arange(len(fine)) / (4.0 * RATE)
        signal = np.stack([np.interp(clock, at, one) for one in fine.T], axis=1)
    if "path" in disturbed:
        frequency = np.fft.rfftfreq(len(signal), 1.0 / RATE)
        factor = np.ones((len(frequency), 2), dtype=complex)
        for low, high in ((500.0, 1400.0), (1400.0, 3500.0)):
            r = frequency / math.exp(rng.uniform(math.log(low), math.log(high)))
            damped = 2j * rng.uniform(0.02, 0.06) * r
            gains = rng.uniform(0.5, 3.0, 2) * rng.choice([-1.0, 1.0], 2)
            factor += (damped / (1.0 - r**2 + damped))[:, None] * gains
        signal = np.fft.irfft(np.fft.rfft(signal, axis=0) * factor, len(signal), axis=0)
    if "noise" in disturbed:
        level = math.sqrt(np.mean(signal**2))
        for order in range(1, 5):
            angle = order * machine.speed * time + rng.uniform(0.0, 2.0 * math.pi)
            signal += 0.3 * level / order * np.sin(angle)[:, None]
        white = np.fft.rfft(rng.standard_normal(signal.shape), axis=0)
        pink = white[1:] / np.sqrt(np.arange(1, len(white)))[:, None]
        pink = np.fft.irfft(np.concatenate([0.0 * white[:1], pink]), len(signal), axis=0)
        signal += 0.1 * level * pink / math.sqrt(np.mean(pink**2))
    return signal[: round(duration * RATE)]
