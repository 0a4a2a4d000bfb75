"""References for motions and statics: two families of methods each, and how far they are apart.

No method is its own reference. Motions are integrated by a multistep method of variable order
(LSODA) and by a one-step embedded pair (Dormand and Prince); static states are found as roots of
the forces in double precision (MINPACK) and as minima of the energy in extended precision.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.dynamics.problem import Array, MotionProblem
from bearingcore.experiments.integrators import METHODS, history_of
from bearingcore.experiments.points import Reference
from bearingcore.signals.spectrum import spectrum

TOLERANCE = 1e-13

MOTION_ERRORS = {
    "spectrum": "greatest error of the housing's spectrum [dB], up to 1.25 times the highest "
    "natural frequency, where a direction is within 40 dB of its greatest level",
    "acceleration": "root mean square error of the housing's acceleration over its root mean "
    "square",
    "displacement": "greatest error of a displacement over the greatest swing about the mean",
}
"""Errors of motions by name."""

TRUSTED = {"spectrum": 1e-2, "acceleration": 1e-3, "displacement": 1e-4}
"""How far apart the two families may be at most [as MOTION_ERRORS]."""

RESOLUTION = 32.0


@dataclass(frozen=True)
class MotionReference:
    """A motion that two families agree on, or not: `reference` says so.

    `history` (n, 6, directions) at `sample_rate` [Hz], that of LSODA.
    """

    problem: MotionProblem
    duration: float
    sample_rate: float
    band: float
    history: Array
    reference: Reference

    def errors(self, history: Array) -> dict[str, float]:
        """Errors of another history at the same instants, by the names in MOTION_ERRORS."""
        return motion_errors(history, self.history, self.sample_rate, self.band)


def motion_errors(
    found: Array, expected: Array, sample_rate: float, band: float
) -> dict[str, float]:
    """Errors of a history against another one, by the names in MOTION_ERRORS; band [Hz].

    Infinite where the motion found is not finite.
    """
    n = min(len(found), len(expected))
    found, expected = found[:n], expected[:n]
    if not np.all(np.isfinite(found)):
        return dict.fromkeys(MOTION_ERRORS, math.inf)
    places = expected[:, (0, 3)]
    swing = np.abs(places - places.mean(axis=0)).max()
    signal, mine = expected[:, 5], found[:, 5]
    size = math.sqrt(float(np.mean(signal**2)))
    with np.errstate(over="ignore"):
        displacement = float(np.abs(found[:, (0, 3)] - places).max() / swing)
        acceleration = math.sqrt(float(np.mean((mine - signal) ** 2))) / size
    return {
        "spectrum": spectrum_error(mine, signal, sample_rate, band),
        "acceleration": acceleration,
        "displacement": displacement,
    }


def spectrum_error(found: Array, expected: Array, sample_rate: float, band: float) -> float:
    """Greatest difference of two signals' spectra [dB], below `band` [Hz] and where it counts."""
    segment = round(sample_rate / RESOLUTION)
    resolution = RESOLUTION if len(expected) >= segment else sample_rate / len(expected) * 1.001
    if float(np.abs(found).max()) > 1e100:
        return math.inf
    frequency, density = spectrum(expected, sample_rate, resolution)
    other = spectrum(found, sample_rate, resolution).density
    counts = bins_that_count(frequency, density, band)
    if not counts.any():
        return math.nan
    with np.errstate(divide="ignore"):
        return float(np.abs(10.0 * np.log10(other[counts] / density[counts])).max())


def bins_that_count(frequency: Array, density: Array, band: float) -> NDArray[np.bool_]:
    """(m, k) where k spectra are worth comparing: below `band` [Hz], within 40 dB of their best.

    Directions that do not move have no spectrum to err in; of the first bins the mean of each
    segment, which is taken away, leaves no more than a remnant.
    """
    level = density.max(axis=0)
    strong = (density > 1e-4 * level) & (level > 1e-12 * level.max())
    counts: NDArray[np.bool_] = (
        strong & ((frequency > 2.5 * frequency[1]) & (frequency <= band))[:, None]
    )
    return counts


def motion_reference(
    problem: MotionProblem, duration: float, sample_rate: float, band: float
) -> MotionReference:
    """The motion by both families at a tolerance of 1e-13, and how far they are apart."""
    began = time.perf_counter()
    first = _multistep(problem, duration, sample_rate)
    second = METHODS["Dormand-Prince, stops"].march(problem, TOLERANCE, duration, sample_rate)
    agreement = motion_errors(second.history, first, sample_rate, band)
    note = ""
    if second.failure or not np.all(np.isfinite(first)):
        note = f"Dormand-Prince: {second.failure}" if second.failure else "LSODA did not finish"
    trusted = not note and all(agreement[name] <= TRUSTED[name] for name in TRUSTED)
    if not trusted and not note:
        note = "The motion may be sensitive to its start: errors grow whatever the method"
    reference = Reference(
        ("LSODA (multistep)", "Dormand-Prince (embedded pair)"),
        agreement,
        trusted,
        time.perf_counter() - began,
        note,
    )
    return MotionReference(problem, duration, sample_rate, band, first, reference)


def _multistep(problem: MotionProblem, duration: float, sample_rate: float) -> Array:
    """History by LSODA, in variables scaled to 1. It finds jumps by itself: its order falls."""
    from scipy.integrate import odeint  # imported late: slow to import

    time_ = np.arange(math.ceil(duration * sample_rate - 1e-9) + 1) / sample_rate
    scale = problem.scale

    def rate(t: float, y: Array) -> Array:
        return problem.rate(t, y * scale) / scale

    states = odeint(
        rate, problem.start / scale, time_, tfirst=True, rtol=TOLERANCE, atol=TOLERANCE,
        mxstep=1_000_000,
    )  # fmt: skip
    return history_of(problem, time_, states * scale)
