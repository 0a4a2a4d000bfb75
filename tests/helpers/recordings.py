"""Signals of damaged bearings: the package's own, and one that no code of the package made."""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import resample_poly

from bearingcore import Defect, Scene, contact_damping, presets, simulate

RIG = presets["fan-rig"]
RATE = 20_480.0


def signal_of(scene: Scene, duration: float = 1.0, start: float = 0.23) -> np.ndarray:
    motion = simulate(scene, duration + start, RATE)
    return motion.outer_acceleration[round(start * RATE) :]


def noisy(signal: np.ndarray, decibels: float, seed: int = 0) -> np.ndarray:
    level = math.sqrt(np.mean(signal**2)) * 10.0 ** (-decibels / 20.0)
    return signal + level * np.random.default_rng(seed).standard_normal(signal.shape)


def marched_elsewhere(scene: Scene, duration: float, rate: float) -> np.ndarray:
    """Housing acceleration (n, 2), by scipy's DOP853 and a right-hand side written for this test.

    Eqs. 18-23 with Eq. 19, radial, no code of the package but the numbers of the scene.
    """
    b, d, s = scene.bearing, scene.defect, scene.support
    assert isinstance(d, Defect)
    r_b, R_o = 0.5 * b.ball_diameter, b.outer_raceway_radius
    cage = 0.5 * scene.shaft_speed * (1.0 - b.ball_diameter / b.pitch_diameter)
    c = contact_damping(scene)
    force = np.array([scene.load.fx, scene.load.fy])
    k_o, c_o = np.array([s.stiffness_x, s.stiffness_y]), np.array([s.damping_x, s.damping_y])
    start = 2.0 * np.pi * np.arange(b.n_balls) / b.n_balls

    def drop(angle):
        """Eq. 6 as published, r_b read for r_b²."""
        from_middle = (angle - d.center + np.pi) % (2.0 * np.pi) - np.pi
        inside = 0.5 * d.extent - np.abs(from_middle)
        root = np.maximum(r_b**2 - 0.25 * (R_o * inside) ** 2, 0.0)
        fallen = np.where(root > 0.0, r_b - np.sqrt(root), np.inf)
        return np.where(inside > 0.0, np.minimum(fallen, d.depth), 0.0)

    def rates(t, y):
        inner, outer, v_inner, v_outer = y.reshape(4, 2)
        angle = start + cage * t
        along = np.array([np.cos(angle), np.sin(angle)])
        across = np.array([-along[1], along[0]])
        apart, v_apart = inner - outer, v_inner - v_outer
        delta = apart @ along - b.radial_clearance - drop(angle)
        step = 1e-6
        slope = (drop(angle + step) - drop(angle - step)) / (2.0 * step)
        closing = v_apart @ along + cage * (apart @ across) - cage * slope
        touching = delta > 0.0
        load = np.where(
            touching, b.load_deflection_factor * np.maximum(delta, 0.0) ** 1.5 + c * closing, 0.0
        )
        contact = along @ load
        return np.concatenate(
            [
                v_inner,
                v_outer,
                (force - contact) / s.inner_mass,
                (contact - k_o * outer - c_o * v_outer) / s.outer_mass,
            ]
        )

    settling = 0.15
    times = settling + np.arange(round(duration * rate)) / rate
    rest = force / k_o
    state = np.concatenate([rest, rest, np.zeros(4)])
    state[1] -= 8e-6  # in touch with the balls, about
    marched = solve_ivp(
        rates,
        (0.0, times[-1] + 1e-6),
        state,
        "DOP853",
        t_eval=times,
        rtol=1e-6,
        atol=1e-11,
        max_step=2e-4,
    )
    assert marched.success
    return np.array([rates(t, y)[6:] for t, y in zip(marched.t, marched.y.T, strict=True)])


@functools.cache
def file_from_elsewhere() -> tuple[Scene, bytes]:
    """A CSV file in g, with a clock 0.1 % off, offset, drift and hum, resampled; and its scene."""
    truth = RIG.replace(extent=math.radians(47.3), fy=-300.0, shaft_speed=2.0 * math.pi * 12.0)
    signal = marched_elsewhere(truth, 0.45, 16_000.0)
    signal = noisy(signal, 20.0)
    signal = resample_poly(signal, 6, 5, axis=0)
    rate = 16_000.0 * 6 / 5 * 1.001
    time = np.arange(len(signal)) / rate
    signal = signal / 9.80665 + 0.4 + 0.3 * time[:, None]
    signal += 0.05 * np.sin(2.0 * math.pi * 5.0 * time)[:, None]
    rows = [f"{t:.7f};{x:.6e};{y:.6e}" for t, (x, y) in zip(time, signal, strict=True)]
    return truth, ("time [s];horizontal;vertical\n" + "\n".join(rows)).encode()
