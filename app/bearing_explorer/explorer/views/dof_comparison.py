"""The free directions of the scene, and the error of leaving others out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import panel as pn

from bearing_explorer.explorer.results.dof_comparison import DofComparison
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.widgets.facts import Fact, facts_html, facts_pane
from bearing_explorer.kit.widgets.form import Fields, button, row
from bearingcore import DOF_NAMES
from bearingcore.common.numbers import decibels as in_decibels
from bearingcore.common.numbers import percent, scientific
from bearingcore.scene.scene import DOF_SYMBOLS

_WORDS = {
    "x": "x, sideways",
    "y": "y, up and down",
    "z": "z, along the shaft",
    "rx": "θx, tilt about x",
    "ry": "θy, tilt about y",
}


class DofDifferences(View):
    """The free directions of the inner ring, and the error of leaving some out."""

    name = "dofs"
    title = "Degrees of freedom"
    about = (
        "Directions in which the rings can move. The scene takes the fewest that are exact; force "
        "others on it, and see what that changes."
    )
    in_report = False
    needs = frozenset({"dof_comparison", "spectra"})

    def build(self, packed: PackedSource) -> Any:
        self._fields = Fields(lambda _: self.force(self._fields.values["dofs"]))
        boxes = pn.widgets.CheckBoxGroup(
            options={words: name for name, words in _WORDS.items()},
            css_classes=["dofs"],
            margin=0,
            stylesheets=[asset_text("form.css")],
        )
        self._fields.add("dofs", boxes)
        self._automatic = button("As the scene needs", lambda: self._ask("auto"), align="start")
        self._facts = facts_pane("", styles={"flex": "1 1 260px"})
        self._refusal = facts_pane("", visible=False)
        form = pn.Column(
            facts_pane("<h3>Free directions</h3>"), self._automatic, boxes, self._refusal,
            styles={"flex": "1 1 260px", "gap": "7px"}, margin=0,
        )  # fmt: skip
        return row(form, self._facts, styles={"align-items": "start", "gap": "10px 34px"})

    def force(self, dofs: Sequence[str]) -> None:
        """Force directions on the scene."""
        free = [name for name in DOF_NAMES if name in dofs]
        if free:
            self._ask(" ".join(free))
            return
        words = "At least one direction has to be free."
        self._refusal.param.update(object=f'<p role="alert">{words}</p>', visible=True)

    def _ask(self, dofs: str) -> None:
        self._refusal.visible = False
        if self.parts is not None:
            self.parts.ask({"choose": {"dofs": dofs}})

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
        differ = f"differ by {share(max(static))} at most" if any(static) else "are the same"
        return f"{text}; with {against} static answers {differ}."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is not None:
            found = results.dof_comparison
            against = "all five free" if found.other == DOF_NAMES else _listed(found.other)
            self._fields.put({"dofs": list(found.chosen)})
            self._automatic.disabled = found.chosen == results.scene.needed_dofs
            facts = facts_of(found)
            head = f"Greatest difference against {against}" if facts else "Nothing is left out"
            self._facts.object = f"<h3>{head}</h3>{facts_html(facts)}"

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.dof_comparison.table().named()


def facts_of(found: DofComparison) -> list[Fact]:
    """The greatest differences."""
    if found.chosen == found.other:
        return []
    names = {
        "k_xx": "Stiffness sideways <i>k<sub>xx</sub></i>",
        "k_yy": "Stiffness up and down <i>k<sub>yy</sub></i>",
        "ball load": "Loads of the balls <i>Q</i>",
    }
    facts = [Fact(names[name], share(value)) for name, value in found.static.items()]
    facts += [
        Fact(f"Spectrum of the vibration <i>S<sub>{dof}</sub></i>", decibels(value))
        for dof, value in found.motion.items()
    ]
    if found.no_motion:
        facts.append(Fact("Spectrum of the vibration <i>S</i>", f"none: {found.no_motion}"))
    return facts


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
