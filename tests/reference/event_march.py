"""March a system whose right-hand side jumps at events, by two families of integrators.

At an event the solver stops and a fresh one starts, so that each integrates smooth pieces only.
Known events are times; found ones are zeros of one indicator a ball, which says whether the ball
presses (positive) or not. A system is as `make_motion_reference.General`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.signal import welch

SAMPLE_RATE = 65536.0


@dataclass
class Trace:
    """What an integration says at 65,536 Hz, SI units."""

    state: np.ndarray
    """(n, 4 times the free directions): inner and outer displacement, inner and outer velocity."""
    acceleration: np.ndarray
    """(n, free directions) of the outer ring."""
    events: int


def integrate(solver: Any, system: Any, duration: float, tolerance: float) -> Trace:
    """March from event to event."""
    count = round(duration * SAMPLE_RATE) + 1
    grid = np.arange(count) / SAMPLE_RATE
    size = len(system.scale)
    free = size // 4
    states, accelerations = np.empty((count, size)), np.empty((count, free))
    stops = [*system.known_events(float(grid[-1])), float(grid[-1])]
    t, y, sample, events = 0.0, system.start(), 0, 0
    pressing = system.indicator(0.0, y, system.where(1e-12)) > 0.0
    for stop in stops:
        where = system.where(0.5 * (t + stop))
        while t < stop:
            held = pressing.copy()

            def slope(
                t: float, y: np.ndarray, held: np.ndarray = held, where: np.ndarray = where
            ) -> np.ndarray:
                return system.slope(t, y, held, where)

            march = solver(
                slope,
                t,
                y,
                stop,
                rtol=tolerance,
                atol=tolerance,
                max_step=1.0 / SAMPLE_RATE,
                first_step=min(1e-9, stop - t),
            )
            ball = -1
            while march.status == "running":
                message = march.step()
                assert march.status != "failed", message
                dense = march.dense_output()
                event, ball = earliest(system, dense, march.t_old, march.t, held, where)
                end = march.t if ball < 0 else event
                while sample < count and grid[sample] <= end:
                    now = dense(grid[sample])
                    states[sample] = now * system.scale
                    rate = slope(float(grid[sample]), now)
                    accelerations[sample] = (rate * system.scale)[-free:]
                    sample += 1
                if ball >= 0:
                    t, y = event, dense(event)
                    pressing[ball] = not pressing[ball]
                    events += 1
                    break
            if ball < 0:
                t, y = march.t, march.y
    assert sample == count
    return Trace(states, accelerations, events)


def earliest(
    system: Any,
    dense: Callable[[float], np.ndarray],
    start: float,
    end: float,
    pressing: np.ndarray,
    where: np.ndarray,
) -> tuple[float, int]:
    """First moment of a step at which a ball begins or ceases to press, and which; -1: none."""
    sign = np.where(pressing, 1.0, -1.0)
    last = start
    for part in np.linspace(0.0, 1.0, 5)[1:]:
        now = end if part == 1.0 else start + part * (end - start)
        wrong = np.flatnonzero(sign * system.indicator(now, dense(now), where) < 0.0)
        if wrong.size:
            found = []
            for j in wrong:

                def gap(t: float, j: int = j) -> float:
                    return float(sign[j] * system.indicator(t, dense(t), where)[j])

                # at the very start of a piece rounding may have put the ball on the wrong side
                time = brentq(gap, last, now, xtol=1e-16, rtol=1e-15) if gap(last) > 0 else last
                found.append((time, int(j)))
            return min(found)
        last = now
    return end, -1


def spectrum_of(acceleration: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Welch, Hann, 2048 points, half overlapping [Hz, (m/s²)²/Hz]."""
    frequency, density = welch(
        acceleration, SAMPLE_RATE, window="hann", nperseg=2048, noverlap=1024, axis=0
    )
    return frequency, density


def apart(one: Trace, other: Trace, units: np.ndarray | None = None) -> np.ndarray:
    """Greatest differences of two integrations: displacement, acceleration, spectrum in dB.

    Displacements over their greatest swing about the mean, accelerations over their greatest
    value, the spectrum over 0.3 to 2.1 kHz. `units` makes rotations comparable with displacements.
    """
    half = one.state.shape[1] // 2
    free = half // 2
    units = np.ones(free) if units is None else units
    both = np.concatenate([units, units])
    swing = np.abs((one.state[:, :half] - one.state[:, :half].mean(axis=0)) * both).max()
    displacement = np.abs((one.state - other.state)[:, :half] * both).max() / swing
    size = np.abs(one.acceleration * units).max()
    acceleration = np.abs((one.acceleration - other.acceleration) * units).max() / size
    frequency, mine = spectrum_of(one.acceleration)
    theirs = spectrum_of(other.acceleration)[1]
    band = (frequency >= 300.0) & (frequency <= 2100.0)
    decibel = np.abs(10.0 * np.log10(mine[band] / theirs[band])).max()
    return np.array([displacement, acceleration, decibel])
