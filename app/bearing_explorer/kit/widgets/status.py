"""The status line, in words and in colour, and the tabs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
import param

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.results.verdict import verdict
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import TabChange, take
from bearing_explorer.kit.serve.live_component import LiveComponent
from bearingcore.common.numbers import count, scientific
from bearingcore.scene.scene import DOF_SYMBOLS


class StatusLine(LiveComponent):
    """Converged or not, residual, degrees of freedom and time taken."""

    #: {"mood": "good" | "bad" | "busy", "words": str, "details": [str, ...]}
    #: and, where it is of a picture, "tab": str and "resting": bool
    line = param.Dict(default={"mood": "busy", "words": "Computing", "details": []})
    #: of compiling: {"done": int, "of": int, "words": str, "still": bool}; empty once all is ready
    progress = param.Dict(default={})
    #: whether the details are behind a button, in a list that opens above the line
    folded = param.Boolean(default=False)

    _esm = scripts("element.js", "status.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("footer.css"),
        asset_text("status.css"),
    ]


class Tabs(LiveComponent):
    """The tabs of the page."""

    names = param.List(default=[])  # [[name, title, group], ...]
    active = param.String()

    _esm = scripts("element.js", "tabs.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("tabs.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, **params)
        self.on_msg(lambda event: take(asked, TabChange, event.data))


def status_of(
    results: Results, seconds: float, shown: frozenset[str] = frozenset()
) -> dict[str, Any]:
    """The status line of results that took `seconds` [s] to compute.

    `shown`: the attributes of the results that views on screen read.
    """
    found = results.equilibrium
    n_angles = found.converged.size
    mood, words = verdict(results, shown)
    details = []
    finite = found.residual[found.converged & np.isfinite(found.residual)]
    if finite.size:
        details.append(f"residual at most {scientific(float(finite.max()))}")
    symbols = " ".join(DOF_SYMBOLS[dof] for dof in found.dofs)
    freedom = count(len(found.dofs), "degree of freedom", "degrees of freedom")
    details.append(f"{freedom}: {symbols}")
    details.append(count(n_angles, "cage angle"))
    if results.is_coarse(shown):
        details.append(results.coarse_words(shown))
    by_hand = results.settings.changed_by_hand()
    details = [*by_hand, *details, f"{1e3 * seconds:.1f} ms of computing"]
    return {"mood": mood, "words": words, "details": details, "resting": not results.moving}
