"""Which directions are free to move, and what it would change if others were."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.plots import style
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources
from bearing_explorer.views.control_view import ControlView
from bearing_explorer.widgets.controls import Rows
from bearingcore import DOF_NAMES
from bearingcore.common.numbers import decibels as in_decibels
from bearingcore.common.numbers import percent, scientific
from bearingcore.scene.scene import DOF_SYMBOLS

if TYPE_CHECKING:
    from bearing_explorer.results.dof_comparison import DofComparison
    from bearing_explorer.results.results import Results

_WORDS = {
    "x": "x, sideways",
    "y": "y, up and down",
    "z": "z, along the shaft",
    "rx": "θx, tilt about x",
    "ry": "θy, tilt about y",
}


class DofRows(Rows):
    """The boxes and the differences in the browser."""

    #: {"needed": "x y", "active": "x y", "facts": [{label, symbol, value, about}]}
    shown = param.Dict(default={})

    _esm = scripts("element.js", "asking.js", "rows.js", "dof_comparison.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("controls.css"),
        asset_text("dof_comparison.css"),
    ]


class DofDifferences(ControlView):
    """The free directions of the inner ring, and the error of leaving some out."""

    name = "dofs"
    title = "Degrees of freedom"
    about = (
        "Directions in which the rings can move. The scene takes the fewest that are exact; force "
        "others on it, and see what that changes."
    )
    needs = frozenset({"dof_comparison", "spectra"})

    def build(self, packed: PackedSource) -> Any:
        spec = {"dofs": [[name, _WORDS[name]] for name in DOF_NAMES]}
        self.rows = DofRows(self.forward, spec=spec)
        return self.rows

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        return {}, {}

    def sentence(self, results: Results) -> str:
        found = results.dof_comparison
        needed = found.chosen == results.scene.needed_dofs
        text = f"{_listed(found.chosen)} {'is' if len(found.chosen) == 1 else 'are'} free"
        text += ", as the scene needs" if needed else ", which is forced on the scene"
        if found.chosen == found.other:
            why = results.scene.bearing.kind.left_out
            return f"{text}: {why}." if why else f"{text}; there is nothing left out."
        against = "all five free" if found.other == DOF_NAMES else f"{_listed(found.other)} free"
        static = [value for value in found.static.values() if math.isfinite(value)]
        if not static:
            return f"{text}; with {against} there is no answer to compare with."
        return f"{text}; against {against} static answers differ by {share(max(static))} at most."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is not None:
            found = results.dof_comparison
            against = "all five free" if found.other == DOF_NAMES else _listed(found.other)
            self.rows.put(
                shown={
                    "needed": " ".join(results.scene.needed_dofs),
                    "active": " ".join(found.chosen),
                    "against": against,
                    "facts": facts_of(found),
                }
            )

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.dof_comparison.table().named()


def facts_of(found: DofComparison) -> list[dict[str, str]]:
    """The differences in words."""
    if found.chosen == found.other:
        return []
    names = {
        "k_xx": ("Stiffness sideways", "k<sub>xx</sub>"),
        "k_yy": ("Stiffness up and down", "k<sub>yy</sub>"),
        "ball load": ("Loads of the balls", "Q"),
    }
    facts = [(*names[name], share(value)) for name, value in found.static.items()]
    facts += [
        ("Spectrum of the vibration", f"S<sub>{dof}</sub>", decibels(value))
        for dof, value in found.motion.items()
    ]
    if found.no_motion:
        facts.append(("Spectrum of the vibration", "S", f"none: {found.no_motion}"))
    return [dict(zip(("label", "symbol", "value"), fact, strict=True)) for fact in facts]


def share(value: float) -> str:
    """A relative difference in words: percent, or a power of ten where it is rounding."""
    if not math.isfinite(value):
        return "no answer"
    if value < 1e-6:
        return scientific(value)
    return percent(value, 2)


def decibels(value: float) -> str:
    """A difference of levels in words."""
    if not math.isfinite(value):
        return "no answer"
    return "below 0.01 dB" if value < 0.01 else in_decibels(value)


def _listed(dofs: tuple[str, ...]) -> str:
    return style.list_words([DOF_SYMBOLS[dof] for dof in dofs])
