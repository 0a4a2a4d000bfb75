"""Signals of bearings on a shaft whose speed changes, made by closed forms: nothing is of the core.

Each passage of a ball is an instant at which the shaft has a certain angle, whatever the speed; a
structure rings from then on, at frequencies that the speed does not change.
"""

import math

import numpy as np
from numpy.typing import NDArray

TURN = 2.0 * math.pi
BALLS = {"6205": (9, 7.94 / 39.04), "6309": (8, 17.462 / 72.5)}
"""Number of balls, and their diameter over that of their pitch circle (catalogue)."""

CHANGES = ("steady", "2 %", "10 %", "rising by half")


def turns_at(change: str, time: NDArray, duration: float, mean: float) -> NDArray:
    """Turns of the shaft up to each time [s], as the integral of its speed [Hz] by hand."""
    if change == "rising by half":
        return mean * (0.8 * time + 0.2 * time**2 / duration)
    depth = {"steady": 0.0, "2 %": 0.02, "10 %": 0.1}[change]
    pace = TURN * 1.5 / duration
    return mean * (time + depth * (1.0 - np.cos(pace * time)) / pace)


def machine(
    bearing: str, part: str, change: str, seed: int, *, rpm: float = 1500.0, rate: float = 12_800.0
) -> tuple[NDArray, NDArray, NDArray]:
    """Times [s], acceleration and turns of the shaft (n,), over 4 s."""
    rng, duration = np.random.default_rng([2029, seed]), 4.0
    time = np.arange(round(rate * duration)) / rate
    turns = turns_at(change, time, duration, rpm / 60.0)
    balls, ratio = BALLS[bearing]
    order = 0.5 * balls * (1.0 - ratio if part == "outer race" else 1.0 + ratio)
    angle = np.arange(rng.uniform(), turns[-1] * order) / order
    angle += 0.005 * rng.standard_normal(len(angle)) / order
    blow = 1.0 + 0.2 * rng.standard_normal(len(angle))
    if part == "inner race":  # Stribeck's load zone, through which the shaft carries it
        blow *= np.maximum(0.0, np.cos(TURN * (angle + rng.uniform()))) ** 1.5
    at = np.interp(angle, turns, time)
    index = np.ceil(at * rate).astype(int)[:, None] + np.arange(round(0.01 * rate))
    short = index / rate - at[:, None]
    ring = sum(
        np.exp(-decay * short) * np.sin(TURN * frequency * short)
        for frequency, decay in ((3100.0, 800.0), (1750.0, 600.0))
    )
    kept = (index >= 0) & (index < len(time))
    ringing = np.bincount(index[kept], (blow[:, None] * ring)[kept], len(time))
    signal = rng.standard_normal(len(time)) + 1.4 * ringing / ringing.std()
    for multiple, height in ((1, 0.5), (2, 0.25), (3, 0.2)):
        signal += height * np.cos(TURN * (multiple * turns + rng.uniform()))
    return time, signal, turns
