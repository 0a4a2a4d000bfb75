"""Signals of damaged bearings: the package's own, and one that no code of the package made."""

import functools
import math
from dataclasses import replace

import numpy as np
from scipy.signal import resample_poly

from bearingcore import Scene, contact_damping, presets, simulate
from tests.outside.test_charts import problem

RIG = presets["fan-rig"]
RATE = 20_480.0


def signal_of(scene: Scene, duration: float = 1.0, start: float = 0.23) -> np.ndarray:
    motion = simulate(scene, duration + start, RATE)
    return motion.outer_acceleration[round(start * RATE) :]


def noisy(signal: np.ndarray, decibels: float, seed: int = 0) -> np.ndarray:
    level = math.sqrt(np.mean(signal**2)) * 10.0 ** (-decibels / 20.0)
    return signal + level * np.random.default_rng(seed).standard_normal(signal.shape)


@functools.cache
def file_from_elsewhere() -> tuple[Scene, bytes]:
    """A CSV file in g, with a clock 0.1 % off, offset, drift and hum, resampled; and its scene."""
    truth = RIG.replace(extent=math.radians(47.3), fy=-300.0, shaft_speed=2.0 * math.pi * 12.0)
    rig = problem("fan-rig", shaft=truth.shaft_speed)
    hurt = replace(rig.rows.defect, extent=math.radians(47.3))
    rig = replace(
        rig, rows=replace(rig.rows, defect=hurt), force=truth.load.vector, c=contact_damping(truth)
    )
    time = np.arange(round(1.25 * 16_000.0)) / 16_000.0
    signal = rig.accelerations(time, rig.solved(rig.start(), time, 1e-7))
    signal = signal[round(0.15 * 16_000.0) :, :2]  # after its transient
    signal = noisy(signal, 20.0)
    signal = resample_poly(signal, 6, 5, axis=0)
    rate = 16_000.0 * 6 / 5 * 1.001
    time = np.arange(len(signal)) / rate
    signal = signal / 9.80665 + 0.4 + 0.3 * time[:, None]
    signal += 0.05 * np.sin(2.0 * math.pi * 5.0 * time)[:, None]
    rows = [f"{t:.7f};{x:.6e};{y:.6e}" for t, (x, y) in zip(time, signal, strict=True)]
    return truth, ("time [s];horizontal;vertical\n" + "\n".join(rows)).encode()
