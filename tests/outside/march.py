"""The motion of any row of balls or rollers, compiled: a witness of its own for the charts.

The equations are those of `elements.py` (Petersen, Howard & Prime 2014, Eqs. 3-5 and 7-23) with
their derivatives written out; SciPy's DOP853 and the classical Runge-Kutta integrate them.
"""

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from tests.outside.elements import Array, Rows

EDGES = {"published": 0.0, "chord": 1.0, "exact": 2.0}
"""3 is exact too, of the inner race."""


@njit(cache=True)
def drop(s: float, ball: float, race: float, depth: float, edge: float) -> tuple[float, float]:
    """Drop of a ball's centre s [rad] inside the nearer edge, and its derivative by s."""
    if s <= 0.0:
        return 0.0, 0.0
    if edge == 0.0:  # Eq. 6
        half, turn = 0.5 * race * s, 0.5 * race
    else:
        half, turn = race * math.sin(s), race * math.cos(s)
    if half >= ball:
        return depth, 0.0
    root = math.sqrt(ball * ball - half * half)
    down, slope = ball - root, half * turn / root
    if edge >= 2.0:
        bulge = race if edge == 2.0 else -race
        down += bulge * (math.cos(s) - 1.0)
        slope -= bulge * math.sin(s)
    return (down, slope) if down < depth else (depth, 0.0)


@njit(cache=True)
def accelerate(t: float, q: Array, v: Array, own: Array, rows: Array, out: Array) -> None:
    """Push of all elements on the outer ring (5,) at displacement q and velocity v (5,) of one ring
    against the other [m, rad]; `own` and `rows` as `Problem` packs them.
    """
    count, ball, ca, sa, lever, apart, clearance, K, n, preload = own[:10]
    extent, depth, race, edge, center, cage, c_contact, least = own[10:18]
    turn, spalls = own[20], own[21]  # of the defect; how many alike touch in its extent
    out[:] = 0.0
    for r in range(rows.shape[0]):
        z, facing = rows[r, 0], rows[r, 1]
        for j in range(int(count)):
            phi = cage * t + 2.0 * math.pi / count * j
            c, s = math.cos(phi), math.sin(phi)
            down = slope = 0.0
            if r == 0:
                away = (phi - center - turn * t + math.pi) % (2.0 * math.pi) - math.pi
                if abs(away) < 0.5 * extent and spalls > 1.0:
                    away = (away + 0.5 * extent) % (extent / spalls) - 0.5 * extent / spalls
                down, slope = drop(0.5 * extent / spalls - abs(away), ball, race, depth, edge)
                slope *= turn - cage if away > 0.0 else cage - turn
            radial = q[0] * c + q[1] * s + z * (q[4] * c - q[3] * s) - clearance
            radial_rate = v[0] * c + v[1] * s + z * (v[4] * c - v[3] * s)
            radial_rate += cage * (q[1] * c - q[0] * s - z * (q[4] * s + q[3] * c))
            axial = facing * (q[2] + lever * (q[3] * s - q[4] * c)) + preload
            axial_rate = facing * (v[2] + lever * (v[3] * s - v[4] * c))
            axial_rate += facing * lever * cage * (q[3] * c + q[4] * s)
            if math.isinf(apart):
                across, along = ca, sa
                delta = radial * ca + axial * sa - down
                rate = radial_rate * ca + axial_rate * sa - slope
            else:
                if radial * ca + axial * sa + apart - down <= 0.0:
                    continue
                R, Z = radial + (apart - down) * ca, axial + (apart - down) * sa
                length = math.sqrt(R * R + Z * Z)
                across, along = R / length, Z / length
                delta = length - apart
                rate = across * (radial_rate - slope * ca) + along * (axial_rate - slope * sa)
            if delta > 0.0:
                push = max(K * delta**n + c_contact * rate, least)
                along *= facing
                out[0] += push * across * c
                out[1] += push * across * s
                out[2] += push * along
                out[3] += push * (along * lever - across * z) * s
                out[4] += push * (across * z - along * lever) * c


@njit(cache=True)
def rates(t: float, y: Array, own: Array, rows: Array, free: Array, rig: Array) -> Array:
    """Rates of y (4 n,): inner ring, outer ring, then their velocities [µm, µm/s and µrad].

    `rig` (4, n): mass, stiffness and damping of what holds the outer ring, and the load.
    """
    n = free.size
    q, v, push = np.zeros(5), np.zeros(5), np.zeros(5)
    for i in range(n):
        q[free[i]] = 1e-6 * (y[i] - y[n + i])
        v[free[i]] = 1e-6 * (y[2 * n + i] - y[3 * n + i])
    accelerate(t, q, v, own, rows, push)
    out = np.empty(4 * n)
    out[: 2 * n] = y[2 * n :]
    unbalance, shaft = own[18], own[19]
    for i in range(n):
        load = rig[3, i]
        if free[i] < 2:
            load += unbalance * (math.cos(shaft * t) if free[i] == 0 else math.sin(shaft * t))
        held = rig[1, i] * y[n + i] + rig[2, i] * y[3 * n + i]
        out[2 * n + i] = 1e6 * (load - push[free[i]]) / rig[0, i]
        out[3 * n + i] = (1e6 * push[free[i]] - held) / rig[0, i]
    return out


@njit(cache=True)
def by_runge_kutta(
    y: Array, h: float, steps: int, keep: int, own: Array, rows: Array, free: Array, rig: Array
) -> Array:
    """Accelerations (steps // keep + 1, n) [m/s², rad/s²] of the outer ring, steps of h [s]."""
    n = free.size
    out = np.empty((steps // keep + 1, n))
    for i in range(steps + 1):
        t = i * h
        k1 = rates(t, y, own, rows, free, rig)
        if i % keep == 0:
            out[i // keep] = 1e-6 * k1[3 * n :]
        k2 = rates(t + 0.5 * h, y + 0.5 * h * k1, own, rows, free, rig)
        k3 = rates(t + 0.5 * h, y + 0.5 * h * k2, own, rows, free, rig)
        k4 = rates(t + h, y + h * k3, own, rows, free, rig)
        y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return out


@dataclass(frozen=True)
class Problem:
    """Two rings on a support; arrays by free direction, in SI; speeds [rad/s].

    `no_tension`: contacts never pull; `unbalance` [N] turns with the shaft; `spalls` that touch
    share the extent of the defect.
    """

    rows: Rows
    force: Array
    free: tuple[int, ...]
    mass: Array
    stiffness: Array
    damping: Array
    cage: float
    c: float
    no_tension: bool = False
    unbalance: float = 0.0
    shaft: float = 0.0
    spalls: int = 1

    def packed(self) -> tuple[Array, Array, Array, Array]:
        one, hurt = self.rows, self.rows.defect
        own = (
            one.count, 0.5 * one.element, math.cos(one.angle), math.sin(one.angle), one.lever,
            one.apart, one.clearance, *one.law, one.preload, hurt.extent, hurt.depth, hurt.race,
            EDGES[hurt.edge] + hurt.inner, hurt.center, self.cage, self.c,
            0.0 if self.no_tension else -math.inf, self.unbalance, self.shaft,
            self.shaft if hurt.inner else 0.0, self.spalls,
        )  # fmt: skip
        free = list(self.free)
        rig = np.stack([self.mass, self.stiffness, self.damping, self.force[free]])
        rows = np.column_stack([one.places, one.facing]).astype(float)
        return np.array(own, dtype=float), rows, np.array(free), rig

    def start(self) -> Array:
        """(4 n,): at rest at cage angle 0."""
        free = list(self.free)
        outer = self.force[free] / self.stiffness
        inner = self.rows.rest(self.force, 0.0, free)[free] + outer
        return 1e6 * np.concatenate([inner, outer, 0.0 * inner, 0.0 * outer])

    def solved(self, y: Array, times: Array, tolerance: float = 1e-10) -> Array:
        """States (len(times), 4 n) from y at times[0] on, by DOP853."""
        made = solve_ivp(
            rates, (times[0], times[-1]), y, "DOP853", times, args=self.packed(),
            rtol=tolerance, atol=tolerance, max_step=1e-4,
        )  # fmt: skip
        assert made.success
        return made.y.T

    def accelerations(self, times: Array, states: Array) -> Array:
        """(len(times), n) [m/s², rad/s²] of the outer ring."""
        n, packed = len(self.free), self.packed()
        all_rates = [rates(t, y, *packed)[3 * n :] for t, y in zip(times, states, strict=True)]
        return 1e-6 * np.array(all_rates)

    def multipliers(self, passes: int = 8) -> Array:
        """Of the periodic orbit of one ball pass, greatest first: Newton's method on its closing,
        the monodromy by differences, which serves for several steps: it is nearly all of the work.

        They reach a nanometre, and 30 µm/s: a tenth of a micrometre already takes a touching ball
        off its race, and the multiplier with it by 4 %.
        """
        times = np.array([0.0, 2.0 * math.pi / self.rows.count / self.cage])
        y = self.start()

        def after(y: Array) -> Array:
            return self.solved(y, times)[-1]

        for _ in range(passes):
            y = after(y)
        size = np.abs(y).max()
        reach = 1e-3 * np.repeat([1.0, 3e4], y.size // 2)

        def monodromy() -> Array:
            ends = [(after(y + h) - after(y - h)) for h in np.diag(reach)]
            return np.stack(ends, axis=1) / (2.0 * reach)

        slopes, before = monodromy(), math.inf
        for _ in range(20):
            missed = after(y) - y
            left = np.abs(missed).max()
            if left < 1e-7 * size:
                break
            if left > 0.2 * before:
                slopes = monodromy()
            y, before = y + np.linalg.solve(np.eye(y.size) - slopes, missed), left
        values = np.linalg.eigvals(monodromy())
        return values[np.argsort(-np.abs(values))]
