"""Static equilibrium of defective ball bearings at 40 digits.

Writes `static_reference.json` beside this file. The physics is written out here from the
equations of Petersen, Howard & Prime (2014), numbered as in the paper, and imports nothing of
bearingcore: a solver must not be its own reference.

    python tests/reference/make_static_reference.py            # a few seconds
    python tests/reference/make_static_reference.py --tables   # check against the summary tables

An answer is believed because of what it is, not of how it was found: the contact energy is
convex, so a point where its gradient vanishes to 1e-30 is its minimum, and where the stiffness
over the free degrees of freedom is positive definite it is the only one.

Conventions the paper leaves open:
- the guard: where the pair of groove centres has passed each other along the unloaded line of
  contact, that component is taken out, so that a gap is never counted as a contact;
- an edge is over (floor reached) from the angle on where the ball no longer touches the corner,
  also where the formula would come back at more than a quarter turn from the edge;
- the inner race takes the inner raceway radius in every edge model, and its defect turns with the
  shaft: by cage angle × 2 / (1 − D_b cos α0 / D_p).
"""

from __future__ import annotations

import argparse
import csv
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from mpmath import mp, mpf
from scipy.optimize import minimize

HERE = Path(__file__).parent
DOFS = ("x", "y", "z", "rx", "ry")
TERMS = [DOFS[i] + DOFS[j] for i in range(5) for j in range(i, 5)]
DIGITS = 40

LIEW_LIM = {
    "n_balls": 12,
    "ball_diameter": 6e-3,
    "pitch_diameter": 39.3e-3,
    "contact_angle": math.radians(30.0),
    "groove_center_radius": 19.65e-3,
    "groove_center_distance": 50e-6,
    "radial_clearance": 0.05e-6,
    "load_deflection_factor": 1.45e10,
    "outer_raceway_radius": 22.65e-3,
    "inner_raceway_radius": 16.65e-3,
}
FAN_RIG = {
    "n_balls": 14,
    "ball_diameter": 8e-3,
    "pitch_diameter": 45e-3,
    "contact_angle": 0.0,
    "groove_center_radius": 22.5e-3,
    "groove_center_distance": 50e-6,
    "radial_clearance": 3e-6,
    "load_deflection_factor": 5453e6,
    "outer_raceway_radius": 26.5e-3,
    "inner_raceway_radius": 18.5e-3,
}
LIEW_LIM_LOAD = {"fx": 0.0, "fy": -2000.0, "fz": 500.0, "mx": 0.0, "my": 0.0}
FAN_RIG_LOAD = {"fx": 0.0, "fy": -100.0, "fz": 0.0, "mx": 0.0, "my": 0.0}
NO_LOAD = {"fx": 0.0, "fy": 0.0, "fz": 0.0, "mx": 0.0, "my": 0.0}


def case(
    name: str,
    bearing: dict[str, Any],
    load: dict[str, float],
    cage_deg: float,
    extent_deg: float = 0.0,
    depth_um: float = 50.0,
    center_deg: float = 270.0,
    race: str = "outer",
    edge: str = "published",
    dofs: tuple[str, ...] = DOFS,
) -> dict[str, Any]:
    """One scene in plain floats [SI, rad]; what is rounded here is what goes in everywhere."""
    return {
        "name": name,
        "bearing": bearing,
        "load": load,
        "defect": {
            "extent": math.radians(extent_deg),
            "depth": depth_um * 1e-6,
            "center": math.radians(center_deg),
            "race": race,
            "edge": edge,
        },
        "dofs": list(dofs),
        "cage_angle": math.radians(cage_deg),
    }


def scenes() -> list[dict[str, Any]]:
    """The spread of scenes: presets, edges, races, depths, loads, bearings, sets of DOFs."""
    ll, ll_load, fan, fan_load = LIEW_LIM, LIEW_LIM_LOAD, FAN_RIG, FAN_RIG_LOAD
    general = {"fx": 300.0, "fy": -1500.0, "fz": 800.0, "mx": 5.0, "my": -8.0}
    xy = ("x", "y")
    cases = [
        case("liew-lim sound", ll, ll_load, 0.0),
        case("liew-lim 5 deg, ball at the middle", ll, ll_load, 0.0, 5.0),
        case("liew-lim 40 deg", ll, ll_load, 7.0, 40.0),
        case("liew-lim 70 deg", ll, ll_load, 11.0, 70.0),
        case("liew-lim 40 deg chord", ll, ll_load, 13.0, 40.0, edge="chord"),
        case("liew-lim 40 deg exact", ll, ll_load, 3.0, 40.0, edge="exact"),
        case("liew-lim 5 deg exact deep", ll, ll_load, 0.5, 5.0, 500.0, edge="exact"),
        case("liew-lim 20 deg chord, ball on the edge", ll, ll_load, 9.0, 20.0, edge="chord"),
        case("liew-lim 64 deg shallow chord", ll, ll_load, 1.0, 64.0, 30.0, edge="chord"),
        case("liew-lim 40 deg depth 100", ll, ll_load, 4.0, 40.0, 100.0),
        case("liew-lim 40 deg depth 200", ll, ll_load, 4.0, 40.0, 200.0),
        case("liew-lim 40 deg depth 500", ll, ll_load, 4.0, 40.0, 500.0),
        case("liew-lim 25 deg depth 0", ll, ll_load, 4.0, 25.0, 0.0),
        case("liew-lim depth 3, floor carries", ll, ll_load, 4.0, 60.0, 3.0),
        case("liew-lim inner 40 deg", ll, ll_load, 5.0, 40.0, race="inner"),
        case("liew-lim inner 20 deg chord", ll, ll_load, 2.0, 20.0, race="inner", edge="chord"),
        case("liew-lim inner 30 deg exact, turns later", ll, general, 1234.0, 30.0, 20.0, 100.0,
             race="inner", edge="exact"),
        case("inner 50 deg exact deep, backwards", ll, general, -77.0, 50.0, 300.0, 10.0,
             race="inner", edge="exact"),
        case("across zero from above", ll, {**NO_LOAD, "fx": 1500.0, "fz": 600.0}, 2.0, 50.0,
             center_deg=3.0),
        case("across zero from below", ll, {**NO_LOAD, "fx": 1500.0, "fz": 600.0}, 2.0, 50.0,
             center_deg=357.0, edge="exact"),
        case("across zero, negative centre", ll, {**NO_LOAD, "fx": 900.0, "fz": 600.0}, 2.0, 30.0,
             center_deg=-2.0, edge="chord"),
        case("extent 200 deg exact", ll, general, 6.0, 200.0, 20.0, edge="exact"),
        case("extent 350 deg exact", ll, general, 6.0, 350.0, 20.0, 90.0, edge="exact"),
        case("whole race, balls off the joint", ll, general, 15.0, 360.0, 20.0, 90.0),
        case("all five loads", ll, general, 21.0, 33.0, center_deg=240.0),
        case("moments under preload", ll, {**NO_LOAD, "fz": 1200.0, "mx": 6.0, "my": 4.0}, 8.0,
             25.0, center_deg=45.0),
        case("axial load the other way", ll, {**NO_LOAD, "fy": -400.0, "fz": -900.0}, 8.0, 25.0),
        case("liew-lim x and y", ll, ll_load, 7.0, 40.0, dofs=xy),
        case("liew-lim x, y and z", ll, ll_load, 7.0, 40.0, dofs=("x", "y", "z")),
        case("liew-lim x, z and ry", ll, {**NO_LOAD, "fx": -800.0, "fz": 700.0, "my": 3.0}, 7.0,
             40.0, center_deg=180.0, dofs=("x", "z", "ry")),
        case("fan rig sound", fan, fan_load, 5.0, dofs=xy),
        case("fan rig 12.9 deg, ball entering", fan, fan_load, 7.5, 12.9, dofs=xy),
        case("fan rig 38.6 deg", fan, fan_load, 3.0, 38.6, dofs=xy),
        case("fan rig 38.6 deg five DOFs", fan, fan_load, 3.0, 38.6),
        case("fan rig 12.9 deg chord five DOFs", fan, {**FAN_RIG_LOAD, "fx": 40.0, "mx": 0.2},
             20.0, 12.9, edge="chord"),
        case("fan rig wide clearance", {**fan, "radial_clearance": 100e-6},
             {**FAN_RIG_LOAD, "fy": -3000.0}, 4.0, 12.9, edge="exact", dofs=xy),
        case("zero contact angle, axial load, clearance 50",
             {**fan, "radial_clearance": 50e-6}, {**NO_LOAD, "fy": -300.0, "fz": 900.0}, 4.0, 30.0),
        case("guard active and loaded", fan, {**NO_LOAD, "fy": -800.0, "fz": 25e3}, 4.0, 90.0,
             400.0),
        case("guard active and loaded, 15 deg", {**fan, "contact_angle": math.radians(15.0)},
             {**NO_LOAD, "fy": -800.0, "fz": -40e3, "mx": 20.0}, 9.0, 90.0, 400.0),
        case("three balls", {**ll, "n_balls": 3, "contact_angle": math.radians(20.0)},
             {**NO_LOAD, "fx": 20.0, "fy": -50.0, "fz": 300.0}, 10.0, 20.0, 2.0),
        case("five balls, 40 deg", {**ll, "n_balls": 5, "contact_angle": math.radians(40.0)},
             {**NO_LOAD, "fy": -300.0, "fz": 2500.0, "mx": 2.0}, 30.0, 50.0, 10.0, edge="exact"),
        case("thirty balls", {**ll, "n_balls": 30, "ball_diameter": 3.5e-3,
                              "contact_angle": math.radians(25.0)},
             {**general, "fy": -6000.0, "fz": 2000.0}, 1.0, 100.0, edge="chord"),
        case("thirty balls, 360 deg less a hair",
             {**ll, "n_balls": 30, "ball_diameter": 3.5e-3}, general, 1.0, 359.0, 15.0),
        case("heavy", ll, {**NO_LOAD, "fx": 4e3, "fy": -20e3, "fz": 9e3, "mx": 30.0, "my": 40.0},
             17.0, 45.0, 500.0, 285.0),
    ]  # fmt: skip
    return cases + edge_scenes() + random_scenes(12)


def edge_scenes() -> list[dict[str, Any]]:
    """A loaded ball a little way into either edge, each edge model on each race."""
    cases = []
    ratio = LIEW_LIM["ball_diameter"] * math.cos(LIEW_LIM["contact_angle"])
    turns = 2.0 / (1.0 - ratio / LIEW_LIM["pitch_diameter"])
    for race in ("outer", "inner"):
        for edge, into_deg in (("published", 0.9), ("chord", 0.45), ("exact", 0.5)):
            for side, cage_deg in ((-1.0, 13.0), (1.0, -400.0)):
                ball_deg = cage_deg % 30.0 + 240.0  # one of the twelve is there
                middle = ball_deg - side * (20.0 - into_deg)
                if race == "inner":
                    middle -= cage_deg * turns
                which = "lower" if side < 0.0 else "upper"
                name = f"{race} {edge}, ball {into_deg} deg into the {which} edge"
                cases.append(
                    case(name, LIEW_LIM, LIEW_LIM_LOAD, cage_deg, 40.0, 50.0, middle, race, edge)
                )
    return cases


def random_scenes(count: int) -> list[dict[str, Any]]:
    """Scenes drawn from a wide box with a fixed seed, loaded enough to have one answer."""
    rng = np.random.default_rng(20140101)
    cases = []
    for number in range(count):
        n_balls = int(rng.integers(5, 25))
        pitch = float(rng.uniform(25e-3, 120e-3))
        ball = float(rng.uniform(0.4, 0.8) * pitch * math.sin(math.pi / n_balls))
        bearing = {
            "n_balls": n_balls,
            "ball_diameter": ball,
            "pitch_diameter": pitch,
            "contact_angle": math.radians(float(rng.uniform(5.0, 40.0))),
            "groove_center_radius": float(pitch / 2 * rng.uniform(1.0, 1.03)),
            "groove_center_distance": float(ball * rng.uniform(0.02, 0.1)),
            "radial_clearance": float(rng.uniform(0.0, 30e-6)),
            "load_deflection_factor": float(10 ** rng.uniform(9.5, 10.5)),
            "outer_raceway_radius": pitch / 2 + ball / 2,
            "inner_raceway_radius": pitch / 2 - ball / 2,
        }
        axial = float(rng.uniform(300.0, 3000.0))
        tilt = 0.2 * axial * pitch
        load = {
            "fx": float(rng.uniform(-1, 1) * axial),
            "fy": float(rng.uniform(-1, 1) * axial),
            "fz": axial,
            "mx": float(rng.uniform(-1, 1) * tilt),
            "my": float(rng.uniform(-1, 1) * tilt),
        }
        cases.append(
            case(
                f"random {number}",
                bearing,
                load,
                float(rng.uniform(0.0, 360.0)),
                float(rng.uniform(0.0, 120.0)),
                float(rng.choice([5.0, 20.0, 50.0, 500.0])),
                float(rng.uniform(0.0, 360.0)),
                str(rng.choice(["outer", "inner"])),
                str(rng.choice(["published", "chord", "exact"])),
            )
        )
    return cases


# --- the equations, in mpmath -----------------------------------------------------------------


def drop(s: mpf, radius: mpf, ball_radius: mpf, edge: str, race: str) -> mpf:
    """Drop of the ball centre [m] at angle s [rad] from the nearer edge; infinite past it."""
    if edge in ("published", "chord"):
        factor = mpf("0.25") if edge == "published" else mpf(1)
        under_root = ball_radius**2 - factor * radius**2 * s**2  # Equation (6)
        return ball_radius - mp.sqrt(under_root) if under_root >= 0 else mp.inf
    if s >= mp.asin(ball_radius / radius):
        return mp.inf
    root = mp.sqrt(ball_radius**2 - (radius * mp.sin(s)) ** 2)
    if race == "outer":
        return radius * mp.cos(s) - root - (radius - ball_radius)
    return (radius + ball_radius) - (radius * mp.cos(s) + root)


def path(ball_angle: mpf, scene: dict[str, Any]) -> mpf:
    """d(φ) [m]: the drop of the ball centre at one ball angle [rad]."""
    bearing, defect = scene["bearing"], scene["defect"]
    center = mpf(defect["center"])
    if defect["race"] == "inner":
        ratio = mpf(bearing["ball_diameter"]) / mpf(bearing["pitch_diameter"])
        turns = 2 / (1 - ratio * mp.cos(mpf(bearing["contact_angle"])))
        center += mpf(scene["cage_angle"]) * turns
    away = ball_angle - center
    away = abs(away - 2 * mp.pi * mp.nint(away / (2 * mp.pi)))
    s = mpf(defect["extent"]) / 2 - away
    if s <= 0:
        return mpf(0)
    radius = mpf(bearing[defect["race"] + "_raceway_radius"])
    ball_radius = mpf(bearing["ball_diameter"]) / 2
    fall = drop(s, radius, ball_radius, defect["edge"], defect["race"])
    return min(mpf(defect["depth"]), fall)


def prepare(scene: dict[str, Any]) -> dict[str, Any]:
    """What does not depend on the displacement: numbers at full precision, angles, drops."""
    ready: dict[str, Any] = {key: mpf(value) for key, value in scene["bearing"].items()}
    count = scene["bearing"]["n_balls"]
    ready["angles"] = [mpf(scene["cage_angle"]) + 2 * mp.pi * j / count for j in range(count)]
    ready["drops"] = [path(angle, scene) for angle in ready["angles"]]
    ready["load"] = mp.matrix([mpf(scene["load"][key]) for key in ("fx", "fy", "fz", "mx", "my")])
    return ready


def contact(ready: dict[str, Any], q: Any, j: int) -> tuple[mpf, mpf, mpf, bool]:
    """Guarded (δr*, δz*) [m], compression A − A0 [m, negative: gap] and whether guarded."""
    phi, d = ready["angles"][j], ready["drops"][j]
    distance, tilt_arm = ready["groove_center_distance"], ready["groove_center_radius"]
    cosine, sine = mp.cos(ready["contact_angle"]), mp.sin(ready["contact_angle"])
    radial = q[0] * mp.cos(phi) + q[1] * mp.sin(phi) - ready["radial_clearance"] - d * cosine
    axial = q[2] + tilt_arm * (q[3] * mp.sin(phi) - q[4] * mp.cos(phi)) - d * sine  # (11), (12)
    radial, axial = distance * cosine + radial, distance * sine + axial  # (9), (10)
    along = radial * cosine + axial * sine
    if along < 0:
        radial, axial = radial - along * cosine, axial - along * sine
    return radial, axial, mp.hypot(radial, axial) - distance, along < 0  # (7), (8)


def ball_results(ready: dict[str, Any], q: Any) -> tuple[list[mpf], list[mpf]]:
    """Load [N] and contact angle [rad] of each ball."""
    loads, angles = [], []
    for j in range(len(ready["angles"])):
        radial, axial, delta, _ = contact(ready, q, j)
        loads.append(ready["load_deflection_factor"] * max(delta, mpf(0)) ** mpf("1.5"))  # (13)
        angles.append(mp.atan2(axial, radial))  # (14)
    return loads, angles


def contact_load(ready: dict[str, Any], q: Any) -> Any:
    """Sum over the balls of their forces and moments, Equation (15) [N, N·m]."""
    total, arm = mp.zeros(5, 1), ready["groove_center_radius"]
    loads, alphas = ball_results(ready, q)
    for load, alpha, phi in zip(loads, alphas, ready["angles"], strict=True):
        total += load * mp.matrix(
            [
                mp.cos(alpha) * mp.cos(phi),
                mp.cos(alpha) * mp.sin(phi),
                mp.sin(alpha),
                arm * mp.sin(alpha) * mp.sin(phi),
                -arm * mp.sin(alpha) * mp.cos(phi),
            ]
        )
    return total


def stiffness(ready: dict[str, Any], q: Any) -> Any:
    """Appendix A, term by term; a guarded ball has its own one-term form [N/m, N/rad, N·m/rad]."""
    n, arm = mpf("1.5"), ready["groove_center_radius"]
    total = mp.zeros(5, 5)
    for j, phi in enumerate(ready["angles"]):
        radial, axial, delta, guarded = contact(ready, q, j)
        if delta <= 0:
            continue
        a = delta + ready["groove_center_distance"]
        factor = ready["load_deflection_factor"] * delta**n
        c, s = mp.cos(phi), mp.sin(phi)
        if guarded:
            # The line of contact is held across the unloaded one, so it cannot turn.
            w = mp.matrix([radial * c, radial * s, axial, arm * axial * s, -arm * axial * c]) / a
            total += factor * n / delta * (w * w.T)
            continue
        rr = factor * (n * a * radial**2 / delta + a**2 - radial**2) / a**3  # (A.1)
        rz = factor * radial * axial * (n * a / delta - 1) / a**3  # (A.3)
        zz = factor * (n * a * axial**2 / delta + a**2 - axial**2) / a**3  # (A.10)
        upper = [
            [rr * c * c, rr * s * c, rz * c, arm * rz * s * c, -arm * rz * c * c],
            [rr * s * s, rz * s, arm * rz * s * s, -arm * rz * s * c],
            [zz, arm * zz * s, -arm * zz * c],
            [arm**2 * zz * s * s, -(arm**2) * zz * s * c],
            [arm**2 * zz * c * c],
        ]
        for i, row in enumerate(upper):
            for k, value in enumerate(row):
                total[i, i + k] += value
                if k:
                    total[i + k, i] += value
    return total


def difference_quotient(ready: dict[str, Any], q: Any) -> Any:
    """The same by central differences of Equation (15) at twice the digits."""
    result = mp.zeros(5, 5)
    with mp.workdps(2 * DIGITS):
        for i in range(5):
            step = mp.zeros(5, 1)
            step[i] = mpf(10) ** (-DIGITS // 2 - 5)
            slope = (contact_load(ready, q + step) - contact_load(ready, q - step)) / (2 * step[i])
            for k in range(5):
                result[k, i] = slope[k]
    return result


# --- a start in double precision, on the convex energy ------------------------------------------


def double_energy(ready: dict[str, Any]) -> Any:
    """Energy, gradient and Hessian of the contacts as a NumPy function of q [m, rad]."""
    phi = np.array([float(v) for v in ready["angles"]])
    d = np.array([float(v) for v in ready["drops"]])
    load = np.array([float(v) for v in ready["load"]])
    alpha, arm = float(ready["contact_angle"]), float(ready["groove_center_radius"])
    distance, k = float(ready["groove_center_distance"]), float(ready["load_deflection_factor"])
    zero = np.zeros_like(phi)
    g_r = np.array([np.cos(phi), np.sin(phi), zero, zero, zero])
    g_z = np.array([zero, zero, zero + 1.0, arm * np.sin(phi), -arm * np.cos(phi)])
    u_r, u_z = math.cos(alpha), math.sin(alpha)

    def energy(q: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        # Along (p) and across (t) the unloaded line of contact; p is cut at zero by the guard.
        r = distance * u_r + q @ g_r - float(ready["radial_clearance"]) - d * u_r
        z = distance * u_z + q @ g_z - d * u_z
        p, t = r * u_r + z * u_z, z * u_r - r * u_z
        free = p > 0
        p = np.where(free, p, 0.0)
        g_p, g_t = (g_r * u_r + g_z * u_z) * free, g_z * u_r - g_r * u_z
        a = np.sqrt(p * p + t * t)
        delta = np.maximum(a - distance, 0.0)
        a = np.maximum(a, 1e-300)
        e_p, e_t = p / a, t / a
        q_ball = k * delta**1.5
        along = g_p * e_p + g_t * e_t
        across = (g_t * e_p - g_p * e_t) * free
        hessian = (along * (1.5 * k * np.sqrt(delta))) @ along.T
        hessian += (across * (q_ball / a)) @ across.T
        return float(np.sum(0.4 * q_ball * delta) - load @ q), along @ q_ball - load, hessian

    return energy


def double_solution(ready: dict[str, Any], free: list[int], start: np.ndarray) -> np.ndarray:
    """Minimum of the energy over the free DOFs by a trust region of scipy, scaled to 10 µm."""
    energy = double_energy(ready)
    scale = 1e-5 * np.array([1.0, 1.0, 1.0, *[1 / float(ready["groove_center_radius"])] * 2])[free]
    size = float(np.linalg.norm([float(v) for v in ready["load"]])) * 1e-5

    def full(z: np.ndarray) -> np.ndarray:
        q = np.zeros(5)
        q[free] = z * scale
        return q

    found = minimize(
        lambda z: energy(full(z))[0] / size,
        start[free] / scale,
        jac=lambda z: energy(full(z))[1][free] * scale / size,
        hess=lambda z: energy(full(z))[2][np.ix_(free, free)] * np.outer(scale, scale) / size,
        method="trust-exact",
        options={"gtol": 1e-12, "maxiter": 2000, "initial_trust_radius": 1.0},
    )
    q = full(found.x)
    for _ in range(5):  # the last digits, lost to rounding of the energy itself
        _, gradient, hessian = energy(q)
        step = np.zeros(5)
        step[free] = np.linalg.solve(hessian[np.ix_(free, free)], gradient[free])
        q = q - step
    return q


# --- putting it together ------------------------------------------------------------------------


def solve(scene: dict[str, Any]) -> dict[str, Any]:
    """One case with its answer and its proof; asserts what makes it a reference."""
    ready = prepare(scene)
    free = [DOFS.index(name) for name in scene["dofs"]]
    arm = ready["groove_center_radius"]
    unit = [mpf(1), mpf(1), mpf(1), arm, arm]  # moments and rotations over this are comparable
    size = max(abs(ready["load"][i]) / unit[i] for i in free)
    q = mp.matrix([mpf(float(v)) for v in double_solution(ready, free, np.zeros(5))])
    for _ in range(60):
        gap = contact_load(ready, q) - ready["load"]
        residual = max(abs(gap[i]) / unit[i] for i in free) / size
        if residual < mpf(10) ** (-DIGITS + 5):
            break
        hessian = stiffness(ready, q)
        small = mp.matrix([[hessian[i, k] / unit[i] / unit[k] for k in free] for i in free])
        step = mp.lu_solve(small, mp.matrix([gap[i] / unit[i] for i in free]))
        for i, value in zip(free, step, strict=True):
            q[i] -= value / unit[i]
    hessian = stiffness(ready, q)
    quotient = difference_quotient(ready, q)
    scaled = mp.matrix([[hessian[i, k] / unit[i] / unit[k] for k in range(5)] for i in range(5)])
    largest = max(abs(v) for v in scaled)
    mismatch = max(
        abs(hessian[i, k] - quotient[i, k]) / unit[i] / unit[k] / largest
        for i in range(5)
        for k in range(5)
    )
    eigenvalues = mp.eigsy(
        mp.matrix([[scaled[i, k] / largest for k in free] for i in free]), eigvals_only=True
    )
    loads, angles = ball_results(ready, q)
    to_touch = min(abs(contact(ready, q, j)[2]) for j in range(len(loads)))
    guarded = [contact(ready, q, j)[3] for j in range(len(loads))]
    assert residual < mpf("1e-30"), (scene["name"], residual)
    assert mismatch < mpf("1e-30"), (scene["name"], mismatch)
    assert min(eigenvalues) > mpf("1e-6"), (scene["name"], eigenvalues)
    # A ball within a hair of touching has a stiffness that double precision cannot tell.
    assert to_touch > mpf("1e-9"), (scene["name"], to_touch)

    def digits(value: mpf) -> str:
        return str(mp.nstr(value, 20))

    return {
        **scene,
        "displacement": [digits(v) for v in q],
        "ball_load": [digits(v) for v in loads],
        "contact_angle": [digits(v) for v in angles],
        "drop": [digits(v) for v in ready["drops"]],
        "stiffness": [[digits(hessian[i, k]) for k in range(5)] for i in range(5)],
        "proof": {
            "relative_residual": mp.nstr(residual, 3),
            "stiffness_against_difference_quotient": mp.nstr(mismatch, 3),
            "least_eigenvalue_over_greatest_term": mp.nstr(min(eigenvalues), 3),
            "nearest_to_touch_m": mp.nstr(to_touch, 3),
            "guarded_balls": sum(guarded),
            "guarded_and_loaded_balls": sum(
                g and v > 0 for g, v in zip(guarded, loads, strict=True)
            ),
        },
    }


def check_tables() -> float:
    """Greatest relative difference of the same formulas in double from the summary tables."""
    worst = 0.0
    for file, bearing, load, dofs in (
        ("liew_lim_summary.csv", LIEW_LIM, LIEW_LIM_LOAD, DOFS),
        ("fan_rig_summary.csv", FAN_RIG, FAN_RIG_LOAD, ("x", "y")),
    ):
        with (HERE / file).open(newline="") as lines:
            rows = list(csv.DictReader(lines))
        for row in rows:
            found = table_row(bearing, load, dofs, float(row["extent_deg"]), row["edge"])
            for name, value in row.items():
                if name in found:
                    size = found.get("size_" + name.split("_", 1)[1], abs(float(value)))
                    difference = abs(found[name] - float(value)) / size
                    if difference > 1e-6:
                        print(f"{file} {row['extent_deg']} {name}: {found[name]} not {value}")
                    worst = max(worst, difference)
    return worst


def table_row(
    bearing: dict[str, Any],
    load: dict[str, float],
    dofs: tuple[str, ...],
    extent_deg: float,
    edge: str,
) -> dict[str, float]:
    """What one row of a summary table holds, by this script's double-precision form."""
    free = [DOFS.index(name) for name in dofs]
    q, ball_loads, matrices, frequencies = np.zeros(5), [], [], []
    for angle_deg in np.arange(120) * 360.0 / bearing["n_balls"] / 120:
        scene = case("", bearing, load, float(angle_deg), extent_deg, edge=edge, dofs=dofs)
        with mp.workdps(20):
            ready = prepare(scene)
            q = double_solution(ready, free, q)
            ball_loads.append([float(v) for v in ball_results(ready, mp.matrix(q))[0]])
        matrix = double_energy(ready)(q)[2]
        matrices.append(matrix)
        if dofs == ("x", "y"):
            k_b, k_o = matrix[:2, :2], 212.2e6 * np.eye(2)
            whole = np.block([[k_b, -k_b], [-k_b, k_b + k_o]])
            frequencies.append(np.sqrt(np.linalg.eigvalsh(whole / 2.0)) / (2 * np.pi))
    loads, k = np.array(ball_loads), np.array(matrices)
    row = {
        "max_ball_load_N": float(loads.max()),
        "min_loaded": float((loads > 0).sum(axis=1).min()),
        "max_loaded": float((loads > 0).sum(axis=1).max()),
    }
    for term in TERMS:
        for i in range(5):
            for j in range(i, 5):
                if DOFS[i] + DOFS[j] == term:
                    values = k[:, i, j]
        for name in ("k_" + term, "k" + term):
            row["min_" + name], row["max_" + name] = float(values.min()), float(values.max())
            row["mean_" + name] = float(values.mean())
            row["size_" + name] = float(np.abs(values).max())
    for number, values in enumerate(np.array(frequencies).T, start=1):
        row[f"min_f{number}_Hz"] = float(values.min())
        row[f"max_f{number}_Hz"] = float(values.max())
    return row


def main() -> None:
    """Make the reference, or check the formulas against the summary tables."""
    parser = argparse.ArgumentParser(description="Static reference at 40 digits.")
    parser.add_argument("--tables", action="store_true", help="check against the summary tables")
    mp.dps = DIGITS
    if parser.parse_args().tables:
        print(f"greatest relative difference from the tables: {check_tables():.2e}")
        return
    cases = []
    for scene in scenes():
        cases.append(solve(scene))
        print(cases[-1]["name"], cases[-1]["proof"], flush=True)
    lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in cases)
    (HERE / "static_reference.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
