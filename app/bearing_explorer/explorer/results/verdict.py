"""Status of the computation and limits of the model, in words, for all that is on screen."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from bearing_explorer.explorer.results.chain import Chain
from bearingcore import Equilibrium, Limit
from bearingcore.common import count, number, scientific, with_prefix
from bearingcore.model.scene import DOF_SYMBOLS
from bearingcore.model.statics import NO_OIL

MOTIONS = frozenset({"motion", "excerpt", "late_spectra"})
"""Attributes that come from a simulated motion."""

LIFE_FIELDS = " Enter them on the Machine tab, under Life."
"""Words after a limit that is unknown because no oil was entered."""


class Verdict(NamedTuple):
    """A sentence on the results on screen, and its `mood`: "good", "bad" or "busy"."""

    mood: str
    words: str


def statics_words(state: Equilibrium) -> str:
    """Say at how many cage angles of the curves there is no static equilibrium; empty if none."""
    bad = np.flatnonzero(~state.converged)
    if not bad.size:
        return ""
    reason = state.reason(int(bad[0]))
    if bad.size == state.converged.size:
        return f"No answer: {reason}"
    return f"No answer at {bad.size} of {state.converged.size} cage angles: {reason}"


def chain_words(chain: Chain) -> str:
    """Say at which share of all positions there is no equilibrium; empty if there always is one."""
    if chain.answered == 1.0:
        return ""
    share = number(100.0 * (1.0 - chain.answered), 2)
    return f"No answer at {share} % of the cage angles: {chain.reason}"


def details_of(state: Equilibrium) -> list[str]:
    """Details of the static equilibrium of the curves, for the status line."""
    finite = state.residual[state.converged & np.isfinite(state.residual)]
    symbols = " ".join(DOF_SYMBOLS[dof] for dof in state.dofs)
    freedom = count(len(state.dofs), "degree of freedom", "degrees of freedom")
    return [
        *([f"residual at most {scientific(float(finite.max()))}"] if finite.size else []),
        f"{freedom}: {symbols}",
        count(state.converged.size, "cage angle"),
    ]


def rows_of(limits: tuple[Limit, ...]) -> tuple[dict[str, Any], ...]:
    """Limits for the browser, crossed ones first: names, numbers and sentences in words."""
    rows = [
        {
            "name": limit.name,
            "value": _number(limit.value, limit.unit),
            "limit": _number(limit.limit, limit.unit),
            "state": "unknown"
            if math.isnan(limit.value)
            else "crossed"
            if limit.crossed
            else "kept",
            "short": f"{limit.name.capitalize()}: {_number(limit.value, limit.unit)} "
            f"(limit {_number(limit.limit, limit.unit)})",
            "sentence": limit.sentence
            + (LIFE_FIELDS if math.isnan(limit.value) and NO_OIL in limit.sentence else ""),
        }
        for limit in limits
    ]
    return tuple(sorted(rows, key=lambda row: row["state"] != "crossed"))


def _number(value: float, unit: str) -> str:
    if math.isnan(value):
        return "not known"
    if unit == "rad":
        return f"{number(math.degrees(value))}°"
    if unit:
        return with_prefix(value, unit)
    return number(value) if value >= 1e-4 or value == 0.0 else "below 0.0001"
