"""The line that always says how the computation went: in words and in colour."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.compute.planning import by_hand
from bearing_explorer.compute.results import Results
from bearing_explorer.server.live_component import LiveComponent
from bearingcore.model.scene import DOF_SYMBOLS


class StatusLine(LiveComponent):
    """Converged or not, residual, degrees of freedom, time taken, or what was planned."""

    #: {"mood": "good" | "bad" | "busy", "words": str, "details": [str, ...]}
    line = param.Dict(default={"mood": "busy", "words": "Computing", "details": []})
    #: whether the details are behind a button, in a list that opens above the line
    folded = param.Boolean(default=False)

    _esm = scripts("element.js", "status.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("footer.css"),
        asset_text("status.css"),
    ]


class Tabs(LiveComponent):
    """Which section of the page is on screen."""

    names = param.List(default=[])  # [[name, title, group], ...]
    active = param.String()

    _esm = scripts("element.js", "tabs.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("tabs.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, **params)
        self.on_msg(lambda event: asked(event.data))


def status_of(
    results: Results, seconds: float, shown: frozenset[str] = frozenset()
) -> dict[str, Any]:
    """What the status line says about these results, which cost `seconds` [s] of computing.

    `shown`: the attributes of the results that views on screen read.
    """
    found = results.equilibrium
    n_angles = found.converged.size
    bad = np.flatnonzero(~found.converged)
    if bad.size == 0:
        mood, words = "good", "Converged"
    elif bad.size == n_angles:
        mood, words = "bad", f"No answer: {found.reason(int(bad[0]))}"
    else:
        reason = found.reason(int(bad[0]))
        mood = "bad"
        words = f"No answer at {bad.size} of {n_angles} cage angles: {reason}"
    details = []
    finite = found.residual[found.converged & np.isfinite(found.residual)]
    if finite.size:
        details.append(f"residual at most {scientific(float(finite.max()))}")
    overruled = by_hand(results.settings)
    symbols = " ".join(DOF_SYMBOLS[dof] for dof in found.dofs)
    if (plan := results.plan) is not None:
        planned = plan.sentence().replace(" DOF", f" DOF ({symbols})", 1)
        return {"mood": mood, "words": words, "details": [*overruled, planned, *details]}
    plural = "" if len(found.dofs) == 1 else "s"
    details.append(f"{len(found.dofs)} degree{plural} of freedom: {symbols}")
    details.append(f"{n_angles} cage angles")
    if results.is_coarse(shown):
        details.append("coarse while it moves: half the motion in half the steps")
    details = [*overruled, *details, f"{1e3 * seconds:.1f} ms of computing"]
    return {"mood": mood, "words": words, "details": details}


def scientific(value: float) -> str:
    """`value` as people write it: 3·10⁻¹²."""
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.0e}".split("e")
    return f"{mantissa}·10" + str(int(exponent)).translate(_RAISED)


_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
