"""Motions integrated by two different families that agree, for the references here.

    python -m tests.reference.make_motion_reference    # three minutes

Nothing of bearingcore is imported: the general contact of Eqs. 7 to 14 (Petersen, Howard & Prime
2014) is written out here with the law of Eq. 18 along the loaded line of contact:

    N = K δ^1.5 + c δ̇ where δ > 0; "no tension": never below zero;
    δ̇ the whole time derivative: rings moving, ball turning with the cage, drop changing.

Each body has the free directions out of x, y, z, rx, ry; the contacts act between them, the load
on the inner ring, springs and dampers on the outer one. Motions start at rest at the static state
of cage angle 0.

A smaller step of the same method is no reference: where balls meet edges or touch and leave, the
right-hand side kinks or jumps and the error of every step size is of the same kind. So

- each motion is integrated twice, by an explicit Runge-Kutta method of order 8 (scipy DOP853) and
  by a multistep method of variable order (scipy LSODA), both at a relative tolerance of 1e-12;
- both stop and start afresh at every known event (a ball meets an edge or the floor) and at every
  found one (a ball touches or leaves), so that each integrates smooth pieces (`event_march.py`);
- the files say how far the two are apart, and only what both say is a reference.

`motion_reference.npz` is the rig of the paper (Table 1, and what is assumed beside it), healthy and
with both published extents, over 1.4 s. `general_motion_reference.npz` has tilt, axial motion,
inner-race defects and contacts that cannot pull. Contents, under `<case>/`, of DOP853:

- `scene`: extent [rad], depth [m], contact damping c [N·s/m], duration [s] of the rig; a JSON text
  with everything that goes in of the others [SI, rad];
- `displacement`, `velocity` of inner, then outer ring and `acceleration` of the outer ring [m, rad,
  s] at 65,536 Hz: every 64th sample and every 16th of the rig, every 32nd of the others;
- `density` (1025, 2), of the rig alone: Welch, Hann, 2048 points, half overlapping, of all samples
  [(m/s²)²/Hz], at `frequency` [Hz], which all cases share;
- `agreement`: greatest difference of the two families: of displacement over its greatest swing
  about the mean (rotations times the groove centre radius), of acceleration over its greatest
  value, of the spectrum in dB, 0.3 to 2.1 kHz;
- `events`: balls beginning or ceasing to press, found by each family.
"""

from __future__ import annotations

import json
import math
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import numba
import numpy as np
from mpmath import mp
from scipy.integrate import DOP853, LSODA
from scipy.optimize import brentq

from tests.reference.event_march import Trace, apart, integrate, spectrum_of
from tests.reference.statics import DOFS, prepare, start

HERE = Path(__file__).parent
MICRO, MILLI = 1e-6, 1e-3
PUBLISHED, CHORD, EXACT_OUTER, EXACT_INNER = range(4)
OUTSIDE, LOW_EDGE, FLOOR, HIGH_EDGE = range(4)

RIG, GENERAL = HERE / "motion_reference.npz", HERE / "general_motion_reference.npz"
RIG_EXTENTS = {"sound": 0.0, "12.9deg": 12.9, "38.6deg": 38.6}
"""[degrees]"""


def general_cases() -> dict[str, dict[str, Any]]:
    """What goes in, as its file holds it; a new case is one more there."""
    stored = np.load(GENERAL)
    return {str(name): json.loads(str(stored[f"{name}/scene"])) for name in stored["cases"]}


def rig_cases(like: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """The rig of the paper: bearing, load and edges `like` those of a general case."""
    support = {"outer_mass": 2.0, "stiffness_y": 212.2e6, "damping_y": 1648.2}
    return {
        name: {
            **like,
            "support": {**like["support"], **support},
            "defect": {**like["defect"], "extent": math.radians(extent)},
            "shaft_speed": 2.0 * math.pi * 7.0,
            "contact_damping": 122.0,
            "contact_law": "published",
            "duration": 1.4,
        }
        for name, extent in RIG_EXTENTS.items()
    }


@numba.njit
def edge_drop(s, code, radius, ball_radius):
    """Drop [m] and slope [m/rad] at angle s from an edge, smooth past both ends."""
    if code in (PUBLISHED, CHORD):
        reach = (0.5 if code == PUBLISHED else 1.0) * radius
        root = math.sqrt(ball_radius**2 - reach**2 * s**2)
        return ball_radius - root, reach**2 * s / root
    c, si = math.cos(s), math.sin(s)
    root = math.sqrt(ball_radius**2 - radius**2 * si**2)
    if code == EXACT_OUTER:
        return radius * c - root - (radius - ball_radius), -radius * si + radius**2 * si * c / root
    return (radius + ball_radius) - (radius * c + root), radius * si + radius**2 * si * c / root


@numba.njit
def ball(phi, cage_speed, q, v, numbers, path, where, turn):
    """Compression δ [m], its rate [m/s] and the direction (e_r, e_z) of the line of contact."""
    alpha, arm, distance, clearance = numbers[0], numbers[1], numbers[2], numbers[3]
    code, radius, ball_radius = int(path[0]), path[1], path[2]
    half, depth, center, relative_speed = path[3], path[4], path[5], path[6]
    d, d_rate = 0.0, 0.0
    if where == FLOOR:
        d = depth
    elif where != OUTSIDE:
        away = phi - center - turn
        away -= 2.0 * math.pi * np.rint(away / (2.0 * math.pi))
        sign = 1.0 if where == LOW_EDGE else -1.0
        d, slope = edge_drop(half + sign * away, code, radius, ball_radius)
        d_rate = sign * slope * relative_speed
    c, s = math.cos(phi), math.sin(phi)
    u_r, u_z = math.cos(alpha), math.sin(alpha)
    r = distance * u_r + q[0] * c + q[1] * s - clearance - d * u_r
    z = distance * u_z + q[2] + arm * (q[3] * s - q[4] * c) - d * u_z
    r_rate = v[0] * c + v[1] * s + cage_speed * (q[1] * c - q[0] * s) - d_rate * u_r
    z_rate = v[2] + arm * (v[3] * s - v[4] * c) + arm * cage_speed * (q[3] * c + q[4] * s)
    z_rate -= d_rate * u_z
    along, along_rate = r * u_r + z * u_z, r_rate * u_r + z_rate * u_z
    if along < 0.0:
        r, z = r - along * u_r, z - along * u_z
        r_rate, z_rate = r_rate - along_rate * u_r, z_rate - along_rate * u_z
    a = math.sqrt(r * r + z * z)
    if a == 0.0:  # a guarded ball without axial displacement: a gap
        return -distance, 0.0, u_r, u_z
    return a - distance, (r * r_rate + z * z_rate) / a, r / a, z / a


@numba.njit
def relative(y, free, arm):
    """Displacement and velocity of the inner against the outer ring, all five [m, rad, 1/s]."""
    q, v, m = np.zeros(5), np.zeros(5), len(free)
    for i in range(m):
        lever = arm if free[i] >= 3 else 1.0
        q[free[i]] = (y[i] - y[m + i]) * MICRO / lever
        v[free[i]] = (y[2 * m + i] - y[3 * m + i]) * MILLI / lever
    return q, v


@numba.njit
def press(t, y, free, numbers, path, where, no_tension):
    """Positive for balls that press: compression in µm, and with it the force in N."""
    q, v = relative(y, free, numbers[1])
    out = np.empty(len(where))
    for j in range(len(where)):
        phi = numbers[6] * t + 2.0 * math.pi * j / len(where)
        delta, rate, _, _ = ball(phi, numbers[6], q, v, numbers, path, where[j], path[7] * t)
        out[j] = delta / MICRO
        if no_tension:
            force = numbers[5] * rate
            if delta > 0.0:
                force += numbers[4] * delta * math.sqrt(delta)
            out[j] = min(out[j], force)
    return out


@numba.njit
def right_hand_side(t, y, free, numbers, path, where, pressing, bodies, force):
    """Equation (18) with the set of pressing balls held; `bodies`: m_i, m_o, k_o, c_o by DOF."""
    arm = numbers[1]
    q, v = relative(y, free, arm)
    sums = np.zeros(5)
    for j in range(len(where)):
        if not pressing[j]:
            continue
        phi = numbers[6] * t + 2.0 * math.pi * j / len(where)
        delta, rate, e_r, e_z = ball(phi, numbers[6], q, v, numbers, path, where[j], path[7] * t)
        push = numbers[5] * rate
        if delta > 0.0:
            push += numbers[4] * delta * math.sqrt(delta)
        c, s = math.cos(phi), math.sin(phi)
        sums += push * np.array([e_r * c, e_r * s, e_z, arm * e_z * s, -arm * e_z * c])
    m = len(free)
    out = np.empty(4 * m)
    out[: 2 * m] = y[2 * m :] * (MILLI / MICRO)
    for i in range(m):
        k = free[i]
        lever = arm if k >= 3 else 1.0
        out[2 * m + i] = (force[k] - sums[k]) / bodies[0, k] * lever / MILLI
        back = bodies[2, k] * y[m + i] * MICRO + bodies[3, k] * y[3 * m + i] * MILLI
        out[3 * m + i] = (sums[k] - back / lever) / bodies[1, k] * lever / MILLI
    return out


class General:
    """A case as a system for `event_march`; rotations are scaled by the groove centre radius."""

    def __init__(self, case: dict[str, Any]) -> None:
        bearing, cut, support = case["bearing"], case["defect"], case["support"]
        self.case = case
        self.n_balls = bearing["n_balls"]
        self.free = np.array([DOFS.index(name) for name in case["dofs"]])
        ratio = bearing["ball_diameter"] / bearing["pitch_diameter"]
        shaft = case["shaft_speed"]
        cage = 0.5 * shaft * (1.0 - ratio * math.cos(bearing["contact_angle"]))  # Equation (3)
        inner = cut["race"] == "inner"
        code = {"published": PUBLISHED, "chord": CHORD, "exact": EXACT_OUTER}[cut["edge"]]
        code = EXACT_INNER if inner and code == EXACT_OUTER else code
        radius = bearing[f"{cut['race']}_raceway_radius"]
        ball_radius = bearing["ball_diameter"] / 2.0
        self.relative_speed = cage - shaft if inner else cage
        names = ("contact_angle", "groove_center_radius", "groove_center_distance",
                 "radial_clearance", "load_deflection_factor")  # fmt: skip
        self.numbers = np.array([*(bearing[n] for n in names), case["contact_damping"], cage])
        self.half, depth = cut["extent"] / 2.0, cut["depth"]
        turn = shaft if inner else 0.0
        shape = (code, radius, ball_radius, self.half, depth)
        self.path = np.array([*shape, cut["center"], self.relative_speed, turn])
        self.arc = 0.0
        if self.half:
            self.arc = brentq(
                lambda s: edge_drop(s, code, radius, ball_radius)[0] - depth,
                0.0,
                0.9 * ball_radius / radius,
                xtol=1e-16,
                rtol=1e-15,
            )
            assert self.arc < self.half
        self.no_tension = case["contact_law"] == "no tension"
        mass = ["mass"] * 3 + ["inertia"] * 2
        self.bodies = np.array(
            [
                [support[f"inner_{kind}"] for kind in mass],
                [support[f"outer_{kind}"] for kind in mass],
                [support[f"stiffness_{dof}"] for dof in DOFS],
                [support[f"damping_{dof}"] for dof in DOFS],
            ]
        )
        self.force = np.array([case["load"][key] for key in ("fx", "fy", "fz", "mx", "my")])
        self.levers = np.where(self.free >= 3, bearing["groove_center_radius"], 1.0)
        self.scale = np.concatenate(
            [MICRO / np.tile(self.levers, 2), MILLI / np.tile(self.levers, 2)]
        )

    def away(self, t: float, ball_: int) -> float:
        """Angle of a ball from the middle of the defect, not wrapped."""
        start = 2.0 * math.pi * ball_ / self.n_balls - self.case["defect"]["center"]
        return start + self.relative_speed * t

    def boundaries(self) -> list[float]:
        """Angles from the middle at which pieces of path begin; none without a defect."""
        if not self.half:
            return []
        return [-self.half, -self.half + self.arc, self.half - self.arc, self.half]

    def known_events(self, duration: float) -> list[float]:
        """Times at which balls meet an edge or the floor."""
        turns = int(abs(self.relative_speed) * duration / (2.0 * math.pi)) + 2
        times = {
            (edge + 2.0 * math.pi * k - self.away(0.0, j)) / self.relative_speed
            for edge in self.boundaries()
            for j in range(self.n_balls)
            for k in range(-turns - 1, turns + 2)
        }
        inside = sorted(t for t in times if 1e-9 < t < duration)
        # two balls may meet edges at one time but for rounding
        return [t for t, after in pairwise([*inside, duration]) if after - t > 1e-12]

    def where(self, t: float) -> np.ndarray:
        """Piece of path of each ball."""
        pieces = (LOW_EDGE, FLOOR, HIGH_EDGE, OUTSIDE)
        out = np.zeros(self.n_balls, dtype=np.int64)
        for j in range(self.n_balls):
            away = math.remainder(self.away(t, j), 2.0 * math.pi)
            for edge, piece in zip(self.boundaries(), pieces, strict=False):
                if away >= edge:
                    out[j] = piece
        return out

    def start(self) -> np.ndarray:
        """Rest at the static state of cage angle 0."""
        with mp.workdps(20):
            ready = prepare({**self.case, "cage_angle": 0.0})
            q = start(ready, list(self.free))[self.free]
        outer = (self.force / self.bodies[2])[self.free]
        y = np.concatenate([q + outer, outer]) * np.tile(self.levers, 2) / MICRO
        return np.concatenate([y, np.zeros_like(y)])

    def indicator(self, t: float, y: np.ndarray, where: np.ndarray) -> np.ndarray:
        """See `press`."""
        return press(t, y, self.free, self.numbers, self.path, where, self.no_tension)

    def slope(self, t: float, y: np.ndarray, pressing: np.ndarray, where: np.ndarray) -> np.ndarray:
        """See `right_hand_side`."""
        return right_hand_side(
            t, y, self.free, self.numbers, self.path, where, pressing, self.bodies, self.force
        )


def integrated(name: str, case: dict[str, Any]) -> tuple[Trace, dict[str, Any]]:
    """The motion by DOP853, and what both families say of each other."""
    system, traces = General(case), []
    for solver in (DOP853, LSODA):
        began = time.perf_counter()
        traces.append(integrate(solver, system, case["duration"], 1e-12))
        print(f"{name}, {solver.__name__}: {traces[-1].events} events, "
              f"{time.perf_counter() - began:.1f} s", flush=True)  # fmt: skip
    agreement = apart(*traces, units=system.levers)
    print(f"{name}: apart by {agreement[0]:.1e} (displacement), {agreement[1]:.1e} "
          f"(acceleration), {agreement[2]:.1e} dB", flush=True)  # fmt: skip
    return traces[0], {
        f"{name}/agreement": agreement,
        f"{name}/events": np.array([trace.events for trace in traces]),
    }


def kept(name: str, motion: Trace, state: int, acceleration: int) -> dict[str, Any]:
    """Each so many-th sample."""
    both = motion.state.shape[1] // 2
    return {
        f"{name}/displacement": motion.state[::state, :both],
        f"{name}/velocity": motion.state[::state, both:],
        f"{name}/acceleration": motion.acceleration[::acceleration],
    }


def main() -> None:
    """Integrate all cases by both families and store what they agree on."""
    general = general_cases()
    stored: dict[str, Any] = {"cases": np.array(list(RIG_EXTENTS))}
    for name, case in rig_cases(general["two DOFs, no tension"]).items():
        motion, proof = integrated(name, case)
        stored["frequency"], density = spectrum_of(motion.acceleration)
        cut = case["defect"]
        scene = [cut["extent"], cut["depth"], case["contact_damping"], case["duration"]]
        stored |= kept(name, motion, 64, 16) | proof
        stored |= {f"{name}/scene": np.array(scene), f"{name}/density": density}
    np.savez_compressed(RIG, **stored)
    stored = {"cases": np.array(list(general))}
    for name, case in general.items():
        motion, proof = integrated(name, case)
        stored |= kept(name, motion, 32, 32) | proof
        stored[f"{name}/scene"] = np.array(json.dumps(case))
    np.savez_compressed(GENERAL, **stored)


if __name__ == "__main__":
    main()
