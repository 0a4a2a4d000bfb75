"""A ball bearing in its plane, at many angles at once: a witness that shares nothing with ours.

Petersen, Howard & Prime (2014), Eqs. 3-6, 13, 15, 17, 24-29, by NumPy alone.
"""

import math

import numpy as np


class Plane:
    """A row of balls without contact angle under a load in its plane."""

    def __init__(self, balls: int, ball: float, pitch: float, K: float, clearance: float) -> None:
        self.balls, self.r, self.K, self.clearance = balls, 0.5 * ball, K, clearance
        self.cage = 0.5 * (1.0 - ball / pitch)
        self.radius = {"inner": 0.5 * (pitch - ball), "outer": 0.5 * (pitch + ball)}

    def drop(self, s: np.ndarray, race: str, edge: str, depth: float) -> np.ndarray:
        """Drop of a ball's centre, s inside the nearer edge: Eq. 6, or a ball on the corner."""
        R = self.radius[race]
        if edge == "published":
            root = self.r**2 - 0.25 * (R * s) ** 2
            drop = self.r - np.sqrt(np.maximum(root, 0.0))
        else:
            sign = 1.0 if race == "inner" else -1.0
            root = self.r**2 - (R * np.sin(s)) ** 2
            drop = sign * (R - R * np.cos(s)) + self.r - np.sqrt(np.maximum(root, 0.0))
        return np.where(s > 0.0, np.where(root > 0.0, np.minimum(drop, depth), depth), 0.0)

    def solve(
        self,
        load: float,
        cage: np.ndarray,
        middle: np.ndarray | float,
        defect: tuple[float, float, str, str],
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Loads of the balls (n, balls), stiffness (n, 2, 2) and Σ e e' of the loaded ones.

        At cage angles (n,), the middle of the defect (extent, depth, race, edge) at angles (n,), by
        Newton's method on the energy with steps that are halved until it falls.
        """
        extent, depth, race, edge = defect
        phi = cage[:, None] + 2.0 * math.pi / self.balls * np.arange(self.balls)
        away = (phi - np.reshape(middle, (-1, 1)) + math.pi) % (2.0 * math.pi) - math.pi
        gap = self.clearance + self.drop(0.5 * extent - np.abs(away), race, edge, depth)
        e = np.stack([np.cos(phi), np.sin(phi)])
        q = np.zeros((2, cage.size))
        q[1] = -(gap.min(axis=1) + 3.0 * (load / self.K) ** (2.0 / 3.0))
        force = np.array([[0.0], [-load]])

        def at(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            delta = np.maximum((q[:, :, None] * e).sum(axis=0) - gap, 0.0)
            return delta, 0.4 * self.K * (delta**2.5).sum(axis=1) - (force * q).sum(axis=0)

        delta, energy = at(q)
        for _ in range(100):
            off = (self.K * delta**1.5 * e).sum(axis=2) - force
            if np.abs(off).max() < 1e-9 * load:
                break
            k = 1.5 * self.K * np.einsum("ink,jnk,nk->nij", e, e, np.sqrt(delta))
            k += 1e-9 * np.trace(k, axis1=1, axis2=2)[:, None, None] * np.eye(2)
            step = -np.linalg.solve(k, off.T[:, :, None])[:, :, 0].T
            part = np.ones(cage.size)
            for _ in range(12):
                new, lower = at(q + part * step)
                worse = lower > energy + 1e-13 * np.abs(energy)
                if not worse.any():
                    break
                part[worse] *= 0.5
            q, delta, energy = q + part * step, new, lower
        assert np.quantile(np.abs(off).max(axis=0), 0.999) < 1e-6 * load
        k = 1.5 * self.K * np.einsum("ink,jnk,nk->nij", e, e, np.sqrt(delta))
        return self.K * delta**1.5, k, np.einsum("ink,jnk,nk->nij", e, e, delta > 0.0)


def undamped(k: np.ndarray, mass: float, support: float) -> np.ndarray:
    """(n, 4) [Hz] of two bodies of a mass, the outer one on its support, rising."""
    whole = np.block([[k, -k], [-k, k + support * np.eye(2)]]) / mass
    return np.sqrt(np.maximum(np.linalg.eigvalsh(whole), 0.0)) / (2.0 * math.pi)


def damped(k: np.ndarray, c: np.ndarray, mass: float, support: tuple[float, float]) -> np.ndarray:
    """The same with damping, |λ|/2π: `support` is its stiffness and its damping."""
    whole = [
        np.block([[one, -one], [-one, one + ground * np.eye(2)]]) / mass
        for one, ground in zip((k, c), support, strict=True)
    ]
    zero, unit = (np.broadcast_to(one, whole[0].shape) for one in (np.zeros((4, 4)), np.eye(4)))
    values = np.linalg.eigvals(np.block([[zero, unit], [-whole[0], -whole[1]]]))
    return np.sort(np.abs(values), axis=1)[:, ::2] / (2.0 * math.pi)
