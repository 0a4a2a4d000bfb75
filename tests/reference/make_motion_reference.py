"""Motion of the fan rig, integrated by two different families that agree.

Writes `motion_reference.npz` beside this file. The equations (Petersen, Howard & Prime 2014,
Eqs. 18 to 23, published contact law) are written out here and nothing of bearingcore is imported.

    python -m tests.reference.make_motion_reference            # two minutes

A smaller step of the same method is no reference: where balls meet edges or touch and leave, the
right-hand side kinks or jumps and the error of every step size is of the same kind. So

- each motion is integrated twice, by an explicit Runge-Kutta method of order 8 (scipy DOP853) and
  by a multistep method of variable order (scipy LSODA), both at a relative tolerance of 1e-12;
- both stop and start afresh at every known event (a ball meets an edge or the floor) and at every
  found one (a ball touches or leaves), so that each integrates smooth pieces (`event_march.py`);
- the file says how far the two are apart, and only what both say is a reference.

Contents, for each case in `cases` under the prefix `<case>/`:

- `scene`: extent [rad], depth [m], contact damping c [N·s/m], duration [s];
- `acceleration` (n, 2): of the outer ring, x and y, every 16th sample of 65,536 Hz [m/s²];
- `displacement` (m, 4): inner x, y, outer x, y, every 64th sample [m]; `velocity` likewise [m/s];
- `density` (1025, 2): Welch, Hann, 2048 points, half overlapping, of all samples [(m/s²)²/Hz],
  at `frequency` [Hz], which all cases share;
- `agreement`: greatest difference of the two families: of displacement over its greatest swing
  about the mean, of acceleration over its greatest value, of the spectrum in dB, 0.3 to 2.1 kHz;
- `events`: touches and departures found by each family.

The stored values are those of DOP853. The motion starts at rest at the static state of cage angle
0; the rest of the scene is Table 1 of the paper and what is assumed beside it.
"""

from __future__ import annotations

import argparse
import math
import time
from pathlib import Path
from typing import Any

import numba
import numpy as np
from scipy.integrate import DOP853, LSODA
from scipy.optimize import root

from tests.reference.event_march import apart, integrate, spectrum_of

HERE = Path(__file__).parent
DURATION = 1.4
CONTACT_DAMPING = 122.0
N_BALLS, BALL_RADIUS, CLEARANCE, STIFFNESS = 14, 4e-3, 3e-6, 5453e6
PITCH_RADIUS, OUTER_RADIUS, DEPTH, CENTER = 22.5e-3, 26.5e-3, 50e-6, math.radians(270.0)
MASS, SUPPORT_STIFFNESS, SUPPORT_DAMPING, LOAD_Y = 2.0, 212.2e6, 1648.2, -100.0
SHAFT_SPEED = 2.0 * math.pi * 7.0
CAGE_SPEED = SHAFT_SPEED / 2.0 * (1.0 - BALL_RADIUS / PITCH_RADIUS)  # Equation (3)
SPACING = 2.0 * math.pi / N_BALLS
EXTENTS_DEG = {"sound": 0.0, "12.9deg": 12.9, "38.6deg": 38.6}
# Balls know where they are: outside, on the edge where they enter, on the floor, on the way out.
OUTSIDE, ENTERING, FLOOR, LEAVING = range(4)

MICRO = 1e-6
"""The state is (displacement in µm, velocity in mm/s), so that all its parts are of like size."""
MILLI = 1e-3


@numba.njit
def drop(angle: float, where: int, extent: float) -> tuple[float, float]:
    """Path of the ball centre d(φ) [m] and its slope [m/rad], Equation (6), within one piece."""
    if where == OUTSIDE:
        return 0.0, 0.0
    if where == FLOOR:
        return DEPTH, 0.0
    away = angle - CENTER
    away -= 2.0 * math.pi * np.rint(away / (2.0 * math.pi))
    # measured from the edge the ball is at, so that the piece continues smoothly past its ends
    s = 0.5 * extent + away if where == ENTERING else 0.5 * extent - away
    root_ = math.sqrt(BALL_RADIUS**2 - 0.25 * OUTER_RADIUS**2 * s**2)
    slope = 0.25 * OUTER_RADIUS**2 * s / root_
    return BALL_RADIUS - root_, slope if where == ENTERING else -slope


@numba.njit
def compressions(
    t: float, y: np.ndarray, where: np.ndarray, extent: float
) -> tuple[np.ndarray, np.ndarray]:
    """Compression of each ball and its rate [m, m/s], Equation (19), negative for gaps."""
    delta, rate = np.empty(N_BALLS), np.empty(N_BALLS)
    dx, dy = (y[0] - y[2]) * MICRO, (y[1] - y[3]) * MICRO
    vx, vy = (y[4] - y[6]) * MILLI, (y[5] - y[7]) * MILLI
    for j in range(N_BALLS):
        phi = CAGE_SPEED * t + SPACING * j
        c, s = math.cos(phi), math.sin(phi)
        d, slope = drop(phi, where[j], extent)
        delta[j] = dx * c + dy * s - CLEARANCE - d
        rate[j] = vx * c + vy * s + CAGE_SPEED * (dy * c - dx * s - slope)
    return delta, rate


@numba.njit
def right_hand_side(
    t: float,
    y: np.ndarray,
    touching: np.ndarray,
    where: np.ndarray,
    extent: float,
    damping: float,
) -> np.ndarray:
    """Equation (18) with the set of touching balls held."""
    delta, rate = compressions(t, y, where, extent)
    fx, fy = 0.0, 0.0
    for j in range(N_BALLS):
        if touching[j]:
            force = damping * rate[j]
            if delta[j] > 0.0:
                force += STIFFNESS * delta[j] * math.sqrt(delta[j])
            phi = CAGE_SPEED * t + SPACING * j
            fx += force * math.cos(phi)
            fy += force * math.sin(phi)
    out = np.empty(8)
    out[:4] = y[4:] * (MILLI / MICRO)
    out[4] = -fx / MASS
    out[5] = (LOAD_Y - fy) / MASS
    out[6] = (fx - SUPPORT_STIFFNESS * y[2] * MICRO - SUPPORT_DAMPING * y[6] * MILLI) / MASS
    out[7] = (fy - SUPPORT_STIFFNESS * y[3] * MICRO - SUPPORT_DAMPING * y[7] * MILLI) / MASS
    out[4:] /= MILLI
    return out


def floor_arc() -> float:
    """Angle from an edge at which the ball centre reaches the floor, published edges [rad]."""
    return math.sqrt(BALL_RADIUS**2 - (BALL_RADIUS - DEPTH) ** 2) / (0.5 * OUTER_RADIUS)


def pieces_of_path(extent: float) -> list[tuple[float, int]]:
    """Angles from the centre at which a ball's piece of path begins, and which piece."""
    if extent == 0.0:
        return []
    half, arc = 0.5 * extent, floor_arc()
    assert arc < half, "the floor is not reached; this script does not need that case"
    return [(-half, ENTERING), (-half + arc, FLOOR), (half - arc, LEAVING), (half, OUTSIDE)]


def where_balls_are(t: float, extent: float) -> np.ndarray:
    """Piece of path of each ball at a time that is not an event."""
    where = np.zeros(N_BALLS, dtype=np.int64)
    for j in range(N_BALLS):
        away = math.remainder(CAGE_SPEED * t + SPACING * j - CENTER, 2.0 * math.pi)
        for start, piece in pieces_of_path(extent):
            if away >= start:
                where[j] = piece
    return where


def known_events(extent: float, duration: float) -> list[float]:
    """Times at which balls meet an edge or the floor."""
    times = set()
    for start, _ in pieces_of_path(extent):
        first = (CENTER + start) % SPACING / CAGE_SPEED
        period = SPACING / CAGE_SPEED
        times.update(first + k * period for k in range(int(duration / period) + 2))
    return sorted(t for t in times if 0.0 < t < duration)


def static_state(extent: float) -> np.ndarray:
    """Rest at the static displacement of cage angle 0: Equation (15) by scipy."""
    where = where_balls_are(0.0, extent)

    def unbalanced(relative: np.ndarray) -> np.ndarray:
        y = np.concatenate([relative, np.zeros(6)])
        delta, _ = compressions(0.0, y, where, extent)
        force = STIFFNESS * np.maximum(delta, 0.0) ** 1.5
        phi = SPACING * np.arange(N_BALLS)
        return np.array([force @ np.cos(phi), force @ np.sin(phi) - LOAD_Y]) / abs(LOAD_Y)

    found = root(unbalanced, np.array([0.0, -12.0]), tol=1e-15)
    assert np.abs(unbalanced(found.x)).max() < 1e-13
    outer = LOAD_Y / SUPPORT_STIFFNESS / MICRO
    return np.array([found.x[0], found.x[1] + outer, 0.0, outer, 0.0, 0.0, 0.0, 0.0])


class FanRig:
    """The fan rig with a defect of some extent [rad], for `event_march`."""

    scale = np.repeat([MICRO, MILLI], 4)

    def __init__(self, extent: float, damping: float) -> None:
        self.extent, self.damping = extent, damping

    def start(self) -> np.ndarray:
        """Rest at the static displacement of cage angle 0."""
        return static_state(self.extent)

    def known_events(self, duration: float) -> list[float]:
        """Times at which balls meet an edge or the floor."""
        return known_events(self.extent, duration)

    def where(self, t: float) -> np.ndarray:
        """Piece of path of each ball."""
        return where_balls_are(t, self.extent)

    def indicator(self, t: float, y: np.ndarray, where: np.ndarray) -> np.ndarray:
        """Compression: with the published law a ball presses, or pulls, from touch to touch."""
        return compressions(t, y, where, self.extent)[0]

    def slope(self, t: float, y: np.ndarray, pressing: np.ndarray, where: np.ndarray) -> np.ndarray:
        """Equation (18)."""
        return right_hand_side(t, y, pressing, where, self.extent, self.damping)


def main() -> None:
    """Integrate all cases by both families and store what they agree on."""
    parser = argparse.ArgumentParser(description="Motion reference by two families.")
    parser.add_argument("--duration", type=float, default=DURATION, help="seconds of motion")
    parser.add_argument("--tolerance", type=float, default=1e-12)
    parser.add_argument("--dry", action="store_true", help="print the agreement, store nothing")
    options = parser.parse_args()
    stored: dict[str, Any] = {"cases": np.array(list(EXTENTS_DEG))}
    for name, extent_deg in EXTENTS_DEG.items():
        traces = []
        for solver in (DOP853, LSODA):
            start = time.perf_counter()
            extent = math.radians(extent_deg)
            rig = FanRig(extent, CONTACT_DAMPING)
            traces.append(integrate(solver, rig, options.duration, options.tolerance))
            print(f"{name} {solver.__name__}: {traces[-1].events} events, "
                  f"{time.perf_counter() - start:.1f} s", flush=True)  # fmt: skip
        agreement = apart(*traces)
        print(f"{name}: apart by {agreement[0]:.1e} (displacement), {agreement[1]:.1e} "
              f"(acceleration), {agreement[2]:.1e} dB", flush=True)  # fmt: skip
        best = traces[0]
        frequency, density = spectrum_of(best.acceleration)
        stored["frequency"] = frequency
        stored |= {
            f"{name}/scene": np.array([extent, DEPTH, CONTACT_DAMPING, options.duration]),
            f"{name}/acceleration": best.acceleration[::16],
            f"{name}/displacement": best.state[::64, :4],
            f"{name}/velocity": best.state[::64, 4:],
            f"{name}/density": density,
            f"{name}/agreement": agreement,
            f"{name}/events": np.array([trace.events for trace in traces]),
        }
    if not options.dry:
        np.savez_compressed(HERE / "motion_reference.npz", **stored)


if __name__ == "__main__":
    main()
