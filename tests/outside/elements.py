"""Rows of balls or rollers between two rings at rest: a witness of its own.

Petersen, Howard & Prime (2014), Eqs. 3-5 and 7-23, for rows at any place: written down from the
geometry of groove centres, minimised by SciPy, differentiated by complex steps (`march.py` has
their motion).
Everything takes complex numbers, so that no derivative is written down.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize, root
from scipy.special import ellipe, ellipk

Array = np.ndarray
STEP = 1e-20


@dataclass(frozen=True)
class Defect:
    """Of a race with exact edges or those of Eq. 6: SI, angles in radians, `inner` at angle 0."""

    extent: float
    depth: float
    race: float
    edge: str = "exact"
    center: float = 1.5 * math.pi
    inner: bool = False

    def drop(self, phi: Array, ball: float) -> Array:
        """How far a ball's centre of that radius goes into it at angles phi."""
        away = phi - self.center
        away = away - 2.0 * math.pi * np.round(away.real / (2.0 * math.pi))
        s = 0.5 * self.extent - np.where(away.real < 0.0, -away, away)
        part = np.where(s.real > 0.0, s, 0.0)
        if self.edge == "published":
            under = ball**2 - (0.5 * self.race * part) ** 2
            drop = ball - np.sqrt(np.where(under.real > 0.0, under, 0.0))
        else:
            under = ball**2 - (self.race * np.sin(part)) ** 2
            under_root = np.sqrt(np.where(under.real > 0.0, under, 0.0))
            bulge = -self.race if self.inner else self.race
            drop = bulge * (np.cos(part) - 1.0) + ball - under_root
        return np.where((under.real > 0.0) & (drop.real < self.depth), drop, self.depth)


@dataclass(frozen=True)
class Rows:
    """Rows of elements; `places` (n,) of the inner groove centres, `facing` 1 or -1 of each row.

    `apart`: of the groove centres, inf of straight races; `law`: K and exponent of both contacts;
    `preload` [m] of each row along the shaft.
    """

    count: int
    element: float
    angle: float
    lever: float
    apart: float
    clearance: float
    law: tuple[float, float]
    places: tuple[float, ...] = (0.0,)
    facing: tuple[int, ...] = (1,)
    preload: float = 0.0
    defect: Defect | None = None

    def angles(self, cage: complex | float) -> Array:
        """(rows · count,), one row after the other."""
        return np.tile(cage + 2.0 * math.pi / self.count * np.arange(self.count), len(self.places))

    def contacts(self, q: Array, cage: complex | float | Array) -> tuple[Array, Array]:
        """δ (rows · count,) of every element, negative where there is a gap, and its derivative by
        q (5, rows · count): of displacements (5, m, 1) at cage angles (m, 1), too.
        """
        phi = self.angles(cage)
        z, s = (np.repeat(one, self.count) for one in (self.places, self.facing))
        c, n = np.cos(phi), np.sin(phi)
        radial = q[0] * c + q[1] * n + z * (q[4] * c - q[3] * n) - self.clearance
        axial = s * (q[2] + self.lever * (q[3] * n - q[4] * c)) + self.preload
        down = np.zeros(phi.shape, dtype=phi.dtype)
        if self.defect:
            first = np.arange(phi.shape[-1]) < self.count
            down = np.where(first, self.defect.drop(phi, 0.5 * self.element), 0.0)
        ca, sa = math.cos(self.angle), math.sin(self.angle)
        if math.isinf(self.apart):
            across, along, delta = ca, sa, radial * ca + axial * sa - down
        else:
            radial, axial = radial + (self.apart - down) * ca, axial + (self.apart - down) * sa
            length = np.sqrt(radial**2 + axial**2)
            across, along = radial / length, axial / length
            ahead = (radial * ca + axial * sa).real > 0.0
            delta = np.where(ahead, length - self.apart, -1.0)
        turned = along * s * self.lever - across * z
        return delta, np.stack(
            [across * c, across * n, along * s + 0.0 * c, turned * n, -turned * c]
        )

    def compression(self, q: Array, cage: complex | float | Array) -> Array:
        """δ (rows · count,) of every element, negative where there is a gap."""
        return self.contacts(q, cage)[0]

    def load(self, q: Array, cage: complex | float | Array) -> Array:
        return self.pressed(self.compression(q, cage))

    def pressed(self, delta: Array) -> Array:
        pressed = np.where(delta.real > 0.0, delta, 0.0)
        return np.where(delta.real > 0.0, self.law[0] * pressed ** self.law[1], 0.0)

    def pushes(self, q: Array, cage: Array) -> Array:
        """Force of all elements (5, m) at displacements (5, m) and cage angles (m,)."""
        delta, directions = self.contacts(q[:, :, None], cage[:, None])
        return (directions * self.pressed(delta)).sum(axis=-1)

    def slopes(self, q: Array, cage: Array) -> Array:
        """Stiffness (m, 5, 5): derivatives of `pushes` by complex steps."""
        ways = [self.pushes(q + STEP * 1j * one[:, None], cage).imag for one in np.eye(5)]
        return np.stack(ways, axis=2).swapaxes(0, 1) / STEP

    def directions(self, q: Array, cage: float) -> Array:
        """∂δ/∂q (5, rows · count)."""
        steps = STEP * 1j * np.eye(5)
        return np.stack([self.compression(q + h, cage).imag for h in steps]) / STEP

    def rest(self, force: Array, cage: float, free: list[int], near: Array | None = None) -> Array:
        """Displacement (5,) of the least energy: BFGS, then the root of its gradient.

        `near`: the state at a cage angle nearby, from which the root is found.
        """
        size = np.array([1e-5, 1e-5, 1e-5, 3e-4, 3e-4])

        def full(p: Array) -> Array:
            q = np.zeros(5)
            q[free] = p * size[free]
            return q

        def gradient(p: Array) -> Array:
            q = full(p)
            off = self.directions(q, cage) @ self.load(q, cage) - force
            return (off * size)[free] / np.abs(force * size).max()

        def value(p: Array) -> tuple[float, Array]:
            q, n = full(p), self.law[1] + 1.0
            delta = np.maximum(self.compression(q, cage), 0.0)
            energy = self.law[0] / n * (delta**n).sum() - force @ q
            return float(energy / np.abs(force * size).max()), gradient(p)

        if near is not None:
            result = root(gradient, (near / size)[free], tol=1e-14, options={"xtol": 1e-14})
            if np.abs(gradient(result.x)).max() < 1e-9:
                return full(result.x)
        start = np.sign(force[free]) * np.array([2.0, 2.0, 2.0, 0.0, 0.0])[free]
        result = minimize(value, start, jac=True, method="BFGS", options={"gtol": 1e-8})
        return full(root(gradient, result.x, tol=1e-14, options={"xtol": 1e-14}).x)

    def curves(self, force: Array, cage: Array, free: list[int]) -> tuple[Array, Array]:
        """Loads (n, elements) and stiffness (n, 5, 5) at cage angles (n,), one after the other."""
        states: list[Array] = []
        for one in cage:
            states.append(self.rest(force, one, free, states[-1] if states else None))
        loads = [self.load(q, one) for q, one in zip(states, cage, strict=True)]
        stiffness = [self.stiffness(q, one) for q, one in zip(states, cage, strict=True)]
        return np.array(loads), np.array(stiffness)

    def states(self, force: Array, cage: Array, free: list[int]) -> tuple[Array, Array, Array]:
        """Displacement (5, m), loads (m, elements), stiffness (m, 5, 5) at all cage angles at once:
        Newton's method from the state at the first.
        """
        q = np.repeat(self.rest(force, cage[0], free)[:, None], cage.size, axis=1)
        size = np.array([1.0, 1.0, 1.0, 1.0 / self.lever, 1.0 / self.lever]) / np.abs(force).max()
        for _ in range(40):
            off = force[:, None] - self.pushes(q, cage)
            slopes = self.slopes(q, cage)
            missing = np.abs(off * size[:, None])[free].max()
            if missing < 1e-11:
                break
            inside = slopes[:, free][:, :, free]
            q[free] += np.linalg.solve(inside, off[free].T[:, :, None])[:, :, 0].T
        assert missing < 1e-9
        return q, self.load(q[:, :, None], cage[:, None]), slopes

    def stiffness(self, q: Array, cage: float) -> Array:
        """(5, 5): ∂(loads)/∂q, by differences of what complex steps give."""
        out = np.zeros((5, 5))
        for i, h in enumerate((1e-10, 1e-10, 1e-10, 1e-9, 1e-9)):
            ends = [
                self.directions(q + side * h * np.eye(5)[i], cage)
                @ self.load(q + side * h * np.eye(5)[i], cage)
                for side in (1.0, -1.0)
            ]
            out[:, i] = (ends[0] - ends[1]) / (2.0 * h)
        return out


def point_contact(D: float, across: float, along: float, plane: float = 210e9 / 0.91) -> Array:
    """K [N/m^1.5], pressure [Pa] and ellipse ratio at 1 N; curvatures [1/m] of the race.

    `plane` [Pa] is E/(1 − ν²), or the harmonic mean of both materials'.

    Hertz, by his integrals at the ratio that bisection finds (Harris, chapter 6).
    """
    A, B = 2.0 / D + across, 2.0 / D + along
    wanted = (B - A) / (A + B)
    low, high = 1.0 + 1e-9, 1e3
    for _ in range(200):
        k = math.sqrt(low * high)
        K, E = ellipk(1.0 - k**-2), ellipe(1.0 - k**-2)
        low, high = (k, high) if 1.0 - 2.0 / (k * k - 1.0) * (K / E - 1.0) < wanted else (low, k)
    factor = math.pi / math.sqrt(4.5) * k * plane * math.sqrt(E / ((A + B) * K**3))
    b = (6.0 * E / (math.pi * k * (A + B) * plane)) ** (1.0 / 3.0)
    return np.array([factor, 1.5 / (math.pi * k * b * b), k])
