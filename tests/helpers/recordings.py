"""Signals of damaged bearings: the package's own, and one that no code of the package made."""

import functools
import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import resample_poly

from bearingcore import Defect, Scene, contact_damping, presets, simulate
from tests.outside.test_charts import problem

RIG = presets["fan-rig"]
Array = NDArray[np.floating]
RATE = 20_480.0


def signal_of(scene: Scene, duration: float = 1.0, start: float = 0.23) -> np.ndarray:
    motion = simulate(scene, duration + start, RATE)
    return motion.outer_acceleration[round(start * RATE) :]


def noisy(signal: np.ndarray, decibels: float, seed: int = 0) -> np.ndarray:
    level = math.sqrt(np.mean(signal**2)) * 10.0 ** (-decibels / 20.0)
    return signal + level * np.random.default_rng(seed).standard_normal(signal.shape)


def contacts(scene: Scene, c: float, time: float, x: Array, v: Array) -> tuple[Array, Array, Array]:
    """Load K δ^1.5 and damping c δ̇ (N_b,) of touching balls [N], and their rays (N_b, 2).

    Eqs. 18 and 19, radial, with no code of the package but the numbers of the scene; edges as
    published. x, v (2,): displacement [m] and velocity [m/s] of the inner ring against the outer.
    """
    b, d = scene.bearing, scene.defect
    assert isinstance(d, Defect)
    r_b, R_o = 0.5 * b.ball_diameter, b.outer_raceway_radius
    turn = 0.5 * scene.shaft_speed * (1.0 - b.ball_diameter / b.pitch_diameter)
    phi = turn * time + 2.0 * np.pi * np.arange(b.n_balls) / b.n_balls
    rays = np.stack([np.cos(phi), np.sin(phi)], axis=1)

    def drop(angle: Array) -> Array:
        """Eq. 6 as published, r_b read for r_b²."""
        from_middle = (angle - d.center + np.pi) % (2.0 * np.pi) - np.pi
        inside = 0.5 * d.extent - np.abs(from_middle)
        root = np.maximum(r_b**2 - 0.25 * (R_o * inside) ** 2, 0.0)
        fallen = np.where(root > 0.0, r_b - np.sqrt(root), np.inf)
        return np.where(inside > 0.0, np.minimum(fallen, d.depth), 0.0)

    step = 1e-6
    slope = (drop(phi + step) - drop(phi - step)) / (2.0 * step)
    delta = rays @ x - b.radial_clearance - drop(phi)
    rate = rays @ v + turn * (rays @ [[0.0, 1.0], [-1.0, 0.0]] @ x - slope)
    elastic = b.load_deflection_factor * np.maximum(delta, 0.0) ** 1.5
    return elastic, np.where(delta > 0.0, c * rate, 0.0), rays


def marched_elsewhere(
    scene: Scene, time: Array, state: Array, method: str, **limits: float
) -> Array:
    """Housing acceleration (n, 2) [m/s²] at times [s] from a state (8,), by scipy's `solve_ivp`."""
    support, load = scene.support, scene.load.vector[:2]
    k_o = np.array([support.stiffness_x, support.stiffness_y])
    c_o = np.array([support.damping_x, support.damping_y])
    c = contact_damping(scene)

    def rates(t: float, y: Array) -> Array:
        inner, outer, v_inner, v_outer = y.reshape(4, 2)
        elastic, viscous, rays = contacts(scene, c, t, inner - outer, v_inner - v_outer)
        force = rays.T @ (elastic + viscous)
        ground = k_o * outer + c_o * v_outer
        rings = (load - force) / support.inner_mass, (force - ground) / support.outer_mass
        return np.concatenate([v_inner, v_outer, *rings])

    marched = solve_ivp(rates, (0.0, time[-1] + 1e-6), state, method, time, **limits)
    assert marched.success
    return np.array([rates(t, y)[6:] for t, y in zip(marched.t, marched.y.T, strict=True)])


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
