"""Status of the computation, in words and colour: one verdict for all that is on screen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bearing_explorer.kit.compute.compiling import StillCompiling
from bearing_explorer.kit.sentences import words_of
from bearingcore.common import count, number, scientific
from bearingcore.model.dynamics import OrbitStatus
from bearingcore.model.scene import DOF_SYMBOLS

if TYPE_CHECKING:
    from bearing_explorer.explorer.results.results import Results

ORBITS = frozenset({"orbit"})
"""Attributes of the results that are of the steady orbit."""
MOTIONS = frozenset({"motion", "excerpt", "late_spectra"})
"""Attributes that are of a simulated motion."""

BALLS = frozenset({"ball_mass"})
"""Attributes that compare motions without and with the mass of balls."""

LOST = {
    "-1": "Unstable: period doubling (flip)",
    "pair": "Unstable: second frequency (Neimark–Sacker)",
    "+1": "Unstable: jump to another orbit (fold)",
}
"""Losses of stability, by the place where the largest multiplier leaves the unit circle."""

_NO_ORBIT = {
    OrbitStatus.NO_PERIOD: "No common period",
    OrbitStatus.NO_START: "No static state",
}


class Verdict(NamedTuple):
    """`mood`: "good", "bad" or "busy"."""

    mood: str
    words: str


def verdict(results: Results, shown: frozenset[str]) -> Verdict:
    """The verdict on what is on screen: `shown` are the attributes that its views read.

    The first failure counts: without a static state there is no motion, and a motion that broke
    off has no orbit. An orbit that is shown is judged, converged or not: an unstable one is no
    place where a machine stays.
    """
    bad = statics_words(results)
    if not bad and "now" in shown:
        bad = words_of_now(results)
    if not bad and "chain" in shown:
        bad = chain_words(results)
    if bad:
        return Verdict("bad", bad)
    try:
        if shown & BALLS and results.ball_mass.broke_off:
            return Verdict("bad", f"No motion: {results.ball_mass.broke_off}")
        if shown & MOTIONS and results.fault:
            return Verdict("bad", f"The motion {results.fault}")
        if shown & ORBITS:
            return orbit_verdict(results)
    except StillCompiling as wait:
        return Verdict("busy", f"Not ready: {wait}")
    except ValueError as error:  # the view gives the whole sentence
        return Verdict("bad", f"No motion: {words_of(error)}")
    return Verdict("good", "Computed without problems")


def statics_words(results: Results) -> str:
    """At which cage angles of the curves no static equilibrium was found; empty for none."""
    states = results.equilibrium
    bad = np.flatnonzero(~states.converged)
    if not bad.size:
        return ""
    reason = states.reason(int(bad[0]))
    if bad.size == states.converged.size:
        return f"No answer: {reason}"
    return f"No answer at {bad.size} of {states.converged.size} cage angles: {reason}"


def words_of_now(results: Results) -> str:
    """Why there is no static equilibrium at the cage angle that is drawn; empty where there is."""
    now = results.now
    return "" if now.converged[0] else f"No answer at this cage angle: {now.reason(0)}"


def chain_words(results: Results) -> str:
    """The same wherever the change is followed: the shaft may turn too."""
    chain = results.chain
    if chain.answered == 1.0:
        return ""
    share = number(100.0 * (1.0 - chain.answered), 2)
    return f"No answer at {share} % of the cage angles: {chain.reason}"


def orbit_verdict(results: Results) -> Verdict:
    """Whether there is a steady orbit, and whether it is stable."""
    orbit = results.orbit
    if orbit is None:
        return Verdict("bad", "Orbit not searched")
    if orbit.multipliers.size:
        if orbit.stable:
            return Verdict("good", "Stable orbit")
        return Verdict("bad", LOST[orbit.through])
    if orbit.status in _NO_ORBIT:
        return Verdict("bad", _NO_ORBIT[orbit.status])
    return (
        Verdict("busy", "No orbit found yet")
        if results.moving
        else Verdict("bad", "No orbit found")
    )


def status_of(
    results: Results, seconds: float, shown: frozenset[str] = frozenset()
) -> dict[str, Any]:
    """The status line of results that took `seconds` [s] to compute.

    `shown`: the attributes of the results that views on screen read.
    """
    states = results.equilibrium
    n_angles = states.converged.size
    mood, words = verdict(results, shown)
    details = []
    finite = states.residual[states.converged & np.isfinite(states.residual)]
    if finite.size:
        details.append(f"residual at most {scientific(float(finite.max()))}")
    symbols = " ".join(DOF_SYMBOLS[dof] for dof in states.dofs)
    freedom = count(len(states.dofs), "degree of freedom", "degrees of freedom")
    details.append(f"{freedom}: {symbols}")
    details.append(count(n_angles, "cage angle"))
    if results.is_coarse(shown):
        details.append(results.coarse_words(shown))
    details = [*details, f"{1e3 * seconds:.1f} ms of computing"]
    return {"mood": mood, "words": words, "details": details, "resting": not results.moving}
