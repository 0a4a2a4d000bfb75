"""Fast angular contact bearings by Jones's equations (1960), solved by SciPy.

Unknown are the place of each ball and of the ring; on each ball act its two contacts, its
centrifugal load and, where it is asked for, the couple of the gyroscopic moment, λ_o M_g/D at the
outer and (2 − λ_o) M_g/D at the inner race (Harris, Rolling Bearing Analysis, chapter 9).
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import root

from tests.outside.elements import point_contact


@dataclass(frozen=True)
class Jones:
    """SI; groove radii over the ball's diameter; E and ν of ball and race."""

    balls: int
    D: float
    pitch: float
    angle: float
    grooves: tuple[float, float]
    density: float
    ball: tuple[float, float]
    race: tuple[float, float]

    @property
    def factors(self) -> tuple[float, float]:
        """K [N/m^1.5] of the inner and the outer contact."""
        compliance = [(1.0 - nu * nu) / E for E, nu in (self.ball, self.race)]
        factors = [
            point_contact(
                self.D,
                -1.0 / (groove * self.D),
                side / (0.5 * (self.pitch / math.cos(self.angle) - side * self.D)),
                2.0 / sum(compliance),
            )[0]
            for groove, side in zip(self.grooves, (1.0, -1.0), strict=True)
        ]
        return factors[0], factors[1]

    def solve(
        self, thrust: float, radial: float, speed: float, gyroscopic: bool
    ) -> tuple[np.ndarray, ...]:
        """Loads (2, balls), angles (2, balls), inner race first, M_g and δ along y, z.

        The radial load acts along +y with a ball at every 2π/Z from +x on; tilts are held.
        """
        phi = 2.0 * math.pi * np.arange(self.balls) / self.balls
        ca, sa = math.cos(self.angle), math.sin(self.angle)
        K_i, K_o = self.factors
        a_i, a_o = ((groove - 0.5) * self.D for groove in self.grooves)
        mass = self.density * math.pi * self.D**3 / 6.0
        g, inertia = self.D / self.pitch, 0.1 * mass * self.D**2

        def ball(q: np.ndarray) -> tuple[np.ndarray, ...]:
            """Contacts of balls at places (radial, axial) from the outer groove's centre."""
            y, z, places = q[0], q[1], q[2:].reshape(2, -1)
            centre = np.stack(
                [(a_i + a_o) * ca + y * np.sin(phi), (a_i + a_o) * sa + z + 0.0 * phi]
            )
            lengths = np.linalg.norm(centre - places, axis=0), np.linalg.norm(places, axis=0)
            alpha = [np.arctan2(v[1], v[0]) for v in (centre - places, places)]
            loads = [
                K * np.maximum(length - own, 0.0) ** 1.5
                for K, length, own in zip((K_i, K_o), lengths, (a_i, a_o), strict=True)
            ]
            # outer race control: no spin at the outer contact
            beta = np.arctan2(np.sin(alpha[1]), np.cos(alpha[1]) + g)
            outer = (np.cos(alpha[1]) + np.tan(beta) * np.sin(alpha[1])) / (
                1 + g * np.cos(alpha[1])
            )
            inner = (np.cos(alpha[0]) + np.tan(beta) * np.sin(alpha[0])) / (
                1 - g * np.cos(alpha[0])
            )
            rolling = speed / ((outer + inner) * g * np.cos(beta))
            turning = 1.0 + np.cos(alpha[0] - alpha[1])
            cage = speed * (1.0 - g * np.cos(alpha[0])) / turning
            moment = inertia * rolling * cage * np.sin(beta)
            return np.array(loads), np.array(alpha), moment, cage

        def off(p: np.ndarray) -> np.ndarray:
            q = 1e-6 * p
            loads, alpha, moment, cage = ball(q)
            if not gyroscopic:
                cage = 0.5 * speed * (1.0 - g * ca)
            force = 0.5 * mass * self.pitch * cage**2
            push = 2.0 * moment / self.D if gyroscopic else 0.0 * moment  # all at the outer race
            cosine, sine = loads * np.cos(alpha), loads * np.sin(alpha)
            outwards = cosine[0] - cosine[1] + force + push * np.sin(alpha[1])
            along = sine[0] - sine[1] - push * np.cos(alpha[1])
            ring = radial - (cosine[0] * np.sin(phi)).sum(), thrust - sine[0].sum()
            return np.concatenate([ring, outwards, along])

        start = np.concatenate([[0.0, 10.0], np.repeat(1e6 * a_o * np.array([ca, sa]), self.balls)])
        start[2:] *= 1.02
        for share in (0.0, 0.5, 1.0):  # centrifugal load comes on in steps
            whole, speed = speed, speed * share
            result = root(off, start, method="hybr", tol=1e-13, options={"maxfev": 100_000})
            start, speed = result.x, whole
        assert np.abs(off(start)).max() < 1e-6 * (thrust + abs(radial))
        loads, alpha, moment, _ = ball(1e-6 * start)
        return loads, alpha, moment, 1e-6 * start[:2]


STEEL = 1.99948e11, 0.25
CASES = {
    # bearing, thrust, radial load, turns a minute: trullatest.m of OpenJones (2015)
    "Zenker": (
        Jones(18, 12.7e-3, 90e-3, math.radians(25), (6.8 / 12.7, 6.66 / 12.7), 7750.37,
              (2.1008e11, 0.3), (2.1008e11, 0.3)), 4150.0, 0.0, 11_111.111,
    ),
    "Gupta": (
        Jones(6, 8e-3, 31e-3, math.radians(24), (0.56, 0.52), 7750.37, STEEL, STEEL),
        2000.0, 400.0, 120_000.0,
    ),
    "Ma": (
        Jones(12, 6.35e-3, 31.031e-3, math.radians(25), (3.43 / 6.35, 3.3 / 6.35), 7750.37,
              (310e9, 0.27), STEEL), 500.0, 200.0, 30_000.0,
    ),
    "Nosaka, steel": (
        Jones(10, 7.938e-3, 38.5e-3, math.radians(20), (0.56, 0.52), 7750.37, STEEL, STEEL),
        2670.0, 0.0, 50_000.0,
    ),
    "Nosaka, hybrid": (
        Jones(10, 7.938e-3, 38.5e-3, math.radians(20), (0.56, 0.52), 3160.0, (320e9, 0.26), STEEL),
        2700.0, 0.0, 50_000.0,
    ),
}  # fmt: skip
