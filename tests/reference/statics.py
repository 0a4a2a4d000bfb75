"""Static equilibrium of any rows of balls or rollers at 64 digits, for the references here.

    python -m tests.reference.statics    # two minutes

solves the scenes of `static_reference.json` (one row of balls) and `rows_reference.json` (pairs,
unlike rows, self-aligning and roller bearings) anew, and writes the files with what it found. A new
scene is a line with the keys of `SCENE`, in SI units and radians.

The physics is written out from the equations of Petersen, Howard & Prime (2014), numbered as in the
paper, and imports nothing of bearingcore: a solver must not be its own reference. With e and t the
directions along and across a ball's line of contact, and G_r, G_z the gradients of its radial and
axial way in q, row k at z_k along the shaft:

    G_r = (cos φ, sin φ, 0, −z_k sin φ, z_k cos φ),   G_z = (0, 0, 1, r_d sin φ, −r_d cos φ),
    load  = Σ Q (e_r G_r + e_z G_z),                                                  Eq. (15)
    K     = Σ n Q/δ w w' + Q/A v v',   w = e_r G_r + e_z G_z,  v = e_r G_z − e_z G_r. Eq. (17)

A row with dimensions of its own has its own factor K by Hertz, with complete elliptic integrals of
40 digits, and its cage stands at (1 − D/D_p cos α) over that of the bearing, times the cage angle.

An answer is believed because of what it is, not of how it was found: the contact energy is convex,
so a point where its gradient vanishes to 1e-30 is its minimum; the stiffness is the difference
quotient of the loads to 1e-30, and positive definite over the free directions, so that it is the
only one.

Conventions the paper leaves open:
- the guard: where the pair of groove centres has passed each other along the unloaded line of
  contact, that component is taken out, so that a gap is never counted as a contact;
- an edge is over (floor reached) from the angle on where the ball no longer touches the corner,
  also where the formula would come back at more than a quarter turn from the edge;
- the inner race takes the inner raceway radius in every edge model, and its defect turns with the
  shaft: by cage angle × 2 / (1 − D_b cos α0 / D_p).
"""

import json
from pathlib import Path
from typing import Any

from mpmath import mp, mpf

HERE = Path(__file__).parent
DOFS = ("x", "y", "z", "rx", "ry")
DIGITS = 64

OWN = (
    *("n_balls", "ball_diameter", "pitch_diameter", "contact_angle"),
    *("inner_groove_radius", "outer_groove_radius"),
)


SCENE = ("name", "bearing", "rows", "load", "defect", "dofs", "cage_angle")
"""Keys of a scene in the files; all others are its answer."""

ONE_ROW = {"place": 0.0, "facing": 1, "clearance": 0.0, "offset": 0.0, "turn": 0.0}
"""A row [m, rad], of bearings that say nothing of rows."""


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
    for number, r in enumerate(scene.get("rows", [ONE_ROW])):
        own = of_row(b, r)
        alpha, arm, A0 = (
            own[name]
            for name in ("contact_angle", "groove_center_radius", "groove_center_distance")
        )
        cage = mpf(scene["cage_angle"]) * slowness(own) / slowness(b)
        at = {**scene, "bearing": own, "cage_angle": cage}
        for j in range(own["n_balls"]):
            phi = cage + mpf(r["turn"]) + 2 * mp.pi * j / own["n_balls"]
            met = defect.get("row") in (None, number)
            d = path(phi, at) if met else mpf(0)
            c, s, z = mp.cos(phi), mp.sin(phi), mpf(r["place"])
            ca, sa = mp.cos(alpha), r["facing"] * mp.sin(alpha)
            if len(scene.get("rows", [ONE_ROW])) > 1 and own["ball_diameter"] > A0:
                # places are those of balls, but of rows on one sphere those of the inner grooves
                z += (arm - mpf(own["pitch_diameter"]) / 2) * sa / ca
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
                    "fixed": "roller_length" in b,
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
        if contact["fixed"]:  # a roller between straight races: no displacement turns its line
            A, r, z = p, p * ca, p * sa
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
        if contact["fixed"]:
            v = mp.zeros(5, 1)
        total += Q * w
        K += n * Q / delta * (w * w.T) + Q / A * (v * v.T)
    return total, K, each


def energy(ready: dict[str, Any], q: Any, each: list[Any]) -> Any:
    """What contacts store, less the work of the load [N m]."""
    stored = sum(Q * max(delta, mpf(0)) for Q, _, delta, _ in each) / (ready["n"] + 1)
    return stored - (ready["load"].T * q)[0]


def solve(scene: dict[str, Any]) -> dict[str, Any]:
    """One case with its answer and its proof; asserts what makes it a reference."""
    ready = prepare(scene)
    free = [DOFS.index(name) for name in scene["dofs"]]
    unit = [mpf(1), mpf(1), mpf(1), ready["arm"], ready["arm"]]
    size = max(abs(ready["load"][i]) / unit[i] for i in free)
    q, damping = mp.zeros(5, 1), size * 100_000  # [N/m], a hundredth of a millimetre at first
    total, K, each = push_and_stiffness(ready, q)
    for _ in range(400):  # Newton's steps, damped while a full one would go too far
        gap = mp.matrix([(total[i] - ready["load"][i]) / unit[i] for i in free])
        residual = mp.norm(gap, mp.inf) / size
        if residual < mpf(10) ** (-DIGITS + 24):  # a straight race takes 21 of a compression
            break
        small = mp.matrix([[K[i, k] / unit[i] / unit[k] for k in free] for i in free])
        step = mp.lu_solve(small + damping * mp.eye(len(free)), gap)
        moved = q.copy()
        for i, value in zip(free, step, strict=True):
            moved[i] -= value / unit[i]
        there = push_and_stiffness(ready, moved)
        left = max(abs(there[0][i] - ready["load"][i]) / unit[i] for i in free) / size
        if left < residual / 2 or energy(ready, moved, there[2]) < energy(ready, q, each):
            q, (total, K, each), damping = moved, there, damping / 100
        else:
            damping *= 10
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
    # a ball within a hair of touching has a stiffness that double precision cannot tell
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
            "guarded_balls": sum(guarded for _, _, _, guarded in each),
            "guarded_and_loaded_balls": sum(guarded and Q > 0 for Q, _, _, guarded in each),
        },
    }


def main() -> None:
    """Solve all scenes of the files and write them with their answers and proofs."""
    for file in (HERE / "static_reference.json", HERE / "rows_reference.json"):
        cases = []
        with mp.workdps(DIGITS):
            for stored in json.loads(file.read_text(encoding="utf-8")):
                cases.append(solve({key: stored[key] for key in SCENE if key in stored}))
                print(cases[-1]["name"], cases[-1]["proof"], flush=True)
        lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in cases)
        file.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
