"""The contact of balls and races written a second time, slowly and as on paper.

Nothing here is shared with the compiled code but the drop of a ball's centre, which has tests of
its own. `Balls` are massless and held by both races together, in extended precision; `TwoContacts`
are balls with a place of their own. Tilts of `Balls` are carried as r_d θ and moments as M/r_d, so
that q is five lengths and F five forces.

Quantity                                           | Symbol   | Unit
-------------------------------------------------- | -------- | ----
vector between the groove centres                  | δr*, δz* | m
its part along the unloaded line of contact        | p        | m
its length, and the compression                    | A, δ     | m
gradients in q of the ball's motion along and across the unloaded line | along, across |
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, wraps
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore import DOF_NAMES, Bearing, Scene
from bearingcore.model.statics import drops_now

Long = np.longdouble
Array = NDArray[np.floating]

GRAVITY = 9.80665

NEARLY_STRAIGHT = 1e3
"""[m] taken for centres of races that are straight: farther off a compression loses its digits."""


def gradients(angle: Array, place: Array, reach: Array) -> tuple[Array, Array]:
    """Gradients (N_b, 5) of radial and axial displacement at angles [rad] (Eqs. 11, 12).

    Tilts are lengths: the rotation times the radius r_d of the groove centres. `place` along the
    shaft and `reach`, the row's own radius of groove centres, are parts of it.
    """
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.zeros_like(c), np.ones_like(c)
    return (
        np.stack([c, s, zero, -place * s, place * c], 1),
        np.stack([zero, zero, one, reach * s, -reach * c], 1),
    )


def straightened(vector: Array, line: Array) -> tuple[Array, Array]:
    """Vectors (N_b, 2) between groove centres without their part against the unloaded line.

    Centres that have passed each other do not press. Also returned is the part p (N_b,) along the
    line (2,) or (N_b, 2), negative for these.
    """
    p = (vector * line).sum(axis=-1)
    return vector - np.minimum(p, 0.0)[:, None] * line, p


def remembered(method: Callable[..., Any]) -> Callable[..., Any]:
    """A method of `Balls` and q that is computed once for each q."""

    @wraps(method)
    def recall(self: Balls, q: Array) -> Any:
        key = (method.__name__, np.asarray(q, dtype=Long).tobytes())
        if key not in self.memory:
            self.memory[key] = method(self, q)
        return self.memory[key]

    return recall


def centers_apart(bearing: Bearing) -> float:
    """A0 [m]; of straight races so far that a line of contact hardly turns, if it can at all."""
    far = NEARLY_STRAIGHT if bearing.contact_angle else bearing.ball_diameter
    return bearing.groove_center_distance or far


def rows_of(bearing: Bearing) -> list[dict[str, float]]:
    """Return the numbers of the contacts of each row, written out from its dimensions."""
    b, rows = bearing, []
    for row in b.all_rows:
        n = b.n_balls if row.n_balls is None else row.n_balls
        angle = b.contact_angle if row.contact_angle is None else row.contact_angle
        each = {
            "n": n, "angle": angle, "K": b.load_deflection_factor, "pace": 1.0,
            "reach": b.groove_center_radius, "A0": centers_apart(b),
            "place": row.place, "facing": row.facing, "turn": row.turn, "offset": row.offset,
            "slack": b.radial_clearance + row.clearance, "D": b.ball_diameter,
        }  # fmt: skip
        rows.append(each)
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
        each["D"] = D
        each["K"] *= drawn.load_deflection_factor / base.load_deflection_factor
        each["reach"] = 0.5 * pitch + (r_i - 0.5 * D) * math.cos(angle)
        each["A0"] = r_i + r_o - D
        slow = b.ball_diameter * math.cos(b.contact_angle) / b.pitch_diameter
        each["pace"] = (1.0 - D * math.cos(angle) / pitch) / (1.0 - slow)
    if b.kind.name == "rows":  # placed by their balls; the inner grooves are further along the line
        for row, each in zip(b.all_rows, rows, strict=True):
            beyond = each["reach"] - 0.5 * (row.pitch_diameter or b.pitch_diameter)
            each["place"] += each["facing"] * beyond * math.tan(each["angle"])
    return rows


@dataclass(frozen=True)
class Balls:
    """The balls or rollers of a scene at one cage angle [rad], and the inner ring's energy."""

    scene: Scene
    cage_angle: float
    as_printed: bool = False
    """whether the distance of the groove centres has no sign, so that passed centres press"""
    memory: dict[tuple[str, bytes], Any] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def rows(self) -> list[dict[str, float]]:
        """See `rows_of`."""
        return rows_of(self.scene.bearing)

    def each(self, name: str) -> Array:
        """(N_b,) a number of each ball's row."""
        return np.concatenate([np.full(int(row["n"]), row[name], Long) for row in self.rows])

    @cached_property
    def angle(self) -> NDArray[np.float64]:
        """(N_b,) [rad]"""
        return np.concatenate(
            [
                row["pace"] * self.cage_angle
                + (row["turn"] + 2.0 * math.pi / row["n"] * np.arange(row["n"]))
                for row in self.rows
            ]
        )

    @cached_property
    def drop(self) -> Array:
        """(N_b,) [m] into all defects."""
        return drops_now(self.scene, self.cage_angle).astype(Long)

    @cached_property
    def distance(self) -> Array:
        """(N_b,) A0 [m]."""
        return self.each("A0")

    @cached_property
    def factor(self) -> Array:
        """(N_b,) K [N/m^n]."""
        return self.each("K")

    @cached_property
    def exponent(self) -> Long:
        """The n of Eq. 13, of points or lines."""
        return Long(10) / Long(9) if self.scene.bearing.kind.line_contact else Long(1.5)

    @cached_property
    def load(self) -> Array:
        """(5,) [N], moments over r_d."""
        return self.scene.load.vector.astype(Long) / self.units

    @cached_property
    def units(self) -> Array:
        """(5,) what a scaled displacement is divided by to give metres and radians."""
        return np.array([1.0, 1.0, 1.0, *[self.scene.bearing.groove_center_radius] * 2], dtype=Long)

    @cached_property
    def radial_axial(self) -> tuple[Array, Array]:
        """Gradients (N_b, 5) of a ball's radial and axial displacement (Eqs. 11, 12)."""
        lever = Long(self.scene.bearing.groove_center_radius)
        return gradients(
            self.angle.astype(Long), self.each("place") / lever, self.each("reach") / lever
        )

    @cached_property
    def along_across(self) -> tuple[Array, Array]:
        """Gradients (N_b, 5) of a ball's motion along and across the unloaded line of contact."""
        radial, axial = self.radial_axial
        ca, sa = self._line.T[:, :, None]
        return radial * ca + axial * sa, axial * ca - radial * sa

    @cached_property
    def _line(self) -> Array:
        """(N_b, 2) the unloaded line of contact, radial and axial."""
        alpha = self.each("angle")
        return np.stack([np.cos(alpha), self.each("facing") * np.sin(alpha)], 1)

    @remembered
    def vector(self, q: Array) -> tuple[Array, Array, Array]:
        """δr*, δz* (N_b,) [m] (Eqs. 9, 10) with a negative p taken off, and p over A0."""
        radial, axial = self.radial_axial
        q, line, slack = q.astype(Long), self._line, self.each("slack")
        vector = np.stack([radial @ q - slack, axial @ q + self.each("offset")], 1)
        vector += (self.distance - self.drop)[:, None] * line
        if self.as_printed:
            return vector[:, 0], vector[:, 1], np.full(len(vector), np.inf, Long)
        vector, p = straightened(vector, line)
        return vector[:, 0], vector[:, 1], p / self.distance

    @remembered
    def compression(self, q: Array) -> Array:
        """δ (N_b,) [m], negative for gaps."""
        dr, dz, _ = self.vector(q)
        return np.hypot(dr, dz) - self.distance

    @remembered
    def ball_load(self, q: Array) -> Array:
        """Q (N_b,) [N] (Eq. 13)."""
        return self.factor * np.maximum(self.compression(q), 0.0) ** self.exponent

    def contact_stiffness(self, load: Array) -> Array:
        """Slopes n K^(1/n) Q^(1 − 1/n) (N_b,) [N/m] of the contacts under loads [N]."""
        n = self.exponent
        return n * self.factor ** (1 / n) * load ** (1 - 1 / n)

    def energy(self, q: Array) -> float:
        """V(q) [N·m]: what the contacts store, less the work of the load."""
        more = self.exponent + 1
        stored = np.sum(self.factor / more * np.maximum(self.compression(q), 0.0) ** more)
        return stored - self.load @ q.astype(Long)

    def rounding(self, q: Array) -> float:
        """Effect of rounding on the energy [N·m]: on its lengths, and to the work of the load."""
        lengths = self.drop + self.distance + np.linalg.norm(q)
        size = float(self.ball_load(q) @ lengths + np.abs(self.load * q).sum())
        return float(np.finfo(Long).eps) * size

    @remembered
    def directions(self, q: Array) -> tuple[Array, Array]:
        """Gradients (N_b, 5) in q along each contact and across it."""
        dr, dz, _ = self.vector(q)
        A = np.maximum(np.hypot(dr, dz), Long(1e-300))[:, None]
        er, ez = dr[:, None] / A, dz[:, None] / A
        radial, axial = self.radial_axial
        return er * radial + ez * axial, er * axial - ez * radial

    @remembered
    def contact_force(self, q: Array) -> Array:
        """(5,) [N] with which the contacts resist the load (Eq. 15)."""
        return self.ball_load(q) @ self.directions(q)[0]

    def stiffness(self, q: Array, passed: float = 0.0, faint: float = 0.0) -> Array:
        """(5, 5) [N/m] (Eq. 17), from directions along and across each contact.

        `passed` is the p, over A0, up to which the centres of a ball count as passed, `faint` the
        load [N] from which on a ball counts.
        """
        dr, dz, p = self.vector(q)
        along, across = self.directions(q)
        load = self.ball_load(q)
        load = np.where(load > faint, load, 0.0)
        push = self.contact_stiffness(load)
        turn = np.where(p > passed, load / np.maximum(np.hypot(dr, dz), Long(1e-300)), 0.0)
        if self.scene.bearing.kind.line_contact:  # straight races do not let it turn
            turn = np.zeros_like(turn)
        return (along.T * push) @ along + (across.T * turn) @ across

    def unbalanced(self, q: Array, active: list[int]) -> float:
        """Size of the unbalanced load along `active` [N]."""
        return float(np.linalg.norm((self.contact_force(q) - self.load)[active].astype(float)))

    def whole_load(self, q: Array, active: list[int]) -> float:
        """Size of the load along `active` and of what the other directions take [N].

        That of the greatest ball load where there is none, as in a pair that is only preloaded.
        """
        whole = self.contact_force(q).copy()
        whole[active] = self.load[active]
        return float(np.linalg.norm(whole.astype(float))) or float(self.ball_load(q).max())


class Attempt(NamedTuple):
    """End of Newton's method: scaled displacement (5,) [m], and why it failed, if it did."""

    q: NDArray[np.float64]
    failure: str


def newton(balls: Balls, start: Array, steps: int = 100, tolerance: float = 1e-9) -> Attempt:
    """Newton-Raphson on the balance of loads (Eq. 15) from q (5,) [m]: full steps alone."""
    active = [DOF_NAMES.index(name) for name in balls.scene.active_dofs]
    size = float(np.linalg.norm(balls.load[active].astype(float)))
    q = np.array(start, dtype=float)
    for _ in range(steps):
        unbalanced = (balls.load - balls.contact_force(q))[active].astype(float)
        if np.linalg.norm(unbalanced) <= tolerance * size:
            return Attempt(q, "")
        matrix = balls.stiffness(q).astype(float)[np.ix_(active, active)]
        try:
            q[active] += np.linalg.solve(matrix, unbalanced)
        except np.linalg.LinAlgError:
            return Attempt(q, "singular matrix")
    return Attempt(q, "does not settle")


def motion_rates(
    scene: Scene, damping: float, t: float, y: NDArray[np.float64]
) -> NDArray[np.float64]:
    """dy/dt (4 n,) of displacements and velocities of inner and outer ring (Eq. 18).

    Rotations are carried times r_d; `damping` [N·s/m] is that of each contact. δ̇ is taken by
    differences: along the motion, the turning of the cage and the slope of the path together.
    """
    dofs, cage, step = scene.active_dofs, scene.cage_speed * t, 1e-7
    index = [DOF_NAMES.index(name) for name in dofs]
    inner, inner_velocity, outer, outer_velocity = y.reshape(4, -1)
    q, v = np.zeros((2, 5))
    q[index], v[index] = inner - outer, inner_velocity - outer_velocity
    balls = Balls(scene, cage)
    behind, ahead = (
        Balls(scene, cage + h * scene.cage_speed).compression(q + h * v) for h in (-step, step)
    )
    push = balls.ball_load(q) + damping * (ahead - behind) / (2.0 * step)
    push = np.where(balls.compression(q) > 0.0, push, 0.0)
    if scene.contact_law == "no tension":
        push = np.maximum(push, 0.0)
    contact = (push @ balls.directions(q)[0])[index].astype(float)
    support, squared = scene.support, balls.units[index].astype(float) ** 2
    ground = support.stiffness(dofs) * outer + support.damping(dofs) * outer_velocity
    load = balls.load[index].astype(float)
    return np.concatenate([
        inner_velocity, squared / support.inertia("inner", dofs) * (load - contact),
        outer_velocity, (squared * contact - ground) / support.inertia("outer", dofs),
    ])  # fmt: skip


@dataclass
class TwoContacts:
    """Contacts of all balls of a scene with the cage at an angle [rad].

    inner, outer (5,): displacements of the rings [m, rad]; place (2, N_b) [m] of the balls, radial
    and axial, against balls that touch the outer race with the rings concentric.
    """

    scene: Scene
    cage_angle: float
    inner: np.ndarray
    outer: np.ndarray
    place: np.ndarray

    def __post_init__(self) -> None:
        bearing = self.scene.bearing
        self.phi = self.cage_angle + 2.0 * math.pi / bearing.n_balls * np.arange(bearing.n_balls)
        u = np.array([math.cos(bearing.contact_angle), math.sin(bearing.contact_angle)])
        A_i, A_e = bearing.kind.race_distances(bearing)
        drop = {"inner": np.zeros(bearing.n_balls), "outer": np.zeros(bearing.n_balls)}
        for defect in self.scene.defects:
            drop[defect.race] += defect.path(self.phi, bearing, self.cage_angle)
        g_i = self._groove(self.inner) - [[bearing.radial_clearance], [0.0]]
        g_e = self._groove(self.outer)
        vectors = (
            np.outer(u, A_i - drop["inner"]) + g_i - self.place,
            np.outer(u, A_e - drop["outer"]) + self.place - g_e,
        )
        self.load, self.direction, self.energy = [], [], 0.0
        for vector, A, K in zip(vectors, (A_i, A_e), bearing.race_factors, strict=True):
            vector = straightened(vector.T, u)[0].T
            length = np.linalg.norm(vector, axis=0)
            delta = np.maximum(length - A, 0.0)
            self.load.append(K * delta**1.5)
            self.direction.append(vector / np.maximum(length, 1e-300))
            self.energy += float((0.4 * K * delta**2.5).sum())

    def _groove(self, q: np.ndarray) -> np.ndarray:
        """(2, N_b) [m] displacement of a ring's groove centres (Eqs. 11, 12)."""
        c, s = np.cos(self.phi), np.sin(self.phi)
        lever = self.scene.bearing.groove_center_radius
        return np.array([q[0] * c + q[1] * s, q[2] + lever * (q[3] * s - q[4] * c)])

    def force(self, race: int) -> np.ndarray:
        """(5,) [N, N·m] of the balls against a ring: what its load must balance."""
        radial, axial = self.load[race] * self.direction[race]
        c, s = np.cos(self.phi), np.sin(self.phi)
        lever = self.scene.bearing.groove_center_radius
        return np.array([
            (radial * c).sum(), (radial * s).sum(), axial.sum(),
            lever * (axial * s).sum(), -lever * (axial * c).sum(),
        ])  # fmt: skip

    def on_balls(self, *, centrifugal: float, weight: bool) -> np.ndarray:
        """(2, N_b) [N] radial and axial force that is left on each ball."""
        force = self.load[0] * self.direction[0] - self.load[1] * self.direction[1]
        force[0] += centrifugal
        if weight:
            force[0] -= self.scene.bearing.ball_mass * GRAVITY * np.sin(self.phi)
        return force
