"""Bearings by designation: a list to search, and to extend with a table of one's own."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.bearing_list import BearingTable, entry_words
from bearing_explorer.views.base import Ranges, SessionParts, Sources
from bearing_explorer.views.control_view import ControlView
from bearing_explorer.widgets.controls import Rows
from bearingcore.bearings.catalogue import COLUMNS, NEEDED

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results
    from bearing_explorer.state.scene_editor import SceneEditor
    from bearingcore import CatalogueBearing


class ListRows(Rows):
    """The list in the browser."""

    #: [{name, words, note, assumed, own}]
    entries = param.List(default=[])
    #: what became of the last table: {"words": str, "bad": bool}
    answer = param.Dict(default={"words": "", "bad": False})

    _esm = scripts("element.js", "asking.js", "rows.js", "bearing_list.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("controls.css"),
        asset_text("bearing_list.css"),
    ]

    editor: SceneEditor | None = None
    _shown = -1

    def show(self, **news: Any) -> None:
        """Follow the editor: its list is sent when it has changed."""
        super().show(**news)
        if self.editor is not None and self.editor.listed.version != self._shown:
            self._shown = self.editor.listed.version
            self.entries = [_entry(one, own) for one, own in self.editor.listed.all()]
            self.answer = {"words": self.editor.listed.words, "bad": self.editor.listed.bad}


class BearingList(ControlView):
    """Bearings whose inside dimensions are published, and a workshop's own."""

    name = "bearing-list"
    title = "Bearings by designation"
    about = (
        "Search, and take one into the scene. Load, speed and support stay. Each says what is "
        "printed, and what is assumed. A table of your own comes on top."
    )
    needs = frozenset[str]()

    def build(self, packed: PackedSource) -> Any:
        spec = {
            "file": "bearings.csv",
            "template": ";".join(COLUMNS)
            + "\n"
            + "6205, pump 3;9;7.94;39.04;;0.52;;0.53;0;10;14;\n",
            "needed": ", ".join(NEEDED),
        }
        self.rows = ListRows(self.forward, spec=spec)
        return self.rows

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self.rows.editor = parts.editor
        self.rows.show()

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        return {}, {}

    def sentence(self, results: Results) -> str:
        count = len(self.rows.entries)
        return f"{count} bearings are on the list." if count else "The list is being read."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        editor = self.rows.editor
        known = BearingTable() if editor is None else editor.listed
        listed = [one for one, _ in known.all()]
        return {
            "name": np.array([one.name for one in listed]),
            "balls": np.array([one.bearing.n_balls for one in listed]),
            "ball_diameter_mm": np.array([1e3 * one.bearing.ball_diameter for one in listed]),
            "pitch_diameter_mm": np.array([1e3 * one.bearing.pitch_diameter for one in listed]),
            "contact_angle_deg": np.array(
                [math.degrees(one.bearing.contact_angle) for one in listed]
            ),
            "assumed": np.array(["; ".join(one.assumed) for one in listed]),
        }


def _entry(one: CatalogueBearing, own: bool) -> dict[str, Any]:
    return {
        "name": one.name,
        "words": entry_words(one),
        "note": one.note,
        "assumed": ", ".join(one.assumed),
        "own": own,
    }
