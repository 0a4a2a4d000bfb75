"""Panels of controls: sliders with boxes to type in, choices, play.

One component holds a whole panel, so a session stays cheap, and a drag sends one message a frame
for all its controls. `bearing_explorer.explorer.state.scene_editor` checks the messages.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, ClassVar

import param

from bearing_explorer.explorer.messages import SceneChange
from bearing_explorer.explorer.state.choice_list import CHOICE_LIST, Choice
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE, SCENE_GROUPS, SHOWN_FIELDS
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.messages import take
from bearing_explorer.kit.serve.panel_internals import LiveComponent


def spec_of(groups: Iterable[str], *choices: Choice) -> dict[str, Any]:
    """The constant part of a panel of controls: groups of fields with their choices.

    `choices` are choices besides those of the groups.
    """
    names = list(groups)
    return {
        "groups": [
            {
                "title": group,
                "controls": [
                    {
                        "name": field.key,
                        "label": field.read_label,
                        "sign": field.read_sign,
                        "symbol": field.read_symbol_html,
                        "unit": field.shown_unit,
                        "about": field.meaning,
                    }
                    for field in SHOWN_FIELDS
                    if field.group == group
                ],
            }
            for group in names
        ],
        "choices": {
            choice.name: {
                "label": choice.label,
                "group": choice.group,
                "first": choice.first,
                "options": [
                    {"value": option.name, "label": option.label, "about": option.about}
                    for option in choice.options
                ],
            }
            for choice in CHOICE_LIST
            if choice in choices or choice.group in names
        },
    }


class Rows(LiveComponent):
    """Sliders, numbers and choices.

    `on_change` is called with each change as a dictionary with fields of `SceneChange`.
    """

    spec = param.Dict(default={})
    state = param.Dict(default={})

    _stylesheets: ClassVar[list[str]] = [asset_text("button.css"), asset_text("controls.css")]

    def __init__(self, on_change: Callable[[Any], None], **params: Any) -> None:
        super().__init__(**params)
        self.on_msg(lambda event: take(on_change, SceneChange, event.data))


MAIN = ("extent_deg", "fy_n", "shaft_speed_hz")
"""Sliders that are always visible; the others are folded."""


class Controls(Rows):
    """The controls next to the figures: bearing, defects, turning, load."""

    _esm = scripts("element.js", "asking.js", "rows.js", "bearing_search.js", "controls.js")

    def __init__(self, on_change: Callable[[Any], None], **params: Any) -> None:
        spec = {
            **spec_of(SCENE_GROUPS),
            "main": MAIN,
            "extent": "extent_deg",
            "turning": CAGE_ANGLE,
            "defects": "Defect",
            "last": [field.key for field in SHOWN_FIELDS if field.part == "floor"],
        }
        super().__init__(on_change, spec=spec, **params)
