"""Form for the masses, springs and dampers around the bearing, and the law of the contacts."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
import param

from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import MODEL_GROUPS, values_of
from bearing_explorer.explorer.views.control_view import ControlView, table_of_fields
from bearing_explorer.explorer.widgets.controls import Rows, spec_of
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore.model.scene import FREE_TILT_WORDS


class ModelRows(Rows):
    """The fields in the browser."""

    #: text of the contact damping that follows from the stiffness
    automatic = param.String()

    _esm = scripts("element.js", "asking.js", "rows.js", "model_editor.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("controls.css"),
        asset_text("model_editor.css"),
    ]


class ModelEditor(ControlView):
    """Rotor, housing, support and damping, on which the motion of the bearing depends."""

    name = "model-editor"
    title = "Rotor, housing and support"
    about = (
        "Two bodies, and the support of the housing. The rotor sits in the inner ring, the housing "
        "around the outer one, on springs and dampers. They decide natural frequencies and "
        "vibration, never the static loads. An empty field means that the number is not known. A "
        "shaft on two bearings does not tilt; on this one alone it may, and the bearing carries "
        "less."
    )
    needs = frozenset({"contact_damping"})

    def build(self, packed: PackedSource) -> Any:
        self.rows = ModelRows(self.forward, spec=spec_of(MODEL_GROUPS))
        return self.rows

    def sentence(self, results: Results) -> str:
        scene = results.scene
        tilt = FREE_TILT_WORDS if {"rx", "ry"} & set(scene.active_dofs) else ""
        return " ".join(filter(None, (self._bodies(results), reasons.not_needed(scene), tilt)))

    def _bodies(self, results: Results) -> str:
        support = results.scene.support
        source = "given" if results.scene.contact_damping is not None else "from its stiffness"
        words = (
            f"A rotor of {style.number(support.inner_mass, 4)} kg in a housing of "
            f"{style.number(support.outer_mass, 4)} kg; "
        )
        if not results.contact_damping and results.scene.contact_damping is None:
            return f"{words}without a static state there is no stiffness to take a damping from."
        damping = style.number(results.contact_damping, 4)
        return f"{words}a loaded contact has a damping of {damping} N·s/m, {source}."

    def show(self, results: Results) -> None:
        if results.scene.contact_damping is None:
            self.rows.put(automatic=style.number(results.contact_damping, 4))

    def table(self, results: Results) -> dict[str, np.ndarray]:
        values = values_of(results.scene) | {"contact_damping": results.contact_damping}
        return table_of_fields(MODEL_GROUPS, values)
