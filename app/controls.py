"""The controls beside the figures: sliders one can type into, choices, play.

One component holds them all: a session stays cheap, and a drag sends one message a frame
whatever it moves. What it asks for is judged in `app.explorer`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any, ClassVar

import param
from panel.custom import JSComponent

from app.assets import asset_path, asset_text
from app.quantities import CAGE_ANGLE, QUANTITIES, Limits, Values
from bearingcore import EDGES, preset_notes, presets

_PRESET_LABELS = {
    "liew-lim": "Angular contact bearing (Liew–Lim)",
    "fan-rig": "Fan rig, deep groove bearing",
}
_EDGE_LABELS = {
    "published": "Published (Eq. 6)",
    "chord": "Chord, whole arc",
    "exact": "Exact, curved race",
}
_EDGE_NOTES = {
    "published": "Eq. 6 with its factor 0.25: a ball sinks less than geometry asks for, but the "
    "paper's figures were made with it.",
    "chord": "Eq. 6 without the factor 0.25: the ball follows a straight chord between the edges.",
    "exact": "A ball that pivots on the corner of the curved race.",
}


def _spec() -> dict[str, Any]:
    """What the browser needs to know once, to make the controls."""
    groups: dict[str, list[dict[str, str]]] = {}
    for quantity in QUANTITIES.values():
        shown = ("name", "label", "symbol", "unit", "about")
        entry = {key: value for key, value in asdict(quantity).items() if key in shown}
        groups.setdefault(quantity.group, []).append(entry)
    choices = {
        "preset": {
            "label": "Bearing",
            "group": "",
            "options": [
                {"value": name, "label": _PRESET_LABELS.get(name, name), "about": note}
                for name, note in preset_notes.items()
                if name in presets
            ],
        },
        "edge": {
            "label": "Edge model",
            "group": "Defect",
            "options": [
                {"value": name, "label": _EDGE_LABELS[name], "about": _EDGE_NOTES[name]}
                for name in EDGES
            ],
        },
    }
    return {
        "groups": [{"title": title, "controls": entries} for title, entries in groups.items()],
        "choices": choices,
        "turning": CAGE_ANGLE,
        "speed": "shaft_speed_hz",
    }


class Controls(JSComponent):
    """Sliders, numbers and choices of a session. `tell` moves them, `asked` hears of them.

    `asked` gets messages of the browser as they come, from strangers too: judge them.
    """

    spec = param.Dict(default={})
    state = param.Dict(default={})

    _esm = asset_path("controls.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("controls.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(spec=_spec(), margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: asked(event.data))

    @staticmethod
    def state_of(
        values: Values, limits: Mapping[str, Limits], choices: Mapping[str, str]
    ) -> dict[str, Any]:
        """All that can be told to the browser, as one value."""
        return {
            "values": dict(values),
            "limits": {name: asdict(allowed) for name, allowed in limits.items()},
            "choices": dict(choices),
        }

    def tell(self, **news: Any) -> None:
        """Move controls in the browser (`state`), or say what was refused (`refused`)."""
        self._send_msg(news)
