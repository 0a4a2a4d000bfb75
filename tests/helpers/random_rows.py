"""Random pairs, self-aligning and roller bearings, unlike rows, and a judge of their equilibria.

The judge writes the contact out again in extended precision, from its own gradients: energy,
loads and nothing else. It shares the drop of a ball's centre with the program, which has tests of
its own, and no solver.

Quantity                                          | Symbol   | Unit
------------------------------------------------- | -------- | ----
gradients in q of a ball's radial and axial way   | radial, axial |
vector between the groove centres                 | δr*, δz* | m
its part along the unloaded line of contact       | p        | m
its length, and the compression                   | A, δ     | m

Tilts are carried as r_d θ and moments as M/r_d.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from bearingcore import (
    EDGES,
    RACES,
    Bearing,
    Defect,
    Equilibrium,
    Load,
    Scene,
    equilibrium,
    kernels,
    presets,
)
from bearingcore.bearings.rows import ARRANGEMENTS, Row
from bearingcore.statics.passes import drops_now

Long = np.longdouble
OWN_ANGLES = "rows with angles of their own"
UNLIKE = "rows of unlike balls"
KINDS = (*ARRANGEMENTS, "self-aligning", "rollers", OWN_ANGLES, UNLIKE)

RESIDUAL = 1e-9
STEP = 1e-10
"""[m] of the finite differences; in extended precision they are then right to 1e-8."""
NEAR_A_KINK = 1e-8
"""[m] A ball so near to touching has a stiffness that differences over a step cannot tell."""


def random_scene(rng: np.random.Generator, kind: str) -> Scene:
    """A scene with a bearing of a kind, out of a box wider than what is built."""

    def decades(low: float, high: float) -> float:
        return float(math.exp(rng.uniform(math.log(low), math.log(high))))

    bearing = _bearing(rng, kind, decades)
    loads = [
        decades(1.0, 1e5) * float(rng.choice([-1.0, 1.0])) * (rng.random() < 0.7) for _ in "12345"
    ]
    lever = 0.5 * bearing.pitch_diameter
    load = Load(loads[0], loads[1], loads[2], lever * loads[3], lever * loads[4])
    dofs: tuple[str, ...] | None = None
    if kind == "rollers":
        load = Load(loads[0], loads[1])
    elif kind != "self-aligning":
        dofs = (None, ("x", "y", "z"), ("x", "y"))[int(rng.choice(3, p=[0.7, 0.2, 0.1]))]
    defect = Defect(
        extent=float(rng.uniform(0.0, 1.5)),
        depth=0.2 * bearing.ball_diameter * float(rng.random() ** 3),
        center=float(rng.uniform(0.0, 6.28)),
        race=str(rng.choice(RACES)),
        edge=str(rng.choice(EDGES)),
        row=[None, 0, len(bearing.all_rows) - 1][int(rng.integers(3))],
    )
    return Scene(bearing, defect, load, 100.0, presets["fan-rig"].support, dofs=dofs)


def _bearing(rng: np.random.Generator, kind: str, decades: Any) -> Bearing:
    n = int(rng.integers(3, 25))
    pitch = decades(15e-3, 0.4)
    room = math.sin(math.pi / n)
    ball = pitch * min(0.6, room) * float(rng.uniform(0.3, 0.95))
    clearance = float(rng.choice([0.0, decades(1e-7, 1e-4)]))
    if kind == "rollers":
        return Bearing.cylindrical(n, ball, ball * float(rng.uniform(0.5, 3.0)), pitch, clearance)
    angle = math.radians(float(rng.uniform(3.0, 60.0)))
    groove = ball * float(rng.uniform(0.505, 0.56))
    if kind == "self-aligning":
        angle *= 0.4
        sphere = 0.5 * pitch / math.cos(angle) + 0.5 * ball
        return Bearing.self_aligning(n, ball, sphere, groove, angle, clearance)
    outer = ball * float(rng.uniform(0.505, 0.56))
    one = Bearing.from_drawing(n, ball, pitch, groove, outer, contact_angle=angle)
    one = dataclasses.replace(
        one,
        radial_clearance=clearance,
        load_deflection_factor=one.load_deflection_factor * decades(0.1, 10.0),
    )
    arrangement = kind if kind in ARRANGEMENTS else str(rng.choice(ARRANGEMENTS))
    preload = 0.0 if arrangement == "tandem" else float(rng.choice([0.0, decades(1e-7, 3e-5)]))
    pair = one.paired(pitch * float(rng.uniform(0.0, 2.0)), arrangement, preload)
    low, high = pair.rows
    if kind == OWN_ANGLES:
        own = [math.radians(float(rng.uniform(0.0, 60.0))) for _ in "12"]
        low = dataclasses.replace(low, contact_angle=own[0] if rng.random() < 0.5 else None)
        high = dataclasses.replace(high, contact_angle=own[1])
    if kind == UNLIKE:
        low, high = (_unlike(rng, row, one) for row in (low, high))
    high = dataclasses.replace(high, turn=float(rng.choice([0.0, 0.5 * pair.ball_spacing])))
    return pair.replace(rows=(low, high))


def _unlike(rng: np.random.Generator, row: Row, one: Bearing) -> Row:
    """A row with some numbers of its own, near those of the bearing, that fit each other."""
    assert one.inner_groove_radius is not None
    ball, pitch = (
        d * float(rng.uniform(0.8, 1.2)) for d in (one.ball_diameter, one.pitch_diameter)
    )
    own: dict[str, Any] = {"ball_diameter": ball, "pitch_diameter": pitch}
    most = math.floor(math.pi / math.asin(ball / pitch))
    if most < 2:
        return row
    own["n_balls"] = int(rng.integers(2, min(most, 2 * one.n_balls) + 1))
    if rng.random() < 0.5:
        own["contact_angle"] = math.radians(float(rng.uniform(0.0, 60.0)))
    if rng.random() < 0.5:
        own["inner_groove_radius"] = ball * float(rng.uniform(0.505, 0.56))
    return dataclasses.replace(row, **own)


def _of_rows(b: Bearing) -> list[dict[str, float]]:
    """What the contacts of each row are made of, written out from its dimensions."""
    found = []
    for row in b.all_rows:
        n = b.n_balls if row.n_balls is None else row.n_balls
        angle = b.contact_angle if row.contact_angle is None else row.contact_angle
        each = {
            "n": n, "angle": angle, "K": b.load_deflection_factor, "pace": 1.0,
            "reach": b.groove_center_radius, "A0": b.groove_center_distance,
        }  # fmt: skip
        found.append(each)
        if not row.own:
            continue
        assert b.inner_groove_radius is not None
        assert b.outer_groove_radius is not None
        D, pitch = row.ball_diameter or b.ball_diameter, row.pitch_diameter or b.pitch_diameter
        r_i = row.inner_groove_radius or b.inner_groove_radius * D / b.ball_diameter
        r_o = row.outer_groove_radius or b.outer_groove_radius * D / b.ball_diameter
        drawn = Bearing.from_drawing(n, D, pitch, r_i, r_o, contact_angle=angle)
        base = Bearing.from_drawing(
            b.n_balls, b.ball_diameter, b.pitch_diameter, b.inner_groove_radius,
            b.outer_groove_radius, contact_angle=b.contact_angle,
        )  # fmt: skip
        each["K"] *= drawn.load_deflection_factor / base.load_deflection_factor
        each["reach"] = 0.5 * pitch + (r_i - 0.5 * D) * math.cos(angle)
        each["A0"] = r_i + r_o - D
        slow = b.ball_diameter * math.cos(b.contact_angle) / b.pitch_diameter
        each["pace"] = (1.0 - D * math.cos(angle) / pitch) / (1.0 - slow)
    return found


class Contacts:
    """The contacts of a scene at one cage angle [rad], in extended precision."""

    def __init__(self, scene: Scene, cage_angle: float) -> None:
        b = scene.bearing
        rows, own = b.all_rows, _of_rows(b)
        n = [int(each["n"]) for each in own]

        def of(name: str) -> Any:
            return np.repeat([each[name] for each in own], n).astype(Long)

        turn = np.repeat([row.turn for row in rows], n).astype(Long)
        around = np.concatenate([2.0 * math.pi / each * np.arange(each) for each in n])
        angle = of("pace") * cage_angle + turn + around
        place = np.repeat([row.place for row in rows], n).astype(Long) / b.groove_center_radius
        facing = np.repeat([row.facing for row in rows], n).astype(Long)
        c, s = np.cos(angle), np.sin(angle)
        zero, one = np.zeros_like(c), np.ones_like(c)
        reach, alpha = of("reach") / b.groove_center_radius, of("angle")
        self.radial = np.stack([c, s, zero, -place * s, place * c], 1)
        self.axial = np.stack([zero, zero, one, reach * s, -reach * c], 1)
        self.ca = np.cos(alpha)
        self.sa = facing * np.sin(alpha)
        drop = drops_now(scene, cage_angle).astype(Long)
        slack = np.repeat([b.radial_clearance + row.clearance for row in rows], n).astype(Long)
        offset = np.repeat([row.offset for row in rows], n).astype(Long)
        self.A0, self.K = of("A0"), of("K")
        self.exponent = Long(10) / Long(9) if b.kind.line_contact else Long(1.5)
        self.r0 = self.A0 * self.ca - slack - drop * self.ca
        self.z0 = self.A0 * self.sa + offset - drop * self.sa
        self.units = np.array([1.0, 1.0, 1.0, *[b.groove_center_radius] * 2], dtype=Long)
        self.load = scene.load.vector.astype(Long) / self.units

    def state(self, q: Any) -> tuple[Any, Any, Any, Any]:
        """Guarded δr*, δz*, length A and compression δ at q (5,) [m]."""
        r, z = self.r0 + self.radial @ q, self.z0 + self.axial @ q
        back = np.minimum(r * self.ca + z * self.sa, 0.0)
        r, z = r - back * self.ca, z - back * self.sa
        A = np.hypot(r, z)
        return r, z, A, A - self.A0

    def energy(self, q: Any) -> Any:
        """V(q) [N·m]."""
        _, _, _, delta = self.state(q)
        n = self.exponent
        stored = np.sum(self.K / (n + 1) * np.maximum(delta, 0.0) ** (n + 1))
        return stored - self.load @ q

    def push(self, q: Any) -> Any:
        """What the contacts push with (5,) [N], moments over r_d."""
        r, z, A, delta = self.state(q)
        Q = self.K * np.maximum(delta, 0.0) ** self.exponent
        safe = np.where(A > 0.0, A, 1.0)
        # a guarded ball feels only what moves it across its line
        along = r * self.ca + z * self.sa
        held = (along <= 0.0)[:, None]
        across = z * self.ca - r * self.sa
        free = self.radial * (r / safe)[:, None] + self.axial * (z / safe)[:, None]
        side = (self.axial * self.ca[:, None] - self.radial * self.sa[:, None]) * (across / safe)[
            :, None
        ]
        return np.where(held, side, free).T @ Q

    def near_a_kink(self, q: Any) -> bool:
        """Whether differences at q would cross a touching or a passing of centres."""
        delta = self.state(q)[3]
        r, z = self.r0 + self.radial @ q, self.z0 + self.axial @ q
        along = np.abs(r * self.ca + z * self.sa)
        return bool(np.abs(delta).min() < NEAR_A_KINK or along.min() < NEAR_A_KINK)


def verdict(found: Equilibrium, i: int, rng: np.random.Generator) -> str:
    """What is wrong with the answer at cage angle i; empty where nothing is."""
    status = int(found.status[i])
    if status == kernels.NOT_CONVERGED:
        return found.reason(i)
    if status != kernels.CONVERGED:
        return ""
    contacts = Contacts(found.scene, float(found.cage_angles[i]))
    units = contacts.units
    q = found.displacement[i].astype(Long) * units
    free = [("x", "y", "z", "rx", "ry").index(name) for name in found.dofs]
    size = max(np.abs(contacts.push(q)).max(), np.abs(contacts.load).max(), Long(1e-30))
    left = np.abs(contacts.push(q) - contacts.load)[free].max() / size
    # what the digits of a displacement in double precision leave is not the solver's
    K = found.stiffness[i] / np.outer(units, units).astype(float)
    far = max(float(np.abs(q).max()), float(contacts.A0.max()))
    digits = 1e-15 * np.abs(K).max() * far / float(size)
    if left > RESIDUAL + 10.0 * digits:
        return f"residual {float(left):.1e}"
    if np.abs(K - K.T).max() > 1e-12 * np.abs(K).max():
        return "the stiffness is not symmetric"
    least = float(np.linalg.eigvalsh(K).min())
    if least < -1e-10 * np.abs(K).max():
        return f"the stiffness has an eigenvalue of {least:.1e} of {np.abs(K).max():.1e}"
    for _ in range(2):
        d = rng.normal(size=5).astype(Long) * contacts.A0[0] * Long(10.0 ** rng.uniform(-4, 0))
        bend = contacts.energy(q + d) + contacts.energy(q - d) - 2 * contacts.energy(q)
        scale = abs(contacts.energy(q + d)) + abs(contacts.energy(q - d)) + abs(contacts.energy(q))
        if bend < -1e-15 * scale:
            return f"the energy is not convex: {float(bend / scale):.1e}"
    if contacts.near_a_kink(q):
        return ""
    slope = np.empty((5, 5), dtype=Long)
    for k in range(5):
        step = np.zeros(5, dtype=Long)
        step[k] = Long(STEP)
        slope[:, k] = (contacts.push(q + step) - contacts.push(q - step)) / (2 * Long(STEP))
    off = float(np.abs(slope - K).max() / np.abs(K).max())
    return f"the stiffness is {off:.1e} from finite differences" if off > 1e-4 else ""


def judged(rng: np.random.Generator, kind: str) -> tuple[Scene, Equilibrium, str]:
    """A random scene of a kind, its answer at one cage angle, and what is wrong with it."""
    scene = random_scene(rng, kind)
    found = equilibrium(scene, [float(rng.uniform(0.0, 6.28))])
    return scene, found, verdict(found, 0, rng)
