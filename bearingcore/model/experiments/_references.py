"""References for motions: several families of methods, and their differences.

No method is its own reference. Motions are integrated by a multistep method of variable order
(LSODA), and by a one-step embedded pair (Dormand and Prince's of order 8) that restarts when a ball
meets an edge or floor. If scikit-sundae is installed, a third code (CVODE, Adams) integrates
motions too. `_statics` has the references for statics.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bearingcore.common import Array, scientific
from bearingcore.model.dynamics._problem import MotionProblem
from bearingcore.model.experiments._integrators import HAS_CVODE, Rates, cvode_states, instants
from bearingcore.model.experiments._points import Reference
from bearingcore.recordings._spectrum_difference import spectrum_difference

TOLERANCE = 1e-13

KINK_SLIVER = 1e-13
"""Half the length [s] of the step across a kink; 1e-13 s times any jump is negligible."""

MOTION_ERRORS = {
    "spectrum": "greatest error of the housing's spectrum [dB], up to 1.25 times the highest "
    "natural frequency, where a direction is within 40 dB of its greatest level",
    "third octaves": "greatest error of the housing's level in a third octave [dB], up to as high",
    "series L2": "root mean square error of the housing's acceleration over its root mean square",
    "displacement": "greatest error of a displacement over the greatest swing about the mean",
    "final state": "greatest error of a displacement at the end, over the same swing",
}
"""Errors of motions by name."""

TRUSTED = {"spectrum": 1e-2, "series L2": 1e-3, "displacement": 1e-4}
"""Greatest differences of families that count as agreement, in units of MOTION_ERRORS."""

LEAST_RTOL = 2.3e-14
"""Least relative tolerance that SciPy accepts."""


@dataclass(frozen=True)
class MotionReference:
    """A motion by several families; `reference` says whether they agree.

    `history` (n, 6, directions) at `sample_rate` [Hz] is that of LSODA.
    """

    problem: MotionProblem
    duration: float
    sample_rate: float
    band: float
    history: Array
    reference: Reference

    def errors(self, history: Array) -> dict[str, float]:
        """Return the errors of another history at the same instants, by names in MOTION_ERRORS."""
        return motion_errors(history, self.history, self.sample_rate, self.band)


def motion_errors(
    history: Array, expected: Array, sample_rate: float, band: float
) -> dict[str, float]:
    """Return the errors of a history up to a frequency `band` [Hz], by the names in MOTION_ERRORS.

    They are infinite if the motion is not finite.
    """
    n = min(len(history), len(expected))
    history, expected = history[:n], expected[:n]
    if not np.all(np.isfinite(history)):
        return dict.fromkeys(MOTION_ERRORS, math.inf)
    places = expected[:, (0, 3)]
    swing = np.abs(places - places.mean(axis=0)).max()
    signal, tested = expected[:, 5], history[:, 5]
    size = math.sqrt(float(np.mean(signal**2)))
    with np.errstate(over="ignore"):
        displacement = np.abs(history[:, (0, 3)] - places) / swing
        series = math.sqrt(float(np.mean((tested - signal) ** 2))) / size
    return {
        "spectrum": spectrum_difference(tested, signal, sample_rate, band),
        "third octaves": spectrum_difference(tested, signal, sample_rate, band, third_octaves=True),
        "series L2": series,
        "displacement": float(displacement.max()),
        "final state": float(displacement[-1].max()),
    }


def motion_reference(
    problem: MotionProblem,
    duration: float,
    sample_rate: float,
    band: float,
    report: Callable[[float], object] = lambda part: None,
) -> MotionReference:
    """Compute the motion by all families at a tolerance of 1e-13, and compare them.

    `report` is called with the part done, 0 to 1.
    """
    time = instants(sample_rate, duration)
    families = FAMILIES if HAS_CVODE else FAMILIES[:2]

    def history(k: int, states: Callable[[Rates, Array], Array]) -> Array:
        rates = Rates(problem, lambda t: report((k + t / duration) / len(families)))
        return rates.history(time, states(rates, time))

    histories = [history(k, states) for k, (_, states) in enumerate(families)]
    first = histories[0]
    differences = [motion_errors(other, first, sample_rate, band) for other in histories[1:]]
    agreement = differences[0]
    finished = [bool(np.all(np.isfinite(history))) for history in histories]
    finished_of = dict(zip((name for name, _ in families), finished, strict=True))
    unfinished = [name.partition(" ")[0] for name, complete in finished_of.items() if not complete]
    # two families make a reference, even if a third one stops at a kink
    trusted = all(finished[:2]) and all(
        difference[name] <= TRUSTED[name]
        for difference, complete in zip(differences, finished[1:], strict=True)
        if complete
        for name in TRUSTED
    )
    note = ""
    if differences[1:]:
        note = f"CVODE is {scientific(differences[1]['spectrum'], 2)} dB from the first"
    if unfinished:
        note = f"{' and '.join(unfinished)} did not finish"
    elif not trusted:
        note = "The motion may be sensitive to its start: errors grow whatever the method"
    names = tuple(name for name, complete in finished_of.items() if complete or not trusted)
    reference = Reference(names, agreement, trusted, note)
    return MotionReference(problem, duration, sample_rate, band, first, reference)


def _multistep(rates: Rates, time: Array) -> Array:
    """Return scaled states at times [s] by LSODA, which reduces its order at jumps by itself."""
    from scipy.integrate import odeint  # imported late: slow to import

    states: Array = odeint(
        rates, rates.start, time, tfirst=True, rtol=TOLERANCE, atol=TOLERANCE, mxstep=1_000_000
    )
    return states


def _embedded_pair(rates: Rates, time: Array) -> Array:
    """Return scaled states at times [s] by DOP853, up to a failure.

    A very short step crosses each kink, so that the rates are smooth within all other steps.
    """
    from scipy.integrate import DOP853  # imported late: slow to import

    kinks = rates.problem.kinks(float(time[-1]))
    ends = np.append(kinks[:, None] + np.array([-KINK_SLIVER, KINK_SLIVER]), time[-1])
    y, now, filled = rates.start, 0.0, 1
    states = np.empty((len(time), y.size))
    states[0] = y
    for end in ends[ends > 0.0]:
        solver = DOP853(rates, now, y, end, rtol=LEAST_RTOL, atol=TOLERANCE)
        while solver.status == "running":
            solver.step()
            last = int(np.searchsorted(time, solver.t, side="right"))
            if solver.status != "failed" and last > filled:
                states[filled:last] = solver.dense_output()(time[filled:last]).T
                filled = last
        if solver.status == "failed":
            break
        y, now = solver.y, end
    return states[:filled]


FAMILIES = (
    ("LSODA (multistep)", _multistep),
    ("DOP853 (embedded pair)", _embedded_pair),
    ("CVODE (Adams)", lambda rates, time: cvode_states(rates, time, TOLERANCE)),
)
"""Integrators of the references; the last one is used only if it is installed."""
