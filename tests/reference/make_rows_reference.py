"""Static equilibrium of pairs, unlike rows, self-aligning and roller bearings at 40 digits.

Writes `rows_reference.json` beside this file. The contact of a ball of any row is written out here
from the geometry alone, and imports nothing of bearingcore; the drop into a defect is that of
`make_static_reference.py`.

    python -m tests.reference.make_rows_reference   # a minute

With e and t the directions along and across a ball's line of contact, and G_r, G_z the gradients of
its radial and axial way in q, row k at z_k along the shaft:

    G_r = (cos φ, sin φ, 0, −z_k sin φ, z_k cos φ),   G_z = (0, 0, 1, r_d sin φ, −r_d cos φ),
    load  = Σ Q (e_r G_r + e_z G_z),
    K     = Σ n Q/δ w w' + Q/A v v',   w = e_r G_r + e_z G_z,  v = e_r G_z − e_z G_r.

A row with dimensions of its own has its own factor K by Hertz, with complete elliptic integrals of
40 digits, and its cage stands at (1 − D/D_p cos α) over that of the bearing, times the cage angle.

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

DRAWN_BALL = 15.0 / 32.0 * 25.4e-3
DRAWN = {
    "n_balls": 14,
    "ball_diameter": DRAWN_BALL,
    "pitch_diameter": 60e-3,
    "contact_angle": math.radians(25.0),
    "groove_center_radius": 30e-3 + 0.02 * DRAWN_BALL * math.cos(math.radians(25.0)),
    "groove_center_distance": 0.52 * DRAWN_BALL + 0.53 * DRAWN_BALL - DRAWN_BALL,
    "radial_clearance": 2e-6,
    "load_deflection_factor": 1.07e10,
    "outer_raceway_radius": 30e-3 + 0.5 * DRAWN_BALL,
    "inner_raceway_radius": 30e-3 - 0.5 * DRAWN_BALL,
    "inner_groove_radius": 0.52 * DRAWN_BALL,
    "outer_groove_radius": 0.53 * DRAWN_BALL,
    "youngs_modulus": 210e9,
    "poisson": 0.3,
}
OWN = (
    *("n_balls", "ball_diameter", "pitch_diameter", "contact_angle"),
    *("inner_groove_radius", "outer_groove_radius"),
)


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
    unlike = {"n_balls": 11, "ball_diameter": 10e-3, "pitch_diameter": 55e-3,
              "contact_angle": math.radians(40.0), "inner_groove_radius": 5.25e-3}  # fmt: skip
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
        case("unlike rows", DRAWN, pair(9e-3, -1, 4e-6, turn=0.1, **unlike), all_five, 21.0, 12.0,
             40.0, 280.0),
        case("unlike rows, inner race, later", DRAWN, pair(9e-3, 1, 6e-6, n_balls=9), all_five,
             130.0, 20.0, 15.0, 60.0, "inner", defect_row=1),
    ]  # fmt: skip


def hertz(b: dict[str, Any]) -> Any:
    """K [N/m^1.5] of both contacts of a ball in series, from the dimensions."""
    D, modulus = b["ball_diameter"], b["youngs_modulus"] / (1 - b["poisson"] ** 2)
    gamma = D * mp.cos(b["contact_angle"]) / b["pitch_diameter"]
    factors = []
    for race, side in (("inner", 1), ("outer", -1)):
        around = side * 2 * gamma / (D * (1 - side * gamma))
        groove = 1 / b[f"{race}_groove_radius"]
        total = 4 / D + around - groove
        wanted = (groove + around) / total

        def integrals(chi: Any) -> tuple[Any, Any]:
            m = 1 - 1 / chi**2
            return mp.ellipk(m), mp.ellipe(m)

        def off(chi: Any, wanted: Any = wanted) -> Any:
            k, e = integrals(chi)
            return 1 - 2 / (chi**2 - 1) * (k / e - 1) - wanted

        chi = mp.findroot(off, (mpf("1.1"), mpf(200)), solver="anderson", tol=mpf("1e-70"))
        k, e = integrals(chi)
        factors.append(mp.pi / mp.sqrt(4.5) * chi * modulus * mp.sqrt(e / (total * k**3)))
    return sum(factor ** (-mpf(2) / 3) for factor in factors) ** (-mpf(3) / 2)


def of_row(b: dict[str, Any], r: dict[str, Any]) -> dict[str, Any]:
    """The bearing's numbers with those that a row has of its own, and what follows from them."""
    base = {name: mpf(value) for name, value in b.items()} | {"n_balls": b["n_balls"]}
    own = {name: r[name] if name == "n_balls" else mpf(r[name]) for name in OWN if name in r}
    if not own:
        return base
    made = base | own
    larger = made["ball_diameter"] / base["ball_diameter"]
    for name in OWN[-2:]:
        made[name] = own.get(name, larger * base[name])
    D, middle = made["ball_diameter"], made["pitch_diameter"] / 2
    lean = mp.cos(made["contact_angle"])
    return made | {
        "groove_center_distance": made["inner_groove_radius"] + made["outer_groove_radius"] - D,
        "groove_center_radius": middle + (made["inner_groove_radius"] - D / 2) * lean,
        "load_deflection_factor": base["load_deflection_factor"] * hertz(made) / hertz(base),
        "outer_raceway_radius": middle + D / 2,
        "inner_raceway_radius": middle - D / 2,
    }


def slowness(b: dict[str, Any]) -> Any:
    """Twice the cage's speed over the shaft's."""
    return 1 - mpf(b["ball_diameter"]) / b["pitch_diameter"] * mp.cos(mpf(b["contact_angle"]))


def prepare(scene: dict[str, Any]) -> dict[str, Any]:
    """Numbers of all contacts at full precision; tilts stay in radians."""
    b, defect = scene["bearing"], scene["defect"]
    contacts = []
    for number, r in enumerate(scene["rows"]):
        own = of_row(b, r)
        alpha, arm, A0 = (
            own[name]
            for name in ("contact_angle", "groove_center_radius", "groove_center_distance")
        )
        cage = mpf(scene["cage_angle"]) * slowness(own) / slowness(b)
        at = {**scene, "bearing": own, "cage_angle": cage}
        for j in range(own["n_balls"]):
            phi = cage + mpf(r["turn"]) + 2 * mp.pi * j / own["n_balls"]
            met = defect["row"] in (None, number)
            d = path(phi, at) if met else mpf(0)
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
                    "A0": A0,
                    "K": own["load_deflection_factor"],
                }
            )
    names = ("fx", "fy", "fz", "mx", "my")
    return {
        "contacts": contacts,
        "arm": mpf(b["groove_center_radius"]),
        "n": mpf(10) / 9 if "roller_length" in b else mpf("1.5"),
        "load": mp.matrix([mpf(scene["load"][name]) for name in names]),
    }


def push_and_stiffness(ready: dict[str, Any], q: Any) -> tuple[Any, Any, list[Any]]:
    """Load of all contacts [N, N·m], stiffness, and (Q, angle, δ, guarded) of each."""
    total, K, each = mp.zeros(5, 1), mp.zeros(5, 5), []
    n = ready["n"]
    for contact in ready["contacts"]:
        A0 = contact["A0"]
        G_r, G_z, ca, sa = (contact[name] for name in ("radial", "axial", "ca", "sa"))
        r = contact["r0"] + (G_r.T * q)[0]
        z = contact["z0"] + (G_z.T * q)[0]
        p = r * ca + z * sa
        guarded = p < 0
        if guarded:
            r, z = r - p * ca, z - p * sa
        A = mp.hypot(r, z)
        delta = A - A0
        Q = contact["K"] * max(delta, mpf(0)) ** n
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
    r0, z0, ca, sa, A0, K = (
        np.array([float(c[name]) for c in ready["contacts"]])
        for name in ("r0", "z0", "ca", "sa", "A0", "K")
    )
    n = float(ready["n"])
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
