"""Whether a mean ball pass is evidence: is it one, and explained better than by chance?

A few harmonics can be laid over many simulated passes, and some of those will fit by luck. How well
luck does is found with the signal's own harmonics, their sizes kept and their phases drawn anew: of
such a pass everything is left that tones, resonances and the path to the sensor do to its spectrum,
and nothing of the order in which balls meet edges.
"""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass

import numpy as np

from bearingcore.diagnosis.size.matching import Prepared, Target

DRAWN_PASSES = 24
"""Passes with phases drawn anew."""


@dataclass(frozen=True)
class PassQuality:
    """Composition of a mean ball pass, in the band that is compared.

    Attributes
    ----------
    noise_share
        part of its power that is noise, mean over directions.
    strongest
        part of its power that the strongest harmonic carries.
    harmonics
        how many harmonics carry it: 1/Σ p², p the parts of the power.
    """

    noise_share: float
    strongest: float
    harmonics: float


def pass_quality(target: Target) -> PassQuality:
    """Noise and number of harmonics of a measured mean ball pass."""
    part = (np.abs(target.harmonics) ** 2 / target.energy).mean(axis=1)
    part = part / max(float(part.sum()), 1e-300)
    return PassQuality(
        noise_share=float(target.noise_share.mean()),
        strongest=float(part.max(initial=0.0)),
        harmonics=1.0 / max(float((part**2).sum()), 1e-300),
    )


class ByChance:
    """Fit of passes with the phases drawn anew by the same simulations."""

    def __init__(self, target: Target) -> None:
        rng = np.random.default_rng(0)
        count = len(target.harmonics)
        turns = np.exp(2j * math.pi * rng.uniform(size=(DRAWN_PASSES, count)))
        self._drawn = [target.harmonics * turn[:, None] for turn in turns]
        self._measured = target.harmonics
        self._drawn_least = np.full(DRAWN_PASSES, math.inf)
        self._least = math.inf
        self._lock = threading.Lock()

    def explain(self, simulated: Prepared) -> None:
        """Let the drawn passes be explained by simulations, as the measured one is.

        From any thread: the least of all does not depend on the order.
        """
        own = float(simulated.least_cost(self._measured).min())
        least = [float(simulated.least_cost(drawn).min()) for drawn in self._drawn]
        with self._lock:
            self._least = min(self._least, own)
            self._drawn_least = np.minimum(self._drawn_least, least)

    @property
    def share(self) -> float:
        """Part of the passes, the measured one among them, explained as well as it is or better."""
        return float((1 + np.sum(self._drawn_least <= self._least)) / (1 + DRAWN_PASSES))
