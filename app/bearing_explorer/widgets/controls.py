"""Panels of controls: sliders one can type into, choices, play.

One component holds a whole panel: a session stays cheap, and a drag sends one message a frame
whatever it moves. What they ask for is judged in `bearing_explorer.state.scene_editor`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import asdict
from typing import Any, ClassVar

import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.server.live import LiveComponent
from bearing_explorer.state.quantity_list import CAGE_ANGLE, QUANTITY_LIST, SCENE_GROUPS
from bearingcore import preset_notes, presets

_PRESET_LABELS = {
    "liew-lim": "Angular contact bearing (Liew–Lim)",
    "fan-rig": "Fan rig, deep groove bearing",
    "6205": "6205, deep groove bearing",
    "6206": "6206, deep groove bearing",
    "7208-15deg": "7208, angular contact, 15°",
    "7208-25deg": "7208, angular contact, 25°",
    "7208-40deg": "7208, angular contact, 40°",
    "seven-ball": "Seven balls, commercial code",
}

#: name: (label, group, whether it stands before the sliders, {value: (label, sentence)})
_CHOICES: dict[str, tuple[str, str, bool, dict[str, tuple[str, str]]]] = {
    "race": (
        "Race",
        "Defect",
        True,
        {
            "outer": ("Outer", "The outer ring stands still, and its defect too."),
            "inner": (
                "Inner, turns",
                "The inner ring turns with the shaft. Curves are then drawn over a turn of the "
                "shaft, as the defect meets the balls in other places with each turn of the cage.",
            ),
        },
    ),
    "edge": (
        "Edge model",
        "Defect",
        False,
        {
            "published": (
                "Published (Eq. 6)",
                "Eq. 6 with its factor 0.25: a ball sinks less than geometry asks for, but the "
                "paper's figures were made with it.",
            ),
            "chord": (
                "Chord, whole arc",
                "Eq. 6 without the factor 0.25: the ball follows a straight chord between the "
                "edges.",
            ),
            "exact": (
                "Exact, curved race",
                "A ball that pivots on the corner of the curved race.",
            ),
        },
    ),
    "floor": (
        "Floor",
        "Defect",
        False,
        {
            "flat": ("Flat", "As deep everywhere."),
            "rough": (
                "Rough",
                "Random heights about the depth. The centre of a ball follows the ball's circle "
                "rolled over them.",
            ),
            "measured": (
                "From a file",
                "A text file of two columns: angle around the race in degrees, depth in "
                "micrometres. Extent, depth and centre come from the file; their sliders stretch "
                "it.",
            ),
        },
    ),
}


def spec_of(
    groups: Iterable[str], choices: Iterable[tuple[str, dict[str, Any]]] = ()
) -> dict[str, Any]:
    """What the browser needs to know once, to make the controls of some groups of quantities."""
    shown = ("name", "label", "symbol", "unit", "about")
    return {
        "groups": [
            {
                "title": group,
                "controls": [
                    {key: value for key, value in asdict(quantity).items() if key in shown}
                    for quantity in QUANTITY_LIST
                    if quantity.group == group
                ],
            }
            for group in groups
        ],
        "choices": dict(choices),
    }


def choice_spec(
    label: str, group: str, first: bool, options: dict[str, tuple[str, str]]
) -> dict[str, Any]:
    """What the browser needs to know of a choice."""
    return {
        "label": label,
        "group": group,
        "first": first,
        "options": [
            {"value": value, "label": words, "about": about}
            for value, (words, about) in options.items()
        ],
    }


def preset_options() -> dict[str, tuple[str, str]]:
    """Presets with their labels and notes."""
    return {
        name: (_PRESET_LABELS.get(name, name), note)
        for name, note in preset_notes.items()
        if name in presets
    }


class Rows(LiveComponent):
    """Sliders, numbers and choices. `tell` moves them, `asked` hears of them.

    `asked` gets messages of the browser as they come, from strangers too: judge them.
    """

    spec = param.Dict(default={})
    state = param.Dict(default={})

    _stylesheets: ClassVar[list[str]] = [asset_text("button.css"), asset_text("controls.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: asked(event.data))

    def tell(self, **news: Any) -> None:
        """Move controls in the browser (`state`), or say what was refused (`refused`)."""
        self._send_msg(news)


class Controls(Rows):
    """The controls beside the figures: bearing, defects, turning, load."""

    _esm = scripts("element.js", "rows.js", "controls.js")

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        choices = {"preset": choice_spec("Bearing", "", True, preset_options())}
        choices |= {name: choice_spec(*parts) for name, parts in _CHOICES.items()}
        spec = {
            **spec_of(SCENE_GROUPS, choices.items()),
            "turning": CAGE_ANGLE,
            "speed": "shaft_speed_hz",
            "defects": "Defect",
            "last": [quantity.name for quantity in QUANTITY_LIST if quantity.of == "floor"],
        }
        super().__init__(asked, spec=spec, **params)
