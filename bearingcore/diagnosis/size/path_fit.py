"""Effect of the path from the housing to the sensor on a simulated ball pass.

Sensors are not on the rings: between them are plates and screws that ring, and a ball that strikes
the far edge makes more ring than two rigid bodies can. Neither is known, both are of a kind: a path
answers a blow at once and fades, and a strike happens where the exit is. So the measured pass D_n
is taken for

    D_n = (1 + H_n) S_n + B_n + error

with S_n the simulated one, H the transfer function of a random impulse response that fades by
exp(−t/T) in power, and B a random burst around the exit. All three are Gaussian, so how well a
simulation explains a pass, with every path there may be, has a closed form; what a path could
explain by chance is paid for by the determinant (the evidence of a Gaussian process).

Quantity                                   | Symbol | Name           | Unit
------------------------------------------ | ------ | -------------- | ----
size of H, root mean square                | α      | strength       |
time in which its power fades by e         | T      | ringing        | s
power of the burst, over that of the pass  | β²     | strike         |
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common.lazy import cached_property

STRIKE_REACH = 0.15
"""[rad] of a ball pass: standard deviation of where the strike is, about the exit."""

FEW = 8
"""Passes of which products are taken with all digits."""


@dataclass(frozen=True)
class PathModel:
    """Parameters of a path; all 0 for a sensor on the housing itself."""

    strength: float = 0.0
    ringing: float = 0.0
    strike: float = 0.0
    cost: float = 0.0
    """Taken off the score of whatever needs this path: the direct one is the likelier."""

    @property
    def direct(self) -> bool:
        """Whether there is no path."""
        return self.strength == 0.0 and self.strike == 0.0


DIRECT = PathModel()


class PathFit:
    """Evidence of simulated passes, behind any path, for a measured one of a direction.

    Parameters
    ----------
    model
        what the path may do.
    order : (N,)
        harmonics that are compared.
    frequency
        of ball passes [Hz].
    noise : (N,)
        variance of the measured coefficients about the simulation's, the pass having power 1.
    """

    def __init__(
        self, model: PathModel, order: NDArray[np.int_], frequency: float,
        noise: NDArray[np.float64],
    ) -> None:  # fmt: skip
        self.model = model
        self.order = order
        self.noise = noise
        apart = order[:, None] - order
        self.path = model.strength**2 / (1.0 + 2j * math.pi * frequency * model.ringing * apart)
        share = model.strike**2 / len(order)
        self.burst = share * np.exp(-0.5 * (STRIKE_REACH * apart) ** 2)
        self._apart = apart

    def explained(self, simulated: NDArray[np.complex128], exits: NDArray[np.float64]) -> Explained:
        """The evidence of passes (m, N) of power about 1 whose balls leave at phases (m,) [rad]."""
        prior = simulated[:, :, None] * self.path * simulated[:, None, :].conj()
        if self.model.strike > 0.0:
            prior = prior + self.burst * np.exp(-1j * exits[:, None, None] * self._apart)
        covariance = prior + np.diag(self.noise)
        lower = np.linalg.cholesky(covariance)
        diagonal = np.diagonal(lower, axis1=1, axis2=2).real
        size = 2.0 * np.log(diagonal).sum(axis=1) - np.log(self.noise).sum()
        return Explained(self, simulated, np.asarray(lower, dtype=complex), size / len(self.order))


@dataclass(frozen=True)
class Explained:
    """Covariances of what may be measured where simulated passes (m, N) are the cause.

    Attributes
    ----------
    complexity : (m,)
        what a path could explain by chance: mean logarithm by which it widens the covariance.
    """

    fit: PathFit
    simulated: NDArray[np.complex128]
    lower: NDArray[np.complex128]
    complexity: NDArray[np.float64]

    @cached_property
    def root(self) -> NDArray[np.complex128]:
        """(m, N, N) that makes what may be measured white; its square inverts the covariances.

        The squares themselves, N³ of work for each, are not needed: all that is used are
        products with vectors. Of many passes, which are compared and not refined, it is kept in
        half the digits: covariances of the noise allowed for are well conditioned.
        """
        several = len(self.lower) > FEW
        return np.asarray(np.linalg.inv(self.lower.astype(np.complex64 if several else complex)))

    def some(self, step: int) -> Explained:
        """Every so many of the passes."""
        other = Explained(
            self.fit, self.simulated[::step], self.lower[::step], self.complexity[::step]
        )
        other.__dict__["root"] = self.root[::step]
        return other

    def misfit(self, residual: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Quadratic form (m, l) of what is left (m, l, N) after the simulation, per harmonic."""
        white = residual.astype(self.root.dtype) @ self.root.swapaxes(1, 2)
        form = (white.real**2 + white.imag**2).sum(axis=2)
        return np.asarray(form / len(self.fit.order))

    def _weights(self, residual: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """The inverse covariances times what is left (m, N)."""
        white = self.root @ residual[:, :, None]
        return np.asarray((self.root.conj().swapaxes(1, 2) @ white)[:, :, 0])

    def whitened(self, residual: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Numbers (m, N) whose mean squared sizes are the misfit, of what is left (m, N)."""
        rooted = np.linalg.solve(self.lower, residual[:, :, None])[:, :, 0]
        return np.asarray(rooted / math.sqrt(len(self.fit.order)), dtype=complex)

    def transfer(self, residual: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """The most likely H (m, N), of what is left (m, N)."""
        weights = self._weights(residual)
        return np.asarray((self.fit.path @ (self.simulated.conj() * weights)[:, :, None])[:, :, 0])

    def left(self, residual: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Power (m,) that neither path nor burst take up, of what is left (m, N)."""
        weights = self._weights(residual)
        return np.asarray((np.abs(self.fit.noise * weights) ** 2).sum(axis=1))
