"""The directions in which the rings are free to move."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn

from bearing_explorer.explorer.results import reasons
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.widgets.facts import facts_pane
from bearing_explorer.kit.widgets.form import Fields, button
from bearingcore import DOF_NAMES
from bearingcore.scene import DOF_SYMBOLS, FREE_TILT_WORDS, TILT_FREE

if TYPE_CHECKING:
    from bearing_explorer.explorer.results.results import Results

_WORDS = {
    "x": "x, sideways",
    "y": "y, up and down",
    "z": "z, along the shaft",
    "rx": "θx, tilt about x",
    "ry": "θy, tilt about y",
}


_CHOICES = {
    "auto": "A shaft on two bearings: tilt held",
    TILT_FREE: "This bearing alone holds the shaft: tilt free",
}


class FreeDirections(View):
    """A form for the free directions of the inner ring."""

    name = "dofs"
    title = "Degrees of freedom"
    about = (
        "Directions in which the rings can move. A shaft on two bearings does not tilt: the scene "
        "takes the fewest directions that are exact for it. One that this bearing alone holds may "
        "tilt, and a bearing carries less then. Or choose them one by one; the Accuracy tab says "
        "what fewer would change."
    )
    in_report = False

    def build(self, packed: PackedSource) -> Any:
        self._fields = Fields(lambda _: self.force(self._fields.values["dofs"]))
        boxes = pn.widgets.CheckBoxGroup(
            options={words: name for name, words in _WORDS.items()},
            css_classes=["dofs"],
            margin=0,
            stylesheets=[asset_text("form.css")],
        )
        self._fields.add("dofs", boxes)
        self._choices = {
            dofs: button(words, partial(self._ask, dofs), align="start")
            for dofs, words in _CHOICES.items()
        }
        self._refusal = facts_pane("", visible=False)
        parts = (*self._choices.values(), boxes, self._refusal)
        return pn.Column(*parts, styles={"gap": "7px"}, margin=0)

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
        scene = results.scene
        free = style.list_words([DOF_SYMBOLS[dof] for dof in scene.active_dofs])
        words = f"{free} {'is' if len(scene.active_dofs) == 1 else 'are'} free"
        tilt = FREE_TILT_WORDS if {"rx", "ry"} & set(scene.active_dofs) else ""
        return " ".join(filter(None, (f"{words}.", reasons.not_needed(scene), tilt)))

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is not None:
            scene = results.scene
            self._fields.put({"dofs": list(scene.active_dofs)})
            for dofs, choice in self._choices.items():
                with_it = scene.replace(dofs=None if dofs == "auto" else dofs)
                choice.disabled = with_it.active_dofs == scene.active_dofs

    def table(self, results: Results) -> dict[str, np.ndarray]:
        free = [float(dof in results.scene.active_dofs) for dof in DOF_NAMES]
        return {"direction": np.array(DOF_NAMES), "free": np.array(free)}
