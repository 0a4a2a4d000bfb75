"""Steps that choose themselves, for contacts whose force jumps as they touch."""

from __future__ import annotations

import math

import numpy as np

from bearingcore.kernels.compiling import compiled
from bearingcore.kernels.motion.march import new_forces, rates_at
from bearingcore.kernels.path import new_passage

# Dormand & Prince 5(4): stages, their times, and the difference of the two orders.
PAIR_STAGES = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
        [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
        [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
        [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
        [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ]
)
PAIR_TIMES = np.array([0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0])
PAIR_ERROR = np.array(
    [
        -71.0 / 57600.0,
        0.0,
        71.0 / 16695.0,
        -71.0 / 1920.0,
        17253.0 / 339200.0,
        -22.0 / 525.0,
        1.0 / 40.0,
    ]
)


@compiled
def interpolate_step(history, row, part, h, y0, k0, y1, k1):
    """A row of a history, `part` of the step h after y0: quintic in x, v, a of both ends."""
    u = part
    n = y0.size // 4
    for body in range(2):
        for a in range(n):
            i = 2 * body * n + a
            x0 = y0[i]
            v0 = h * y0[n + i]
            a0 = 0.5 * h * h * k0[n + i]
            rise = y1[i] - x0 - v0 - a0
            speed = h * y1[n + i] - v0 - 2.0 * a0
            bend = 0.5 * h * h * k1[n + i] - a0
            c3 = 10.0 * rise - 4.0 * speed + bend
            c4 = -15.0 * rise + 7.0 * speed - 2.0 * bend
            c5 = 6.0 * rise - 3.0 * speed + bend
            history[row, 3 * body, a] = x0 + u * (v0 + u * (a0 + u * (c3 + u * (c4 + u * c5))))
            history[row, 3 * body + 1, a] = (
                v0 + u * (2.0 * a0 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))
            ) / h
            history[row, 3 * body + 2, a] = (
                2.0 * a0 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))
            ) / (h * h)


@compiled
def march_adaptive(y, adaptive, start_angle, system, history):
    """Dormand and Prince's embedded pair of orders 5 and 4 from y (4 n,), which is moved.

    The rotor marches velocities. history (samples, 6, n) is filled every `sample_step` [s] between
    steps. Returns (samples filled, steps, refused steps, right-hand-side calls).
    """
    size = y.size
    n_contacts = system.contacts.angle.size
    passage = new_passage(1, n_contacts)
    work = new_forces(n_contacts)
    k = np.zeros((7, size))
    trial = np.zeros(size)
    w = system.rotor.cage_speed
    sample_step = adaptive.sample_step
    scale = adaptive.scale
    stops = adaptive.stops
    n_samples = history.shape[0]
    end = (n_samples - 1) * sample_step
    t = 0.0
    h = 1e-3 * sample_step  # short enough; steps grow by up to five times
    norm_before = 1.0
    first = 0  # the first stage to compute: the last one of a step is the first of the next
    refused_last = False
    stop = 0
    sample = 0
    steps = 0
    refused = 0
    calls = 0
    while True:
        while stop < stops.size and stops[stop] <= t:
            stop += 1
        target = min(stops[stop], end) if stop < stops.size else end
        last = h >= 0.999999 * (target - t)
        taken = target - t if last else h
        for stage in range(first, 7):
            for r in range(size):
                total = 0.0
                for i in range(stage):
                    total += PAIR_STAGES[stage, i] * k[i, r]
                trial[r] = y[r] + taken * total
            angle = start_angle + w * (t + PAIR_TIMES[stage] * taken)
            rates_at(angle, trial, k[stage], system, passage, work)
            calls += 1
        first = 1
        total = 0.0
        for r in range(size):
            e = 0.0
            for i in range(7):
                e += PAIR_ERROR[i] * k[i, r]
            total += (taken * e / scale[r]) ** 2
        norm = math.sqrt(total / size) / adaptive.tolerance
        if not math.isfinite(norm) or calls > adaptive.most_calls or t + 0.1 * taken == t:
            return sample, steps, refused, calls
        if norm > 1.0:
            refused += 1
            refused_last = True
            h = taken * max(0.1, 0.9 * norm**-0.2)
            continue
        steps += 1
        ends = last and target == end
        while sample < n_samples and (ends or sample * sample_step <= t + taken):
            part = min((sample * sample_step - t) / taken, 1.0)
            interpolate_step(history, sample, part, taken, y, k[0], trial, k[6])
            sample += 1
        t = target if last else t + taken
        for r in range(size):
            y[r] = trial[r]
            k[0, r] = k[6, r]
        if sample >= n_samples:
            return sample, steps, refused, calls
        norm = max(norm, 1e-4)
        grown = taken * min(5.0, max(0.2, 0.9 * norm**-0.14 * norm_before**0.08))
        h = max(h, grown) if last else min(grown, taken) if refused_last else grown
        refused_last = False
        norm_before = norm
