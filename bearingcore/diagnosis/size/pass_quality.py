"""Whether a mean ball pass is evidence: how much of it is noise, and on how many harmonics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bearingcore.diagnosis.size.matching import Target


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
