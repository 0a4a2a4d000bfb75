"""Static equilibrium of pairs, double-row, self-aligning and roller bearings at 40 digits.

Writes `rows_reference.json` beside this file. The contact of a ball of any row is written out here
from the geometry alone, and imports nothing of bearingcore; the drop into a defect is that of
`make_static_reference.py`.

    python -m tests.reference.make_rows_reference   # a minute

With e and t the directions along and across a ball's line of contact, and G_r, G_z the gradients of
its radial and axial way in q, row k at z_k along the shaft:

    G_r = (cos φ, sin φ, 0, −z_k sin φ, z_k cos φ),   G_z = (0, 0, 1, r_d sin φ, −r_d cos φ),
    load  = Σ Q (e_r G_r + e_z G_z),
    K     = Σ n Q/δ w w' + Q/A v v',   w = e_r G_r + e_z G_z,  v = e_r G_z − e_z G_r.

As there, an answer is believed because of what it is: the gradient vanishes to 1e-30, the stiffness
is the difference quotient of the loads to 1e-30 and positive definite over the free directions, and
the energy is convex.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
from mpmath import mp, mpf
from scipy.optimize import minimize

from tests.reference.make_static_reference import DIGITS, DOFS, HERE, path

ALL, XYZ, XY = DOFS, DOFS[:3], DOFS[:2]

SMALL = {
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
DOUBLE_ROW = {
    "n_balls": 14,
    "ball_diameter": 10.31875e-3,
    "pitch_diameter": 60e-3,
    "contact_angle": math.radians(30.0),
    "groove_center_radius": 30.17872e-3,
    "groove_center_distance": 515.9375e-6,
    "radial_clearance": 0.0,
    "load_deflection_factor": 9.96e9,
    "outer_raceway_radius": 35.159375e-3,
    "inner_raceway_radius": 24.840625e-3,
}
SPHERE, GROOVE, ALIGNING_ANGLE = 34.4e-3, 4.6275e-3, math.radians(10.0)
_FROM_MIDDLE = SPHERE + GROOVE - 8.73125e-3
ALIGNING = {
    "n_balls": 16,
    "ball_diameter": 8.73125e-3,
    "pitch_diameter": 2.0 * (SPHERE - 0.5 * 8.73125e-3) * math.cos(ALIGNING_ANGLE),
    "contact_angle": ALIGNING_ANGLE,
    "groove_center_radius": _FROM_MIDDLE * math.cos(ALIGNING_ANGLE),
    "groove_center_distance": _FROM_MIDDLE,
    "radial_clearance": 5e-6,
    "load_deflection_factor": 5.4e9,
    "outer_raceway_radius": SPHERE,
    "inner_raceway_radius": 25.28e-3,
}
ROLLERS = {
    "n_balls": 14,
    "ball_diameter": 11e-3,
    "pitch_diameter": 60.5e-3,
    "contact_angle": 0.0,
    "groove_center_radius": 30.25e-3,
    "groove_center_distance": 11e-3,
    "radial_clearance": 15e-6,
    "load_deflection_factor": 1.4634e9,
    "outer_raceway_radius": 35.75e-3,
    "inner_raceway_radius": 24.75e-3,
    "roller_length": 11e-3,
}


def row(
    place: float, facing: int = 1, clearance: float = 0.0, offset: float = 0.0, turn: float = 0.0
) -> dict[str, Any]:
    """One row [m, rad]."""
    return {
        "place": place,
        "facing": facing,
        "clearance": clearance,
        "offset": offset,
        "turn": turn,
    }


def pair(place: float, upper: int, push: float, **of_upper: float) -> list[dict[str, Any]]:
    """Two rows ± `place`, the upper one facing `upper`, each pushed by `push` [m]."""
    low = row(-place, -upper, offset=-upper * push)
    return [low, {**row(place, upper, offset=upper * push), **of_upper}]


def case(
    name: str,
    bearing: dict[str, Any],
    rows: list[dict[str, Any]],
    load: tuple[float, float, float, float, float],
    cage_deg: float,
    extent_deg: float = 0.0,
    depth_um: float = 50.0,
    center_deg: float = 270.0,
    race: str = "outer",
    edge: str = "exact",
    defect_row: int | None = None,
    dofs: tuple[str, ...] = ALL,
) -> dict[str, Any]:
    """One scene in plain floats [SI, rad]."""
    return {
        "name": name,
        "bearing": bearing,
        "rows": rows,
        "load": dict(zip(("fx", "fy", "fz", "mx", "my"), load, strict=True)),
        "defect": {
            "extent": math.radians(extent_deg),
            "depth": depth_um * 1e-6,
            "center": math.radians(center_deg),
            "race": race,
            "edge": edge,
            "row": defect_row,
        },
        "dofs": list(dofs),
        "cage_angle": math.radians(cage_deg),
    }


def scenes() -> list[dict[str, Any]]:
    """Each kind, healthy and damaged, in one row and in all."""
    down = (0.0, -2000.0, 500.0, 0.0, 0.0)
    all_five = (300.0, -1500.0, 600.0, 12.0, -7.0)
    place = _FROM_MIDDLE * math.sin(ALIGNING_ANGLE)
    aligning = [row(-place, -1), row(place, 1)]
    loose = [row(-place, -1, clearance=-8e-6), row(place, 1, clearance=-8e-6)]
    half = math.pi / 12.0
    return [
        case("back to back, preloaded", SMALL, pair(8e-3, -1, 4e-6), down, 3.0),
        case("face to face, preloaded", SMALL, pair(8e-3, 1, 4e-6), down, 3.0),
        case("back to back, all loads, defect in row 1", SMALL, pair(8e-3, -1, 4e-6), all_five, 7.0,
             30.0, 20.0, defect_row=0),
        case("face to face, all loads, defect in row 2", SMALL, pair(8e-3, 1, 3e-6), all_five, 7.0,
             30.0, 20.0, defect_row=1),
        case("back to back, defect across both rows", SMALL, pair(9e-3, -1, 2e-6), all_five, 11.0,
             40.0, 15.0, 250.0, edge="chord"),
        case("face to face, inner race, later", SMALL, pair(9e-3, 1, 5e-6), all_five, 411.0, 25.0,
             10.0, 100.0, "inner", defect_row=1),
        case("tandem", SMALL, [row(-7e-3), row(7e-3)], (0.0, -1500.0, 2500.0, 0.0, 0.0), 5.0, 20.0,
             10.0, dofs=XYZ),
        case("tandem, all directions", SMALL, [row(-7e-3), row(7e-3)],
             (100.0, -1500.0, 4500.0, 10.0, 5.0), 5.0),
        case("rows half a spacing apart", SMALL, pair(8e-3, -1, 3e-6, turn=half), all_five, 2.0,
             20.0, 30.0),
        case("rows of unlike clearance", SMALL, pair(8e-3, -1, 2e-6, clearance=-1.5e-6), all_five,
             2.0),
        case("double row, angular contact", DOUBLE_ROW, pair(7e-3, -1, 2e-6),
             (0.0, -2500.0, 500.0, 0.0, 0.0), 4.0, 8.0, 100.0, 272.0, defect_row=0),
        case("double row, moment", DOUBLE_ROW, pair(7e-3, -1, 2e-6),
             (400.0, -1500.0, -700.0, 20.0, -15.0), 9.0),
        case("self-aligning", ALIGNING, aligning, (0.0, -1000.0, 0.0, 0.0, 0.0), 3.0, dofs=XYZ),
        case("self-aligning, defect in row 1", ALIGNING, aligning,
             (150.0, -1000.0, 60.0, 0.0, 0.0), 1.0, 8.0, 100.0, defect_row=0, dofs=XYZ),
        case("self-aligning, preloaded, axial", ALIGNING, loose,
             (0.0, -700.0, 300.0, 0.0, 0.0), 1.0, dofs=XYZ),
        case("rollers", ROLLERS, [row(0.0)], (0.0, -3000.0, 0.0, 0.0, 0.0), 3.0, dofs=XY),
        case("rollers over a defect", ROLLERS, [row(0.0)], (200.0, -3000.0, 0.0, 0.0, 0.0), 9.5,
             8.0, 100.0, 268.0, dofs=XY),
        case("rollers, inner race", ROLLERS, [row(0.0)], (0.0, -5000.0, 0.0, 0.0, 0.0), 77.0, 20.0,
             12.0, 30.0, "inner", dofs=XY),
    ]  # fmt: skip


def prepare(scene: dict[str, Any]) -> dict[str, Any]:
    """Numbers of all contacts at full precision; tilts stay in radians."""
    b, defect = scene["bearing"], scene["defect"]
    alpha, arm = mpf(b["contact_angle"]), mpf(b["groove_center_radius"])
    A0 = mpf(b["groove_center_distance"])
    contacts = []
    for number, r in enumerate(scene["rows"]):
        for j in range(b["n_balls"]):
            phi = mpf(scene["cage_angle"]) + mpf(r["turn"]) + 2 * mp.pi * j / b["n_balls"]
            met = defect["row"] in (None, number)
            d = path(phi, scene) if met else mpf(0)
            c, s, z = mp.cos(phi), mp.sin(phi), mpf(r["place"])
            ca, sa = mp.cos(alpha), r["facing"] * mp.sin(alpha)
            slack = mpf(b["radial_clearance"]) + mpf(r["clearance"])
            contacts.append(
                {
                    "radial": mp.matrix([c, s, 0, -z * s, z * c]),
                    "axial": mp.matrix([0, 0, 1, arm * s, -arm * c]),
                    "r0": A0 * ca - slack - d * ca,
                    "z0": A0 * sa + mpf(r["offset"]) - d * sa,
                    "ca": ca,
                    "sa": sa,
                    "drop": d,
                }
            )
    names = ("fx", "fy", "fz", "mx", "my")
    return {
        "contacts": contacts,
        "A0": A0,
        "arm": arm,
        "K": mpf(b["load_deflection_factor"]),
        "n": mpf(10) / 9 if "roller_length" in b else mpf("1.5"),
        "load": mp.matrix([mpf(scene["load"][name]) for name in names]),
    }


def push_and_stiffness(ready: dict[str, Any], q: Any) -> tuple[Any, Any, list[Any]]:
    """Load of all contacts [N, N·m], stiffness, and (Q, angle, δ, guarded) of each."""
    total, K, each = mp.zeros(5, 1), mp.zeros(5, 5), []
    A0, n = ready["A0"], ready["n"]
    for contact in ready["contacts"]:
        G_r, G_z, ca, sa = (contact[name] for name in ("radial", "axial", "ca", "sa"))
        r = contact["r0"] + (G_r.T * q)[0]
        z = contact["z0"] + (G_z.T * q)[0]
        p = r * ca + z * sa
        guarded = p < 0
        if guarded:
            r, z = r - p * ca, z - p * sa
        A = mp.hypot(r, z)
        delta = A - A0
        Q = ready["K"] * max(delta, mpf(0)) ** n
        each.append((Q, mp.atan2(z, r), delta, guarded))
        if delta <= 0:
            continue
        e_r, e_z = r / A, z / A
        if guarded:
            side = G_z * ca - G_r * sa
            w = side * (e_z * ca - e_r * sa)
            v = mp.zeros(5, 1)
        else:
            w, v = G_r * e_r + G_z * e_z, G_z * e_r - G_r * e_z
        total += Q * w
        K += n * Q / delta * (w * w.T) + Q / A * (v * v.T)
    return total, K, each


def start(ready: dict[str, Any], free: list[int]) -> np.ndarray:
    """Minimum of the energy in double precision, by a trust region of scipy."""
    G_r = np.array([[float(x) for x in c["radial"]] for c in ready["contacts"]])
    G_z = np.array([[float(x) for x in c["axial"]] for c in ready["contacts"]])
    r0, z0, ca, sa = (
        np.array([float(c[name]) for c in ready["contacts"]]) for name in ("r0", "z0", "ca", "sa")
    )
    A0, K, n = (float(ready[name]) for name in ("A0", "K", "n"))
    load = np.array([float(v) for v in ready["load"]])
    scale = 1e-5 * np.array([1.0, 1.0, 1.0, *[1.0 / float(ready["arm"])] * 2])
    size = float(np.linalg.norm(load)) * 1e-5

    def parts(x: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        q = np.zeros(5)
        q[free] = x * scale[free]
        r, z = r0 + G_r @ q, z0 + G_z @ q
        back = np.minimum(r * ca + z * sa, 0.0)
        r, z = r - back * ca, z - back * sa
        A = np.hypot(r, z)
        delta = np.maximum(A - A0, 0.0)
        Q = K * delta**n
        w = G_r * (r / A)[:, None] + G_z * (z / A)[:, None]
        v = G_z * (r / A)[:, None] - G_r * (z / A)[:, None]
        energy = float(np.sum(Q * delta) / (n + 1.0) - load @ q)
        slope = w.T @ Q - load
        bend = (w.T * (n * K * delta ** (n - 1.0) * (delta > 0.0))) @ w + (v.T * (Q / A)) @ v
        unit = scale[free]
        return (
            energy / size,
            slope[free] * unit / size,
            bend[np.ix_(free, free)] * np.outer(unit, unit) / size,
        )

    found = minimize(
        lambda x: parts(x)[0],
        np.zeros(len(free)),
        jac=lambda x: parts(x)[1],
        hess=lambda x: parts(x)[2],
        method="trust-exact",
        options={"gtol": 1e-11, "maxiter": 3000},
    )
    q = np.zeros(5)
    q[free] = found.x * scale[free]
    return q


def solve(scene: dict[str, Any]) -> dict[str, Any]:
    """One case with its answer and its proof."""
    ready = prepare(scene)
    free = [DOFS.index(name) for name in scene["dofs"]]
    unit = [mpf(1), mpf(1), mpf(1), ready["arm"], ready["arm"]]
    size = max(abs(ready["load"][i]) / unit[i] for i in range(5))
    q = mp.matrix([mpf(float(v)) for v in start(ready, free)])
    for _ in range(60):
        total, K, each = push_and_stiffness(ready, q)
        gap = total - ready["load"]
        residual = max(abs(gap[i]) / unit[i] for i in free) / size
        if residual < mpf(10) ** (-DIGITS + 5):
            break
        small = mp.matrix([[K[i, k] / unit[i] / unit[k] for k in free] for i in free])
        step = mp.lu_solve(small, mp.matrix([gap[i] / unit[i] for i in free]))
        for i, value in zip(free, step, strict=True):
            q[i] -= value / unit[i]
    quotient = mp.zeros(5, 5)
    with mp.workdps(2 * DIGITS):
        for i in range(5):
            step = mp.zeros(5, 1)
            step[i] = mpf(10) ** (-DIGITS // 2 - 5)
            high, low = (push_and_stiffness(ready, q + s * step)[0] for s in (1, -1))
            for k in range(5):
                quotient[k, i] = (high[k] - low[k]) / (2 * step[i])
    scaled = mp.matrix([[K[i, k] / unit[i] / unit[k] for k in range(5)] for i in range(5)])
    largest = max(abs(value) for value in scaled)
    mismatch = max(
        abs(K[i, k] - quotient[i, k]) / unit[i] / unit[k] / largest
        for i in range(5)
        for k in range(5)
    )
    eigenvalues = mp.eigsy(
        mp.matrix([[scaled[i, k] / largest for k in free] for i in free]), eigvals_only=True
    )
    to_touch = min(abs(delta) for _, _, delta, _ in each)
    assert residual < mpf("1e-30"), (scene["name"], residual)
    assert mismatch < mpf("1e-30"), (scene["name"], mismatch)
    assert min(eigenvalues) > mpf("1e-6"), (scene["name"], eigenvalues)
    assert to_touch > mpf("1e-9"), (scene["name"], to_touch)

    def digits(value: Any) -> str:
        return str(mp.nstr(value, 20))

    return {
        **scene,
        "displacement": [digits(value) for value in q],
        "ball_load": [digits(Q) for Q, _, _, _ in each],
        "contact_angle": [digits(angle) for _, angle, _, _ in each],
        "drop": [digits(contact["drop"]) for contact in ready["contacts"]],
        "stiffness": [[digits(K[i, k]) for k in range(5)] for i in range(5)],
        "proof": {
            "relative_residual": mp.nstr(residual, 3),
            "stiffness_against_difference_quotient": mp.nstr(mismatch, 3),
            "least_eigenvalue_over_greatest_term": mp.nstr(min(eigenvalues), 3),
            "nearest_to_touch_m": mp.nstr(to_touch, 3),
        },
    }


def main() -> None:
    """Make the reference."""
    mp.dps = DIGITS
    cases = []
    for scene in scenes():
        cases.append(solve(scene))
        print(cases[-1]["name"], cases[-1]["proof"], flush=True)
    lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in cases)
    (HERE / "rows_reference.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
